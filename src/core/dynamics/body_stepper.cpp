// SPDX-License-Identifier: MIT
// Advances batches of bodies through a time slice of a step.
#include "core/dynamics/body_stepper.h"

#include "core/base/constants.h"
#include "core/dynamics/body_reset.h"
#include "core/dynamics/shape_limits_lanes.h"
#include "core/dynamics/slice_lanes.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

bool is_pressed(const SoftBodyData &body) {
	return hull_area<Real>(body.hull()) < pressed_area(body.settings()) * body.shape().rest_area();
}

} // namespace

void BodyStepper::begin_step(const StepContext &context) {
	context_.emplace(context);
	counts_.substeps = 0;
	counts_.contacts = 0;
	counts_.self_contacts = 0;
	counts_.non_finite.clear();
	counts_.dented.clear();
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
	if (can_use_lanes(batch)) {
		advance_lanes(batch, slice, prefetch);
		return;
	}
	prefetch.ask_all();
	for (std::size_t lane = 0; lane < batch.count; ++lane) {
		if (slice.is_coupled && context_->pairs_bounce) {
			SolverBody &solver_body = context_->bodies.solver_body(batch.active_indices[lane]);
			const Translation motion = measure_translation(body(batch.body_indices[lane]));
			solver_body.mass_center = motion.center;
			solver_body.mass_velocity = motion.velocity;
		}
		batch.shape->chain() != nullptr ? advance_chain(batch, lane, slice) : advance_one(batch, lane, slice);
		if (slice.is_coupled) {
			context_->bodies.solver_body(batch.active_indices[lane]).measure_extent();
		}
	}
}

bool BodyStepper::can_use_lanes(const Batch &batch) const {
	if (batch.count == 1 || batch.plan->integrator == Integrator::XPBD) {
		return false;
	}
	// Thousands of bodies take many megabytes: a body is read only if needed.
	return !context_->has_forces || std::none_of(batch.body_indices.begin(), batch.body_indices.begin() + batch.count,
											[&](std::uint32_t body_index) { return body(body_index).is_pushed(); });
}

std::uint32_t BodyStepper::lanes_solved_alone(const Batch &batch, const TimeSlice &slice) {
	std::uint32_t lanes = 0;
	if (may_bounce_on_borders(batch) && bounces_by_points(*batch.shape, *batch.settings)) {
		lanes = (1u << batch.count) - 1;
	}
	for (std::uint32_t lane = 0; lane < batch.count && (context_->colliders.has_colliders() || lanes != 0); ++lane) {
		const bool is_near =
				collision_.begin_body(context_->colliders, body(batch.body_indices[lane]), slice.elapsed, slice.duration, lane);
		lanes |= std::uint32_t(is_near) << lane;
	}
	return lanes;
}

bool BodyStepper::may_bounce_on_borders(const Batch &batch) const {
	return context_->borders_bounce || (batch.settings->restitution > 0 && !context_->world.borders().empty());
}

// Other bodies, or the body itself, may have pushed it through a thin wall since its contacts with colliders were last
// solved, in this step or in the last one.
const Vec2 *BodyStepper::sweep_start(std::uint32_t active_index, std::uint32_t body_index, const TimeSlice &slice) {
	if (!context_->colliders.has_colliders()) {
		return nullptr;
	}
	if (slice.elapsed > 0) {
		return context_->bodies.sweep_start(active_index).data();
	}
	const std::vector<Vec2> &outside = body(body_index).last_valid_hull();
	return outside.empty() ? nullptr : outside.data();
}

void BodyStepper::keep_start(const Batch &batch, std::size_t lane) {
	const std::size_t size = 2 * batch.shape->point_count();
	start_.resize(std::max(start_.size(), (lane + 1) * size));
	std::copy_n(batch.states[lane], size, start_.begin() + std::ptrdiff_t(lane * size));
}

void BodyStepper::restore_start(const Batch &batch, std::size_t lane) const {
	const std::size_t size = 2 * batch.shape->point_count();
	std::copy_n(start_.begin() + std::ptrdiff_t(lane * size), size, batch.states[lane]);
}

