// SPDX-License-Identifier: MIT
// Changes of the rigid part of a body's motion.
#include "core/model/rigid_motion.h"

#include "core/base/constants.h"
#include "core/model/body_frame.h"

namespace softbody {

namespace {

bool can_turn(const SoftBodyData &body, const BodyFrame &frame) {
	return frame.inertia > DEGENERATE_LENGTH * body.shape().rest_inertia();
}

void change_motion(SoftBodyData &body, const BodyFrame &frame, Vec2 velocity, Real spin) {
	if (body.is_frozen()) {
		return;
	}
	body.wake();
	const std::span<const Vec2> x = body.positions();
	const std::span<Vec2> v = body.mutable_velocities();
	const Real turn = can_turn(body, frame) ? spin : Real(0);
	for (std::size_t i = 0; i < v.size(); ++i) {
		if (body.inverse_masses()[i] != 0) {
			v[i] += velocity + perpendicular(x[i] - frame.center) * turn;
		}
	}
}

} // namespace

Status apply_rigid_impulse(SoftBodyData &body, Vec2 impulse, Vec2 position) {
	if (Status status = first_error({ check_finite("impulse", impulse), check_finite("position", position) })) {
		return status;
	}
	const BodyFrame frame = measure_frame(body);
	change_motion(body, frame, impulse * (1 / body.shape().total_mass()),
			cross(position - frame.center, impulse) / frame.inertia);
	return {};
}

Status apply_angular_impulse(SoftBodyData &body, Real impulse) {
	if (Status status = check_finite("impulse", impulse, "kg·m²/s")) {
		return status;
	}
	const BodyFrame frame = measure_frame(body);
	change_motion(body, frame, {}, impulse / frame.inertia);
	return {};
}

Status add_rigid_force(SoftBodyData &body, Vec2 force, Vec2 position) {
	if (Status status = first_error({ check_finite("force", force), check_finite("position", position) })) {
		return status;
	}
	body.queue_load({ force, cross(position - measure_frame(body).center, force) });
	return {};
}

Status add_torque(SoftBodyData &body, Real torque) {
	if (Status status = check_finite("torque", torque, "N·m")) {
		return status;
	}
	body.queue_load({ {}, torque });
	return {};
}

Status set_linear_velocity(SoftBodyData &body, Vec2 velocity) {
	if (Status status = check_finite("linear_velocity", velocity)) {
		return status;
	}
	const BodyFrame frame = measure_frame(body);
	change_motion(body, frame, velocity - frame.velocity, 0);
	return {};
}

Status set_angular_velocity(SoftBodyData &body, Real velocity) {
	if (Status status = check_finite("angular_velocity", velocity, "rad/s")) {
		return status;
	}
	const BodyFrame frame = measure_frame(body);
	change_motion(body, frame, {}, velocity - frame.angular_velocity);
	return {};
}

void add_rigid_load(const SoftBodyData &body, std::span<Vec2> forces) {
	const RigidLoad &load = body.queued_load();
	const BodyFrame frame = measure_frame(body);
	const Vec2 acceleration = load.force * (1 / body.shape().total_mass());
	const Real turn = can_turn(body, frame) ? load.torque / frame.inertia : Real(0);
	for (std::size_t i = 0; i < forces.size(); ++i) {
		forces[i] += (acceleration + perpendicular(body.positions()[i] - frame.center) * turn) * body.shape().masses()[i];
	}
}

} // namespace softbody
