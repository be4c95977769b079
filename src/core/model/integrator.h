// SPDX-License-Identifier: MIT
// The methods that advance a body in time.
#pragma once

#include <cstdint>

namespace softbody {

/// Methods that advance a body's points. Orders and limits are those of the undamped oscillator of angular frequency ω
/// stepped by h; docs/accuracy.md charts all of them.
enum class Integrator : std::uint8_t {
	AUTOMATIC, ///< Verlet alone, semi-implicit Euler with an environment, XPBD where both cost too much
	EXPLICIT_EULER, ///< order 1, 1 evaluation; gains energy at every h without damping (thesis 3.3.1)
	SEMI_IMPLICIT_EULER, ///< order 1, 1 evaluation, symplectic; stable for hω < 2
	MIDPOINT, ///< order 2, 2 evaluations; gains energy slowly at every h without damping (thesis 3.3.2, corrected)
	HEUN, ///< order 2, 2 evaluations; the average in the thesis's midpoint formulas; like MIDPOINT
	RUNGE_KUTTA_4, ///< order 4, 4 evaluations; stable for hω < 2√2, loses energy there (thesis 3.3.3, corrected)
	VELOCITY_VERLET, ///< order 2, 1 evaluation, symplectic; stable for hω < 2
	XPBD, ///< order 1, constraints; its energy is kept in bounds for every stiffness and h, damps wobble numerically
};

inline constexpr int INTEGRATOR_COUNT = 8;

} // namespace softbody
