// SPDX-License-Identifier: MIT
// Finds the ends of joints, and solves joints.
#include "core/dynamics/joint_solver.h"

#include "core/base/constants.h"
#include "core/base/hash.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

bool is_rigid(const Joint &joint) {
	return std::isinf(joint.stiffness);
}

// Solves K J = v for the symmetric matrix K = (a b; b c). If K is nearly singular, as for a body that can only turn, it
// is replaced by its trace.
Vec2 solve_2x2(Real a, Real b, Real c, Vec2 v) {
	const Real determinant = a * c - b * b;
	const Real trace = a + c;
	if (!(determinant > DEGENERATE_LENGTH * trace * trace)) {
		return trace > 0 ? v * (1 / trace) : Vec2{};
	}
	return Vec2{ c * v.x - b * v.y, a * v.y - b * v.x } * (1 / determinant);
}

} // namespace

JointSolver::Side JointSolver::side_of(const JointAnchor &anchor) const {
	Side side;
	side.position = anchor.position;
	if (anchor.kind == JointAnchor::Kind::RIGID_BODY) {
		const auto found = std::ranges::lower_bound(tags_, anchor.tag, {}, &std::pair<std::uint64_t, std::uint32_t>::first);
		side.rigid = found != tags_.end() && found->first == anchor.tag ? found->second : NO_RIGID_BODY;
		return side;
	}
	if (!anchor.is_soft()) {
		return side;
	}
	side.body = world_->find(anchor.body);
	side.active_index = active_indices_[std::size_t(side.body - world_->soft_bodies().data())];
	const std::uint32_t hull_count = std::uint32_t(side.body->shape().hull_count());
	const std::uint32_t end = anchor.fraction != 0 ? (anchor.point + 1) % hull_count : anchor.point;
	side.place = PointOnEdge({ anchor.point, end, anchor.fraction }, side.body->inverse_masses());
	take_section(side, anchor);
	return side;
}

void JointSolver::begin_step(WorldData &world, std::span<const std::uint32_t> body_indices, bool is_rearranged, Real dt) {
	active_.clear();
	chain_ends_.clear();
	const std::span<const Joint> joints = world.joints();
	const bool has_changed = is_rearranged || seen_joints_ != world.change_counts().joints || world_ != &world;
	world_ = &world;
	body_indices_ = body_indices;
	dt_ = dt;
	seen_joints_ = world.change_counts().joints;
	if (has_changed) {
		joined_.clear();
		separated_.clear();
		is_held_.assign(joints.empty() ? 0 : body_indices.size(), 0);
		rigid_ends_.assign(joints.empty() ? 0 : body_indices.size(), 0);
		held_to_rigid_.clear();
		active_indices_.assign(joints.empty() ? 0 : world.soft_bodies().size(), UINT32_MAX);
		for (std::uint32_t active_index = 0; !joints.empty() && active_index < body_indices.size(); ++active_index) {
			active_indices_[body_indices[active_index]] = active_index;
		}
	}
	if (joints.empty()) {
		separated_now_.clear();
		return;
	}
	tags_.clear();
	for (std::uint32_t i = 0; i < world.rigid_bodies().size(); ++i) {
		if (world.rigid_bodies()[i].tag != 0) {
			tags_.push_back({ world.rigid_bodies()[i].tag, i });
		}
	}
	std::ranges::sort(tags_);
	std::ranges::fill(is_held_, char(0));
	for (const std::uint32_t active_index : held_to_rigid_) {
		rigid_ends_[active_index] = 0;
	}
	held_to_rigid_.clear();
	for (std::uint32_t i = 0; i < joints.size(); ++i) {
		Active active;
		active.joint = i;
		active.sides = { side_of(joints[i].first), side_of(joints[i].second) };
		note_rigid_ends(joints[i], active.sides);
		bool is_there = true;
		for (std::size_t end = 0; end < 2; ++end) {
			const Side &side = active.sides[end];
			const JointAnchor &anchor = end == 0 ? joints[i].first : joints[i].second;
			is_there &= anchor.is_soft() ? side.active_index != UINT32_MAX
										 : anchor.kind == JointAnchor::Kind::WORLD || side.rigid != NO_RIGID_BODY;
		}
		if (!is_there) {
			continue;
		}
		for (std::size_t end = 0; end < 2; ++end) {
			const Side &side = active.sides[end];
			const std::uint32_t other = active.sides[1 - end].rigid;
			const bool is_to_dynamic = other != NO_RIGID_BODY && world.rigid_bodies()[other].is_dynamic();
			if (side.body) {
				is_held_[side.active_index] = std::max(is_held_[side.active_index], char(is_to_dynamic ? 2 : 1));
			}
		}
		active_.push_back(active);
		if (has_changed && active.sides[0].body && active.sides[1].body) {
			const auto [a, b] = std::minmax(active.sides[0].active_index, active.sides[1].active_index);
			joined_.push_back({ a, b });
			if (!joints[i].collide_joined) {
				separated_.push_back({ a, b });
			}
		}
	}
	if (has_changed) {
		std::ranges::sort(separated_);
		find_structures();
	}
	find_chains();
	separate_crushed();
	std::ranges::sort(held_to_rigid_);
	held_to_rigid_.erase(std::unique(held_to_rigid_.begin(), held_to_rigid_.end()), held_to_rigid_.end());
}

