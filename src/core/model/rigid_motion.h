// SPDX-License-Identifier: MIT
// Pushes, turns or sets the motion of a soft body as a whole, without exciting its wobble.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

// All of these treat the body as a rigid body of its present shape: mass M, center of mass c, inertia I, velocity and
// spin as measured by `measure_frame`. Every point gets the change that the rigid body would have at its place. Each
// wakes the body. Pinned points stay, and their share is lost. Frozen bodies ignore all of these; a body whose points
// coincide cannot be turned. Non-finite values are refused, and nothing changes. O(points).

/// An impulse J [mass·length/s] at the place p of the world: every point's velocity changes by
/// J/M + perpendicular(x - c) cross(p - c, J)/I at once.
Status apply_rigid_impulse(SoftBodyData &body, Vec2 impulse, Vec2 position);
/// Changes the angular momentum about the center of mass at once [mass·length²/s].
Status apply_angular_impulse(SoftBodyData &body, Real impulse);

/// A force [mass·length/s²] at the place p of the world, which acts during the next step only, with its present torque
/// cross(p - c, F). Several add up. However the body turns and stretches within the step, it gains F dt and that torque
/// times dt.
Status add_rigid_force(SoftBodyData &body, Vec2 force, Vec2 position);
/// A torque about the center of mass [mass·length²/s²], which acts during the next step only. Several add up.
Status add_torque(SoftBodyData &body, Real torque);

/// Sets the velocity of the center of mass [length/s]; spin and wobble stay.
Status set_linear_velocity(SoftBodyData &body, Vec2 velocity);
/// Sets the spin [rad/s], angular momentum over inertia; velocity and wobble stay.
Status set_angular_velocity(SoftBodyData &body, Real velocity);

/// Adds to `forces`, one a point, the effect of the body's queued load on the present points: m (F/M + perpendicular(x
/// - c) τ/I).
void add_rigid_load(const SoftBodyData &body, std::span<Vec2> forces);

} // namespace softbody
