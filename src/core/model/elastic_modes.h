// SPDX-License-Identifier: MIT
// The softest ways in which an outline filled with an elastic solid deforms.
#pragma once

#include "core/base/vec2.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// Most modes of a body [1]. More: finer dents, and proportionally more time a substep.
inline constexpr std::size_t MAX_ELASTIC_MODES = 16;

/// Poisson's ratios at which mode stiffnesses are known; a parabola interpolates and extrapolates them.
inline constexpr std::array<double, 3> MODE_POISSON_RATIOS = { 0, 0.3, 0.45 };

/// Reduced elastic model of a body (modal analysis; Pentland and Williams 1989). Every mode moves each point by a
/// vector, keeps the area and has a stiffness in proportion to the shear modulus. Modes are orthogonal to each other
/// and to rigid motion, weighted by mass. Deformation in no mode is resisted like the stiffest mode. The area term
/// resists dilation. An outline has equal modes at any size and mass. Immutable; shared by shapes.
struct ElasticModes {
	std::size_t count = 0; ///< of modes, 1..MAX_ELASTIC_MODES
	/// Mass share times displacement of point i in mode j at [i * count + j] [1].
	std::vector<Vec2> shapes;
	/// Stiffness of each mode over the shear modulus at each of MODE_POISSON_RATIOS [1], ascending in the first column.
	std::vector<std::array<Real, 3>> stiffness;
	/// For each hull point: the derivative of the rest area over twice the rest area [1/length].
	std::vector<Vec2> dilation;
	/// For each mode: sum over points of mode shape times rest position [length].
	std::vector<Real> dilation_overlap;
	/// Largest factor by which the removal of dilation may raise a squared frequency [1], >= 1.
	Real projection_bound = 1;

	/// Relative growth of the hull's area under a pressure inside of 1, times the shear modulus, at each of MODE_POISSON_RATIOS [1]: of a solid
	/// with holes, whose hull gives way where the solid would not. Zeros without holes, where it follows from the bulk modulus.
	std::array<Real, 3> hull_compliance{};

	std::span<const Vec2> shape_of_point(std::size_t point) const { return { shapes.data() + point * count, count }; }
};

/// Weights of the three columns of `ElasticModes::stiffness` at a Poisson's ratio.
inline std::array<Real, 3> mode_weights(Real poisson_ratio) {
	const auto &[a, b, c] = MODE_POISSON_RATIOS;
	const double x = poisson_ratio;
	return { Real((x - b) * (x - c) / ((a - b) * (a - c))), Real((x - a) * (x - c) / ((b - a) * (b - c))),
		Real((x - a) * (x - b) / ((c - a) * (c - b))) };
}

} // namespace softbody
