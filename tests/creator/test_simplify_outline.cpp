// SPDX-License-Identifier: MIT
#include "core/creator/simplify_outline.h"

#include "core/base/hash.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "scenes/fine_outlines.h"
#include "scenes/random_cuts.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <utility>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

double distance_to(Vec2d p, const std::vector<Vec2> &polygon) {
	double least = 1e300;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2d a(polygon[i]);
		const Vec2d along = Vec2d(polygon[(i + 1) % polygon.size()]) - a;
		const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
		const Vec2d arm = a + along * t - p;
		least = std::min(least, std::sqrt(dot(arm, arm)));
	}
	return least;
}

// By brute force: of many places of `from`, the largest distance to any edge of `to`.
double one_sided_distance(const std::vector<Vec2> &from, const std::vector<Vec2> &to) {
	double most = 0;
	for (std::size_t i = 0; i < from.size(); ++i) {
		const Vec2d a(from[i]);
		const Vec2d b(from[(i + 1) % from.size()]);
		for (int k = 0; k < 16; ++k) {
			most = std::max(most, distance_to(a + (b - a) * (k / 16.0), to));
		}
	}
	return most;
}

double side(Vec2 a, Vec2 b, Vec2 c) {
	return cross(difference(b, a), difference(c, a));
}

// Whether no two edges meet but at the point that neighbors share.
bool is_simple(const std::vector<Vec2> &polygon) {
	const std::size_t n = polygon.size();
	for (std::size_t i = 0; i < n; ++i) {
		for (std::size_t j = i + 2; j < n; ++j) {
			if (i == 0 && j == n - 1) {
				continue;
			}
			const Vec2 a = polygon[i], b = polygon[i + 1], c = polygon[j], d = polygon[(j + 1) % n];
			if (side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0) {
				return false;
			}
		}
	}
	return true;
}

double shortest_edge(const std::vector<Vec2> &polygon) {
	double least = 1e300;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		least = std::min(least, double(length(polygon[(i + 1) % polygon.size()] - polygon[i])));
	}
	return least;
}

double longest_edge(const std::vector<Vec2> &polygon) {
	double most = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		most = std::max(most, double(length(polygon[(i + 1) % polygon.size()] - polygon[i])));
	}
	return most;
}

std::vector<Vec2> fresh_outline(int kind, Random &random) {
	switch (kind) {
		case 0: return random_blob(random.integer(30, 300), random);
		case 1: return noisy_blob(random.integer(60, 300), random);
		case 2: { // a picture that was traced: corners rounded, points close together
			const std::vector<Vec2> corners = random_outline(OutlineKind(random.integer(0, OUTLINE_KIND_COUNT - 1)), 24, random);
			return rounded_outline(corners, 2, random.integer(60, 300));
		}
		default: return random_outline(OutlineKind(random.integer(0, OUTLINE_KIND_COUNT - 1)), 80, random);
	}
}

SimplifiedOutline simplified(const std::vector<Vec2> &outline, const SimplifyOptions &options = {}) {
	const auto made = simplify_outline(outline, options);
	REQUIRE(made);
	return made.value();
}

} // namespace

