// SPDX-License-Identifier: MIT
// The convex hull of a small set of points, in memory of the caller.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// The corners of the convex hull, of positive winding, starting at the least x (of those, the least y), as a part of
/// `workspace`. It holds at least twice as many points as `points`, and does not overlap them. No three corners are in
/// line, as far as double can resolve. No points give no corners, coincident points one, points in line their two ends.
/// Precondition: finite points. O(n log n), no allocation. Source: Andrew 1979 (monotone chain).
std::span<const Vec2> convex_hull(std::span<const Vec2> points, std::span<Vec2> workspace);

} // namespace softbody
