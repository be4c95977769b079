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

/// Poses of a collider at the start and at the end of a substep.
struct ColliderMotion {
	Pose from;
	Pose to;
	bool is_still = true; ///< if true, vertices are in the world's frame and the poses are not read

	/// Places of the world in the collider's frame, at the start and at the end, and one of the start in the world.
	Vec2 own_from(Vec2 p) const { return is_still ? p : from.apply_inverse(p); }
	Vec2 own_to(Vec2 p) const { return is_still ? p : to.apply_inverse(p); }
	Vec2 world_from(Vec2 own) const { return is_still ? own : from.apply(own); }
	/// A direction of the collider's frame in the world, at the end.
	Vec2 turned(Vec2 direction) const { return is_still ? direction : to.rotation.apply(direction); }
};

/// A hull and the motion of its points in a substep, up to their present positions.
struct HullMotion {
	std::span<const Vec2> from; ///< positions at the start; at least one for each hull point
	std::span<const Vec2> to;

	/// Box around both.
	Aabb box() const {
		Aabb box = bounding_box(to);
		for (const Vec2 p : from.first(to.size())) {
			box.include(p);
		}
		return box;
	}
};

/// Contact of a hull point with the collider. The path of the point is swept in the frame of the collider, so that a
/// passage is found whichever of the two moves. `bounds` is the collider's box in its own frame, grown by the slop.
/// O(vertices).
std::optional<SurfaceContact> find_contact_of_point(const HullMotion &hull, std::size_t point,
		const Collider &collider, const ColliderMotion &motion, const Aabb &bounds, Real slop);

/// Contact of a round edge of the hull (`SoftBodyShape::bulges`) with the collider, where the outline bulges deeper than
/// both ends: as `find_contact_of_point`, for the deepest place. The edge goes from the hull point `edge` to the next.
/// O(vertices).
std::optional<SurfaceContact> find_contact_of_edge(const HullMotion &hull, std::size_t edge, Real bulge_at_rest,
		const Collider &collider, const ColliderMotion &motion, const Aabb &bounds, Real slop);

/// Contact of a collider's corner or round end with the hull: the depth by which the hull must retreat, and the place.
/// A corner that entered during this substep leaves through the edge that it entered by; if its collider moves, this
/// also holds for a corner that has left the hull on the other side. `box` contains the hull, and its start positions
/// if the collider moves. `slop` [length] is the least radius of the free ends of a segment. O(hull points).
std::optional<SurfaceContact> find_contact_of_corner(const HullMotion &hull, const Aabb &box,
		const Collider &collider, std::size_t corner, const ColliderMotion &motion, Real slop = 0);

} // namespace softbody
