// SPDX-License-Identifier: MIT
// Advances a whole world by one fixed time step.
#include "core/dynamics/simulator.h"

#include "core/model/body_frame.h"

#include <algorithm>

namespace softbody {

namespace {

bool has_finite_state(const SoftBodyData &body) {
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		if (!is_finite(body.positions()[i]) || !is_finite(body.velocities()[i])) {
			return false;
		}
	}
	return true;
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

	if (!has_finite_state(body)) {
		std::ranges::copy(body.previous_positions(), body.mutable_positions().begin());
		std::ranges::fill(body.mutable_velocities(), Vec2{});
		body.touch_memory() = {};
		report.reset_bodies.push_back(id);
	}
	const BodyFrame frame = measure_frame(body);
	if (frame.rotation_defined) {
		body.set_rotation_memory(frame.rotation);
	}
}

} // namespace softbody
