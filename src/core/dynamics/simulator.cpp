// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace softbody {

namespace {

// Tasks get multiples of WIDE_WIDTH bodies, so that few bodies are left over for narrower batches.
constexpr std::size_t UNITS_A_TASK = 2;

// Number of bodies by which the state is prefetched ahead.
constexpr std::size_t BODIES_AHEAD = 12;

} // namespace

Simulator::Simulator(WorldData &world, ParallelFor parallel_for, Clock clock) :
		world_(world), parallel_for_(std::move(parallel_for)), clock_(std::move(clock)), bodies_(world),
		sleep_(world, bodies_, surroundings_, joint_solver_), steppers_(MOST_SLICES) {}

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	return plan_substeps(body, dt, world_.has_environment());
}

template <class Work>
void Simulator::for_batches(std::span<const std::uint32_t> list, int parts, const Work &work) {
	const std::size_t units = (list.size() + WIDE_WIDTH - 1) / WIDE_WIDTH;
	run_slices(parallel_for_, units, UNITS_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		const std::size_t last = std::min(end * WIDE_WIDTH, list.size());
		for (std::size_t at = begin * WIDE_WIDTH; at < last;) {
			const Batch batch = bodies_.batch_at(list.subspan(at, std::min(last - at, steppers_[task].width())), parts);
			StatePrefetch prefetch;
			if (at + BODIES_AHEAD < last) {
				bodies_.prefetch(list.subspan(at + BODIES_AHEAD, last - at - BODIES_AHEAD), batch.count, prefetch);
			}
			work(steppers_[task], batch, prefetch);
			prefetch.ask_all();
			at += batch.count;
		}
	});
}

StepReport Simulator::simulate(Real dt) {
	StepReport report;
	contact_monitor_.begin_step();
	report.refused = check_above("dt", dt, 0, "s");
	if (report.refused) {
		return report;
	}
	profile_ = {};
	timer_.start();
	begin_step(dt);
	find_rigid_contacts(dt);
	timer_.lap(profile_.begin);
	if (!bodies_.awake().empty() || rigid_contacts_.has_bodies()) {
		bodies_.plan_pressure(dt);
		bodies_.plan_near_rest_shapes(bodies_.awake(), parallel_for_);
		divide_bodies(dt);
	}
	timer_.lap(profile_.broad_phase);
	const bool bounces = may_bounce();
	if (bounces) {
		bounce_ledger_.begin_step(bodies_, world_.gravity(), parallel_for_);
	}
	fly(dt);
	step_free(dt);
	timer_.lap(profile_.bodies);
	const bool are_coupled = !coupled_.empty() || rigid_contacts_.has_bodies();
	if (are_coupled) {
		step_coupled(dt);
	} else {
		move_rigid_bodies_alone(dt);
	}
	rigid_contacts_.end_step(dt);
	if (bounces) {
		bounce_ledger_.end_step(pair_contacts_.pairs(), pair_contacts_.touches(), joint_solver_.joined(), dt, parallel_for_);
	}
	if (are_coupled) {
		pair_contacts_.end_step(pair_bodies()); // remembers what the ledger has left unpaid
	}
	pin_motion_.end_step(world_);
	joint_solver_.end_step(report.broken_joints);
	if (bodies_.has_monitored() || contact_monitor_.has_touches()) {
		report_contacts(dt);
	}
	if (world_.has_sleeping()) {
		let_sleep();
	}
	collect(report);
	if (reports_islands_) {
		for (std::uint32_t i = 0; i < flown_.size(); ++i) { // alone as those that were stepped in full
			if (flown_[i] != 0) {
				free_.push_back(i);
			}
		}
		report.islands = report_islands({ world_, bodies_, free_, coupled_, contact_substeps_.island_substeps(), pair_contacts_.pairs(),
				pair_contacts_.touched(), joint_solver_.joined(), beside_dynamic_ });
	}
	timer_.lap(profile_.end);
	report.profile = profile_;
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
	// Bodies that were added or activated may have external forces.
	const bool is_rearranged = bodies_.version() != old_version;
	const bool has_forces = std::exchange(seen_forces_, world_.change_counts().forces) != seen_forces_ || is_rearranged;
	if (has_forces) {
		has_accelerated_bodies_ = std::ranges::any_of(world_.soft_bodies(),
				[](const SoftBodyData &body) { return body.acceleration() != Vec2{}; });
	}
	pin_motion_.begin_step(world_, dt, is_rearranged);
	// A body that was put back may bring a hull from a step in which there were colliders.
	had_colliders_ |= std::exchange(seen_restores_, world_.change_counts().restores) != seen_restores_;
	if (std::exchange(had_colliders_, surroundings_.has_colliders()) && !had_colliders_) {
		for (SoftBodyData &body : world_.soft_bodies()) {
			body.last_valid_hull().clear(); // it would say nothing of colliders that come later
		}
	}
	const bool borders_bounce =
			std::ranges::any_of(world_.borders(), [](const Border &border) { return border.surface.restitution != 0; });
	for (BodyStepper &stepper : steppers_) {
		stepper.begin_step({ world_, surroundings_, bodies_, joint_solver_, has_forces || has_accelerated_bodies_, borders_bounce,
				pair_contacts_.bounces() });
	}
	pair_contacts_.forget_step();
	free_.clear();
	coupled_.clear();
	beside_dynamic_.clear();
	sleep_.wake_by_environment();
	while (joint_solver_.wake_joined()) {
		sleep_.take_over();
	}
}

