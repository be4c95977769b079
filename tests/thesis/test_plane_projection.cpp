// SPDX-License-Identifier: MIT
// Claims about the foot of a point on a plane, with the fault of the thesis's algorithm 4.4 as a regression.
#include "thesis/plane_projection.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

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
