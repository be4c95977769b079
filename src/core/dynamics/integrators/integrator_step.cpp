// SPDX-License-Identifier: MIT
// The table of integrators.
#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace softbody {

void IntegratorWorkspace::begin_body(std::size_t count) {
	for (std::vector<Vec2> *array :
			{ &forces, &stage_positions, &stage_velocities, &position_slopes, &velocity_slopes }) {
		array->resize(std::max(array->size(), count));
	}
	forces_are_current = false;
}

const IntegratorTraits &integrator_traits(Integrator integrator) {
	static constexpr double NONE = 0;
	static const std::array<IntegratorTraits, INTEGRATOR_COUNT> table = { {
			{ "automatic", 0, 0, NONE, nullptr },
			{ "explicit_euler", 1, 1, NONE, step_explicit_euler },
			{ "semi_implicit_euler", 1, 1, 2, step_semi_implicit_euler },
			{ "midpoint", 2, 2, NONE, step_midpoint },
			{ "heun", 2, 2, NONE, step_heun },
			{ "runge_kutta_4", 4, 4, 2 * std::numbers::sqrt2, step_runge_kutta_4 },
			{ "velocity_verlet", 2, 1, 2, step_velocity_verlet },
			{ "xpbd", 1, 1, std::numeric_limits<double>::infinity(), step_xpbd },
	} };
	return table[std::size_t(integrator)];
}

} // namespace softbody
