// SPDX-License-Identifier: MIT
// Claims about points and planes, with the fault of the thesis's algorithm 4.3 as a regression.
#include "core/geometry/plane.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("the side of a plane depends on where the plane lies, not only on its normal") {
	// Thesis Alg. 4.3 leaves the plane's position out and calls this point in front.
	const Plane ground{ { 0, 10 }, { 0, 1 } };
	CHECK(signed_distance(ground, { 0, 4 }) == -6);
	CHECK(signed_distance(ground, { -7, 13 }) == 3);
	CHECK(signed_distance(ground, { 5, 10 }) == 0);
}

TEST_CASE("signed distance is that of the foot point, positive in front, wherever the plane is anchored") {
	Random random(2);
	for (int i = 0; i < 200; ++i) {
		const Rotation turn = Rotation::from_angle(random.real(-3.1, 3.1));
		const Vec2 normal = turn.apply({ 0, 1 });
		const Vec2 along = turn.apply({ 1, 0 });
		const Vec2 foot = random.vector(10);
		const Real height = random.real(-10, 10);
		const Plane plane{ foot + along * random.real(-10, 10), normal };
		// A dozen roundings of numbers up to 40.
		CHECK(std::abs(double(signed_distance(plane, foot + normal * height)) - height) <= 12 * EPSILON * 40);
	}
}
