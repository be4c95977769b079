// SPDX-License-Identifier: MIT
// Claims about the vector, its products, and rotations kept as cosine and sine.
#include "core/base/vec2.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <numbers>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("vector arithmetic works by component") {
	const Vec2 a{ 3, -4 };
	const Vec2 b{ 10, 20 };
	CHECK(a + b == Vec2{ 13, 16 });
	CHECK(a - b == Vec2{ -7, -24 });
	CHECK(-a == Vec2{ -3, 4 });
	CHECK(a * Real(2) == Vec2{ 6, -8 });
	CHECK(Real(2) * a == Vec2{ 6, -8 });
	Vec2 c = a;
	c += b;
	CHECK(c == Vec2{ 13, 16 });
	c -= a;
	CHECK(c == b);
	c *= Real(0.5);
	CHECK(c == Vec2{ 5, 10 });
	CHECK_FALSE(a == Vec2{ 3, 4 });
	CHECK_FALSE(a == Vec2{ -3, -4 });
}

TEST_CASE("the products agree with their geometry") {
	CHECK(dot(Vec2{ 3, 4 }, { 5, 6 }) == 39);
	CHECK(cross(Vec2{ 1, 0 }, { 0, 1 }) == 1); // positive from x towards y
	CHECK(cross(Vec2{ 3, 4 }, { 5, 6 }) == -2);
	CHECK(perpendicular(Vec2{ 1, 0 }) == Vec2{ 0, 1 });
	CHECK(perpendicular(Vec2{ 0, 1 }) == Vec2{ -1, 0 });
	CHECK(length_squared(Vec2{ 3, 4 }) == 25);
	CHECK(length(Vec2{ 3, -4 }) == 5);
}

TEST_CASE("a vector with one bad component is not finite") {
	CHECK(is_finite({ 1, 2 }));
	for (const Real bad : { NOT_A_NUMBER, INFINITE, -INFINITE }) {
		CHECK_FALSE(is_finite({ bad, 0 }));
		CHECK_FALSE(is_finite({ 0, bad }));
	}
}

TEST_CASE("rotations turn from x towards y, keep lengths, and are undone by their inverse") {
	const Vec2 turned = Rotation::from_angle(Real(std::numbers::pi / 2)).apply({ 1, 0 });
	CHECK(distance(turned, { 0, 1 }) <= EPSILON); // the rounding of pi/2
	Random random(1);
	for (int i = 0; i < 100; ++i) {
		const Real angle = random.real(-3.14, 3.14);
		const Rotation rotation = Rotation::from_angle(angle);
		const Vec2 a = random.vector(10);
		// Four products of relative error eps each, on lengths up to 14.
		const double tolerance = 4 * EPSILON * 15;
		CHECK(std::abs(double(length(rotation.apply(a))) - length(a)) <= tolerance);
		CHECK(distance(rotation.apply_inverse(rotation.apply(a)), a) <= tolerance);
		CHECK(std::abs(double(rotation.angle()) - angle) <= 4 * EPSILON * 3.2);
	}
}
