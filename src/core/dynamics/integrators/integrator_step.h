// SPDX-License-Identifier: MIT
// The one interface behind which all integrators stand.
#pragma once

#include "core/base/vec2.h"
#include "core/model/integrator.h"
#include "core/model/soft_body_data.h"

#include <span>
#include <vector>

namespace softbody {

/// What acts on a body during one substep.
struct SubstepInput {
	Vec2 gravity; ///< [length/s²]
	std::span<const Vec2> external; ///< one constant force a point [mass·length/s²]
	Real h = 0; ///< [s], > 0
};

/// Scratch memory of the integrators. It grows to the largest body and then stays.
struct IntegratorWorkspace {
	std::vector<Vec2> forces;
	std::vector<Vec2> stage_positions;
	std::vector<Vec2> stage_velocities;
	std::vector<Vec2> position_slopes;
	std::vector<Vec2> velocity_slopes;
	/// Whether `forces` still belongs to the body's present state, so that velocity Verlet need not
	/// evaluate it again. Whoever changes the state in between (a contact) sets it to false.
	bool forces_are_current = false;

	/// Makes room for `count` points and forgets the last body.
	void begin_body(std::size_t count);
};

/// Advances positions and velocities of one body by one substep, without contacts. Stages evaluate
/// the same contact-free forces; contacts are answered once, after the substep, by whoever calls.
/// A pinned point (inverse mass 0) keeps its velocity, which is 0.
using IntegratorStep = void (*)(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);

void step_explicit_euler(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_semi_implicit_euler(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_midpoint(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_heun(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_runge_kutta_4(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_velocity_verlet(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_xpbd(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);

/// What is known of an integrator before it runs.
struct IntegratorTraits {
	const char *name; ///< as benches and charts spell it
	int order; ///< of the error over a fixed time as h goes to 0
	int evaluations; ///< force evaluations a substep
	/// Largest stable hω of the undamped oscillator; 0 when every step gains energy, infinite for XPBD.
	double undamped_limit;
	IntegratorStep step;
};

/// Precondition: `integrator` is not AUTOMATIC, which is a choice and no method.
const IntegratorTraits &integrator_traits(Integrator integrator);

} // namespace softbody
