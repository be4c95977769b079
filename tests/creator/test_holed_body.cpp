// SPDX-License-Identifier: MIT
// Bodies with holes against the theory of rings and exact moments.
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/holed_polygon.h"
#include "core/geometry/polygon.h"
#include "core/model/material.h"
#include "core/model/world_data.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

using namespace softbody;

namespace {

constexpr double PI = std::numbers::pi;
constexpr Real OUTER = 50;

std::vector<Vec2> moved(std::vector<Vec2> polygon, Vec2 by) {
	for (Vec2 &p : polygon) {
		p += by;
	}
	return polygon;
}

std::shared_ptr<const SoftBodyShape> ring(Real inner, ElasticModel model, int points = 64, bool has_hole = true) {
	StructureOptions options;
	options.elastic = model == ElasticModel::MODES;
	options.elastic_triangles = model == ElasticModel::TRIANGLES;
	options.triangle_points = 3 * points / 2;
	if (has_hole) {
		options.holes = { circle_hull(inner, 96).value() };
	}
	const auto shape = SoftBodyCreator::create_polygon(circle_hull(OUTER, points).value(), options);
	REQUIRE_MESSAGE(shape.has_value(), shape.error().message());
	return shape.value();
}

// How much nearer to each other two opposite points come under forces towards each other, once the body rests.
double compression(const std::shared_ptr<const SoftBodyShape> &shape, ElasticModel model, const Material &material, double force) {
	BodySettings settings;
	settings.can_sleep = false;
	REQUIRE(!apply_material(material, model, *shape, settings));
	WorldData world;
	world.set_gravity({});
	const BodyId id = world.add_soft_body(SoftBodyData::create(shape, settings, {}).value());
	Simulator simulator(world);
	const std::uint32_t opposite = std::uint32_t(shape->hull_count() / 2);
	const auto gap = [&] { return double(length(world.find(id)->positions()[opposite] - world.find(id)->positions()[0])); };
	const double before = gap();
	for (int tick = 0; tick < 1500; ++tick) {
		SoftBodyData &body = *world.find(id);
		const Vec2 direction = (body.positions()[opposite] - body.positions()[0]) * Real(1 / gap());
		// Spread over a tenth of the outline, as by a finger: a single point gives way alone.
		const int reach = std::max(1, int(shape->hull_count() / 32));
		for (int k = -reach; k <= reach; ++k) {
			const double share = double(reach + 1 - std::abs(k)) / double((reach + 1) * (reach + 1));
			const auto point = [&](std::uint32_t middle) { return (middle + std::uint32_t(int(shape->hull_count()) + k)) % std::uint32_t(shape->hull_count()); };
			REQUIRE(!body.add_external_force(point(0), direction * Real(share * force)));
			REQUIRE(!body.add_external_force(point(opposite), direction * Real(-share * force)));
		}
		REQUIRE(!simulator.simulate(Real(1) / 60).refused);
	}
	return before - gap();
}

// Of a ring under two opposite forces, in plane strain, with the shear and the stretch of its wall (Roark's Formulas for Stress and Strain,
// table 9.2, case 1).
double roark(double inner, const Material &material, double force) {
	const double wall = double(OUTER) - inner;
	const double radius = (double(OUTER) + inner) / 2;
	const double nu = double(material.poisson_ratio);
	const double modulus = double(material.youngs_modulus) / (1 - nu * nu);
	const double bending = modulus * wall * wall * wall / 12;
	const double alpha = wall * wall / (12 * radius * radius);
	const double beta = 1.2 * modulus / double(material.shear_modulus()) * alpha;
	const double k1 = 1 - alpha + beta;
	const double k2 = 1 - alpha;
	return force * radius * radius * radius / bending * (PI * k1 / 4 - 2 * k2 * k2 / PI);
}

} // namespace

TEST_CASE("a ring pressed by two opposite forces gives way as the theory of rings says" * doctest::test_suite("slow")) {
	// 0.149 F R³ / (E I) for a thin one. Sixteen modes are kept.
	for (const Real inner : { Real(45), Real(40), Real(32) }) {
		for (const Real nu : { Real(0), Real(0.45) }) {
			const Material material{ 30000, nu, Real(0.5) };
			CAPTURE(inner);
			CAPTURE(nu);
			const double unit = roark(double(inner), material, 1);
			const double force = 0.01 * double(OUTER) / unit; // to 0.99 of its diameter
			const double found = compression(ring(inner, ElasticModel::MODES), ElasticModel::MODES, material, force);
			CHECK(std::abs(found / (unit * force) - 1) < (inner < 35 ? 0.2 : 0.06)); // a wall of a third of the radius is as wide as what presses it
			const double filled = compression(ring(inner, ElasticModel::MODES, 64, false), ElasticModel::MODES, material, force);
			CHECK(filled < 0.3 * found);
		}
	}
}

TEST_CASE("a thick ring of triangles gives way as one of modes") {
	const Material material{ 30000, Real(0.3), Real(0.5) };
	const double modes = compression(ring(25, ElasticModel::MODES, 32), ElasticModel::MODES, material, 300);
	const double triangles = compression(ring(25, ElasticModel::TRIANGLES, 32), ElasticModel::TRIANGLES, material, 300);
	// Points of triangles take their load alone, not along two edges.
	CHECK(triangles / modes > 0.9);
	CHECK(triangles / modes < 1.4);
}

