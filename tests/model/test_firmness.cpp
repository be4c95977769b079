// SPDX-License-Identifier: MIT
// Claims about how firm a body is made for its weight.
#include "core/base/real.h"
#include "core/model/firmness.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("the load of a disk is its weight over its radius, in pixels and in meters alike") {
	const double pixels = load_of(1, 980, std::numbers::pi * 50 * 50);
	CHECK(pixels == doctest::Approx(980.0 / 50).epsilon(1e-12));
	CHECK(load_of(1, -9.8, std::numbers::pi * 0.5 * 0.5) == doctest::Approx(pixels).epsilon(1e-12));
	CHECK(load_of(3, 0, 100) == 0);
}

TEST_CASE("a light body is as firm as its material says, to the bit") {
	Random random(1);
	for (int i = 0; i < 1000; ++i) {
		const double load = random.real(0, LIGHT_LOAD);
		const double modulus = LEAST_FIRM_STRENGTH * LIGHT_LOAD * std::exp(double(random.real(0, 9)));
		const Firmness firmness = firmness_for(load, modulus);
		CHECK(firmness.factor == 1);
		CHECK(firmness.for_load == 1);
		CHECK_FALSE(firmness.is_least);
	}
}

TEST_CASE("from the largest light load on, E over the load stays the same, so that twice as firm a material is twice as firm") {
	Random random(2);
	for (int i = 0; i < 1000; ++i) {
		const double load = LIGHT_LOAD * std::exp(double(random.real(0, 14)));
		const double modulus = LEAST_FIRM_STRENGTH * LIGHT_LOAD * std::exp(double(random.real(0.001, 9)));
		const Firmness firmness = firmness_for(load, modulus);
		CHECK(firmness.factor * modulus / load == doctest::Approx(modulus / LIGHT_LOAD).epsilon(1e-9));
		CHECK(firmness.factor == firmness.for_load);
		CHECK_FALSE(firmness.is_least);
	}
}

TEST_CASE("no material is softer than the least strength asks, and none is made softer than it is") {
	Random random(3);
	for (int i = 0; i < 1000; ++i) {
		const double load = std::exp(double(random.real(-12, 14)));
		const double modulus = std::exp(double(random.real(-7, 9)));
		const Firmness firmness = firmness_for(load, modulus);
		const double strength = firmness.factor * modulus / load;
		CHECK(strength >= LEAST_FIRM_STRENGTH * (1 - 1e-9));
		CHECK(firmness.factor >= 1);
		CHECK(firmness.for_load >= 1);
		CHECK(firmness.is_least == (modulus * std::fmax(load / LIGHT_LOAD, 1) < LEAST_FIRM_STRENGTH * load));
		if (firmness.is_least) {
			CHECK(strength == doctest::Approx(LEAST_FIRM_STRENGTH).epsilon(1e-9));
		}
	}
}

TEST_CASE("a body without weight, and loads beyond all numbers, leave a finite factor") {
	CHECK(firmness_for(0, 1e-30).factor == 1);
	CHECK_FALSE(firmness_for(0, 1e-30).is_least);
	const double most = double(std::numeric_limits<float>::max());
	const Firmness huge = firmness_for(std::numeric_limits<double>::infinity(), 300);
	CHECK(huge.factor * 300 == doctest::Approx(MOST_FIRM_MODULUS));
	CHECK(huge.for_load <= huge.factor);
	CHECK(firmness_for(1e30, most).factor == 1);
}
