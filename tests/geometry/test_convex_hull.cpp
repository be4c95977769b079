// SPDX-License-Identifier: MIT
// Claims about convex hulls, against a search through all triangles on a small integer grid.
#include "core/geometry/polygon.h"
#include "geometry/integer_geometry.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> hull_of(const std::vector<Vec2> &points) {
	std::vector<Vec2> workspace(2 * points.size());
	return copy_of(convex_hull(points, workspace));
}

// A point is a corner when no segment and no triangle of the other places contains it.
bool grid_is_corner(GridPoint p, const std::vector<GridPoint> &points) {
	std::vector<GridPoint> others;
	std::copy_if(points.begin(), points.end(), std::back_inserter(others), [p](GridPoint q) { return !(q == p); });
	for (const GridPoint a : others) {
		for (const GridPoint b : others) {
			if (grid_on_segment(p, a, b)) {
				return false;
			}
			for (const GridPoint c : others) {
				const long whole = std::labs(grid_double_area({ a, b, c }));
				const long parts = std::labs(grid_double_area({ p, b, c })) + std::labs(grid_double_area({ a, p, c })) +
						std::labs(grid_double_area({ a, b, p }));
				if (whole != 0 && parts == whole) {
					return false;
				}
			}
		}
	}
	return true;
}

bool is_strictly_convex(const std::vector<Vec2> &polygon) {
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2 b = polygon[(i + 1) % polygon.size()];
		const Vec2 c = polygon[(i + 2) % polygon.size()];
		if (!(signed_double_area(polygon[i], b, c) > 0)) {
			return false;
		}
	}
	return true;
}

bool before(Vec2 a, Vec2 b) {
	return a.x < b.x || (a.x == b.x && a.y < b.y);
}

} // namespace

TEST_CASE("the hull's corners are the points that no triangle of the others contains") {
	Random random(31);
	int wrong = 0;
	int flat = 0;
	for (int i = 0; i < 3000; ++i) {
		// On small grids many points coincide and many are in line; a height of 0 puts all in line.
		const int size = random.integer(0, 6);
		auto points = random_grid_polygon(random, random.integer(1, 12), size);
		if (random.chance(0.2)) {
			for (GridPoint &p : points) {
				p.y = 2 * p.x;
			}
		}
		std::vector<Vec2> expected;
		for (const GridPoint p : points) {
			if (grid_is_corner(p, points)) {
				expected.push_back(p);
			}
		}
		std::sort(expected.begin(), expected.end(), before);
		expected.erase(std::unique(expected.begin(), expected.end()), expected.end());

		auto hull = hull_of(to_real(points));
		wrong += hull.size() > 2 && !is_strictly_convex(hull);
		wrong += std::min_element(hull.begin(), hull.end(), before) != hull.begin();
		std::sort(hull.begin(), hull.end(), before);
		wrong += !identical(hull, expected);
		flat += hull.size() < 3;
	}
	CHECK(wrong == 0);
	CHECK(flat > 300);
}

TEST_CASE("the hull of points anywhere is convex, consists of them, and contains them") {
	Random random(32);
	for (int i = 0; i < 500; ++i) {
		const Vec2 far = i % 2 ? random.vector(1000) : Vec2{};
		std::vector<Vec2> points;
		for (int k = random.integer(3, 32); k > 0; --k) {
			points.push_back(far + random.vector(1));
		}
		const auto hull = hull_of(points);
		CHECK(is_strictly_convex(hull));
		for (const Vec2 corner : hull) {
			CHECK(std::count(points.begin(), points.end(), corner) > 0);
		}
		for (const Vec2 p : points) {
			for (std::size_t k = 0; k < hull.size(); ++k) {
				// Exact for float; in double the products of 1 are rounded.
				CHECK(signed_double_area(hull[k], hull[(k + 1) % hull.size()], p) >= -4e-16);
			}
		}
	}
}

TEST_CASE("degenerate sets have a point or a segment for a hull") {
	CHECK(hull_of({}).empty());
	CHECK(hull_of({ { 3, 4 } }) == std::vector<Vec2>{ { 3, 4 } });
	CHECK(hull_of({ { 3, 4 }, { 3, 4 }, { 3, 4 } }) == std::vector<Vec2>{ { 3, 4 } });
	CHECK(hull_of({ { 5, 1 }, { 2, 1 }, { 5, 1 } }) == std::vector<Vec2>{ { 2, 1 }, { 5, 1 } });
	CHECK(hull_of({ { 2, 2 }, { 0, 0 }, { 3, 3 }, { 1, 1 } }) == std::vector<Vec2>{ { 0, 0 }, { 3, 3 } });
	CHECK(hull_of({ { 1, 5 }, { 1, 2 }, { 1, 7 }, { 1, 2 } }) == std::vector<Vec2>{ { 1, 2 }, { 1, 7 } });
}

TEST_CASE("a dented outline is closed over, and the largest hull keeps all its corners") {
	CHECK(hull_of({ { 4, 4 }, { 2, 1 }, { 0, 4 }, { 0, 0 }, { 4, 0 }, { 4, 2 } }) ==
			std::vector<Vec2>{ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } });
	std::vector<Vec2> circle;
	for (int i = 0; i < 4096; ++i) {
		const double angle = 2 * std::numbers::pi * i / 4096;
		circle.push_back({ Real(1000000 * std::cos(angle)), Real(1000000 * std::sin(angle)) });
	}
	const double area = double(signed_area(circle));
	// Neighboring edges differ by 0.0015 rad in direction, 1.2 m in 1000 km from a straight line: far above rounding.
	std::reverse(circle.begin() + 7, circle.end() - 100);
	const auto hull = hull_of(circle);
	CHECK(hull.size() == 4096);
	CHECK(relative_error(double(signed_area(hull)), area) <= 4 * EPSILON + 1e-13); // two sums of 4096 terms in double
}
