// SPDX-License-Identifier: MIT
// Claims about the outlines of circle, box and capsule.
#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

double longest_edge(const std::vector<Vec2> &hull) {
	double longest = 0;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		longest = std::fmax(longest, distance(hull[i], hull[(i + 1) % hull.size()]));
	}
	return longest;
}

bool contains_point(const std::vector<Vec2> &hull, Vec2 p, double tolerance) {
	for (const Vec2 q : hull) {
		if (distance(p, q) <= tolerance) {
			return true;
		}
	}
	return false;
}

} // namespace

TEST_CASE("circle points lie evenly on the circle, from (r, 0) towards y") {
	for (const int count : { 3, 8, 16, 100 }) {
		const auto hull = circle_hull(50, count).value();
		REQUIRE(hull.size() == std::size_t(count));
		CHECK(hull[0] == Vec2{ 50, 0 });
		for (int i = 0; i < count; ++i) {
			const double angle = 2 * std::numbers::pi * i / count;
			// One rounding of the cosine, one of the product.
			CHECK(std::abs(hull[std::size_t(i)].x - 50 * std::cos(angle)) <= 2 * EPSILON * 50);
			CHECK(std::abs(hull[std::size_t(i)].y - 50 * std::sin(angle)) <= 2 * EPSILON * 50);
		}
		CHECK_FALSE(check_hull(hull));
		CHECK(signed_area(hull) > 0);
	}
}

TEST_CASE("a coordinate that should be zero is zero") {
	const auto hull = circle_hull(50, 4).value();
	CHECK(hull[1].x == 0);
	CHECK(hull[2].y == 0);
	CHECK(hull[3].x == 0);
}

TEST_CASE("a box has its corners, its area, edges no longer than the spacing, and positive winding") {
	struct Case {
		Vec2 size;
		Real spacing;
		std::size_t count;
	};
	for (const Case &each : { Case{ { 4, 2 }, 1, 12 }, Case{ { 4, 2 }, Real(0.9), 2 * (5 + 3) }, Case{ { 4, 2 }, 100, 4 }, Case{ { Real(0.3), Real(0.1) }, Real(0.1), 8 } }) {
		const auto hull = box_hull(each.size, each.spacing).value();
		CHECK(hull.size() == each.count);
		const Vec2 h = each.size * Real(0.5);
		CHECK(hull[0] == -h);
		const double tolerance = 2 * EPSILON * double(each.size.x);
		for (const Vec2 corner : { Vec2{ -h.x, -h.y }, Vec2{ h.x, -h.y }, Vec2{ h.x, h.y }, Vec2{ -h.x, h.y } }) {
			CHECK(contains_point(hull, corner, 0));
		}
		for (const Vec2 p : hull) { // on the outline
			const double outside = std::fmax(std::abs(double(p.x)) - h.x, std::abs(double(p.y)) - h.y);
			CHECK(std::abs(outside) <= tolerance);
		}
		CHECK(relative_error(signed_area(hull), double(each.size.x) * each.size.y) <= 8 * EPSILON);
		CHECK(longest_edge(hull) <= double(each.spacing) * (1 + 1e-6)); // the allowance for exact divisions
		CHECK_FALSE(check_hull(hull));
	}
}

TEST_CASE("capsule points lie on the capsule and enclose little less than it") {
	struct Case {
		Real radius, height, spacing;
	};
	for (const Case &each : { Case{ 1, 4, Real(0.25) }, Case{ 20, 100, 7 }, Case{ 3, 7, 1000 } }) {
		const auto hull = capsule_hull(each.radius, each.height, each.spacing).value();
		const double straight = double(each.height) / 2 - each.radius;
		double lowest = 0;
		double highest = 0;
		for (const Vec2 p : hull) {
			const double core_y = std::fmin(std::fmax(double(p.y), -straight), straight);
			const double from_core = std::hypot(double(p.x), double(p.y) - core_y);
			CHECK(std::abs(from_core - each.radius) <= 4 * EPSILON * double(each.height));
			lowest = std::fmin(lowest, double(p.y));
			highest = std::fmax(highest, double(p.y));
		}
		// An arc of n pieces of angle pi/n loses n r² (pi/n - sin(pi/n)) / 2 of its area.
		const double pieces = std::fmax(2, std::ceil(std::numbers::pi * each.radius / each.spacing - 1e-6));
		const double r = each.radius;
		const double expected = 4 * r * straight + pieces * r * r * std::sin(std::numbers::pi / pieces);
		CHECK(relative_error(signed_area(hull), expected) <= 16 * EPSILON);
		CHECK(longest_edge(hull) <= std::fmax(double(each.spacing), 0) * (1 + 1e-6));
		CHECK(highest == doctest::Approx(-lowest));
		CHECK(contains_point(hull, { each.radius, Real(straight) }, 2 * EPSILON * double(each.height)));
		CHECK(contains_point(hull, { each.radius, Real(-straight) }, 2 * EPSILON * double(each.height)));
		CHECK(contains_point(hull, { -each.radius, Real(straight) }, 2 * EPSILON * double(each.height)));
		CHECK(contains_point(hull, { -each.radius, Real(-straight) }, 2 * EPSILON * double(each.height)));
		CHECK_FALSE(check_hull(hull));
	}
	CHECK(capsule_hull(3, 7, 1000).value().size() == 6); // two pieces an arc, one a side
}

TEST_CASE("deep dents are told from shallow ones, in either winding") {
	const std::vector<Vec2> letter = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }; // 3 of 3.5
	CHECK(has_deep_dents(letter));
	CHECK(has_deep_dents(std::vector<Vec2>(letter.rbegin(), letter.rend())));
	const auto box_with_dent = [](Real depth) { // 4 - depth of 4
		return std::vector<Vec2>{ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 1, 2 - depth }, { 0, 2 } };
	};
	CHECK(has_deep_dents(box_with_dent(Real(0.21))));
	CHECK_FALSE(has_deep_dents(box_with_dent(Real(0.19))));
	CHECK_FALSE(has_deep_dents(circle_hull(50, 16).value()));
	CHECK_FALSE(has_deep_dents(box_hull({ 40, 10 }, 5).value()));
}

TEST_CASE("outlines refuse lengths that are not positive and counts out of range, by name") {
	for (const Real bad : { Real(0), Real(-1), NOT_A_NUMBER, INFINITE }) {
		CHECK(circle_hull(bad, 8).error().name == "radius");
		CHECK(box_hull({ bad, 1 }, 1).error().name == "size.x");
		CHECK(box_hull({ 1, bad }, 1).error().name == "size.y");
		CHECK(box_hull({ 1, 1 }, bad).error().name == "spacing");
		CHECK(capsule_hull(bad, 4, 1).error().name == "radius");
		CHECK(capsule_hull(1, bad, 1).error().name == "height");
		CHECK(capsule_hull(1, 4, bad).error().name == "spacing");
	}
	CHECK(capsule_hull(2, 4, 1).error().name == "height"); // a circle is no capsule
	for (const int bad : { -1, 0, MIN_HULL_POINTS - 1, MAX_HULL_POINTS + 1 }) {
		CHECK(circle_hull(1, bad).error().name == "point_count");
	}
	CHECK(circle_hull(1, MIN_HULL_POINTS).has_value());
	CHECK(circle_hull(10000, MAX_HULL_POINTS).value().size() == std::size_t(MAX_HULL_POINTS));
	// Too many to count in an int, let alone to store.
	CHECK(box_hull({ 1, 1 }, Real(1e-20)).error().name == "point_count");
	CHECK(capsule_hull(1, 4, Real(1e-20)).error().name == "point_count");
}
