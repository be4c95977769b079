// SPDX-License-Identifier: MIT
// Claims about springs that nobody has drawn.
#include "core/creator/structure.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Pairs pairs_of(std::span<const SpringEnds> springs) {
	Pairs pairs;
	for (const auto [a, b] : springs) {
		pairs.insert(std::minmax(a, b));
	}
	CHECK(pairs.size() == springs.size());
	return pairs;
}

std::vector<Vec2> points_inside(std::span<const Vec2> hull, std::size_t count, Random &random) {
	const Aabb box = bounding_box(hull);
	std::vector<Vec2> points;
	while (points.size() < count) {
		const Vec2 p{ random.real(box.min.x, box.max.x), random.real(box.min.y, box.max.y) };
		if (point_in_polygon(p, hull)) {
			points.push_back(p);
		}
	}
	return points;
}

const std::vector<Vec2> U_SHAPE{ { 0, 0 }, { 9, 0 }, { 9, 9 }, { 6, 9 }, { 6, 3 }, { 3, 3 }, { 3, 9 }, { 0, 9 } };

} // namespace

TEST_CASE("without inner points a hull is a ring, with a center point a wheel") {
	const std::vector<Vec2> square{ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } };
	CHECK(automatic_springs(square, {}, {}) == std::vector<SpringEnds>{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } });
	CHECK(automatic_springs(square, {}, Vec2{ 1, 1 }) ==
			std::vector<SpringEnds>{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 0, 4 }, { 1, 4 }, { 2, 4 }, { 3, 4 } });
}

TEST_CASE("a lattice gets its edges and both diagonals of each cell") {
	// A hull of 4 by 4 unit cells, and the 3 by 3 points inside of it.
	const std::vector<Vec2> hull = box_hull({ 4, 4 }, 1).value();
	std::vector<Vec2> inner;
	for (int y = -1; y <= 1; ++y) {
		for (int x = -1; x <= 1; ++x) {
			inner.push_back({ Real(x), Real(y) });
		}
	}
	REQUIRE(hull.size() == 16);
	std::vector<Vec2> points = hull;
	points.insert(points.end(), inner.begin(), inner.end());
	Pairs expected;
	for (std::uint32_t i = 0; i < 16; ++i) {
		expected.insert(std::minmax(i, (i + 1) % 16));
	}
	for (std::uint32_t i = 16; i < 25; ++i) {
		for (std::uint32_t j = 0; j < 25; ++j) {
			const Vec2 way = points[j] - points[i];
			if (i != j && std::abs(way.x) < Real(1.5) && std::abs(way.y) < Real(1.5)) {
				expected.insert(std::minmax(i, j));
			}
		}
	}
	CHECK(pairs_of(automatic_springs(hull, inner, {})) == expected);
}

TEST_CASE("on scattered points springs join those that have no third one in the circle between them") {
	Random random(7);
	for (int round = 0; round < 20; ++round) {
		const std::vector<Vec2> hull = circle_hull(10, 24).value(); // convex: all see each other
		const std::vector<Vec2> inner = points_inside(hull, 30, random);
		std::vector<Vec2> points = hull;
		points.insert(points.end(), inner.begin(), inner.end());
		points.push_back({ 0, 0 });
		Pairs expected;
		for (std::uint32_t i = 0; i < 24; ++i) {
			expected.insert(std::minmax(i, (i + 1) % 24));
			expected.insert({ i, 54 });
		}
		for (std::uint32_t i = 24; i < 54; ++i) {
			for (std::uint32_t j = 0; j < 55; ++j) {
				const Vec2 middle = (points[i] + points[j]) * Real(0.5);
				const Real radius = length(points[i] - points[j]) / 2;
				bool is_free = i != j;
				for (std::uint32_t k = 0; k < 55; ++k) {
					is_free = is_free && (k == i || k == j || length(points[k] - middle) > radius * Real(0.9999));
				}
				if (is_free) {
					expected.insert(std::minmax(i, j));
				}
			}
		}
		CHECK(pairs_of(automatic_springs(hull, inner, Vec2{ 0, 0 })) == expected);
	}
}

TEST_CASE("no spring of an inner point leaves a concave outline, and none is left alone") {
	Random random(11);
	for (int round = 0; round < 20; ++round) {
		const std::vector<Vec2> inner = points_inside(U_SHAPE, 40, random);
		std::vector<Vec2> points = U_SHAPE;
		points.insert(points.end(), inner.begin(), inner.end());
		std::vector<int> springs_at(points.size());
		for (const auto [a, b] : automatic_springs(U_SHAPE, inner, {})) {
			++springs_at[a];
			++springs_at[b];
			for (int step = 1; step < 20 && std::max(a, b) >= U_SHAPE.size(); ++step) {
				const Vec2 p = points[a] + (points[b] - points[a]) * (Real(step) / 20);
				CHECK(point_in_polygon(p, U_SHAPE));
			}
		}
		CHECK(*std::ranges::min_element(springs_at) >= 1);
	}
}

TEST_CASE("points that coincide are not joined to each other, and the same springs come from the same points") {
	const std::vector<Vec2> hull = circle_hull(10, 12).value();
	const std::vector<Vec2> inner{ { 1, 1 }, { 1, 1 }, { 10, 0 } };
	const Pairs pairs = pairs_of(automatic_springs(hull, inner, {}));
	CHECK_FALSE(pairs.contains({ 12, 13 }));
	CHECK_FALSE(pairs.contains({ 0, 14 }));
	CHECK(automatic_springs(hull, inner, {}) == automatic_springs(hull, inner, {}));
}
