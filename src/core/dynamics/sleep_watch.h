// SPDX-License-Identifier: MIT
// Lets islands of bodies at rest fall asleep, and wakes them when what is around them changes.
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

/// Bodies that touch form an island. When all its bodies have hardly moved (SLEEP_SPEED, SLEEP_SPEED_WEIGHTLESS) for
/// SLEEP_TIME, they fall asleep together, and they wake together. A frozen body counts as one that sleeps and never wakes; it
/// joins no island. A change near a sleeping body (a collider or rigid body that comes, goes or moves, a rigid body at the
/// other end of a joint that is put elsewhere, a frozen body that is moved or let go) wakes its island.
class SleepWatch {
public:
	/// All must outlive the object.
	SleepWatch(WorldData &world, ActiveBodies &bodies, const ColliderIndex &surroundings, const JointSolver &joints) :
			world_(world), bodies_(bodies), surroundings_(surroundings), joints_(joints) {}

	/// Begins a step, after bodies and joints have: takes over which bodies were woken or put to sleep from outside.
	/// `is_rearranged`: the list of active bodies is new.
	void begin_step(bool is_rearranged);
	/// Wakes the bodies around which something has changed. O(1) where nothing has, else O(bodies).
	void wake_by_environment();
	/// Takes over which bodies have been woken since (SoftBodyData::wake), with their islands. O(1) where none was, else
	/// O(bodies log woken).
	void take_over() { take_over(false); }
	/// After a step: a sleeping body that an awake one has touched is woken for the next step, and islands at rest fall
	/// asleep. `pairs` with `touched` are the contacts of the step; `joined` are pairs held together by joints or lying beside
	/// one rigid body. Bodies whose `restless` is set (none, if it is empty) stay awake. O(bodies + pairs).
	void let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
			std::span<const char> restless);

private:
	void take_over(bool is_rearranged);
	void wake_by_changes();
	void wake_by_rigid_ends();
	void wake_by_frozen_bodies();
	void join(BodyPair pair);
	Aabb rest_box(std::uint32_t active_index) const;
	/// A hash of what the body rests amid and hangs from (RestState::surroundings).
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
	std::vector<std::uint64_t> names_; ///< of the islands that fall asleep, else 0
	std::uint64_t seen_restores_ = 0;
};

} // namespace softbody
