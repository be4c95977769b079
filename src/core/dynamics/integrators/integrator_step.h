// SPDX-License-Identifier: MIT
// The common interface of all integrators.
#pragma once

#include "core/base/vec2.h"
#include "core/model/body_lanes.h"
#include "core/model/integrator.h"
#include "core/model/soft_body_data.h"

#include <span>
#include <vector>

namespace softbody {

/// Loads on a body during one substep.
template <class T>
struct BasicSubstepInput {
	Vec2 gravity; ///< [length/s²]
	std::span<const BasicVec2<T>> external; ///< one constant force a point [mass·length/s²], or none at all
	Real h = 0; ///< [s], > 0
	Real implicit_share = 1; ///< SubstepPlan::implicit_share
};
using SubstepInput = BasicSubstepInput<Real>;

/// What XPBD's sweep over the springs leaves for the sweep back. All 0 for a spring without a direction.
struct SpringVisit {
	Vec2 direction; ///< unit, from the spring's first end to its second
	Real elastic = 0; ///< k h²
	Real viscous = 0; ///< c h
	Real share = 0; ///< of a correction that the spring takes, 1 / (1 + (k h² + c h) (w_a + w_b))
	Real impulse = 0; ///< so far, times h
};

/// Scratch memory of the integrators. It grows to the largest body and then stays.
template <class T>
struct BasicWorkspace {
	std::vector<BasicVec2<T>> forces;
	std::vector<BasicVec2<T>> stage_positions;
	std::vector<BasicVec2<T>> stage_velocities;
	std::vector<BasicVec2<T>> position_slopes;
	std::vector<BasicVec2<T>> velocity_slopes;
	std::vector<SpringVisit> spring_visits; ///< of XPBD
	/// Whether `forces` still belongs to the body's present state, so that velocity Verlet need not evaluate it again.
	/// Code that changes the state in between (a contact) sets it to false, lane by lane.
	MaskOf<T> forces_are_current = T(0) < T(0);

	/// Makes room for `count` points and forgets the last body.
	void begin_body(std::size_t count) {
		if (forces.size() < count) {
			for (auto *array : { &forces, &stage_positions, &stage_velocities, &position_slopes, &velocity_slopes }) {
				array->resize(count);
			}
		}
		forces_are_current = T(0) < T(0);
	}
};
using IntegratorWorkspace = BasicWorkspace<Real>;

/// The one seam between a step and its method: a step calls its bodies' method through this pointer, once a substep and batch,
/// as `integrator_traits` and `LANE_STEPS` hold it. Methods that only charts and teaching use (explicit Euler, midpoint,
/// Heun, Runge-Kutta) cost the others nothing beyond that call.
/// Advances positions and velocities by one substep, without contacts. Stages evaluate contact-free forces; the caller
/// solves contacts once, after the substep. A pinned point (inverse mass 0) keeps its velocity, which is 0.
template <class T>
using LaneStep = void (*)(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace);

/// Advances one body. XPBD exists only in this form, as its passes end at different times for different bodies.
using IntegratorStep = void (*)(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);
void step_xpbd(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace);

/// Properties of an integrator.
struct IntegratorTraits {
	int evaluations; ///< force evaluations a substep
	/// Whether the velocity after a substep is ahead of the way just gone: it holds the forces of the whole substep,
	/// the way only those of a part, or none.
	bool velocity_leads;
	IntegratorStep step;
};

/// Precondition: `integrator` is not AUTOMATIC, which is not a method.
const IntegratorTraits &integrator_traits(Integrator integrator);

} // namespace softbody
