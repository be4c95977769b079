// SPDX-License-Identifier: MIT
// Claims about the mesh that fills a body.
#include "core/skin/fill_mesh.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace softbody;
using softbody::testing::Random;

namespace {

struct Placed {
	std::vector<Vec2> rim;
	std::vector<Vec2> vertices;
};

Placed placed(const FillMesh &mesh, const std::vector<Vec2> &points) {
	Placed result{ std::vector<Vec2>(mesh.rim_count()), std::vector<Vec2>(mesh.vertex_count()) };
	mesh.place_rim(points, result.rim);
	mesh.place(points, result.rim, result.vertices);
	return result;
}

double area_of(const FillMesh &mesh, const std::vector<Vec2> &vertices) {
	double sum = 0;
	for (const Triangle &t : mesh.triangles()) {
		sum += std::abs(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]])) / 2;
	}
	return sum;
}

const std::vector<Vec2> U_SHAPE{ { -90, -60 }, { -50, -60 }, { -40, 30 }, { 40, 30 }, { 50, -60 }, { 90, -60 },
	{ 90, 80 }, { -90, 80 } };

std::vector<std::vector<Vec2>> bodies() {
	std::vector<std::vector<Vec2>> all{ circle_hull(50, 16).value(), box_hull({ 160, 100 }, 20).value(), U_SHAPE,
		{ { 0, 0 }, { 30, 5 }, { 10, 40 } } };
	for (std::size_t i = 0, count = all.size(); i < count; ++i) {
		all.push_back(all[i]);
		std::ranges::reverse(all.back());
	}
	return all;
}

} // namespace

TEST_CASE("the triangles fill what the rim encloses, straight or curved, with a middle point or without") {
	for (const std::vector<Vec2> &hull : bodies()) {
		for (const std::size_t pieces : { std::size_t(1), std::size_t(4) }) {
			for (const int inner : { 0, 1, 2 }) {
				std::vector<Vec2> points = hull;
				for (int i = 0; i < inner; ++i) {
					points.push_back({ Real(12 + 3 * i), Real(10) });
				}
				const FillMesh mesh(points, hull.size(), { pieces, 0 });
				const Placed result = placed(mesh, points);
				CAPTURE(hull.size());
				CAPTURE(pieces);
				CAPTURE(inner);
				CHECK(area_of(mesh, result.vertices) == doctest::Approx(std::abs(signed_area(result.rim))).epsilon(1e-4));
			}
		}
	}
}

TEST_CASE("a band follows the edge at its width inside, and takes the values of the rim") {
	for (const std::vector<Vec2> &hull : bodies()) {
		const Real band = 5;
		const FillMesh mesh(hull, hull.size(), { .pieces = 1, .soft_edge = 1, .band = band });
		const Placed result = placed(mesh, hull);
		const std::size_t rim = mesh.rim_count();
		REQUIRE(mesh.faded_start() == mesh.band_start() + rim);
		REQUIRE(mesh.vertex_count() == mesh.faded_start() + rim);
		for (std::size_t i = 0; i < rim; ++i) {
			const std::size_t next = (i + 1) % rim;
			const Vec2 edge = (hull[next] - hull[i]) * (1 / length(hull[next] - hull[i]));
			// Distance from the line of the edge, into the polygon.
			const auto depth = [&](std::size_t vertex) { return cross(edge, result.vertices[vertex] - hull[i]) * mesh.side(); };
			CHECK(depth(i) == doctest::Approx(band).epsilon(0.01));
			CHECK(depth(next) == doctest::Approx(band).epsilon(0.01));
			CHECK(depth(mesh.band_start() + i) == doctest::Approx(0.5).epsilon(0.01));
			CHECK(depth(mesh.faded_start() + i) == doctest::Approx(-0.5).epsilon(0.01));
		}
		// Nothing is left out and nothing is covered twice: the triangles have the area inside of the outermost line.
		const std::vector<Vec2> outermost(result.vertices.begin() + std::ptrdiff_t(mesh.faded_start()), result.vertices.end());
		CHECK(area_of(mesh, result.vertices) == doctest::Approx(std::abs(signed_area(outermost))).epsilon(1e-3));
		std::vector<Real> values;
		for (std::size_t i = 0; i < hull.size(); ++i) {
			values.push_back(Real(i));
		}
		const std::vector<Real> spread = mesh.spread<Real>(values);
		for (std::size_t i = 0; i < rim; ++i) {
			CHECK(spread[mesh.band_start() + i] == Real(i));
			CHECK(spread[mesh.faded_start() + i] == Real(i));
		}
	}
}

