// SPDX-License-Identifier: MIT
// Claims about filling outlines with triangles, judged by areas, winding numbers and circles of their own.
#include "core/skin/triangulation.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace softbody;
using namespace softbody::testing;

namespace {

double double_area(Vec2 a, Vec2 b, Vec2 c) {
	return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(c.x) - a.x) * (double(b.y) - a.y);
}

// A comb of deep teeth: most of its triangles are forced by the hull.
std::vector<Vec2> comb(int teeth) {
	std::vector<Vec2> hull;
	for (int i = 0; i < teeth; ++i) {
		hull.push_back({ Real(20 * i), 0 });
		hull.push_back({ Real(20 * i + 6), Real(90) });
		hull.push_back({ Real(20 * i + 12), Real(4) });
	}
	hull.push_back({ Real(20 * teeth), -30 });
	hull.push_back({ -10, -30 });
	return hull;
}

std::vector<Vec2> spiral(int count) {
	std::vector<Vec2> hull;
	for (const double width : { 0.0, 12.0 }) {
		for (int i = 0; i < count; ++i) {
			const int k = width > 0 ? count - 1 - i : i;
			const double angle = 0.35 * k;
			const double radius = 30 + 6 * angle + width;
			hull.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
		}
	}
	return hull;
}

// A star of random reach: simple, dented at random.
std::vector<Vec2> random_star(Random &random, int count) {
	std::vector<Vec2> hull;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		const Real reach = random.real(Real(15), Real(100));
		hull.push_back({ Real(reach * std::cos(angle)), Real(reach * std::sin(angle)) });
	}
	return hull;
}

std::vector<std::vector<Vec2>> outlines() {
	Random random(11);
	std::vector<std::vector<Vec2>> all{ comb(5), spiral(20), box_hull({ 160, 100 }, 20).value(),
		circle_hull(50, 16).value(), { { 0, 0 }, { 10, 0 }, { 0, 10 } } };
	for (int i = 0; i < 40; ++i) {
		all.push_back(random_star(random, 5 + i));
	}
	for (std::size_t i = 0, count = all.size(); i < count; ++i) {
		all.push_back(all[i]);
		std::ranges::reverse(all.back());
	}
	return all;
}

void check_fills(const std::vector<Vec2> &points, std::size_t hull_count, const std::vector<Triangle> &triangles) {
	double sum = 0;
	std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
	for (const Triangle &t : triangles) {
		const double twice = double_area(points[t[0]], points[t[1]], points[t[2]]);
		CHECK(twice > 0);
		sum += twice / 2;
		for (std::size_t k = 0; k < 3; ++k) {
			edges[std::minmax(t[k], t[(k + 1) % 3])]++;
		}
	}
	const std::vector<Vec2> hull(points.begin(), points.begin() + std::ptrdiff_t(hull_count));
	CHECK(sum == doctest::Approx(std::abs(signed_area(hull))).epsilon(1e-5));
	for (const auto &[edge, uses] : edges) {
		const bool on_hull = edge.second < hull_count &&
				(edge.second == edge.first + 1 || (edge.first == 0 && edge.second == hull_count - 1));
		CHECK(uses == (on_hull ? 1 : 2));
	}
	for (std::uint32_t i = 0; i < hull_count; ++i) {
		const std::uint32_t next = (i + 1) % std::uint32_t(hull_count);
		CHECK(edges.contains(std::minmax(i, next)));
	}
}

std::vector<Vec2> with_inner_points(Random &random, const std::vector<Vec2> &hull, int count) {
	std::vector<Vec2> points = hull;
	while (points.size() < hull.size() + std::size_t(count)) {
		const Vec2 p{ random.real(Real(-120), Real(120)), random.real(Real(-120), Real(120)) };
		if (point_in_polygon(p, hull)) {
			points.push_back(p);
		}
	}
	return points;
}

// How often the closed line goes around the place, by summing angles.
double winding(Vec2 place, const std::vector<Vec2> &line) {
	double sum = 0;
	for (std::size_t i = 0; i < line.size(); ++i) {
		const Vec2 a = line[i] - place;
		const Vec2 b = line[(i + 1) % line.size()] - place;
		sum += std::atan2(double(a.x) * b.y - double(a.y) * b.x, double(a.x) * b.x + double(a.y) * b.y);
	}
	return sum / (2 * std::numbers::pi);
}

} // namespace

