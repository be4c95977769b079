// SPDX-License-Identifier: MIT
// Chooses the points of a body that are joined by springs, if the user gives none.
#pragma once

#include "core/base/vec2.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Two points that a spring joins, by index.
using SpringEnds = std::array<std::uint32_t, 2>;

/// The springs of a body that has been given none: from each hull point to the next, then from each hull point to the
/// center point if there is one, then those of the inner points. An inner point is joined to every point that it sees
/// without crossing the outline, unless a third point lies inside the circle over the two (Gabriel and Sokal 1969). On
/// a lattice these are its edges and both diagonals of each cell; on scattered points the better part of a Delaunay
/// triangulation, without triangles that could fail for points on one circle. Coincident points are not joined. Points
/// are counted hull, inner points, center. O(hull) without inner points, else usually O(inner points * points + springs
/// * hull).
std::vector<SpringEnds> automatic_springs(std::span<const Vec2> hull, std::span<const Vec2> inner_points,
		std::optional<Vec2> center);

} // namespace softbody
