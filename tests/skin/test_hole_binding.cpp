// SPDX-License-Identifier: MIT
// Holes that follow the hull around them.
#include "core/skin/hole_binding.h"

#include "core/creator/hole_weights.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double PI = std::numbers::pi;

HoleBinding bound(const Holes &holes, const std::vector<Vec2> &hull) {
	return HoleBinding(holes, hull, hole_weights(hull, holes));
}

std::vector<Vec2> placed(const HoleBinding &binding, const std::vector<Vec2> &hull) {
	std::vector<Vec2> points(binding.point_count());
	binding.place(hull, points);
	return points;
}

std::vector<Vec2> moved(std::vector<Vec2> polygon, Vec2 by) {
	for (Vec2 &p : polygon) {
		p += by;
	}
	return polygon;
}

// How a thin ring of outer radius 1 is bent that keeps the length of its middle line: u_r = e cos 2φ and u_φ = -e/2 sin 2φ there; its cross
// sections turn by 3/2 e sin 2φ / R and stay straight and as wide.
struct BentRing {
	double inner;
	double bend;

	Vec2 place(double radius, double angle) const {
		const double middle = (1 + inner) / 2;
		const double turn = 1.5 * bend * std::sin(2 * angle) / middle;
		const double out = radius + bend * std::cos(2 * angle);
		const double along = -0.5 * bend * std::sin(2 * angle) + (radius - middle) * turn;
		return { Real(50 * (out * std::cos(angle) - along * std::sin(angle))), Real(50 * (out * std::sin(angle) + along * std::cos(angle))) };
	}
	std::vector<Vec2> hull(int count) const {
		std::vector<Vec2> points;
		for (int i = 0; i < count; ++i) {
			points.push_back(place(1, 2 * PI * i / count));
		}
		return points;
	}
};

} // namespace

TEST_CASE("holes lie where they were drawn at rest, and move and turn with the hull, whichever way it is wound") {
	Random random(3);
	std::vector<Vec2> hull = moved(box_hull({ 160, 100 }, 20).value(), { 300, 200 });
	const Holes holes{ moved(circle_hull(20, 12).value(), { 260, 200 }), moved(box_hull({ 30, 80 }, 100).value(), { 340, 201 }) };
	for (int i = 0; i < 40; ++i) {
		if (i == 20) {
			std::ranges::reverse(hull);
		}
		const HoleBinding binding = bound(holes, hull);
		CHECK(binding.counts().size() == 2);
		CHECK(binding.point_count() == holes[0].size() + holes[1].size());
		const bool is_rest = i % 20 == 0;
		const double angle = is_rest ? 0.0 : double(random.real(-3, 3));
		const Vec2 shift = is_rest ? Vec2{} : random.vector(300);
		const Vec2 x{ Real(std::cos(angle)), Real(std::sin(angle)) };
		const auto mapped = [&](Vec2 p) { return x * p.x + Vec2{ -x.y, x.x } * p.y + shift; };
		std::vector<Vec2> moved_hull = hull;
		std::ranges::transform(hull, moved_hull.begin(), mapped);
		const std::vector<Vec2> found = placed(binding, moved_hull);
		std::size_t k = 0;
		for (const std::vector<Vec2> &hole : holes) {
			for (const Vec2 p : hole) {
				CHECK(double(length(found[k++] - mapped(p))) < (is_rest ? 1e-4 : 1e-2));
			}
		}
	}
}

TEST_CASE("the hole of a ring that grows gets wider than the ring does, as that of Lame's cylinder") {
	// Displacement A r + B / r without pressure inside, in plane strain: that of the inner side over that of the outer one.
	constexpr double NU = 0.45 / 0.55;
	for (const double inner : { 45.0, 30.0, 15.0 }) {
		const std::vector<Vec2> hull = circle_hull(50, 32).value();
		std::vector<Vec2> grown = hull;
		for (Vec2 &p : grown) {
			p = p * Real(1.05);
		}
		const std::vector<Vec2> found = placed(bound({ circle_hull(Real(inner), 32).value() }, hull), grown);
		const double ratio = 2 * inner / ((1 - NU) * 50 + (1 + NU) * inner * inner / 50);
		CAPTURE(inner);
		for (const Vec2 p : found) {
			CHECK(std::abs((double(length(p)) - inner) / 2.5 / ratio - 1) < (inner < 20 ? 0.08 : 0.03)); // cells are large beside a small hole
		}
	}
}

