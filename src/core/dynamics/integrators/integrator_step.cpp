// SPDX-License-Identifier: MIT
// The table of integrators.
#include "core/dynamics/integrators/integrator_step.h"

#include "core/dynamics/integrators/lane_steps.h"

#include <array>
#include <limits>
#include <numbers>

namespace softbody {

// For tests and benches that call them by name.
template void step_explicit_euler(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_semi_implicit_euler(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_midpoint(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_heun(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_runge_kutta_4(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_velocity_verlet(const BodyLanes<Real> &, const SubstepInput &, IntegratorWorkspace &);
template void step_explicit_euler(
		const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);
template void step_semi_implicit_euler(
		const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);
template void step_midpoint(
		const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);
template void step_heun(const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);
template void step_runge_kutta_4(
		const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);
template void step_velocity_verlet(
		const BodyLanes<RealPack> &, const BasicSubstepInput<RealPack> &, BasicWorkspace<RealPack> &);

namespace {

template <LaneStep<Real> step>
void step_one(SoftBodyData &body, const SubstepInput &input, IntegratorWorkspace &workspace) {
	step(lanes_of(body), input, workspace);
}

} // namespace

const IntegratorTraits &integrator_traits(Integrator integrator) {
	static constexpr double NONE = 0;
	static constexpr double SQRT_8 = 2 * std::numbers::sqrt2;
	static constexpr double INFINITE = std::numeric_limits<double>::infinity();
	static const std::array<IntegratorTraits, INTEGRATOR_COUNT> table = { {
			{ "automatic", 0, 0, NONE, false, true, nullptr, nullptr },
			{ "explicit_euler", 1, 1, NONE, true, true, step_one<step_explicit_euler<Real>>, step_explicit_euler<RealPack> },
			{ "semi_implicit_euler", 1, 1, 2, false, true, step_one<step_semi_implicit_euler<Real>>,
					step_semi_implicit_euler<RealPack> },
			{ "midpoint", 2, 2, NONE, true, true, step_one<step_midpoint<Real>>, step_midpoint<RealPack> },
			{ "heun", 2, 2, NONE, true, true, step_one<step_heun<Real>>, step_heun<RealPack> },
			{ "runge_kutta_4", 4, 4, SQRT_8, true, true, step_one<step_runge_kutta_4<Real>>, step_runge_kutta_4<RealPack> },
			{ "velocity_verlet", 2, 1, 2, true, false, step_one<step_velocity_verlet<Real>>, step_velocity_verlet<RealPack> },
			{ "xpbd", 1, 1, INFINITE, false, false, step_xpbd, nullptr },
	} };
	return table[std::size_t(integrator)];
}

} // namespace softbody
