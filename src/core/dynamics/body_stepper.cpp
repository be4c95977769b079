// SPDX-License-Identifier: MIT
// Advances batches of bodies through a time slice of a step.
#include "core/dynamics/body_stepper.h"

#include "core/base/constants.h"
#include "core/dynamics/area_lanes.h"
#include "core/dynamics/body_reset.h"
#include "core/dynamics/finite_check.h"
#include "core/dynamics/rigid_damping.h"
#include "core/dynamics/shape_limits_lanes.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace softbody {

namespace {

using States = std::array<Vec2 *, PACK_WIDTH>;

States positions_of(const Batch &batch) {
	States states;
	std::copy_n(batch.states.begin(), PACK_WIDTH, states.begin());
	return states;
}

States velocities_of(const Batch &batch) {
	States states;
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		states[lane] = batch.velocities(lane);
	}
	return states;
}

void load(const Batch &batch, const BodyLanes<RealPack> &lanes) {
	const States positions = positions_of(batch);
	const States velocities = velocities_of(batch);
	for (std::size_t i = 0; i < lanes.positions.size(); ++i) {
		lanes.positions[i] = gather(positions, i);
		lanes.velocities[i] = gather(velocities, i);
	}
}

void store(const BodyLanes<RealPack> &lanes, const Batch &batch) {
	const States positions = positions_of(batch);
	const States velocities = velocities_of(batch);
	for (std::size_t i = 0; i < lanes.positions.size(); ++i) {
		scatter(lanes.positions[i], positions, i);
		scatter(lanes.velocities[i], velocities, i);
	}
}

} // namespace

void BodyStepper::begin_step(const StepContext &context) {
	context_.emplace(context);
	counts_.substeps = 0;
	counts_.contacts = 0;
	counts_.self_contacts = 0;
	counts_.non_finite.clear();
}

void BodyStepper::begin(const Batch &batch) {
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		if (is_finite(*batch.states[lane])) { // otherwise only the last positions tell where the body was
			SoftBodyData &data = body(batch.body_indices[lane]);
			std::ranges::copy(data.positions(), data.mutable_previous_positions().begin());
		}
	}
}

void BodyStepper::advance(const Batch &batch, const TimeSlice &slice, StatePrefetch &prefetch) {
	if (!can_use_lanes(batch)) {
		prefetch.ask_all();
		for (std::size_t lane = 0; lane < batch.count; ++lane) {
			advance_one(batch, lane, slice);
		}
	} else if (batch.count == PACK_WIDTH) {
		prefetch.ask_all();
		advance_lanes(batch, slice, lanes_solved_alone(batch, slice));
	} else {
		const Batch first = batch.half(0);
		const Batch second = batch.half(PACK_WIDTH);
		const std::uint32_t first_alone = lanes_solved_alone(first, slice);
		if (first_alone == 0) {
			const std::uint32_t second_alone = lanes_solved_alone(second, slice);
			if (second_alone == 0 && advance_wide(batch, slice, prefetch)) {
				return;
			}
			advance_lanes(first, slice, 0);
			advance_lanes(second, slice, second_alone);
		} else {
			advance_lanes(first, slice, first_alone);
			advance_lanes(second, slice, lanes_solved_alone(second, slice));
		}
		prefetch.ask_all();
	}
	for (std::uint32_t lane = 0; slice.is_coupled && lane < batch.count; ++lane) {
		context_->bodies.solver_body(batch.active_indices[lane]).measure_extent();
	}
}

bool BodyStepper::can_use_lanes(const Batch &batch) const {
	if (batch.count == 1 || !integrator_traits(batch.plan->integrator).step_side_by_side) {
		return false;
	}
	// Thousands of bodies take many megabytes: a body is read only if needed.
	return !context_->has_forces || std::none_of(batch.body_indices.begin(), batch.body_indices.begin() + batch.count,
											[&](std::uint32_t body_index) { return body(body_index).is_pushed(); });
}

