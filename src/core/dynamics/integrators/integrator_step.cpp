// SPDX-License-Identifier: MIT
// The table of integrators.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/integrators/lane_steps.h"

#include <array>

namespace softbody {

namespace {

template <LaneStep<Real> step>
void step_one(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	step(lanes_of(body), input, workspace);
}

} // namespace

const IntegratorTraits &integrator_traits(Integrator integrator) {
	static const std::array<IntegratorTraits, INTEGRATOR_COUNT> table = { {
			{ 0, false, nullptr }, // AUTOMATIC
			{ 1, true, step_one<step_explicit_euler<Real>> },
			{ 1, false, step_one<step_semi_implicit_euler<Real>> },
			{ 2, true, step_one<step_midpoint<Real>> },
			{ 2, true, step_one<step_heun<Real>> },
			{ 4, true, step_one<step_runge_kutta_4<Real>> },
			{ 1, true, step_one<step_velocity_verlet<Real>> },
			{ 1, true, step_xpbd },
	} };
	return table[std::size_t(integrator)];
}

} // namespace softbody
