// SPDX-License-Identifier: MIT
// The thesis's answer to a contact: a force that grows with the area of the overlap. Kept to be compared with.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/hull_contact.h"
#include "core/collision/pair_constraint.h"

#include <cstddef>
#include <vector>

namespace softbody {

/// Pushes two overlapping bodies apart with F = κ A (thesis 4.4, "EnvironmentContactSolver"): A the area that their hulls share, κ a
/// coefficient, the direction away from the other body. What the thesis leaves open is completed with the simplest reading:
/// - A is the exact area, which for concave hulls may be several pieces. The thesis takes the found points in the order in
///   which it finds them, which gives another, mostly smaller number.
/// - "Away" is the line between the means of the hulls' points.
/// - The points loaded are the hull points inside the other body, in equal shares; all hull points where none is inside.
/// - Both bodies get the same force, one its opposite. Momentum stays. Angular momentum does not: the two forces need not
///   act in one line.
/// - It acts for the substep that follows, as the thesis's external forces do. No friction, no damping, no restitution.
///
/// Its measured faults are in docs/accuracy.md. One object serves one thread.
class SeparationForce {
public:
	/// `stiffness` κ [force/length²] acts for `h` [s] at a time.
	void begin_substep(Real stiffness, Real h);
	/// Changes the velocities of both bodies if they overlap. Returns the force [force]; 0 without overlap.
	/// O(product of hull points).
	Real handle(SolverBody &a, SolverBody &b);

private:
	void push(SolverBody &body, const SolverBody &other, Vec2 impulse);

	HullEdges edges_;
	std::vector<std::size_t> loaded_;
	Real stiffness_ = 0;
	Real h_ = 0;
};

} // namespace softbody