std::uint32_t BodyStepper::lanes_solved_alone(const Batch &batch, const TimeSlice &slice) {
	std::uint32_t lanes = 0;
	for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) { // each body has its own memory of bounces
		const bool bounces = context_->borders_bounce || context_->bodies.has_touch(batch.active_indices[lane]);
		lanes |= std::uint32_t(bounces) << lane;
	}
	for (std::uint32_t lane = 0; lane < PACK_WIDTH && (context_->colliders.has_colliders() || lanes != 0); ++lane) {
		const bool is_near =
				collision_.begin_body(context_->colliders, body(batch.body_indices[lane]), slice.elapsed, slice.duration, lane);
		lanes |= std::uint32_t(is_near) << lane;
	}
	// Borders are solved for all lanes at once, or for each lane alone.
	return lanes == 0 || context_->world.borders().empty() ? lanes : (1u << PACK_WIDTH) - 1;
}

// Other bodies may have pushed a body through a thin wall since its contacts with colliders were last solved.
const Vec2 *BodyStepper::sweep_start(std::uint32_t active_index, const TimeSlice &slice) const {
	const bool was_pushed = slice.elapsed > 0 && context_->colliders.has_colliders();
	return was_pushed ? context_->bodies.sweep_start(active_index).data() : nullptr;
}

BodyLanes<RealPack> BodyStepper::gather_lanes(const Batch &batch) {
	const std::size_t count = batch.shape->point_count();
	pack_positions_.resize(std::max(pack_positions_.size(), count));
	pack_velocities_.resize(std::max(pack_velocities_.size(), count));
	BodyLanes<RealPack> lanes{ { *batch.shape, *batch.settings, {} }, batch.shape->inverse_masses(),
		{ pack_positions_.data(), count }, { pack_velocities_.data(), count } };
	for (std::size_t lane = 0; batch.settings->turns_with_body() && lane < PACK_WIDTH; ++lane) {
		const Rotation memory = batch.rotation_memory(lane);
		lanes.model.rotation_memory.c.set(lane, memory.c);
		lanes.model.rotation_memory.s.set(lane, memory.s);
	}
	load(batch, lanes);
	return lanes;
}

void BodyStepper::advance_lanes(const Batch &batch, const TimeSlice &slice, std::uint32_t solved_alone) {
	const int substeps = slice.substeps_of(*batch.plan);
	counts_.substeps += std::uint64_t(substeps) * PACK_WIDTH;
	const SoftBodyShape &shape = *batch.shape;
	const std::size_t count = shape.point_count();
	const BodyLanes<RealPack> lanes = gather_lanes(batch);
	if (solved_alone != 0) {
		pack_start_.assign(lanes.positions.begin(), lanes.positions.end());
		pack_start_.insert(pack_start_.end(), lanes.velocities.begin(), lanes.velocities.end());
	}
	pack_workspace_.begin_body(count);
	const LaneStep<RealPack> step = integrator_traits(batch.plan->integrator).step_side_by_side;
	const Real h = slice.duration / Real(substeps);
	const WorldData &world = context_->world;
	const std::uint32_t monitored = batch.settings->contact_monitor ? (1u << PACK_WIDTH) - 1 : 0;
	std::array<const Vec2 *, PACK_WIDTH> sweep_starts;
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		sweep_starts[lane] = sweep_start(batch.active_indices[lane], slice);
	}
	for (int i = 0; i < substeps; ++i) {
		step(lanes, { world.gravity(), {}, h }, pack_workspace_);
		if (holds_area(shape, *batch.settings)) {
			hold_area<RealPack>(lanes, h);
			pack_workspace_.forces_are_current = RealPack(0) < RealPack(0);
		}
		if (batch.settings->has_limits()) { // before contacts, which act last and sweep the whole path
			const PackMask crushed = may_break_limits<RealPack>(lanes.model, lanes.positions);
			if (any(crushed)) {
				keep_whole_in_lanes(batch, bits(crushed), lanes, h, slice.is_coupled || world.has_environment());
				pack_workspace_.forces_are_current = RealPack(0) < RealPack(0);
			}
		}
		if (batch.settings->has_damp()) {
			damp_rigid_motion<RealPack>(lanes, h);
		}
		RealPack contacts(0);
		if (solved_alone != 0) {
			contacts = solve_alone(batch, solved_alone, lanes, h, sweep_starts);
			sweep_starts = {};
		} else if (!world.borders().empty()) {
			contacts = collision_.solve_borders_side_by_side(lanes, world.borders(), h,
					std::span(batch.body_indices).first(PACK_WIDTH), monitored);
		}
		pack_workspace_.forces_are_current = both(pack_workspace_.forces_are_current, !(contacts > RealPack(0)));
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			counts_.contacts += std::uint64_t(contacts[lane]);
		}
	}
	const PackMask whole =
			is_finite_within<RealPack>(lanes.positions, lanes.velocities, credible_reach(shape, *batch.plan));
	for (std::uint32_t lane = 0; any(!whole) && lane < PACK_WIDTH; ++lane) {
		if (whole[lane]) {
			continue;
		}
		// The body's own arrays hold the start of the slice, unless contacts were solved there.
		Vec2 *positions = batch.states[lane];
		Vec2 *velocities = batch.velocities(lane);
		for (std::size_t i = 0; solved_alone != 0 && i < count; ++i) {
			positions[i] = lane_of(pack_start_[i], lane);
			velocities[i] = lane_of(pack_start_[count + i], lane);
		}
		reset(batch.body_indices[lane], slice.duration);
		for (std::size_t i = 0; i < count; ++i) {
			set_lane(lanes.positions[i], lane, positions[i]);
			set_lane(lanes.velocities[i], lane, velocities[i]);
		}
	}
	store(lanes, batch);
	for (std::uint32_t lane = 0; solved_alone != 0 && lane < PACK_WIDTH; ++lane) {
		context_->bodies.has_touch(batch.active_indices[lane]) = char(body(batch.body_indices[lane]).touch_memory().touching);
	}
}

