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

/// The same for a polygon with holes: `loops` are the numbers of points of the polygon and of its holes, which lie one after the other in
/// `points`, each of either winding. No triangle is in a hole. Preconditions: `check_hull` and `check_holes` accept them.
/// Source: each hole is joined to what lies around it by a cut between two points that see each other (Eberly 2002).
std::vector<Triangle> triangulate(std::span<const Vec2> points, std::span<const std::size_t> loops);

} // namespace softbody
