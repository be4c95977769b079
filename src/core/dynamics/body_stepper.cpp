// SPDX-License-Identifier: MIT
// Advances bodies through one step, alone or side by side.
#include "core/dynamics/body_stepper.h"

#include "core/base/constants.h"
#include "core/dynamics/area_lanes.h"
#include "core/dynamics/rigid_damping.h"
#include "core/dynamics/shape_limits_lanes.h"
#include "core/dynamics/soundness.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

// As `is_sound`, without the reach, of one body.
bool is_finite(std::span<const Vec2> positions, std::span<const Vec2> velocities) {
	RealPack sum(0);
	for (std::size_t i = 0; i < packs_for(positions.size()); ++i) {
		sum += zero_if_finite(pack_of(positions, i), pack_of(velocities, i));
	}
	return !any(!(sum < RealPack(1)));
}

// Points that nothing joins may part.
Real credible_reach(const SoftBodyShape &shape, const SubstepPlan &plan) {
	return plan.frequency > 0 ? CREDIBLE_REACH * shape.radius() : std::numeric_limits<Real>::infinity();
}

bool is_together(const SoftBodyData &body) {
	return is_sound<Real>(body.positions(), body.velocities(), CREDIBLE_REACH * body.shape().radius());
}

// Where the center of a body at rest has to be for its pins, on average, to be where they are: torn off from them, it would
// be torn again in every step. Without pins that can be believed, `otherwise`.
Vec2 center_by_pins(const SoftBodyData &data, Rotation rotation, Vec2 otherwise) {
	Vec2 sum;
	std::size_t count = 0;
	for (std::uint32_t i = 0; i < data.point_count(); ++i) {
		if (data.is_pinned(i) && is_finite(data.positions()[i])) {
			sum += data.positions()[i] - rotation.apply(data.shape().rest_positions()[i]);
			++count;
		}
	}
	const Vec2 mean = sum * (1 / Real(count));
	return count > 0 && is_finite(mean) ? mean : otherwise;
}

// Where a body with points that are no numbers most probably is: amid those that are, else where the step began.
Vec2 center_by_finite_points(const SoftBodyData &data) {
	for (const std::span<const Vec2> points : { data.positions(), data.previous_positions() }) {
		Vec2 sum;
		std::size_t count = 0;
		for (const Vec2 p : points) {
			if (is_finite(p)) {
				sum += p;
				++count;
			}
		}
		const Vec2 mean = sum * (1 / Real(count));
		if (count > 0 && is_finite(mean)) {
			return mean;
		}
	}
	return {};
}

} // namespace

void BodyStepper::begin_step(WorldData &world, const ColliderIndex &surroundings, bool has_forces) {
	world_ = &world;
	surroundings_ = &surroundings;
	has_forces_ = has_forces;
	borders_bounce_ = std::ranges::any_of(world.borders(), [](const Border &b) { return b.surface.restitution != 0; });
	counts_.substeps = 0;
	counts_.contacts = 0;
	counts_.self_contacts = 0;
	counts_.non_finite.clear();
}

void BodyStepper::begin(const Batch &batch, std::uint32_t lanes) {
	if (!world_->is_interpolated()) {
		return;
	}
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		SoftBodyData &data = body(batch.bodies[lane]);
		if ((lanes >> lane & 1) && is_finite(data.positions()[0])) { // or else this is all that tells where it was
			std::ranges::copy(data.positions(), data.mutable_previous_positions().begin());
		}
	}
}

void BodyStepper::advance(Batch &batch, std::uint32_t lanes, const SubstepPlan &plan, Real elapsed, Real duration,
		int substeps, const SweepStarts &sweep_start, bool are_coupled) {
	if (!can_go_side_by_side(batch, lanes, plan)) {
		advance_one_by_one(batch, lanes, plan, elapsed, duration, substeps, sweep_start, are_coupled);
	} else if (lanes == ALL_LANES) {
		const std::uint32_t alone = lanes_solved_alone(batch, lanes, elapsed, duration);
		advance_side_by_side(batch, lanes, alone, plan, duration, substeps, sweep_start, are_coupled);
	} else {
		Batch some = with_stand_ins(batch, lanes);
		const std::uint32_t alone = lanes_solved_alone(some, lanes, elapsed, duration);
		advance_side_by_side(some, lanes, alone, plan, duration, substeps, sweep_start, are_coupled);
		batch.touching = (batch.touching & ~lanes) | (some.touching & lanes);
	}
}

