// SPDX-License-Identifier: MIT
// Polygons with holes as one outline, filled with triangles, and the mesh of a body with holes.
#include "core/skin/bridged_loops.h"

#include "core/creator/hulls.h"
#include "core/geometry/holed_polygon.h"
#include "core/geometry/polygon.h"
#include "core/skin/fill_mesh.h"
#include "core/skin/triangulation.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

struct Holed {
	std::vector<Vec2> hull;
	Holes holes;

	std::vector<Vec2> points() const {
		std::vector<Vec2> all = hull;
		for (const std::vector<Vec2> &hole : holes) {
			all.insert(all.end(), hole.begin(), hole.end());
		}
		return all;
	}
	std::vector<std::size_t> loops() const {
		std::vector<std::size_t> counts{ hull.size() };
		for (const std::vector<Vec2> &hole : holes) {
			counts.push_back(hole.size());
		}
		return counts;
	}
};

std::vector<Vec2> moved(std::vector<Vec2> polygon, Vec2 by) {
	for (Vec2 &p : polygon) {
		p += by;
	}
	return polygon;
}

// A wavy outline with as many holes of random places and shapes as fit.
Holed random_holed(Random &random) {
	Holed made;
	const int count = random.integer(5, 40);
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		const Real reach = random.real(60, 100);
		made.hull.push_back({ Real(double(reach) * std::cos(angle)), Real(double(reach) * std::sin(angle)) });
	}
	const int wanted = random.integer(1, 8);
	for (int k = 0; k < wanted; ++k) {
		std::vector<Vec2> hole;
		const int corners = random.integer(3, 12);
		const Vec2 middle = random.vector(70);
		for (int i = 0; i < corners; ++i) {
			const double angle = 2 * std::numbers::pi * i / corners;
			const Real reach = random.real(4, 25);
			hole.push_back(middle + Vec2{ Real(double(reach) * std::cos(angle)), Real(double(reach) * std::sin(angle)) });
		}
		if (random.integer(0, 1) == 1) {
			std::ranges::reverse(hole);
		}
		made.holes.push_back(hole);
		if (check_holes("holes", made.holes, made.hull)) {
			made.holes.pop_back();
		}
	}
	if (random.integer(0, 1) == 1) {
		std::ranges::reverse(made.hull);
	}
	return made;
}

// All points in rows and columns: many coincide in x, and lines between them run through others.
Holed perforated() {
	Holed made{ box_hull({ 100, 100 }, 10).value(), {} };
	for (int row = -1; row <= 1; ++row) {
		for (int column = -1; column <= 1; ++column) {
			made.holes.push_back(moved(box_hull({ 20, 20 }, 10).value(), { Real(30 * column), Real(30 * row) }));
		}
	}
	return made;
}

void check_filled(const Holed &body) {
	const std::vector<Vec2> points = body.points();
	const std::vector<std::size_t> loops = body.loops();
	const std::vector<Triangle> triangles = triangulate(points, loops);
	CHECK(triangles.size() == points.size() + 2 * body.holes.size() - 2); // Euler
	double area = 0;
	std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
	int outside = 0;
	for (const Triangle &t : triangles) {
		const double twice = signed_double_area(points[t[0]], points[t[1]], points[t[2]]);
		CHECK(twice >= 0);
		area += twice / 2;
		const Vec2 middle = (points[t[0]] + points[t[1]] + points[t[2]]) * (Real(1) / 3);
		outside += twice > 1e-3 && !point_in_holed_polygon(middle, body.hull, body.holes) ? 1 : 0;
		for (std::size_t k = 0; k < 3; ++k) {
			edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
		}
	}
	CHECK(outside == 0);
	CHECK(area == doctest::Approx(area_moments(body.hull, body.holes).area).epsilon(1e-5));
	std::uint32_t start = 0;
	for (const std::size_t count : loops) {
		for (std::uint32_t i = 0; i < count; ++i) {
			CHECK(edges.contains(std::minmax(start + i, start + (i + 1) % std::uint32_t(count))));
		}
		start += std::uint32_t(count);
	}
}

} // namespace

TEST_CASE("a polygon with holes is filled once, along all of its edges, and its holes stay empty") {
	Random random(11);
	int holes = 0;
	for (int i = 0; i < 300; ++i) {
		CAPTURE(i);
		const Holed body = random_holed(random);
		holes += int(body.holes.size());
		check_filled(body);
	}
	CHECK(holes > 400);
	check_filled(perforated());
	check_filled({ circle_hull(50, 64).value(), { circle_hull(49, 48).value() } });
}

