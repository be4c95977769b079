// SPDX-License-Identifier: MIT
// A polygon with holes as one outline.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Joins the outlines of a polygon and its holes to one, of positive winding: it runs to each hole along a line, around it, and back. Lines meet
/// nothing but the two points that they join. `loops` are the numbers of points of the polygon and of the holes, one after the other
/// in `points`, each of either winding. Preconditions: `check_hull` and `check_holes` accept them. Usually O(holes · points²).
std::vector<std::uint32_t> bridge_loops(std::span<const Vec2> points, std::span<const std::size_t> loops);

} // namespace softbody
