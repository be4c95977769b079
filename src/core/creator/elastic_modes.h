// SPDX-License-Identifier: MIT
// Finds the elastic modes of an outline, and the masses with which they swing as the solid does.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/holed_polygon.h"
#include "core/model/elastic_modes.h"

#include <memory>
#include <span>
#include <vector>

namespace softbody {

/// A reduced elastic solid: masses of its points, and its modes.
struct ElasticReduction {
	std::vector<Real> mass_shares; ///< one a point, summing to 1; a hull point by the length of outline that it stands for
	std::shared_ptr<const ElasticModes> modes; ///< for exactly these masses; positions relative to the center of mass
};

/// Reduces the solid inside an outline (`LatticeSolid`) to the softest modes of its points (static condensation, Guyan
/// 1965, truncated). The mass is divided between hull and inner points so that the lowest frequency is the solid's;
/// without inner points frequencies are up to a third too low. `points` are the hull, of positive area, then the inner
/// points. With `is_balanced` their center is the outline's area centroid (`balance_masses`). A solid with holes gives its stiffness to
/// the points outside of them; their masses then have its center and, where an inner point can take up mass, its moment of inertia,
/// instead of its lowest frequency. Allocates; takes some milliseconds for up to a few hundred points, some tens for thin rings.
ElasticReduction reduce_solid(std::span<const Vec2> points, std::size_t hull_count, bool is_balanced = false, const Holes &holes = {});

} // namespace softbody
