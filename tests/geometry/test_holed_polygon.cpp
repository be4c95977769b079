// SPDX-License-Identifier: MIT
// Polygons with holes: measures against closed forms, and what is refused.
#include "core/geometry/holed_polygon.h"

#include "core/creator/hulls.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> box(Real left, Real top, Real right, Real bottom) {
	return { { left, top }, { right, top }, { right, bottom }, { left, bottom } };
}

std::vector<Vec2> moved(std::vector<Vec2> polygon, Vec2 by) {
	for (Vec2 &p : polygon) {
		p += by;
	}
	return polygon;
}

} // namespace

TEST_CASE("area, centroid and inertia of a frame are those of a box less a box, wherever it lies and however it is wound") {
	// b h and b h (b² + h²) / 12, by Steiner about the common centroid.
	const Vec2 far{ 300, -200 };
	for (const bool is_reversed : { false, true }) {
		std::vector<Vec2> hull = moved(box(0, 0, 100, 60), far);
		Holes holes{ moved(box(10, 10, 40, 50), far) };
		if (is_reversed) {
			std::ranges::reverse(holes[0]);
		}
		const AreaMoments moments = area_moments(hull, holes);
		const double x = (6000.0 * 50 - 1200.0 * 25) / 4800;
		CHECK(moments.area == doctest::Approx(4800));
		CHECK(moments.centroid.x == doctest::Approx(300 + x));
		CHECK(moments.centroid.y == doctest::Approx(-200 + 30));
		const double whole = 6000.0 * (10000 + 3600) / 12 + 6000 * (50 - x) * (50 - x);
		const double hole = 1200.0 * (900 + 1600) / 12 + 1200 * (25 - x) * (25 - x);
		CHECK(moments.inertia == doctest::Approx(whole - hole));
		std::ranges::reverse(hull);
		CHECK(area_moments(hull, holes).inertia == doctest::Approx(whole - hole));
	}
}

TEST_CASE("the inertia of a ring approaches A (R² + r²) / 2") {
	const AreaMoments ring = area_moments(circle_hull(50, 512).value(), { circle_hull(30, 512).value() });
	CHECK(ring.area == doctest::Approx(std::numbers::pi * 1600).epsilon(1e-4));
	CHECK(ring.inertia == doctest::Approx(ring.area * (2500 + 900) / 2).epsilon(1e-4));
	CHECK(holed_perimeter(circle_hull(50, 512).value(), { circle_hull(30, 512).value() }) == doctest::Approx(2 * std::numbers::pi * 80).epsilon(1e-4));
}

TEST_CASE("moments of a polygon with holes are sums over its points, drawn at random") {
	Random random(7);
	const std::vector<Vec2> hull = box(-50, -40, 50, 40);
	const Holes holes{ moved(circle_hull(15, 9).value(), { -25, 5 }), box(10, -20, 30, 10) };
	const AreaMoments moments = area_moments(hull, holes);
	constexpr int COUNT = 200000;
	int inside = 0;
	double sum_x = 0;
	double squares = 0;
	for (int i = 0; i < COUNT; ++i) {
		const Vec2 p{ random.real(-50, 50), random.real(-40, 40) };
		if (point_in_holed_polygon(p, hull, holes)) {
			inside++;
			sum_x += double(p.x);
			squares += dot(Vec2d(p) - moments.centroid, Vec2d(p) - moments.centroid);
		}
	}
	// Errors of sampling: 1 / sqrt(COUNT) of the spread.
	CHECK(8000.0 * inside / COUNT == doctest::Approx(moments.area).epsilon(0.01));
	CHECK(std::abs(sum_x / inside - moments.centroid.x) < 0.4);
	CHECK(squares / inside == doctest::Approx(moments.inertia / moments.area).epsilon(0.01));
}

TEST_CASE("holes that no body can have are refused by name, value, bound and remedy") {
	const std::vector<Vec2> hull = box(0, 0, 100, 100);
	const auto refused = [&](const Holes &holes, const std::string &name, const std::string &word) {
		const Status status = check_holes("holes", holes, hull);
		REQUIRE(status);
		CAPTURE(status->message());
		CHECK(status->name.starts_with(name));
		CHECK(status->message().find(word) != std::string::npos);
		CHECK(!status->remedy.empty());
	};
	CHECK(!check_holes("holes", {}, hull));
	CHECK(!check_holes("holes", { box(10, 10, 40, 40), box(60, 60, 90, 90) }, hull));
	refused({ box(10, 10, 40, 40), { { 1, 1 }, { 2, 2 } } }, "holes[1]", "points");
	refused({ { { 10, 10 }, { 40, 40 }, { 40, 10 }, { 10, 40 } } }, "holes[0]", "intersect");
	refused({ { { 10, 10 }, { 40, 10 }, { std::numeric_limits<Real>::quiet_NaN(), 40 } } }, "holes[0]", "nan");
	refused({ box(80, 80, 120, 90) }, "holes[0]", "inside the polygon");
	refused({ box(120, 80, 140, 90) }, "holes[0]", "inside the polygon");
	refused({ box(-10, -10, 110, 110) }, "holes[0]", "inside the polygon");
	refused({ box(10, 0, 40, 40) }, "holes[0]", "inside the polygon"); // touches its side
	refused({ box(10, 10, 50, 50), box(40, 40, 80, 80) }, "holes[1]", "another hole");
	refused({ box(10, 10, 50, 50), box(20, 20, 40, 40) }, "holes[1]", "overlap");
	refused({ box(20, 20, 40, 40), box(10, 10, 50, 50) }, "holes[1]", "overlap");
	refused({ std::vector<Vec2>(5000) }, "holes", "4096");
}
