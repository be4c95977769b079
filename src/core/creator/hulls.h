// SPDX-License-Identifier: MIT
// Outlines to start from: circle, box, capsule.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"

#include <span>
#include <vector>

namespace softbody {

/// `point_count` points evenly on a circle about the origin, from (radius, 0) and turning from x towards y (thesis Alg.
/// 4.9, with the winding stated). Refuses radius <= 0 or a count outside 3..4096.
Result<std::vector<Vec2>> circle_hull(Real radius, int point_count);

/// A box about the origin, its edges divided so that no piece is longer than `spacing` [length].
/// Starts at the corner (-x, -y). Refuses sizes or spacing <= 0, and more than 4096 points.
Result<std::vector<Vec2>> box_hull(Vec2 size, Real spacing);

/// An upright capsule about the origin: `height` along y, caps included, and half circles of `radius`, divided into
/// pieces no longer than `spacing` [length]. Refuses radius or spacing <= 0 and height <= 2 radius.
Result<std::vector<Vec2>> capsule_hull(Real radius, Real height, Real spacing);

/// Whether an outline has dents so deep that their sides meet when it is pressed: it fills less than LEAST_SOLIDITY of
/// its convex hull. Precondition: a simple polygon. O(n log n).
bool has_deep_dents(std::span<const Vec2> outline);

} // namespace softbody
