// SPDX-License-Identifier: MIT
// Restitution between two bodies as wholes.
#pragma once

#include "core/collision/pair_constraint.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// Inverse mass of a body as a whole [1/mass]; 0 if a point is pinned.
inline Real whole_inverse_mass(const SoftBodyData &body) {
	return body.is_free() ? 1 / body.shape().total_mass() : Real(0);
}

/// Follows the touch of two bodies through a substep of `h` [s]. `push` is the summed normal impulse of the contacts
/// between them as it acts on the first [mass·length/s]. When the touch is over, the centers must part with their
/// fastest approach times the restitution of both (the sum, at most 1). If the springs have given less, the missing
/// speed is noted, and `BounceLedger` gives it at the end of the step. Approaches slower than RESTITUTION_SUBSTEPS of the
/// larger pull do not count. Precondition: `mass_center` and `mass_velocity` of both are of this substep. O(1).
void follow_pair_bounce(const SolverBody &first, const SolverBody &second, Vec2 push, PairTouch &touch, Real h);

} // namespace softbody
