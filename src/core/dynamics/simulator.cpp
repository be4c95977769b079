// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include "core/base/constants.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

constexpr std::size_t CREWS_A_TASK = 16;
constexpr std::size_t BODIES_A_TASK = CREWS_A_TASK * PACK_WIDTH;

// Whose state is asked for meanwhile (353,400 bodies in explicit Euler steps on one thread: 47 ns a body with three, 50 with
// six).
constexpr std::size_t CREWS_AHEAD = 3;

int share_of(const SubstepPlan &plan, int parts) {
	return (plan.substeps + parts - 1) / parts;
}

} // namespace

Simulator::Simulator(WorldData &world, ParallelFor parallel_for) :
		world_(world), parallel_for_(std::move(parallel_for)), steppers_(MOST_SLICES) {}

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	return plan_substeps(body, dt, world_.has_surroundings());
}

// What holds until bodies are rearranged, the time step changes or the first surroundings appear.
bool Simulator::arrange(Real dt) {
	const bool has_contacts = world_.has_surroundings();
	if (arranged_roster_ == roster_.version() && arranged_dt_ == dt && arranged_with_contacts_ == has_contacts) {
		return false;
	}
	arranged_roster_ = roster_.version();
	arranged_dt_ = dt;
	arranged_with_contacts_ = has_contacts;
	crews_.clear();
	pressed_crews_.clear();
	touching_.clear();
	places_.clear();
	pair_contacts_.begin_arranging();
	frozen_count_ = 0;
	std::size_t hull_points = 0;
	first_hull_point_.clear();
	// Rows in the order of the world, whatever the crews: pairs go by it.
	row_of_.assign(world_.soft_bodies().size(), 0);
	for (std::uint32_t place = 0; place < world_.soft_bodies().size(); ++place) {
		SoftBodyData &body = world_.soft_bodies()[place];
		if (!body.is_active()) {
			continue;
		}
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
		first_hull_point_.push_back(hull_points);
		hull_points += body.shape().hull_count();
		pair_contacts_.add_body(settings);
	}
	sleepers_.reset(touching_.size());
	before_.resize(hull_points);
	swept_from_.resize(hull_points);
	crew_of_.resize(touching_.size());
	for (const Crew &crew : roster_.crews()) {
		const bool is_like_last = !crews_.empty() && move_alike(roster_.crews()[crews_.size() - 1], crew);
		const std::uint32_t kind = crews_.empty() ? 0 : crews_.back().kind + std::uint32_t(!is_like_last);
		CrewState &state = crews_.emplace_back();
		state.kind = kind;
		state.plan = plan(world_.soft_bodies()[crew.bodies[0]], dt);
		if (crew.settings->pressure_stiffness > 0) {
			pressed_crews_.push_back(std::uint32_t(crews_.size() - 1));
		}
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			const std::uint32_t row = row_of_[crew.bodies[lane]];
			state.rows[lane] = row;
			state.awake |= 1u << lane;
			crew_of_[row] = std::uint32_t(crews_.size() - 1);
			touching_[row].velocity_leads = integrator_traits(state.plan.integrator).velocity_leads;
			touching_[row].before = std::span(before_).subspan(first_hull_point_[row], crew.shape->hull_count());
		}
	}
	bodies_meet_themselves_ = std::ranges::any_of(roster_.crews(), [](const Crew &c) { return c.settings->self_collision; });
	has_monitored_bodies_ = std::ranges::any_of(touching_, &TouchingBody::is_monitored);
	return true;
}

