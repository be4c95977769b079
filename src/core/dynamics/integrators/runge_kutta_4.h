// SPDX-License-Identifier: MIT
// The classical fourth-order Runge-Kutta method on the joint state (x, v).
#pragma once

#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/forces.h"

namespace softbody {

// Four slopes of (x, v): at the start, twice in the middle, at the end; weights 1/6, 1/3, 1/3, 1/6.
// The thesis's eq. 3.36 to 3.53 evaluate no new forces at the stages and integrate positions apart
// from velocities, which leaves order 1 at best.
template <class T>
void step_runge_kutta_4(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const std::span<BasicVec2<T>> x = body.positions;
	const std::span<BasicVec2<T>> v = body.velocities;
	const std::span<const Real> w = body.inverse_masses;
	const std::span<BasicVec2<T>> forces(workspace.forces.data(), x.size());
	const std::span<BasicVec2<T>> stage_x(workspace.stage_positions.data(), x.size());
	const std::span<BasicVec2<T>> stage_v(workspace.stage_velocities.data(), x.size());
	const std::span<BasicVec2<T>> sum_x(workspace.position_slopes.data(), x.size());
	const std::span<BasicVec2<T>> sum_v(workspace.velocity_slopes.data(), x.size());

	for (std::size_t i = 0; i < x.size(); ++i) {
		stage_x[i] = x[i];
		stage_v[i] = v[i];
		sum_x[i] = {};
		sum_v[i] = {};
	}
	// Stage s has weight `weights[s]` in the result and leads to the next stage over `reaches[s]` of h.
	constexpr Real weights[4] = { Real(1) / 6, Real(1) / 3, Real(1) / 3, Real(1) / 6 };
	constexpr Real reaches[4] = { Real(0.5), Real(0.5), 1, 0 };
	for (int stage = 0; stage < 4; ++stage) {
		evaluate_forces<T>(body.model, input.gravity, input.external, stage_x, stage_v, forces);
		const Real reach = reaches[stage] * input.h;
		for (std::size_t i = 0; i < x.size(); ++i) {
			const BasicVec2<T> slope_x = stage_v[i];
			const BasicVec2<T> slope_v = forces[i] * w[i];
			sum_x[i] += slope_x * weights[stage];
			sum_v[i] += slope_v * weights[stage];
			stage_x[i] = x[i] + slope_x * reach;
			stage_v[i] = v[i] + slope_v * reach;
		}
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += sum_x[i] * input.h;
		v[i] += sum_v[i] * input.h;
	}
}

} // namespace softbody