// Where a lane takes no part, a copy of a body that does goes along: all lanes are computed, and nobody asks for that one.
Batch BodyStepper::with_stand_ins(const Batch &batch, std::uint32_t lanes) {
	Batch some = batch;
	const std::uint32_t model = std::uint32_t(std::countr_zero(lanes));
	const std::size_t size = 2 * batch.shape->point_count() + 1; // positions, velocities, rotation memory
	stand_ins_.resize(std::max(stand_ins_.size(), PACK_WIDTH * size));
	for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (!(lanes >> lane & 1)) {
			some.bodies[lane] = batch.bodies[model];
			some.positions[lane] = &stand_ins_[lane * size];
			some.velocities[lane] = some.positions[lane] + batch.shape->point_count();
			std::copy_n(batch.positions[model], size, some.positions[lane]);
		}
	}
	some.monitored &= lanes;
	some.touching &= lanes;
	return some;
}

bool BodyStepper::advance_both(const std::array<Batch *, 2> &batches, const SubstepPlan &plan, Real elapsed,
		Real duration, int substeps, const std::array<SweepStarts, 2> &sweep_start, bool are_coupled,
		const std::array<SolverBody *, WIDE_WIDTH> &solver_bodies, StatePrefetch &prefetch) {
	const auto advance_one = [&](std::size_t i) {
		advance(*batches[i], ALL_LANES, plan, elapsed, duration, substeps, sweep_start[i], are_coupled);
	};
	if (!can_go_side_by_side(*batches[0], ALL_LANES, plan) || !can_go_side_by_side(*batches[1], ALL_LANES, plan)) {
		prefetch.prefetch_all();
		advance_one(0);
		advance_one(1);
		return false;
	}
	const std::uint32_t alone = lanes_solved_alone(*batches[0], ALL_LANES, elapsed, duration);
	if (alone != 0) {
		prefetch.prefetch_all();
		advance_side_by_side(*batches[0], ALL_LANES, alone, plan, duration, substeps, sweep_start[0], are_coupled);
		advance_one(1);
		return false;
	}
	const std::uint32_t other_alone = lanes_solved_alone(*batches[1], ALL_LANES, elapsed, duration);
	if (other_alone != 0 || !advance_wide(batches, plan, duration, substeps, solver_bodies, prefetch)) {
		prefetch.prefetch_all();
		advance_side_by_side(*batches[0], ALL_LANES, alone, plan, duration, substeps, sweep_start[0], are_coupled);
		advance_side_by_side(*batches[1], ALL_LANES, other_alone, plan, duration, substeps, sweep_start[1], are_coupled);
		return false;
	}
	return solver_bodies[0] != nullptr;
}

void BodyStepper::advance_one_by_one(Batch &batch, std::uint32_t lanes, const SubstepPlan &plan, Real elapsed,
		Real duration, int substeps, const SweepStarts &sweep_start, bool are_coupled) {
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		if (lanes >> lane & 1) {
			advance_alone(batch.bodies[lane], plan, elapsed, duration, substeps, sweep_start[lane], are_coupled);
			const std::uint32_t is_touching = body(batch.bodies[lane]).touch_memory().touching;
			batch.touching = (batch.touching & ~(1u << lane)) | is_touching << lane;
			counts_.substeps += std::uint64_t(substeps);
		}
	}
}

void BodyStepper::time_rest(const Batch &batch, std::uint32_t lanes, Real dt) {
	const std::span<const Real> masses = batch.shape->masses();
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		if (!(lanes >> lane & 1)) {
			continue;
		}
		const bool is_weightless = body(batch.bodies[lane]).total_acceleration(world_->gravity()) == Vec2{};
		const Real slow = (is_weightless ? SLEEP_SPEED_WEIGHTLESS : SLEEP_SPEED) * world_->length_unit();
		const Real wobble = is_weightless ? Real(1) : SLEEP_WOBBLE;
		Real twice_energy = 0;
		Vec2 momentum;
		for (std::size_t i = 0; i < masses.size(); ++i) {
			twice_energy += masses[i] * length_squared(batch.velocities[lane][i]);
			momentum += batch.velocities[lane][i] * masses[i];
		}
		const Real mass = batch.shape->total_mass();
		const bool is_slow = length_squared(momentum) < slow * slow * mass * mass &&
				twice_energy < slow * slow * mass * wobble * wobble;
		RestState &rest = body(batch.bodies[lane]).rest_state();
		rest.rest_time = is_slow ? rest.rest_time + dt : Real(0);
		if (batch.settings->can_sleep && rest.rest_time > DROWSY_TIME) {
			const Real keep = std::max(Real(0), 1 - dt / DROWSY_DECAY);
			for (std::size_t i = 0; i < masses.size(); ++i) {
				batch.velocities[lane][i] *= keep;
			}
		}
	}
}

