// SPDX-License-Identifier: MIT
// Chooses the integrator and the number of substeps of a body.
#include "core/dynamics/substep_plan.h"

#include "core/base/constants.h"
#include "core/base/elementary.h"
#include "core/dynamics/chain_solver.h"
#include "core/dynamics/elastic_lanes.h"
#include "core/dynamics/integrators/integrator_step.h"
#include "core/model/body_lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Largest h with h²Ω² + 2h·rate <= S², without the cancellation of the textbook formula for small Ω.
double within_quadratic(double frequency_squared, double rate, double budget) {
	const double root = std::sqrt(rate * rate + frequency_squared * budget * budget);
	const double denominator = rate + root;
	return denominator > 0 ? budget * budget / denominator : INFINITE;
}

double ratio(double numerator, double denominator) {
	return denominator > 0 ? numerator / denominator : INFINITE;
}

// Hull values of the pressure term: sum |∂A/∂x|²/m [length²/mass], and |A/A0 - s|.
struct HullState {
	double area_inverse_mass = 0;
	double excess = 0;
};

// Between crushed flat and twice its target no hull is farther off than this.
HullState hull_at_rest(const SoftBodyShape &shape, const BodySettings &settings) {
	return { shape.area_inverse_mass(), std::max(1.0, double(settings.inflation)) };
}

HullState hull_of(const SoftBodyData &body, Real ahead) {
	const SoftBodyShape &shape = body.shape();
	const std::size_t count = shape.hull_count();
	const auto at = [&](std::size_t i) { return body.positions()[i] + body.velocities()[i] * ahead; };
	double inverse_mass = 0;
	double twice_area = 0;
	Vec2 last = at(count - 1);
	Vec2 here = at(0);
	const Vec2 base = here; // areas relative to a point of the body keep digits far from the origin
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2 next = at(i + 1 == count ? 0 : i + 1);
		inverse_mass += double(length_squared(next - last)) / (4 * double(shape.masses()[i]));
		twice_area += cross(here - base, next - base);
		last = here;
		here = next;
	}
	return { inverse_mass, std::abs(twice_area / (2 * shape.rest_area()) - body.settings().inflation) };
}

// A hull with NaN asks for nothing; the simulator handles the step that made it.
void include(HullState &state, const HullState &other) {
	if (std::isfinite(other.area_inverse_mass) && std::isfinite(other.excess)) {
		state.area_inverse_mass = std::max(state.area_inverse_mass, other.area_inverse_mass);
		state.excess = std::max(state.excess, other.excess);
	}
}

// XPBD damps more in a longer substep, and a dent keeps the difference: a body that may dent has the same substep in short steps.
int xpbd_substeps(const BodySettings &settings, Real dt) {
	if (settings.can_dent() && dt < USUAL_STEP) {
		return std::max(MIN_CONTACT_SUBSTEPS, int(std::lround(XPBD_SUBSTEPS * double(dt) / double(USUAL_STEP))));
	}
	return substeps_of_step(XPBD_SUBSTEPS, dt);
}

bool lives_on_damping(Integrator integrator) {
	return integrator == Integrator::EXPLICIT_EULER || integrator == Integrator::MIDPOINT || integrator == Integrator::HEUN;
}

FrequencyBounds bounds_with(const SoftBodyShape &shape, const BodySettings &settings, const HullState &hull) {
	const double per_mass = double(shape.point_count()) / shape.total_mass();
	const double area_term = settings.pressure_stiffness * hull.area_inverse_mass / shape.rest_area();
	FrequencyBounds bounds;
	double shear_term = 0; // damped, of elastic modes and triangles
	double dilation_term = 0;
	if (settings.is_elastic() && shape.modes() != nullptr) {
		shear_term = double(mode_stiffness(*shape.modes(), settings).rest) * shape.modes()->projection_bound / shape.total_mass();
	}
	if (has_triangles(shape, settings)) {
		shear_term = double(settings.shear_modulus) * shape.triangle_shear_inverse_mass();
		dilation_term = double(settings.area_stiffness) * shape.triangle_dilation_inverse_mass();
	}
	bounds.frequency_squared = double(settings.spring_stiffness_scale) * shape.spring_frequency_squared() + shear_term + settings.shape_stiffness * per_mass + area_term +
			settings.pressure_stiffness * hull.excess / shape.least_hull_mass() + dilation_term;
	bounds.damping_rate = double(settings.spring_damping_scale) * shape.spring_damping_rate() + shear_term * settings.elastic_damping_time + settings.shape_damping * per_mass;
	if (!lives_on_damping(settings.integrator)) {
		return bounds;
	}
	bounds.damping_time = ratio(settings.shape_damping, settings.shape_stiffness + area_term / per_mass);
	if (shear_term > 0) {
		bounds.damping_time = std::min(bounds.damping_time, double(settings.elastic_damping_time));
	}
	for (const Spring2D &spring : shape.springs()) {
		const double stiffness = double(spring.stiffness) * settings.spring_stiffness_scale;
		const double damping = double(spring.damping) * settings.spring_damping_scale;
		if (damping < bounds.damping_time * stiffness) {
			bounds.damping_time = damping / stiffness;
		}
	}
	return bounds;
}

