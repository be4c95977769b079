// SPDX-License-Identifier: MIT
// Contacts of soft bodies with dynamic rigid bodies.
#include "core/collision/rigid_contacts.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 8;

// Box around a collider on its way, however it turns. It spares points far from the collider their way into its frame.
Aabb box_on_way(const Collider &collider, const ColliderMotion &motion, Real slop) {
	Real reach = 0;
	for (const Vec2 vertex : collider.vertices) {
		reach = std::max(reach, length_squared(vertex));
	}
	return Aabb::between(motion.from.position, motion.to.position).grown(std::sqrt(reach) + collider.radius + slop);
}

} // namespace

void RigidContacts::begin_step(WorldData &world, const ColliderIndex &surroundings) {
	world_ = &world;
	surroundings_ = &surroundings;
	bodies_.clear();
	before_.clear();
	from_.resize(world.rigid_bodies().size());
	std::ranges::fill(world.mutable_reactions(), Reaction{});
}

void RigidContacts::add_body(SoftBodyData &body) {
	bodies_.push_back({ &body, before_.size() });
	before_.resize(before_.size() + body.hull().size());
}

void RigidContacts::begin_substep(Real h) {
	h_ = h;
	const std::span<RigidBody> rigid_bodies = world_->mutable_rigid_bodies();
	Real pull = length(world_->gravity());
	for (std::size_t i = 0; i < rigid_bodies.size(); ++i) {
		RigidBody &rigid = rigid_bodies[i];
		if (rigid.is_dynamic()) {
			from_[i] = rigid.pose;
			rigid.pose = rigid.asleep ? rigid.pose : rigid.pose_after(h);
			rigid.change_velocities(rigid.acceleration * h, 0);
			pull = std::max(pull, length(rigid.acceleration));
		}
	}
	for (const NearBody &near : bodies_) {
		if (near.body->acceleration() != Vec2{}) {
			pull = std::max(pull, length(near.body->total_acceleration(world_->gravity())));
		}
		std::ranges::copy(near.body->hull(), before_.begin() + std::ptrdiff_t(near.first_before));
	}
	bounce_threshold_ = RESTITUTION_SUBSTEPS * pull * h;
}

void RigidContacts::find(const NearBody &near, Task &task) const {
	SoftBodyData &body = *near.body;
	const HullMotion hull{ std::span(before_).subspan(near.first_before, body.hull().size()), body.hull() };
	const Aabb swept = hull.box();
	surroundings_->collect_dynamic(swept, task.colliders);
	const Real slop = LINEAR_SLOP * world_->length_unit();
	for (const std::uint32_t i : task.colliders) {
		const Collider &collider = world_->colliders()[i];
		if (!notices(body, collider.surface)) {
			continue;
		}
		const RigidBody &rigid = world_->rigid_bodies()[collider.rigid_body];
		const ColliderMotion motion{ from_[collider.rigid_body], rigid.pose, false };
		const Aabb bounds = collider.bounds().grown(slop);
		const auto add = [&](const SurfaceContact &at, std::uint32_t feature) {
			Contact &contact = task.contacts.emplace_back();
			contact.body = &body;
			contact.at = at;
			contact.rigid_body = collider.rigid_body;
			contact.collider = i;
			contact.feature = feature;
			contact.place = position_of(at.place, hull.to);
			contact.belt = motion.to.rotation.apply(collider.surface.velocity_at(motion.to.apply_inverse(contact.place)));
			contact.friction = combined_friction(body.settings(), collider.surface);
			contact.restitution = combined_restitution(body.settings(), collider.surface);
		};
		const Aabb box = box_on_way(collider, motion, slop);
		for (std::uint32_t point = 0; point < hull.to.size(); ++point) {
			if (!Aabb::between(hull.from[point], hull.to[point]).overlaps(box)) {
				continue;
			}
			if (const auto at = find_contact_of_point(hull, point, collider, motion, bounds, slop)) {
				add(*at, point);
			}
		}
		for (std::uint32_t corner = 0; corner < collider.vertices.size(); ++corner) {
			if (const auto at = find_contact_of_corner(hull, swept, collider, corner, motion, slop)) {
				add(*at, ContactPoint::CORNER | corner);
			}
		}
	}
}

std::uint64_t RigidContacts::solve(const ParallelFor &parallel_for) {
	run_slices(parallel_for, bodies_.size(), BODIES_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			find(bodies_[i], tasks_[task]);
		}
	});
	contacts_.clear();
	for (Task &task : tasks_) {
		contacts_.insert(contacts_.end(), task.contacts.begin(), task.contacts.end());
		task.contacts.clear();
	}
	for (Contact &contact : contacts_) {
		prepare(contact);
	}
	// Each contact disturbs the others a little. Further passes, forward and backward, reduce that error.
	for (int pass = 0; pass < RIGID_CONTACT_PASSES; ++pass) {
		for (std::size_t i = 0; i < contacts_.size(); ++i) {
			push(contacts_[pass % 2 == 0 ? i : contacts_.size() - 1 - i]);
		}
	}
	for (Contact &contact : contacts_) {
		move_out(contact);
		if (contact.body->settings().contact_monitor) {
			note(contact);
		}
	}
	return contacts_.size();
}

