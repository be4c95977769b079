// SPDX-License-Identifier: MIT
// Claims about areas, centroids, containment, and which outlines can be a hull.
#include "core/base/constants.h"
#include "core/geometry/polygon.h"
#include "geometry/integer_geometry.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> moved(std::vector<Vec2> polygon, Vec2 offset) {
	for (Vec2 &p : polygon) {
		p += offset;
	}
	return polygon;
}

std::vector<Vec2> regular(int count, Real radius) {
	std::vector<Vec2> polygon;
	for (int i = 0; i < count; ++i) {
		polygon.push_back(Rotation::from_angle(Real(2 * std::numbers::pi * i / count)).apply({ radius, 0 }));
	}
	return polygon;
}

const std::vector<Vec2> L_SHAPE{ { 0, 0 }, { 4, 0 }, { 4, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };

} // namespace

TEST_CASE("area counts lattice points by Pick's theorem") {
	// Interior and border points of a simple polygon with integer corners: A = I + B/2 - 1. No
	// shoelace sum takes part.
	Random random(21);
	int checked = 0;
	for (int i = 0; i < 4000; ++i) {
		const auto polygon = random_grid_polygon(random, random.integer(3, 7), 8);
		if (!grid_is_simple(polygon)) {
			continue;
		}
		long interior = 0;
		long border = 0;
		for (long x = 0; x <= 8; ++x) {
			for (long y = 0; y <= 8; ++y) {
				const GridPoint p{ x, y };
				border += grid_on_border(p, polygon);
				interior += !grid_on_border(p, polygon) && grid_winding_number(p, polygon) != 0;
			}
		}
		const double area = double(interior) + double(border) / 2 - 1;
		const double sign = grid_double_area(polygon) > 0 ? 1 : -1;
		CHECK(double(signed_area(to_real(polygon))) == sign * area); // exact: halves of small integers
		checked++;
	}
	CHECK(checked > 500);
}

TEST_CASE("a regular polygon has area n r² sin(2 pi / n) / 2, negative when reversed") {
	for (const int count : { 3, 8, 64 }) {
		auto polygon = regular(count, 3);
		const double expected = count * 9 * std::sin(2 * std::numbers::pi / count) / 2;
		// Each corner carries a rounding of its angle and its cosine.
		CHECK(relative_error(signed_area(polygon), expected) <= 8 * EPSILON);
		std::reverse(polygon.begin(), polygon.end());
		CHECK(relative_error(signed_area(polygon), -expected) <= 8 * EPSILON);
	}
}

TEST_CASE("area and centroid lose no digits far from the origin") {
	const Vec2 far{ 65536, -131072 }; // exact in float, and so are the corners there
	CHECK(signed_area(moved(L_SHAPE, far)) == signed_area(L_SHAPE));
	CHECK(distance(area_centroid(moved(L_SHAPE, far)), area_centroid(L_SHAPE) + far) <= EPSILON * 131072);
}

TEST_CASE("the centroid is that of the parts weighted by area") {
	// 4 x 1 at (2, 0.5) and 1 x 2 at (0.5, 2).
	const Vec2 expected{ Real((4 * 2 + 2 * 0.5) / 6), Real((4 * 0.5 + 2 * 2) / 6) };
	CHECK(distance(area_centroid(L_SHAPE), expected) <= 4 * EPSILON);
	Random random(22);
	for (int i = 0; i < 500; ++i) {
		const auto polygon = random_grid_polygon(random, random.integer(3, 7), 8);
		const long double_area = grid_double_area(polygon);
		if (double_area == 0) {
			continue;
		}
		long x = 0;
		long y = 0;
		for (std::size_t k = 0; k < polygon.size(); ++k) {
			const GridPoint a = polygon[k];
			const GridPoint b = polygon[(k + 1) % polygon.size()];
			x += (a.x + b.x) * grid_cross(a, b);
			y += (a.y + b.y) * grid_cross(a, b);
		}
		const Vec2 exact{ Real(double(x) / double(3 * double_area)), Real(double(y) / double(3 * double_area)) };
		// One rounding to Real of a place that is far away when the area is small; before it, in double, up to
		// seven moments of 700, rounded and divided by an area of at least 1.
		CHECK(distance(area_centroid(to_real(polygon)), exact) <= EPSILON * (1 + distance(exact, {})) + 1e-12);
	}
}

TEST_CASE("without area the centroid is the mean, and nothing has none") {
	CHECK(area_centroid(std::vector<Vec2>{ { 0, 0 }, { 3, 3 }, { 6, 6 } }) == Vec2{ 3, 3 });
	CHECK(area_centroid(std::vector<Vec2>{ { 2, 7 } }) == Vec2{ 2, 7 });
	CHECK(area_centroid({}) == Vec2{});
}

