// SPDX-License-Identifier: MIT
// Measures and checks of triangles and closed polygons: area, centroid, containment, convex hull, simplicity.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/geometry/aabb.h"

#include <span>

namespace softbody {

/// Twice the signed area of the triangle abc: positive when a, b, c turn from x towards y
/// (counter-clockwise with y up, clockwise on Godot's screen). Evaluated in double, so that the
/// sign is right for float input unless the triangle is thinner than about 1e-15 of its size.
/// Source: thesis Alg. 4.6, which calls this the area.
constexpr double signed_double_area(Vec2 a, Vec2 b, Vec2 c) {
	return cross(difference(a, c), difference(b, c));
}

/// Whether p lies in the triangle abc, border included, for either winding. A degenerate triangle
/// (zero area) contains nothing. Source: thesis Alg. 4.5, with the upper bound on u that it lacks.
bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c);

/// Signed area of the closed polygon [length²]: positive when it winds from x towards y. O(n).
/// Source: thesis Alg. 4.8 (shoelace), with its winding stated.
Real signed_area(std::span<const Vec2> polygon);

/// Length of the closed outline [length]. O(n).
Real perimeter(std::span<const Vec2> polygon);

/// Center of area [length]; the mean of the points when the area is zero. O(n).
Vec2 area_centroid(std::span<const Vec2> polygon);

/// Place of a closed outline.
struct OutlinePlace {
	std::size_t edge = 0; ///< from the corner of this index to the next
	Real t = 0; ///< of the way along the edge [1], 0..1
	Vec2 position; ///< [length]
	Real distance_squared = 0; ///< from the point asked about [length²]
};
/// The place of a closed outline that is nearest to p; of several the first. Precondition: not empty. O(n).
OutlinePlace nearest_place(std::span<const Vec2> outline, Vec2 p);

/// Whether p lies inside the closed polygon (even-odd rule). Points on the border may fall on either side. O(n).
bool point_in_polygon(Vec2 p, std::span<const Vec2> polygon);

/// The corners of the convex hull, of positive winding, starting at the least x (of those, the least y), as a part of
/// `workspace`. It holds at least twice as many points as `points`, and does not overlap them. No three corners are in
/// line, as far as double can resolve. No points give no corners, coincident points one, points in line their two ends.
/// Precondition: finite points. O(n log n), no allocation. Source: Andrew 1979 (monotone chain).
std::span<const Vec2> convex_hull(std::span<const Vec2> points, std::span<Vec2> workspace);

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
