// SPDX-License-Identifier: MIT
// Where a point meets a rounded convex collider: by distance, or on its way through.
#pragma once

#include "core/base/vec2.h"
#include "core/model/surroundings.h"

#include <optional>

namespace softbody {

/// Nearest place on a collider's surface.
struct SurfaceDistance {
	Real distance = 0; ///< [length], negative inside
	Vec2 normal; ///< outward unit normal there; distance changes fastest along it
};

/// Distance of p from the surface. Exact everywhere for rounded and concave shapes and inside polygons; outside a
/// convex polygon without rounding it is the largest distance to a face line, a lower bound that has the right
/// sign. `least_radius` thickens shapes of fewer than three vertices, which have no inside. O(vertices).
SurfaceDistance surface_distance(const Collider &collider, Vec2 p, Real least_radius = 0);

/// A point that went into or through a collider.
struct PointContact {
	Vec2 normal; ///< unit, from the collider towards where the point came from
	Real depth = 0; ///< how far to move along `normal` to be out [length], > 0
};

/// Whether a point that moved from `from` to `to` in one substep must be pushed out of the collider,
/// and along which normal. The face chosen is the one of least depth among those the point came
/// from the front of: a point that sank half through a thin plate goes back the way it came, and one
/// that slides over the seam of two tiles is not stopped by the hidden side of the second. From a concave polygon it
/// leaves by the edge it came in by, or by the nearest if it started inside. Points
/// that passed right through are caught too (swept test). `slop` [length] > 0 is the half thickness
/// of bare segments and the tolerance of "in front". O(vertices).
std::optional<PointContact> find_point_contact(const Collider &collider, Vec2 from, Vec2 to, Real slop);

} // namespace softbody
