// SPDX-License-Identifier: MIT
// How much two polygons, convex or not, overlap: for judging a simulation, not for stepping it.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// Area that two simple polygons share [length²], >= 0, whatever their windings. Exact to rounding in
/// double for concave polygons too, of which the overlap may be several pieces: the thesis (4.4,
/// "collision shape") orders all found points into one. Where a polygon crosses itself its parts count
/// with the number of times they are wound around, so the result means little. O(n m).
double overlap_area(std::span<const Vec2> a, std::span<const Vec2> b);

/// How deep two simple polygons are in each other [length]: the largest distance from the border of
/// one at which a corner of the other lies inside it; 0 when no corner of either is inside the other.
/// Bars that cross without a corner inside are 0 deep by this measure, while their `overlap_area` is
/// not 0. O(n m).
double penetration_depth(std::span<const Vec2> a, std::span<const Vec2> b);

} // namespace softbody
