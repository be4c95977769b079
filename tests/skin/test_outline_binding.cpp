// SPDX-License-Identifier: MIT
#include "core/skin/outline_binding.h"

#include "core/base/elementary.h"
#include "core/creator/simplify_outline.h"
#include "core/geometry/polygon.h"
#include "scenes/fine_outlines.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

struct Bound {
	std::vector<Vec2> outline;
	SimplifiedOutline simple;
	OutlineBinding binding;
	double radius = 0;

	explicit Bound(std::vector<Vec2> p_outline) :
			outline(std::move(p_outline)), simple(simplify_outline(outline, {}).value()), binding(outline, simple.hull, simple.places), radius(radius_of_area(outline)) {}

	std::vector<Vec2> placed(const std::vector<Vec2> &hull) const {
		std::vector<Vec2> places(outline.size());
		binding.place(hull, places);
		return places;
	}
	template <class Map>
	std::vector<Vec2> mapped(const std::vector<Vec2> &points, const Map &map) const {
		std::vector<Vec2> images;
		for (const Vec2 p : points) {
			images.push_back(map(p));
		}
		return images;
	}
};

double largest_distance(const std::vector<Vec2> &a, const std::vector<Vec2> &b) {
	double most = 0;
	for (std::size_t i = 0; i < a.size(); ++i) {
		most = std::max(most, double(length(a[i] - b[i])));
	}
	return most;
}

// A limb that bends: the plane rolled up about a point far below, places 100 px apart turned against each other by `turn`.
Vec2 bend(Vec2 p, double turn) {
	const double radius = 100 / turn;
	const SineCosine direction = sine_cosine(double(p.x) / radius);
	return { Real((radius + double(p.y)) * direction.sine), Real((radius + double(p.y)) * direction.cosine - radius) };
}

// The largest second difference of the displacement along a circle of `count` points whose hull points are pushed in one by one.
double largest_bend(int count) {
	std::vector<Vec2> circle;
	for (int i = 0; i < count; ++i) {
		const SineCosine direction = sine_cosine(6.283185307179586 * i / count);
		circle.push_back({ Real(50 * direction.cosine), Real(50 * direction.sine) });
	}
	const Bound body(circle);
	double peak = 0;
	for (std::size_t moved = 0; moved < body.simple.hull.size(); ++moved) {
		std::vector<Vec2> hull = body.simple.hull;
		hull[moved] *= Real(0.9);
		const std::vector<Vec2> placed = body.placed(hull);
		for (int i = 0; i < count; ++i) {
			const auto push = [&](int k) { return placed[std::size_t((k + count) % count)] - circle[std::size_t((k + count) % count)]; };
			peak = std::max(peak, double(length(push(i - 1) + push(i + 1) - push(i) * Real(2))));
		}
	}
	return peak;
}

} // namespace

