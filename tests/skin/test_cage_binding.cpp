// SPDX-License-Identifier: MIT
// Points that follow an outline around them.
#include "core/skin/cage_binding.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double PI = std::numbers::pi;

// Weights and places are rounded to `Real`; a place is a sum of products of these.
const double ROUNDING = sizeof(Real) == 4 ? 2e-4 : 1e-10;

// A star around the origin, of radii that differ by up to four times, in either winding.
std::vector<Vec2> star(Random &random, double least = 15) {
	const int count = random.integer(3, 40);
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * PI * (i + double(random.real(-0.3, 0.3))) / count;
		const double radius = double(random.real(least, 60));
		points.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
	}
	if (random.chance(0.5)) {
		std::reverse(points.begin(), points.end());
	}
	return points;
}

std::vector<Vec2> placed(const CageBinding &binding, const std::vector<Vec2> &outline) {
	std::vector<Vec2> points(binding.point_count());
	binding.place(outline, points);
	return points;
}

double distance(Vec2 a, Vec2 b) {
	return std::hypot(double(a.x) - double(b.x), double(a.y) - double(b.y));
}

// Largest size of a place's weights in sum: how much rounding of the outline's points counts.
double size_of(const CageBinding &binding, std::size_t index) {
	double sum = 0;
	for (const Real weight : binding.weights_of(index)) {
		sum += std::abs(double(weight));
	}
	return sum;
}

// The mean value of the outline's coordinate function, by the integral that defines it (Hormann and Floater 2006, eq. 5), by midpoints of small
// angles: the ray's place on the outline, over the distance to it.
Vec2 mean_value(const std::vector<Vec2> &outline, const std::vector<Vec2> &now, Vec2 place) {
	constexpr int STEPS = 20000;
	double x = 0, y = 0, sum = 0;
	for (int step = 0; step < STEPS; ++step) {
		const double angle = 2 * PI * (step + 0.5) / STEPS;
		const double dx = std::cos(angle), dy = std::sin(angle);
		for (std::size_t i = 0; i < outline.size(); ++i) {
			const std::size_t next = (i + 1) % outline.size();
			const double ax = double(outline[i].x) - double(place.x), ay = double(outline[i].y) - double(place.y);
			const double ex = double(outline[next].x) - double(outline[i].x), ey = double(outline[next].y) - double(outline[i].y);
			const double across = dx * ey - dy * ex;
			const double way = (ax * ey - ay * ex) / across;
			const double share = (ax * dy - ay * dx) / across;
			if (across != 0 && way > 0 && share >= 0 && share < 1) {
				x += ((1 - share) * double(now[i].x) + share * double(now[next].x)) / way;
				y += ((1 - share) * double(now[i].y) + share * double(now[next].y)) / way;
				sum += 1 / way;
				break;
			}
		}
	}
	return { Real(x / sum), Real(y / sum) };
}

} // namespace

TEST_CASE("at rest places are where they were, and any affine map of the outline carries them along, inside and outside") {
	const unsigned seed = std::random_device()();
	CAPTURE(seed);
	Random random(seed);
	for (int trial = 0; trial < 300; ++trial) {
		const std::vector<Vec2> outline = star(random);
		std::vector<Vec2> places;
		for (int i = 0; i < 12; ++i) {
			places.push_back(random.vector(90));
		}
		const CageBinding binding(outline, places);
		REQUIRE(binding.point_count() == places.size());
		const std::vector<Vec2> still = placed(binding, outline);
		const double a = double(random.real(-2, 2)), b = double(random.real(-2, 2)), c = double(random.real(-2, 2)), d = double(random.real(-2, 2));
		const double x = double(random.real(-100, 100)), y = double(random.real(-100, 100));
		const auto map = [&](Vec2 p) {
			return Vec2{ Real(a * double(p.x) + b * double(p.y) + x), Real(c * double(p.x) + d * double(p.y) + y) };
		};
		std::vector<Vec2> mapped;
		for (const Vec2 p : outline) {
			mapped.push_back(map(p));
		}
		const std::vector<Vec2> carried = placed(binding, mapped);
		for (std::size_t i = 0; i < places.size(); ++i) {
			CAPTURE(trial);
			CAPTURE(places[i].x);
			CAPTURE(places[i].y);
			const double allowed = ROUNDING * (1 + size_of(binding, i));
			CHECK(distance(still[i], places[i]) < allowed);
			CHECK(distance(carried[i], map(places[i])) < 4 * allowed);
		}
	}
}

