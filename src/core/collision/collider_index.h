// SPDX-License-Identifier: MIT
// Which colliders are near a place during a step.
#pragma once

#include "core/collision/box_grid.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// The colliders of a world by where they are, for all bodies to ask. Colliders of dynamic bodies are apart: they are
/// solved between substeps, when all soft bodies are at the same time (`RigidContacts`).
class ColliderIndex {
public:
	/// Reads the surroundings for the coming `dt` [s]. `world` must outlive this object. O(colliders that
	/// move), and O(colliders) after others came or went.
	void update(const WorldData &world, Real dt);
	const WorldData &world() const { return *world_; }
	/// In which a collider stays during the step.
	const Aabb &bounds(std::uint32_t collider) const { return bounds_[collider]; }

	bool has_colliders() const { return !still_.empty() || !kinematic_.empty(); }
	/// Whether any collider overlaps the box; those of dynamic bodies aside. O(colliders near it).
	bool has_collider_in(const Aabb &box) const { return still_.overlaps_any(box) || kinematic_.overlaps_any(box); }
	/// Those colliders, in the order of the world's list. O(n log n) in their number.
	void collect(const Aabb &box, std::vector<std::uint32_t> &colliders) const;

	bool has_dynamic_colliders() const { return !dynamic_.empty(); }
	bool has_dynamic_collider_in(const Aabb &box) const { return dynamic_.overlaps_any(box); }
	void collect_dynamic(const Aabb &box, std::vector<std::uint32_t> &colliders) const;

private:
	void update_still();
	void update_moving(Real dt);

	const WorldData *world_ = nullptr;
	std::uint64_t version_ = 0;
	std::vector<Aabb> bounds_; ///< of every collider
	BoxGrid still_;
	BoxGrid kinematic_;
	BoxGrid dynamic_;
	std::vector<std::uint32_t> moving_; ///< colliders of rigid bodies
	// Scratch.
	std::vector<Aabb> boxes_;
	std::vector<std::uint32_t> names_;
};

} // namespace softbody