template <class Work>
void Simulator::for_crews(std::span<const std::uint32_t> crews, const Work &work) {
	run_slices(parallel_for_, crews.size(), CREWS_A_TASK, [&](std::size_t task, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			if (i + CREWS_AHEAD < end) {
				StateAhead ahead;
				ahead.add(roster_.crews()[crews[i + CREWS_AHEAD]]);
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
			const bool are_two = i + 1 < end && move_alike_now(crews[i], crews[i + 1]);
			next = i + 1 + std::size_t(are_two);
			StateAhead ahead;
			for (std::size_t k = i; k < next; ++k) {
				if (k + CREWS_AHEAD < end) {
					ahead.add(roster_.crews()[crews[k + CREWS_AHEAD]]);
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

// Pressure on a stretched hull needs more substeps than at rest, so that bodies of one crew may differ from step to step.
void Simulator::plan_pressure(Real dt) {
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
			plans[lane] = plan(world_.soft_bodies()[crew.bodies[lane]], dt);
			are_equal &= plans[lane].substeps == plans[0].substeps && plans[lane].integrator == plans[0].integrator;
		}
		state.plan = plans[0];
		state.own_plans = are_equal ? NO_OWN_PLANS : std::uint32_t(own_plans_.size());
		if (!are_equal) {
			own_plans_.push_back(plans);
		}
	}
}

// Other bodies may have pushed it through a thin wall since it last looked at the surroundings.
SweptFrom Simulator::swept_from(std::uint32_t crew, const Stretch &stretch) const {
	SweptFrom from{};
	for (std::uint32_t lane = 0; stretch.elapsed > 0 && surroundings_.has_colliders() && lane < PACK_WIDTH; ++lane) {
		from[lane] = &swept_from_[first_hull_point_[crews_[crew].rows[lane]]];
	}
	return from;
}

void Simulator::advance(BodyStepper &stepper, std::uint32_t crew, const Stretch &stretch) {
	const CrewState &state = crews_[crew];
	const SweptFrom from = swept_from(crew, stretch);
	const std::size_t resets = stepper.counts().non_finite.size();
	if (state.own_plans == NO_OWN_PLANS) {
		stepper.advance(roster_.crews()[crew], state.stepped(), state.plan, stretch.elapsed, stretch.duration,
				share_of(state.plan, stretch.parts), from, stretch.is_coupled);
	}
	for (std::uint32_t lane = 0; state.own_plans != NO_OWN_PLANS && lane < roster_.crews()[crew].count; ++lane) {
		const SubstepPlan &own = own_plans_[state.own_plans][lane];
		stepper.advance(roster_.crews()[crew], state.stepped() & 1u << lane, own, stretch.elapsed, stretch.duration,
				share_of(own, stretch.parts), from, stretch.is_coupled);
	}
	if (stretch.is_coupled && roster_.crews()[crew].settings->self_collision && stepper.counts().non_finite.size() > resets) {
		touching_[state.rows[0]].begin_substep(); // in its rest shape again: no way behind it that could be blocked
	}
	if (stretch.is_coupled) {
		measure_extents(crew);
	}
}

void Simulator::measure_extents(std::uint32_t crew) {
	for (std::uint32_t lane = 0; lane < roster_.crews()[crew].count; ++lane) {
		if (crews_[crew].stepped() >> lane & 1) {
			touching_[crews_[crew].rows[lane]].measure_extent();
		}
	}
}

void Simulator::advance_both(BodyStepper &stepper, std::uint32_t a, std::uint32_t b, const Stretch &stretch,
		StateAhead &ahead) {
	const SubstepPlan &plan = crews_[a].plan;
	std::array<TouchingBody *, WIDE_WIDTH> touching{};
	for (std::size_t lane = 0; stretch.is_coupled && lane < PACK_WIDTH; ++lane) {
		touching[lane] = &touching_[crews_[a].rows[lane]];
		touching[PACK_WIDTH + lane] = &touching_[crews_[b].rows[lane]];
	}
	const bool are_measured = stepper.advance_both({ &roster_.crews()[a], &roster_.crews()[b] }, plan, stretch.elapsed,
			stretch.duration, share_of(plan, stretch.parts), { swept_from(a, stretch), swept_from(b, stretch) },
			stretch.is_coupled, touching, ahead);
	if (stretch.is_coupled && !are_measured) {
		measure_extents(a);
		measure_extents(b);
	}
}

bool Simulator::move_alike_now(std::uint32_t a, std::uint32_t b) const {
	const CrewState &state_a = crews_[a];
	const CrewState &state_b = crews_[b];
	return state_a.kind == state_b.kind && (state_a.stepped() & state_b.stepped()) == ALL_LANES &&
			state_a.own_plans == NO_OWN_PLANS && state_b.own_plans == NO_OWN_PLANS &&
			state_a.plan.substeps == state_b.plan.substeps && state_a.plan.integrator == state_b.plan.integrator;
}

// Which bodies take contact substeps: those that may touch another or a dynamic rigid body, or are joined to something.
void Simulator::divide_crews(Real dt) {
	pair_contacts_.begin_step(pair_bodies(), dt, roster_.version(), joint_solver_.separated(), parallel_for_);
	if (sleepers_.count() == 0 && !pair_contacts_.is_used() && has_rigid_body_.empty() && !joint_solver_.has_joints()) {
		// Nobody meets anybody: no need to look at each.
		free_crews_.resize(crews_.size());
		std::iota(free_crews_.begin(), free_crews_.end(), 0u);
		return;
	}
	for (std::uint32_t i = 0; i < crews_.size(); ++i) {
		CrewState &state = crews_[i];
		if (state.awake == 0) {
			continue;
		}
		state.coupled = 0;
		for (std::uint32_t lane = 0; lane < roster_.crews()[i].count; ++lane) {
			const std::uint32_t row = state.rows[lane];
			const bool has_rigid_body = !has_rigid_body_.empty() && has_rigid_body_[row] != 0;
			if (has_rigid_body) {
				rigid_contacts_.add_body(world_.soft_bodies()[roster_.crews()[i].bodies[lane]]);
			}
			const bool is_coupled = has_rigid_body || pair_contacts_.has_pair(row) || joint_solver_.holds(row);
			state.coupled |= std::uint32_t(is_coupled) << lane;
		}
		(state.coupled != 0 ? coupled_crews_ : free_crews_).push_back(i);
	}
	if (!coupled_crews_.empty() || rigid_contacts_.has_bodies()) {
		choose_contact_substeps(dt);
	}
}

// A point that moves through several force substeps between two looks at its contacts trembles: each body gets as many looks
// as it has force substeps, up to a bound that keeps one very stiff body from slowing its whole heap.
void Simulator::choose_contact_substeps(Real dt) {
	const int least = substeps_of_step(world_.contact_substeps(), dt);
	const bool meets_rigid_bodies = rigid_contacts_.has_bodies() || joint_solver_.has_dynamic_ends();
	if (const std::optional<int> common = common_need(least)) {
		heap_substeps_.set_common(*common);
		rigid_substeps_ = meets_rigid_bodies ? *common : 0;
		return;
	}
	find_heaps(least);
	leave_free();
}

int Simulator::needed_substeps(const CrewState &crew, std::uint32_t lane, int least) const {
	const int own = crew.plan_of(lane, own_plans_).substeps;
	return crew.coupled >> lane & 1 ? std::max(least, std::min(own, MAX_CONTACT_SUBSTEPS)) : own;
}

// Whether a body that is in no heap ends in the same bits by as many contact substeps as it takes force substeps.
bool Simulator::may_be_divided(const CrewState &crew, std::uint32_t lane) const {
	return integrator_traits(crew.plan_of(lane, own_plans_).integrator).hands_nothing_on;
}

// Where all take the same number, there is no need to know who belongs to which heap.
std::optional<int> Simulator::common_need(int least) const {
	std::optional<int> common;
	for (const std::uint32_t i : coupled_crews_) {
		const CrewState &state = crews_[i];
		for (std::uint32_t lane = 0; lane < roster_.crews()[i].count; ++lane) {
			if (state.awake >> lane & 1) {
				const int needed = needed_substeps(state, lane, least);
				const bool is_coupled = state.coupled >> lane & 1;
				if (common.value_or(needed) != needed || !(is_coupled || may_be_divided(state, lane))) {
					return {};
				}
				common = needed;
			}
		}
	}
	return common.value_or(least);
}

// All who meet dynamic rigid bodies are one heap: these move in the same substeps.
void Simulator::find_heaps(int least) {
	const std::uint32_t count = std::uint32_t(touching_.size());
	heap_substeps_.begin(count);
	for (const std::span<const BodyPair> pairs : { pair_contacts_.pairs(), joint_solver_.joined() }) {
		for (const auto [a, b] : pairs) {
			heap_substeps_.join(a, b);
		}
	}
	beside_dynamic_.clear();
	for (std::uint32_t row = 0; row < count; ++row) {
		if ((!has_rigid_body_.empty() && has_rigid_body_[row] != 0) || joint_solver_.holds_to_dynamic(row)) {
			beside_dynamic_.push_back(row);
			heap_substeps_.join(beside_dynamic_[0], row);
		}
	}
	for (const std::uint32_t row : beside_dynamic_) {
		heap_substeps_.need(row, least); // frozen ones, too
	}
	for (const std::uint32_t i : coupled_crews_) {
		const CrewState &state = crews_[i];
		for (std::uint32_t lane = 0; lane < roster_.crews()[i].count; ++lane) {
			if (state.awake & state.coupled & 1u << lane) {
				heap_substeps_.need(state.rows[lane], needed_substeps(state, lane, least));
			}
		}
	}
	heap_substeps_.finish();
	rigid_substeps_ = beside_dynamic_.empty() ? 0 : heap_substeps_.of(beside_dynamic_[0]);
}

// Bodies of a crew go side by side: who is in no heap goes with one that takes as many substeps, if there is one.
void Simulator::leave_free() {
	for (const std::uint32_t i : coupled_crews_) {
		CrewState &state = crews_[i];
		const std::uint32_t lanes = (1u << roster_.crews()[i].count) - 1;
		for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
			if (!(state.awake & lanes & ~state.coupled & 1u << lane) || !may_be_divided(state, lane)) {
				continue;
			}
			const int own = state.plan_of(lane, own_plans_).substeps;
			for (std::uint32_t other = 0; other < PACK_WIDTH; ++other) {
				if ((lanes & state.coupled & 1u << other) && heap_substeps_.of(state.rows[other]) == own) {
					heap_substeps_.add(state.rows[lane], own);
				}
			}
		}
		for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
			state.coupled |= std::uint32_t((lanes >> lane & 1) && heap_substeps_.of(state.rows[lane]) != 0) << lane;
		}
		state.turn = ~state.coupled & ALL_LANES;
		if (state.stepped() != 0) {
			free_crews_.push_back(i);
		}
	}
}

void Simulator::wake_by_surroundings() {
	watch_.update(surroundings_);
	const bool was_restored = std::exchange(seen_restores_, world_.change_counts().restores) != seen_restores_;
	const bool asks_all = was_restored || watch_.has_border_changed();
	if (!asks_all && watch_.changed_boxes().empty()) {
		return;
	}
	const auto is_in = [](std::span<const Aabb> boxes, const Aabb &box) {
		return std::ranges::any_of(boxes, [&](const Aabb &b) { return b.overlaps(box); });
	};
	for (std::uint32_t row = 0; row < places_.size(); ++row) {
		SoftBodyData &body = world_.soft_bodies()[places_[row]];
		const Aabb box = rest_box(row);
		// Who sleeps goes by what was there when it fell asleep, not in the last step, so that it does not matter how
		// this state came about. Who is awake does not rest beside what moves.
		const bool has_changed = sleepers_[row] && (asks_all || is_in(watch_.changed_boxes(), box)) &&
				watch_.describe(surroundings_, box) != body.rest_state().surroundings;
		if (has_changed || is_in(watch_.moving_boxes(), box)) {
			body.wake();
		}
	}
	take_over_sleepers(false);
}

// What a body rests on touches its box at most.
Aabb Simulator::rest_box(std::uint32_t row) const {
	const TouchingBody &body = touching_[row];
	return (sleepers_[row] ? body.box : bounding_box(body.positions.first(body.before.size()))).grown(body.rolling_radius / 8);
}

// Where one was, is now, or both.
void Simulator::wake_by_frozen_bodies() {
	const std::vector<Aabb> boxes = world_.take_disturbed_boxes();
	if (boxes.empty()) {
		return;
	}
	wake_in(boxes);
	for (std::uint32_t row = 0; row < places_.size(); ++row) {
		SoftBodyData &body = world_.soft_bodies()[places_[row]];
		if (body.is_frozen()) {
			note_awake(row, false); // it may lie elsewhere now
		}
	}
}

void Simulator::wake_in(std::span<const Aabb> boxes) {
	for (std::uint32_t row = 0; row < places_.size(); ++row) {
		const Aabb box = rest_box(row); // who is awake does not rest either while that changes
		if (std::ranges::any_of(boxes, [&](const Aabb &b) { return b.overlaps(box); })) {
			world_.soft_bodies()[places_[row]].wake();
		}
	}
	take_over_sleepers(false);
}

// Which bodies may meet a rigid body that they push back. Beside one that sleeps they may sleep as well, and what is beside
// the same one sleeps and wakes together; beside one that is awake nobody sleeps, or what rests on it would sink in.
void Simulator::find_rigid_contacts(Real dt) {
	rigid_contacts_.begin_step(world_, surroundings_);
	rigid_contact_count_ = 0;
	has_rigid_body_.clear();
	restless_.clear();
	beside_rigid_.clear();
	if (!surroundings_.has_dynamic_colliders()) {
		return;
	}
	const std::size_t count = touching_.size();
	has_rigid_body_.assign(count, 0);
	restless_.assign(count, 0);
	run_slices(parallel_for_, count, BODIES_A_TASK, [&](std::size_t, std::size_t begin, std::size_t end) {
		for (std::size_t i = begin; i < end; ++i) {
			has_rigid_body_[i] =
					surroundings_.has_dynamic_collider_in(sweep_box(touching_[i].hull(), touching_[i].velocities, dt));
		}
	});
	for (std::uint32_t i = 0; i < count; ++i) {
		if (has_rigid_body_[i] == 0) {
			continue;
		}
		surroundings_.collect_dynamic(sweep_box(touching_[i].hull(), touching_[i].velocities, dt), near_colliders_);
		for (const std::uint32_t collider : near_colliders_) {
			const std::uint32_t rigid = world_.colliders()[collider].rigid_body;
			restless_[i] |= char(!world_.rigid_bodies()[rigid].asleep);
			beside_rigid_.push_back({ rigid, i });
		}
		SoftBodyData &body = world_.soft_bodies()[places_[i]];
		if (sleepers_[i] && restless_[i] != 0) {
			body.wake();
		}
		if (body.is_frozen()) {
			rigid_contacts_.add_body(body); // it is in no crew that is stepped
		}
	}
	take_over_sleepers(false);
	std::ranges::sort(beside_rigid_);
	for (const auto &[rigid, row] : beside_rigid_) {
		world_.mutable_reactions()[rigid].beside_sleeper |= sleepers_[row] && !world_.soft_bodies()[places_[row]].is_frozen();
	}
}

StepReport Simulator::simulate(Real dt) {
	StepReport report;
	contact_monitor_.begin_step();
	report.refused = check_above("dt", dt, 0, "s");
	if (report.refused) {
		return report;
	}
	const std::uint64_t old_roster = roster_.version();
	roster_.update(world_);
	surroundings_.update(world_, dt);
	const bool is_arranged = arrange(dt);
	take_over_sleepers(is_arranged);
	for (std::uint32_t row = 0; is_arranged && sleepers_.count() > 0 && row < places_.size(); ++row) {
		// Who was put to sleep sleeps amid what is there now.
		RestState &rest = world_.soft_bodies()[places_[row]].rest_state();
		if (rest.asleep && rest.surroundings == 0) {
			rest.surroundings = watch_.describe(surroundings_, rest_box(row));
		}
	}
	// Bodies that came or were activated may have brought forces along.
	const bool is_rearranged = roster_.version() != old_roster;
	const bool has_forces = seen_forces_ != world_.change_counts().forces || is_rearranged;
	seen_forces_ = world_.change_counts().forces;
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
	if (world_.has_sleeping()) {
		wake_by_surroundings();
	}
	wake_by_frozen_bodies();
	joint_solver_.begin_step(world_, places_, is_arranged, dt);
	while (joint_solver_.wake_joined()) {
		take_over_sleepers(false);
	}
	find_rigid_contacts(dt);
	if (!sleepers_.is_everybody() || rigid_contacts_.has_bodies()) {
		plan_pressure(dt);
		divide_crews(dt);
	}
	const auto begin = [&](BodyStepper &stepper, std::uint32_t i) {
		stepper.begin(roster_.crews()[i], crews_[i].stepped());
	};
	advance_crews(free_crews_, { 0, dt, 1, false }, begin, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = roster_.crews()[i];
		if (crew.settings->matches_shape()) {
			stepper.remember_rotations(crew, crews_[i].stepped(), stepper.measure_frames(crew));
		}
		stepper.end(crew, crews_[i].stepped());
		if (world_.has_sleeping()) {
			stepper.time_rest(crew, crews_[i].stepped(), dt);
		}
	});
	if (!coupled_crews_.empty() || rigid_contacts_.has_bodies()) {
		step_coupled(dt);
	} else {
		move_rigid_bodies_alone(dt);
	}
	rigid_contacts_.end_step(dt);
	pin_motion_.end_step(world_);
	joint_solver_.end_step(report.broken_joints);
	if (has_monitored_bodies_ || contact_monitor_.has_touches()) {
		report_contacts(dt);
	}
	if (world_.has_sleeping()) {
		let_sleep();
	}
	report.sleeping_bodies = sleepers_.count() - frozen_count_;
	for (const std::uint32_t place : roster_.inactive_bodies()) {
		SoftBodyData &body = world_.soft_bodies()[place];
		std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	}
	collect(report);
	return report;
}

void Simulator::step_coupled(Real dt) {
	for (const int substeps : heap_substeps_.counts()) {
		step_heaps(substeps, dt);
	}
	if (rigid_substeps_ == 0) {
		move_rigid_bodies_alone(dt);
	}
	for (const std::uint32_t i : coupled_crews_) {
		crews_[i].turn = heap_substeps_.are_common() ? ALL_LANES : crews_[i].coupled;
	}
	pair_contacts_.end_step(pair_bodies());
	measure_frames();
	resist_rolling_between_bodies();
	for_crews(coupled_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = roster_.crews()[i];
		if (crew.settings->self_collision && surroundings_.has_colliders()) {
			const std::size_t first = first_hull_point_[crews_[i].rows[0]];
			world_.soft_bodies()[crew.bodies[0]].outside_hull().assign(&swept_from_[first], &swept_from_[first] + crew.shape->hull_count());
		}
		stepper.check(crew, crews_[i].turn, dt);
		stepper.end(crew, crews_[i].turn);
		if (world_.has_sleeping()) {
			stepper.time_rest(crew, crews_[i].stepped(), dt);
		}
		crews_[i].turn = ALL_LANES;
	});
	check_touched_sleepers(dt);
}

