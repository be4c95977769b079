// SPDX-License-Identifier: MIT
// Claims about the distance of convex sets, against all pairs of segments and triangles on a small integer grid.
#include "thesis/gjk.h"
#include "geometry/integer_geometry.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

using GridSet = std::vector<GridPoint>;

bool grid_in_hull(GridPoint p, const GridSet &set) {
	for (const GridPoint a : set) {
		for (const GridPoint b : set) {
			if (grid_on_segment(p, a, b)) {
				return true;
			}
			for (const GridPoint c : set) {
				const long whole = std::labs(grid_double_area({ a, b, c }));
				const long parts = std::labs(grid_double_area({ p, b, c })) + std::labs(grid_double_area({ a, p, c })) +
						std::labs(grid_double_area({ a, b, p }));
				if (whole != 0 && parts == whole) {
					return true;
				}
			}
		}
	}
	return false;
}

// Hulls share a point when one contains a point of the other or when two of their segments meet.
bool grid_hulls_overlap(const GridSet &a, const GridSet &b) {
	for (const GridPoint p : a) {
		if (grid_in_hull(p, b)) {
			return true;
		}
	}
	for (const GridPoint p : b) {
		if (grid_in_hull(p, a)) {
			return true;
		}
	}
	for (std::size_t i = 0; i < a.size(); ++i) {
		for (std::size_t j = 0; j < b.size(); ++j) {
			for (std::size_t k = 0; k < i; ++k) {
				for (std::size_t m = 0; m < j; ++m) {
					if (grid_intersection(a[i], a[k], b[j], b[m])) {
						return true;
					}
				}
			}
		}
	}
	return false;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
	const double x = double(b.x) - a.x;
	const double y = double(b.y) - a.y;
	const double size = x * x + y * y;
	const double t = size > 0 ? std::clamp(((double(p.x) - a.x) * x + (double(p.y) - a.y) * y) / size, 0.0, 1.0) : 0;
	return std::hypot(p.x - (a.x + t * x), p.y - (a.y + t * y));
}

// Of hulls that are apart: the least distance of a point of one from any segment of the other.
double distance_of_hulls(const std::vector<Vec2> &a, const std::vector<Vec2> &b) {
	double least = std::numeric_limits<double>::max();
	for (const Vec2 p : a) {
		for (const Vec2 q : b) {
			for (const Vec2 r : b) {
				least = std::fmin(least, distance_to_segment(p, q, r));
			}
			for (const Vec2 r : a) {
				least = std::fmin(least, distance_to_segment(q, p, r));
			}
		}
	}
	return least;
}

// How far the sets are apart along an axis; negative when they are not.
double gap_along(Vec2 axis, const std::vector<Vec2> &a, const std::vector<Vec2> &b) {
	double most = -std::numeric_limits<double>::max();
	double least = std::numeric_limits<double>::max();
	for (const Vec2 p : a) {
		most = std::fmax(most, double(axis.x) * p.x + double(axis.y) * p.y);
	}
	for (const Vec2 p : b) {
		least = std::fmin(least, double(axis.x) * p.x + double(axis.y) * p.y);
	}
	return least - most;
}

std::vector<Vec2> circle(Vec2 center, double radius, int count) {
	std::vector<Vec2> points;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		points.push_back({ Real(center.x + radius * std::cos(angle)), Real(center.y + radius * std::sin(angle)) });
	}
	return points;
}

// Points, segments, and sets of up to eight points, spread over a strip of the grid.
GridSet random_set(Random &random, int least_x, int most_x) {
	GridSet set;
	for (int k = random.integer(1, 8); k > 0; --k) {
		set.push_back({ random.integer(least_x, most_x), random.integer(0, 6) });
	}
	if (random.chance(0.1)) {
		for (GridPoint &p : set) {
			p.y = p.x; // in line
		}
	}
	return set;
}

} // namespace

