// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t CREWS_A_TASK = 16;

// Whose state is asked for meanwhile (353,400 bodies in explicit Euler steps on one thread: 47 ns a body with three, 50 with
// six).
constexpr std::size_t CREWS_AHEAD = 3;

int share_of(const SubstepPlan &plan, int parts) {
	return (plan.substeps + parts - 1) / parts;
}

} // namespace

Simulator::Simulator(WorldData &world, ParallelFor parallel_for) :
		world_(world), parallel_for_(std::move(parallel_for)), bodies_(world),
		sleep_(world, bodies_, surroundings_, joint_solver_), steppers_(MOST_SLICES) {}

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	return plan_substeps(body, dt, world_.has_surroundings());
}

template <class Work>
void Simulator::for_crews(std::span<const std::uint32_t> crews, const Work &work) {
	run_slices(parallel_for_, crews.size(), CREWS_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			if (i + CREWS_AHEAD < end) {
				StateAhead ahead;
				ahead.add(bodies_.crew(crews[i + CREWS_AHEAD]));
				ahead.ask_all();
			}
			work(steppers_[task], crews[i]);
		}
	});
}

template <class Before, class After>
void Simulator::advance_crews(std::span<const std::uint32_t> crews, const Stretch &stretch, const Before &before,
		const After &after) {
	run_slices(parallel_for_, crews.size(), CREWS_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		BodyStepper &stepper = steppers_[task];
		for (std::size_t i = begin, next = begin; i < end; i = next) {
			const bool are_two = i + 1 < end && bodies_.move_alike_now(crews[i], crews[i + 1]);
			next = i + 1 + std::size_t(are_two);
			StateAhead ahead;
			for (std::size_t k = i; k < next; ++k) {
				if (k + CREWS_AHEAD < end) {
					ahead.add(bodies_.crew(crews[k + CREWS_AHEAD]));
				}
				before(stepper, crews[k]);
			}
			if (are_two) {
				advance_both(stepper, crews[i], crews[i + 1], stretch, ahead);
			} else {
				ahead.ask_all();
				advance(stepper, crews[i], stretch);
			}
			for (std::size_t k = i; k < next; ++k) {
				after(stepper, crews[k]);
			}
		}
	});
}

void Simulator::for_stepped(std::uint32_t crew, const auto &work) const {
	const CrewState &state = bodies_.state(crew);
	for (std::uint32_t lane = 0; lane < bodies_.crew(crew).count; ++lane) {
		if (state.stepped() >> lane & 1) {
			work(state.rows[lane]);
		}
	}
}

// Other bodies may have pushed it through a thin wall since it last looked at the surroundings.
SweptFrom Simulator::swept_from(std::uint32_t crew, const Stretch &stretch) const {
	SweptFrom from{};
	for (std::uint32_t lane = 0; stretch.elapsed > 0 && surroundings_.has_colliders() && lane < PACK_WIDTH; ++lane) {
		from[lane] = bodies_.swept_from(bodies_.state(crew).rows[lane]);
	}
	return from;
}

void Simulator::advance(BodyStepper &stepper, std::uint32_t i, const Stretch &stretch) {
	Crew &crew = bodies_.crew(i);
	const CrewState &state = bodies_.state(i);
	const SweptFrom from = swept_from(i, stretch);
	const std::size_t resets = stepper.counts().non_finite.size();
	if (!state.has_own_plans()) {
		stepper.advance(crew, state.stepped(), state.plan, stretch.elapsed, stretch.duration,
				share_of(state.plan, stretch.parts), from, stretch.is_coupled);
	}
	for (std::uint32_t lane = 0; state.has_own_plans() && lane < crew.count; ++lane) {
		const SubstepPlan &own = bodies_.plan_of(state, lane);
		stepper.advance(crew, state.stepped() & 1u << lane, own, stretch.elapsed, stretch.duration,
				share_of(own, stretch.parts), from, stretch.is_coupled);
	}
	if (stretch.is_coupled && crew.settings->self_collision && stepper.counts().non_finite.size() > resets) {
		bodies_.touching(state.rows[0]).begin_substep(); // in its rest shape again: no way behind it that could be blocked
	}
	if (stretch.is_coupled) {
		measure_extents(i);
	}
}