void Simulator::find_rigid_contacts(Real dt) {
	rigid_contacts_.begin_step(world_, surroundings_);
	rigid_contact_count_ = 0;
	rigid_neighbors_.find(bodies_, world_, surroundings_, dt, parallel_for_);
	if (!rigid_neighbors_.has_any()) {
		return;
	}
	sleep_.take_over();
	rigid_neighbors_.report_sleepers(bodies_, world_);
	for (std::uint32_t active_index = 0; active_index < bodies_.count(); ++active_index) {
		SoftBodyData &body = bodies_.data(active_index);
		if (rigid_neighbors_.has(active_index) && body.is_frozen()) { // a frozen body is not stepped
			rigid_contacts_.add_body(body, rigid_neighbors_.surroundings_of(active_index));
			beside_dynamic_.push_back(active_index);
		}
	}
}

// Bodies take contact substeps if they may touch another or a dynamic rigid body, or if a joint holds them.
void Simulator::divide_bodies(Real dt) {
	pair_contacts_.begin_step(pair_bodies(), dt, bodies_.version(), joint_solver_.separated(), parallel_for_);
	const std::span<const std::uint32_t> awake = bodies_.awake();
	if (!pair_contacts_.is_used() && !rigid_neighbors_.has_any() && !joint_solver_.has_joints()) {
		free_.assign(awake.begin(), awake.end()); // no body meets another, so none needs a test
		return;
	}
	for (std::uint32_t i = 0; rigid_neighbors_.has_any() && i < bodies_.count(); ++i) { // in the order in which contacts are solved
		if (rigid_neighbors_.has(i) && !bodies_.is_resting(i)) {
			rigid_contacts_.add_body(bodies_.data(i), rigid_neighbors_.surroundings_of(i));
			beside_dynamic_.push_back(i);
		}
	}
	for (const std::uint32_t i : awake) {
		const bool is_coupled = rigid_neighbors_.has(i) || pair_contacts_.has_pair(i) || joint_solver_.holds(i);
		(is_coupled ? coupled_ : free_).push_back(i);
	}
	if (coupled_.empty() && !rigid_contacts_.has_bodies()) {
		return;
	}
	for (std::uint32_t i = 0; joint_solver_.has_dynamic_ends() && i < bodies_.count(); ++i) {
		if (joint_solver_.holds_to_dynamic(i)) {
			beside_dynamic_.push_back(i);
		}
	}
	contact_substeps_.choose(bodies_, coupled_, { pair_contacts_.pairs(), joint_solver_.joined(), beside_dynamic_ },
			substeps_of_step(world_.contact_substeps(), dt));
}

// A bounce goes on after its surface has gone.
bool Simulator::may_bounce() {
	const std::vector<Border> &borders = world_.borders();
	return pair_contacts_.bounces() || surroundings_.bounces() ||
			std::ranges::any_of(borders, [](const Border &border) { return border.surface.restitution != 0; }) ||
			std::ranges::any_of(bodies_.awake(), [&](std::uint32_t i) { return bodies_.has_touch(i) != 0; });
}