void JointSolver::find_structures() {
	members_.clear();
	structures_.reset(std::uint32_t(is_held_.size()));
	for (const BodyPair pair : joined_) {
		structures_.join(pair.a, pair.b);
	}
	for (const BodyPair pair : joined_) {
		for (const std::uint32_t active_index : { pair.a, pair.b }) {
			members_.push_back({ structures_.find(active_index), active_index });
		}
	}
	std::ranges::sort(members_);
	members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
}

// A chain that was shaken until its bodies lie in one another is a knot: each body is kept crushed by the others, and the
// joints let none of them leave. A crushed body unfolds as soon as nothing of its structure presses on it.
void JointSolver::separate_crushed() {
	separated_now_.assign(separated_.begin(), separated_.end());
	for (std::size_t begin = 0, end = 0; begin < members_.size(); begin = end) {
		while (end < members_.size() && members_[end].first == members_[begin].first) {
			++end;
		}
		if (end - begin < 3) {
			continue; // these are joined, and collide only if told to
		}
		for (std::size_t i = begin; i < end; ++i) {
			const SoftBodyData &body = world_->soft_bodies()[body_indices_[members_[i].second]];
			if (signed_area(body.hull()) >= CRUSHED_AREA * body.shape().rest_area()) {
				continue;
			}
			for (std::size_t other = begin; other < end; ++other) {
				const auto [a, b] = std::minmax(members_[i].second, members_[other].second);
				if (a != b) {
					separated_now_.push_back({ a, b });
				}
			}
		}
	}
	if (separated_now_.size() > separated_.size()) {
		std::ranges::sort(separated_now_);
		separated_now_.erase(std::unique(separated_now_.begin(), separated_now_.end()), separated_now_.end());
	}
}

// Sums hashes, so that the order of the joints does not matter. A missing rigid body has a hash, too.
void JointSolver::note_rigid_ends(const Joint &joint, const std::array<Side, 2> &sides) {
	for (std::size_t end = 0; end < 2; ++end) {
		const JointAnchor &other = end == 0 ? joint.second : joint.first;
		if (sides[end].active_index == UINT32_MAX || other.kind != JointAnchor::Kind::RIGID_BODY) {
			continue;
		}
		const std::uint32_t rigid = sides[1 - end].rigid;
		Hash hash;
		if (rigid != NO_RIGID_BODY) {
			hash.add(world_->rigid_bodies()[rigid].pose.apply(other.position));
		}
		rigid_ends_[sides[end].active_index] += hash.value();
		held_to_rigid_.push_back(sides[end].active_index);
	}
}