// The faster a wobble is for the substep, the less the midpoint rule shows of it, and the longer it rings on in contacts.
double implicit_share(const SubstepPlan &plan, double h) {
	if (plan.damping_rate > XPBD_STRONG_DAMPING * plan.frequency) {
		return 1;
	}
	const double turn = double(plan.frequency) * h / double(XPBD_FAST_WOBBLE);
	return 1 - 0.5 / (1 + turn * turn);
}

SubstepPlan plan_within(const FrequencyBounds &bounds, const SoftBodyShape &shape, const BodySettings &settings, Real dt,
		bool has_contacts) {
	const bool automatic = settings.integrator == Integrator::AUTOMATIC;
	has_contacts |= settings.self_collision;
	const int least = has_contacts ? substeps_of_step(MIN_CONTACT_SUBSTEPS, dt) : 1;
	SubstepPlan plan;
	plan.frequency = Real(std::sqrt(bounds.frequency_squared));
	plan.damping_rate = Real(bounds.damping_rate);
	// Without contacts Verlet costs the same and is of order 2. With contacts it evaluates its forces twice, and its
	// resting bodies tremble. Moving the points to hold an area invalidates forces too, so it takes Verlet's advantage
	// away as well. Figures: docs/accuracy.md, "The automatic choice".
	const Integrator chosen = has_contacts || holds_area(shape, settings) ? Integrator::SEMI_IMPLICIT_EULER : Integrator::VELOCITY_VERLET;
	plan.integrator = automatic ? chosen : settings.integrator;

	// A damping of -0 counts as none, and gives a step of -0.
	const double largest = std::abs(largest_stable_step(plan.integrator, bounds, STABILITY_BUDGET));
	const double wanted = std::ceil(double(dt) / largest);
	// Methods damp an impact differently, and a dent keeps the difference: what may dent has the same one at any tick rate.
	const double capped = settings.can_dent() && wanted <= MAX_SUBSTEPS ? double(USUAL_STEP) / largest : wanted;
	if (settings.substeps > 0) {
		plan.substeps = settings.substeps;
		plan.reason = PlanReason::FIXED;
	} else if (automatic && capped > EXPLICIT_SUBSTEP_CAP) {
		plan.integrator = Integrator::XPBD;
		plan.substeps = xpbd_substeps(settings, dt);
		plan.reason = PlanReason::TOO_STIFF;
	} else if (plan.integrator == Integrator::XPBD) {
		plan.substeps = xpbd_substeps(settings, dt);
		plan.reason = PlanReason::CONTACTS;
	} else if (!(wanted <= MAX_SUBSTEPS)) { // not ">": an unstable method wants infinitely many
		plan.substeps = MAX_SUBSTEPS;
		plan.reason = PlanReason::UNSTABLE;
	} else {
		plan.substeps = std::max(int(wanted), least);
		plan.reason = wanted < least ? PlanReason::CONTACTS : PlanReason::STABILITY;
	}

	const double step = double(dt) / plan.substeps;
	if (plan.integrator == Integrator::XPBD) {
		plan.implicit_share = Real(implicit_share(plan, step));
	}
	plan.stability_margin = Real(largest_stable_step(plan.integrator, bounds, 2) / step);
	plan.safe = plan.stability_margin > 1 && plan.reason != PlanReason::UNSTABLE;
	const std::size_t triangles = has_triangles(shape, settings) ? shape.triangles()->triangles.size() : 0;
	plan.cost = Real(plan.substeps * integrator_traits(plan.integrator).evaluations) *
			Real(shape.point_count() + shape.springs().size() + triangles);
	return plan;
}

} // namespace

// Rounded up, with tolerance for rounding: a step of 1/60 s is no longer than one of 1/60 s.
int substeps_of_step(int in_usual_step, Real dt) {
	const double wanted = std::ceil(double(in_usual_step) * (double(dt) / double(USUAL_STEP)) - 1e-3);
	return int(std::clamp(wanted, double(in_usual_step), double(std::max(in_usual_step, MAX_CONTACT_SUBSTEPS))));
}

FrequencyBounds frequency_bounds(const SoftBodyShape &shape, const BodySettings &settings) {
	return bounds_with(shape, settings, hull_at_rest(shape, settings));
}