TEST_CASE("a point is in a polygon when it is wound around an odd number of times") {
	Random random(23);
	int wrong = 0;
	int inside = 0;
	for (int i = 0; i < 30000; ++i) {
		const auto polygon = random_grid_polygon(random, random.integer(3, 8), 6);
		const GridPoint p = random_grid_point(random, 6);
		if (grid_on_border(p, polygon)) {
			continue; // either answer is allowed there
		}
		const bool expected = grid_winding_number(p, polygon) % 2 != 0;
		inside += expected;
		wrong += point_in_polygon(p, to_real(polygon)) != expected;
	}
	CHECK(wrong == 0);
	CHECK(inside > 1000);
	CHECK_FALSE(point_in_polygon({ 0, 0 }, {}));
}

TEST_CASE("every border point of a star-shaped polygon is seen from its center, for either winding") {
	auto dented = regular(8, 2);
	dented[3] *= Real(0.3);
	CHECK(is_star_shaped_about({ 0, 0 }, dented));
	CHECK(is_star_shaped_about({ Real(0.5), Real(0.5) }, L_SHAPE));
	CHECK_FALSE(is_star_shaped_about({ 3, Real(0.5) }, L_SHAPE)); // the upper arm is hidden
	CHECK_FALSE(is_star_shaped_about({ 5, 5 }, L_SHAPE));
	auto reversed = L_SHAPE;
	std::reverse(reversed.begin(), reversed.end());
	CHECK(is_star_shaped_about({ Real(0.5), Real(0.5) }, reversed));
	CHECK_FALSE(is_star_shaped_about({ 3, Real(0.5) }, reversed));
}

TEST_CASE("a hull is accepted exactly when no point of it is there twice") {
	Random random(24);
	int wrong = 0;
	int accepted = 0;
	int refused = 0;
	for (int i = 0; i < 60000; ++i) {
		const auto polygon = random_grid_polygon(random, random.integer(3, 7), random.integer(2, 6));
		const bool expected = grid_is_simple(polygon) && grid_double_area(polygon) != 0;
		accepted += expected;
		refused += !expected;
		wrong += !check_hull(to_real(polygon)).has_value() != expected;
	}
	CHECK(wrong == 0);
	CHECK(accepted > 5000);
	CHECK(refused > 5000);
}

TEST_CASE("a polygon meets itself exactly when a point of its border is there twice, and then counts as folded") {
	Random random(25);
	int wrong = 0;
	int simple = 0;
	int turned_over = 0;
	for (int i = 0; i < 60000; ++i) {
		const auto polygon = random_grid_polygon(random, random.integer(3, 8), random.integer(2, 6));
		const bool expected = !grid_is_simple(polygon);
		simple += !expected;
		turned_over += !expected && grid_double_area(polygon) < 0;
		wrong += is_self_intersecting(to_real(polygon)) != expected;
		wrong += is_folded(to_real(polygon)) != (expected || grid_double_area(polygon) <= 0);
	}
	CHECK(wrong == 0);
	CHECK(simple > 5000);
	CHECK(turned_over > 2000);
	CHECK(is_folded(std::vector<Vec2>{ { 0, 0 }, { 1, 0 }, { 0, NOT_A_NUMBER } }));
}

TEST_CASE("concave and clockwise outlines can be hulls") {
	CHECK_FALSE(check_hull(L_SHAPE));
	auto clockwise = L_SHAPE;
	std::reverse(clockwise.begin(), clockwise.end());
	CHECK_FALSE(check_hull(clockwise));
	CHECK_FALSE(check_hull(regular(MIN_HULL_POINTS, 1)));
}

TEST_CASE("the largest hull is accepted and one more point is not") {
	// A polygon of 4097 points on a circle of this size has distinct neighbors in float, too.
	CHECK_FALSE(check_hull(regular(MAX_HULL_POINTS, 10000)));
	const Status status = check_hull(regular(MAX_HULL_POINTS + 1, 10000));
	REQUIRE(status.has_value());
	CHECK(mentions(status->message(), "4097 points"));
	CHECK(mentions(status->message(), "4096"));
}

