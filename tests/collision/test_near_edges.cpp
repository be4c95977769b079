// SPDX-License-Identifier: MIT
// Points and edges near a box, and the nearest of these edges, against plain loops.
#include "core/collision/near_edges.h"
#include "support/random.h"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A hull that may have dents. A star about a center is simple.
std::vector<Vec2> star(Random &random, int points) {
	std::vector<Vec2> hull;
	for (int i = 0; i < points; ++i) {
		hull.push_back(Rotation::from_angle(Real(6.283185307179586 * i / points)).apply({ random.real(0.4, 1), 0 }));
	}
	return hull;
}

double distance_to_edge(Vec2 p, Vec2 a, Vec2 b) {
	const double x = double(b.x) - double(a.x);
	const double y = double(b.y) - double(a.y);
	const double size = x * x + y * y;
	double t = size > 0 ? ((double(p.x) - double(a.x)) * x + (double(p.y) - double(a.y)) * y) / size : 0;
	t = std::min(std::max(t, 0.0), 1.0);
	return std::hypot(double(p.x) - double(a.x) - t * x, double(p.y) - double(a.y) - t * y);
}

} // namespace

TEST_CASE("points in a box are those that a plain loop finds, for every number of points and from any of them on") {
	Random random(61);
	int inside = 0;
	for (int round = 0; round < 2000; ++round) {
		std::vector<Vec2> points(std::size_t(random.integer(1, 70)));
		for (Vec2 &p : points) {
			p = random.vector(1);
		}
		const Aabb box = Aabb::between(random.vector(1), random.vector(1));
		const std::uint32_t first = std::uint32_t(random.integer(0, int(points.size()) - 1));
		const std::uint32_t mask = points_in(box, points, first);
		for (std::uint32_t i = 0; i < POINT_BITS; ++i) {
			bool is_in = false;
			if (first + i < points.size()) {
				const Vec2 p = points[first + i];
				is_in = p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y;
			}
			inside += is_in;
			CHECK((mask >> i & 1) == std::uint32_t(is_in));
		}
	}
	CHECK(inside > 1000);
}

TEST_CASE("of the edges near a box, the nearest to a point is the nearest of all edges, unless that is farther than the box reaches") {
	Random random(62);
	NearEdges edges; // keeps its memory
	int found = 0;
	int none = 0;
	for (int round = 0; round < 3000; ++round) {
		const std::vector<Vec2> hull = star(random, random.integer(3, 45));
		const Aabb body = Aabb::between(random.vector(1.2), random.vector(1.2));
		const Real margin = random.real(0.01, 0.3);
		edges.assign(hull, body.grown(margin));
		std::array<Vec2, PACK_WIDTH> points;
		BasicVec2<RealPack> pack;
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			points[lane] = { random.real(double(body.min.x), double(body.max.x)), random.real(double(body.min.y), double(body.max.y)) };
			set_lane(pack, lane, points[lane]);
		}
		const NearestEdge nearest = edges.find(pack);
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			double least = std::numeric_limits<double>::max();
			for (std::size_t i = 0; i < hull.size(); ++i) {
				least = std::min(least, distance_to_edge(points[lane], hull[i], hull[(i + 1) % hull.size()]));
			}
			const double distance = std::sqrt(double(nearest.distance[lane]));
			if (least < double(margin) * (1 - 1e-5)) {
				++found;
				const std::size_t edge = std::size_t(nearest.edge[lane]);
				REQUIRE(edge < hull.size());
				CHECK(std::abs(distance - least) <= 1e-5);
				CHECK(std::abs(distance_to_edge(points[lane], hull[edge], hull[(edge + 1) % hull.size()]) - least) <= 1e-5);
			} else {
				++none;
				CHECK(distance >= double(margin) * (1 - 1e-5));
			}
		}
	}
	CHECK(found > 2000);
	CHECK(none > 2000);
}

TEST_CASE("an edge of length 0 is as far as its point, and a point that is NaN is near no edge") {
	const std::vector<Vec2> hull = { { 0, 0 }, { 2, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } };
	NearEdges edges;
	edges.assign(hull, { { -10, -10 }, { 10, 10 } });
	BasicVec2<RealPack> p = in_all_lanes<RealPack>({ 3, -1 });
	set_lane(p, 1, { std::numeric_limits<Real>::quiet_NaN(), 0 });
	const NearestEdge nearest = edges.find(p);
	CHECK(double(nearest.distance[0]) == doctest::Approx(2));
	CHECK(nearest.distance[1] == std::numeric_limits<Real>::max());
	edges.assign(hull, { { 5, 5 }, { 6, 6 } });
	CHECK(edges.find(p).distance[0] == std::numeric_limits<Real>::max());
}