TEST_CASE("places on points of the outline follow these to the bit, and those on edges divide them as at rest") {
	const unsigned seed = std::random_device()();
	CAPTURE(seed);
	Random random(seed);
	for (int trial = 0; trial < 200; ++trial) {
		const std::vector<Vec2> outline = star(random);
		std::vector<Vec2> places = outline;
		std::vector<double> shares;
		for (std::size_t i = 0; i < outline.size(); ++i) {
			shares.push_back(double(random.real(0.05, 0.95)));
			const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
			places.push_back({ Real(double(a.x) + shares[i] * (double(b.x) - double(a.x))), Real(double(a.y) + shares[i] * (double(b.y) - double(a.y))) });
		}
		const CageBinding binding(outline, places);
		std::vector<Vec2> now = outline;
		for (Vec2 &p : now) {
			p += random.vector(20);
		}
		const std::vector<Vec2> carried = placed(binding, now);
		for (std::size_t i = 0; i < outline.size(); ++i) {
			CHECK(carried[i].x == now[i].x);
			CHECK(carried[i].y == now[i].y);
			const Vec2 a = now[i], b = now[(i + 1) % now.size()];
			const Vec2 expected{ Real(double(a.x) + shares[i] * (double(b.x) - double(a.x))), Real(double(a.y) + shares[i] * (double(b.y) - double(a.y))) };
			// Rounded, a place is beside the edge by up to a ten-millionth of its coordinates.
			CHECK(distance(carried[outline.size() + i], expected) < (sizeof(Real) == 4 ? 2e-3 : 1e-8));
		}
	}
}

TEST_CASE("weights are those of the integral that defines mean values, where the outline is seen from") {
	const unsigned seed = std::random_device()();
	CAPTURE(seed);
	Random random(seed);
	for (int trial = 0; trial < 12; ++trial) {
		const std::vector<Vec2> outline = star(random, 35);
		if (outline.size() < 8) {
			continue; // wide gaps between points: the star may not be seen from its middle
		}
		std::vector<Vec2> now = outline;
		for (Vec2 &p : now) {
			p += random.vector(25);
		}
		const Vec2 middle{ 0, 0 };
		const CageBinding binding(outline, std::vector<Vec2>{ middle });
		CHECK(distance(placed(binding, now)[0], mean_value(outline, now, middle)) < 0.02);
	}
}

TEST_CASE("a small way in the plane is a small way on the carried plane, across edges and around points too") {
	const std::vector<Vec2> outline = { { 0, 0 }, { 60, 0 }, { 60, 60 }, { 40, 60 }, { 40, 20 }, { 0, 20 } }; // an L
	std::vector<Vec2> now = outline;
	Random random(7);
	for (Vec2 &p : now) {
		p += random.vector(8);
	}
	constexpr double STEP = 0.25;
	std::vector<Vec2> places;
	for (double x = -30; x < 90; x += STEP) {
		for (const double y : { -3.0, 0.0, 10.0, 19.999, 20.0, 20.001, 45.0, 60.0, 75.0 }) {
			places.push_back({ Real(x), Real(y) });
		}
	}
	const std::vector<Vec2> carried = placed(CageBinding(outline, places), now);
	for (std::size_t i = 9; i < places.size(); ++i) {
		CAPTURE(places[i].x);
		CAPTURE(places[i].y);
		CHECK(distance(carried[i], carried[i - 9]) < 12 * STEP);
	}
}
