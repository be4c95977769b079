// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t BATCHES_A_TASK = 16;

// Whose state is asked for meanwhile (353,400 bodies in explicit Euler steps on one thread: 47 ns a body with three, 50 with
// six).
constexpr std::size_t BATCHES_AHEAD = 3;

int share_of(const SubstepPlan &plan, int parts) {
	return (plan.substeps + parts - 1) / parts;
}

} // namespace

Simulator::Simulator(WorldData &world, ParallelFor parallel_for) :
		world_(world), parallel_for_(std::move(parallel_for)), bodies_(world),
		sleep_(world, bodies_, surroundings_, joint_solver_), steppers_(MOST_SLICES) {}

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	return plan_substeps(body, dt, world_.has_environment());
}

template <class Work>
void Simulator::for_batches(std::span<const std::uint32_t> batches, const Work &work) {
	run_slices(parallel_for_, batches.size(), BATCHES_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			if (i + BATCHES_AHEAD < end) {
				StatePrefetch prefetch;
				prefetch.add(bodies_.batch(batches[i + BATCHES_AHEAD]));
				prefetch.prefetch_all();
			}
			work(steppers_[task], batches[i]);
		}
	});
}

template <class Before, class After>
void Simulator::advance_batches(std::span<const std::uint32_t> batches, const TimeSlice &slice, const Before &before,
		const After &after) {
	run_slices(parallel_for_, batches.size(), BATCHES_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		BodyStepper &stepper = steppers_[task];
		for (std::size_t i = begin, next = begin; i < end; i = next) {
			const bool are_two = i + 1 < end && bodies_.move_alike_now(batches[i], batches[i + 1]);
			next = i + 1 + std::size_t(are_two);
			StatePrefetch prefetch;
			for (std::size_t k = i; k < next; ++k) {
				if (k + BATCHES_AHEAD < end) {
					prefetch.add(bodies_.batch(batches[k + BATCHES_AHEAD]));
				}
				before(stepper, batches[k]);
			}
			if (are_two) {
				advance_both(stepper, batches[i], batches[i + 1], slice, prefetch);
			} else {
				prefetch.prefetch_all();
				advance(stepper, batches[i], slice);
			}
			for (std::size_t k = i; k < next; ++k) {
				after(stepper, batches[k]);
			}
		}
	});
}

void Simulator::for_stepped(std::uint32_t batch, const auto &work) const {
	const BatchState &state = bodies_.state(batch);
	for (std::uint32_t lane = 0; lane < bodies_.batch(batch).count; ++lane) {
		if (state.stepped() >> lane & 1) {
			work(state.active_indices[lane]);
		}
	}
}

// Other bodies may have pushed it through a thin wall since it last looked at the surroundings.
SweepStarts Simulator::sweep_start(std::uint32_t batch, const TimeSlice &slice) const {
	SweepStarts from{};
	for (std::uint32_t lane = 0; slice.elapsed > 0 && surroundings_.has_colliders() && lane < PACK_WIDTH; ++lane) {
		from[lane] = bodies_.sweep_start(bodies_.state(batch).active_indices[lane]);
	}
	return from;
}

void Simulator::advance(BodyStepper &stepper, std::uint32_t i, const TimeSlice &slice) {
	Batch &batch = bodies_.batch(i);
	const BatchState &state = bodies_.state(i);
	const SweepStarts from = sweep_start(i, slice);
	const std::size_t resets = stepper.counts().non_finite.size();
	if (!state.has_own_plans()) {
		stepper.advance(batch, state.stepped(), state.plan, slice.elapsed, slice.duration,
				share_of(state.plan, slice.parts), from, slice.is_coupled);
	}
	for (std::uint32_t lane = 0; state.has_own_plans() && lane < batch.count; ++lane) {
		const SubstepPlan &own = bodies_.plan_of(state, lane);
		stepper.advance(batch, state.stepped() & 1u << lane, own, slice.elapsed, slice.duration,
				share_of(own, slice.parts), from, slice.is_coupled);
	}
	if (slice.is_coupled && batch.settings->self_collision && stepper.counts().non_finite.size() > resets) {
		bodies_.solver_body(state.active_indices[0]).begin_substep(); // in its rest shape again: no way behind it that could be blocked
	}
	if (slice.is_coupled) {
		measure_extents(i);
	}
}

