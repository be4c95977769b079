// SPDX-License-Identifier: MIT
// Velocity Verlet (leapfrog): kick, drift, kick.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// v' = v + h/2 F/m; x += h v'; v = v' + h/2 F(x, ·)/m (Swope et al. 1982). Damping makes F depend on
// the velocity at the end, which is not known yet; it is evaluated at the prediction v' + h/2 F/m,
// whose error is O(h²), so the order stays 2. The second kick's forces open the next substep unless
// something changed the state in between: one evaluation a substep.
void step_velocity_verlet(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<Vec2> forces(workspace.forces.data(), x.size());
	const std::span<Vec2> predicted(workspace.stage_velocities.data(), x.size());
	if (!workspace.forces_are_current) {
		evaluate_forces(body, input.gravity, input.external, x, v, forces);
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		const Vec2 kick = forces[i] * (w[i] * input.h / 2);
		v[i] += kick;
		x[i] += v[i] * input.h;
		predicted[i] = v[i] + kick;
	}
	evaluate_forces(body, input.gravity, input.external, x, predicted, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		v[i] += forces[i] * (w[i] * input.h / 2);
	}
	workspace.forces_are_current = true;
}

} // namespace softbody
