// SPDX-License-Identifier: MIT
// Velocity Verlet (leapfrog): kick, drift, kick.
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// v' = v + h/2 F/m; x += h v'; v = v' + h/2 F(x, ·)/m (Swope et al. 1982). Damping makes F depend on
// the velocity at the end, which is not known yet; it is evaluated at the prediction v' + h/2 F/m,
// whose error is O(h²), so the order stays 2. The second kick's forces open the next substep unless
// something changed the state in between: one evaluation a substep.
template <class T>
void step_velocity_verlet(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	const std::span<BasicVec2<T>> predicted(workspace.stage_velocities.data(), x.size());
	if (any(!workspace.forces_are_current)) {
		const std::span<BasicVec2<T>> fresh(workspace.velocity_slopes.data(), x.size());
		evaluate_forces<T>(body.model, input.gravity, input.external, x, v, fresh);
		for (std::size_t i = 0; i < x.size(); ++i) {
			forces[i] = select(workspace.forces_are_current, forces[i], fresh[i]);
		}
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		const BasicVec2<T> kick = forces[i] * (w[i] * input.h / 2);
		v[i] += kick;
		x[i] += v[i] * input.h;
		predicted[i] = v[i] + kick;
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, x, predicted, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		v[i] += forces[i] * (w[i] * input.h / 2);
	}
	workspace.forces_are_current = T(0) < T(1);
}

} // namespace softbody