TEST_CASE("a ring grows under a pressure inside as Lame's cylinder does") {
	for (const Real inner : { Real(45), Real(35), Real(15) }) {
		const auto shape = ring(inner, ElasticModel::MODES);
		for (std::size_t k = 0; k < MODE_POISSON_RATIOS.size(); ++k) {
			// Drawn outwards at its outer side, in plane strain: 2 u / b, times the shear modulus.
			const double nu = MODE_POISSON_RATIOS[k];
			const double over_modulus = (1 - nu) / 2; // μ / E', E' = 2 μ (1 + ν) / (1 - ν²)
			const double nu_plane = nu / (1 - nu);
			const double b2 = double(OUTER) * OUTER;
			const double a2 = double(inner) * inner;
			const double exact = 2 * over_modulus * ((1 - nu_plane) * b2 + (1 + nu_plane) * a2) / (b2 - a2);
			CAPTURE(inner);
			CAPTURE(nu);
			CHECK(double(shape->modes()->hull_compliance[k]) == doctest::Approx(exact).epsilon(0.05));
		}
		const Material material{ 1000, Real(0.45), Real(0.15) };
		BodySettings settings;
		REQUIRE(!apply_material(material, ElasticModel::MODES, *shape, settings));
		CHECK(double(settings.area_stiffness) == doctest::Approx(double(material.shear_modulus()) / double(shape->modes()->hull_compliance[2])).epsilon(1e-3));
		CHECK(settings.area_stiffness < material.bulk_modulus());
	}
	const auto filled = ring(10, ElasticModel::MODES, 64, false);
	CHECK(filled->modes()->hull_compliance[0] == 0);
}

TEST_CASE("center of mass and moment of inertia are those of the polygon less its holes, under every model, wherever it lies") {
	const std::vector<Vec2> hull = moved(box_hull({ 120, 80 }, 20).value(), { 400, -300 });
	const Holes holes = { moved(circle_hull(16, 24).value(), { 430, -300 }), moved(box_hull({ 20, 30 }, 15).value(), { 365, -290 }) };
	const AreaMoments moments = area_moments(hull, holes);
	for (const bool is_reversed : { false, true }) {
		for (const int model : { 0, 1, 2 }) {
			StructureOptions options;
			options.mass = 3;
			options.holes = holes;
			options.elastic = model == 1;
			options.elastic_triangles = model == 2;
			options.triangle_points = 60;
			std::vector<Vec2> outline = hull;
			if (is_reversed) {
				std::ranges::reverse(outline);
			}
			const auto made = SoftBodyCreator::create_polygon(outline, options);
			CAPTURE(model);
			REQUIRE_MESSAGE(made.has_value(), made.error().message());
			const SoftBodyShape &shape = *made.value();
			CHECK(double(shape.total_mass()) == doctest::Approx(3));
			CHECK(double(shape.origin_offset().x) == doctest::Approx(moments.centroid.x).epsilon(2e-5));
			CHECK(double(shape.origin_offset().y) == doctest::Approx(moments.centroid.y).epsilon(2e-5));
			CHECK(double(shape.rest_inertia()) == doctest::Approx(3 * moments.inertia / moments.area).epsilon(1e-3));
			CHECK(double(*std::ranges::min_element(shape.masses())) > 0);
		}
	}
}

TEST_CASE("a ring without a point inside has its center, and the inertia of its points") {
	StructureOptions options;
	options.center_point = false;
	options.elastic = true;
	options.holes = { moved(circle_hull(20, 24).value(), { 15, 0 }) };
	const std::vector<Vec2> hull = circle_hull(OUTER, 24).value();
	const auto shape = SoftBodyCreator::create_polygon(hull, options).value();
	const AreaMoments moments = area_moments(hull, options.holes);
	CHECK(double(shape->origin_offset().x) == doctest::Approx(moments.centroid.x).epsilon(1e-3));
	CHECK(moments.centroid.x < -2);
	CHECK(double(shape->rest_inertia()) > moments.inertia / moments.area);
}

TEST_CASE("triangles fill the body around its holes, and none lies in a hole") {
	const auto shape = ring(30, ElasticModel::TRIANGLES, 32);
	const AreaMoments moments = area_moments(circle_hull(OUTER, 32).value(), { circle_hull(30, 96).value() });
	double area = 0;
	for (const ElasticTriangle &triangle : shape->triangles()->triangles) {
		area += double(triangle.area);
		Vec2 middle;
		for (const std::uint32_t corner : triangle.corners) {
			middle += shape->rest_positions()[corner] * (Real(1) / 3);
		}
		CHECK(double(length(middle)) > 29);
	}
	CHECK(area == doctest::Approx(moments.area).epsilon(0.03));
}

TEST_CASE("a body with a bad hole is refused, and one without holes has the shape that it always had") {
	StructureOptions options;
	options.holes = { circle_hull(60, 12).value() };
	const auto refused = SoftBodyCreator::create_polygon(circle_hull(OUTER, 16).value(), options);
	REQUIRE(!refused);
	CHECK(refused.error().name.starts_with("holes[0]"));
}