TEST_CASE("a strip that is bent to an arc is filled inside of its outline alone") {
	// 40 long by 280, bent about a circle of 200: its middle, left where it was, lies outside of it.
	const std::vector<Vec2> strip = box_hull({ 40, 280 }, 20).value();
	for (const bool has_center : { false, true }) {
		std::vector<Vec2> points = strip;
		std::vector<Vec2> bent;
		if (has_center) {
			points.push_back({ 0, 0 });
		}
		for (const Vec2 p : points) {
			const Real radius = 200 + p.x;
			bent.push_back({ radius * std::cos(p.y / 200) - 200, radius * std::sin(p.y / 200) });
		}
		if (has_center) {
			bent.back().x -= 30; // it hangs behind
		}
		const FillMesh mesh(points, strip.size(), {});
		const Placed result = placed(mesh, bent);
		CHECK(area_of(mesh, result.vertices) == doctest::Approx(std::abs(signed_area(result.rim))).epsilon(0.01));
	}
}

TEST_CASE("the curve goes through the hull points and is rounder than the hull") {
	const std::vector<Vec2> circle = circle_hull(50, 12).value();
	const FillMesh mesh(circle, circle.size(), { 8, 0 });
	const Placed result = placed(mesh, circle);
	for (std::size_t i = 0; i < circle.size(); ++i) {
		CHECK(length(result.rim[8 * i] - circle[i]) < 1e-4);
	}
	for (const Vec2 p : result.rim) {
		CHECK(length(p) == doctest::Approx(50).epsilon(0.005)); // the edges of the hull come as near as 48.3
	}
}

TEST_CASE("vertices take their place from the points: hull, then inner ones, then the mean") {
	const std::vector<Vec2> hull = circle_hull(50, 8).value();
	std::vector<Vec2> moved = hull;
	moved[3] += { 7, -4 };
	const Placed ring = placed(FillMesh(hull, 8, {}), moved);
	CHECK(length(ring.vertices[3] - moved[3]) == 0);
	CHECK(length(ring.vertices[8] - Vec2{ Real(7) / 8, Real(-4) / 8 }) < 1e-4);
	std::vector<Vec2> with_center = hull;
	with_center.push_back({ 1, 2 });
	const Placed centered = placed(FillMesh(with_center, 8, {}), with_center);
	CHECK(centered.vertices.size() == 9);
	CHECK(length(centered.vertices[8] - Vec2{ 1, 2 }) == 0);
}

TEST_CASE("a soft edge covers half a pixel more and fades as much inside") {
	for (const std::vector<Vec2> &hull : bodies()) {
		const FillMesh hard(hull, hull.size(), {});
		const FillMesh soft(hull, hull.size(), { 1, 1 });
		const Placed result = placed(soft, hull);
		const double rim = perimeter(hull);
		CHECK(area_of(soft, result.vertices) - area_of(hard, placed(hard, hull).vertices) ==
				doctest::Approx(rim / 2).epsilon(0.05));
		for (std::size_t i = soft.faded_start(); i < soft.vertex_count(); ++i) {
			CHECK(!point_in_polygon(result.vertices[i], hull));
			CHECK(length(result.vertices[i] - hull[i - soft.faded_start()]) <= 2.01);
			CHECK(point_in_polygon(result.vertices[i - soft.faded_start()], hull));
		}
	}
}

TEST_CASE("values that are linear in the plane come back linear at every vertex") {
	for (const std::vector<Vec2> &hull : bodies()) {
		std::vector<Vec2> points = hull;
		points.push_back({ 14, 12 });
		points.push_back({ 16, 20 });
		const FillMesh mesh(points, hull.size(), {});
		const auto f = [](Vec2 p) { return 3 + p.x / 2 - 2 * p.y; };
		std::vector<Real> values;
		for (const Vec2 p : hull) {
			values.push_back(f(p));
		}
		const std::vector<Real> spread = mesh.spread<Real>(values);
		const Placed result = placed(mesh, points);
		for (std::size_t i = 0; i < spread.size(); ++i) {
			if (point_in_polygon(result.vertices[i], hull)) {
				CHECK(spread[i] == doctest::Approx(f(result.vertices[i])).epsilon(1e-3));
			}
		}
	}
}

