// SPDX-License-Identifier: MIT
// Which integrator and how many substeps a body needs.
#include "core/dynamics/substep_plan.h"

#include "core/base/constants.h"
#include "core/dynamics/integrators/integrator_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Largest h with h²Ω² + 2h·rate <= S². The root of the quadratic, written without the cancellation
// that the textbook form has for small Ω.
double within_quadratic(double frequency_squared, double rate, double budget) {
	const double root = std::sqrt(rate * rate + frequency_squared * budget * budget);
	const double denominator = rate + root;
	return denominator > 0 ? budget * budget / denominator : INFINITE;
}

double ratio(double numerator, double denominator) {
	return denominator > 0 ? numerator / denominator : INFINITE;
}

} // namespace

FrequencyBounds frequency_bounds(const SoftBodyShape &shape, const BodySettings &settings) {
	const double per_mass = double(shape.point_count()) / shape.total_mass();
	FrequencyBounds bounds;
	bounds.frequency_squared = shape.spring_frequency_squared() + settings.shape_stiffness * per_mass +
			settings.pressure_stiffness *
					(double(shape.area_mobility()) / shape.rest_area() + 1 / double(shape.least_hull_mass()));
	bounds.damping_rate = shape.spring_damping_rate() + settings.shape_damping * per_mass;
	return bounds;
}

double largest_stable_step(Integrator integrator, const FrequencyBounds &bounds, double budget) {
	const double frequency = std::sqrt(bounds.frequency_squared);
	const double rate = bounds.damping_rate;
	switch (integrator) {
		case Integrator::EXPLICIT_EULER:
			return bounds.frequency_squared > 0
					? std::min(budget / 2 * rate / bounds.frequency_squared, ratio(budget, rate))
					: ratio(budget, rate);
		case Integrator::MIDPOINT:
		case Integrator::HEUN:
			return frequency > 0 ? std::min(std::cbrt(budget / 2 * 4 * rate / frequency) / frequency, ratio(budget, rate))
								 : ratio(budget, rate);
		case Integrator::RUNGE_KUTTA_4:
			return ratio(budget / 2 * 2.6, std::max(frequency, rate));
		case Integrator::XPBD:
			return INFINITE;
		case Integrator::VELOCITY_VERLET:
			return within_quadratic(bounds.frequency_squared, 2 * rate, budget);
		case Integrator::AUTOMATIC:
		case Integrator::SEMI_IMPLICIT_EULER:
			break;
	}
	return within_quadratic(bounds.frequency_squared, rate, budget);
}

SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts) {
	const FrequencyBounds bounds = frequency_bounds(shape, settings);
	const bool automatic = settings.integrator == Integrator::AUTOMATIC;
	const int least = has_contacts ? MIN_CONTACT_SUBSTEPS : 1;
	SubstepPlan plan;
	plan.frequency = Real(std::sqrt(bounds.frequency_squared));
	plan.damping_rate = Real(bounds.damping_rate);
	// Without contacts Verlet costs the same and is of order 2. Each contact makes it evaluate its forces
	// twice, and a resting body trembles more under it; there semi-implicit Euler is the better choice.
	const Integrator chosen = has_contacts ? Integrator::SEMI_IMPLICIT_EULER : Integrator::VELOCITY_VERLET;
	plan.integrator = automatic ? chosen : settings.integrator;

	const double wanted = std::ceil(double(dt) / largest_stable_step(plan.integrator, bounds, STABILITY_BUDGET));
	if (settings.substeps > 0) {
		plan.substeps = settings.substeps;
		plan.reason = PlanReason::FIXED;
	} else if (automatic && wanted > EXPLICIT_SUBSTEP_CAP) {
		plan.integrator = Integrator::XPBD;
		plan.substeps = XPBD_SUBSTEPS;
		plan.reason = PlanReason::TOO_STIFF;
	} else if (plan.integrator == Integrator::XPBD) {
		plan.substeps = XPBD_SUBSTEPS;
		plan.reason = PlanReason::CONTACTS;
	} else if (!(wanted <= MAX_SUBSTEPS)) { // not ">": an unstable method wants infinitely many
		plan.substeps = MAX_SUBSTEPS;
		plan.reason = PlanReason::UNSTABLE;
	} else {
		plan.substeps = std::max(int(wanted), least);
		plan.reason = wanted < least ? PlanReason::CONTACTS : PlanReason::STABILITY;
	}

	const double step = double(dt) / plan.substeps;
	plan.stability_margin = Real(largest_stable_step(plan.integrator, bounds, 2) / step);
	plan.safe = plan.stability_margin > 1 && plan.reason != PlanReason::UNSTABLE;
	plan.cost = Real(plan.substeps * integrator_traits(plan.integrator).evaluations) *
			Real(shape.point_count() + shape.springs().size());
	return plan;
}

} // namespace softbody
