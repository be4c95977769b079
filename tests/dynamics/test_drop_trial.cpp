// SPDX-License-Identifier: MIT
// Claims about the height from which a fall dents a body, against falls from heights around it.
#include "core/creator/body_tear.h"
#include "core/dynamics/drop_trial.h"
#include "scenes/metal.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Vec2 GRAVITY = { 0, PIXEL_GRAVITY };
constexpr int MANY = 100000;

Real dent_height(const SoftBodyData &body, int most_steps = MANY) {
	return find_drop_height(body, GRAVITY, PIXELS_PER_METER, FRAME, most_steps, [](const SoftBodyData &landed) { return landed.is_dented(); });
}

} // namespace

TEST_CASE("a fall from a third above the height that is found dents, one from a third below does not, whatever the model and yield") {
	for (const ElasticModel model : MODELS) {
		for (const Real yield : { Real(0.05), Real(0.1), Real(0.2) }) {
			CAPTURE(int(model));
			CAPTURE(yield);
			const Metal metal{ .model = model, .yield = yield };
			const Real height = dent_height(metal_disc(metal, {}));
			CAPTURE(height);
			REQUIRE(std::isfinite(height));
			REQUIRE(height > 0);
			CHECK(drop_metal(metal, height * Real(1.34), 60, 3).soft_bodies()[0].is_dented());
			if (height > Real(0.051) * 50) { // the least that is told apart
				CHECK_FALSE(drop_metal(metal, height * Real(0.66), 60, 3).soft_bodies()[0].is_dented());
			}
		}
	}
}

TEST_CASE("a stiffer body of the same yield dents from higher, a body that yields to its weight from nothing, an elastic one never") {
	Metal metal;
	metal.yield = Real(0.1);
	const Real soft = dent_height(metal_disc(metal, {}));
	metal.material.youngs_modulus *= 4;
	CHECK(dent_height(metal_disc(metal, {})) > 2 * soft);
	metal.material.youngs_modulus = 20;
	metal.yield = Real(0.001);
	CHECK(dent_height(metal_disc(metal, {})) == 0);
	metal.yield = 0;
	CHECK(std::isinf(dent_height(metal_disc(metal, {}))));
}

TEST_CASE("a drop that tears is found by the same search") {
	const SoftBodyData body = metal_disc({ .yield = 0 }, {});
	const auto tears = [&](Real stretch) {
		return find_drop_height(body, GRAVITY, PIXELS_PER_METER, FRAME, MANY, [&](const SoftBodyData &landed) { return is_overstretched(landed, stretch); });
	};
	CHECK(tears(Real(0.1)) > 0);
	CHECK(tears(Real(0.2)) > tears(Real(0.1)));
}

TEST_CASE("what cannot fall, or takes too many steps, is not known") {
	SoftBodyData body = metal_disc({}, {});
	CHECK(std::isnan(dent_height(body, 10)));
	CHECK(std::isnan(find_drop_height(body, {}, PIXELS_PER_METER, FRAME, MANY, [](const SoftBodyData &) { return true; })));
	REQUIRE(!body.set_pinned(0, true));
	CHECK(std::isnan(dent_height(body)));
}