TEST_CASE("the wall of a ring bends and keeps its width" * doctest::test_suite("slow")) {
	for (const double inner : { 0.9, 0.8, 0.7 }) {
		const BentRing ring{ inner, 0.05 };
		for (const int count : { 12, 16, 32, 64 }) {
			const std::vector<Vec2> hole = circle_hull(Real(50 * inner), 48).value();
			const std::vector<Vec2> found = placed(bound({ hole }, circle_hull(50, count).value()), ring.hull(count));
			double worst = 0;
			for (int i = 0; i < 48; ++i) {
				worst = std::max(worst, double(length(found[std::size_t(i)] - ring.place(inner, 2 * PI * i / 48))));
			}
			CAPTURE(inner);
			CAPTURE(count);
			CHECK(worst < 0.1 * 50 * ring.bend);
			// Wound the other way, the same.
			std::vector<Vec2> turned = circle_hull(50, count).value();
			std::vector<Vec2> turned_bent = ring.hull(count);
			std::ranges::reverse(turned);
			std::ranges::reverse(turned_bent);
			const std::vector<Vec2> same = placed(bound({ hole }, turned), turned_bent);
			for (std::size_t i = 0; i < found.size(); ++i) {
				CHECK(double(length(same[i] - found[i])) < 0.02);
			}
		}
	}
}

TEST_CASE("a small hole in a sheet that is stretched grows more than twice as much along, and shrinks across") {
	// In a wide sheet of stress σ in plane strain the radius r of a hole changes by r σ (1 + 2 cos 2φ) / E' (Kirsch 1898), the sheet by σ / E' along
	// and -ν' σ / E' across, with ν' = ν / (1 - ν).
	const double nu = 0.45 / 0.55;
	constexpr double STRAIN = 0.02;
	const std::vector<Vec2> hull = box_hull({ 100, 100 }, 10).value();
	const std::vector<Vec2> hole = circle_hull(10, 24).value();
	std::vector<Vec2> stretched = hull;
	for (Vec2 &p : stretched) {
		p = { Real(double(p.x) * (1 + STRAIN)), Real(double(p.y) * (1 - nu * STRAIN)) };
	}
	const std::vector<Vec2> found = placed(bound({ hole }, hull), stretched);
	const double along = (double(found[0].x) - found[12].x) / 20 - 1;
	const double across = (double(found[6].y) - found[18].y) / 20 - 1;
	// 3 and -1 in an endless sheet; this one is held at its edges, and has four cells to the hole's radius.
	CHECK(along / STRAIN > 2.2);
	CHECK(along / STRAIN < 3.1);
	CHECK(across / STRAIN < -0.7);
	CHECK(across / STRAIN > -1.1);
}

TEST_CASE("however far a body is pressed, its holes do not turn inside out") {
	for (const double radius : { 8.0, 25.0, 42.0 }) {
		const std::vector<Vec2> hull = circle_hull(50, 24).value();
		const HoleBinding binding = bound({ circle_hull(Real(radius), 24).value() }, hull);
		double least = 1;
		for (double pressed = 1; pressed > 0.15; pressed -= 0.05) {
			std::vector<Vec2> flat = hull;
			for (Vec2 &p : flat) {
				p = { Real(double(p.x) / std::sqrt(pressed)), Real(double(p.y) * pressed) };
			}
			const std::vector<Vec2> found = placed(binding, flat);
			CAPTURE(radius);
			CAPTURE(pressed);
			CHECK(!is_folded(found));
			const double height = (double(found[6].y) - found[18].y) / (2 * radius);
			CHECK(height > 0);
			CHECK(height < 1.01);
			least = std::min(least, height);
		}
		CHECK(least < 0.45); // they do close
	}
}

TEST_CASE("hundreds of hull points carry holes by affine maps, exactly") {
	Random random(5);
	const std::vector<Vec2> hull = circle_hull(50, 200).value();
	const std::vector<Vec2> hole = circle_hull(20, 12).value();
	const HoleBinding binding = bound({ hole }, hull);
	const Vec2 x{ Real(1.1), Real(0.1) };
	const Vec2 y{ Real(-0.2), Real(0.8) };
	std::vector<Vec2> mapped = hull;
	std::ranges::transform(hull, mapped.begin(), [&](Vec2 p) { return x * p.x + y * p.y; });
	const std::vector<Vec2> found = placed(binding, mapped);
	for (std::size_t i = 0; i < found.size(); ++i) {
		CHECK(double(length(found[i] - (x * hole[i].x + y * hole[i].y))) < 1e-3);
	}
}

TEST_CASE("the far side of a body does not move a hole here") {
	const std::vector<Vec2> hull = box_hull({ 400, 60 }, 20).value();
	const HoleBinding binding = bound({ moved(circle_hull(15, 12).value(), { -160, 0 }) }, hull);
	std::vector<Vec2> pushed = hull;
	for (Vec2 &p : pushed) {
		if (p.x > 100) {
			p.x += 5;
		}
	}
	const std::vector<Vec2> before = placed(binding, hull);
	const std::vector<Vec2> after = placed(binding, pushed);
	for (std::size_t i = 0; i < before.size(); ++i) {
		CHECK(double(length(after[i] - before[i])) < 0.5);
	}
}
