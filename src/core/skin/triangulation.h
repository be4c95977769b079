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

/// Fills the simple polygon `points[0, hull_count)`, of either winding, with triangles of positive winding. Further
/// points become corners if they lie inside and on no other point. The triangles cover the polygon once, contain all
/// hull edges, and are otherwise as far from slivers as those edges allow (constrained Delaunay). Equal input gives
/// equal output. However the points move afterwards, the triangles leave no hole inside the moved hull.
/// Precondition: `check_hull` accepts the polygon. Usually O(n²).
/// Source: ear clipping (Meisters 1975), then edge flips (Lawson 1977).
std::vector<Triangle> triangulate(std::span<const Vec2> points, std::size_t hull_count);

} // namespace softbody
