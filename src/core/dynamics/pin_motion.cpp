// SPDX-License-Identifier: MIT
// Pins that move.
#include "core/dynamics/pin_motion.h"

namespace softbody {

void PinMotion::begin_step(WorldData &world, Real dt, bool is_rearranged) {
	places_.clear();
	// Bodies that came or were activated may have brought targets along.
	if (seen_targets_ == world.change_counts().pin_targets && !is_rearranged) {
		return;
	}
	seen_targets_ = world.change_counts().pin_targets;
	const std::span<SoftBodyData> bodies = world.soft_bodies();
	for (std::uint32_t place = 0; place < bodies.size(); ++place) {
		SoftBodyData &body = bodies[place];
		if (body.pin_targets().empty() || !body.is_active()) {
			continue;
		}
		for (const PinTarget &target : body.pin_targets()) {
			body.mutable_velocities()[target.point] = (target.position - body.positions()[target.point]) * (1 / dt);
		}
		places_.push_back(place);
	}
}

void PinMotion::end_step(WorldData &world) {
	for (const std::uint32_t place : places_) {
		SoftBodyData &body = world.soft_bodies()[place];
		for (const PinTarget &target : body.pin_targets()) {
			body.mutable_positions()[target.point] = target.position;
			body.mutable_velocities()[target.point] = {};
		}
		body.clear_pin_targets();
	}
}

} // namespace softbody
