// SPDX-License-Identifier: MIT
// The explicit integrators, for any scalar type.
#pragma once

#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/integrators/integrator_step.h"

#include <array>
#include <cstddef>
#include <span>

namespace softbody {

/// Positions, velocities and inverse masses of a body, with memory for its forces.
template <class T>
struct SubstepState {
	std::span<BasicVec2<T>> x;
	std::span<BasicVec2<T>> v;
	std::span<const Real> w;
	std::span<BasicVec2<T>> forces;
};

template <class T>
SubstepState<T> substep_state(const BodyLanes<T> &body, BasicWorkspace<T> &workspace) {
	return { body.positions, body.velocities, body.inverse_masses, { workspace.forces.data(), body.positions.size() } };
}

// The thesis's Euler integrator, kept for comparison: x += h v, v += h F(x, v)/m, both from the old state (thesis eq.
// 3.17 to 3.25). On an undamped oscillator every step multiplies the energy by 1 + (hω)².
template <class T>
void step_explicit_euler(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += v[i] * input.h;
		v[i] += forces[i] * (w[i] * input.h);
	}
}

// The default integrator: v += h F(x, v)/m, then x += h v. That is thesis eq. 3.17 to 3.25 with the updated velocity in
// 3.25, which makes the method symplectic for undamped springs.
template <class T>
void step_semi_implicit_euler(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		v[i] += forces[i] * (w[i] * input.h);
		x[i] += v[i] * input.h;
	}
}

// The explicit midpoint method: half an Euler step to (x, v) at t + h/2, then a whole step with the slopes found there.
// The thesis's eq. 3.26 to 3.35 carry this name but average the slopes of both ends (see `step_heun`), and double-count
// as printed. Energy of an undamped oscillator grows by 1 + (hω)⁴/4 a step.
template <class T>
void step_midpoint(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
	const std::span<BasicVec2<T>> middle_x(workspace.stage_positions.data(), x.size());
	const std::span<BasicVec2<T>> middle_v(workspace.stage_velocities.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		middle_x[i] = x[i] + v[i] * (input.h / 2);
		middle_v[i] = v[i] + forces[i] * (w[i] * input.h / 2);
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, middle_x, middle_v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += middle_v[i] * input.h;
		v[i] += forces[i] * (w[i] * input.h);
	}
}

// Heun's method, the intended meaning of the thesis's "midpoint" formulas: a trial Euler step, then a step with the
// mean of the slopes at both ends: thesis eq. 3.26 to 3.35 without the double count in 3.30 and 3.35. Same order and
// stability as the midpoint method.
template <class T>
void step_heun(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
	const std::span<BasicVec2<T>> end_x(workspace.stage_positions.data(), x.size());
	const std::span<BasicVec2<T>> end_v(workspace.stage_velocities.data(), x.size());
	const std::span<BasicVec2<T>> first_forces(workspace.velocity_slopes.data(), x.size());
	evaluate_forces<T>(body.model, input.gravity, input.external, x, v, first_forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		end_x[i] = x[i] + v[i] * input.h;
		end_v[i] = v[i] + first_forces[i] * (w[i] * input.h);
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, end_x, end_v, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		x[i] += (v[i] + end_v[i]) * (input.h / 2);
		v[i] += (first_forces[i] + forces[i]) * (w[i] * input.h / 2);
	}
}

// The classical fourth-order Runge-Kutta method on the joint state. Four slopes of (x, v): at the start, twice in the
// middle, at the end; weights 1/6, 1/3, 1/3, 1/6. The thesis's eq. 3.36 to 3.53 evaluate no new forces at the stages
// and integrate positions apart from velocities, which leaves order 1 at best.
template <class T>
void step_runge_kutta_4(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
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

// Velocity Verlet (leapfrog): kick, drift, kick. v' = v + h/2 F/m; x += h v'; v = v' + h/2 F(x, ·)/m (Swope et al.
// 1982). Damping makes F depend on the velocity at the end, which is not known yet; it is evaluated at the prediction
// v' + h/2 F/m, whose error is O(h²), so the order stays 2. The second kick's forces open the next substep unless
// something changed the state in between: one evaluation a substep.
template <class T>
void step_velocity_verlet(const BodyLanes<T> &body, const BasicSubstepInput<T> &input, BasicWorkspace<T> &workspace) {
	const auto [x, v, w, forces] = substep_state(body, workspace);
	const std::span<BasicVec2<T>> predicted(workspace.stage_velocities.data(), x.size());
	if (any(!workspace.forces_are_current)) {
		const std::span<BasicVec2<T>> fresh(workspace.velocity_slopes.data(), x.size());
		evaluate_forces<T>(body.model, input.gravity, input.external, x, v, fresh);
		for (std::size_t i = 0; i < x.size(); ++i) {
			forces[i] = select(workspace.forces_are_current, forces[i], fresh[i]);
		}
	}
	for (std::size_t i = 0; i < x.size(); ++i) {
		const BasicVec2<T> kick = forces[i] * (w[i] * input.h / 2);
		v[i] += kick;
		x[i] += v[i] * input.h;
		predicted[i] = v[i] + kick;
	}
	evaluate_forces<T>(body.model, input.gravity, input.external, x, predicted, forces);
	for (std::size_t i = 0; i < x.size(); ++i) {
		v[i] += forces[i] * (w[i] * input.h / 2);
	}
	workspace.forces_are_current = T(0) < T(1);
}

/// The step function of each method, by `Integrator`. Null for AUTOMATIC, which is not a method, and for XPBD.
template <class T>
inline constexpr std::array<LaneStep<T>, INTEGRATOR_COUNT> LANE_STEPS = { nullptr, step_explicit_euler<T>,
	step_semi_implicit_euler<T>, step_midpoint<T>, step_heun<T>, step_runge_kutta_4<T>, step_velocity_verlet<T>, nullptr };

} // namespace softbody
