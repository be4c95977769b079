// SPDX-License-Identifier: MIT
// Holds joints together.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/substep_group.h"
#include "core/collision/surface_constraint.h"
#include "core/model/world_data.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Solves the joints of a world once a contact substep, after the bodies have moved. Rigid joints twice: the anchors are
/// moved to where they belong, which changes no velocity, and the velocity at which they would part is taken from them by
/// impulses, equal and opposite in one place, so that momentum and angular momentum stay. Springs are compliant
/// constraints, stable at any stiffness (Macklin, Müller, Chentanez 2016, eq. 18 and 26).
///
/// The velocities of rigid joints are not derived from the corrections of positions, as XPBD would: a rigid body is not
/// ours to move, and so would be left with the speed that it gains in a substep, and the engine would let it creep. That is
/// right for soft bodies too, as a joint that was made with a gap closes without a jump.
///
/// Joints are gone through one after the other, there and back, as several may hold on to one point or rigid body.
/// Bodies go by their active index (`ActiveBodies`).
class JointSolver {
public:
	/// Finds what each joint joins in the coming step of `dt` [s]. `is_rearranged`: the list of bodies is another. O(1)
	/// without joints, else O(joints), and O(bodies) where joints or bodies have changed.
	void begin_step(WorldData &world, std::span<const std::uint32_t> body_indices, bool is_rearranged, Real dt);
	bool has_joints() const { return !active_.empty(); }
	/// The bodies that a joint holds to a rigid body, or would if that were there, in order.
	std::span<const std::uint32_t> held_to_rigid() const { return held_to_rigid_; }
	/// A number that stands for where the rigid ends of a body's joints are; 0: it has none.
	std::uint64_t rigid_ends_of(std::uint32_t active_index) const { return rigid_ends_.empty() ? 0 : rigid_ends_[active_index]; }
	/// Wakes whoever is joined to a body that is awake, or to a rigid one that moves or may. True when somebody woke.
	bool wake_joined();
	/// Whether the body is held by a joint in this step.
	bool holds(std::uint32_t active_index) const { return !is_held_.empty() && is_held_[active_index] != 0; }
	/// Whether any joint holds a dynamic rigid body.
	bool has_dynamic_ends() const { return std::ranges::any_of(is_held_, [](char held) { return held > 1; }); }
	/// Whether a joint holds it to a dynamic rigid body.
	bool holds_to_dynamic(std::uint32_t active_index) const { return !is_held_.empty() && is_held_[active_index] > 1; }
	/// The pairs that are not to collide, because they are joined, in order.
	std::span<const BodyPair> separated() const { return separated_; }
	/// The bodies that are joined to each other.
	std::span<const BodyPair> joined() const { return joined_; }

	/// Keeps where the anchors are as a substep begins, of all joints of the bodies whose turn it is.
	void begin_substep(const SubstepGroup &group);
	/// Answers their joints at the end of a substep of `h` [s], `elapsed` [s] after the step began.
	void solve(Real elapsed, Real h, const SubstepGroup &group);
	/// Removes the joints that bore more than they can in the step, and adds them to `broken`.
	void end_step(std::vector<JointId> &broken);

private:
	/// An end of a joint; of a soft body, of a rigid one, or neither.
	struct Side {
		SoftBodyData *body = nullptr;
		std::uint32_t active_index = UINT32_MAX;
		HullPlace place;
		std::uint32_t rigid = NO_RIGID_BODY;
		Vec2 position; ///< as in `JointAnchor`
		Real inverse_mass_a = 0; ///< share times inverse mass of the ends of the place
		Real inverse_mass_b = 0;
		Real inverse_mass = 0; ///< of the place
		Vec2 before; ///< where it was when the substep began
		Vec2 at; ///< where it is now
		Vec2 arm; ///< from the rigid body's center of mass
	};
	struct Active {
		std::uint32_t joint = 0; ///< index in the world's list
		std::array<Side, 2> sides;
		Vec2 direction; ///< unit, from the first to the second, where the joint acts along a line
		bool is_idle = false; ///< in this substep
		bool is_in(const SubstepGroup &group) const {
			return std::ranges::any_of(sides, [&](const Side &side) { return side.body && group.has(side.active_index); });
		}
		bool is_line = false;
		Real response = 0; ///< change of the speed along the line per impulse
		Vec2 wanted; ///< relative velocity [length/s]
		Vec2 impulse; ///< of the substep, on the first side
		Vec2 total; ///< of the step
	};

	Side side_of(const JointAnchor &anchor) const;
	void update_place(Side &side, Real elapsed) const;
	Vec2 velocity_of(const Side &side) const;
	void move(Side &side, Vec2 way) const;
	void apply(Side &side, Vec2 impulse) const;
	void prepare(Active &active, Real elapsed, Real h);
	void close_gap(Active &active, Vec2 gap, Vec2 relative_velocity, Real h);
	void push(Active &active);
	void stretch(Active &active, Real h);
	void keep_spin(Active &active, Real closed);
	bool is_still(const Side &side) const;
	void note_rigid_ends(const Joint &joint, const std::array<Side, 2> &sides);

	WorldData *world_ = nullptr;
	std::uint64_t seen_joints_ = 0;
	Real dt_ = 0;
	std::vector<std::uint32_t> active_indices_; ///< of every body in the world
	std::vector<Active> active_;
	std::vector<char> is_held_; ///< a active index; 2: to a dynamic rigid body
	std::vector<std::uint64_t> rigid_ends_; ///< a active index
	std::vector<std::uint32_t> held_to_rigid_;
	std::vector<BodyPair> joined_;
	std::vector<BodyPair> separated_; ///< in order
	std::vector<std::pair<std::uint64_t, std::uint32_t>> tags_; ///< of rigid bodies, in order
};

} // namespace softbody
