// SPDX-License-Identifier: MIT
// Claims about the validator of per-body settings.
#include "core/base/constants.h"
#include "core/model/body_settings.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <functional>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("the default settings are valid, and shape matching is off in them") {
	const BodySettings settings;
	CHECK_FALSE(check_settings(settings));
	CHECK(settings.shape_stiffness == 0);
	CHECK(settings.shape_damping == 0);
	CHECK(settings.gravity_scale == 1);
	CHECK(settings.collision_mask == 0xffffffffu);
}

TEST_CASE("each setting outside its range is refused by its own name") {
	struct Case {
		const char *name;
		std::function<void(BodySettings &, Real)> set;
		std::vector<Real> good;
		std::vector<Real> bad;
	};
	const std::vector<Real> never{ NOT_A_NUMBER, INFINITE, -INFINITE };
	const std::vector<Case> cases{
		{ "shape_stiffness", [](BodySettings &s, Real x) { s.shape_stiffness = x; }, { 0, 1000000 }, { -1 } },
		{ "shape_damping", [](BodySettings &s, Real x) { s.shape_damping = x; }, { 0, 1000000 }, { -1 } },
		{ "friction", [](BodySettings &s, Real x) { s.friction = x; }, { 0, 5 }, { Real(-0.001) } },
		{ "rolling_resistance", [](BodySettings &s, Real x) { s.rolling_resistance = x; }, { 0, 5 }, { Real(-0.001) } },
		{ "restitution", [](BodySettings &s, Real x) { s.restitution = x; }, { 0, 1 }, { Real(-0.001), Real(1.001) } },
		{ "failure_response", [](BodySettings &s, Real x) { s.failure_response = FailureResponse(x == 0 || x == 1 ? int(x) : FAILURE_RESPONSE_COUNT); }, { 0, 1 }, { 2 } },
		{ "gravity_scale", [](BodySettings &s, Real x) { s.gravity_scale = x; }, { -100, 0, 100 }, {} },
	};
	for (const Case &each : cases) {
		CAPTURE(each.name);
		for (const Real value : each.good) {
			BodySettings settings;
			each.set(settings, value);
			CHECK_FALSE(check_settings(settings));
		}
		std::vector<Real> bad = each.bad;
		bad.insert(bad.end(), never.begin(), never.end());
		for (const Real value : bad) {
			BodySettings settings;
			each.set(settings, value);
			const Status status = check_settings(settings);
			REQUIRE(status.has_value());
			CHECK(status->name == each.name);
		}
	}
}

TEST_CASE("a fixed substep count lies between 0, which means automatic, and the maximum") {
	for (const int substeps : { 0, 1, MAX_SUBSTEPS }) {
		BodySettings settings;
		settings.substeps = substeps;
		CHECK_FALSE(check_settings(settings));
	}
	for (const int substeps : { -1, MAX_SUBSTEPS + 1 }) {
		BodySettings settings;
		settings.substeps = substeps;
		const Status status = check_settings(settings);
		REQUIRE(status.has_value());
		CHECK(status->name == "substeps");
	}
}