bool BodyStepper::can_go_side_by_side(const Batch &batch, std::uint32_t lanes, const SubstepPlan &plan) const {
	if (batch.count < PACK_WIDTH || std::popcount(lanes) < 2 || !integrator_traits(plan.integrator).step_side_by_side) {
		return false;
	}
	// Thousands of bodies are many megabytes: what need not be read is left where it is.
	return !has_forces_ ||
			std::ranges::none_of(batch.bodies, [&](std::uint32_t body_index) { return body(body_index).is_pushed(); });
}

std::uint32_t BodyStepper::lanes_solved_alone(const Batch &batch, std::uint32_t taking_part, Real elapsed, Real duration) {
	std::uint32_t lanes = borders_bounce_ ? taking_part : batch.touching; // each body remembers its own bounce
	for (std::uint32_t lane = 0; lane < PACK_WIDTH && (surroundings_->has_colliders() || lanes != 0); ++lane) {
		if (!(taking_part >> lane & 1)) {
			continue;
		}
		const bool is_near = collision_.begin_body(*surroundings_, body(batch.bodies[lane]), elapsed, duration, lane);
		lanes |= std::uint32_t(is_near) << lane;
	}
	// Borders are solved for all lanes at once, or for each alone.
	return lanes == 0 || world_->borders().empty() ? lanes : taking_part;
}

// The rotations of the last step only where shape matching asks for them: what need not be read is left where it is.
BodyLanes<RealPack> BodyStepper::gather_lanes(const Batch &batch) {
	const std::size_t count = batch.shape->point_count();
	pack_positions_.resize(std::max(pack_positions_.size(), count));
	pack_velocities_.resize(std::max(pack_velocities_.size(), count));
	BodyLanes<RealPack> lanes{ { *batch.shape, *batch.settings, {} }, batch.shape->inverse_masses(),
		{ pack_positions_.data(), count }, { pack_velocities_.data(), count } };
	if (batch.settings->turns_with_body()) {
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			const Rotation memory = batch.rotation_memory(lane);
			lanes.model.rotation_memory.c.set(lane, memory.c);
			lanes.model.rotation_memory.s.set(lane, memory.s);
		}
	}
	for (std::size_t i = 0; i < count; ++i) {
		lanes.positions[i] = gather(batch.positions, i);
		lanes.velocities[i] = gather(batch.velocities, i);
	}
	return lanes;
}

