// SPDX-License-Identifier: MIT
// Restitution between two bodies as wholes.
#pragma once

#include "core/model/soft_body_data.h"

namespace softbody {

/// Applies the restitution between two bodies. Call it after each substep of `h` [s] with `push`, the summed normal
/// impulse of the contacts between them as it acts on the first [mass·length/s]. Contacts remove the approach of single
/// points. When the touch is over, the centers must part with their fastest approach times the restitution of both (the
/// sum, at most 1). If the springs have given less, the rest acts along the line between the centers, so that momentum
/// and angular momentum stay. It is paid for by the energy that contacts and damping have taken since the touch began,
/// then by the wobble. If both do not suffice, the bounce is lower. Approaches slower than `bounce_threshold`
/// [length/s] do not count. O(points) while they touch.
void give_back_pair_bounce(SoftBodyData &a, SoftBodyData &b, Vec2 push, PairTouch &touch, Real bounce_threshold,
		Real h);

} // namespace softbody
