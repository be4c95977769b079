// SPDX-License-Identifier: MIT
// The table of integrators.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/integrators/lane_steps.h"

#include <array>
#include <limits>
#include <numbers>

namespace softbody {

namespace {

template <LaneStep<Real> step>
void step_one(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	step(lanes_of(body), input, workspace);
}

} // namespace

const IntegratorTraits &integrator_traits(Integrator integrator) {
	static constexpr double NONE = 0;
	static constexpr double SQRT_8 = 2 * std::numbers::sqrt2;
	static constexpr double INFINITE = std::numeric_limits<double>::infinity();
	static const std::array<IntegratorTraits, INTEGRATOR_COUNT> table = { {
			{ "automatic", 0, 0, NONE, false, true, nullptr },
			{ "explicit_euler", 1, 1, NONE, true, true, step_one<step_explicit_euler<Real>> },
			{ "semi_implicit_euler", 1, 1, 2, false, true, step_one<step_semi_implicit_euler<Real>> },
			{ "midpoint", 2, 2, NONE, true, true, step_one<step_midpoint<Real>> },
			{ "heun", 2, 2, NONE, true, true, step_one<step_heun<Real>> },
			{ "runge_kutta_4", 4, 4, SQRT_8, true, true, step_one<step_runge_kutta_4<Real>> },
			{ "velocity_verlet", 2, 1, 2, true, false, step_one<step_velocity_verlet<Real>> },
			{ "xpbd", 1, 1, INFINITE, false, false, step_xpbd },
	} };
	return table[std::size_t(integrator)];
}

} // namespace softbody
