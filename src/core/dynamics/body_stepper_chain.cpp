// SPDX-License-Identifier: MIT
// Advances a body that is an open chain through a time slice of a step.
#include "core/dynamics/body_stepper.h"

#include "core/dynamics/body_reset.h"
#include "core/dynamics/joint_solver.h"
#include "core/dynamics/state_lanes.h"

#include <algorithm>

namespace softbody {

void BodyStepper::advance_chain(const Batch &batch, std::size_t lane, const TimeSlice &slice) {
	const std::uint32_t active_index = batch.active_indices[lane];
	const std::uint32_t body_index = batch.body_indices[lane];
	SoftBodyData &data = body(body_index);
	const std::span<ChainLoad> loads = context_->joints.loads_of(active_index);
	// Contacts and joints with other bodies come after each slice: what holds a chain is solved once in it.
	const int substeps = slice.is_coupled ? 1 : slice.substeps_of(*batch.plan);
	counts_.substeps += std::uint64_t(substeps);
	const Real h = slice.duration / Real(substeps);
	const std::size_t count = data.point_count();
	before_.resize(std::max(before_.size(), count));
	const std::span<Vec2> before(before_.data(), count);
	keep_start(batch, lane);
	const Vec2 gravity = data.total_acceleration(context_->world.gravity());
	collision_.begin_body(context_->colliders, data, slice.elapsed, slice.duration);
	const bool meets_itself = data.settings().self_collision && !slice.is_coupled;
	std::vector<Vec2> &outside = data.last_valid_hull();
	const Vec2 *sweep = sweep_start(active_index, body_index, slice);
	for (int i = 0; i < substeps; ++i) {
		std::ranges::copy(data.positions(), before.begin());
		if (meets_itself) {
			hull_before_.assign(data.hull().begin(), data.hull().end());
		}
		if (sweep != nullptr) {
			std::copy_n(sweep, data.shape().hull_count(), before.begin());
			sweep = nullptr;
		}
		const Real elapsed = slice.elapsed + Real(i) * h;
		if (loads.empty()) { // else solved before the slice, one chain after the other
			counts_.contacts += chain_stepper_.solve_velocities(context_->colliders, data, elapsed, h, {}, 0, collision_.log());
		}
		chain_stepper_.move(context_->colliders, data, elapsed, h, loads);
		chain_stepper_.begin_contacts(data);
		if (collision_.handle(data, before, gravity, h) > 0) {
			chain_stepper_.take_contacts(data);
		}
		if (meets_itself) {
			outside.assign(data.hull().begin(), data.hull().end());
			const std::size_t self_contacts = self_collision_.handle(data, hull_before_, h);
			if (self_contacts > 0) {
				sweep = outside.data();
			} else {
				outside.clear();
			}
			counts_.self_contacts += self_contacts;
		}
	}
	if (!is_finite_within<Real>(data.positions(), data.velocities(), CREDIBLE_REACH * data.shape().radius())) {
		restore_start(batch, lane);
		reset(body_index, slice.duration);
	}
	context_->bodies.has_touch(active_index) = char(data.touch_memory().touching);
}

} // namespace softbody