void Simulator::measure_extents(std::uint32_t crew) {
	for_stepped(crew, [&](std::uint32_t row) { bodies_.touching(row).measure_extent(); });
}

void Simulator::advance_both(BodyStepper &stepper, std::uint32_t a, std::uint32_t b, const Stretch &stretch,
		StateAhead &ahead) {
	const SubstepPlan &plan = bodies_.state(a).plan;
	std::array<TouchingBody *, WIDE_WIDTH> touching{};
	for (std::size_t lane = 0; stretch.is_coupled && lane < PACK_WIDTH; ++lane) {
		touching[lane] = &bodies_.touching(bodies_.state(a).rows[lane]);
		touching[PACK_WIDTH + lane] = &bodies_.touching(bodies_.state(b).rows[lane]);
	}
	const bool are_measured = stepper.advance_both({ &bodies_.crew(a), &bodies_.crew(b) }, plan, stretch.elapsed,
			stretch.duration, share_of(plan, stretch.parts), { swept_from(a, stretch), swept_from(b, stretch) },
			stretch.is_coupled, touching, ahead);
	if (stretch.is_coupled && !are_measured) {
		measure_extents(a);
		measure_extents(b);
	}
}

StepReport Simulator::simulate(Real dt) {
	StepReport report;
	contact_monitor_.begin_step();
	report.refused = check_above("dt", dt, 0, "s");
	if (report.refused) {
		return report;
	}
	begin_step(dt);
	find_rigid_contacts(dt);
	if (!sleep_.sleepers().is_everybody() || rigid_contacts_.has_bodies()) {
		bodies_.plan_pressure(dt);
		divide_crews(dt);
	}
	step_free(dt);
	if (!coupled_crews_.empty() || rigid_contacts_.has_bodies()) {
		step_coupled(dt);
	} else {
		move_rigid_bodies_alone(dt);
	}
	rigid_contacts_.end_step(dt);
	pin_motion_.end_step(world_);
	joint_solver_.end_step(report.broken_joints);
	if (bodies_.has_monitored() || contact_monitor_.has_touches()) {
		report_contacts(dt);
	}
	if (world_.has_sleeping()) {
		let_sleep();
	}
	collect(report);
	return report;
}

void Simulator::begin_step(Real dt) {
	const std::uint64_t old_version = bodies_.version();
	surroundings_.update(world_, dt);
	const bool is_arranged = bodies_.update(dt);
	if (is_arranged) {
		pair_contacts_.begin_arranging();
		for (std::uint32_t row = 0; row < bodies_.count(); ++row) {
			pair_contacts_.add_body(bodies_.data(row).settings());
		}
	}
	joint_solver_.begin_step(world_, bodies_.places(), is_arranged, dt);
	sleep_.begin_step(is_arranged);
	// Bodies that came or were activated may have brought forces along.
	const bool is_rearranged = bodies_.version() != old_version;
	const bool has_forces = std::exchange(seen_forces_, world_.change_counts().forces) != seen_forces_ || is_rearranged;
	if (has_forces) {
		has_accelerated_bodies_ = std::ranges::any_of(world_.soft_bodies(),
				[](const SoftBodyData &body) { return body.acceleration() != Vec2{}; });
	}
	pin_motion_.begin_step(world_, dt, is_rearranged);
	for (BodyStepper &stepper : steppers_) {
		stepper.begin_step(world_, surroundings_, has_forces || has_accelerated_bodies_);
	}
	pair_contacts_.forget_step();
	free_crews_.clear();
	coupled_crews_.clear();
	beside_dynamic_.clear();
	sleep_.wake_by_surroundings();
	while (joint_solver_.wake_joined()) {
		sleep_.take_over();
	}
}