TEST_CASE("at rest the outline is the drawn one, and a moved, turned, stretched and sheared hull carries it exactly") {
	for (int seed = 0; seed < 100; ++seed) {
		CAPTURE(seed);
		Random random(92'000 + std::uint64_t(seed));
		const Bound body(seed == 0 ? character_outline(200) : random_blob(random.integer(40, 300), random));
		const double rounding = 2e-5 * (body.radius + 1000);
		CHECK(largest_distance(body.placed(body.simple.hull), body.outline) <= rounding);
		const Real a = random.real(-2, 2), b = random.real(-1, 1), c = random.real(-1, 1), d = random.real(-2, 2);
		const auto affine = [&](Vec2 p) { return Vec2{ a * p.x + b * p.y + 30, c * p.x + d * p.y - 70 }; };
		const std::vector<Vec2> carried = body.placed(body.mapped(body.simple.hull, affine));
		CHECK(largest_distance(carried, body.mapped(body.outline, affine)) <= 4 * rounding);
	}
}

TEST_CASE("a bent hull carries the outline to within a tolerance of the bent outline") {
	for (int seed = 0; seed < 60; ++seed) {
		CAPTURE(seed);
		Random random(93'000 + std::uint64_t(seed));
		std::vector<Vec2> outline = seed == 0 ? character_outline(200) : random_blob(200, random);
		const Vec2 middle = area_centroid(outline);
		for (Vec2 &p : outline) {
			p = p - middle;
		}
		const Bound body(outline);
		const double turn = 0.8; // 46 degrees from one side to the other
		const auto bent = [&](Vec2 p) { return bend(p, turn); };
		const double error = largest_distance(body.placed(body.mapped(body.simple.hull, bent)), body.mapped(body.outline, bent));
		CHECK(error <= 0.045 * body.radius);
	}
}

// Where the motion along the outline is continuously differentiable, second differences fall with the square of the distance between
// drawn points; at a corner, with the distance alone: to a quarter for four times as many points, not to a sixteenth.
TEST_CASE("a drawn circle shows no corner where a hull point is pushed in") {
	const double coarse = largest_bend(200);
	const double fine = largest_bend(800);
	CHECK(coarse < 0.4);
	CHECK(fine < coarse / 9);
}

TEST_CASE("weights sum to 1, and no drawn point follows a hull point more than one to one by much") {
	for (int seed = 0; seed < 60; ++seed) {
		CAPTURE(seed);
		Random random(94'000 + std::uint64_t(seed));
		const Bound body(seed == 0 ? character_outline(200) : noisy_blob(random.integer(60, 300), random));
		for (std::size_t i = 0; i < body.outline.size(); ++i) {
			double sum = 0;
			double sizes = 0;
			for (const Real weight : body.binding.weights_of(i)) {
				sum += double(weight);
				sizes += std::abs(double(weight));
			}
			CHECK(sum == doctest::Approx(1).epsilon(1e-5));
			CHECK(sizes < 2);
		}
	}
}

TEST_CASE("the far side of a body does not move what is drawn here") {
	const Bound body(character_outline(200));
	// The left ear is pushed away; the feet stay.
	std::vector<Vec2> hull = body.simple.hull;
	for (Vec2 &p : hull) {
		if (p.y < -50 && p.x < 0) {
			p += Vec2{ -10, -10 };
		}
	}
	const std::vector<Vec2> placed = body.placed(hull);
	for (std::size_t i = 0; i < placed.size(); ++i) {
		if (body.outline[i].y > 30) {
			CHECK(length(placed[i] - body.outline[i]) < 0.15);
		}
	}
}

TEST_CASE("the hull is found again from the outline that follows it, however it is deformed") {
	for (int seed = 0; seed < 40; ++seed) {
		CAPTURE(seed);
		Random random(95'000 + std::uint64_t(seed));
		const Bound body(seed == 0 ? character_outline(200) : noisy_blob(random.integer(60, 300), random));
		std::vector<Vec2> hull = body.simple.hull;
		for (Vec2 &p : hull) {
			p += random.vector(8);
		}
		std::vector<Vec2> found(hull.size());
		body.binding.fit(body.placed(hull), found);
		CHECK(largest_distance(found, hull) < 0.02);
	}
}

TEST_CASE("the hull that is fitted to a bent outline shows it to within a tolerance") {
	const Bound body(character_outline(200));
	const auto bent = [](Vec2 p) { return bend(p, 0.8); };
	const std::vector<Vec2> outline = body.mapped(body.outline, bent);
	std::vector<Vec2> hull(body.simple.hull.size());
	body.binding.fit(outline, hull);
	CHECK(largest_distance(body.placed(hull), outline) <= 0.03 * body.radius);
	// No hull shows it better, at this one's points and in the mean.
	const auto sum_of_squares = [&](const std::vector<Vec2> &placed) {
		double sum = 0;
		for (std::size_t i = 0; i < placed.size(); ++i) {
			sum += double(length_squared(placed[i] - outline[i]));
		}
		return sum;
	};
	const double least = sum_of_squares(body.placed(hull));
	for (std::size_t i = 0; i < hull.size(); ++i) {
		for (const Vec2 step : { Vec2{ Real(0.3), 0 }, Vec2{ Real(-0.3), 0 }, Vec2{ 0, Real(0.3) }, Vec2{ 0, Real(-0.3) } }) {
			std::vector<Vec2> other = hull;
			other[i] += step;
			CHECK(sum_of_squares(body.placed(other)) > least);
		}
	}
}

TEST_CASE("a binding knows what it was made of") {
	const Bound body(character_outline(200));
	CHECK(body.binding.is_made_of(body.outline, body.simple.hull, body.simple.places));
	std::vector<Vec2> other = body.outline;
	other[7].x += 1;
	CHECK(!body.binding.is_made_of(other, body.simple.hull, body.simple.places));
	CHECK(!body.binding.is_made_of(body.outline, other, body.simple.places));
	CHECK(body.binding.outline_count() == 200);
	CHECK(body.binding.hull_count() == body.simple.hull.size());
}
