// SPDX-License-Identifier: MIT
// Which bodies may take their step as rigid ones, and the part of it that is done body by body.
#include "core/dynamics/rigid_flight.h"

#include "core/base/elementary.h"
#include "core/collision/surface_constraint.h"
#include "core/dynamics/body_stepper.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/dynamics/rigid_flight_lanes.h"

#include <algorithm>

namespace softbody {

// A pressure that aims at another area, and springs that are tense, pull the body out of its rest shape. Explicit Euler gains energy as it
// falls; it stays what it is.
bool can_fly(const SoftBodyShape &shape, const BodySettings &settings, const SubstepPlan &plan) {
	const bool is_solid = settings.is_elastic() && (shape.modes() != nullptr || shape.triangles() != nullptr);
	const bool is_slack = settings.inflation == 1 && (!settings.has_springs() || !shape.is_tense());
	return settings.can_fly_rigid && is_solid && is_slack && !settings.can_dent() && plan.integrator != Integrator::EXPLICIT_EULER;
}

FlightSlice flight_slice(const BodySettings &settings, const SubstepPlan &plan, Vec2 gravity, std::span<const Border> borders, Real dt) {
	FlightSlice slice;
	slice.acceleration = gravity * settings.gravity_scale;
	slice.duration = dt;
	slice.substeps = plan.substeps;
	slice.h = dt / Real(plan.substeps);
	slice.early = integrator_traits(plan.integrator).velocity_leads ? Real(0.5) : Real(1);
	if (settings.has_damp()) {
		slice.lost = Real(-exponential_minus_one(-double(settings.linear_damp) * double(slice.h)));
		slice.lost_spin = Real(-exponential_minus_one(-double(settings.angular_damp) * double(slice.h)));
	}
	slice.borders = borders;
	return slice;
}

FlightResult fly_alone(SoftBodyData &body, const FlightSlice &slice, FlightGate &gate) {
	return fly_lanes<Real>(lanes_of(body), slice, gate);
}

std::uint32_t BodyStepper::fly(const Batch &batch, Real dt) {
	const WorldData &world = context_->world;
	if (!can_fly(*batch.shape, *batch.settings, *batch.plan)) {
		return 0;
	}
	// What a body remembers of a touch is followed in full, and so are loads of its own.
	const auto must_stay = [&](std::size_t lane) {
		SoftBodyData &data = body(batch.body_indices[lane]);
		return !data.is_free() || context_->bodies.has_touch(batch.active_indices[lane]) || !data.pair_memories().empty() || !data.one_ways().empty() ||
				(context_->has_forces && data.is_pushed());
	};
	std::uint32_t staying = 0;
	for (std::size_t lane = 0; lane < batch.count; ++lane) {
		staying |= std::uint32_t(must_stay(lane)) << lane;
	}
	if (staying == (1u << batch.count) - 1) {
		return 0;
	}
	struct Gate final : FlightGate {
		BodyStepper &stepper;
		const Batch &batch;
		std::uint32_t staying;
		Gate(BodyStepper &stepper, const Batch &batch, std::uint32_t staying) : stepper(stepper), batch(batch), staying(staying) {}
		bool is_clear(std::size_t lane, Vec2 center, Real reach) override {
			if ((staying >> lane & 1) != 0) {
				return false;
			}
			SoftBodyData &data = stepper.body(batch.body_indices[lane]);
			const StepContext &context = *stepper.context_;
			if (context.colliders.has_colliders()) {
				std::vector<std::uint32_t> &near = stepper.near_colliders_;
				near.clear();
				context.colliders.collect(Aabb{ center, center }.grown(reach), near);
				const std::vector<Collider> &colliders = context.world.colliders();
				if (std::ranges::any_of(near, [&](std::uint32_t i) { return notices(data, colliders[i].surface); })) {
					return false;
				}
			}
			std::ranges::copy(data.positions(), data.mutable_previous_positions().begin());
			return true;
		}
	} gate(*this, batch, staying);
	FlightSlice slice = flight_slice(*batch.settings, *batch.plan, world.gravity(), world.borders(), dt);
	slice.batch = &batch;
	const FlightResult result = batch.count == 1 ? fly_alone(body(batch.body_indices[0]), slice, gate) : lanes_for(batch).fly(slice, gate);
	for (std::size_t lane = 0; result.flown != 0 && lane < batch.count; ++lane) {
		if ((result.flown >> lane & 1) == 0) {
			continue;
		}
		SoftBodyData &data = body(batch.body_indices[lane]);
		data.set_rotation_memory(result.rotations[lane]);
		data.set_placed(false);
		data.last_valid_hull().clear();
		if (world.has_sleeping()) {
			Batch alone = batch;
			alone.count = 1;
			alone.active_indices[0] = batch.active_indices[lane];
			alone.body_indices[0] = batch.body_indices[lane];
			alone.states[0] = batch.states[lane];
			time_rest(alone, dt);
		}
	}
	return result.flown;
}

} // namespace softbody
