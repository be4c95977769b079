// SPDX-License-Identifier: MIT
// Maps integrators to their step functions, for any scalar type: included where they are instantiated.
#pragma once

#include "core/dynamics/integrators/explicit_euler.h"
#include "core/dynamics/integrators/heun.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/integrators/midpoint.h"
#include "core/dynamics/integrators/runge_kutta_4.h"
#include "core/dynamics/integrators/semi_implicit_euler.h"
#include "core/dynamics/integrators/velocity_verlet.h"

namespace softbody {

/// The step function of a method. Null for XPBD, and for AUTOMATIC, which is not a method.
template <class T>
LaneStep<T> lane_step(Integrator integrator) {
	switch (integrator) {
		case Integrator::EXPLICIT_EULER:
			return step_explicit_euler<T>;
		case Integrator::SEMI_IMPLICIT_EULER:
			return step_semi_implicit_euler<T>;
		case Integrator::MIDPOINT:
			return step_midpoint<T>;
		case Integrator::HEUN:
			return step_heun<T>;
		case Integrator::RUNGE_KUTTA_4:
			return step_runge_kutta_4<T>;
		case Integrator::VELOCITY_VERLET:
			return step_velocity_verlet<T>;
		case Integrator::AUTOMATIC:
		case Integrator::XPBD:
			break;
	}
	return nullptr;
}

} // namespace softbody