TEST_CASE("the triangles of any outline are its area, once, and keep its edges") {
	for (const std::vector<Vec2> &hull : outlines()) {
		CAPTURE(hull.size());
		check_fills(hull, hull.size(), triangulate(hull, hull.size()));
	}
}

TEST_CASE("points inside become corners of triangles") {
	Random random(5);
	for (const std::vector<Vec2> &hull : outlines()) {
		const std::vector<Vec2> points = with_inner_points(random, hull, 7);
		const std::vector<Triangle> triangles = triangulate(points, hull.size());
		CAPTURE(hull.size());
		check_fills(points, hull.size(), triangles);
		std::set<std::uint32_t> corners;
		for (const Triangle &t : triangles) {
			corners.insert(t.begin(), t.end());
		}
		CHECK(corners.size() == points.size());
		CHECK(triangles.size() == hull.size() - 2 + 2 * 7); // Euler
	}
}

TEST_CASE("points outside, and on top of another, are left out") {
	std::vector<Vec2> points = comb(3);
	const std::size_t hull_count = points.size();
	points.push_back({ 9, 80 }); // between two teeth
	points.push_back(points[4]);
	points.push_back({ 10, -10 });
	points.push_back({ 10, -10 });
	const std::vector<Triangle> triangles = triangulate(points, hull_count);
	check_fills(points, hull_count, triangles);
	CHECK(triangles.size() == hull_count - 2 + 2);
}

TEST_CASE("a point exactly on an edge between two triangles leaves no flat one") {
	const std::vector<Vec2> points{ { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 }, { 5, 5 }, { 2, 2 } };
	const std::vector<Triangle> triangles = triangulate(points, 4);
	check_fills(points, 4, triangles);
	CHECK(triangles.size() == 6);
}

TEST_CASE("no circle through a triangle holds the far corner of its neighbor, unless the hull forces it") {
	Random random(21);
	for (const std::vector<Vec2> &hull : outlines()) {
		const std::vector<Vec2> points = with_inner_points(random, hull, 12);
		const std::vector<Triangle> triangles = triangulate(points, hull.size());
		for (const Triangle &t : triangles) {
			for (const Triangle &other : triangles) {
				int shared = 0;
				std::uint32_t far_corner = 0;
				for (const std::uint32_t corner : other) {
					const bool is_shared = std::ranges::find(t, corner) != t.end();
					shared += is_shared;
					far_corner = is_shared ? far_corner : corner;
				}
				if (shared != 2) {
					continue;
				}
				// Center of the circle from the two bisectors.
				const Vec2 a = points[t[0]];
				const double bx = double(points[t[1]].x) - a.x;
				const double by = double(points[t[1]].y) - a.y;
				const double cx = double(points[t[2]].x) - a.x;
				const double cy = double(points[t[2]].y) - a.y;
				const double d = 2 * (bx * cy - by * cx);
				const double ux = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d;
				const double uy = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
				const double radius = std::hypot(ux, uy);
				const double reach = std::hypot(points[far_corner].x - a.x - ux, points[far_corner].y - a.y - uy);
				CHECK(reach > radius * (1 - 1e-4));
			}
		}
	}
}

TEST_CASE("however the points move, every place that the hull winds around is covered that often") {
	Random random(8);
	int places_inside = 0;
	for (const std::vector<Vec2> &hull : outlines()) {
		std::vector<Vec2> points = with_inner_points(random, hull, 4);
		const std::vector<Triangle> triangles = triangulate(points, hull.size());
		const double sense = signed_area(hull) < 0 ? -1 : 1;
		for (Vec2 &p : points) {
			p += { random.real(Real(-60), Real(60)), random.real(Real(-60), Real(60)) };
		}
		const std::vector<Vec2> moved(points.begin(), points.begin() + std::ptrdiff_t(hull.size()));
		for (int i = 0; i < 30; ++i) {
			const Vec2 place{ random.real(Real(-100), Real(100)), random.real(Real(-100), Real(100)) };
			int covered = 0;
			for (const Triangle &t : triangles) {
				covered += int(std::lround(winding(place, { points[t[0]], points[t[1]], points[t[2]] })));
			}
			const int around = int(std::lround(sense * winding(place, moved)));
			CHECK(covered == around);
			places_inside += around != 0;
		}
	}
	CHECK(places_inside > 300);
}
