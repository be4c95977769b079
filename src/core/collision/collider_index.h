// SPDX-License-Identifier: MIT
// Finds the colliders near a place during a step.
#pragma once

#include "core/collision/box_grid.h"
#include "core/model/world_data.h"

#include <cstdint>
#include <vector>

namespace softbody {

/// Spatial index of the colliders of a world, shared by all bodies. Colliders of dynamic bodies are kept apart: their
/// contacts are solved between substeps, when all soft bodies have reached one time (`RigidContacts`).
class ColliderIndex {
public:
	/// Reads the environment for the coming `dt` [s]. `world` must outlive this object. O(moving colliders), and
	/// O(colliders) after colliders were added or removed.
	void update(const WorldData &world, Real dt);
	const WorldData &world() const { return *world_; }
	/// Box that contains the collider during the step.
	const Aabb &bounds(std::uint32_t collider) const { return bounds_[collider]; }

	/// Whether any collider has restitution.
	bool bounces() const { return bounces_; }
	bool has_colliders() const { return !still_.empty() || !kinematic_.empty(); }
	/// Writes the static and kinematic colliders that overlap the box, in the order of the world's list. O(n log n) in
	/// their number.
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
	bool bounces_ = false;
	std::vector<std::uint32_t> moving_; ///< colliders of rigid bodies
	// Scratch memory.
	std::vector<Aabb> boxes_;
	std::vector<std::uint32_t> names_;
};

} // namespace softbody
