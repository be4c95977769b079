// SPDX-License-Identifier: MIT
// What moves colliders during a step: rigid bodies of the surroundings, pushed along a path or free to be pushed.
#pragma once

#include "core/base/error.h"
#include "core/base/vec2.h"
#include "core/model/pose.h"
#include "core/model/surroundings.h"

#include <cstdint>

namespace softbody {

/// A rigid body that owns colliders. With both inverse values 0 it is kinematic: it moves with its velocities, whatever
/// is in the way. Otherwise it is dynamic: contacts with soft bodies change its velocities by mass and inertia, and what
/// they gave it is handed back (`WorldData::reactions()`). Rigid bodies do not meet one another here; that belongs to
/// the engine they come from. A step moves the pose to its end, so that a body which nobody updates goes on.
struct RigidBody {
	Pose pose; ///< of the frame in which its colliders are given
	Vec2 center_of_mass; ///< in that frame [length]; the kinematic body turns about it too
	Vec2 linear_velocity; ///< of the center of mass [length/s]
	Real angular_velocity = 0; ///< [rad/s]
	/// By whatever acts on a dynamic body besides soft bodies, gravity for example [length/s²].
	Vec2 acceleration;
	Real inverse_mass = 0; ///< [1/mass], >= 0; 0: no contact moves it
	Real inverse_inertia = 0; ///< about the center of mass [1/(mass·length²)], >= 0; 0: no contact turns it
	/// Names the body for joints (JointAnchor::tag), however often the surroundings are made anew. 0: no joint knows it.
	std::uint64_t tag = 0;

	/// What holds a dynamic body besides soft bodies, such as a floor that only the engine knows: the direction in which it is
	/// held, as long as the share of a push that is taken, 0..1. Soft bodies that push it against this direction find it so
	/// much heavier; what they give it is handed back in full. Zero: nothing is known to hold it.
	Vec2 support;
	/// The share of such a push that does not turn it, 0..1.
	Real turn_support = 0;
	/// The engine that a dynamic body comes from lets it sleep: it stays where it is during the step, and soft bodies may
	/// fall asleep beside it, or wake with it. What they give it is handed back as ever.
	bool asleep = false;

	bool is_dynamic() const { return inverse_mass > 0 || inverse_inertia > 0; }
	/// Center of mass in the world [length].
	Vec2 center() const { return pose.apply(center_of_mass); }
	/// Where it is after moving for `time` [s] with the velocities it has; where it is now if that is out of the range of
	/// numbers.
	Pose pose_after(Real time) const;
	/// Adds to both velocities [length/s, rad/s]. False, and nothing is done, if either would not be finite.
	bool change_velocities(Vec2 linear, Real angular);
	/// Velocity of its material at the place p of the world, for a body that is at `at` [length/s].
	Vec2 velocity_at(Vec2 p, const Pose &at) const {
		return linear_velocity + perpendicular(p - at.apply(center_of_mass)) * angular_velocity;
	}
};

/// What soft bodies gave a rigid body in one step.
struct Reaction {
	Vec2 impulse; ///< [mass·length/s]
	Real angular_impulse = 0; ///< about the center of mass [mass·length²/s]
	/// A soft body that sleeps is beside it, which is not looked at: it holds the rigid body as it did when it fell asleep.
	bool beside_sleeper = false;
};

/// The kinematic body that goes from one pose to the other in `dt` [s], the shorter way round.
/// Precondition: dt > 0.
RigidBody kinematic_between(const Pose &from, const Pose &to, Real dt);

/// How the surface of a collider on `body`, which is at `at`, moves, in the world: the body's motion and the
/// surface's own together.
Surface surface_in_motion(const Surface &surface, const RigidBody &body, const Pose &at);

/// Refuses what is not finite, a rotation that is not of unit length (to 1e-3), and negative inverse values.
Status check_rigid_body(const RigidBody &body);

} // namespace softbody