TEST_CASE("equal values stay equal, on a rim, on an edge and in the middle") {
	std::vector<Vec2> points = box_hull({ 100, 60 }, 20).value();
	const std::size_t hull_count = points.size();
	points.push_back((points[0] + points[1]) * Real(0.5));
	points.push_back(points[2]);
	points.push_back({ 0, 0 });
	const FillMesh mesh(points, hull_count, { 3, 1 });
	for (const Real value : mesh.spread<Real>(std::vector<Real>(hull_count, Real(0.25)))) {
		CHECK(value == doctest::Approx(0.25));
	}
}

TEST_CASE("an inset ends the triangles that far inside the rim") {
	for (const std::vector<Vec2> &hull : bodies()) {
		const FillMesh whole(hull, hull.size(), {});
		const FillMesh inset(hull, hull.size(), { 1, 0, 1 });
		CHECK(inset.vertex_count() == whole.vertex_count());
		const double less = area_of(whole, placed(whole, hull).vertices) - area_of(inset, placed(inset, hull).vertices);
		CHECK(less == doctest::Approx(perimeter(hull)).epsilon(0.1));
	}
}

TEST_CASE("a mesh knows the points and options that it was made of, as bodies that share it are told by that") {
	const std::vector<Vec2> hull = circle_hull(50, 16).value();
	const FillMesh::Options options{ 4, 1, 0 };
	const FillMesh mesh(hull, hull.size(), options);
	CHECK(mesh.is_made_of(hull, hull.size(), options));
	std::vector<Vec2> moved = hull;
	moved[7].y += Real(0.01);
	CHECK_FALSE(mesh.is_made_of(moved, hull.size(), options));
	std::vector<Vec2> longer = hull;
	longer.push_back({ 1, 2 });
	CHECK_FALSE(mesh.is_made_of(longer, hull.size(), options));
	CHECK_FALSE(mesh.is_made_of(hull, hull.size() - 1, options)); // the last would be an inner point
	for (const FillMesh::Options &other : { FillMesh::Options{ 1, 1, 0 }, FillMesh::Options{ 4, 2, 0 }, FillMesh::Options{ 4, 1, Real(0.5) } }) {
		CHECK_FALSE(mesh.is_made_of(hull, hull.size(), other));
	}
}

namespace {

double distance_to_box(Vec2 place, Vec2 half) {
	const double x = std::abs(double(place.x)) - double(half.x), y = std::abs(double(place.y)) - double(half.y);
	return x > 0 || y > 0 ? std::hypot(std::max(x, 0.0), std::max(y, 0.0)) : -std::max(x, y);
}

std::vector<Vec2> joined(std::vector<Vec2> hull, const std::vector<Vec2> &more) {
	hull.insert(hull.end(), more.begin(), more.end());
	return hull;
}

// Whether two segments have a point in common that is inside of both.
bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	const Real u = cross(b - a, c - a), v = cross(b - a, d - a), w = cross(d - c, a - c), x = cross(d - c, b - c);
	return u * v < 0 && w * x < 0;
}

} // namespace

TEST_CASE("sides beside a corner stay straight on a curve, of the hull and of a hole") {
	std::vector<Vec2> hole = box_hull({ 124, 74 }, 31).value();
	std::ranges::reverse(hole);
	for (const double spacing : { 12.0, 22.0, 45.0 }) {
		const std::vector<Vec2> hull = box_hull({ 180, 130 }, Real(spacing)).value();
		const std::vector<std::size_t> holes{ hole.size() };
		const FillMesh mesh(joined(hull, hole), hull.size(), { 4, 0 }, holes);
		const Placed result = placed(mesh, joined(hull, hole));
		CAPTURE(spacing);
		for (std::size_t i = 0; i < 4 * hull.size(); ++i) {
			CHECK(std::abs(distance_to_box(result.rim[i], { 90, 65 })) < 1e-3);
		}
		for (std::size_t i = 4 * hull.size(); i < result.rim.size(); ++i) {
			CHECK(std::abs(distance_to_box(result.rim[i], { 62, 37 })) < 1e-3);
		}
	}
}