bool JointSolver::is_still(const Side &side) const {
	return side.body->is_asleep() || side.body->is_frozen();
}

bool JointSolver::wake_joined() {
	bool has_woken = false;
	const auto wake = [&](Side &side) {
		if (side.body->is_asleep()) {
			side.body->wake();
			has_woken = true;
		}
	};
	for (Active &active : active_) {
		for (std::size_t end = 0; end < 2; ++end) {
			Side &side = active.sides[end];
			const Side &other = active.sides[1 - end];
			if (!side.body || (other.body && is_still(other))) {
				continue;
			}
			if (other.rigid == NO_RIGID_BODY) {
				if (other.body) {
					wake(side);
				}
				continue;
			}
			// A body joined to a moving rigid body stays awake. A dynamic body would fall if its joint were not solved.
			const RigidBody &rigid = world_->rigid_bodies()[other.rigid];
			if ((rigid.is_dynamic() && !rigid.asleep) || rigid.linear_velocity != Vec2{} || rigid.angular_velocity != 0) {
				wake(side);
				side.body->wake();
			}
		}
	}
	return has_woken;
}

void JointSolver::update_place(Side &side, Real elapsed) const {
	if (side.body) {
		side.at = side.place.of(side.body->positions());
	} else if (side.rigid != NO_RIGID_BODY) {
		const RigidBody &rigid = world_->rigid_bodies()[side.rigid];
		const Pose pose = rigid.is_dynamic() ? rigid.pose : rigid.pose_after(elapsed);
		side.at = pose.apply(side.position);
		side.arm = side.at - pose.apply(rigid.center_of_mass);
	} else {
		side.at = side.position;
	}
}

Vec2 JointSolver::velocity_of(const Side &side) const {
	if (side.body) {
		return side.place.of(side.body->velocities());
	}
	if (side.rigid != NO_RIGID_BODY) {
		const RigidBody &rigid = world_->rigid_bodies()[side.rigid];
		return rigid.linear_velocity + perpendicular(side.arm) * rigid.angular_velocity;
	}
	return {};
}

void JointSolver::move(Side &side, Vec2 way) const {
	if (!side.body) {
		return;
	}
	const std::span<Vec2> x = side.body->mutable_positions();
	side.section == ChainShape::NO_SECTION ? side.place.push(x, way) : push_section(side, x, way);
	side.at = side.place.of(x);
}

void JointSolver::apply(Side &side, Vec2 impulse) const {
	if (side.body && side.section != ChainShape::NO_SECTION) {
		push_section(side, side.body->mutable_velocities(), impulse);
	} else if (side.body) {
		side.place.push(side.body->mutable_velocities(), impulse);
	} else if (side.rigid != NO_RIGID_BODY) {
		RigidBody &rigid = world_->mutable_rigid_bodies()[side.rigid];
		if (!rigid.is_dynamic()) {
			return;
		}
		const Real turning = cross(side.arm, impulse);
		if (!rigid.change_velocities(impulse * rigid.inverse_mass, turning * rigid.inverse_inertia)) {
			return; // skipped as in `prepare`
		}
		Reaction &reaction = world_->mutable_reactions()[side.rigid];
		reaction.impulse += impulse;
		reaction.angular_impulse += turning;
	}
}

