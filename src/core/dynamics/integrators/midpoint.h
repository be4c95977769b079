// SPDX-License-Identifier: MIT
// The explicit midpoint method.
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// Half an Euler step to (x, v) at t + h/2, then a whole step with the slopes found there. The thesis's
// eq. 3.26 to 3.35 carry this name but average the slopes of both ends (see heun.h), and double-count
// as printed. Energy of an undamped oscillator grows by 1 + (hω)⁴/4 a step.
template <class T>
void step_midpoint(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	const std::span<BasicVec2<T>> middle_x(workspace.stage_positions.data(), x.size());
	const std::span<BasicVec2<T>> middle_v(workspace.stage_velocities.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		middle_x[i] = x[i] + v[i] * (input.h / 2);
		middle_v[i] = v[i] + forces[i] * (w[i] * input.h / 2);
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, middle_x, middle_v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += middle_v[i] * input.h;
		v[i] += forces[i] * (w[i] * input.h);
	}
}

} // namespace softbody
