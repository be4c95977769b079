// SPDX-License-Identifier: MIT
// Contacts of soft bodies with dynamic rigid bodies.
#include "core/collision/rigid_contacts.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

constexpr std::size_t BODIES_A_TASK = 8;

} // namespace

void RigidContacts::begin_step(WorldData &world, const ColliderIndex &surroundings) {
	world_ = &world;
	search_.begin_step(world, surroundings);
	std::ranges::fill(world.mutable_reactions(), Reaction{});
}

void RigidContacts::begin_substep(Real h) {
	h_ = h;
	search_.begin_substep();
	pull_ = length(world_->gravity());
	for (RigidBody &rigid : world_->mutable_rigid_bodies()) {
		if (rigid.is_dynamic()) {
			rigid.pose = rigid.asleep ? rigid.pose : rigid.pose_after(h);
			rigid.change_velocities(rigid.acceleration * h, 0);
			pull_ = std::max(pull_, length(rigid.acceleration));
		}
	}
	for (std::size_t near = 0; near < search_.body_count(); ++near) {
		if (const SoftBodyData &body = *search_.body(near).body; body.acceleration() != Vec2{}) {
			pull_ = std::max(pull_, length(body.total_acceleration(world_->gravity())));
		}
	}
}

std::uint64_t RigidContacts::solve(const ParallelFor &parallel_for) {
	for (Task &task : tasks_) {
		task.contacts.clear();
		task.places.clear();
	}
	run_slices(parallel_for, search_.body_count(), BODIES_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t near = begin; near < end; ++near) {
			search_.find(near, [&](const RigidTouch &touch) { add_contact(touch, tasks_[task]); });
		}
	});
	// Each contact disturbs the others a little. Further passes, forward and backward, reduce that error.
	static_assert(RIGID_CONTACT_PASSES % 2 == 0);
	for (int pass = 0; pass < RIGID_CONTACT_PASSES; pass += 2) {
		for (Task &task : tasks_) {
			std::ranges::for_each(task.contacts, [&](Contact &contact) { push(contact); });
		}
		for (auto task = tasks_.rbegin(); task != tasks_.rend(); ++task) {
			std::for_each(task->contacts.rbegin(), task->contacts.rend(), [&](Contact &contact) { push(contact); });
		}
	}
	std::uint64_t count = 0;
	for (const Task &task : tasks_) {
		for (std::size_t i = 0; i < task.contacts.size(); ++i) {
			finish(task.contacts[i], task.places[i]);
		}
		count += task.contacts.size();
	}
	return count;
}

// A supported rigid body has a smaller inverse mass along s, the direction of its support, by the share a: W = (1 - a s
// sᵀ) / m. So a contact that presses the body against its support meets resistance. With the mass alone the two would
// sink together until the engine puts the body back. With h = s sqrt(a), W x = (x - h (h · x)) / m.
Vec2 RigidContacts::inverse_mass_along(const Contact &contact, Vec2 impulse) {
	return (impulse - contact.held * dot(contact.held, impulse)) * contact.inverse_mass;
}

// An impulse J n on the place and its opposite on the rigid body change their relative normal velocity by J k with k =
// w + 1/m + (r × n)² / I, where w is the inverse mass of the place.
void RigidContacts::add_contact(const RigidTouch &touch, Task &task) const {
	const RigidContactSearch::NearBody &body = search_.body(touch.near);
	const Collider &collider = world_->colliders()[touch.collider];
	const RigidBody &rigid = world_->rigid_bodies()[collider.rigid_body];
	const PointOnEdge edge(touch.at.place, body.inverse_masses);
	const Vec2 found = position_of(touch.at.place, body.positions);
	task.places.push_back({ touch, edge, found });
	Contact &contact = task.contacts.emplace_back();
	contact.velocity_a = &body.velocities[edge.a];
	contact.velocity_b = &body.velocities[edge.b];
	contact.rigid_body = collider.rigid_body;
	contact.share_a = edge.share_a;
	contact.share_b = edge.share_b;
	contact.inverse_mass_a = edge.inverse_mass_a;
	contact.inverse_mass_b = edge.inverse_mass_b;
	const Vec2 normal = touch.at.normal;
	const Vec2 tangent = perpendicular(normal);
	contact.normal = normal;
	contact.arm = found - rigid.center();
	if (collider.surface.is_moving()) {
		contact.belt = rigid.pose.rotation.apply(collider.surface.velocity_at(rigid.pose.apply_inverse(found)));
	}
	contact.friction = combined_friction(body.body->settings(), collider.surface);
	contact.inverse_mass = rigid.inverse_mass;
	contact.inverse_inertia = rigid.inverse_inertia;
	if (const Real share = length_squared(rigid.support); share > 0 && dot(normal, rigid.support) > 0) {
		contact.held = rigid.support * (1 / std::sqrt(std::sqrt(share)));
		contact.inverse_inertia *= 1 - rigid.turn_support;
	}
	const auto mass_along = [&](Vec2 direction) {
		const Real along = dot(contact.held, direction);
		const Real lever = cross(contact.arm, direction);
		const Real response = edge.inverse_mass + rigid.inverse_mass * (1 - along * along) + contact.inverse_inertia * lever * lever;
		return response > 0 ? 1 / response : Real(0);
	};
	const Real approach = -dot(relative_velocity(contact), normal);
	contact.wanted = rebound_speed(approach, combined_restitution(body.body->settings(), collider.surface), RESTITUTION_SUBSTEPS * pull_ * h_);
	// A body that is about to be reset must not affect the rigid body.
	contact.normal_mass = std::isfinite(approach) ? mass_along(normal) : Real(0);
	contact.tangent_mass = mass_along(tangent);
	contact.coupling = contact.inverse_inertia * cross(contact.arm, normal) * cross(contact.arm, tangent) +
			dot(inverse_mass_along(contact, normal), tangent);
}

