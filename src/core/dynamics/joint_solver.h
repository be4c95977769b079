// SPDX-License-Identifier: MIT
// Solves joints.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/point_edge_constraint.h"
#include "core/collision/substep_group.h"
#include "core/dynamics/chain_stepper.h"
#include "core/dynamics/islands.h"
#include "core/model/world_data.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Solves the joints of a world once a contact substep, after the bodies have moved. A rigid joint is solved twice. Its
/// anchors are moved to where they belong, which changes no velocity. Then impulses remove the velocity at which they
/// would part. Impulses are equal and opposite in one place, so that momentum and angular momentum stay. Springs are
/// compliant constraints, stable at any stiffness (Macklin, Müller, Chentanez 2016, eq. 18 and 26).
///
/// Joints are solved one after the other, forward and backward, as several may hold one point or rigid body. Bodies are
/// indexed by active index (`ActiveBodies`).
class JointSolver {
public:
	/// Finds the ends of each joint for the coming step of `dt` [s]. `is_rearranged`: the list of bodies was rebuilt.
	/// O(1) without joints, else O(joints), and O(bodies) if joints or bodies have changed.
	void begin_step(WorldData &world, std::span<const std::uint32_t> body_indices, bool is_rearranged, Real dt);
	bool has_joints() const { return !active_.empty(); }
	/// Bodies joined to a rigid body, present or missing, in order.
	std::span<const std::uint32_t> held_to_rigid() const { return held_to_rigid_; }
	/// Hash of the positions of the rigid ends of a body's joints; 0 if it has none.
	std::uint64_t rigid_ends_of(std::uint32_t active_index) const { return rigid_ends_.empty() ? 0 : rigid_ends_[active_index]; }
	/// Wakes sleeping bodies that are joined to an awake body, or to a rigid body that moves or may move. Returns
	/// whether any body woke.
	bool wake_joined();
	/// Whether a joint holds the body in this step.
	bool holds(std::uint32_t active_index) const { return !is_held_.empty() && is_held_[active_index] != 0; }
	/// Whether any joint holds a dynamic rigid body.
	bool has_dynamic_ends() const { return std::ranges::any_of(is_held_, [](char held) { return held > 1; }); }
	/// Whether a joint holds the body to a dynamic rigid body.
	bool holds_to_dynamic(std::uint32_t active_index) const { return !is_held_.empty() && is_held_[active_index] > 1; }
	/// Pairs that must not collide in this step, sorted: joined ones, and crushed bodies with all others of their
	/// structure (bodies tied to one another, directly or through others).
	std::span<const BodyPair> separated() const { return separated_now_; }
	/// Pairs of bodies that are joined to each other.
	std::span<const BodyPair> joined() const { return joined_; }

	/// Stores the positions of the anchors at the start of a substep, for all joints of the group's bodies.
	void begin_substep(const SubstepGroup &group);
	/// Solves the velocities of the group's chains that rigid joints without a length hold, with what hangs on them, for the substep
	/// of `h` [s] that begins `elapsed` [s] after the step began. One chain comes after the other, as several may carry one body. Contacts of
	/// monitored chains go to `log`. Returns the number of contacts. For a chain, any of its points stands for its whole section.
	std::size_t solve_chains(const ColliderIndex &surroundings, Real elapsed, Real h, const SubstepGroup &group, ContactLog &log);
	/// What `solve_chains` has found to be fastened to a body; none of one that it leaves out.
	std::span<ChainLoad> loads_of(std::uint32_t active_index);
	/// Solves the group's joints at the end of a substep of `h` [s], `elapsed` [s] after the step began.
	void solve(Real elapsed, Real h, const SubstepGroup &group);
	/// Removes the joints that bore more than Joint::break_force in the step, and adds them to `broken`.
	void end_step(std::vector<JointId> &broken);

private:
	/// An end of a joint: on a soft body, on a rigid body, or on the world.
	struct Side {
		SoftBodyData *body = nullptr;
		std::uint32_t active_index = UINT32_MAX;
		PointOnEdge place; ///< on the soft body; has inverse mass 0 if this end is not soft
		std::uint32_t rigid = NO_RIGID_BODY;
		Vec2 position; ///< as in `JointAnchor`
		Vec2 before; ///< position at the start of the substep
		Vec2 at; ///< present position
		Vec2 arm; ///< from the rigid body's center of mass
		std::uint32_t section = ChainShape::NO_SECTION; ///< of a chain, which moves as a whole
	};
	/// An end of a joint on a chain.
	struct ChainEnd {
		std::uint32_t active_index;
		std::uint32_t joint; ///< in `active_`
		std::uint32_t end; ///< 0 or 1
	};
	struct Active {
		std::uint32_t joint = 0; ///< index in the world's list
		std::array<Side, 2> sides;
		Vec2 direction; ///< unit, from the first to the second end, if the joint acts along a line
		bool is_idle = false; ///< not solved in this substep
		bool is_in(const SubstepGroup &group) const {
			return std::ranges::any_of(sides, [&](const Side &side) { return side.body && group.has(side.active_index); });
		}
		bool is_line = false;
		Real response = 0; ///< change of the speed along the line per impulse
		Vec2 wanted; ///< target relative velocity [length/s]
		Vec2 impulse; ///< of the substep, on the first side
		Vec2 total; ///< of the step
	};

	Side side_of(const JointAnchor &anchor) const;
	void take_section(Side &side, const JointAnchor &anchor) const;
	static void push_section(const Side &side, std::span<Vec2> values, Vec2 impulse);
	void find_chains();
	ChainLoad load_at(Side &own, Side &other, Real elapsed, Real h) const;
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
	void find_structures();
	void separate_crushed();

	WorldData *world_ = nullptr;
	std::span<const std::uint32_t> body_indices_; ///< of the active bodies, during the step
	std::uint64_t seen_joints_ = 0;
	Real dt_ = 0;
	std::vector<std::uint32_t> active_indices_; ///< of every body in the world
	std::vector<Active> active_;
	std::vector<ChainEnd> chain_ends_; ///< sorted by body
	std::vector<ChainLoad> chain_loads_; ///< one for each of those
	ChainStepper chain_stepper_;
	std::vector<char> is_held_; ///< one for each active index; 2: held to a dynamic rigid body
	std::vector<std::uint64_t> rigid_ends_; ///< one for each active index
	std::vector<std::uint32_t> held_to_rigid_;
	std::vector<BodyPair> joined_;
	std::vector<BodyPair> separated_; ///< joined pairs that do not collide, sorted
	std::vector<BodyPair> separated_now_; ///< the same and those of crushed bodies, sorted
	Islands structures_; ///< bodies tied to one another, by active index
	std::vector<std::pair<std::uint32_t, std::uint32_t>> members_; ///< structure and active index of each joined body, sorted
	std::vector<std::pair<std::uint64_t, std::uint32_t>> tags_; ///< of rigid bodies, sorted
};

} // namespace softbody