TEST_CASE("sets overlap, touch and are apart as all their segments and triangles say" * doctest::test_suite("slow")) {
	Random random(41);
	int wrong = 0;
	int overlapping = 0;
	int apart = 0;
	int bad_normals = 0;
	int bad_filters = 0;
	int most_iterations = 0;
	double worst_distance = 0;
	double worst_place = 0;
	for (int i = 0; i < 20000; ++i) {
		const int shift = random.integer(0, 6);
		const GridSet ga = random_set(random, 0, 5);
		const GridSet gb = random_set(random, shift, shift + 5);
		const std::vector<Vec2> a = to_real(ga);
		const std::vector<Vec2> b = to_real(gb);
		const Vec2 first = random.chance(0.5) ? Vec2{} : random.vector(3);
		const GjkResult found = gjk(a, b, first);
		const bool expected = grid_hulls_overlap(ga, gb);
		wrong += found.overlap != expected;
		most_iterations = std::max(most_iterations, found.iterations);
		Vec2 axis = first;
		if (expected) {
			overlapping++;
			bad_filters += is_apart(a, b, 0, &axis) || is_apart(a, b, 1);
			wrong += found.distance != 0;
			continue;
		}
		apart++;
		const double exact = distance_of_hulls(a, b);
		worst_distance = std::fmax(worst_distance, std::abs(double(found.distance) - exact));
		worst_place = std::fmax(worst_place, std::abs(distance(found.closest_a, found.closest_b) - exact));
		// A unit axis, from A to B, along which the whole distance is seen.
		bad_normals += std::abs(gap_along(found.normal, a, b) - exact) > 30 * EPSILON + 1e-11; // ends at 1e-12
		bad_normals += std::abs(std::hypot(double(found.normal.x), double(found.normal.y)) - 1) > 2 * EPSILON;
		bad_filters += !is_apart(a, b, 0, &axis) || !is_apart(a, b, Real(exact * 0.999), &axis);
		bad_filters += is_apart(a, b, Real(exact * 1.001)) || is_apart(a, b, Real(exact * 1.001), &axis);
		bad_filters += std::abs(std::hypot(double(axis.x), double(axis.y)) - 1) > 2 * EPSILON;
	}
	CHECK(wrong == 0);
	CHECK(bad_normals == 0);
	CHECK(bad_filters == 0);
	CHECK(worst_distance <= 8 * EPSILON); // lengths below 13, one rounding to Real
	CHECK(worst_place <= 32 * EPSILON); // two places, each rounded
	CHECK(overlapping > 5000);
	CHECK(apart > 3000);
	CHECK(most_iterations <= 10);
}

TEST_CASE("the closest points lie in their sets") {
	Random random(42);
	for (int i = 0; i < 500; ++i) {
		const Vec2 at = i % 2 ? random.vector(1000) : Vec2{};
		const auto a = circle(at + random.vector(1), random.real(0, 2), random.integer(1, 20));
		const auto b = circle(at + random.vector(5), random.real(0, 2), random.integer(1, 20));
		const GjkResult found = gjk(a, b);
		if (found.overlap) {
			continue;
		}
		const double tolerance = 16 * EPSILON * (double(length(at)) + 10);
		for (const std::vector<Vec2> *set : { &a, &b }) {
			const Vec2 p = set == &a ? found.closest_a : found.closest_b;
			double least = std::numeric_limits<double>::max();
			for (const Vec2 q : *set) {
				for (const Vec2 r : *set) {
					least = std::fmin(least, distance_to_segment(p, q, r));
				}
			}
			CHECK(least <= tolerance); // closest points of sets that are apart lie on an edge
		}
	}
}

TEST_CASE("swapping the sets turns the normal round") {
	const std::vector<Vec2> a{ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } };
	const std::vector<Vec2> b{ { 5, 1 }, { 7, 0 }, { 7, 2 } };
	const GjkResult forth = gjk(a, b);
	const GjkResult back = gjk(b, a);
	CHECK(forth.distance == 3);
	CHECK(forth.normal == Vec2{ 1, 0 });
	CHECK(forth.closest_a == Vec2{ 2, 1 });
	CHECK(forth.closest_b == Vec2{ 5, 1 });
	CHECK(back.normal == Vec2{ -1, 0 });
	CHECK(back.closest_a == forth.closest_b);
}

TEST_CASE("circles of many points are as far apart as they should be, in few rounds") {
	Random random(43);
	int most_iterations = 0;
	for (int i = 0; i < 50; ++i) {
		const double gap = std::pow(10.0, double(random.real(-3, 1)));
		const double angle = random.real(0, 6.28);
		const auto a = circle({ 0, 0 }, 1, 4096);
		const auto b = circle({ Real((2 + gap) * std::cos(angle)), Real((2 + gap) * std::sin(angle)) }, 1, 4096);
		const GjkResult found = gjk(a, b);
		CHECK_FALSE(found.overlap);
		// The circles bulge by up to 3e-7 over their chords.
		CHECK(std::abs(double(found.distance) - gap) <= 7e-7 + 16 * EPSILON);
		most_iterations = std::max(most_iterations, found.iterations);
	}
	CHECK(most_iterations <= 24);
}

TEST_CASE("when the rounds run out, sets are apart only if an axis shows it, and never by too much") {
	Random random(44);
	int undecided = 0;
	int decided = 0;
	for (int i = 0; i < 3000; ++i) {
		const auto a = circle(random.vector(1), 1, random.integer(1, 30));
		const auto b = circle(random.vector(4), 1, random.integer(1, 30));
		const GjkResult exact = gjk(a, b);
		for (int rounds = 0; rounds <= 4; ++rounds) {
			const GjkResult cut_short = gjk(a, b, random.vector(1), rounds);
			CHECK(cut_short.iterations <= rounds);
			CHECK(cut_short.distance <= exact.distance + 8 * Real(EPSILON));
			CHECK((cut_short.overlap || gap_along(cut_short.normal, a, b) > 0));
			undecided += cut_short.overlap && !exact.overlap;
			decided += !cut_short.overlap && cut_short.distance < exact.distance * Real(0.99);
		}
	}
	CHECK(undecided > 1000);
	CHECK(decided > 1000); // an axis that separates is enough, the closest points need not be known
}

