// SPDX-License-Identifier: MIT
// Claims about the substep rule: the smallest safe count, its bounds, and what it reports.
#include "core/base/constants.h"
#include "core/dynamics/substep_plan.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60; // s

// h²Ω² + 2hΓ, with the bounds summed here from springs and shape matching.
double load(const SoftBodyShape &shape, const BodySettings &settings, double h) {
	const double mean_mass = double(shape.total_mass()) / double(shape.point_count());
	const double frequency_squared = double(shape.spring_frequency_squared()) + double(settings.shape_stiffness) / mean_mass;
	const double damping_rate = double(shape.spring_damping_rate()) + double(settings.shape_damping) / mean_mass;
	return h * h * frequency_squared + 2 * h * damping_rate;
}

// The rule of one named method; what AUTOMATIC does past its cap is claimed in test_automatic_choice.cpp.
BodySettings semi_implicit() {
	BodySettings settings;
	settings.integrator = Integrator::SEMI_IMPLICIT_EULER;
	return settings;
}

} // namespace

TEST_CASE("the plan is the smallest count with h²Ω² + 2hΓ within the stability budget") {
	const double budget = double(STABILITY_BUDGET) * double(STABILITY_BUDGET);
	Random random(91);
	int between = 0;
	for (int round = 0; round < 2000; ++round) {
		const Real stiffness = std::pow(Real(10), random.real(0, 4.5));
		const auto shape = thesis_shape(stiffness, random.real(0, 0.3) * std::sqrt(stiffness));
		BodySettings settings = semi_implicit();
		settings.shape_stiffness = stiffness * random.real(0, 1);
		settings.shape_damping = random.real(0, 0.3) * std::sqrt(stiffness);
		const Real dt = random.real(0.001, 0.05);
		const SubstepPlan plan = plan_substeps(*shape, settings, dt, false);
		const double here = load(*shape, settings, double(dt) / plan.substeps);
		const double rounding = 1e-12; // both sides are evaluated in double
		if (plan.safe) {
			CHECK(here <= budget + rounding);
		} else {
			CHECK(plan.substeps == MAX_SUBSTEPS);
			CHECK(here > budget - rounding);
		}
		if (plan.substeps > 1) {
			CHECK(load(*shape, settings, double(dt) / (plan.substeps - 1)) > budget - rounding);
			between++;
		}
		// The margin is the factor at which the linear limit 4 is reached; it is stored as Real.
		CHECK(relative_error(load(*shape, settings, double(dt) / plan.substeps * double(plan.stability_margin)), 4) <= 4 * EPSILON);
	}
	CHECK(between > 500);
}

TEST_CASE("the plan shows the bounds it used") {
	const auto shape = thesis_shape(100, 2);
	BodySettings settings;
	settings.shape_stiffness = 40;
	settings.shape_damping = 3;
	const SubstepPlan plan = plan_substeps(*shape, settings, Real(0.01), false);
	// The springs' bounds (claimed in test_soft_body_shape.cpp), plus k_s/m and c_s/m with m = 1/9.
	CHECK(relative_error(plan.frequency, std::sqrt(double(shape->spring_frequency_squared()) + 40 * 9.0)) <= 8 * EPSILON);
	CHECK(relative_error(plan.damping_rate, double(shape->spring_damping_rate()) + 3 * 9.0) <= 8 * EPSILON);
	CHECK(plan.safe);
}

TEST_CASE("a body that can touch something gets at least four substeps") {
	const auto soft = thesis_shape(Real(0.001));
	CHECK(plan_substeps(*soft, semi_implicit(), Real(0.01), false).substeps == 1);
	CHECK(plan_substeps(*soft, semi_implicit(), Real(0.01), true).substeps == MIN_CONTACT_SUBSTEPS);
	const auto stiff = thesis_shape(2000);
	const int wanted = plan_substeps(*stiff, semi_implicit(), Real(0.016), false).substeps;
	CHECK(wanted > MIN_CONTACT_SUBSTEPS);
	CHECK(plan_substeps(*stiff, semi_implicit(), Real(0.016), true).substeps == wanted);
}

