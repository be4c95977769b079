// SPDX-License-Identifier: MIT
// Finds the bodies that may meet a dynamic rigid body.
#pragma once

#include "core/base/parallel_for.h"
#include "core/collision/broad_phase.h"
#include "core/collision/collider_index.h"
#include "core/collision/rigid_contact_search.h"
#include "core/dynamics/active_bodies.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace softbody {

/// Bodies near dynamic rigid bodies, by active index. Bodies beside a sleeping rigid body may sleep; all bodies beside
/// it sleep and wake together. Bodies beside an awake rigid body stay awake, or a rigid body resting on them would sink
/// in.
class RigidNeighbors {
public:
	/// Finds the bodies for a step of `dt` [s], and wakes sleeping bodies beside an awake rigid body. The caller then
	/// updates the sleep states, and calls `report_sleepers`. O(bodies) if there are dynamic colliders.
	void find(const ActiveBodies &bodies, WorldData &world, const ColliderIndex &surroundings, Real dt,
			const ParallelFor &parallel_for);
	/// Marks the rigid bodies that have a sleeping body beside them (Reaction::beside_sleeper).
	void report_sleepers(const ActiveBodies &bodies, WorldData &world) const;

	/// The dynamic colliders around the way of a body that `has`, until the next `find`.
	RigidSurroundings surroundings_of(std::uint32_t active_index) const;

	/// Whether there are dynamic colliders.
	bool has_any() const { return !is_near_.empty(); }
	bool has(std::uint32_t active_index) const { return !is_near_.empty() && is_near_[active_index] != 0; }
	/// For each body, whether it is near an awake rigid body. Empty if there are no dynamic colliders.
	std::span<const char> restless() const { return restless_; }
	/// Adds pairs that link all bodies beside one rigid body.
	void add_linked(std::vector<BodyPair> &pairs) const;

private:
	// One entry for each active index; empty if there are no dynamic colliders.
	std::vector<char> is_near_;
	std::vector<char> restless_;
	std::vector<std::pair<std::uint32_t, std::uint32_t>> beside_; ///< rigid bodies and the active indices of bodies near them, sorted
	/// A body's part of the colliders of its task.
	struct List {
		Aabb way; ///< of the body in the step
		Aabb box;
		std::uint32_t task = 0;
		std::uint32_t begin = 0;
		std::uint32_t end = 0;
	};
	std::vector<List> lists_;
	struct Task {
		std::vector<std::uint32_t> colliders;
		std::vector<std::uint32_t> found; ///< around one body
	};
	std::array<Task, MOST_SLICES> tasks_;
};

} // namespace softbody
