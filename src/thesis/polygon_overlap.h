// SPDX-License-Identifier: MIT
// Overlap of two polygons, convex or not: for judging a simulation, not for stepping it.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// Area that two simple polygons share [length²], >= 0, for any winding. Exact to rounding in double, also for concave
/// polygons, where the overlap may have several pieces; the thesis (4.4, "collision shape") orders all found points
/// into one piece. Parts of a self-intersecting polygon count as often as the polygon winds around them, so the result
/// means little. O(n m).
double overlap_area(std::span<const Vec2> a, std::span<const Vec2> b);

/// Penetration depth of two simple polygons [length]: the largest distance from the border of one polygon at which a
/// corner of the other lies inside it. 0 when no corner of either polygon is inside the other: bars that cross without
/// a corner inside have depth 0, although their `overlap_area` is not 0. O(n m).
double penetration_depth(std::span<const Vec2> a, std::span<const Vec2> b);

} // namespace softbody