TEST_CASE("every kind of bad hull is refused with a message that names what is wrong") {
	struct Case {
		std::vector<Vec2> hull;
		std::vector<std::string> parts;
	};
	const std::vector<Case> cases{
		{ {}, { "hull", "0 points", "3" } },
		{ { { 0, 0 }, { 1, 0 } }, { "hull", "2 points", "3" } },
		{ { { 0, 0 }, { 1, 0 }, { 1, NOT_A_NUMBER } }, { "hull[2]", "nan", "finite" } },
		{ { { 0, 0 }, { -INFINITE, 0 }, { 1, 1 } }, { "hull[1]", "-inf", "finite" } },
		{ { { 0, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 } }, { "points 1 and 2", "coincide" } },
		{ { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 0, 0 } }, { "points 3 and 0", "coincide" } },
		{ { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } }, { "edge 0-1", "edge 2-3", "intersect" } },
		{ { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 2, 0 }, { 0, 4 } }, { "edge 0-1", "edge 2-3" } }, // touches
		{ { { 0, 0 }, { 4, 0 }, { 2, 0 }, { 2, 2 } }, { "edge 1-2", "edge 0-1", "folds back" } },
		{ { { 0, 0 }, { 1, 1 }, { 2, 2 } }, { "folds back" } },
		{ { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 0 }, { -2, 2 } }, { "edge 0-1", "meets" } }, // pinched
	};
	for (const Case &bad : cases) {
		const Status status = check_hull(bad.hull);
		REQUIRE(status.has_value());
		CAPTURE(status->message());
		for (const std::string &part : bad.parts) {
			CAPTURE(part);
			CHECK(mentions(status->message(), part));
		}
	}
}

TEST_CASE("the nearest place of an outline is as near as any of 20,000 outlines has one, and the first of several") {
	Random random(67);
	for (int round = 0; round < 20000; ++round) {
		std::vector<Vec2> outline;
		const bool on_lattice = random.chance(0.3); // with points that coincide and places that are equally near
		for (int i = random.integer(1, 40); i > 0; --i) {
			const Vec2 p = random.vector(4);
			outline.push_back(on_lattice ? Vec2{ std::round(p.x), std::round(p.y) } : p);
		}
		Vec2 p = random.vector(5);
		p = on_lattice ? Vec2{ std::round(p.x), std::round(p.y) } : p;
		double least = 1e9;
		std::size_t first = 0;
		for (std::size_t i = 0; i < outline.size(); ++i) {
			const Vec2d a{ double(outline[i].x), double(outline[i].y) };
			const Vec2 end = outline[(i + 1) % outline.size()];
			const Vec2d way{ double(end.x) - a.x, double(end.y) - a.y };
			const Vec2d offset{ double(p.x) - a.x, double(p.y) - a.y };
			const double size = length_squared(way);
			const double t = size > 0 ? std::clamp(dot(offset, way) / size, 0.0, 1.0) : 0.0;
			if (const double distance = length_squared(offset - way * t); distance < least) {
				least = distance;
				first = i;
			}
		}
		const OutlinePlace found = nearest_place(outline, p);
		REQUIRE(found.edge < outline.size());
		const Vec2 a = outline[found.edge];
		const Vec2 b = outline[(found.edge + 1) % outline.size()];
		CHECK(length(a + (b - a) * found.t - found.position) <= Real(1e-6));
		CHECK(std::abs(double(length(p - found.position)) - std::sqrt(least)) <= 2e-6);
		CHECK(std::abs(std::sqrt(double(found.distance_squared)) - std::sqrt(least)) <= 2e-6);
		if (least == 0 && on_lattice) {
			CHECK(found.edge == first);
		}
	}
}

TEST_CASE("no place is near a point that is no number") {
	const OutlinePlace found = nearest_place(std::vector<Vec2>{ { 0, 0 }, { 1, 0 }, { 0, 1 } }, { std::numeric_limits<Real>::quiet_NaN(), 0 });
	CHECK(found.edge == 0);
	CHECK(found.distance_squared == std::numeric_limits<Real>::max());
}

TEST_CASE("boxes grow, contain and overlap with their borders included") {
	const Aabb box = bounding_box(std::vector<Vec2>{ { 1, 5 }, { -2, 3 }, { 0, 7 } });
	CHECK(box.min == Vec2{ -2, 3 });
	CHECK(box.max == Vec2{ 1, 7 });
	const Aabb large = box.grown(2);
	CHECK(large.min == Vec2{ -4, 1 });
	CHECK(large.max == Vec2{ 3, 9 });
	CHECK(large.contains(box));
	CHECK(box.contains(box));
	CHECK_FALSE(box.contains(large));
	const std::vector<Vec2> sides{ { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
	for (const Vec2 side : sides) {
		const Vec2 touch{ side.x * 3, side.y * 4 };
		const Aabb touching{ box.min + touch, box.max + touch };
		CHECK(box.overlaps(touching));
		CHECK(touching.overlaps(box));
		const Aabb apart{ box.min + touch * Real(1.01), box.max + touch * Real(1.01) };
		CHECK_FALSE(box.overlaps(apart));
		CHECK_FALSE(apart.overlaps(box));
		const Aabb shifted{ box.min + side, box.max + side };
		CHECK_FALSE(box.contains(shifted));
	}
	CHECK_FALSE(Aabb{}.overlaps(box));
	CHECK_FALSE(box.overlaps(Aabb{}));
}