TEST_CASE("the filter never calls sets apart that overlap by a hair, wherever they are") {
	Random random(45);
	int lost = 0;
	int kept = 0;
	for (int i = 0; i < 20000; ++i) {
		// The second set has a corner on the border of the first, and then moves in or out by some roundings.
		const Vec2 far = random.vector(i % 3 == 0 ? 0 : 1000);
		const int count = random.integer(2, 12);
		auto a = circle(far, 1, count);
		const int edge = random.integer(0, count - 1);
		const Vec2 from = a[std::size_t(edge)];
		const Vec2 to = a[std::size_t((edge + 1) % count)];
		const Vec2 place = from + (to - from) * random.real(0, 1);
		const Vec2 out = place - far;
		const double hair = random.real(-1, 1) * 1e-2;
		const std::vector<Vec2> b{ place + out * Real(hair), place + out * 2 + random.vector(0.5) };
		// Twin for a point and its hull: out of the hull when beyond any of its edge lines.
		double beyond = -std::numeric_limits<double>::max();
		for (int k = 0; k < count; ++k) {
			const Vec2 p = a[std::size_t(k)];
			const Vec2 q = a[std::size_t((k + 1) % count)];
			const double side = (double(q.x) - p.x) * (double(b[0].y) - p.y) - (double(q.y) - p.y) * (double(b[0].x) - p.x);
			beyond = std::fmax(beyond, -side);
		}
		if (count > 2 && beyond < -1e-9) {
			kept++;
			lost += is_apart(a, b, 0) || !gjk(a, b).overlap;
		}
	}
	CHECK(lost == 0);
	CHECK(kept > 5000);
}

TEST_CASE("few rounds are enough, also for sets that share corners and edges, far from the origin too") {
	Random random(46);
	int most_iterations = 0;
	int lost = 0;
	double sum = 0;
	const int cases = 50000;
	for (int i = 0; i < cases; ++i) {
		const Vec2 far = random.vector(i % 3 ? 1000 : 1);
		const auto a = circle(far, 1, random.integer(1, 12));
		auto b = circle(far + random.vector(2.5), random.real(0.1, 2), random.integer(1, 12));
		if (i % 2) {
			b[0] = a[0];
			b[b.size() / 2] = a[a.size() / 2];
		}
		const GjkResult found = gjk(a, b);
		lost += i % 2 && !found.overlap;
		most_iterations = std::max(most_iterations, found.iterations);
		sum += found.iterations;
	}
	CHECK(lost == 0);
	CHECK(most_iterations <= 10);
	CHECK(sum / cases <= 4);
}

TEST_CASE("sets nearer than 1e-12 of the differences looked at touch") {
	const std::vector<Vec2> a{ { 0, 0 }, { 0, 1 } };
	const auto at = [](double x) { return std::vector<Vec2>{ { Real(x), 1 }, { Real(x), 0 } }; };
	CHECK(gjk(a, at(1e-13)).overlap);
	CHECK_FALSE(is_apart(a, at(1e-13), 0));
	CHECK_FALSE(gjk(a, at(1e-11)).overlap);
	CHECK(is_apart(a, at(1e-11), 0));
}

TEST_CASE("points, segments, coincident points and empty sets") {
	const std::vector<Vec2> point{ { 3, 4 } };
	const std::vector<Vec2> origin{ { 0, 0 }, { 0, 0 }, { 0, 0 } };
	const std::vector<Vec2> segment{ { -1, 0 }, { 1, 0 } };
	CHECK(gjk(origin, point).distance == 5);
	CHECK(gjk(point, point).overlap);
	CHECK(gjk(segment, origin).overlap);
	CHECK(gjk(segment, segment).overlap);
	CHECK(gjk(segment, std::vector<Vec2>{ { 0, -1 }, { 0, 1 } }).overlap);
	CHECK(gjk(segment, std::vector<Vec2>{ { 1, 0 }, { 2, 3 } }).overlap); // share an end
	CHECK(gjk(segment, std::vector<Vec2>{ { 2, 0 }, { 5, 0 } }).distance == 1); // in line
	CHECK(gjk(segment, std::vector<Vec2>{ { -3, 2 }, { 5, 2 } }).distance == 2); // parallel
	CHECK(std::isinf(gjk(segment, {}).distance));
	CHECK_FALSE(gjk({}, segment).overlap);
	CHECK(is_apart({}, segment, 7));
	CHECK_FALSE(is_apart(segment, origin, 0));
	Vec2 axis;
	CHECK_FALSE(is_apart(point, point, 0, &axis)); // nothing says where to look
	CHECK(std::abs(double(length(axis)) - 1) <= 2 * EPSILON);
}
