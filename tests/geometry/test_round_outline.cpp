// SPDX-License-Identifier: MIT
// Claims about the round outline that straight edges stand for.
#include "core/geometry/round_outline.h"

#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> ellipse(double a, double b, int count) {
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		points.push_back({ Real(a * std::cos(angle)), Real(b * std::sin(angle)) });
	}
	return points;
}

bool is_straight(const std::vector<Real> &bulges) {
	return std::ranges::all_of(bulges, [](Real bulge) { return bulge == 0; });
}

} // namespace

TEST_CASE("the edges of a circle's polygon bulge out to the circle, from eleven points on") {
	for (int count = 3; count <= 256; ++count) {
		CAPTURE(count);
		const double angle = std::numbers::pi / count; // half a turn
		const std::vector<Real> bulges = edge_bulges(ellipse(50, 50, count));
		REQUIRE(bulges.size() == std::size_t(count));
		for (const Real bulge : bulges) {
			if (std::tan(angle) > 0.31) {
				CHECK(bulge == 0);
			} else {
				CHECK(bulge == doctest::Approx(50 * (1 - std::cos(angle))).epsilon(0.01));
			}
		}
	}
}

TEST_CASE("straight sides, corners and dents stay as they are") {
	CHECK(is_straight(edge_bulges({ { { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 } } }))); // a square
	std::vector<Vec2> square; // four points a side
	for (int side = 0; side < 4; ++side) {
		const Vec2 corners[] = { { 0, 0 }, { 40, 0 }, { 40, 40 }, { 0, 40 }, { 0, 0 } };
		for (int i = 0; i < 4; ++i) {
			square.push_back(corners[side] + (corners[side + 1] - corners[side]) * (Real(i) / 4));
		}
	}
	CHECK(is_straight(edge_bulges(square)));

	// A capsule: caps of eight edges, sides of one. The sides and what lies beside them stay straight.
	std::vector<Vec2> capsule;
	for (int i = 0; i < 18; ++i) {
		const bool is_right = i < 9;
		const double angle = std::numbers::pi * (is_right ? i / 8.0 - 0.5 : (i - 9) / 8.0 + 0.5);
		capsule.push_back({ Real((is_right ? 60 : -60) + 20 * std::cos(angle)), Real(20 * std::sin(angle)) });
	}
	const std::vector<Real> bulges = edge_bulges(capsule);
	const double sagitta = 20 * (1 - std::cos(std::numbers::pi / 16));
	for (std::size_t i = 0; i < capsule.size(); ++i) {
		const Vec2 middle = (capsule[i] + capsule[(i + 1) % capsule.size()]) * Real(0.5);
		CAPTURE(middle.x);
		CAPTURE(middle.y);
		if (std::abs(middle.x) < 60) {
			CHECK(bulges[i] == 0);
		}
		CHECK(double(bulges[i]) <= sagitta * 1.01);
	}
	CHECK(std::ranges::count_if(bulges, [&](Real bulge) { return std::abs(bulge / sagitta - 1) < 0.01; }) == 12);

	std::vector<Vec2> dented = ellipse(50, 50, 32);
	dented[7] *= Real(0.8);
	const std::vector<Real> beside = edge_bulges(dented);
	for (const std::size_t i : { 5, 6, 7, 8 }) {
		CHECK(beside[i] == 0);
	}
	CHECK(beside[20] > 0);
}

TEST_CASE("the round outline never leaves a smooth one that it stands for by more than a tenth of the bulge") {
	for (std::uint32_t seed = 0; seed < 200; ++seed) {
		Random random(seed);
		const double a = random.real(20, 80);
		const double b = a * random.real(Real(0.6), 1);
		const int count = 16 + int(random.real(0, 48));
		CAPTURE(seed);
		const std::vector<Vec2> points = ellipse(a, b, count);
		const std::vector<Real> bulges = edge_bulges(points);
		for (int i = 0; i < count; ++i) {
			const double angle = 2 * std::numbers::pi * (i + 0.5) / count; // where the ellipse is farthest from its chord
			const double true_bulge = std::hypot(a * std::cos(angle), b * std::sin(angle)) -
					double(length(points[i] + points[(i + 1) % count])) / 2;
			CHECK(double(bulges[i]) <= true_bulge * 1.1);
		}
	}
}

TEST_CASE("a pressed edge bulges less, a flat or dented one not at all, a bent one no more than at rest") {
	const std::vector<Vec2> points = ellipse(50, 50, 16);
	const Real rest = edge_bulges(points)[0];
	const auto bulge_of = [&](Real flattened) { // x of the outermost points, pressed to a wall
		std::vector<Vec2> now = points;
		for (Vec2 &p : now) {
			p.x = std::min(p.x, flattened);
		}
		return present_bulge<Real>({ now[15], now[0], now[1], now[2] }, rest);
	};
	CHECK(bulge_of(50) == doctest::Approx(rest).epsilon(0.03));
	CHECK(bulge_of(48) < rest);
	CHECK(bulge_of(Real(46.1)) < Real(0.15) * rest);
	CHECK(bulge_of(35) == doctest::Approx(0));
	CHECK(present_bulge<Real>({ { 0, 0 }, { 1, 0 }, { 2, Real(-0.1) }, { 3, 0 } }, rest) == 0);
	CHECK(present_bulge<Real>({ { 0, 1 }, { 1, 0 }, { 2, 0 }, { 3, 1 } }, Real(0.1)) == Real(0.1));
}