TEST_CASE("480 random outlines are simplified within the tolerance in both directions, with their area and centroid, into simple hulls" * doctest::test_suite("slow")) {
	int taken_out = 0;
	for (int seed = 0; seed < 480; ++seed) {
		CAPTURE(seed);
		Random random(90'000 + std::uint64_t(seed));
		const std::vector<Vec2> outline = fresh_outline(seed % 4, random);
		if (check_hull(outline)) {
			continue; // rounded corners of thin shapes may meet
		}
		SimplifyOptions options;
		options.tolerance = random.chance(0.5) ? 0.03 : double(random.real(0.002, 0.1));
		options.fewest_points = random.chance(0.5) ? 16 : 3;
		options.least_edge = random.chance(0.5) ? 0 : random.real(0, 15);
		const SimplifiedOutline made = simplified(outline, options);
		const double radius = radius_of_area(outline);
		const double rounding = 1e-5 * (radius + 500);

		CHECK(made.error <= options.tolerance);
		CHECK(one_sided_distance(outline, made.hull) <= made.error * radius + rounding);
		CHECK(one_sided_distance(made.hull, outline) <= made.error * radius + rounding);
		CHECK(signed_area(made.hull) == doctest::Approx(signed_area(outline)).epsilon(1e-4));
		CHECK(length(area_centroid(made.hull) - area_centroid(outline)) <= rounding);
		CHECK(!check_hull(made.hull));
		CHECK(is_simple(made.hull));
		CHECK(int(made.hull.size()) >= std::min(int(outline.size()), options.fewest_points));
		// Neighbors that were too close are apart, as far as the tolerance allows.
		CHECK(shortest_edge(made.hull) >= std::min(shortest_edge(outline), std::max(double(options.least_edge), options.tolerance * radius)) - rounding);
		taken_out += int(outline.size() - made.hull.size());
	}
	CHECK(taken_out > 20'000);
}

TEST_CASE("a hull point stands for a place of the outline near it, and places follow one another") {
	for (int seed = 0; seed < 60; ++seed) {
		CAPTURE(seed);
		Random random(91'000 + std::uint64_t(seed));
		const std::vector<Vec2> outline = random_blob(200, random);
		const SimplifiedOutline made = simplified(outline);
		REQUIRE(made.places.size() == made.hull.size());
		for (std::size_t i = 0; i < made.hull.size(); ++i) {
			const std::size_t from = std::size_t(made.places[i]);
			const double t = made.places[i] - double(from);
			REQUIRE(from < outline.size());
			const Vec2d place = Vec2d(outline[from]) + (Vec2d(outline[(from + 1) % outline.size()]) - Vec2d(outline[from])) * t;
			const Vec2d arm = place - Vec2d(made.hull[i]);
			CHECK(std::sqrt(dot(arm, arm)) <= made.error * radius_of_area(outline) + 1e-3);
			CHECK((i == 0 || made.places[i] > made.places[i - 1]));
		}
	}
}

TEST_CASE("a character of 200 points is simulated with at most 24 at 3 %") {
	const std::vector<Vec2> outline = character_outline(200);
	REQUIRE(!check_hull(outline));
	const SimplifiedOutline made = simplified(outline);
	CHECK(made.hull.size() <= 24);
	CHECK(made.error <= 0.03);
	CHECK(one_sided_distance(outline, made.hull) <= 0.03 * radius_of_area(outline));
}

TEST_CASE("thousands of points close together become few, and a circle of 200 stays round") {
	CHECK(simplified(character_outline(2000)).hull.size() <= 26);
	const SimplifiedOutline circle = simplified(circle_hull(50, 200).value());
	CHECK(circle.hull.size() == 16);
	CHECK(longest_edge(circle.hull) < 2.2 * shortest_edge(circle.hull));
}

TEST_CASE("outlines of few points and outlines without points to spare are left as they are, to the bit") {
	const std::vector<Vec2> usual = circle_hull(50, 16).value();
	const SimplifiedOutline made = simplified(usual);
	CHECK(made.is_outline);
	CHECK(made.hull == usual);
	CHECK(made.error == 0);

	// A star: each of its points is needed.
	std::vector<Vec2> star = circle_hull(50, 40).value();
	for (std::size_t i = 0; i < star.size(); i += 2) {
		star[i] *= Real(0.6);
	}
	const SimplifiedOutline kept = simplified(star);
	CHECK(kept.is_outline);
	CHECK(kept.hull == star);
}

// A ring that is open by a slit much narrower than the tolerance: simplified without care, one lip crosses the other.
TEST_CASE("an outline with a narrow slit is simplified, and its lips do not cross") {
	std::vector<Vec2> ring;
	constexpr int COUNT = 120;
	for (int i = 0; i <= COUNT; ++i) {
		const SineCosine direction = sine_cosine(0.005 + (6.283185307179586 - 0.01) * i / COUNT);
		ring.push_back({ Real(60 * direction.cosine), Real(60 * direction.sine) });
	}
	for (int i = COUNT; i >= 0; --i) {
		const SineCosine direction = sine_cosine(0.0025 + (6.283185307179586 - 0.005) * i / COUNT);
		ring.push_back({ Real(30 * direction.cosine), Real(30 * direction.sine) });
	}
	REQUIRE(!check_hull(ring));
	// Where lips cross, all is done again for a smaller tolerance, which leaves more points.
	for (const auto &[tolerance, most] : { std::pair(0.03, 30), std::pair(0.06, 22), std::pair(0.1, 18), std::pair(0.2, 16) }) {
		CAPTURE(tolerance);
		const SimplifiedOutline made = simplified(ring, { .tolerance = tolerance });
		CHECK(int(made.hull.size()) <= most);
		CHECK(is_simple(made.hull));
		CHECK(made.error <= tolerance);
	}
}

TEST_CASE("points that are too close together go first, though others cost less") {
	std::vector<Vec2> outline = circle_hull(50, 100).value();
	// Small teeth in one place: points 0.4 apart.
	std::vector<Vec2> teeth;
	for (int i = 0; i < 20; ++i) {
		teeth.push_back({ 50 + Real(0.35) * Real(i % 2), Real(-4) + Real(0.2) * Real(i) });
	}
	outline.erase(outline.begin(), outline.begin() + 2);
	outline.pop_back();
	outline.insert(outline.begin(), teeth.begin(), teeth.end());
	REQUIRE(!check_hull(outline));
	const SimplifiedOutline made = simplified(outline, { .most_points = 94 });
	CHECK(shortest_edge(outline) < 0.5);
	CHECK(shortest_edge(made.hull) > 1.2);
}

TEST_CASE("a number of points is kept, whatever the error") {
	const std::vector<Vec2> outline = character_outline(200);
	double last = 1;
	for (const int count : { 8, 12, 16, 24, 40, 80, 150 }) {
		CAPTURE(count);
		SimplifyOptions options;
		options.most_points = count;
		const SimplifiedOutline made = simplified(outline, options);
		CHECK(int(made.hull.size()) <= count);
		CHECK(int(made.hull.size()) >= std::min(count, 12)); // points that are in line are taken out for nothing
		CHECK(signed_area(made.hull) == doctest::Approx(signed_area(outline)).epsilon(1e-5));
		CHECK(made.error <= last + 0.01);
		last = made.error;
	}
}

TEST_CASE("long straight sides keep points at which they can bend") {
	const std::vector<Vec2> box = box_hull({ 400, 100 }, 2).value();
	SimplifyOptions options;
	options.fewest_points = 3;
	const SimplifiedOutline made = simplified(box, options);
	CHECK(made.hull.size() < 20);
	CHECK(longest_edge(made.hull) <= LONGEST_SIMPLE_EDGE * double(perimeter(box)) * 1.0001);
}

TEST_CASE("the hull has the outline's winding, and a mirrored outline the same error") {
	std::vector<Vec2> outline = character_outline(200);
	std::ranges::reverse(outline);
	const SimplifiedOutline made = simplified(outline);
	CHECK(signed_area(made.hull) * signed_area(outline) > 0);
	CHECK(made.error <= 0.03);
	CHECK(made.hull.size() <= 24);
}

TEST_CASE("an outline of twice the size gets a hull of twice the size, to the bit") {
	std::vector<Vec2> outline = character_outline(200);
	const SimplifiedOutline single = simplified(outline);
	for (Vec2 &p : outline) {
		p *= 2;
	}
	const SimplifiedOutline twice = simplified(outline);
	REQUIRE(twice.hull.size() == single.hull.size());
	for (std::size_t i = 0; i < single.hull.size(); ++i) {
		CHECK(twice.hull[i] == single.hull[i] * Real(2));
	}
}

TEST_CASE("simplifying refuses options out of range, by name") {
	const std::vector<Vec2> outline = character_outline(100);
	const auto refusal = [&](const SimplifyOptions &options) {
		const auto made = simplify_outline(outline, options);
		return made ? std::string() : made.error().name;
	};
	CHECK(refusal({ .tolerance = 0 }) == "tolerance");
	CHECK(refusal({ .tolerance = 0.6 }) == "tolerance");
	CHECK(refusal({ .tolerance = NAN }) == "tolerance");
	CHECK(refusal({ .fewest_points = 2 }) == "fewest_points");
	CHECK(refusal({ .most_points = 2 }) == "most_points");
	CHECK(refusal({ .most_points = -1 }) == "most_points");
	CHECK(refusal({ .least_edge = -1 }) == "least_edge");
	CHECK(refusal({}) == "");
}

// In single precision the hull of the character is these bits, by every compiler and on every platform.
TEST_CASE("the hull of a character is the same bits everywhere") {
	const SimplifiedOutline made = simplified(character_outline(200));
	Hash hash;
	for (const Vec2 p : made.hull) {
		hash.add(p);
	}
	if (sizeof(Real) == sizeof(float)) {
		CHECK(hash.value() == 12223139717253832562u);
	}
}

TEST_CASE("where an outline has a weight it is kept that much closer, with edges as much shorter, and elsewhere as before") {
	const std::vector<Vec2> outline = character_outline(200);
	const double radius = radius_of_area(outline);
	SimplifyOptions options;
	const SimplifiedOutline plain = simplify_outline(outline, options).value();
	options.weights.assign(outline.size(), 1.0f);
	const SimplifiedOutline even = simplify_outline(outline, options).value();
	CHECK(even.hull == plain.hull); // to the bit
	// The right half four times as fine.
	for (std::size_t i = 0; i < outline.size(); ++i) {
		options.weights[i] = outline[i].x > 0 ? 4.0f : 1.0f;
	}
	const SimplifiedOutline painted = simplify_outline(outline, options).value();
	const auto count_right = [](const SimplifiedOutline &made) { return std::ranges::count_if(made.hull, [](Vec2 p) { return p.x > 0; }); };
	const auto count_left = [](const SimplifiedOutline &made) { return std::ranges::count_if(made.hull, [](Vec2 p) { return p.x < 0; }); };
	CHECK(count_right(painted) >= 1.5 * double(count_right(plain)));
	CHECK(count_left(painted) <= count_left(plain) + 3);
	CHECK(double(signed_area(painted.hull)) == doctest::Approx(double(signed_area(outline))).epsilon(1e-4));
	CHECK(is_simple(painted.hull));
	double right = 0;
	double left = 0;
	for (const Vec2 p : outline) {
		const double distance = distance_to(Vec2d(p), painted.hull) / radius;
		(p.x > 4 ? right : left) = std::max(p.x > 4 ? right : left, distance);
	}
	CHECK(right < 0.03 / 4 + 1e-4);
	CHECK(left < 0.03 + 1e-4);
	for (std::size_t i = 0; i < painted.hull.size(); ++i) {
		const Vec2 a = painted.hull[i];
		const Vec2 b = painted.hull[(i + 1) % painted.hull.size()];
		if (a.x > 4 && b.x > 4) {
			CHECK(double(length(b - a)) < LONGEST_SIMPLE_EDGE / 4 * double(perimeter(outline)) * 1.01);
		}
	}
}

TEST_CASE("a straight side with a weight gets points to bend at") {
	const std::vector<Vec2> outline = box_hull({ 200, 100 }, 4).value();
	SimplifyOptions options;
	options.weights.assign(outline.size(), 1.0f);
	const auto on_top = [](const SimplifiedOutline &made) { return std::ranges::count_if(made.hull, [](Vec2 p) { return p.y < -40; }); };
	const auto plain = on_top(simplify_outline(outline, options).value());
	for (std::size_t i = 0; i < outline.size(); ++i) {
		options.weights[i] = outline[i].y < -49 ? 4.0f : 1.0f;
	}
	CHECK(on_top(simplify_outline(outline, options).value()) >= 2 * plain);
}

TEST_CASE("weights out of range, and of another number than points, are refused by name") {
	const std::vector<Vec2> outline = circle_hull(50, 40).value();
	SimplifyOptions options;
	options.weights.assign(39, 1.0f);
	CHECK(simplify_outline(outline, options).error().name == "weights");
	options.weights.assign(40, 1.0f);
	options.weights[7] = 0.01f;
	CHECK(simplify_outline(outline, options).error().name == "weights[7]");
	options.weights[7] = std::numeric_limits<float>::quiet_NaN();
	CHECK(simplify_outline(outline, options).error().name == "weights[7]");
	options.weights[7] = 11;
	CHECK(check_detail_weights("detail_weights", options.weights)->name == "detail_weights[7]");
}