void Simulator::find_rigid_contacts(Real dt) {
	rigid_contacts_.begin_step(world_, surroundings_);
	rigid_contact_count_ = 0;
	rigid_neighbours_.find(bodies_, world_, surroundings_, sleep_.sleepers().flags(), dt, parallel_for_);
	if (!rigid_neighbours_.has_any()) {
		return;
	}
	sleep_.take_over();
	rigid_neighbours_.report_sleepers(bodies_, world_, sleep_.sleepers().flags());
	for (std::uint32_t row = 0; row < bodies_.count(); ++row) {
		SoftBodyData &body = bodies_.data(row);
		if (rigid_neighbours_.has(row) && body.is_frozen()) { // it is in no crew that is stepped
			rigid_contacts_.add_body(body);
			beside_dynamic_.push_back(row);
		}
	}
}

// Which bodies take contact substeps: those that may touch another or a dynamic rigid body, or are joined to something.
void Simulator::divide_crews(Real dt) {
	pair_contacts_.begin_step(pair_bodies(), dt, bodies_.version(), joint_solver_.separated(), parallel_for_);
	if (sleep_.sleepers().count() == 0 && !pair_contacts_.is_used() && !rigid_neighbours_.has_any() && !joint_solver_.has_joints()) {
		// Nobody meets anybody: no need to look at each.
		free_crews_.resize(bodies_.crew_count());
		std::iota(free_crews_.begin(), free_crews_.end(), 0u);
		return;
	}
	for (std::uint32_t i = 0; i < bodies_.crew_count(); ++i) {
		CrewState &state = bodies_.state(i);
		if (state.awake == 0) {
			continue;
		}
		state.coupled = 0;
		for (std::uint32_t lane = 0; lane < bodies_.crew(i).count; ++lane) {
			const std::uint32_t row = state.rows[lane];
			if ((state.awake >> lane & 1) == 0) {
				continue; // or a sleeper would be moved where others of its crew are awake
			}
			const bool has_rigid_body = rigid_neighbours_.has(row);
			if (has_rigid_body) {
				rigid_contacts_.add_body(bodies_.data(row));
				beside_dynamic_.push_back(row);
			}
			const bool is_coupled = has_rigid_body || pair_contacts_.has_pair(row) || joint_solver_.holds(row);
			state.coupled |= std::uint32_t(is_coupled) << lane;
		}
		(state.coupled != 0 ? coupled_crews_ : free_crews_).push_back(i);
	}
	if (coupled_crews_.empty() && !rigid_contacts_.has_bodies()) {
		return;
	}
	for (std::uint32_t row = 0; joint_solver_.has_dynamic_ends() && row < bodies_.count(); ++row) {
		if (joint_solver_.holds_to_dynamic(row)) {
			beside_dynamic_.push_back(row);
		}
	}
	contact_substeps_.choose(bodies_, coupled_crews_, { pair_contacts_.pairs(), joint_solver_.joined(), beside_dynamic_ },
			substeps_of_step(world_.contact_substeps(), dt), free_crews_);
}

void Simulator::step_free(Real dt) {
	const auto begin = [&](BodyStepper &stepper, std::uint32_t i) { stepper.begin(bodies_.crew(i), bodies_.state(i).stepped()); };
	advance_crews(free_crews_, { 0, dt, 1, false }, begin, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = bodies_.crew(i);
		const std::uint32_t stepped = bodies_.state(i).stepped();
		if (crew.settings->turns_with_body()) {
			stepper.remember_rotations(crew, stepped, stepper.measure_frames(crew));
		}
		stepper.end(crew, stepped);
		if (world_.has_sleeping()) {
			stepper.time_rest(crew, stepped, dt);
		}
	});
}

