// SPDX-License-Identifier: MIT
// Triangles that fill an outline, with points inside it as corners.
#pragma once

#include "core/base/vec2.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Three indices of points.
using Triangle = std::array<std::uint32_t, 3>;

/// Fills the simple polygon `points[0, hull_count)`, of either winding, with triangles of positive winding. Points
/// after it that lie inside become corners too; points outside or on top of another point belong to no triangle. The
/// triangles cover the polygon once, all hull edges are edges of triangles, and otherwise they are as far from slivers
/// as those edges allow (constrained Delaunay). For points on one circle several results are equally good; equal input
/// gives equal output.
///
/// However the points move afterwards, the triangles leave no hole: every place that the moved hull winds around is
/// covered, as a continuous map of a disk cannot leave out a place that its border winds around.
///
/// Precondition: `check_hull` accepts the polygon. Usually O(n²).
/// Source: ear clipping (Meisters 1975), then edge flips (Lawson 1977).
std::vector<Triangle> triangulate(std::span<const Vec2> points, std::size_t hull_count);

} // namespace softbody