// Moves the soft anchors along `gap`, from the first to the second, to close it: by the part that this substep has
// made, and a bounded part of an older gap.
void JointSolver::close_gap(Active &active, Vec2 gap, Vec2 relative_velocity, Real h) {
	Side &first = active.sides[0];
	Side &second = active.sides[1];
	const Real inverse_mass = first.place.inverse_mass + second.place.inverse_mass;
	const Real size = length(gap);
	if (!(inverse_mass > 0) || !(size > 0)) {
		return;
	}
	Real radius = std::numeric_limits<Real>::max();
	for (const Side &side : active.sides) {
		radius = side.body ? std::min(radius, side.body->shape().radius()) : radius;
	}
	// What the velocities did not say may have moved the anchors, too: contacts and limits of shape.
	const auto way_of = [&](const Side &side) { return side.body ? side.at - side.before : velocity_of(side) * h; };
	const Real fresh = std::max(length(relative_velocity) * h, length(way_of(second) - way_of(first)));
	const Real most = fresh + JOINT_GAP_SPEED * radius * h;
	const Vec2 way = gap * (std::min(size, most) / (size * inverse_mass));
	move(first, way);
	move(second, -way);
	if (active.is_line && size <= fresh) {
		keep_spin(active, dot(gap, active.direction));
	}
}

// Two anchors moved towards each other by `closed` keep their angular momentum about each other by turning faster.
// Without this a rod or spring of angular velocity ω would lose h ω²/2 of its spin a second.
void JointSolver::keep_spin(Active &active, Real closed) {
	auto &[first, second] = active.sides;
	const Real distance = dot(second.at - first.at, active.direction);
	const Real inverse_mass = first.place.inverse_mass + second.place.inverse_mass;
	const bool is_soft = first.rigid == NO_RIGID_BODY && second.rigid == NO_RIGID_BODY;
	if (!is_soft || !(inverse_mass > 0) || !(distance > 2 * std::abs(closed))) {
		return;
	}
	const Vec2 across = perpendicular(active.direction);
	const Real faster = dot(velocity_of(second) - velocity_of(first), across) * closed / distance;
	apply(first, across * (-faster / inverse_mass));
	apply(second, across * (faster / inverse_mass));
}

void JointSolver::prepare(Active &active, Real elapsed, Real h) {
	const Joint &joint = world_->joints()[active.joint];
	auto &[first, second] = active.sides;
	update_place(first, elapsed);
	update_place(second, elapsed);
	active.impulse = {};
	active.wanted = {};
	active.is_line = !is_rigid(joint) || joint.rest_length > 0;
	const Vec2 way = second.at - first.at;
	const Vec2 relative_velocity = velocity_of(second) - velocity_of(first);
	const Real distance = length(way);
	// A body that is about to be reset must not affect others.
	active.is_idle = (first.body ? is_still(first) : true) && (second.body ? is_still(second) : true);
	active.is_idle |= !is_finite(way) || !is_finite(relative_velocity);
	if (active.is_idle) {
		return;
	}
	Vec2 gap = way;
	if (active.is_line) {
		if (!(distance > 0)) {
			active.is_idle = true; // no direction; the next substep may bring one
			return;
		}
		active.direction = way * (1 / distance);
		gap = active.direction * (distance - joint.rest_length);
	}
	if (is_rigid(joint)) {
		if (first.place.inverse_mass + second.place.inverse_mass > 0) {
			close_gap(active, gap, relative_velocity, h);
			update_place(first, elapsed);
			update_place(second, elapsed);
		} else {
			active.wanted = gap * (-JOINT_PULL / dt_); // a rigid body joined to an immovable anchor
		}
	}
	if (!active.is_line) {
		return;
	}
	active.response = first.place.inverse_mass + second.place.inverse_mass;
	for (const Side &side : active.sides) {
		if (side.rigid != NO_RIGID_BODY) {
			const RigidBody &rigid = world_->rigid_bodies()[side.rigid];
			const Real lever = cross(side.arm, active.direction);
			active.response += rigid.inverse_mass + rigid.inverse_inertia * lever * lever;
		}
	}
}

