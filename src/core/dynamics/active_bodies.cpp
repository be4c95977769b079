// SPDX-License-Identifier: MIT
// The active bodies of a world as a step goes through them: one after the other in rows, and side by side in crews.
#include "core/dynamics/active_bodies.h"

#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>

namespace softbody {

bool ActiveBodies::update(Real dt) {
	roster_.update(world_);
	const bool has_contacts = world_.has_surroundings();
	if (arranged_roster_ == roster_.version() && arranged_dt_ == dt && arranged_with_contacts_ == has_contacts) {
		return false;
	}
	arranged_roster_ = roster_.version();
	arranged_dt_ = dt;
	arranged_with_contacts_ = has_contacts;
	touching_.clear();
	places_.clear();
	first_hull_point_.clear();
	frozen_count_ = 0;
	row_of_.assign(world_.soft_bodies().size(), 0);
	std::size_t hull_points = 0;
	for (std::uint32_t place = 0; place < world_.soft_bodies().size(); ++place) {
		if (world_.soft_bodies()[place].is_active()) {
			first_hull_point_.push_back(hull_points);
			hull_points += world_.soft_bodies()[place].shape().hull_count();
			add_row(place);
		}
	}
	before_.resize(hull_points);
	swept_from_.resize(hull_points);
	crew_of_.resize(touching_.size());
	crews_.clear();
	pressed_crews_.clear();
	for (const Crew &crew : roster_.crews()) {
		add_crew(crew, dt);
	}
	meet_themselves_ = std::ranges::any_of(roster_.crews(), [](const Crew &c) { return c.settings->self_collision; });
	has_monitored_ = std::ranges::any_of(touching_, &TouchingBody::is_monitored);
	return true;
}

void ActiveBodies::add_row(std::uint32_t place) {
	SoftBodyData &body = world_.soft_bodies()[place];
	const BodySettings &settings = body.settings();
	frozen_count_ += body.is_frozen();
	row_of_[place] = std::uint32_t(touching_.size());
	places_.push_back(place);
	TouchingBody &touching = touching_.emplace_back();
	touching.positions = body.mutable_positions();
	touching.velocities = body.mutable_velocities();
	touching.inverse_masses = body.inverse_masses();
	touching.inverse_mass = body.is_free() ? 1 / body.shape().total_mass() : Real(0);
	touching.width = body.shape().width();
	touching.friction = settings.friction;
	touching.rolling_resistance = settings.rolling_resistance;
	touching.rolling_radius = body.shape().radius();
	touching.place = place;
	touching.is_monitored = settings.contact_monitor;
}

void ActiveBodies::add_crew(const Crew &crew, Real dt) {
	const std::uint32_t index = std::uint32_t(crews_.size());
	const bool is_like_last = index > 0 && move_alike(roster_.crews()[index - 1], crew);
	const std::uint32_t kind = index == 0 ? 0 : crews_.back().kind + std::uint32_t(!is_like_last);
	CrewState &state = crews_.emplace_back();
	state.kind = kind;
	state.plan = plan_substeps(world_.soft_bodies()[crew.bodies[0]], dt, arranged_with_contacts_);
	if (crew.settings->pressure_stiffness > 0) {
		pressed_crews_.push_back(index);
	}
	for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
		const std::uint32_t row = row_of_[crew.bodies[lane]];
		state.rows[lane] = row;
		state.awake |= 1u << lane;
		crew_of_[row] = index;
		touching_[row].velocity_leads = integrator_traits(state.plan.integrator).velocity_leads;
		touching_[row].before = std::span(before_).subspan(first_hull_point_[row], crew.shape->hull_count());
	}
}

void ActiveBodies::plan_pressure(Real dt) {
	own_plans_.clear();
	for (const std::uint32_t i : pressed_crews_) {
		const Crew &crew = roster_.crews()[i];
		CrewState &state = crews_[i];
		if (state.awake == 0) {
			continue;
		}
		std::array<SubstepPlan, PACK_WIDTH> plans;
		bool are_equal = true;
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			plans[lane] = plan_substeps(world_.soft_bodies()[crew.bodies[lane]], dt, arranged_with_contacts_);
			are_equal &= plans[lane].substeps == plans[0].substeps && plans[lane].integrator == plans[0].integrator;
		}
		state.plan = plans[0];
		state.own_plans = are_equal ? CrewState::NO_OWN_PLANS : std::uint32_t(own_plans_.size());
		if (!are_equal) {
			own_plans_.push_back(plans);
		}
	}
}

void ActiveBodies::note_awake(std::uint32_t row, bool awake) {
	const Crew &crew = roster_.crews()[crew_of_[row]];
	CrewState &state = crews_[crew_of_[row]];
	for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
		if (state.rows[lane] == row) {
			state.awake = awake ? state.awake | 1u << lane : state.awake & ~(1u << lane);
		}
	}
	if (awake) {
		return;
	}
	SoftBodyData &body = data(row);
	body.touch_memory() = {};
	body.pair_memories().clear();
	std::ranges::fill(body.mutable_velocities(), Vec2{});
	std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	touching_[row].begin_substep();
	touching_[row].measure_extent();
}

} // namespace softbody
