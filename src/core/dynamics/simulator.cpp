// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include "core/base/constants.h"
#include "core/model/body_frame.h"

#include <algorithm>

namespace softbody {

namespace {

// No point farther from the first than any body is stretched; false also for what is not a number.
bool is_together(const SoftBodyData &body) {
	const Real farthest = CREDIBLE_REACH * body.shape().radius();
	return std::ranges::all_of(body.positions(),
			[&](Vec2 p) { return length_squared(p - body.positions()[0]) <= farthest * farthest; });
}

// A blow-up is noticed by its size long before it overflows: by then rounding has swamped the body's centre. Points
// that nothing joins may part.
bool is_ruined(const SoftBodyData &body, const SubstepPlan &plan) {
	const auto finite = [](Vec2 a) { return is_finite(a); };
	return !std::ranges::all_of(body.velocities(), finite) || !std::ranges::all_of(body.positions(), finite) ||
			(plan.frequency > 0 && !is_together(body));
}

// Of the frame at the start of a step, what can be believed.
struct Fallback {
	Vec2 centre;
	Rotation rotation;
	Vec2 velocity;
};

Fallback fallback_of(const SoftBodyData &body, Real dt) {
	const BodyFrame frame = measure_frame(body);
	Fallback fallback{ frame.centre, body.rotation_memory(), {} };
	if (!is_finite(fallback.centre)) {
		fallback.centre = is_finite(body.positions()[0]) ? body.positions()[0] : Vec2{};
	} else if (is_together(body)) {
		fallback.rotation = frame.rotation;
		const bool is_free = std::ranges::find(body.inverse_masses(), Real(0)) == body.inverse_masses().end();
		if (is_free && length(frame.velocity) * dt <= CREDIBLE_REACH * body.shape().radius()) {
			fallback.velocity = frame.velocity;
		}
	}
	return fallback;
}

} // namespace

SubstepPlan Simulator::plan(const SoftBodyData &body, Real dt) const {
	const bool has_contacts = !world_.borders().empty() || !world_.colliders().empty();
	return plan_substeps(body, dt, has_contacts);
}

StepReport Simulator::simulate(Real dt) {
	StepReport report;
	report.refused = check_above("dt", dt, 0, "s");
	if (report.refused) {
		return report;
	}
	collision_.begin_step();
	for (std::size_t i = 0; i < world_.soft_bodies().size(); ++i) {
		SoftBodyData &body = world_.soft_bodies()[i];
		if (body.is_active()) {
			simulate_body(body, world_.id_at(i), dt, report);
		} else {
			std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
		}
	}
	return report;
}

void Simulator::simulate_body(SoftBodyData &body, BodyId id, Real dt, StepReport &report) {
	const std::size_t count = body.point_count();
	workspace_.begin_body(count);
	before_.resize(std::max(before_.size(), count));
	external_.assign(count, Vec2{});
	for (const ExternalForce &external : body.external_forces()) {
		external_[external.point] += external.force;
	}
	body.clear_external_forces();
	std::ranges::copy(body.positions(), body.mutable_previous_positions().begin());
	const Fallback fallback = fallback_of(body, dt);

	const SubstepPlan chosen = plan(body, dt);
	const IntegratorStep step = integrator_traits(chosen.integrator).step;
	const Real h = dt / Real(chosen.substeps);
	const SubstepInput input{ world_.gravity(), external_, h };
	const std::span<Vec2> before(before_.data(), count);
	const Vec2 gravity = world_.gravity() * body.settings().gravity_scale;
	collision_.begin_body(body, dt);
	for (int i = 0; i < chosen.substeps; ++i) {
		std::ranges::copy(body.positions(), before.begin());
		step(body, input, workspace_);
		const std::size_t contacts = collision_.handle(body, before, gravity, h);
		report.contacts += contacts;
		if (contacts > 0) {
			workspace_.forces_are_current = false;
		}
		report.substeps++;
	}

	if (is_ruined(body, chosen)) {
		// Not the shape at the start of the step: what ruined the body may already have been in it, and would again.
		for (std::size_t i = 0; i < count; ++i) {
			const bool is_pinned = body.inverse_masses()[i] == 0;
			const Vec2 place = fallback.centre + fallback.rotation.apply(body.shape().rest_positions()[i]);
			body.mutable_positions()[i] = is_pinned ? body.previous_positions()[i] : place;
			body.mutable_velocities()[i] = is_pinned ? Vec2{} : fallback.velocity;
		}
		body.touch_memory() = {};
		report.reset_bodies.push_back(id);
	}
	const BodyFrame frame = measure_frame(body);
	if (frame.rotation_defined) {
		body.set_rotation_memory(frame.rotation);
	}
}

} // namespace softbody
