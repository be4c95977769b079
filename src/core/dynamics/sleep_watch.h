// SPDX-License-Identifier: MIT
// Lets islands of bodies at rest fall asleep, and wakes them when their environment changes.
#pragma once

#include "core/collision/broad_phase.h"
#include "core/collision/collider_watch.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/islands.h"
#include "core/dynamics/joint_solver.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Bodies that touch form an island. When all bodies of an island have hardly moved (SLEEP_SPEED,
/// SLEEP_SPEED_WEIGHTLESS) for SLEEP_TIME, they fall asleep together; they also wake together. A frozen body counts as
/// sleeping, never wakes and belongs to no island. A change near a sleeping body wakes its island: a collider or rigid
/// body that is added, removed or moved, a rigid body moved at the other end of a joint, or a frozen body that is moved
/// or released.
class SleepWatch {
public:
	/// All arguments must outlive the object.
	SleepWatch(WorldData &world, ActiveBodies &bodies, const ColliderIndex &surroundings, const JointSolver &joints) :
			world_(world), bodies_(bodies), surroundings_(surroundings), joints_(joints) {}

	/// Begins a step, after bodies and joints have begun it. Takes over which bodies were woken or put to sleep from
	/// outside. `is_rearranged`: the list of active bodies was rebuilt.
	void begin_step(bool is_rearranged);
	/// Wakes the bodies whose environment has changed. O(1) without changes, else O(bodies).
	void wake_by_environment();
	/// Takes over which bodies have been woken since (SoftBodyData::wake), with their islands. O(1) if none was woken,
	/// else O(bodies log woken).
	void take_over() { take_over(false); }
	/// Updates sleep after a step of `dt` [s]. A sleeping body touched by an awake one wakes for the next step, and islands at rest
	/// fall asleep. `pairs` with `touched` are the contacts of the step. `joined` are pairs held together by joints or
	/// lying beside one rigid body. Bodies whose `restless` is set stay awake; `restless` may be empty. An island that
	/// something accelerates (FREE_PULL) is not at rest, however slowly it begins to move. O(bodies + pairs).
	void let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
			std::span<const char> restless);

private:
	void take_over(bool is_rearranged);
	void wake_by_changes();
	void wake_by_rigid_ends();
	void wake_by_frozen_bodies();
	void join(BodyPair pair);
	Vec2 pull_on(std::uint32_t active_index) const;
	void release_pulled();
	bool is_pulled(std::uint32_t island) const;
	Aabb rest_box(std::uint32_t active_index) const;
	/// Hash of a body's environment and of the rigid ends of its joints (RestState::surroundings).
	std::uint64_t describe(std::uint32_t active_index) {
		return watch_.describe(surroundings_, rest_box(active_index)) + joints_.rigid_ends_of(active_index);
	}

	WorldData &world_;
	ActiveBodies &bodies_;
	const ColliderIndex &surroundings_;
	const JointSolver &joints_;
	ColliderWatch watch_;
	Islands islands_;
	std::vector<Real> least_rest_; ///< of each island [s]
	std::vector<Vec2> pulls_; ///< on each island, times its mass
	std::vector<Real> masses_; ///< of each island
	std::vector<std::uint32_t> bodies_in_; ///< each island
	std::vector<std::uint64_t> names_; ///< of the islands that fall asleep, otherwise 0
	std::uint64_t seen_restores_ = 0;
};

} // namespace softbody
