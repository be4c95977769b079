// SPDX-License-Identifier: MIT
// Claims about how much polygons overlap, against cuts into slabs, dense sampling and known shapes.
#include "core/geometry/polygon.h"
#include "thesis/polygon_overlap.h"
#include "geometry/integer_geometry.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

using GridPolygon = std::vector<GridPoint>;

GridPolygon random_simple_polygon(Random &random, int size) {
	while (true) {
		GridPolygon polygon = random_grid_polygon(random, random.integer(3, 8), size);
		if (grid_is_simple(polygon) && grid_double_area(polygon) != 0) {
			return polygon;
		}
	}
}

// Where the border crosses the vertical line at x, in order: inside lies between the first and second, and so on.
std::vector<double> crossings(const GridPolygon &polygon, double x) {
	std::vector<double> ys;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const GridPoint a = polygon[i];
		const GridPoint b = polygon[(i + 1) % polygon.size()];
		if ((double(a.x) > x) != (double(b.x) > x)) {
			ys.push_back(double(a.y) + double(b.y - a.y) * (x - double(a.x)) / double(b.x - a.x));
		}
	}
	std::sort(ys.begin(), ys.end());
	return ys;
}

// Length on that line that both polygons cover.
double shared_length(const GridPolygon &a, const GridPolygon &b, double x) {
	const auto of_a = crossings(a, x);
	const auto of_b = crossings(b, x);
	double sum = 0;
	for (std::size_t i = 0; i + 1 < of_a.size(); i += 2) {
		for (std::size_t j = 0; j + 1 < of_b.size(); j += 2) {
			sum += std::fmax(0, std::fmin(of_a[i + 1], of_b[j + 1]) - std::fmax(of_a[i], of_b[j]));
		}
	}
	return sum;
}

// Cut at every corner and crossing, the shared area is made of trapezoids: width times the length in the middle.
double area_by_slabs(const GridPolygon &a, const GridPolygon &b) {
	std::vector<double> cuts;
	for (const GridPolygon *polygon : { &a, &b }) {
		for (const GridPoint p : *polygon) {
			cuts.push_back(double(p.x));
		}
	}
	for (std::size_t i = 0; i < a.size(); ++i) {
		for (std::size_t j = 0; j < b.size(); ++j) {
			const GridPoint p = a[i];
			const GridPoint q = a[(i + 1) % a.size()];
			if (const auto t = grid_intersection(p, q, b[j], b[(j + 1) % b.size()])) {
				cuts.push_back(double(p.x) + t->value() * double(q.x - p.x));
			}
		}
	}
	std::sort(cuts.begin(), cuts.end());
	double sum = 0;
	for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
		sum += (cuts[i + 1] - cuts[i]) * shared_length(a, b, (cuts[i] + cuts[i + 1]) / 2);
	}
	return sum;
}

// Largest distance from the border of `polygon` of a corner of `corners` inside it, by samples of that border.
double sampled_depth(const GridPolygon &corners, const GridPolygon &polygon) {
	double depth = 0;
	for (const GridPoint p : corners) {
		if (grid_on_border(p, polygon) || grid_winding_number(p, polygon) == 0) {
			continue;
		}
		double least = 1e9;
		for (std::size_t i = 0; i < polygon.size(); ++i) {
			const Vec2 a = polygon[i];
			const Vec2 b = polygon[(i + 1) % polygon.size()];
			for (int k = 0; k <= 500; ++k) {
				least = std::fmin(least, distance(p, a + (b - a) * (Real(k) / 500)));
			}
		}
		depth = std::fmax(depth, least);
	}
	return depth;
}

std::vector<Vec2> regular(Vec2 center, int count, double radius, double turn = 0) {
	std::vector<Vec2> polygon;
	for (int i = 0; i < count; ++i) {
		const double angle = turn + 2 * std::numbers::pi * i / count;
		polygon.push_back({ Real(center.x + radius * std::cos(angle)), Real(center.y + radius * std::sin(angle)) });
	}
	return polygon;
}

} // namespace

TEST_CASE("the area shared by two simple polygons is the sum of their common trapezoids") {
	Random random(51);
	double worst = 0;
	int overlapping = 0;
	for (int i = 0; i < 6000; ++i) {
		const int size = random.integer(2, 8); // on the smallest most edges touch, coincide or lie in line
		const GridPolygon a = random_simple_polygon(random, size);
		const GridPolygon b = random_simple_polygon(random, size);
		const double expected = area_by_slabs(a, b);
		worst = std::fmax(worst, std::abs(overlap_area(to_real(a), to_real(b)) - expected));
		overlapping += expected > 0;
	}
	CHECK(worst <= 1e-12); // some hundred roundings in double of areas up to 64
	CHECK(overlapping > 3000);
}

TEST_CASE("a share of random places lies in both polygons that is their shared area") {
	Random random(52);
	for (int i = 0; i < 5; ++i) {
		const GridPolygon a = random_simple_polygon(random, 8);
		const GridPolygon b = random_simple_polygon(random, 8);
		const auto real_a = to_real(a);
		const auto real_b = to_real(b);
		int both = 0;
		const int samples = 40000;
		for (int k = 0; k < samples; ++k) {
			const Vec2 p{ random.real(0, 8), random.real(0, 8) };
			both += point_in_polygon(p, real_a) && point_in_polygon(p, real_b);
		}
		// Four standard deviations of at most 64 * 0.5 / 200.
		CHECK(std::abs(overlap_area(real_a, real_b) - 64.0 * both / samples) <= 4 * 64 * 0.5 / 200);
	}
}

