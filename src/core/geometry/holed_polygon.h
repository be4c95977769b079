// SPDX-License-Identifier: MIT
// Measures and checks of a polygon with holes.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"

#include <span>
#include <string>
#include <vector>

namespace softbody {

/// Outlines of holes, each a simple polygon of either winding [length].
using Holes = std::vector<std::vector<Vec2>>;

/// Area and its moments, for a mass that is spread evenly.
struct AreaMoments {
	double area = 0; ///< [length²], >= 0
	Vec2d centroid; ///< [length]
	double inertia = 0; ///< polar second moment of area about the centroid [length⁴]: times mass over area, the moment of inertia
};

/// Of the polygon less its holes, which may have either winding. Exact up to rounding. Precondition: the polygon passes `check_hull`, and
/// the holes pass `check_holes`. O(points).
AreaMoments area_moments(std::span<const Vec2> hull, const Holes &holes);

/// Length of the polygon's outline and of those of its holes [length].
double holed_perimeter(std::span<const Vec2> hull, const Holes &holes);

/// Whether p lies inside of the polygon and in none of its holes. Points on a border may fall on either side. O(points).
bool point_in_holed_polygon(Vec2 p, std::span<const Vec2> hull, const Holes &holes);

/// Refuses holes that a body cannot have, as `name[i]`: an outline that `check_hull` refuses, one that is not inside of the polygon or touches
/// it, two that touch or lie in each other, and more than MAX_HULL_POINTS points in all. O(points²), once at creation.
Status check_holes(const std::string &name, const Holes &holes, std::span<const Vec2> hull);

} // namespace softbody