// One lane at a time, as few bodies are crushed at once.
void BodyStepper::keep_whole_in_lanes(const Batch &batch, std::uint32_t crushed, const BodyLanes<RealPack> &lanes, Real h,
		bool bears_load) {
	for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (crushed >> lane & 1) {
			SoftBodyData &data = body(batch.body_indices[lane]);
			limited_.resize(std::max(limited_.size(), 2 * lanes.positions.size()));
			const std::span<Vec2> positions = data.mutable_positions();
			const std::span<Vec2> velocities = data.mutable_velocities();
			std::copy(positions.begin(), positions.end(), limited_.begin());
			std::copy(velocities.begin(), velocities.end(), limited_.begin() + std::ptrdiff_t(positions.size()));
			for (std::size_t i = 0; i < positions.size(); ++i) {
				positions[i] = lane_of(lanes.positions[i], lane);
				velocities[i] = lane_of(lanes.velocities[i], lane);
			}
			keep_whole(data, h, bears_load);
			for (std::size_t i = 0; i < positions.size(); ++i) {
				set_lane(lanes.positions[i], lane, positions[i]);
				set_lane(lanes.velocities[i], lane, velocities[i]);
				positions[i] = limited_[i]; // restores the start of the slice, which a reset needs
				velocities[i] = limited_[positions.size() + i];
			}
		}
	}
}

// Forces and integrators stay in lanes, as they take most of the time. Only contacts with the environment are solved
// for each body alone.
RealPack BodyStepper::solve_alone(const Batch &batch, std::uint32_t solved_alone, const BodyLanes<RealPack> &lanes, Real h,
		const std::array<const Vec2 *, PACK_WIDTH> &sweep_start) {
	const std::size_t hull_count = batch.shape->hull_count();
	before_.resize(std::max(before_.size(), PACK_WIDTH * hull_count));
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (solved_alone >> lane & 1) {
			std::copy_n(sweep_start[lane] != nullptr ? sweep_start[lane] : batch.states[lane], hull_count, &before_[lane * hull_count]);
		}
	}
	store(lanes, batch);
	RealPack contacts(0);
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (solved_alone >> lane & 1) {
			SoftBodyData &data = body(batch.body_indices[lane]);
			const std::span<const Vec2> before(&before_[lane * hull_count], hull_count);
			contacts.set(lane, Real(collision_.handle(data, before, data.total_acceleration(context_->world.gravity()), h, lane)));
		}
	}
	load(batch, lanes);
	return contacts;
}

