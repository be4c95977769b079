// SPDX-License-Identifier: MIT
// How the holes of an elastic solid move when its outline does.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// A linear map of a displacement, by rows.
using WeightMatrix = std::array<Real, 4>;

/// Most hull points for which the solid is asked. It takes a fraction of a second for so many.
inline constexpr std::size_t MOST_CONDENSED_POINTS = 128;

/// For every point of the holes, hole after hole, and for every hull point: the matrix that turns the displacement of the hull point into its part
/// of the displacement of the hole's point. The sum over the hull is where the solid between them has its inner side, for small
/// displacements and Poisson's ratio 0.45 (static condensation, Guyan 1965): a thin wall keeps its width as it bends. Above
/// MOST_CONDENSED_POINTS hull points, the best affine map of those around is followed instead (moving least squares, Schaefer, McPhail and Warren
/// 2006). Rigid motion is followed in both cases. Preconditions: as for `LatticeSolid`, but for either winding of the hull.
std::vector<WeightMatrix> hole_weights(std::span<const Vec2> hull, const Holes &holes);

} // namespace softbody