// A turn of the heaps that take so many contact substeps.
void Simulator::step_heaps(int substeps, Real dt) {
	const HeapTurn turn = heap_substeps_.turn(substeps);
	turn_crews_.clear();
	for (const std::uint32_t i : coupled_crews_) {
		CrewState &state = crews_[i];
		state.turn = 0;
		for (std::uint32_t lane = 0; lane < roster_.crews()[i].count; ++lane) {
			state.turn |= std::uint32_t(turn.has(state.rows[lane])) << lane;
		}
		if (state.stepped() != 0) {
			turn_crews_.push_back(i);
		}
	}
	const bool moves_rigid_bodies = substeps == rigid_substeps_;
	const Real duration = dt / Real(substeps);
	pair_contacts_.begin_substeps(pair_bodies(), duration);
	for (int substep = 0; substep < substeps; ++substep) {
		if (moves_rigid_bodies) {
			rigid_contacts_.begin_substep(duration);
		}
		joint_solver_.begin_substep(turn);
		const auto begin = [&](BodyStepper &stepper, std::uint32_t i) {
			const Crew &crew = roster_.crews()[i];
			if (substep == 0) {
				stepper.begin(crew, crews_[i].stepped());
			}
			for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
				if (crews_[i].stepped() >> lane & 1) {
					touching_[crews_[i].rows[lane]].begin_substep();
				}
			}
		};
		const Stretch stretch{ Real(substep) * duration, duration, substeps, true };
		advance_crews(turn_crews_, stretch, begin, [&](BodyStepper &, std::uint32_t i) {
			for (std::uint32_t lane = 0; surroundings_.has_colliders() && lane < roster_.crews()[i].count; ++lane) {
				if (crews_[i].stepped() >> lane & 1) {
					const std::uint32_t row = crews_[i].rows[lane];
					std::ranges::copy(touching_[row].hull(), &swept_from_[first_hull_point_[row]]);
				}
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

// Who sleeps is in no crew that is stepped, but what has blown up may have touched it.
void Simulator::check_touched_sleepers(Real dt) {
	for (std::uint32_t i = 0; sleepers_.count() > 0 && i < crews_.size(); ++i) {
		const Crew &crew = roster_.crews()[i];
		bool has_pair = false;
		for (std::uint32_t lane = 0; crews_[i].awake == 0 && lane < crew.count; ++lane) {
			has_pair |= pair_contacts_.has_pair(crews_[i].rows[lane]);
		}
		if (has_pair) {
			steppers_[0].check(crew, ALL_LANES, dt);
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
		const Crew &crew = roster_.crews()[i];
		if (!pair_contacts_.resists_rolling() && !crew.settings->matches_shape()) {
			return;
		}
		const std::array<BodyFrame, PACK_WIDTH> frames = stepper.measure_frames(crew);
		for (std::uint32_t lane = 0; lane < crew.count; ++lane) {
			touching_[crews_[i].rows[lane]].take_frame(frames[lane]);
		}
		if (crew.settings->matches_shape()) {
			stepper.remember_rotations(crew, crews_[i].turn, frames);
		}
	});
}

// Last of all, as all others may press a hull against itself. A body that meets itself is a crew of its own.
void Simulator::answer_self_contacts(Real h) {
	if (!bodies_meet_themselves_) {
		return;
	}
	for_crews(turn_crews_, [&](BodyStepper &stepper, std::uint32_t i) {
		const Crew &crew = roster_.crews()[i];
		if (crew.settings->self_collision) {
			stepper.answer_self_contacts(crew.bodies[0], touching_[crews_[i].rows[0]].before, h);
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
		for (std::uint32_t lane = 0; lane < roster_.crews()[i].count; ++lane) {
			touching_[crews_[i].rows[lane]].apply_spin_change();
		}
	});
}

void Simulator::note_awake(std::uint32_t row, bool awake) {
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
	SoftBodyData &body = world_.soft_bodies()[places_[row]];
	body.touch_memory() = {};
	body.pair_memories().clear();
	std::ranges::fill(body.mutable_velocities(), Vec2{});
	std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	touching_[row].begin_substep();
	touching_[row].measure_extent();
}

void Simulator::take_over_sleepers(bool is_rearranged) {
	sleepers_.take_over(world_, places_, is_rearranged, [this](std::uint32_t row, bool awake) { note_awake(row, awake); });
}

void Simulator::let_sleep() {
	joined_.assign(joint_solver_.joined().begin(), joint_solver_.joined().end());
	for (std::size_t i = 1; i < beside_rigid_.size(); ++i) {
		const auto &[rigid, row] = beside_rigid_[i];
		if (rigid == beside_rigid_[i - 1].first && row != beside_rigid_[i - 1].second) {
			joined_.push_back({ beside_rigid_[i - 1].second, row });
		}
	}
	sleepers_.let_sleep(world_, places_, pair_contacts_.pairs(), pair_contacts_.touched(), joined_, restless_,
			[this](std::uint32_t row, bool awake) {
				note_awake(row, awake);
				world_.soft_bodies()[places_[row]].rest_state().surroundings = watch_.describe(surroundings_, rest_box(row));
			});
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