TEST_CASE("a polygon shares all its area with itself and the same area with any other in either order and winding") {
	Random random(53);
	for (int i = 0; i < 300; ++i) {
		const GridPolygon a = random_simple_polygon(random, 8);
		const GridPolygon b = random_simple_polygon(random, 8);
		auto reversed = to_real(a);
		std::reverse(reversed.begin(), reversed.end());
		const double area = std::abs(double(grid_double_area(a))) / 2;
		CHECK(std::abs(overlap_area(to_real(a), to_real(a)) - area) <= 1e-12);
		CHECK(std::abs(overlap_area(to_real(a), reversed) - area) <= 1e-12);
		const double shared = overlap_area(to_real(a), to_real(b));
		CHECK(std::abs(overlap_area(to_real(b), to_real(a)) - shared) <= 1e-12);
		CHECK(std::abs(overlap_area(reversed, to_real(b)) - shared) <= 1e-12);
	}
}

TEST_CASE("the overlap of concave polygons may be several pieces") {
	// Two combs of three teeth, one with its teeth up, the other down over it: the thesis (4.4) joins all found points
	// into a single polygon.
	const std::vector<Vec2> up{ { 0, 0 }, { 5, 0 }, { 5, 4 }, { 4, 4 }, { 4, 1 }, { 3, 1 }, { 3, 4 }, { 2, 4 }, { 2, 1 },
		{ 1, 1 }, { 1, 4 }, { 0, 4 } };
	const std::vector<Vec2> bar{ { -1, 2 }, { 6, 2 }, { 6, 3 }, { -1, 3 } };
	CHECK(std::abs(overlap_area(up, bar) - 3) <= 1e-14);
	CHECK(penetration_depth(up, bar) == 0); // no corner of either is inside the other
	const std::vector<Vec2> low_bar{ { -1, 2 }, { 6, 2 }, { 6, 5 }, { -1, 5 } };
	CHECK(std::abs(overlap_area(up, low_bar) - 6) <= 1e-14);
	CHECK(penetration_depth(up, low_bar) == 1); // tips are 2 above and 1 below an edge
}

TEST_CASE("overlap does not depend on how far from the origin it is") {
	const Vec2 far{ 65536, -131072 };
	auto a = regular({ 0, 0 }, 8, 0.5);
	auto b = regular({ Real(0.875), Real(0.25) }, 8, 0.5, 0.2);
	for (auto *polygon : { &a, &b }) {
		for (Vec2 &p : *polygon) {
			p = { std::round(p.x * 64) / 64, std::round(p.y * 64) / 64 }; // there exact in float, too
		}
	}
	const double area = overlap_area(a, b);
	const double depth = penetration_depth(a, b);
	CHECK(area > 0.005);
	CHECK(depth > 0.01);
	for (auto *polygon : { &a, &b }) {
		for (Vec2 &p : *polygon) {
			p += far;
		}
	}
	CHECK(std::abs(overlap_area(a, b) - area) <= 1e-15);
	CHECK(penetration_depth(a, b) == depth);
}

TEST_CASE("the depth is that of the corner farthest inside, of either polygon") {
	Random random(54);
	double most = 0;
	double least = 0;
	int inside = 0;
	for (int i = 0; i < 1500; ++i) {
		const GridPolygon a = random_simple_polygon(random, 8);
		const GridPolygon b = random_simple_polygon(random, 8);
		const double expected = std::fmax(sampled_depth(a, b), sampled_depth(b, a));
		const double found = penetration_depth(to_real(a), to_real(b));
		CHECK(found == penetration_depth(to_real(b), to_real(a)));
		most = std::fmax(most, expected - found);
		least = std::fmin(least, expected - found);
		inside += expected > 0;
	}
	CHECK(least >= -16 * EPSILON); // a sample is never nearer than the nearest place
	CHECK(most <= 0.012); // half the distance of samples of an edge of 11.4
	CHECK(inside > 500);
}

TEST_CASE("polygons that are apart, touch, or have no area do not overlap") {
	const std::vector<Vec2> square{ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } };
	const std::vector<Vec2> beside{ { 2, 0 }, { 4, 0 }, { 4, 2 }, { 2, 2 } };
	const std::vector<Vec2> at_corner{ { 2, 2 }, { 4, 2 }, { 4, 4 }, { 2, 4 } };
	const std::vector<Vec2> away{ { 5, 5 }, { 6, 5 }, { 6, 6 } };
	const std::vector<Vec2> flat{ { -1, 1 }, { 3, 1 }, { 1, 1 } };
	const std::vector<Vec2> one_place{ { 1, 1 }, { 1, 1 }, { 1, 1 } };
	for (const auto &other : { beside, at_corner, away }) {
		CHECK(overlap_area(square, other) == 0);
		CHECK(penetration_depth(square, other) == 0);
	}
	CHECK(overlap_area(square, flat) == 0);
	CHECK(overlap_area(flat, flat) == 0);
	CHECK(overlap_area(square, one_place) == 0);
	CHECK(penetration_depth(square, flat) == 1); // its middle corner is as deep inside as can be
	CHECK(overlap_area(square, {}) == 0);
	CHECK(overlap_area({}, square) == 0);
	CHECK(penetration_depth(square, {}) == 0);
	CHECK(penetration_depth({}, {}) == 0);
}