void BodyStepper::advance_side_by_side(Batch &batch, std::uint32_t taking_part, std::uint32_t solved_alone,
		const SubstepPlan &plan, Real duration, int substeps, const SweepStarts &sweep_start, bool are_coupled) {
	counts_.substeps += std::uint64_t(substeps) * std::uint64_t(std::popcount(taking_part));
	const SoftBodyShape &shape = *batch.shape;
	const std::size_t count = shape.point_count();
	const BodyLanes<RealPack> lanes = gather_lanes(batch);
	if (solved_alone != 0) {
		pack_start_.assign(lanes.positions.begin(), lanes.positions.end());
		pack_start_.insert(pack_start_.end(), lanes.velocities.begin(), lanes.velocities.end());
	}
	pack_workspace_.begin_body(count);
	const LaneStep<RealPack> step = integrator_traits(plan.integrator).step_side_by_side;
	const Real h = duration / Real(substeps);
	for (int i = 0; i < substeps; ++i) {
		step(lanes, { world_->gravity(), {}, h }, pack_workspace_);
		if (holds_area(shape, *batch.settings)) {
			hold_area<RealPack>(lanes, h);
			pack_workspace_.forces_are_current = RealPack(0) < RealPack(0);
		}
		if (batch.settings->has_limits()) { // before contacts, which have the last word and look along the whole way
			const PackMask crushed = may_break_limits<RealPack>(lanes.model, lanes.positions);
			if (any(crushed)) {
				keep_whole_in_lanes(batch, taking_part, bits(crushed), lanes, h, are_coupled || world_->has_environment());
				pack_workspace_.forces_are_current = RealPack(0) < RealPack(0);
			}
		}
		if (batch.settings->has_damp()) {
			damp_rigid_motion<RealPack>(lanes, h);
		}
		RealPack contacts(0);
		if (solved_alone != 0) {
			contacts = solve_alone(batch, solved_alone, lanes, h, i == 0 ? sweep_start : SweepStarts{});
		} else if (!world_->borders().empty()) {
			contacts = collision_.solve_borders_side_by_side(lanes, world_->borders(), h, batch.bodies, batch.monitored);
		}
		pack_workspace_.forces_are_current = both(pack_workspace_.forces_are_current, !(contacts > RealPack(0)));
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			counts_.contacts += taking_part >> lane & 1 ? std::uint64_t(contacts[lane]) : 0;
		}
	}
	const PackMask sound = is_sound<RealPack>(lanes.positions, lanes.velocities, credible_reach(shape, plan));
	if (any(!sound)) {
		// Bodies keep what they started from until here; those that are ruined fall back on it.
		for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
			if (!sound[lane] && (taking_part >> lane & 1)) {
				for (std::size_t i = 0; solved_alone != 0 && i < count; ++i) {
					batch.positions[lane][i] = lane_of(pack_start_[i], lane);
					batch.velocities[lane][i] = lane_of(pack_start_[count + i], lane);
				}
				reset(batch.bodies[lane], duration);
				for (std::size_t i = 0; i < count; ++i) {
					set_lane(lanes.positions[i], lane, batch.positions[lane][i]);
					set_lane(lanes.velocities[i], lane, batch.velocities[lane][i]);
				}
			}
		}
	}
	for (std::size_t i = 0; i < count; ++i) {
		scatter(lanes.positions[i], batch.positions, i);
		scatter(lanes.velocities[i], batch.velocities, i);
	}
	for (std::uint32_t lane = 0; solved_alone != 0 && lane < PACK_WIDTH; ++lane) {
		const std::uint32_t is_touching = body(batch.bodies[lane]).touch_memory().touching;
		batch.touching = (batch.touching & ~(1u << lane)) | is_touching << lane;
	}
}

// Few bodies are crushed at a time.
void BodyStepper::keep_whole_in_lanes(const Batch &batch, std::uint32_t taking_part, std::uint32_t crushed,
		const BodyLanes<RealPack> &lanes, Real h, bool bears_load) {
	for (std::uint32_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if ((taking_part & crushed) >> lane & 1) {
			SoftBodyData &data = body(batch.bodies[lane]);
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
				positions[i] = limited_[i]; // what the step started from, for those that are ruined
				velocities[i] = limited_[positions.size() + i];
			}
		}
	}
}

// Springs and integrators are most of what a body costs: a body on the ground keeps nobody from going side by side.
RealPack BodyStepper::solve_alone(const Batch &batch, std::uint32_t solved_alone, const BodyLanes<RealPack> &lanes, Real h,
		const SweepStarts &sweep_start) {
	const std::size_t hull_count = batch.shape->hull_count();
	before_.resize(std::max(before_.size(), PACK_WIDTH * hull_count));
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (solved_alone >> lane & 1) {
			std::copy_n(sweep_start[lane] != nullptr ? sweep_start[lane] : batch.positions[lane], hull_count, &before_[lane * hull_count]);
		}
	}
	for (std::size_t i = 0; i < lanes.positions.size(); ++i) {
		scatter(lanes.positions[i], batch.positions, i);
		scatter(lanes.velocities[i], batch.velocities, i);
	}
	RealPack contacts(0);
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		if (solved_alone >> lane & 1) {
			SoftBodyData &data = body(batch.bodies[lane]);
			const std::span<const Vec2> before(&before_[lane * hull_count], hull_count);
			contacts.set(lane, Real(collision_.handle(data, before, data.total_acceleration(world_->gravity()), h, lane)));
		}
	}
	for (std::size_t i = 0; i < lanes.positions.size(); ++i) {
		lanes.positions[i] = gather(batch.positions, i);
		lanes.velocities[i] = gather(batch.velocities, i);
	}
	return contacts;
}