Vec2 RigidContacts::relative_velocity(const Contact &contact) const {
	const RigidBody &rigid = world_->rigid_bodies()[contact.rigid_body];
	return *contact.velocity_a * contact.share_a + *contact.velocity_b * contact.share_b -
			(rigid.linear_velocity + perpendicular(contact.arm) * rigid.angular_velocity + contact.belt);
}

void RigidContacts::push(Contact &contact) {
	if (!(contact.normal_mass > 0)) {
		return; // neither can move
	}
	const Vec2 normal = contact.normal;
	const Vec2 tangent = perpendicular(normal);
	const Vec2 relative = relative_velocity(contact);
	const Real missing = contact.wanted - dot(relative, normal);
	const Real pressing = std::max(contact.normal_impulse + missing * contact.normal_mass, Real(0));
	const Real pressed = pressing - contact.normal_impulse;
	// Friction acts after the normal impulse, which changes the sliding speed, too: by the lever, and along the support.
	const Real slide = dot(relative, tangent) + pressed * contact.coupling;
	const Real braking = within(contact.friction * pressing, contact.tangent_impulse - slide * contact.tangent_mass);
	const Vec2 impulse = normal * pressed + tangent * (braking - contact.tangent_impulse);
	RigidBody &rigid = world_->mutable_rigid_bodies()[contact.rigid_body];
	if (!rigid.change_velocities(-inverse_mass_along(contact, impulse), -cross(contact.arm, impulse) * contact.inverse_inertia)) {
		return; // a body that is about to be reset must not affect the rigid body
	}
	*contact.velocity_a += impulse * contact.inverse_mass_a;
	*contact.velocity_b += impulse * contact.inverse_mass_b;
	contact.normal_impulse = pressing;
	contact.tangent_impulse = braking;
}

// Books the impulse and moves the hull out of the overlap. The push is shortened by the way that other contacts have already moved
// the place. Includes the way slid that friction takes back, as in `contact_change`.
void RigidContacts::finish(const Contact &contact, const Place &place) {
	const Vec2 tangent = perpendicular(contact.normal);
	const Vec2 impulse = contact.normal * contact.normal_impulse + tangent * contact.tangent_impulse;
	Reaction &reaction = world_->mutable_reactions()[contact.rigid_body];
	reaction.impulse -= impulse;
	reaction.angular_impulse -= cross(contact.arm, impulse);
	const RigidContactSearch::NearBody &body = search_.body(place.touch.near);
	if (place.edge.inverse_mass > 0 && contact.normal_mass > 0) {
		const Vec2 moved = place.edge.of(body.positions) - place.found;
		const Real depth = std::max(place.touch.at.depth - dot(moved, contact.normal), Real(0));
		const Real braked = contact.tangent_mass > 0 ? contact.tangent_impulse / contact.tangent_mass * h_ : Real(0);
		place.edge.change(body.positions, contact.normal * depth + tangent * braked);
	}
	if (body.body->settings().contact_monitor) {
		note(contact, place);
	}
}

void RigidContacts::note(const Contact &contact, const Place &place) {
	const HullPlace &at = place.touch.at.place;
	const RigidContactSearch::NearBody &body = search_.body(place.touch.near);
	log_.add({ std::uint32_t(body.body - world_->soft_bodies().data()), ContactOther::Kind::COLLIDER, place.touch.collider,
			place.touch.feature, nearest_point(at), 0, position_of(at, body.positions), contact.normal, contact.normal_impulse,
			place.touch.at.depth });
}

void RigidContacts::end_step(Real dt) {
	for (RigidBody &rigid : world_->mutable_rigid_bodies()) {
		if (!rigid.is_dynamic()) {
			rigid.pose = rigid.pose_after(dt);
		}
	}
}

} // namespace softbody
