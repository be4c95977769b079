// SPDX-License-Identifier: MIT
// Claims about what the automatic choice picks, and what it says about it.
#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/substep_plan.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;

SubstepPlan plan_for(Real stiffness, const BodySettings &settings = {}, bool has_contacts = false) {
	return plan_substeps(*thesis_shape_with_ratio(stiffness, Real(0.05)), settings, TICK, has_contacts);
}

} // namespace

TEST_CASE("a soft body takes one substep alone and the contact minimum beside surroundings") {
	CHECK(plan_for(1).substeps == 1);
	CHECK(plan_for(1).reason == PlanReason::STABILITY);
	CHECK(plan_for(1, {}, true).substeps == MIN_CONTACT_SUBSTEPS);
	CHECK(plan_for(1, {}, true).reason == PlanReason::CONTACTS);
}

TEST_CASE("the automatic choice is Verlet alone and semi-implicit Euler beside surroundings, then XPBD") {
	for (const bool has_contacts : { false, true }) {
		bool was_explicit = false;
		bool was_xpbd = false;
		for (double k = 10; k < 1e8; k *= 1.5) {
			const SubstepPlan plan = plan_for(Real(k), {}, has_contacts);
			CHECK(plan.safe);
			if (plan.integrator == Integrator::XPBD) {
				was_xpbd = true;
				CHECK(plan.reason == PlanReason::TOO_STIFF);
				CHECK(plan.substeps == XPBD_SUBSTEPS);
			} else {
				CHECK_FALSE(was_xpbd); // once too stiff, a stiffer body is not softer
				was_explicit = true;
				CHECK(plan.integrator == (has_contacts ? Integrator::SEMI_IMPLICIT_EULER : Integrator::VELOCITY_VERLET));
				CHECK(plan.substeps <= EXPLICIT_SUBSTEP_CAP);
			}
		}
		CHECK(was_explicit);
		CHECK(was_xpbd);
	}
}

// Or a stack that stands at 60 ticks a second would be crushed at 30 (bench.sh stress: load/stack, size/tiny).
TEST_CASE("a longer step takes as many more substeps for contacts and XPBD as it is longer, a shorter one no fewer") {
	const auto plan = [](Real stiffness, Real dt) {
		return plan_substeps(*thesis_shape_with_ratio(stiffness, Real(0.05)), {}, dt, true);
	};
	CHECK(plan(1, TICK).substeps == MIN_CONTACT_SUBSTEPS);
	CHECK(plan(1, 2 * TICK).substeps == 2 * MIN_CONTACT_SUBSTEPS);
	CHECK(plan(1, Real(1) / 50).substeps == 5); // 4.8
	CHECK(plan(1, TICK / 4).substeps == MIN_CONTACT_SUBSTEPS);
	CHECK(plan(1, 1).substeps == MAX_CONTACT_SUBSTEPS);
	CHECK(plan(Real(1e8), TICK).substeps == XPBD_SUBSTEPS);
	CHECK(plan(Real(1e8), 2 * TICK).substeps == 2 * XPBD_SUBSTEPS);
	CHECK(plan(Real(1e8), TICK / 4).substeps == XPBD_SUBSTEPS);
	CHECK(substeps_of_step(64, 1) == 64);
}

TEST_CASE("a fixed count is kept and judged") {
	BodySettings settings;
	settings.substeps = 2;
	const SubstepPlan soft = plan_for(100, settings);
	CHECK(soft.substeps == 2);
	CHECK(soft.reason == PlanReason::FIXED);
	CHECK(soft.safe);
	const SubstepPlan stiff = plan_for(1e5, settings);
	CHECK(stiff.substeps == 2);
	CHECK_FALSE(stiff.safe);
	CHECK(stiff.stability_margin < 1);
}

TEST_CASE("a named integrator is kept, and called unsafe where no step is stable") {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		BodySettings settings;
		settings.integrator = Integrator(i);
		CHECK(plan_for(100, settings).integrator == Integrator(i));
	}
	BodySettings explicit_euler;
	explicit_euler.integrator = Integrator::EXPLICIT_EULER;
	const SubstepPlan undamped = plan_substeps(*thesis_shape(100, 0), explicit_euler, TICK, false);
	CHECK_FALSE(undamped.safe);
	CHECK(undamped.reason == PlanReason::UNSTABLE);
	CHECK(undamped.substeps == MAX_SUBSTEPS);
}

TEST_CASE("pressure and shape matching raise the frequency bound") {
	const double bare = plan_for(100).frequency;
	BodySettings shape;
	shape.shape_stiffness = 40;
	BodySettings pressure;
	pressure.pressure_stiffness = 200;
	CHECK(plan_for(100, shape).frequency > bare);
	CHECK(plan_for(100, pressure).frequency > bare);
}

TEST_CASE("a stiff crumpled body under the automatic choice stays finite and keeps its energy") {
	for (const Real k : { Real(1e3), Real(1e5), Real(1e7) }) {
		WorldData world;
		BodySettings settings;
		settings.shape_stiffness = Real(0.4) * k;
		SoftBodyData body = thesis_body(thesis_shape_with_ratio(k, Real(0.05)), settings);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			const Vec2 p = body.positions()[i];
			body.set_point(i, { p.x * Real(0.1), p.y * Real(1.4) }, {});
		}
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 300; ++i) {
			CHECK(simulator.simulate(TICK).reset_bodies.empty());
		}
		CHECK(all_finite(world.soft_bodies()[0].positions()));
	}
}

TEST_CASE("values of the new terms outside their range are refused by name, and nothing changes") {
	SoftBodyData body = thesis_body(thesis_shape());
	const auto refuses = [&](auto change, const char *name) {
		BodySettings settings;
		change(settings);
		const Status status = body.set_settings(settings);
		REQUIRE(status);
		CHECK(mentions(status->name, name));
		CHECK(body.settings().pressure_stiffness == 0);
		CHECK(body.settings().inflation == 1);
		CHECK(body.settings().integrator == Integrator::AUTOMATIC);
	};
	for (const Real bad : { Real(-1), NOT_A_NUMBER, INFINITE }) {
		refuses([&](BodySettings &s) { s.pressure_stiffness = bad; }, "pressure_stiffness");
		refuses([&](BodySettings &s) { s.inflation = bad; }, "inflation");
	}
	refuses([](BodySettings &s) { s.integrator = Integrator(INTEGRATOR_COUNT); }, "integrator");
}