void Simulator::step_coupled(Real dt) {
	for (const int substeps : contact_substeps_.heaps().counts()) {
		step_heaps(substeps, dt);
	}
	if (contact_substeps_.of_rigid_bodies() == 0) {
		move_rigid_bodies_alone(dt);
	}
	for (const std::uint32_t i : coupled_crews_) {
		bodies_.state(i).turn = contact_substeps_.heaps().are_common() ? ALL_LANES : bodies_.state(i).coupled;
	}
	pair_contacts_.end_step(pair_bodies());
	measure_frames();
	resist_rolling_between_bodies();
	for_crews(coupled_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = bodies_.crew(i);
		CrewState &state = bodies_.state(i);
		if (crew.settings->self_collision && surroundings_.has_colliders()) {
			const std::span<const Vec2> outside = bodies_.swept_from(state.rows[0]);
			bodies_.data(state.rows[0]).outside_hull().assign(outside.begin(), outside.end());
		}
		stepper.check(crew, state.turn, dt);
		stepper.end(crew, state.turn);
		if (world_.has_sleeping()) {
			stepper.time_rest(crew, state.stepped(), dt);
		}
		state.turn = ALL_LANES;
	});
	check_touched_sleepers(dt);
}

// A turn of the heaps that take so many contact substeps.
void Simulator::step_heaps(int substeps, Real dt) {
	const HeapTurn turn = contact_substeps_.heaps().turn(substeps);
	turn_crews_.clear();
	for (const std::uint32_t i : coupled_crews_) {
		CrewState &state = bodies_.state(i);
		state.turn = 0;
		for (std::uint32_t lane = 0; lane < bodies_.crew(i).count; ++lane) {
			state.turn |= std::uint32_t(turn.has(state.rows[lane])) << lane;
		}
		if (state.stepped() != 0) {
			turn_crews_.push_back(i);
		}
	}
	const bool moves_rigid_bodies = substeps == contact_substeps_.of_rigid_bodies();
	const Real duration = dt / Real(substeps);
	pair_contacts_.begin_substeps(pair_bodies(), duration);
	for (int substep = 0; substep < substeps; ++substep) {
		if (moves_rigid_bodies) {
			rigid_contacts_.begin_substep(duration);
		}
		joint_solver_.begin_substep(turn);
		const auto begin = [&](BodyStepper &stepper, std::uint32_t i) {
			if (substep == 0) {
				stepper.begin(bodies_.crew(i), bodies_.state(i).stepped());
			}
			for_stepped(i, [&](std::uint32_t row) { bodies_.touching(row).begin_substep(); });
		};
		const Stretch stretch{ Real(substep) * duration, duration, substeps, true };
		advance_crews(turn_crews_, stretch, begin, [&](BodyStepper &, std::uint32_t i) {
			if (surroundings_.has_colliders()) {
				for_stepped(i, [&](std::uint32_t row) {
					std::ranges::copy(bodies_.touching(row).hull(), bodies_.swept_from(row).begin());
				});
			}
		});
		pair_contacts_.answer(pair_bodies(), turn, parallel_for_);
		joint_solver_.solve(Real(substep + 1) * duration, duration, turn);
		if (moves_rigid_bodies && rigid_contacts_.has_bodies()) {
			rigid_contact_count_ += rigid_contacts_.answer(parallel_for_);
		}
		answer_self_contacts(duration);
	}
}

// Who sleeps is not stepped, but what has blown up may have touched it.
void Simulator::check_touched_sleepers(Real dt) {
	for (std::uint32_t i = 0; sleep_.sleepers().count() > 0 && i < bodies_.crew_count(); ++i) {
		const CrewState &state = bodies_.state(i);
		std::uint32_t touched = 0;
		for (std::uint32_t lane = 0; lane < bodies_.crew(i).count; ++lane) {
			const bool is_touched = (state.awake >> lane & 1) == 0 && pair_contacts_.has_pair(state.rows[lane]);
			touched |= std::uint32_t(is_touched) << lane;
		}
		if (touched != 0) {
			steppers_[0].check(bodies_.crew(i), touched, dt);
		}
	}
}

