// SPDX-License-Identifier: MIT
// Measures and checks of closed polygons: area, centroid, containment, simplicity.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/geometry/aabb.h"

#include <span>

namespace softbody {

/// Signed area of the closed polygon [length²]: positive when it winds from x towards y. O(n).
/// Source: thesis Alg. 4.8 (shoelace), with its winding stated.
Real signed_area(std::span<const Vec2> polygon);

/// Length of the closed outline [length]. O(n).
Real perimeter(std::span<const Vec2> polygon);

/// Center of area [length]; the mean of the points when the area is zero. O(n).
Vec2 area_centroid(std::span<const Vec2> polygon);

/// Whether p lies inside the closed polygon (even-odd rule). Points on the border may fall on either side. O(n).
bool point_in_polygon(Vec2 p, std::span<const Vec2> polygon);

/// Whether every border point is seen from `center` without crossing the border: the condition for centre springs,
/// where thesis Alg. 4.11 asks for convexity. O(n).
bool is_star_shaped_about(Vec2 center, std::span<const Vec2> polygon);

/// Whether the closed polygon meets itself: edges that cross or touch, an edge that folds back onto its
/// neighbor, neighboring points that coincide. O(n²).
bool is_self_intersecting(std::span<const Vec2> polygon);

/// Whether a hull of positive winding has been folded: it meets itself, or its signed area is no
/// longer positive (turned over, or squeezed flat). O(n²).
bool is_folded(std::span<const Vec2> hull);

/// Refuses a polygon that cannot be a hull: fewer than 3 or more than 4096 points, a coordinate that is not finite,
/// coincident neighbors, edges that touch or cross, zero area. Either winding is accepted. O(n²) once at creation.
Status check_hull(std::span<const Vec2> hull);

} // namespace softbody