TEST_CASE("regular polygons, whose corners are alike, have the curve of Catmull and Rom as before") {
	for (const int count : { 3, 4, 6, 16, 40 }) {
		const std::vector<Vec2> hull = circle_hull(50, count).value();
		const FillMesh mesh(hull, hull.size(), { 4, 0 });
		const Placed result = placed(mesh, hull);
		for (std::size_t i = 0; i < hull.size(); ++i) {
			const auto at = [&](std::size_t k) { return hull[k % hull.size()]; };
			const Vec2 middle = (at(i) + at(i + 1)) * (Real(9) / 16) - (at(i + hull.size() - 1) + at(i + 2)) * (Real(1) / 16); // t = 1/2 of theirs
			CHECK(length(result.rim[4 * i + 2] - middle) < Real(1e-4));
		}
	}
}

TEST_CASE("bands of holes that come near the hull or each other do not overlap, and keep their width elsewhere") {
	const unsigned seed = std::random_device()();
	CAPTURE(seed);
	Random random(seed);
	const std::vector<Vec2> hull = box_hull({ 220, 150 }, 25).value();
	constexpr Real BAND = 12;
	for (int trial = 0; trial < 150; ++trial) {
		// Two round holes somewhere inside, apart from the sides and from each other by 1 px or more.
		std::vector<std::vector<Vec2>> loops{ hull };
		std::vector<std::pair<Vec2, double>> disks;
		for (int tries = 0; tries < 60 && disks.size() < 2; ++tries) {
			const double radius = double(random.real(8, 40));
			const Vec2 middle{ random.real(-109 + radius, 109 - radius), random.real(-74 + radius, 74 - radius) };
			if (std::ranges::all_of(disks, [&](const auto &disk) { return double(length(disk.first - middle)) > radius + disk.second + 1; })) {
				disks.push_back({ middle, radius });
				std::vector<Vec2> hole = circle_hull(Real(radius), 16).value();
				for (Vec2 &p : hole) {
					p += middle;
				}
				std::ranges::reverse(hole);
				loops.push_back(hole);
			}
		}
		std::vector<Vec2> points;
		std::vector<std::size_t> holes;
		for (const std::vector<Vec2> &loop : loops) {
			points = joined(points, loop);
			if (points.size() > hull.size()) {
				holes.push_back(loop.size());
			}
		}
		const FillMesh mesh(points, hull.size(), { 2, 1, 0, BAND }, holes);
		const Placed result = placed(mesh, points);
		// The inner lines, loop after loop, at the begin of the vertices.
		std::vector<std::pair<std::size_t, std::size_t>> rims;
		mesh.for_rims([&](std::size_t start, std::size_t count) { rims.push_back({ start, count }); });
		int crossings = 0;
		for (std::size_t a = 0; a < rims.size(); ++a) {
			for (std::size_t b = a + 1; b < rims.size(); ++b) {
				for (std::size_t i = 0; i < rims[a].second; ++i) {
					for (std::size_t k = 0; k < rims[b].second; ++k) {
						const auto inner = [&](std::size_t rim, std::size_t index) { return result.vertices[rims[rim].first + index % rims[rim].second]; };
						crossings += cross_each_other(inner(a, i), inner(a, i + 1), inner(b, k), inner(b, k + 1));
						const auto outer = [&](std::size_t rim, std::size_t index) { return result.rim[rims[rim].first + index % rims[rim].second]; };
						crossings += cross_each_other(inner(a, i), inner(a, i + 1), outer(b, k), outer(b, k + 1));
						crossings += cross_each_other(outer(a, i), outer(a, i + 1), inner(b, k), inner(b, k + 1));
					}
				}
			}
		}
		CAPTURE(trial);
		CHECK(crossings == 0);
	}
	// Far from everything a hole's band is as wide as it should be.
	std::vector<Vec2> hole = circle_hull(20, 32).value();
	std::ranges::reverse(hole);
	const std::vector<std::size_t> counts{ hole.size() };
	const FillMesh mesh(joined(hull, hole), hull.size(), { 1, 1, 0, BAND }, counts);
	const Placed result = placed(mesh, joined(hull, hole));
	for (std::size_t i = 0; i < hole.size(); ++i) {
		CHECK(double(length(result.vertices[hull.size() + i])) == doctest::Approx(20 + 12).epsilon(0.01));
	}
}
