// SPDX-License-Identifier: MIT
// Triangles that fill an outline and deform like an elastic solid.
#pragma once

#include "core/base/vec2.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace softbody {

/// A triangle of a body at rest, with edges E1 and E2 from its first corner to the others. With e1 and e2 for these
/// edges now, its deformation gradient is F = e1 g1ᵀ + e2 g2ᵀ.
struct ElasticTriangle {
	std::array<std::uint32_t, 3> corners{}; ///< points, of positive winding at rest
	/// g1 and g2, the rows of the inverse of the matrix (E1 E2) [1/length]. They are the gradients of the linear
	/// functions that are 1 at the second or third corner and 0 at the other two.
	std::array<Vec2, 2> gradients{};
	Real area = 0; ///< at rest [length²], > 0

	friend bool operator==(const ElasticTriangle &, const ElasticTriangle &) = default;
};

/// Linear finite elements that fill a body's outline once. Immutable; shared by shapes.
struct ElasticTriangles {
	std::vector<ElasticTriangle> triangles;
	/// Square of the solid's lowest angular frequency, times its mass, over its shear modulus, at each of MODE_POISSON_RATIOS
	/// [1]. The damping of a material follows from it.
	std::array<Real, 3> lowest_stiffness{};
};

} // namespace softbody
