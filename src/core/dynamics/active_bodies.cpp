// SPDX-License-Identifier: MIT
// The active bodies of a world as a step goes through them: one after the other in active indices, and side by side in batches.
#include "core/dynamics/active_bodies.h"

#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>

namespace softbody {

bool ActiveBodies::update(Real dt) {
	batch_builder_.update(world_);
	const bool has_contacts = world_.has_environment();
	if (arranged_batch_builder_ == batch_builder_.version() && arranged_dt_ == dt && arranged_with_contacts_ == has_contacts) {
		return false;
	}
	arranged_batch_builder_ = batch_builder_.version();
	arranged_dt_ = dt;
	arranged_with_contacts_ = has_contacts;
	solver_bodies_.clear();
	body_indices_.clear();
	first_hull_point_.clear();
	frozen_count_ = 0;
	active_index_of_.assign(world_.soft_bodies().size(), 0);
	std::size_t hull_points = 0;
	for (std::uint32_t body_index = 0; body_index < world_.soft_bodies().size(); ++body_index) {
		if (world_.soft_bodies()[body_index].is_active()) {
			first_hull_point_.push_back(hull_points);
			hull_points += world_.soft_bodies()[body_index].shape().hull_count();
			add_body(body_index);
		}
	}
	before_.resize(hull_points);
	sweep_start_.resize(hull_points);
	batch_of_.resize(solver_bodies_.size());
	batches_.clear();
	pressed_batches_.clear();
	for (const Batch &batch : batch_builder_.batches()) {
		add_batch(batch, dt);
	}
	meet_themselves_ = std::ranges::any_of(batch_builder_.batches(), [](const Batch &c) { return c.settings->self_collision; });
	has_monitored_ = std::ranges::any_of(solver_bodies_, &SolverBody::is_monitored);
	return true;
}

void ActiveBodies::add_body(std::uint32_t body_index) {
	SoftBodyData &body = world_.soft_bodies()[body_index];
	const BodySettings &settings = body.settings();
	frozen_count_ += body.is_frozen();
	active_index_of_[body_index] = std::uint32_t(solver_bodies_.size());
	body_indices_.push_back(body_index);
	SolverBody &solver_body = solver_bodies_.emplace_back();
	solver_body.positions = body.mutable_positions();
	solver_body.velocities = body.mutable_velocities();
	solver_body.inverse_masses = body.inverse_masses();
	solver_body.inverse_mass = body.is_free() ? 1 / body.shape().total_mass() : Real(0);
	solver_body.width = body.shape().width();
	solver_body.friction = signed_friction(settings.friction, settings.rough);
	solver_body.rolling_resistance = settings.rolling_resistance;
	solver_body.rolling_radius = body.shape().radius();
	solver_body.body_index = body_index;
	solver_body.is_monitored = settings.contact_monitor;
}

void ActiveBodies::add_batch(const Batch &batch, Real dt) {
	const std::uint32_t index = std::uint32_t(batches_.size());
	const bool is_like_last = index > 0 && move_alike(batch_builder_.batches()[index - 1], batch);
	const std::uint32_t kind = index == 0 ? 0 : batches_.back().kind + std::uint32_t(!is_like_last);
	BatchState &state = batches_.emplace_back();
	state.kind = kind;
	state.plan = plan_substeps(world_.soft_bodies()[batch.bodies[0]], dt, arranged_with_contacts_);
	if (batch.settings->pressure_stiffness > 0) {
		pressed_batches_.push_back(index);
	}
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		const std::uint32_t active_index = active_index_of_[batch.bodies[lane]];
		state.active_indices[lane] = active_index;
		state.awake |= 1u << lane;
		batch_of_[active_index] = index;
		solver_bodies_[active_index].velocity_leads = integrator_traits(state.plan.integrator).velocity_leads;
		solver_bodies_[active_index].before = std::span(before_).subspan(first_hull_point_[active_index], batch.shape->hull_count());
	}
}

void ActiveBodies::plan_pressure(Real dt) {
	own_plans_.clear();
	for (const std::uint32_t i : pressed_batches_) {
		const Batch &batch = batch_builder_.batches()[i];
		BatchState &state = batches_[i];
		if (state.awake == 0) {
			continue;
		}
		std::array<SubstepPlan, PACK_WIDTH> plans;
		bool are_equal = true;
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			plans[lane] = plan_substeps(world_.soft_bodies()[batch.bodies[lane]], dt, arranged_with_contacts_);
			are_equal &= plans[lane].substeps == plans[0].substeps && plans[lane].integrator == plans[0].integrator;
		}
		state.plan = plans[0];
		state.own_plans = are_equal ? BatchState::NO_OWN_PLANS : std::uint32_t(own_plans_.size());
		if (!are_equal) {
			own_plans_.push_back(plans);
		}
	}
}

void ActiveBodies::note_awake(std::uint32_t active_index, bool awake) {
	const Batch &batch = batch_builder_.batches()[batch_of_[active_index]];
	BatchState &state = batches_[batch_of_[active_index]];
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		if (state.active_indices[lane] == active_index) {
			state.awake = awake ? state.awake | 1u << lane : state.awake & ~(1u << lane);
		}
	}
	if (awake) {
		return;
	}
	SoftBodyData &body = data(active_index);
	body.touch_memory() = {};
	body.pair_memories().clear();
	std::ranges::fill(body.mutable_velocities(), Vec2{});
	std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	solver_bodies_[active_index].begin_substep();
	solver_bodies_[active_index].measure_extent();
}

} // namespace softbody