// Bodies that fly leave the list; the order of the others, and so what shares a batch, stays.
void Simulator::fly(Real dt) {
	flown_.clear();
	if (!world_.has_rigid_flight() || free_.empty()) {
		return;
	}
	flown_.assign(bodies_.count(), 0);
	for_batches(free_, 1, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &) {
		const std::uint32_t flown = stepper.fly(batch, dt);
		for (std::uint32_t lane = 0; flown != 0 && lane < batch.count; ++lane) {
			flown_[batch.active_indices[lane]] = char(flown >> lane & 1);
		}
	});
	std::erase_if(free_, [&](std::uint32_t i) { return flown_[i] != 0; });
}

bool Simulator::has_flown(BodyId id) const {
	const SoftBodyData *body = world_.find(id);
	if (body == nullptr || flown_.empty()) {
		return false;
	}
	const std::uint32_t body_index = std::uint32_t(body - world_.soft_bodies().data());
	const auto found = std::ranges::lower_bound(bodies_.body_indices(), body_index);
	const std::size_t active_index = std::size_t(found - bodies_.body_indices().begin());
	return active_index < flown_.size() && *found == body_index && flown_[active_index] != 0;
}

void Simulator::step_free(Real dt) {
	for_batches(free_, 1, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &prefetch) {
		stepper.begin(batch);
		stepper.advance(batch, { 0, dt, 1, false }, prefetch);
		stepper.forget_pushes(batch);
		if (batch.settings->turns_with_body()) {
			stepper.remember_rotations(batch, stepper.measure_frames(batch));
		}
		stepper.end(batch);
		if (world_.has_sleeping()) {
			stepper.time_rest(batch, dt);
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
	measure_frames();
	resist_rolling_between_bodies();
	for_batches(coupled_, MAX_SUBSTEPS, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &) {
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			if (surroundings_.has_colliders()) {
				const std::span<const Vec2> outside = bodies_.sweep_start(batch.active_indices[lane]);
				bodies_.data(batch.active_indices[lane]).last_valid_hull().assign(outside.begin(), outside.end());
			}
			stepper.check(batch.body_indices[lane], dt);
		}
		stepper.end(batch);
		if (world_.has_sleeping()) {
			stepper.time_rest(batch, dt);
		}
	});
	check_touched_sleepers(dt);
	timer_.lap(profile_.bodies);
}

// Steps the islands that take `substeps` contact substeps.
void Simulator::step_islands(int substeps, Real dt) {
	const SubstepGroup group = contact_substeps_.island_substeps().group(substeps);
	group_.clear();
	std::ranges::copy_if(coupled_, std::back_inserter(group_), [&](std::uint32_t i) { return group.has(i); });
	const bool moves_rigid_bodies = substeps == contact_substeps_.of_rigid_bodies();
	const Real duration = dt / Real(substeps);
	pair_contacts_.begin_substeps(duration);
	for (int substep = 0; substep < substeps; ++substep) {
		if (moves_rigid_bodies) {
			rigid_contacts_.begin_substep(duration);
		}
		joint_solver_.begin_substep(group);
		steppers_[0].counts().contacts += joint_solver_.solve_chains(surroundings_, Real(substep) * duration, duration, group, steppers_[0].log());
		const TimeSlice slice{ Real(substep) * duration, duration, substeps, true };
		for_batches(group_, substeps, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &prefetch) {
			if (substep == 0) {
				stepper.begin(batch);
			}
			for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
				SolverBody &body = bodies_.solver_body(batch.active_indices[lane]);
				if (substep == 0) {
					body.begin_step();
				} else {
					body.begin_substep();
				}
			}
			stepper.advance(batch, slice, prefetch);
			for (std::uint32_t lane = 0; surroundings_.has_colliders() && lane < batch.count; ++lane) {
				const std::uint32_t i = batch.active_indices[lane];
				std::ranges::copy(bodies_.solver_body(i).hull(), bodies_.sweep_start(i).begin());
			}
		});
		timer_.lap(profile_.bodies);
		pair_contacts_.solve(pair_bodies(), group, substeps - substep - 1, parallel_for_);
		timer_.lap(profile_.pair_contacts);
		joint_solver_.solve(Real(substep + 1) * duration, duration, group);
		if (moves_rigid_bodies && rigid_contacts_.has_bodies()) {
			rigid_contact_count_ += rigid_contacts_.solve(parallel_for_);
		}
		solve_self_contacts(group_, duration);
		timer_.lap(profile_.couplings);
	}
}

