// SPDX-License-Identifier: MIT
// The thesis's Euler integrator, kept for comparison.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// x += h v, v += h F(x, v)/m, both from the old state (thesis eq. 3.17 to 3.25). On an undamped
// oscillator every step multiplies the energy by 1 + (hω)².
void step_explicit_euler(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	const std::span<Vec2> x = body.mutable_positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const std::span<const Real> w = body.inverse_masses();
	const std::span<Vec2> forces(workspace.forces.data(), x.size());
	evaluate_forces(body, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += v[i] * input.h;
		v[i] += forces[i] * (w[i] * input.h);
	}
}

} // namespace softbody
