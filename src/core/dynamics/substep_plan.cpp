// SPDX-License-Identifier: MIT
// How many substeps a body needs.
#include "core/dynamics/substep_plan.h"

#include "core/base/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

// Largest h with h²Ω² + 2hΓ <= S². The root of the quadratic, written without the cancellation
// that the textbook form has for small Ω.
double largest_step(double frequency_squared, double damping_rate, double budget) {
	const double root = std::sqrt(damping_rate * damping_rate + frequency_squared * budget * budget);
	const double denominator = damping_rate + root;
	return denominator > 0 ? budget * budget / denominator : std::numeric_limits<double>::infinity();
}

} // namespace

SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts) {
	const double per_mass = double(shape.point_count()) / shape.total_mass();
	const double frequency_squared = shape.spring_frequency_squared() + settings.shape_stiffness * per_mass;
	const double damping_rate = shape.spring_damping_rate() + settings.shape_damping * per_mass;
	const double wanted = std::ceil(double(dt) / largest_step(frequency_squared, damping_rate, STABILITY_BUDGET));
	const int least = has_contacts ? MIN_CONTACT_SUBSTEPS : 1;

	SubstepPlan plan;
	plan.frequency = Real(std::sqrt(frequency_squared));
	plan.damping_rate = Real(damping_rate);
	plan.substeps = settings.substeps > 0 ? settings.substeps
										  : int(std::clamp(wanted, double(least), double(MAX_SUBSTEPS)));
	const double step = double(dt) / plan.substeps;
	plan.stability_margin = Real(largest_step(frequency_squared, damping_rate, 2) / step);
	plan.safe = settings.substeps > 0 ? plan.stability_margin > 1 : wanted <= MAX_SUBSTEPS;
	return plan;
}

} // namespace softbody