FrequencyBounds frequency_bounds(const SoftBodyData &body, Real dt) {
	HullState hull = hull_at_rest(body.shape(), body.settings());
	if (body.settings().pressure_stiffness > 0) {
		include(hull, hull_of(body, 0));
		include(hull, hull_of(body, dt));
	}
	return bounds_with(body.shape(), body.settings(), hull);
}

// The roots z of z² + c z + k = 0, see the header, give the growth R(hz) of a step. Below, w = hz, r = |w|, q = hc/2.
double largest_stable_step(Integrator integrator, const FrequencyBounds &bounds, double budget) {
	const double rate = bounds.damping_rate;
	const double time = bounds.damping_time;
	switch (integrator) {
		case Integrator::EXPLICIT_EULER:
			// |1 + w|² = 1 - hc + h²k for complex roots: no growth for h k <= c, which h <= β grants. Real ones lie
			// between -c and 0, and -2 <= w <= 0 does not grow.
			return std::min(budget / 2 * time, ratio(budget, rate));
		case Integrator::MIDPOINT:
		case Integrator::HEUN: {
			// R = 1 + w + w²/2. Real roots as above. For complex ones |R|² = 1 - 2q + 2q² - q r² + r⁴/4, so there is no
			// growth for r⁴/4 <= q (2 - 2q + r²). The right side is concave in q: its ends decide. At the upper,
			// q = r or q = 1, it holds for r <= 2. At the lower, q = β r²/(2h): if h >= β, then 2 - 2q + r² >= 2, and
			// h³ k <= 4β suffices, where r < 2 too; if h < β, the least q is r²/2, where it says r <= 2, as q <= 1 does.
			const double slow = ratio(budget / 2 * 4 * time, bounds.frequency_squared);
			return std::min(std::max(cube_root(slow), budget / 2 * time), ratio(budget, rate));
		}
		case Integrator::RUNGE_KUTTA_4:
			return ratio(budget / 2 * 2.6, std::max(std::sqrt(bounds.frequency_squared), rate));
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

SubstepPlan plan_near_rest(const SubstepPlan &plan, const SoftBodyShape &shape, const BodySettings &settings, Real dt) {
	SubstepPlan calm = plan;
	if (plan.reason != PlanReason::STABILITY || plan.integrator != Integrator::SEMI_IMPLICIT_EULER || settings.pressure_stiffness > 0) {
		return calm;
	}
	FrequencyBounds bounds = frequency_bounds(shape, settings);
	bounds.frequency_squared -= double(settings.spring_stiffness_scale) * (shape.spring_frequency_squared() - shape.rest_spring_frequency_squared());
	bounds.damping_rate -= double(settings.spring_damping_scale) * (shape.spring_damping_rate() - shape.rest_spring_damping_rate());
	if (!(bounds.damping_rate > 2 * CALM_DAMPING * std::sqrt(bounds.frequency_squared))) {
		return calm; // what a moment out of the bounds has added would stay
	}
	const double wanted = std::ceil(double(dt) / std::abs(largest_stable_step(plan.integrator, bounds, STABILITY_BUDGET)));
	calm.substeps = std::min(std::max(int(wanted), substeps_of_step(MIN_CONTACT_SUBSTEPS, dt)), plan.substeps);
	return calm;
}

namespace {

// Stable with any: its equations are solved for the end of the substep.
SubstepPlan plan_chain(const SoftBodyShape &shape, const BodySettings &settings, Real dt) {
	SubstepPlan plan;
	plan.substeps = settings.substeps > 0 ? settings.substeps : substeps_of_step(CHAIN_SUBSTEPS, dt);
	plan.reason = settings.substeps > 0 ? PlanReason::FIXED : PlanReason::CONTACTS;
	plan.stability_margin = std::numeric_limits<Real>::infinity();
	plan.cost = Real(plan.substeps) * Real(shape.point_count());
	return plan;
}

} // namespace

SubstepPlan plan_substeps(const SoftBodyShape &shape, const BodySettings &settings, Real dt, bool has_contacts) {
	if (shape.chain() != nullptr) {
		return plan_chain(shape, settings, dt);
	}
	return plan_within(frequency_bounds(shape, settings), shape, settings, dt, has_contacts);
}

SubstepPlan plan_substeps(const SoftBodyData &body, Real dt, bool has_contacts) {
	if (body.shape().chain() != nullptr) {
		return plan_chain(body.shape(), body.settings(), dt);
	}
	return plan_within(frequency_bounds(body, dt), body.shape(), body.settings(), dt, has_contacts);
}

const char *name_of(PlanReason reason) {
	static constexpr const char *NAMES[] = { "stability", "contacts", "too_stiff", "fixed", "unstable" };
	return NAMES[std::size_t(reason)];
}

} // namespace softbody