// What is monitored writes a log, and what is ruined is reset, by the narrower code alone.
bool BodyStepper::advance_wide(const std::array<Batch *, 2> &batches, const SubstepPlan &plan, Real duration,
		int substeps, const std::array<SolverBody *, WIDE_WIDTH> &solver_bodies, StatePrefetch &prefetch) {
	if (wide_ == nullptr || (batches[0]->monitored | batches[1]->monitored) != 0) {
		return false;
	}
	WideTimeSlice slice;
	slice.batches = { batches[0], batches[1] };
	slice.borders = world_->borders();
	slice.integrator = plan.integrator;
	slice.gravity = world_->gravity();
	slice.h = duration / Real(substeps);
	slice.substeps = substeps;
	slice.reach = credible_reach(*batches[0]->shape, plan);
	slice.solver_bodies = solver_bodies;
	for (std::size_t lane = 0; batches[0]->settings->turns_with_body() && lane < WIDE_WIDTH; ++lane) {
		slice.rotation_memories[lane] = batches[lane / PACK_WIDTH]->rotation_memory(lane % PACK_WIDTH);
	}
	const std::optional<std::uint64_t> contacts = wide_->advance(slice, prefetch);
	if (!contacts) {
		return false;
	}
	counts_.contacts += *contacts;
	counts_.substeps += std::uint64_t(substeps) * WIDE_WIDTH;
	return true;
}

void BodyStepper::advance_alone(std::uint32_t body_index, const SubstepPlan &plan, Real elapsed, Real duration, int substeps,
		const Vec2 *sweep_start, bool is_coupled) {
	SoftBodyData &data = body(body_index);
	const std::size_t count = data.point_count();
	workspace_.begin_body(count);
	before_.resize(std::max(before_.size(), count));
	external_.assign(count, Vec2{});
	for (const ExternalForce &external : data.external_forces()) {
		external_[external.point] += external.force;
	}
	// Like forces on the points: XPBD keeps its books by the world's gravity.
	const Vec2 gravity = data.total_acceleration(world_->gravity());
	const Vec2 extra = gravity - world_->gravity() * data.settings().gravity_scale;
	for (std::size_t i = 0; extra != Vec2{} && i < count; ++i) {
		external_[i] += extra * data.shape().masses()[i];
	}
	start_.assign(data.positions().begin(), data.positions().end());
	start_.insert(start_.end(), data.velocities().begin(), data.velocities().end());
	const IntegratorStep step = integrator_traits(plan.integrator).step;
	const Real h = duration / Real(substeps);
	const bool has_load = data.queued_load() != RigidLoad{};
	SubstepInput input{ world_->gravity(), external_, h };
	const std::span<Vec2> before(before_.data(), count);
	collision_.begin_body(*surroundings_, data, elapsed, duration);
	const bool meets_itself = data.settings().self_collision && !is_coupled;
	// Nor may what a body pushes itself by carry it through a thin wall, not even between two steps.
	std::vector<Vec2> &outside = data.last_valid_hull();
	if (sweep_start == nullptr && !outside.empty()) {
		sweep_start = outside.data();
	}
	for (int i = 0; i < substeps; ++i) {
		std::ranges::copy(data.positions(), before.begin());
		if (meets_itself) {
			hull_before_.assign(data.hull().begin(), data.hull().end());
		}
		if (sweep_start != nullptr) {
			std::copy_n(sweep_start, data.shape().hull_count(), before.begin());
			sweep_start = nullptr;
		}
		if (has_load) {
			load_.assign(external_.begin(), external_.end());
			add_rigid_load(data, load_);
			input.external = load_;
			workspace_.forces_are_current = false; // as the load turns with the body
		}
		step(data, input, workspace_);
		if (holds_area(data.shape(), data.settings())) {
			hold_area<Real>(lanes_of(data), h);
			workspace_.forces_are_current = false;
		}
		// Before contacts, which have the last word and look along the whole way.
		if (keep_whole(data, h, is_coupled || world_->has_environment())) {
			workspace_.forces_are_current = false;
		}
		if (data.settings().has_damp()) {
			damp_rigid_motion(lanes_of(data), h);
			workspace_.forces_are_current &= !data.has_pins(); // or else no spring feels it
		}
		std::size_t contacts = collision_.handle(data, before, gravity, h);
		counts_.contacts += contacts;
		if (meets_itself) {
			outside.assign(data.hull().begin(), data.hull().end());
			const std::size_t self_contacts = self_collision_.handle(data, hull_before_, h);
			if (self_contacts > 0) {
				sweep_start = outside.data();
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
	if (!is_sound<Real>(data.positions(), data.velocities(), credible_reach(data.shape(), plan))) {
		std::ranges::copy(std::span(start_).first(count), data.mutable_positions().begin());
		std::ranges::copy(std::span(start_).last(count), data.mutable_velocities().begin());
		reset(body_index, duration);
	}
}

std::array<BodyFrame, PACK_WIDTH> BodyStepper::measure_frames(const Batch &batch) {
	std::array<BodyFrame, PACK_WIDTH> frames;
	if (batch.count < PACK_WIDTH) {
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			frames[lane] = measure_frame(body(batch.bodies[lane]));
		}
		return frames;
	}
	const BodyLanes<RealPack> lanes = gather_lanes(batch);
	const auto all = measure_frame<RealPack>(*batch.shape, lanes.model.rotation_memory, lanes.positions, lanes.velocities);
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		frames[lane] = { lane_of(all.center, lane), lane_of(all.velocity, lane), { all.rotation.c[lane], all.rotation.s[lane] },
			all.rotation_defined[lane] != 0, all.inertia[lane], all.angular_velocity[lane] };
	}
	return frames;
}

void BodyStepper::remember_rotations(const Batch &batch, std::uint32_t lanes, const std::array<BodyFrame, PACK_WIDTH> &frames) {
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		if (lanes >> lane & 1) {
			body(batch.bodies[lane]).set_rotation_memory(frames[lane].rotation); // the memory itself where it is not defined
		}
	}
}

