// SPDX-License-Identifier: MIT
// Keeps a body that grows where it lies from being thrown by what it lies on.
#include "godot/nodes/body_growth.h"

#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// Time for which a body is held back after it has grown [s]: about as long as it takes to shape itself anew on a floor.
constexpr Real GROWTH_CALM = Real(0.25);

} // namespace

void BodyGrowth::note_growth() {
	calm_time_ = GROWTH_CALM;
}

void BodyGrowth::begin_step(const SoftBodyData &body, Vec2 gravity, Real dt) {
	most_speed_ = -1;
	if (!(calm_time_ > 0)) {
		return;
	}
	calm_time_ -= dt;
	dt_ = dt;
	const BodyFrame frame = measure_frame(body);
	Vec2 push = body.queued_load().force;
	Real torque = body.queued_load().torque;
	for (const ExternalForce &each : body.external_forces()) {
		push += each.force;
		torque += cross(body.positions()[each.point] - frame.center, each.force);
	}
	const Vec2 acceleration = body.total_acceleration(gravity) + push * (1 / body.shape().total_mass());
	most_speed_ = std::max(length(frame.velocity), length(frame.velocity + acceleration * dt));
	most_spin_ = std::abs(frame.angular_velocity);
	if (frame.inertia > 0) {
		most_spin_ += std::abs(torque) / frame.inertia * dt;
	}
}

void BodyGrowth::end_step(SoftBodyData &body) const {
	if (most_speed_ < 0) {
		return;
	}
	const BodyFrame frame = measure_frame(body);
	const Real speed = length(frame.velocity);
	if (speed > most_speed_) {
		// It makes room for itself by the way of this speed, and does not keep it, nor the wobble of being pressed.
		const Vec2 lost = frame.velocity * (1 - most_speed_ / speed);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			if (!body.is_pinned(i)) {
				const Vec2 turning = perpendicular(body.positions()[i] - frame.center) * frame.angular_velocity;
				body.set_point(i, body.positions()[i] + lost * dt_, frame.velocity - lost + turning);
			}
		}
	}
	if (std::abs(frame.angular_velocity) > most_spin_) {
		set_angular_velocity(body, std::copysign(most_spin_, frame.angular_velocity));
	}
}

} // namespace softbody