void Simulator::measure_extents(std::uint32_t batch) {
	for_stepped(batch, [&](std::uint32_t active_index) { bodies_.solver_body(active_index).measure_extent(); });
}

void Simulator::advance_both(BodyStepper &stepper, std::uint32_t a, std::uint32_t b, const TimeSlice &slice,
		StatePrefetch &prefetch) {
	const SubstepPlan &plan = bodies_.state(a).plan;
	std::array<SolverBody *, WIDE_WIDTH> solver_bodies{};
	for (std::size_t lane = 0; slice.is_coupled && lane < PACK_WIDTH; ++lane) {
		solver_bodies[lane] = &bodies_.solver_body(bodies_.state(a).active_indices[lane]);
		solver_bodies[PACK_WIDTH + lane] = &bodies_.solver_body(bodies_.state(b).active_indices[lane]);
	}
	const bool are_measured = stepper.advance_both({ &bodies_.batch(a), &bodies_.batch(b) }, plan, slice.elapsed,
			slice.duration, share_of(plan, slice.parts), { sweep_start(a, slice), sweep_start(b, slice) },
			slice.is_coupled, solver_bodies, prefetch);
	if (slice.is_coupled && !are_measured) {
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
		divide_batches(dt);
	}
	step_free(dt);
	if (!coupled_batches_.empty() || rigid_contacts_.has_bodies()) {
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
		for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
			pair_contacts_.add_body(bodies_.data(active_index).settings());
		}
	}
	joint_solver_.begin_step(world_, bodies_.body_indices(), is_arranged, dt);
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
	free_batches_.clear();
	coupled_batches_.clear();
	beside_dynamic_.clear();
	sleep_.wake_by_environment();
	while (joint_solver_.wake_joined()) {
		sleep_.take_over();
	}
}

void Simulator::find_rigid_contacts(Real dt) {
	rigid_contacts_.begin_step(world_, surroundings_);
	rigid_contact_count_ = 0;
	rigid_neighbors_.find(bodies_, world_, surroundings_, sleep_.sleepers().flags(), dt, parallel_for_);
	if (!rigid_neighbors_.has_any()) {
		return;
	}
	sleep_.take_over();
	rigid_neighbors_.report_sleepers(bodies_, world_, sleep_.sleepers().flags());
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		SoftBodyData &body = bodies_.data(active_index);
		if (rigid_neighbors_.has(active_index) && body.is_frozen()) { // it is in no batch that is stepped
			rigid_contacts_.add_body(body);
			beside_dynamic_.push_back(active_index);
		}
	}
}

// Which bodies take contact substeps: those that may touch another or a dynamic rigid body, or are joined to something.
void Simulator::divide_batches(Real dt) {
	pair_contacts_.begin_step(pair_bodies(), dt, bodies_.version(), joint_solver_.separated(), parallel_for_);
	if (sleep_.sleepers().count() == 0 && !pair_contacts_.is_used() && !rigid_neighbors_.has_any() && !joint_solver_.has_joints()) {
		// Nobody meets anybody: no need to look at each.
		free_batches_.resize(bodies_.batch_count());
		std::iota(free_batches_.begin(), free_batches_.end(), 0u);
		return;
	}
	for (std::uint32_t i = 0; i < bodies_.batch_count(); ++i) {
		BatchState &state = bodies_.state(i);
		if (state.awake == 0) {
			continue;
		}
		state.coupled = 0;
		for (std::uint32_t lane = 0; lane < bodies_.batch(i).count; ++lane) {
			const std::uint32_t active_index = state.active_indices[lane];
			if ((state.awake >> lane & 1) == 0) {
				continue; // or a sleeper would be moved where others of its batch are awake
			}
			const bool has_rigid_body = rigid_neighbors_.has(active_index);
			if (has_rigid_body) {
				rigid_contacts_.add_body(bodies_.data(active_index));
				beside_dynamic_.push_back(active_index);
			}
			const bool is_coupled = has_rigid_body || pair_contacts_.has_pair(active_index) || joint_solver_.holds(active_index);
			state.coupled |= std::uint32_t(is_coupled) << lane;
		}
		(state.coupled != 0 ? coupled_batches_ : free_batches_).push_back(i);
	}
	if (coupled_batches_.empty() && !rigid_contacts_.has_bodies()) {
		return;
	}
	for (std::uint32_t active_index = 0; joint_solver_.has_dynamic_ends() && active_index < bodies_.count(); ++active_index) {
		if (joint_solver_.holds_to_dynamic(active_index)) {
			beside_dynamic_.push_back(active_index);
		}
	}
	contact_substeps_.choose(bodies_, coupled_batches_, { pair_contacts_.pairs(), joint_solver_.joined(), beside_dynamic_ },
			substeps_of_step(world_.contact_substeps(), dt), free_batches_);
}

