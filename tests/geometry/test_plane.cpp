// SPDX-License-Identifier: MIT
// Claims about points and planes, with the faults of the thesis's algorithms 4.3 and 4.4 as regressions.
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

TEST_CASE("a shallow fast point is put back along the normal only") {
	// Thesis Alg. 4.4 goes back along the velocity: at a depth of 0.01 m and v = (10, -0.001) m/s that
	// is 100 m sideways.
	const Plane ground{ { 3, 0 }, { 0, 1 } };
	const Vec2 point{ 2, Real(-0.01) };
	const Vec2 out = project(ground, point);
	CHECK(out.x == point.x);
	CHECK(std::abs(double(out.y)) <= EPSILON * 0.01);
}

TEST_CASE("projecting lands on the plane, moves along the normal, and twice is once") {
	Random random(3);
	for (int i = 0; i < 200; ++i) {
		const Vec2 normal = Rotation::from_angle(random.real(-3.1, 3.1)).apply({ 0, 1 });
		const Plane plane{ random.vector(10), normal };
		const Vec2 point = random.vector(10);
		const Vec2 foot = project(plane, point);
		const double tolerance = 12 * EPSILON * 40; // a dozen roundings of numbers up to 40
		CHECK(std::abs(double(signed_distance(plane, foot))) <= tolerance);
		CHECK(std::abs(double(cross(normal, foot - point))) <= tolerance);
		CHECK(distance(project(plane, foot), foot) <= tolerance);
	}
}
