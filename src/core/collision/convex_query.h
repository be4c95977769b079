// SPDX-License-Identifier: MIT
// Distance of a point from a rounded collider, and the contact of a point that entered or passed one.
#pragma once

#include "core/base/vec2.h"
#include "core/model/surroundings.h"

#include <optional>

namespace softbody {

/// Nearest place on a collider's surface.
struct SurfaceDistance {
	Real distance = 0; ///< [length], negative inside
	Vec2 normal; ///< outward unit normal there, the gradient of the distance
};

/// Distance of p from the surface. Exact everywhere for rounded and concave shapes, and inside polygons. Outside a
/// convex polygon without rounding it is the largest distance to a face line: a lower bound with the right sign.
/// `least_radius` thickens shapes of fewer than three vertices, which have no inside. O(vertices).
SurfaceDistance surface_distance(const Collider &collider, Vec2 p, Real least_radius = 0);

/// Signed distance of p from the line through a segment, positive on the side of its first face normal, the direction
/// from the first to the second vertex turned from y towards x. Precondition: two vertices.
Real distance_to_line(const Collider &segment, Vec2 p);

/// A point that entered or passed a collider.
struct PointContact {
	Vec2 normal; ///< unit, from the collider towards the start of the point
	Real depth = 0; ///< way out along `normal` [length], > 0
};

/// Contact of a point that moved from `from` to `to` in one substep, if it must be pushed out of the collider. The
/// chosen face is the one of least depth among those that the point came from the front of. So a point that sank half
/// through a thin plate goes back, and a point that slides over the seam of two tiles is not stopped by the hidden side
/// of the second. From a concave polygon the point leaves by the edge that it entered by, or by the nearest if it
/// started inside. Points that passed right through are found too (swept test). `slop` [length] > 0 is the half
/// thickness of bare segments and the tolerance of "in front". O(vertices).
std::optional<PointContact> find_point_contact(const Collider &collider, Vec2 from, Vec2 to, Real slop);

} // namespace softbody
