// SPDX-License-Identifier: MIT
// Motion and validator of rigid bodies.
#include "core/model/rigid_body.h"

#include <cmath>

namespace softbody {

namespace {

Rotation turned(Rotation by, Rotation rotation) {
	return { by.c * rotation.c - by.s * rotation.s, by.s * rotation.c + by.c * rotation.s };
}

} // namespace

Pose RigidBody::pose_after(Real time) const {
	Pose result = pose;
	if (angular_velocity != 0) {
		result.rotation = turned(Rotation::from_angle(angular_velocity * time), pose.rotation);
		const Real size = std::sqrt(result.rotation.c * result.rotation.c + result.rotation.s * result.rotation.s);
		result.rotation = { result.rotation.c / size, result.rotation.s / size }; // otherwise it drifts from unit length
		result.position += pose.rotation.apply(center_of_mass) - result.rotation.apply(center_of_mass);
	}
	result.position += linear_velocity * time;
	const bool is_there = is_finite(result.position) && is_finite(Vec2{ result.rotation.c, result.rotation.s });
	return is_there ? result : pose;
}

bool RigidBody::change_velocities(Vec2 linear, Real angular) {
	const Vec2 new_linear = linear_velocity + linear;
	const Real new_angular = angular_velocity + angular;
	if (!is_finite(new_linear) || !std::isfinite(new_angular)) {
		return false;
	}
	linear_velocity = new_linear;
	angular_velocity = new_angular;
	return true;
}

RigidBody kinematic_between(const Pose &from, const Pose &to, Real dt) {
	RigidBody body;
	body.pose = from;
	body.linear_velocity = (to.position - from.position) * (1 / dt);
	body.angular_velocity = turned(to.rotation, { from.rotation.c, -from.rotation.s }).angle() / dt;
	return body;
}

// Velocities of a turning body and of its belt are both linear in the place, so their sum is linear about any origin.
Surface surface_in_motion(const Surface &surface, const RigidBody &body, const Pose &at) {
	Surface result = surface;
	result.velocity_origin = at.apply(body.center_of_mass);
	result.linear_velocity = body.linear_velocity + at.rotation.apply(surface.velocity_at(body.center_of_mass));
	result.angular_velocity = body.angular_velocity + surface.angular_velocity;
	return result;
}

Status check_rigid_body(const RigidBody &body) {
	if (!(length(body.support) <= Real(1.001))) { // NaN compares false
		return Error{ "rigid_body.support", "length " + number_text(length(body.support)), "must be a vector of length 0 to 1",
			"give the share of a push that the support takes, along the direction in which it holds" };
	}
	return first_error({ check_finite("rigid_body.position", body.pose.position),
			check_unit_length("rigid_body.rotation", { body.pose.rotation.c, body.pose.rotation.s },
					"make it with Rotation::from_angle, and leave scale out of it"),
			check_finite("rigid_body.center_of_mass", body.center_of_mass),
			check_finite("rigid_body.linear_velocity", body.linear_velocity),
			check_finite("rigid_body.angular_velocity", body.angular_velocity, "rad/s"),
			check_finite("rigid_body.acceleration", body.acceleration),
			check_between("rigid_body.turn_support", body.turn_support, 0, 1, ""),
			check_at_least("rigid_body.inverse_mass", body.inverse_mass, 0, ""),
			check_at_least("rigid_body.inverse_inertia", body.inverse_inertia, 0, "") });
}

} // namespace softbody
