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

/// The automatic springs of a body: from each hull point to the next, then from each hull point to the center point if
/// there is one, then those of the inner points. An inner point is joined to every point that it sees without crossing
/// the outline, unless a third point lies inside the circle over the two (Gabriel and Sokal 1969): on a lattice its
/// edges and both diagonals of each cell. Points are counted hull, inner points, center. O(hull) without inner points,
/// else usually O(inner points * points + springs * hull).
std::vector<SpringEnds> automatic_springs(std::span<const Vec2> hull, std::span<const Vec2> inner_points,
		std::optional<Vec2> center);

} // namespace softbody