void JointSolver::push(Active &active) {
	auto &[first, second] = active.sides;
	const Vec2 relative = velocity_of(second) - velocity_of(first) - active.wanted;
	Vec2 change;
	if (active.is_line) {
		const Vec2 n = active.direction;
		if (!(active.response > 0)) {
			return; // neither can move
		}
		change = n * (dot(relative, n) / active.response);
	} else {
		Real a = first.place.inverse_mass + second.place.inverse_mass;
		Real b = 0;
		Real c = a;
		for (const Side &side : active.sides) {
			if (side.rigid != NO_RIGID_BODY) {
				const RigidBody &rigid = world_->rigid_bodies()[side.rigid];
				a += rigid.inverse_mass + rigid.inverse_inertia * side.arm.y * side.arm.y;
				b -= rigid.inverse_inertia * side.arm.x * side.arm.y;
				c += rigid.inverse_mass + rigid.inverse_inertia * side.arm.x * side.arm.x;
			}
		}
		change = solve_2x2(a, b, c, relative);
	}
	if (!is_finite(change)) {
		return; // skipped as in `prepare`
	}
	apply(first, change);
	apply(second, -change);
	active.impulse += change;
	active.total += change;
}

// J = h (k C + c C'), with the stretch C and its speed C' = (way within the substep)/h after J, which shortens both by
// h w J: J (1 + h (h k + c) w) = h k C + c way. A dynamic rigid body gets its acceleration after its motion, so its end
// counts with the motion of the coming substep.
void JointSolver::stretch(Active &active, Real h) {
	const Joint &joint = world_->joints()[active.joint];
	auto &[first, second] = active.sides;
	const auto way_of = [&](const Side &side) {
		return side.body ? side.at - side.before : side.rigid != NO_RIGID_BODY ? velocity_of(side) * h : Vec2{};
	};
	const auto end_of = [&](const Side &side) {
		const bool is_ahead = side.rigid != NO_RIGID_BODY && world_->rigid_bodies()[side.rigid].is_dynamic();
		return is_ahead ? side.at + velocity_of(side) * h : side.at;
	};
	const Vec2 n = active.direction;
	const Real longer = dot(end_of(second) - end_of(first), n) - joint.rest_length;
	const Real way = dot(way_of(second) - way_of(first), n);
	const Real strength = h * (h * joint.stiffness + joint.damping);
	const Real pull = h * joint.stiffness * longer + joint.damping * way;
	const Real impulse = (pull - dot(active.impulse, n)) / (1 + strength * active.response);
	const Vec2 change = n * impulse;
	if (!is_finite(change)) {
		return;
	}
	move(first, change * h);
	move(second, change * -h);
	apply(first, change);
	apply(second, -change);
	keep_spin(active, impulse * h * (first.place.inverse_mass + second.place.inverse_mass));
	active.impulse += change;
	active.total += change;
}

void JointSolver::begin_substep(const SubstepGroup &group) {
	for (Active &active : active_) {
		for (Side &side : active.sides) {
			if (side.body && active.is_in(group)) {
				side.before = side.place.of(side.body->positions());
			}
		}
	}
}

void JointSolver::solve(Real elapsed, Real h, const SubstepGroup &group) {
	for (Active &active : active_) {
		if (active.is_in(group)) {
			prepare(active, elapsed, h);
		} else {
			active.is_idle = true;
		}
	}
	for (int pass = 0; pass < JOINT_PASSES; ++pass) {
		for (std::size_t i = 0; i < active_.size(); ++i) {
			Active &active = active_[pass % 2 == 0 ? i : active_.size() - 1 - i];
			if (!active.is_idle) {
				is_rigid(world_->joints()[active.joint]) ? push(active) : stretch(active, h);
			}
		}
	}
}

void JointSolver::end_step(std::vector<JointId> &broken) {
	for (const Active &active : active_) {
		if (length(active.total) > world_->joints()[active.joint].break_force * dt_) {
			broken.push_back(world_->joint_id_at(active.joint));
		}
	}
	for (const JointId id : broken) {
		world_->remove_joint(id);
	}
}

} // namespace softbody
