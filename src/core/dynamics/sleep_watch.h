// SPDX-License-Identifier: MIT
// Lets bodies fall asleep, and wakes them when what is around them changes.
#pragma once

#include "core/collision/collider_watch.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/joint_solver.h"
#include "core/dynamics/sleepers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Keeps `Sleepers` in step with the world: what came, went, changed or moves near a body that sleeps wakes it with its
/// island, and so does a rigid body to which it is joined and that is put elsewhere, and a frozen body that is moved or
/// let go. Whatever falls asleep or wakes is told to `ActiveBodies`.
class SleepWatch {
public:
	/// All must outlive the object.
	SleepWatch(WorldData &world, ActiveBodies &bodies, const ColliderIndex &surroundings, const JointSolver &joints) :
			world_(world), bodies_(bodies), surroundings_(surroundings), joints_(joints) {}

	const Sleepers &sleepers() const { return sleepers_; }

	/// Begins a step, once the others have: takes over who was woken or put to sleep from outside. `is_rearranged`: active indices
	/// are others than before.
	void begin_step(bool is_rearranged);
	/// Wakes those around whom something has changed. O(1) where nothing has, else O(bodies).
	void wake_by_environment();
	/// Takes over who has been woken meanwhile (SoftBodyData::wake), with their islands.
	void take_over() { take_over(false); }
	/// After a step; see `Sleepers::let_sleep`.
	void let_sleep(std::span<const BodyPair> pairs, std::span<const char> touched, std::span<const BodyPair> joined,
			std::span<const char> restless);

private:
	void take_over(bool is_rearranged);
	void wake_by_what_changed();
	void wake_by_rigid_ends();
	void wake_by_frozen_bodies();
	Aabb rest_box(std::uint32_t active_index) const;
	/// What the body rests amid and hangs from, as a number (RestState::surroundings).
	std::uint64_t describe(std::uint32_t active_index) {
		return watch_.describe(surroundings_, rest_box(active_index)) + joints_.rigid_ends_of(active_index);
	}

	WorldData &world_;
	ActiveBodies &bodies_;
	const ColliderIndex &surroundings_;
	const JointSolver &joints_;
	ColliderWatch watch_;
	Sleepers sleepers_;
	std::uint64_t seen_restores_ = 0;
};

} // namespace softbody
