// SPDX-License-Identifier: MIT
// The convex hull of a small set of points, in memory of the caller.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// The corners of the convex hull, of positive winding, starting at the least x (of those, the least y). They are a
/// part of `workspace`, which must hold at least twice as many points as `points` and be apart from it. Points on an
/// edge between two corners are dropped, so no three corners are in line. A point counts as in line if its triangle is
/// thinner than double can resolve.
/// triangle is thinner than double can tell count as in line.
///
/// Degenerate sets: no points give no corners, coincident points one, points in line their two ends.
/// Precondition: finite points. O(n log n), no allocation. Source: Andrew 1979 (monotone chain).
std::span<const Vec2> convex_hull(std::span<const Vec2> points, std::span<Vec2> workspace);

} // namespace softbody
