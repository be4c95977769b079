// SPDX-License-Identifier: MIT
// Which bodies may meet a rigid body that they push back.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/broad_phase.h"
#include "core/collision/collider_index.h"
#include "core/dynamics/active_bodies.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Beside a dynamic rigid body that sleeps bodies may sleep as well, and what is beside the same one sleeps and wakes
/// together; beside one that is awake nobody sleeps, or what rests on it would sink in. Bodies go by their active index.
class RigidNeighbors {
public:
	/// Finds them for a step of `dt` [s], and wakes sleeping bodies beside a rigid body that is awake. The caller then takes
	/// over which bodies have woken, and calls `report_sleepers`. O(bodies) where there are dynamic colliders.
	void find(const ActiveBodies &bodies, WorldData &world, const ColliderIndex &surroundings, Real dt,
			const ParallelFor &parallel_for);
	/// Marks the rigid bodies beside which a body sleeps (Reaction::beside_sleeper).
	void report_sleepers(const ActiveBodies &bodies, WorldData &world) const;

	/// Whether there is anything to meet.
	bool has_any() const { return !is_near_.empty(); }
	bool has(std::uint32_t active_index) const { return !is_near_.empty() && is_near_[active_index] != 0; }
	/// Bodies near a rigid body that is awake; empty when there is nothing to meet.
	std::span<const char> restless() const { return restless_; }
	/// Adds bodies that lie beside one rigid body, as pairs that link all of them.
	void add_linked(std::vector<BodyPair> &pairs) const;

private:
	// One a active index; empty when there is nothing to meet.
	std::vector<char> is_near_;
	std::vector<char> restless_;
	std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_; ///< rigid bodies and the active indices near them, in order
	std::vector<std::uint32_t> colliders_;
};

} // namespace softbody