// As they would among soft bodies, so that their fall does not depend on whether one is near.
void Simulator::move_rigid_bodies_alone(Real dt) {
	const int contact_substeps = substeps_of_step(world_.contact_substeps(), dt);
	for (int substep = 0; substep < contact_substeps; ++substep) {
		rigid_contacts_.begin_substep(dt / Real(contact_substeps));
	}
}

void Simulator::measure_frames() {
	for_crews(coupled_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = bodies_.crew(i);
		if (!pair_contacts_.resists_rolling() && !crew.settings->turns_with_body()) {
			return;
		}
		const std::array<BodyFrame, PACK_WIDTH> frames = stepper.measure_frames(crew);
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			bodies_.touching(bodies_.state(i).rows[lane]).take_frame(frames[lane]);
		}
		if (crew.settings->turns_with_body()) {
			stepper.remember_rotations(crew, bodies_.state(i).turn, frames);
		}
	});
}

// Last of all, as all others may press a hull against itself. A body that meets itself is a crew of its own.
void Simulator::answer_self_contacts(Real h) {
	if (!bodies_.meet_themselves()) {
		return;
	}
	for_crews(turn_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = bodies_.crew(i);
		if (crew.settings->self_collision) {
			stepper.answer_self_contacts(crew.bodies[0], bodies_.touching(bodies_.state(i).rows[0]).before, h);
		}
	});
}

// Once a step, with the impulses of all its substeps: spins change little within one.
void Simulator::resist_rolling_between_bodies() {
	if (!pair_contacts_.resists_rolling() || !pair_contacts_.is_used()) {
		return;
	}
	pair_contacts_.resist_rolling(pair_bodies());
	for_crews(coupled_crews_, [&](BodyStepper &, std::uint32_t i) {
		for (std::uint32_t lane = 0; lane < bodies_.crew(i).count; ++lane) {
			bodies_.touching(bodies_.state(i).rows[lane]).apply_spin_change();
		}
	});
}

void Simulator::let_sleep() {
	joined_.assign(joint_solver_.joined().begin(), joint_solver_.joined().end());
	rigid_neighbours_.add_linked(joined_);
	sleep_.let_sleep(pair_contacts_.pairs(), pair_contacts_.touched(), joined_, rigid_neighbours_.restless());
}

// Before anything falls asleep or wakes: what slept during the step has found no contact and yet lost no touch.
void Simulator::report_contacts(Real dt) {
	for (BodyStepper &stepper : steppers_) {
		contact_monitor_.add(stepper.log());
	}
	for (PairHandling &handling : pair_contacts_.handlings()) {
		contact_monitor_.add(handling.log());
	}
	contact_monitor_.add(rigid_contacts_.log());
	contact_monitor_.end_step(surroundings_, dt);
}

void Simulator::collect(StepReport &report) {
	report.sleeping_bodies = sleep_.sleepers().count() - bodies_.frozen_count();
	for (const std::uint32_t place : bodies_.inactive_places()) {
		SoftBodyData &body = world_.soft_bodies()[place];
		std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	}
	report.pair_contacts = pair_contacts_.contact_count();
	report.contacts += rigid_contact_count_;
	std::vector<std::uint32_t> non_finite;
	for (BodyStepper &stepper : steppers_) {
		const StepCounts &counts = stepper.counts();
		report.substeps += counts.substeps;
		report.contacts += counts.contacts;
		report.self_contacts += counts.self_contacts;
		non_finite.insert(non_finite.end(), counts.non_finite.begin(), counts.non_finite.end());
	}
	std::ranges::sort(non_finite);
	non_finite.erase(std::unique(non_finite.begin(), non_finite.end()), non_finite.end());
	for (const std::uint32_t place : non_finite) {
		report.reset_bodies.push_back(world_.id_at(place));
		SoftBodyData &body = world_.soft_bodies()[place];
		if (body.settings().failure_response == FailureResponse::FREEZE) {
			body.set_frozen(true);
		}
	}
}

} // namespace softbody
