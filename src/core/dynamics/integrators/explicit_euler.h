// SPDX-License-Identifier: MIT
// The thesis's Euler integrator, kept for comparison.
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// x += h v, v += h F(x, v)/m, both from the old state (thesis eq. 3.17 to 3.25). On an undamped
// oscillator every step multiplies the energy by 1 + (hω)².
template <class T>
void step_explicit_euler(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += v[i] * input.h;
		v[i] += forces[i] * (w[i] * input.h);
	}
}

} // namespace softbody