void Simulator::step_free(Real dt) {
	const auto begin = [&](BodyStepper &stepper, std::uint32_t i) { stepper.begin(bodies_.batch(i), bodies_.state(i).stepped()); };
	advance_batches(free_batches_, { 0, dt, 1, false }, begin, [&](BodyStepper &stepper, std::uint32_t i) {
		const Batch &batch = bodies_.batch(i);
		const std::uint32_t stepped = bodies_.state(i).stepped();
		if (batch.settings->turns_with_body()) {
			stepper.remember_rotations(batch, stepped, stepper.measure_frames(batch));
		}
		stepper.end(batch, stepped);
		if (world_.has_sleeping()) {
			stepper.time_rest(batch, stepped, dt);
		}
	});
}

void Simulator::step_coupled(Real dt) {
	for (const int substeps : contact_substeps_.island_substeps().counts()) {
		step_islands(substeps, dt);
	}
	if (contact_substeps_.of_rigid_bodies() == 0) {
		move_rigid_bodies_alone(dt);
	}
	for (const std::uint32_t i : coupled_batches_) {
		bodies_.state(i).active_mask = contact_substeps_.island_substeps().are_common() ? ALL_LANES : bodies_.state(i).coupled;
	}
	pair_contacts_.end_step(pair_bodies());
	measure_frames();
	resist_rolling_between_bodies();
	for_batches(coupled_batches_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Batch &batch = bodies_.batch(i);
		BatchState &state = bodies_.state(i);
		if (batch.settings->self_collision && surroundings_.has_colliders()) {
			const std::span<const Vec2> outside = bodies_.sweep_start(state.active_indices[0]);
			bodies_.data(state.active_indices[0]).last_valid_hull().assign(outside.begin(), outside.end());
		}
		stepper.check(batch, state.active_mask, dt);
		stepper.end(batch, state.active_mask);
		if (world_.has_sleeping()) {
			stepper.time_rest(batch, state.stepped(), dt);
		}
		state.active_mask = ALL_LANES;
	});
	check_touched_sleepers(dt);
}

// A turn of the islands that take so many contact substeps.
void Simulator::step_islands(int substeps, Real dt) {
	const SubstepGroup group = contact_substeps_.island_substeps().group(substeps);
	group_batches_.clear();
	for (const std::uint32_t i : coupled_batches_) {
		BatchState &state = bodies_.state(i);
		state.active_mask = 0;
		for (std::uint32_t lane = 0; lane < bodies_.batch(i).count; ++lane) {
			state.active_mask |= std::uint32_t(group.has(state.active_indices[lane])) << lane;
		}
		if (state.stepped() != 0) {
			group_batches_.push_back(i);
		}
	}
	const bool moves_rigid_bodies = substeps == contact_substeps_.of_rigid_bodies();
	const Real duration = dt / Real(substeps);
	pair_contacts_.begin_substeps(duration);
	for (int substep = 0; substep < substeps; ++substep) {
		if (moves_rigid_bodies) {
			rigid_contacts_.begin_substep(duration);
		}
		joint_solver_.begin_substep(group);
		const auto begin = [&](BodyStepper &stepper, std::uint32_t i) {
			if (substep == 0) {
				stepper.begin(bodies_.batch(i), bodies_.state(i).stepped());
			}
			for_stepped(i, [&](std::uint32_t active_index) { bodies_.solver_body(active_index).begin_substep(); });
		};
		const TimeSlice slice{ Real(substep) * duration, duration, substeps, true };
		advance_batches(group_batches_, slice, begin, [&](BodyStepper &, std::uint32_t i) {
			if (surroundings_.has_colliders()) {
				for_stepped(i, [&](std::uint32_t active_index) {
					std::ranges::copy(bodies_.solver_body(active_index).hull(), bodies_.sweep_start(active_index).begin());
				});
			}
		});
		pair_contacts_.solve(pair_bodies(), group, parallel_for_);
		joint_solver_.solve(Real(substep + 1) * duration, duration, group);
		if (moves_rigid_bodies && rigid_contacts_.has_bodies()) {
			rigid_contact_count_ += rigid_contacts_.solve(parallel_for_);
		}
		solve_self_contacts(duration);
	}
}

