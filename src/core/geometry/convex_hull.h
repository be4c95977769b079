// SPDX-License-Identifier: MIT
// The convex hull of a small set of points, in memory of the caller.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// The corners of the convex hull, of positive winding, starting at the least x (of those, the least
/// y): a part of `workspace`, which must hold at least twice as many points as given and be apart from
/// them. Points on an edge between two corners are dropped, so no three are in line; those whose
/// triangle is thinner than double can tell count as in line.
///
/// Degenerate sets: none gives none, coincident points one, points in line their two ends.
/// Precondition: finite points. O(n log n), no allocation. Source: Andrew 1979 (monotone chain).
std::span<const Vec2> convex_hull(std::span<const Vec2> points, std::span<Vec2> workspace);

} // namespace softbody