// Batches with a monitored body, which writes a log, or a failed body, which is reset, are left to the narrower code.
bool BodyStepper::advance_wide(const Batch &batch, const TimeSlice &slice, StatePrefetch &prefetch) {
	if (wide_ == nullptr || batch.settings->contact_monitor) {
		return false;
	}
	const int substeps = slice.substeps_of(*batch.plan);
	WideTimeSlice wide;
	wide.batch = &batch;
	wide.borders = context_->world.borders();
	wide.integrator = batch.plan->integrator;
	wide.gravity = context_->world.gravity();
	wide.h = slice.duration / Real(substeps);
	wide.substeps = substeps;
	wide.reach = credible_reach(*batch.shape, *batch.plan);
	for (std::size_t lane = 0; slice.is_coupled && lane < WIDE_WIDTH; ++lane) {
		wide.solver_bodies[lane] = &context_->bodies.solver_body(batch.active_indices[lane]);
	}
	const std::optional<std::uint64_t> contacts = wide_->advance(wide, prefetch);
	if (!contacts) {
		return false;
	}
	counts_.contacts += *contacts;
	counts_.substeps += std::uint64_t(substeps) * WIDE_WIDTH;
	return true;
}

void BodyStepper::advance_one(const Batch &batch, std::size_t lane, const TimeSlice &slice) {
	const std::uint32_t active_index = batch.active_indices[lane];
	const std::uint32_t body_index = batch.body_indices[lane];
	const SubstepPlan &plan = *batch.plan;
	const int substeps = slice.substeps_of(plan);
	counts_.substeps += std::uint64_t(substeps);
	WorldData &world = context_->world;
	SoftBodyData &data = body(body_index);
	const std::size_t count = data.point_count();
	workspace_.begin_body(count);
	before_.resize(std::max(before_.size(), count));
	external_.assign(count, Vec2{});
	for (const ExternalForce &external : data.external_forces()) {
		external_[external.point] += external.force;
	}
	// Added as forces on the points, as XPBD uses the world's gravity.
	const Vec2 gravity = data.total_acceleration(world.gravity());
	const Vec2 extra = gravity - world.gravity() * data.settings().gravity_scale;
	for (std::size_t i = 0; extra != Vec2{} && i < count; ++i) {
		external_[i] += extra * data.shape().masses()[i];
	}
	start_.assign(data.positions().begin(), data.positions().end());
	start_.insert(start_.end(), data.velocities().begin(), data.velocities().end());
	const IntegratorStep step = integrator_traits(plan.integrator).step;
	const Real h = slice.duration / Real(substeps);
	const bool has_load = data.queued_load() != RigidLoad{};
	SubstepInput input{ world.gravity(), external_, h };
	const std::span<Vec2> before(before_.data(), count);
	collision_.begin_body(context_->colliders, data, slice.elapsed, slice.duration);
	const bool meets_itself = data.settings().self_collision && !slice.is_coupled;
	// Contacts of the body with itself must not carry it through a thin wall either, not even between two steps.
	std::vector<Vec2> &outside = data.last_valid_hull();
	const Vec2 *sweep = sweep_start(active_index, slice);
	if (sweep == nullptr && !outside.empty()) {
		sweep = outside.data();
	}
	for (int i = 0; i < substeps; ++i) {
		std::ranges::copy(data.positions(), before.begin());
		if (meets_itself) {
			hull_before_.assign(data.hull().begin(), data.hull().end());
		}
		if (sweep != nullptr) {
			std::copy_n(sweep, data.shape().hull_count(), before.begin());
			sweep = nullptr;
		}
		if (has_load) {
			load_.assign(external_.begin(), external_.end());
			add_rigid_load(data, load_);
			input.external = load_;
			workspace_.forces_are_current = false; // the load turns with the body
		}
		step(data, input, workspace_);
		if (holds_area(data.shape(), data.settings())) {
			hold_area<Real>(lanes_of(data), h);
			workspace_.forces_are_current = false;
		}
		// Before contacts, which act last and sweep the whole path.
		if (keep_whole(data, h, slice.is_coupled || world.has_environment())) {
			workspace_.forces_are_current = false;
		}
		if (data.settings().has_damp()) {
			damp_rigid_motion(lanes_of(data), h);
			workspace_.forces_are_current &= !data.has_pins(); // without pins the damping changes no force of a spring
		}
		std::size_t contacts = collision_.handle(data, before, gravity, h);
		counts_.contacts += contacts;
		if (meets_itself) {
			outside.assign(data.hull().begin(), data.hull().end());
			const std::size_t self_contacts = self_collision_.handle(data, hull_before_, h);
			if (self_contacts > 0) {
				sweep = outside.data();
			} else {
				outside.clear();
			}
			counts_.self_contacts += self_contacts;
			contacts += self_contacts;
		}
		if (contacts > 0) {
			workspace_.forces_are_current = false;
		}
	}
	if (!is_finite_within<Real>(data.positions(), data.velocities(), credible_reach(data.shape(), plan))) {
		std::ranges::copy(std::span(start_).first(count), data.mutable_positions().begin());
		std::ranges::copy(std::span(start_).last(count), data.mutable_velocities().begin());
		reset(body_index, slice.duration);
		if (slice.is_coupled && data.settings().self_collision) {
			context_->bodies.solver_body(active_index).begin_substep(); // no path behind the body that a contact could block
		}
	}
	context_->bodies.has_touch(active_index) = char(data.touch_memory().touching);
}

