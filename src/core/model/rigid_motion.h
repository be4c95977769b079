// SPDX-License-Identifier: MIT
// What pushes, turns or sets the motion of a soft body as a whole, without exciting its wobble.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

// All of these treat the body as the rigid one that it would be if it froze in its present shape: mass M, center of mass
// c, inertia I about it, velocity and spin as `measure_frame` tells them. Every point of the rigid part of the motion is
// changed by what that rigid body would do at its place, so that linear and angular momentum are exact and no spring
// feels anything. Each wakes the body. Pinned points stay, and what they would have got is lost to the pins: the other
// points are changed as if there were none. A frozen body ignores them. A body whose points lie in one place cannot be
// turned. Non-finite values are refused, and nothing changes. O(points).

/// An impulse J [mass·length/s] at the place p of the world: every point's velocity changes by
/// J/M + perpendicular(x - c) cross(p - c, J)/I at once.
Status apply_rigid_impulse(SoftBodyData &body, Vec2 impulse, Vec2 position);
/// Changes the angular momentum about the center of mass at once [mass·length²/s].
Status apply_angular_impulse(SoftBodyData &body, Real impulse);

/// A force [mass·length/s²] at the place p of the world, which acts during the whole of the next step and is then
/// forgotten, with the torque cross(p - c, F) that it has now; several add up. However the body turns and stretches within
/// the step, it gains F dt and that torque times dt.
Status add_rigid_force(SoftBodyData &body, Vec2 force, Vec2 position);
/// A torque about the center of mass [mass·length²/s²], likewise.
Status add_torque(SoftBodyData &body, Real torque);

/// Gives the center of mass this velocity [length/s]; spin and wobble stay.
Status set_linear_velocity(SoftBodyData &body, Vec2 velocity);
/// Gives the body this spin [rad/s], angular momentum over inertia; velocity and wobble stay.
Status set_angular_velocity(SoftBodyData &body, Real velocity);

/// Adds to `forces`, one a point, what the body's queued load does to each as the points lie now:
/// m (F/M + perpendicular(x - c) τ/I).
void add_rigid_load(const SoftBodyData &body, std::span<Vec2> forces);

} // namespace softbody
