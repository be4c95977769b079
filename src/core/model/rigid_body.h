// SPDX-License-Identifier: MIT
// Rigid bodies of the environment, which move colliders: along a path, or pushed by soft bodies.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/pose.h"
#include "core/model/surroundings.h"

#include <cstdint>

namespace softbody {

/// A rigid body that owns colliders. With both inverse values 0 it is kinematic: it moves with its velocities, whatever
/// is in the way. Otherwise it is dynamic: contacts with soft bodies change its velocities by mass and inertia, and
/// `WorldData::reactions()` reports their impulses. Rigid bodies do not collide with each other here; that belongs to
/// their engine. A step moves the pose to its end, so a body goes on if its owner does not update it.
struct RigidBody {
	Pose pose; ///< of the frame in which its colliders are given
	Vec2 center_of_mass; ///< in that frame [length]; a kinematic body turns about it too
	Vec2 linear_velocity; ///< of the center of mass [length/s]
	Real angular_velocity = 0; ///< [rad/s]
	/// Acceleration of a dynamic body by everything except soft bodies, gravity for example [length/s²].
	Vec2 acceleration;
	Real inverse_mass = 0; ///< [1/mass], >= 0; 0: no contact moves it
	Real inverse_inertia = 0; ///< about the center of mass [1/(mass·length²)], >= 0; 0: no contact turns it
	/// Identifies the body for joints (JointAnchor::tag), also when the environment is made anew. 0: no joint refers to
	/// it.
	std::uint64_t tag = 0;

	/// Support of a dynamic body by other things than soft bodies, such as a floor that only the engine knows: the
	/// direction in which it is held, as long as the share of a push that the support takes, 0..1. Soft bodies that
	/// push against this direction feel a body that much heavier; their impulses are reported in full. Zero: no known
	/// support.
	Vec2 support;
	/// The share of such a push that does not turn the body, 0..1.
	Real turn_support = 0;
	/// Whether the engine lets a dynamic body sleep: it stays in place during the step, and soft bodies may fall asleep
	/// beside it, or wake with it. Their impulses are reported nevertheless.
	bool asleep = false;

	bool is_dynamic() const { return inverse_mass > 0 || inverse_inertia > 0; }
	/// Center of mass in the world [length].
	Vec2 center() const { return pose.apply(center_of_mass); }
	/// Pose after moving for `time` [s] with the present velocities; the present pose if that is not finite.
	Pose pose_after(Real time) const;
	/// Adds to both velocities [length/s, rad/s]. False, and nothing changes, if either would not be finite.
	bool change_velocities(Vec2 linear, Real angular);
	/// Velocity of its material at the place p of the world, for a body at pose `at` [length/s].
	Vec2 velocity_at(Vec2 p, const Pose &at) const {
		return linear_velocity + perpendicular(p - at.apply(center_of_mass)) * angular_velocity;
	}
};

/// Impulses of soft bodies on a rigid body in one step.
struct Reaction {
	Vec2 impulse; ///< [mass·length/s]
	Real angular_impulse = 0; ///< about the center of mass [mass·length²/s]
	/// A sleeping soft body is beside it and was not stepped: it supports the rigid body as it did when it fell asleep.
	bool beside_sleeper = false;
};

/// The kinematic body that goes from one pose to the other in `dt` [s], by the shorter rotation. Precondition: dt > 0.
RigidBody kinematic_between(const Pose &from, const Pose &to, Real dt);

/// Motion in the world of the surface of a collider on `body` at pose `at`: the body's motion plus the surface's own.
Surface surface_in_motion(const Surface &surface, const RigidBody &body, const Pose &at);

/// Refuses non-finite values, a rotation that is not of unit length (to 1e-3), and negative inverse values.
Status check_rigid_body(const RigidBody &body);

} // namespace softbody
