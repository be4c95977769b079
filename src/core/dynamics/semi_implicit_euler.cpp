// SPDX-License-Identifier: MIT
// The default integrator.
#include "core/dynamics/semi_implicit_euler.h"

#include "core/dynamics/forces.h"

namespace softbody {

void step_semi_implicit_euler(SoftBodyData &body, Vec2 gravity, std::span<const Vec2> external, Real h,
		std::span<Vec2> forces) {
	evaluate_forces(body, gravity, external, body.positions(), body.velocities(), forces);
	const std::span<Vec2> positions = body.mutable_positions();
	const std::span<Vec2> velocities = body.mutable_velocities();
	const std::span<const Real> inverse_masses = body.inverse_masses();
	for (std::size_t i = 0; i < positions.size(); ++i) {
		velocities[i] += forces[i] * (inverse_masses[i] * h);
		positions[i] += velocities[i] * h;
	}
}

} // namespace softbody