TEST_CASE("a hole is not joined to a near point behind a slot") {
	// The slot's sides have no points between their ends; the arm behind it has one right beside the hole.
	const Holed body{ { { -60, -50 }, { 60, -50 }, { 60, 40 }, { 62, 40 }, { 62, -50 }, { 66, -50 }, { 66, 0 }, { 66, 60 }, { -60, 60 } }, { moved(circle_hull(15, 8).value(), { 40, 0 }) } };
	check_filled(body);
}

TEST_CASE("one outline around all holes has the area that is left, and passes each line there and back") {
	const Holed body = perforated();
	const std::vector<Vec2> points = body.points();
	const std::vector<std::uint32_t> outline = bridge_loops(points, body.loops());
	CHECK(outline.size() == points.size() + 2 * body.holes.size());
	std::vector<Vec2> line;
	for (const std::uint32_t point : outline) {
		line.push_back(points[point]);
	}
	CHECK(double(signed_area(line)) == doctest::Approx(10000 - 9 * 400));
}

TEST_CASE("the mesh of a body with a hole fills what is between its rims, straight or curved, with a soft edge and a band on both") {
	std::vector<Vec2> hole = circle_hull(25, 16).value();
	std::ranges::reverse(hole);
	std::vector<Vec2> points = circle_hull(50, 16).value();
	points.insert(points.end(), hole.begin(), hole.end());
	const std::size_t counts[] = { hole.size() };
	for (const std::size_t pieces : { std::size_t(1), std::size_t(4) }) {
		const FillMesh mesh(points, 16, { pieces, 2, 0, 5 }, counts);
		CHECK(mesh.rim_count() == 32 * pieces);
		CHECK(mesh.vertex_count() == 3 * mesh.rim_count());
		std::vector<Vec2> rim(mesh.rim_count());
		std::vector<Vec2> vertices(mesh.vertex_count());
		mesh.place_rim(points, rim);
		mesh.place(points, rim, vertices);
		double area = 0;
		for (const Triangle &t : mesh.triangles()) {
			area += std::abs(double(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]))) / 2;
		}
		// With half a pixel more outside and in the hole.
		const double n = 16.0 * double(pieces);
		const auto disk = [&](double radius) { return n / 2 * std::sin(2 * std::numbers::pi / n) * radius * radius; };
		const double more = 1 / std::cos(std::numbers::pi / n);
		CHECK(area == doctest::Approx(disk(50 + more) - disk(25 - more)).epsilon(0.003));
		for (std::size_t i = 0; i < rim.size(); ++i) {
			const bool is_hole = i >= 16 * pieces;
			const double radius = double(length(rim[i]));
			CHECK(double(length(vertices[i])) == doctest::Approx(radius + (is_hole ? 5 : -5)).epsilon(0.01)); // inside of the band
			CHECK(double(length(vertices[mesh.faded_start() + i])) == doctest::Approx(radius + (is_hole ? -1 : 1)).epsilon(0.01));
		}
		// Values that are linear in the plane come back linear, also along the hole; what the curve adds there is like what it adds to places.
		std::vector<Vec2> values(points.begin(), points.begin() + 16);
		const std::vector<Vec2> spread = mesh.spread<Vec2>(values);
		REQUIRE(spread.size() == mesh.vertex_count());
		for (std::size_t i = 0; i < rim.size(); ++i) {
			CHECK(double(length(spread[i] - rim[i])) < 1e-3);
			CHECK(double(length(spread[mesh.faded_start() + i] - rim[i])) < 1e-3);
		}
		CHECK(mesh.is_made_of(points, 16, { pieces, 2, 0, 5 }, counts));
		CHECK(!mesh.is_made_of(points, 16, { pieces, 2, 0, 5 }));
	}
}

TEST_CASE("an inset of a body with a hole ends inside of both rims") {
	std::vector<Vec2> points = box_hull({ 100, 100 }, 100).value();
	std::vector<Vec2> hole = box_hull({ 40, 40 }, 100).value();
	std::ranges::reverse(hole);
	points.insert(points.end(), hole.begin(), hole.end());
	const std::size_t counts[] = { hole.size() };
	const FillMesh mesh(points, 4, { 1, 0, 3, 0 }, counts);
	std::vector<Vec2> rim(mesh.rim_count());
	std::vector<Vec2> vertices(mesh.vertex_count());
	mesh.place_rim(points, rim);
	mesh.place(points, rim, vertices);
	for (std::size_t i = 0; i < 8; ++i) {
		CHECK(std::abs(double(vertices[i].x)) == doctest::Approx(i < 4 ? 47 : 23));
		CHECK(std::abs(double(vertices[i].y)) == doctest::Approx(i < 4 ? 47 : 23));
	}
}