// A supported rigid body has a smaller inverse mass along s, the direction of its support, by the share a: W = (1 - a s
// sᵀ) / m. So a contact that presses the body against its support meets resistance. With the mass alone the two would
// sink together until the engine puts the body back. With h = s sqrt(a), W x = (x - h (h · x)) / m.
Vec2 RigidContacts::inverse_mass_along(const Contact &contact, Vec2 impulse) const {
	return (impulse - contact.held * dot(contact.held, impulse)) * world_->rigid_bodies()[contact.rigid_body].inverse_mass;
}

// An impulse J n on the place and its opposite on the rigid body change their relative normal velocity by J k with k =
// w + 1/m + (r × n)² / I, where w is the inverse mass of the place.
void RigidContacts::prepare(Contact &contact) {
	const RigidBody &rigid = world_->rigid_bodies()[contact.rigid_body];
	contact.edge = PointOnEdge(contact.at.place, contact.body->inverse_masses());
	contact.arm = contact.place - rigid.center();
	const Real share = length(rigid.support);
	const bool is_pressed = share > 0 && dot(contact.at.normal, rigid.support) > 0;
	contact.held = is_pressed ? rigid.support * (1 / std::sqrt(share)) : Vec2{};
	contact.inverse_inertia = is_pressed ? rigid.inverse_inertia * (1 - rigid.turn_support) : rigid.inverse_inertia;
	const Real lever = cross(contact.arm, contact.at.normal);
	const Real side_lever = cross(contact.arm, perpendicular(contact.at.normal));
	const auto straight = [&](Vec2 direction) {
		const Real along = dot(contact.held, direction);
		return contact.edge.inverse_mass + rigid.inverse_mass * (1 - along * along);
	};
	contact.normal_response = straight(contact.at.normal) + contact.inverse_inertia * lever * lever;
	contact.tangent_response = straight(perpendicular(contact.at.normal)) + contact.inverse_inertia * side_lever * side_lever;
	const Real approach = -dot(relative_velocity(contact), contact.at.normal);
	contact.wanted = rebound_speed(approach, contact.restitution, bounce_threshold_);
	// A body that is about to be reset must not affect the rigid body.
	if (!std::isfinite(approach)) {
		contact.normal_response = 0;
	}
}

Vec2 RigidContacts::relative_velocity(const Contact &contact) const {
	const RigidBody &rigid = world_->rigid_bodies()[contact.rigid_body];
	return contact.edge.of(contact.body->velocities()) -
			(rigid.linear_velocity + perpendicular(contact.arm) * rigid.angular_velocity + contact.belt);
}

void RigidContacts::push(Contact &contact) {
	if (!(contact.normal_response > 0)) {
		return; // neither can move
	}
	const Vec2 normal = contact.at.normal;
	const Vec2 tangent = perpendicular(normal);
	const Vec2 relative = relative_velocity(contact);
	const Real missing = contact.wanted - dot(relative, normal);
	const Real pressing = std::max(contact.normal_impulse + missing / contact.normal_response, Real(0));
	const Real pressed = pressing - contact.normal_impulse;
	// Friction acts after the normal impulse, which changes the sliding speed, too: by the lever, and along the support.
	const Real coupling = contact.inverse_inertia * cross(contact.arm, normal) * cross(contact.arm, tangent) +
			dot(inverse_mass_along(contact, normal), tangent);
	const Real slide = dot(relative, tangent) + pressed * coupling;
	const Real most = contact.friction * pressing;
	const Real braking = within(most, contact.tangent_impulse - slide / contact.tangent_response);
	apply(contact, normal * pressed + tangent * (braking - contact.tangent_impulse));
	contact.normal_impulse = pressing;
	contact.tangent_impulse = braking;
}

void RigidContacts::apply(Contact &contact, Vec2 impulse) {
	RigidBody &rigid = world_->mutable_rigid_bodies()[contact.rigid_body];
	const Real turning = cross(contact.arm, impulse);
	if (!rigid.change_velocities(-inverse_mass_along(contact, impulse), -turning * contact.inverse_inertia)) {
		return; // a body that is about to be reset must not affect the rigid body
	}
	contact.edge.push(contact.body->mutable_velocities(), impulse);
	Reaction &reaction = world_->mutable_reactions()[contact.rigid_body];
	reaction.impulse -= impulse;
	reaction.angular_impulse -= turning;
}

// The push is shortened by the way that other contacts have already moved the place. Includes the way slid that
// friction takes back, as in `contact_change`.
void RigidContacts::move_out(Contact &contact) {
	if (!(contact.edge.inverse_mass > 0) || !(contact.normal_response > 0)) {
		return;
	}
	const std::span<Vec2> x = contact.body->mutable_positions();
	const Vec2 moved = contact.edge.of(x) - contact.place;
	const Real depth = std::max(contact.at.depth - dot(moved, contact.at.normal), Real(0));
	const Real braked = contact.tangent_impulse * contact.tangent_response * h_;
	const Vec2 shift = contact.at.normal * depth + perpendicular(contact.at.normal) * braked;
	contact.edge.change(x, shift);
}

void RigidContacts::note(const Contact &contact) {
	const HullPlace &place = contact.at.place;
	log_.add({ std::uint32_t(contact.body - world_->soft_bodies().data()), ContactOther::Kind::COLLIDER, contact.collider,
			contact.feature, nearest_point(place), 0, position_of(place, contact.body->positions()), contact.at.normal,
			contact.normal_impulse, contact.at.depth });
}

void RigidContacts::end_step(Real dt) {
	for (RigidBody &rigid : world_->mutable_rigid_bodies()) {
		if (!rigid.is_dynamic()) {
			rigid.pose = rigid.pose_after(dt);
		}
	}
}

} // namespace softbody
