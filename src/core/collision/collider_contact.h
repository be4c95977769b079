// SPDX-License-Identifier: MIT
// Contacts between a hull and one collider that may be moving: hull points in the collider, its corners in the hull.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/surface_constraint.h"
#include "core/geometry/polygon.h"
#include "core/model/pose.h"
#include "core/model/surroundings.h"

#include <optional>
#include <span>

namespace softbody {

/// Where a collider is at the start and at the end of a substep.
struct ColliderMotion {
	Pose from;
	Pose to;
	bool is_still = true; ///< then its vertices are in the world's frame and the poses are not looked at
};

/// A hull and the way its points took in a substep, which ends where they are.
struct HullMotion {
	std::span<const Vec2> from; ///< at least one a hull point
	std::span<const Vec2> to;
};

/// A hull point against the collider, in whose frame the way of the point is swept: what passes through it is found,
/// whichever of the two moves. `bounds` is the collider's box in its own frame, grown by the slop. O(vertices).
std::optional<SurfaceContact> find_contact_of_point(const HullMotion &hull, std::size_t point,
		const Collider &collider, const ColliderMotion &motion, const Aabb &bounds, Real slop);

/// A collider's corner or round end against the hull: how far the hull must retreat from it, and where. A corner that
/// came in during this substep goes back through the edge it came by, and if its collider moves even when it is out
/// again. `box` contains the hull, and where it came from if the collider moves. `slop` [length] is the least radius of the free ends of a segment. O(hull points).
std::optional<SurfaceContact> find_contact_of_corner(const HullMotion &hull, const Aabb &box,
		const Collider &collider, std::size_t corner, const ColliderMotion &motion, Real slop = 0);

} // namespace softbody
