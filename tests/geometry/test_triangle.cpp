// SPDX-License-Identifier: MIT
// Claims about triangles, against exact twins on a small integer grid.
#include "core/geometry/polygon.h"
#include "geometry/integer_geometry.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("twice the signed area is positive from x towards y") {
	CHECK(signed_double_area({ 0, 0 }, { 4, 0 }, { 0, 3 }) == 12);
	CHECK(signed_double_area({ 0, 0 }, { 0, 3 }, { 4, 0 }) == -12);
	CHECK(signed_double_area({ 1, 1 }, { 2, 2 }, { 5, 5 }) == 0);
}

TEST_CASE("the sign of the area is right far from the origin") {
	// In plain float arithmetic the products of coordinates near 1e6 lose this area of 1.
	const Vec2 far{ 1000000, 2000000 };
	CHECK(signed_double_area(far, far + Vec2{ 1, 0 }, far + Vec2{ 0, 1 }) == 1);
}

TEST_CASE("the area of a triangle on the grid is exact") {
	Random random(11);
	int wrong = 0;
	for (int i = 0; i < 20000; ++i) {
		const GridPoint a = random_grid_point(random, 50);
		const GridPoint b = random_grid_point(random, 50);
		const GridPoint c = random_grid_point(random, 50);
		wrong += signed_double_area(a, b, c) != double(grid_double_area({ a, b, c }));
	}
	CHECK(wrong == 0);
}

TEST_CASE("a point is in a triangle when the three parts do not exceed the whole") {
	// On a grid of 6 x 6 about one triangle in eight is degenerate and one point in three on a border.
	Random random(12);
	int wrong = 0;
	int inside = 0;
	for (int i = 0; i < 100000; ++i) {
		const GridPoint p = random_grid_point(random, 5);
		const GridPoint a = random_grid_point(random, 5);
		const GridPoint b = random_grid_point(random, 5);
		const GridPoint c = random_grid_point(random, 5);
		const long whole = std::labs(grid_double_area({ a, b, c }));
		const long parts = std::labs(grid_double_area({ p, b, c })) + std::labs(grid_double_area({ a, p, c })) +
				std::labs(grid_double_area({ a, b, p }));
		const bool expected = whole != 0 && parts == whole;
		inside += expected;
		wrong += point_in_triangle(p, a, b, c) != expected;
	}
	CHECK(wrong == 0);
	CHECK(inside > 10000); // the input exercises both answers
}

TEST_CASE("a point beyond the edge opposite a corner is outside") {
	// Thesis Alg. 4.5 does not bound u from below and above alike and accepts points far outside.
	CHECK_FALSE(point_in_triangle({ 5, 5 }, { 0, 0 }, { 1, 0 }, { 0, 1 }));
	CHECK_FALSE(point_in_triangle({ -5, Real(0.5) }, { 0, 0 }, { 1, 0 }, { 0, 1 }));
	CHECK(point_in_triangle({ Real(0.5), Real(0.5) }, { 0, 0 }, { 1, 0 }, { 0, 1 }));
}
