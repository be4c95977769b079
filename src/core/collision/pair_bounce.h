// SPDX-License-Identifier: MIT
// The bounce of two bodies as wholes.
#pragma once

#include "core/model/soft_body_data.h"

namespace softbody {

/// To be called after each substep of `h` [s], with the summed normal impulses of the contacts between the two, as they
/// act on the first [mass·length/s].
/// Points lose their approach. When the touch is over, the centers part with their fastest approach times the
/// restitution of both (the sum, at most 1), if the springs have not seen to that. What is missing acts along the line
/// between the centers, so that momentum and angular momentum stay, and is paid for: by the energy that contacts and
/// damping have taken since the touch began, then by the wobble. Where both do not suffice the bounce is lower. Approaches
/// slower than `bounce_threshold` [length/s] do not count. O(points) while they touch.
void give_back_pair_bounce(SoftBodyData &a, SoftBodyData &b, Vec2 push, PairTouch &touch, Real bounce_threshold,
		Real h);

} // namespace softbody