void BodyStepper::time_rest(const Batch &batch, Real dt) {
	const WorldData &world = context_->world;
	const std::span<const Real> masses = batch.shape->masses();
	const Real mass = batch.shape->total_mass();
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		SoftBodyData &data = body(batch.body_indices[lane]);
		Vec2 *velocities = batch.velocities(lane);
		const bool is_weightless = data.total_acceleration(world.gravity()) == Vec2{};
		const Real slow = (is_weightless ? SLEEP_SPEED_WEIGHTLESS : SLEEP_SPEED) * world.length_unit();
		const Real wobble = is_weightless ? Real(1) : SLEEP_WOBBLE;
		Real twice_energy = 0;
		Vec2 momentum;
		for (std::size_t i = 0; i < masses.size(); ++i) {
			twice_energy += masses[i] * length_squared(velocities[i]);
			momentum += velocities[i] * masses[i];
		}
		const bool is_slow = length_squared(momentum) < slow * slow * mass * mass &&
				twice_energy < slow * slow * mass * wobble * wobble;
		RestState &rest = data.rest_state();
		rest.rest_time = is_slow ? rest.rest_time + dt : Real(0);
		if (batch.settings->can_sleep && rest.rest_time > DROWSY_TIME) {
			const Real keep = std::max(Real(0), 1 - dt / DROWSY_DECAY);
			for (std::size_t i = 0; i < masses.size(); ++i) {
				velocities[i] *= keep;
			}
		}
	}
}

std::array<BodyFrame, WIDE_WIDTH> BodyStepper::measure_frames(const Batch &batch) {
	std::array<BodyFrame, WIDE_WIDTH> frames;
	if (batch.count == 1) {
		frames[0] = measure_frame(body(batch.body_indices[0]));
	}
	for (std::size_t first = 0; first + PACK_WIDTH <= batch.count; first += PACK_WIDTH) {
		const BodyLanes<RealPack> lanes = gather_lanes(batch.half(first));
		const auto all = measure_frame<RealPack>(*batch.shape, lanes.model.rotation_memory, lanes.positions, lanes.velocities);
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			frames[first + lane] = { lane_of(all.center, lane), lane_of(all.velocity, lane),
				{ all.rotation.c[lane], all.rotation.s[lane] }, all.rotation_defined[lane] != 0, all.inertia[lane],
				all.angular_velocity[lane] };
		}
	}
	return frames;
}

void BodyStepper::remember_rotations(const Batch &batch, std::span<const BodyFrame> frames) {
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		body(batch.body_indices[lane]).set_rotation_memory(frames[lane].rotation); // the memory itself if undefined
	}
}

void BodyStepper::solve_self_contacts(std::uint32_t active_index, Real h) {
	const SolverBody &solver_body = context_->bodies.solver_body(active_index);
	counts_.self_contacts += self_collision_.handle(body(solver_body.body_index), solver_body.before, h);
}

void BodyStepper::end(const Batch &batch) {
	for (std::uint32_t lane = 0; context_->has_forces && lane < batch.count; ++lane) {
		body(batch.body_indices[lane]).clear_external_forces();
	}
}

void BodyStepper::check(std::uint32_t body_index, Real dt) {
	if (!is_finite(body(body_index))) {
		reset(body_index, dt);
	}
}

void BodyStepper::reset(std::uint32_t body_index, Real dt) {
	reset_body(body(body_index), dt);
	counts_.non_finite.push_back(body_index);
}

} // namespace softbody
