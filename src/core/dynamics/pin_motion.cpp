// SPDX-License-Identifier: MIT
// Moves pinned points to their targets.
#include "core/dynamics/pin_motion.h"

namespace softbody {

void PinMotion::begin_step(WorldData &world, Real dt, bool is_rearranged) {
	body_indices_.clear();
	// Bodies that were added or activated may have targets.
	if (seen_targets_ == world.change_counts().pin_targets && !is_rearranged) {
		return;
	}
	seen_targets_ = world.change_counts().pin_targets;
	const std::span<SoftBodyData> bodies = world.soft_bodies();
	for (std::uint32_t body_index = 0; body_index < bodies.size(); ++body_index) {
		SoftBodyData &body = bodies[body_index];
		if (body.pin_targets().empty() || !body.is_active()) {
			continue;
		}
		for (const PinTarget &target : body.pin_targets()) {
			body.mutable_velocities()[target.point] = (target.position - body.positions()[target.point]) * (1 / dt);
		}
		body_indices_.push_back(body_index);
	}
}

void PinMotion::end_step(WorldData &world) {
	for (const std::uint32_t body_index : body_indices_) {
		SoftBodyData &body = world.soft_bodies()[body_index];
		for (const PinTarget &target : body.pin_targets()) {
			body.mutable_positions()[target.point] = target.position;
			body.mutable_velocities()[target.point] = {};
		}
		body.clear_pin_targets();
	}
}

} // namespace softbody