// Who sleeps is not stepped, but what has blown up may have touched it.
void Simulator::check_touched_sleepers(Real dt) {
	for (std::uint32_t i = 0; sleep_.sleepers().count() > 0 && i < bodies_.batch_count(); ++i) {
		const BatchState &state = bodies_.state(i);
		std::uint32_t touched = 0;
		for (std::uint32_t lane = 0; lane < bodies_.batch(i).count; ++lane) {
			const bool is_touched = (state.awake >> lane & 1) == 0 && pair_contacts_.has_pair(state.active_indices[lane]);
			touched |= std::uint32_t(is_touched) << lane;
		}
		if (touched != 0) {
			steppers_[0].check(bodies_.batch(i), touched, dt);
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
	for_batches(coupled_batches_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Batch &batch = bodies_.batch(i);
		if (!pair_contacts_.resists_rolling() && !batch.settings->turns_with_body()) {
			return;
		}
		const std::array<BodyFrame, PACK_WIDTH> frames = stepper.measure_frames(batch);
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			bodies_.solver_body(bodies_.state(i).active_indices[lane]).take_frame(frames[lane]);
		}
		if (batch.settings->turns_with_body()) {
			stepper.remember_rotations(batch, bodies_.state(i).active_mask, frames);
		}
	});
}

// Last of all, as all others may press a hull against itself. A body that meets itself is a batch of its own.
void Simulator::solve_self_contacts(Real h) {
	if (!bodies_.meet_themselves()) {
		return;
	}
	for_batches(group_batches_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Batch &batch = bodies_.batch(i);
		if (batch.settings->self_collision) {
			stepper.solve_self_contacts(batch.bodies[0], bodies_.solver_body(bodies_.state(i).active_indices[0]).before, h);
		}
	});
}

// Once a step, with the impulses of all its substeps: spins change little within one.
void Simulator::resist_rolling_between_bodies() {
	if (!pair_contacts_.resists_rolling() || !pair_contacts_.is_used()) {
		return;
	}
	pair_contacts_.resist_rolling(pair_bodies());
	for_batches(coupled_batches_, [&](BodyStepper &, std::uint32_t i) {
		for (std::uint32_t lane = 0; lane < bodies_.batch(i).count; ++lane) {
			bodies_.solver_body(bodies_.state(i).active_indices[lane]).apply_spin_change();
		}
	});
}

void Simulator::let_sleep() {
	joined_.assign(joint_solver_.joined().begin(), joint_solver_.joined().end());
	rigid_neighbors_.add_linked(joined_);
	sleep_.let_sleep(pair_contacts_.pairs(), pair_contacts_.touched(), joined_, rigid_neighbors_.restless());
}

// Before anything falls asleep or wakes: what slept during the step has found no contact and yet lost no touch.
void Simulator::report_contacts(Real dt) {
	for (BodyStepper &stepper : steppers_) {
		contact_monitor_.add(stepper.log());
	}
	for (PairContactSolver &handling : pair_contacts_.solvers()) {
		contact_monitor_.add(handling.log());
	}
	contact_monitor_.add(rigid_contacts_.log());
	contact_monitor_.end_step(surroundings_, dt);
}

void Simulator::collect(StepReport &report) {
	report.sleeping_bodies = sleep_.sleepers().count() - bodies_.frozen_count();
	for (const std::uint32_t body_index : bodies_.inactive_bodies()) {
		SoftBodyData &body = world_.soft_bodies()[body_index];
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
	for (const std::uint32_t body_index : non_finite) {
		report.reset_bodies.push_back(world_.id_at(body_index));
		SoftBodyData &body = world_.soft_bodies()[body_index];
		if (body.settings().failure_response == FailureResponse::FREEZE) {
			body.set_frozen(true);
		}
	}
}

} // namespace softbody
