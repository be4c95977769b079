// SPDX-License-Identifier: MIT
// Which points of a body are joined by springs if nobody says so.
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
/// center point if there is one, then those of the inner points. An inner point is joined to every other point that it sees
/// without looking through the outline, unless a third point lies inside the circle that has the two at its ends
/// (Gabriel and Sokal 1969). On a lattice these are its edges and both diagonals of each cell, on scattered points the
/// better part of a Delaunay triangulation; it needs no triangles, so nothing can break on points of one circle. What
/// coincides is not joined. Points are counted hull, inner points, center. O(hull) without inner points, else
/// O(inner points * points + springs * hull) as a rule.
std::vector<SpringEnds> automatic_springs(std::span<const Vec2> hull, std::span<const Vec2> inner_points,
		std::optional<Vec2> center);

} // namespace softbody
