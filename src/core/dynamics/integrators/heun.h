// SPDX-License-Identifier: MIT
// Heun's method: the intended meaning of the thesis's "midpoint" formulas.
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// A trial Euler step, then a step with the mean of the slopes at both ends: thesis eq. 3.26 to 3.35
// without the double count in 3.30 and 3.35. Same order and stability as the midpoint method.
template <class T>
void step_heun(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	const std::span<BasicVec2<T>> end_x(workspace.stage_positions.data(), x.size());
	const std::span<BasicVec2<T>> end_v(workspace.stage_velocities.data(), x.size());
	const std::span<BasicVec2<T>> first_forces(workspace.velocity_slopes.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, first_forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		end_x[i] = x[i] + v[i] * input.h;
		end_v[i] = v[i] + first_forces[i] * (w[i] * input.h);
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, end_x, end_v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += (v[i] + end_v[i]) * (input.h / 2);
		v[i] += (first_forces[i] + forces[i]) * (w[i] * input.h / 2);
	}
}

} // namespace softbody