// A sleeping body is not stepped, but a body that has failed may have touched it.
void Simulator::check_touched_sleepers(Real dt) {
	for (std::uint32_t i = 0; bodies_.resting_count() > 0 && i < bodies_.count(); ++i) {
		if (bodies_.is_resting(i) && pair_contacts_.has_pair(i)) {
			steppers_[0].check(bodies_.body_indices()[i], dt);
		}
	}
}

// Rigid bodies move in the substeps that they would take near soft bodies. So their fall does not depend on whether a
// soft body is near.
void Simulator::move_rigid_bodies_alone(Real dt) {
	const int contact_substeps = substeps_of_step(world_.contact_substeps(), dt);
	for (int substep = 0; substep < contact_substeps; ++substep) {
		rigid_contacts_.begin_substep(dt / Real(contact_substeps));
	}
}

void Simulator::measure_frames() {
	for_batches(coupled_, MAX_SUBSTEPS, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &) {
		if (!pair_contacts_.resists_rolling() && !batch.settings->turns_with_body()) {
			return;
		}
		const std::array<BodyFrame, WIDE_WIDTH> frames = stepper.measure_frames(batch);
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			bodies_.solver_body(batch.active_indices[lane]).take_frame(frames[lane]);
		}
		if (batch.settings->turns_with_body()) {
			stepper.remember_rotations(batch, frames);
		}
	});
}

// After all other contacts, as those may press a hull against itself.
void Simulator::solve_self_contacts(std::span<const std::uint32_t> list, Real h) {
	if (!bodies_.has_self_collision()) {
		return;
	}
	for_batches(list, MAX_SUBSTEPS, [&](BodyStepper &stepper, const Batch &batch, StatePrefetch &) {
		for (std::uint32_t lane = 0; batch.settings->self_collision && lane < batch.count; ++lane) {
			stepper.solve_self_contacts(batch.active_indices[lane], h);
		}
	});
}

// Once a step, with the impulses of all its substeps: spins change little within a step.
void Simulator::resist_rolling_between_bodies() {
	if (!pair_contacts_.resists_rolling() || !pair_contacts_.is_used()) {
		return;
	}
	pair_contacts_.resist_rolling(pair_bodies());
	for_batches(coupled_, MAX_SUBSTEPS, [&](BodyStepper &, const Batch &batch, StatePrefetch &) {
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			bodies_.solver_body(batch.active_indices[lane]).apply_spin_change();
		}
	});
}

void Simulator::list_awake(std::vector<BodyId> &ids) {
	ids.clear();
	for (const std::uint32_t i : bodies_.awake()) {
		ids.push_back(world_.id_at(bodies_.body_indices()[i]));
	}
}

void Simulator::let_sleep() {
	joined_.assign(joint_solver_.joined().begin(), joint_solver_.joined().end());
	rigid_neighbors_.add_linked(joined_);
	sleep_.let_sleep(pair_contacts_.pairs(), pair_contacts_.touched(), joined_, rigid_neighbors_.restless());
}

// Before any body falls asleep or wakes: a body that slept during the step has no contacts, but keeps its touches.
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
	report.sleeping_bodies = bodies_.resting_count() - bodies_.frozen_count();
	for (const std::uint32_t body_index : bodies_.inactive_bodies()) {
		SoftBodyData &body = world_.soft_bodies()[body_index];
		std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	}
	report.pair_contacts = pair_contacts_.contact_count();
	report.flying_bodies = std::size_t(std::ranges::count(flown_, char(1)));
	report.contacts += rigid_contact_count_;
	std::vector<std::uint32_t> non_finite;
	std::vector<std::uint32_t> dented;
	for (BodyStepper &stepper : steppers_) {
		const StepCounts &counts = stepper.counts();
		report.substeps += counts.substeps;
		report.contacts += counts.contacts;
		report.self_contacts += counts.self_contacts;
		non_finite.insert(non_finite.end(), counts.non_finite.begin(), counts.non_finite.end());
		dented.insert(dented.end(), counts.dented.begin(), counts.dented.end());
	}
	std::ranges::sort(dented);
	dented.erase(std::unique(dented.begin(), dented.end()), dented.end());
	for (const std::uint32_t body_index : dented) {
		report.dented_bodies.push_back(world_.id_at(body_index));
		world_.soft_bodies()[body_index].note_dent();
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
