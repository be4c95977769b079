// SPDX-License-Identifier: MIT
// The default integrator: velocity first, then position with the new velocity.
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// v += h F(x, v)/m, then x += h v: thesis eq. 3.17 to 3.25 with the updated velocity in 3.25, which
// makes the method symplectic for undamped springs.
template <class T>
void step_semi_implicit_euler(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		v[i] += forces[i] * (w[i] * input.h);
		x[i] += v[i] * input.h;
	}
}

} // namespace softbody
