// SPDX-License-Identifier: MIT
// Meshes of elastic triangles: they fill any outline once, evenly, and carry its mass.
#include "core/creator/triangle_mesh.h"

#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A star of random reach about a random place: simple, dented at random.
std::vector<Vec2> random_star(Random &random) {
	const int count = random.integer(4, 24);
	const Vec2 place = random.vector(500);
	std::vector<Vec2> hull;
	for (int i = 0; i < count; ++i) {
		const double angle = 2 * std::numbers::pi * i / count;
		const Real reach = random.real(25, 100);
		hull.push_back(place + Vec2{ Real(reach * std::cos(angle)), Real(reach * std::sin(angle)) });
	}
	return hull;
}

const std::vector<Vec2> L_HULL = { { 0, 0 }, { 50, 0 }, { 100, 0 }, { 100, 40 }, { 70, 40 }, { 40, 40 }, { 40, 100 }, { 0, 100 }, { 0, 50 } };

std::shared_ptr<const SoftBodyShape> filled(const std::vector<Vec2> &hull, int count) {
	StructureOptions options;
	options.elastic_triangles = true;
	options.triangle_points = count;
	return SoftBodyCreator::create_polygon(hull, options).value();
}

double double_area(Vec2 a, Vec2 b, Vec2 c) {
	return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(c.x) - a.x) * (double(b.y) - a.y);
}

// Of q, how far inside the circle around a, b and c it lies: positive inside, over the fourth power of lengths.
double inside_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 q) {
	const auto row = [&](Vec2 p) {
		const double x = double(p.x) - q.x;
		const double y = double(p.y) - q.y;
		return std::array{ x, y, x * x + y * y };
	};
	const auto [ax, ay, a2] = row(a);
	const auto [bx, by, b2] = row(b);
	const auto [cx, cy, c2] = row(c);
	return (a2 * (bx * cy - cx * by) - b2 * (ax * cy - cx * ay) + c2 * (ax * by - bx * ay)) / std::pow(std::max({ a2, b2, c2 }), 2);
}

// Every claim about a filled shape.
void check_filled(const SoftBodyShape &shape) {
	REQUIRE(shape.triangles() != nullptr);
	const std::span<const Vec2> points = shape.rest_positions();
	const std::vector<ElasticTriangle> &triangles = shape.triangles()->triangles;
	// Euler: 2 inner + hull - 2.
	CHECK(triangles.size() == 2 * shape.point_count() - shape.hull_count() - 2);
	double area = 0;
	std::vector<double> shares(points.size(), 0);
	std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> across; // of each edge
	for (const ElasticTriangle &t : triangles) {
		const auto [a, b, c] = t.corners;
		const double twice = double_area(points[a], points[b], points[c]);
		CHECK(twice > 0);
		CHECK(double(t.area) == doctest::Approx(twice / 2).epsilon(1e-4));
		area += twice / 2;
		for (std::size_t k = 0; k < 3; ++k) {
			shares[t.corners[k]] += twice / 6;
			across[std::minmax(t.corners[k], t.corners[(k + 1) % 3])].push_back(t.corners[(k + 2) % 3]);
		}
		// The rows of the inverse of the edges.
		const auto [g1, g2] = t.gradients;
		CHECK(double(dot(g1, points[b] - points[a])) == doctest::Approx(1).epsilon(1e-3));
		CHECK(std::abs(double(dot(g1, points[c] - points[a]))) < 1e-3);
		CHECK(std::abs(double(dot(g2, points[b] - points[a]))) < 1e-3);
		CHECK(double(dot(g2, points[c] - points[a])) == doctest::Approx(1).epsilon(1e-3));
	}
	CHECK(area == doctest::Approx(double(shape.rest_area())).epsilon(1e-5));
	for (std::size_t i = 0; i < points.size(); ++i) {
		CHECK(double(shape.masses()[i]) == doctest::Approx(double(shape.total_mass()) * shares[i] / area).epsilon(1e-3));
	}
	for (const auto &[edge, corners] : across) {
		const auto [from, to] = edge;
		const bool is_hull_edge = to < shape.hull_count() && (to == from + 1 || (from == 0 && to + 1 == shape.hull_count()));
		CHECK(corners.size() == (is_hull_edge ? 1u : 2u));
		if (corners.size() != 2) {
			continue;
		}
		// Delaunay, unless the four corners are no convex quadrilateral.
		const Vec2 p = points[corners[0]];
		const Vec2 q = points[corners[1]];
		const double side = double_area(points[from], points[to], p) > 0 ? 1 : -1;
		const bool is_convex = side * double_area(points[from], q, p) > 0 && side * double_area(q, points[to], p) > 0;
		CHECK((!is_convex || side * inside_circle(points[from], points[to], p, q) < 1e-5));
	}
}

} // namespace

TEST_CASE("a mesh fills its outline exactly, is Delaunay, has no flipped triangle, and carries the mass of the area") {
	for (const int count : { 0, 1, 7, 24, 64 }) {
		CAPTURE(count);
		check_filled(*filled(circle_hull(50, 16).value(), count));
		check_filled(*filled(box_hull({ 160, 60 }, 20).value(), count));
		check_filled(*filled(L_HULL, count));
	}
}