void BodyStepper::advance_lanes(const Batch &batch, const TimeSlice &slice, StatePrefetch &prefetch) {
	const WorldData &world = context_->world;
	const std::size_t hull_count = batch.shape->hull_count();
	limited_.resize(std::max(limited_.size(), 2 * batch.shape->point_count()));
	before_.resize(std::max(before_.size(), batch.count * hull_count));
	LaneSlice lanes;
	lanes.batch = &batch;
	lanes.gravity = world.gravity();
	lanes.substeps = slice.substeps_of(*batch.plan);
	lanes.h = slice.duration / Real(lanes.substeps);
	lanes.reach = credible_reach(*batch.shape, *batch.plan);
	lanes.bears_load = slice.is_coupled || world.has_environment();
	lanes.borders = world.borders();
	lanes.solved_alone = lanes_solved_alone(batch, slice);
	lanes.scratch = limited_;
	lanes.may_bounce = may_bounce_on_borders(batch);
	for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
		lanes.touching |= std::uint32_t(context_->bodies.has_touch(batch.active_indices[lane]) != 0) << lane;
	}
	lanes.touching &= ~lanes.solved_alone;
	struct Contacts final : LoneContacts {
		BodyStepper &stepper;
		const Batch &batch;
		Real h;
		Contacts(BodyStepper &stepper, const Batch &batch, Real h) : stepper(stepper), batch(batch), h(h) {}
		std::span<Vec2> before(std::size_t lane) const {
			const std::size_t hull_count = batch.shape->hull_count();
			return { stepper.before_.data() + lane * hull_count, hull_count };
		}
		std::size_t solve(std::size_t lane) override {
			SoftBodyData &data = stepper.body(batch.body_indices[lane]);
			const Vec2 gravity = data.total_acceleration(stepper.context_->world.gravity());
			const std::size_t contacts = stepper.collision_.handle(data, before(lane), gravity, h, lane);
			std::ranges::copy(data.hull(), before(lane).begin());
			return contacts;
		}
		bool follow_bounce(std::size_t lane, const ContactLoad &load, Vec2 velocity) override {
			TouchMemory &touch = stepper.body(batch.body_indices[lane]).touch_memory();
			const Real threshold = RESTITUTION_SUBSTEPS * length(stepper.body(batch.body_indices[lane]).total_acceleration(stepper.context_->world.gravity())) * h;
			softbody::follow_bounce(touch, load, velocity, batch.shape->total_mass(), threshold, h);
			stepper.context_->bodies.has_touch(batch.active_indices[lane]) = char(touch.touching);
			return touch.touching;
		}
		void report(const ContactPoint &contact) override { stepper.log().add(contact); }
	} contacts(*this, batch, lanes.h);
	lanes.lone_contacts = &contacts;
	lanes.pairs_bounce = slice.is_coupled && context_->pairs_bounce;
	for (std::size_t lane = 0; slice.is_coupled && lane < batch.count; ++lane) {
		lanes.solver_bodies[lane] = &context_->bodies.solver_body(batch.active_indices[lane]);
	}
	for (std::size_t lane = 0; lanes.solved_alone != 0 && lane < batch.count; ++lane) {
		keep_start(batch, lane);
		const Vec2 *sweep = sweep_start(batch.active_indices[lane], batch.body_indices[lane], slice);
		std::copy_n(sweep != nullptr ? sweep : batch.states[lane], hull_count, contacts.before(lane).begin());
	}
	const LaneResult result = lanes_for(batch).advance(lanes, prefetch);
	counts_.substeps += std::uint64_t(lanes.substeps) * batch.count;
	counts_.contacts += result.contacts;
	for (std::size_t lane = 0; (result.ruined | lanes.solved_alone) != 0 && lane < batch.count; ++lane) {
		const std::uint32_t active_index = batch.active_indices[lane];
		if (result.ruined >> lane & 1) {
			if (lanes.solved_alone != 0) {
				restore_start(batch, lane);
			}
			reset(batch.body_indices[lane], slice.duration);
			if (slice.is_coupled) {
				context_->bodies.solver_body(active_index).measure_extent();
			}
		}
		if (lanes.solved_alone != 0) {
			context_->bodies.has_touch(active_index) = char(body(batch.body_indices[lane]).touch_memory().touching);
		}
	}
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
	keep_start(batch, lane);
	const IntegratorStep step = integrator_traits(plan.integrator).step;
	const Real h = slice.duration / Real(substeps);
	const bool has_load = data.queued_load() != RigidLoad{};
	SubstepInput input{ world.gravity(), external_, h, plan.implicit_share };
	const std::span<Vec2> before(before_.data(), count);
	collision_.begin_body(context_->colliders, data, slice.elapsed, slice.duration);
	const bool meets_itself = data.settings().self_collision && !slice.is_coupled;
	const bool may_dent = data.settings().can_dent() && data.takes_damage();
	bool is_dented = false;
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
		if (has_load) {
			load_.assign(external_.begin(), external_.end());
			add_rigid_load(data, load_);
			input.external = load_;
			workspace_.forces_are_current = false; // the load turns with the body
		}
		step(data, input, workspace_);
		const bool is_bearing = slice.is_coupled || world.has_environment();
		workspace_.forces_are_current &= keep_shape<Real>(lanes_of(data), h, is_bearing, {});
		workspace_.forces_are_current &= !data.settings().has_damp() || !data.has_pins();
		std::size_t contacts = collision_.handle(data, before, gravity, h, 0, plan.implicit_share);
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
		const bool flows = may_dent && plastic_flow_.flow(data, h);
		is_dented |= flows;
		if (contacts > 0 || flows) {
			workspace_.forces_are_current = false;
		}
	}
	if (is_dented) {
		data.renew_bounds();
		data.rest_state().rest_time = 0;
		counts_.dented.push_back(body_index);
	}
	if (!is_finite_within<Real>(data.positions(), data.velocities(), credible_reach(data.shape(), plan))) {
		restore_start(batch, lane);
		reset(body_index, slice.duration);
		if (slice.is_coupled && data.settings().self_collision) {
			context_->bodies.solver_body(active_index).begin_step(); // no path behind the body that a contact could block
		}
	}
	context_->bodies.has_touch(active_index) = char(data.touch_memory().touching);
}

void BodyStepper::forget_pushes(const Batch &batch) {
	for (std::uint32_t lane = 0; context_->colliders.has_colliders() && !batch.settings->self_collision && lane < batch.count; ++lane) {
		body(batch.body_indices[lane]).last_valid_hull().clear();
	}
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
		const auto moves_below = [&](Real speed) {
			return length_squared(momentum) < speed * speed * mass * mass && twice_energy < speed * speed * mass * wobble * wobble;
		};
		// A body that a load presses to its limits trembles there.
		const bool is_slow = moves_below(slow) || (moves_below(slow * SLEEP_AT_LIMITS) && is_pressed(data));
		data.count_damage_pause(dt);
		RestState &rest = data.rest_state();
		rest.rest_time = is_slow ? rest.rest_time + dt : Real(0);
		if (batch.settings->can_sleep && rest.rest_time > DROWSY_TIME) {
			if (rest.rest_time - dt <= DROWSY_TIME) {
				rest.drowsy_center = measure_frame(data).center;
				rest.drowsy_velocity = momentum * (1 / mass);
				continue; // slowed from the next step on
			}
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
	} else {
		lanes_for(batch).measure_frames(batch, frames);
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
