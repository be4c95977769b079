// SPDX-License-Identifier: MIT
// Carries values given at the corners of a polygon to any place inside it.
#pragma once

#include "core/base/vec2.h"

#include <span>
#include <vector>

namespace softbody {

/// Mean value coordinates: one weight a corner, of sum 1, by which the mean of the corners is `place`. Values that depend
/// on the place in a linear way are carried exactly. On the outline only the ends of the edge count. Outside the polygon
/// and inside a concave one weights may be negative. Precondition: the polygon is simple and has 3 points or more. O(n).
/// Source: Floater 2003; Hormann and Floater 2006 for any simple polygon.
std::vector<double> mean_value_weights(std::span<const Vec2> polygon, Vec2 place);

} // namespace softbody