TEST_CASE("a mesh holds for random dented outlines of either winding, wherever they lie" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 0; seed < 300; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		std::vector<Vec2> hull = random_star(random);
		if (random.chance(0.5)) {
			std::ranges::reverse(hull);
		}
		check_filled(*filled(hull, random.integer(0, 80)));
	}
}

TEST_CASE("as many inner points are placed as wanted, or hardly other, inside and apart") {
	Random random(5);
	std::vector<std::vector<Vec2>> outlines = { circle_hull(50, 16).value(), L_HULL, box_hull({ 160, 60 }, 20).value() };
	for (int i = 0; i < 20; ++i) {
		outlines.push_back(random_star(random));
	}
	for (const std::vector<Vec2> &hull : outlines) {
		for (const std::size_t count : { 1u, 5u, 24u, 64u, 200u }) {
			CAPTURE(count);
			const std::vector<Vec2> points = even_inner_points(hull, {}, count);
			CHECK(std::abs(double(points.size()) - double(count)) <= 1 + 0.04 * double(count));
			const double spacing = std::sqrt(std::abs(double(signed_area(hull))) / (double(count) * std::sqrt(0.75)));
			for (std::size_t i = 0; i < points.size(); ++i) {
				CHECK(point_in_polygon(points[i], hull));
				for (std::size_t j = 0; j < i; ++j) {
					CHECK(double(length(points[i] - points[j])) > 0.3 * spacing);
				}
			}
		}
	}
	CHECK(even_inner_points(L_HULL, {}, 0).empty());
	CHECK(even_inner_points(L_HULL, {}, 64) == even_inner_points(L_HULL, {}, 64));
}

TEST_CASE("own inner points are corners as given, and the others keep away from them") {
	StructureOptions options;
	options.elastic_triangles = true;
	options.inner_points = { { 3, 2 }, { -20, 10 } };
	const auto shape = SoftBodyCreator::create_polygon(circle_hull(50, 16).value(), options).value();
	check_filled(*shape);
	for (std::size_t i = 0; i < 2; ++i) {
		const Vec2 place = shape->rest_positions()[16 + i] + shape->origin_offset();
		CHECK(double(length(place - options.inner_points[i])) < 1e-4);
		for (std::size_t j = 18; j < shape->point_count(); ++j) {
			CHECK(double(length(shape->rest_positions()[j] - shape->rest_positions()[16 + i])) > 4);
		}
	}
}

TEST_CASE("triangles of a size are even: no angle of a disk's or box's is below 25 degrees") {
	for (const std::vector<Vec2> &hull : { circle_hull(50, 16).value(), box_hull({ 100, 100 }, 25).value() }) {
		const auto shape = filled(hull, 64);
		for (const ElasticTriangle &t : shape->triangles()->triangles) {
			for (std::size_t k = 0; k < 3; ++k) {
				const Vec2 p = shape->rest_positions()[t.corners[k]];
				const Vec2 a = shape->rest_positions()[t.corners[(k + 1) % 3]] - p;
				const Vec2 b = shape->rest_positions()[t.corners[(k + 2) % 3]] - p;
				CHECK(double(dot(a, b) / (length(a) * length(b))) < std::cos(25 * std::numbers::pi / 180));
			}
		}
	}
}

TEST_CASE("what cannot be filled is refused by name") {
	const std::vector<Vec2> hull = circle_hull(50, 16).value();
	const auto refused = [&](const StructureOptions &options, const char *name) {
		const auto result = SoftBodyCreator::create_polygon(hull, options);
		REQUIRE(!result);
		CHECK(result.error().name == name);
	};
	StructureOptions options;
	options.elastic_triangles = true;
	options.triangle_points = -1;
	refused(options, "triangle_points");
	options.triangle_points = MAX_HULL_POINTS + 1;
	refused(options, "triangle_points");
	options.triangle_points = 8;
	options.inner_points = { { 0, 0 }, { 200, 0 } };
	refused(options, "inner_points[1]");
	options.inner_points = { { 5, 5 }, { 5, 5 } };
	refused(options, "inner_points[1]");
	options.inner_points = {};
	options.elastic = true;
	refused(options, "elastic_triangles");
}

TEST_CASE("triangles that are none are refused by a shape") {
	const auto good = filled(circle_hull(50, 8).value(), 4);
	SoftBodyShape::Description description;
	description.points.assign(good->rest_positions().begin(), good->rest_positions().end());
	description.masses.assign(good->masses().begin(), good->masses().end());
	description.hull_count = good->hull_count();
	ElasticTriangles broken = *good->triangles();
	broken.triangles[2].corners[1] = 99;
	description.triangles = std::make_shared<ElasticTriangles>(broken);
	CHECK(SoftBodyShape::create(description).error().name == "triangles[2]");
	broken = *good->triangles();
	broken.triangles[1].area = 0;
	description.triangles = std::make_shared<ElasticTriangles>(broken);
	CHECK(SoftBodyShape::create(description).error().name == "triangles[1].area");
	description.triangles = std::make_shared<ElasticTriangles>(*good->triangles());
	description.modes = std::make_shared<ElasticModes>();
	CHECK(!SoftBodyShape::create(description));
}