TEST_CASE("a hull that leaves the range of numbers, in one measure or all, asks for no more than the rest of the body") {
	BodySettings settings = semi_implicit();
	settings.pressure_stiffness = 500;
	const SoftBodyData sound = thesis_body(thesis_shape(1000, 1), settings);
	const SubstepPlan expected = plan_substeps(sound, FRAME, true);
	REQUIRE(expected.safe);
	// Fast enough for squares to be too large, and areas still to be finite; and too fast for both.
	for (const Real speed : { std::sqrt(std::numeric_limits<Real>::max()) * 1000 / FRAME, std::numeric_limits<Real>::max(), NOT_A_NUMBER }) {
		CAPTURE(speed);
		SoftBodyData body = sound;
		body.mutable_velocities()[1] = { speed, 0 };
		const SubstepPlan plan = plan_substeps(body, FRAME, true);
		CHECK(plan.substeps == expected.substeps);
		CHECK(plan.safe);
		CHECK(std::isfinite(plan.frequency));
	}
}

TEST_CASE("pressure on a stretched hull stiffens it by k_p |A/A0 - s| over the mass of a point") {
	const auto shape = thesis_shape(1000, 1);
	const double mean_mass = double(shape->total_mass()) / double(shape->point_count());
	const auto bound = [&](Real inflation) {
		BodySettings settings = semi_implicit();
		settings.pressure_stiffness = 500;
		settings.inflation = inflation;
		SoftBodyData body = thesis_body(shape, settings);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, shape->rest_positions()[i] * 5, {}); // 25 times its area
		}
		return frequency_bounds(body, FRAME).frequency_squared;
	};
	const double filled_more = bound(8);
	for (const Real inflation : { Real(0), Real(0.5), Real(2), Real(5) }) {
		CAPTURE(inflation);
		CHECK(bound(inflation) - filled_more == doctest::Approx(500 * (8 - double(inflation)) / mean_mass).epsilon(1e-3));
	}
}

TEST_CASE("a body without springs needs one substep and has an unlimited margin") {
	const SoftBodyData body = loose_points(3, 1);
	const SubstepPlan plan = plan_substeps(body.shape(), semi_implicit(), Real(0.01), false);
	CHECK(plan.substeps == 1);
	CHECK(plan.frequency == 0);
	CHECK(plan.safe);
	CHECK(plan.stability_margin > Real(1e30));
}

TEST_CASE("a body too stiff for the largest count is stepped with it and reported as unsafe") {
	const auto absurd = thesis_shape(Real(1e12));
	const SubstepPlan plan = plan_substeps(*absurd, semi_implicit(), Real(0.016), true);
	CHECK(plan.substeps == MAX_SUBSTEPS);
	CHECK_FALSE(plan.safe);
	CHECK(plan.stability_margin < 1);
}

TEST_CASE("exactly the largest count is still safe") {
	// 2k/m = 200: hΩ = S at h = S/sqrt(200). A hair below 64 of them is safe, a hair above is not.
	const SoftBodyData body = two_masses(1, 1, 100, 0);
	const double step = double(STABILITY_BUDGET) / std::sqrt(200.0);
	const SubstepPlan below = plan_substeps(body.shape(), semi_implicit(), Real(step * 63.999), false);
	CHECK(below.substeps == MAX_SUBSTEPS);
	CHECK(below.safe);
	const SubstepPlan above = plan_substeps(body.shape(), semi_implicit(), Real(step * 64.001), false);
	CHECK(above.substeps == MAX_SUBSTEPS);
	CHECK_FALSE(above.safe);
	CHECK(plan_substeps(body.shape(), semi_implicit(), Real(step * 62.999), false).substeps == MAX_SUBSTEPS - 1);
}

TEST_CASE("a fixed count is kept, and is safe below the linear limit only") {
	const SoftBodyData body = two_masses(1, 1, 100, 0);
	const double limit = 2 / std::sqrt(200.0); // hω = 2
	for (const int substeps : { 1, 3, 64 }) {
		BodySettings settings;
		settings.substeps = substeps;
		const SubstepPlan inside = plan_substeps(body.shape(), settings, Real(limit * 0.999 * substeps), true);
		const SubstepPlan outside = plan_substeps(body.shape(), settings, Real(limit * 1.001 * substeps), true);
		CHECK(inside.substeps == substeps);
		CHECK(outside.substeps == substeps);
		CHECK(inside.safe);
		CHECK_FALSE(outside.safe);
		CHECK(std::abs(double(inside.stability_margin) - 1 / 0.999) <= 8 * EPSILON);
	}
}

TEST_CASE("every reason of a plan has a name") {
	CHECK(std::string(name_of(PlanReason::STABILITY)) == "stability");
	CHECK(std::string(name_of(PlanReason::TOO_STIFF)) == "too_stiff");
	CHECK(std::string(name_of(PlanReason::UNSTABLE)) == "unstable");
}