void BodyStepper::solve_self_contacts(std::uint32_t body_index, std::span<const Vec2> before, Real h) {
	counts_.self_contacts += self_collision_.handle(body(body_index), before, h);
}

void BodyStepper::end(const Batch &batch, std::uint32_t lanes) {
	for (std::uint32_t lane = 0; has_forces_ && lane < batch.count; ++lane) {
		if (lanes >> lane & 1) {
			body(batch.bodies[lane]).clear_external_forces();
		}
	}
}

void BodyStepper::check(const Batch &batch, std::uint32_t lanes, Real dt) {
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		const std::size_t count = batch.shape->point_count();
		if ((lanes >> lane & 1) && !is_finite({ batch.positions[lane], count }, { batch.velocities[lane], count })) {
			reset(batch.bodies[lane], dt);
		}
	}
}

// The rest shape where the body was, moving as it did, as far as that can be believed. Not the shape it had: what
// ruined the body may already have been in it, and would again.
void BodyStepper::reset(std::uint32_t body_index, Real dt) {
	SoftBodyData &data = body(body_index);
	const BodyFrame frame = measure_frame(data);
	Vec2 center = frame.center;
	Rotation rotation = data.rotation_memory();
	const Real size = length(Vec2{ rotation.c, rotation.s });
	if (!(size > Real(0.5) && size < 2)) { // NaN compares false; roundings do not get so far
		rotation = {};
		data.set_rotation_memory(rotation);
	}
	Vec2 velocity;
	const bool is_whole = is_finite(center) && is_together(data);
	if (!is_finite(center)) {
		center = center_by_finite_points(data);
	} else if (is_whole) {
		rotation = frame.rotation;
		if (!data.has_pins() && length(frame.velocity) * dt <= CREDIBLE_REACH * data.shape().radius()) {
			velocity = frame.velocity;
		}
	}
	if (!is_whole) {
		center = center_by_pins(data, rotation, center);
	}
	for (std::size_t i = 0; i < data.point_count(); ++i) {
		const bool is_pinned = data.inverse_masses()[i] == 0;
		const Vec2 home = center + rotation.apply(data.shape().rest_positions()[i]);
		data.mutable_positions()[i] = is_pinned && is_finite(data.positions()[i]) ? data.positions()[i] : home;
		data.mutable_velocities()[i] = is_pinned ? Vec2{} : velocity;
	}
	data.touch_memory() = {};
	data.one_ways().clear();
	data.last_valid_hull().clear();
	data.clear_external_forces(); // or they might ruin it once more
	counts_.non_finite.push_back(body_index);
}

} // namespace softbody
