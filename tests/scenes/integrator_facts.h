// SPDX-License-Identifier: MIT
// What is known of the integrators: names in benches and charts, orders and limits.
#pragma once

#include "core/model/integrator.h"

#include <array>
#include <cstddef>
#include <limits>
#include <numbers>

namespace softbody {

struct IntegratorFacts {
	const char *name; ///< in benches and charts
	int order; ///< of the error over a fixed time as h goes to 0
	/// Largest stable hω of the undamped oscillator; 0 when every step gains energy, infinite for XPBD.
	double undamped_limit;
};

inline const IntegratorFacts &integrator_facts(Integrator integrator) {
	static constexpr std::array<IntegratorFacts, INTEGRATOR_COUNT> TABLE = { {
			{ "automatic", 0, 0 },
			{ "explicit_euler", 1, 0 },
			{ "semi_implicit_euler", 1, 2 },
			{ "midpoint", 2, 0 },
			{ "heun", 2, 0 },
			{ "runge_kutta_4", 4, 2 * std::numbers::sqrt2 },
			{ "velocity_verlet", 2, 2 },
			{ "xpbd", 2, std::numeric_limits<double>::infinity() },
	} };
	return TABLE[std::size_t(integrator)];
}

} // namespace softbody
