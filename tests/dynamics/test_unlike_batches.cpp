// SPDX-License-Identifier: MIT
// Bodies of one shape that differ in how firm they are share batches, and move as each would in batches of its own: to the
// last bit.
#include "core/dynamics/simulator.h"
#include "core/model/force_coefficients.h"
#include "core/model/material.h"
#include "scenes/jelly.h"
#include "scenes/metal.h"
#include "support/batches.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr int BODIES = 20; // full batches of both widths

// A body of a material that is up to so many times as firm as another.
BodySettings random_firmness(ElasticModel model, const SoftBodyShape &shape, double span, Random &random) {
	BodySettings settings;
	Material material;
	material.youngs_modulus = Real(2000 * std::pow(span, double(random.real(0, 1))));
	material.damping_ratio = random.real(0.05, 0.4);
	REQUIRE_FALSE(apply_material(material, model, shape, settings));
	settings.rolling_resistance = Real(0.03);
	return settings;
}

// A heap of them in a shaft. With `has_layers` no two bodies share a batch, as each is in a layer of its own.
WorldData heap(std::uint64_t seed, ElasticModel model, double span, Integrator integrator, bool has_layers) {
	Random random(seed);
	StructureOptions options;
	options.stiffness = 1;
	options.damping = 1;
	options.elastic = model == ElasticModel::MODES;
	options.elastic_triangles = model == ElasticModel::TRIANGLES;
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, options).value();
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	for (const Real side : { Real(-1), Real(1) }) {
		Border wall;
		wall.plane = { { side * 160, 0 }, { -side, 0 } };
		world.add_border(wall);
	}
	for (int i = 0; i < BODIES; ++i) {
		BodySettings settings = random_firmness(model, *shape, span, random);
		settings.integrator = integrator;
		settings.can_sleep = false;
		settings.collision_layer = has_layers ? 1u << i : 1u;
		const Vec2 center{ Real(-105 + 105 * (i % 3)) + random.real(-4, 4), Real(-60 - 110 * (i / 3)) };
		world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ center, Rotation::from_angle(random.real(-3, 3)) }).value());
	}
	return world;
}

std::vector<std::uint32_t> sizes_of_batches(WorldData &world, int parts) {
	ActiveBodies bodies(world);
	bodies.update(FRAME);
	std::vector<std::uint32_t> sizes;
	for (std::size_t at = 0; at < bodies.awake().size(); at += sizes.back()) {
		sizes.push_back(bodies.batch_at(bodies.awake().subspan(at), parts).count);
	}
	return sizes;
}

// Largest distance of two bodies' points; 0 if they have the same bits.
double largest_difference(const WorldData &a, const WorldData &b) {
	double largest = 0;
	for (std::size_t i = 0; i < a.soft_bodies().size(); ++i) {
		for (std::size_t point = 0; point < a.soft_bodies()[i].point_count(); ++point) {
			const Vec2 apart = a.soft_bodies()[i].positions()[point] - b.soft_bodies()[i].positions()[point];
			largest = std::max({ largest, std::abs(double(apart.x)), std::abs(double(apart.y)) });
		}
	}
	return largest;
}

} // namespace

TEST_CASE("bodies that are firm in unlike ways move in common batches as in batches of their own, with every model and method" * doctest::test_suite("slow")) {
	int shared = 0;
	for (const ElasticModel model : MODELS) {
		for (int method = 0; method < INTEGRATOR_COUNT; ++method) {
			CAPTURE(int(model));
			CAPTURE(method);
			const std::uint64_t seed = std::uint64_t(100 * int(model) + method);
			WorldData together = heap(seed, model, 4, Integrator(method), false);
			WorldData apart = heap(seed, model, 4, Integrator(method), true);
			REQUIRE(sizes_of_batches(apart, MAX_SUBSTEPS).size() == BODIES);
			shared += int(sizes_of_batches(together, MAX_SUBSTEPS).size() < BODIES);
			Simulator first(together);
			Simulator second(apart);
			for (int tick = 0; tick < 40; ++tick) {
				first.simulate(FRAME);
				second.simulate(FRAME);
			}
			CHECK(largest_difference(together, apart) == 0);
			CHECK(together.soft_bodies()[0].positions()[0] != heap(seed, model, 4, Integrator(method), false).soft_bodies()[0].positions()[0]);
		}
	}
	CHECK(shared >= int(MODELS.size()) * (INTEGRATOR_COUNT - 1) - 2); // all but XPBD, and but methods that are not stable there
}

TEST_CASE("in a heap the bodies that take as many substeps a slice share batches, whatever their own plans") {
	WorldData world = heap(1, ElasticModel::MODES, 3, Integrator::AUTOMATIC, false);
	std::vector<int> plans;
	for (const SoftBodyData &body : world.soft_bodies()) {
		plans.push_back(Simulator(world).plan(body, FRAME).substeps);
	}
	const auto [fewest, most] = std::ranges::minmax(plans);
	REQUIRE(fewest < most);
	const std::size_t whole = sizes_of_batches(world, most).size();
	CHECK(whole == BODIES / WIDE_WIDTH + (BODIES % WIDE_WIDTH) / PACK_WIDTH + BODIES % PACK_WIDTH);
	CHECK(sizes_of_batches(world, 1).size() > whole); // alone, each takes its own number

	SUBCASE("a body with a term that others lack is in none with them") {
		BodySettings settings = world.soft_bodies()[4].settings();
		settings.elastic_damping_time = 0;
		REQUIRE_FALSE(world.soft_bodies()[4].set_settings(settings));
		CHECK(sizes_of_batches(world, most).size() > whole);
	}
	SUBCASE("so is one with another friction") {
		BodySettings settings = world.soft_bodies()[4].settings();
		settings.friction = Real(0.9);
		REQUIRE_FALSE(world.soft_bodies()[4].set_settings(settings));
		CHECK(sizes_of_batches(world, most).size() > whole);
	}
}

TEST_CASE("coefficients of lanes are those of the settings") {
	Random random(5);
	std::array<BodySettings, WIDE_WIDTH> settings;
	std::array<const BodySettings *, WIDE_WIDTH> list;
	for (std::size_t lane = 0; lane < WIDE_WIDTH; ++lane) {
		settings[lane].spring_stiffness_scale = random.real(1, 2);
		settings[lane].spring_damping_scale = random.real(1, 2);
		settings[lane].shear_modulus = random.real(1, 2);
		settings[lane].area_stiffness = random.real(1, 2);
		settings[lane].elastic_damping_time = random.real(1, 2);
		settings[lane].shape_stiffness = random.real(1, 2);
		settings[lane].shape_damping = random.real(1, 2);
		list[lane] = &settings[lane];
	}
	const auto coefficients = coefficients_of<RealPack>(list.data());
	for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
		CHECK(coefficients.spring_stiffness_scale[lane] == settings[lane].spring_stiffness_scale);
		CHECK(coefficients.spring_damping_scale[lane] == settings[lane].spring_damping_scale);
		CHECK(coefficients.shear_modulus[lane] == settings[lane].shear_modulus);
		CHECK(coefficients.area_stiffness[lane] == settings[lane].area_stiffness);
		CHECK(coefficients.elastic_damping_time[lane] == settings[lane].elastic_damping_time);
		CHECK(coefficients.shape_stiffness[lane] == settings[lane].shape_stiffness);
		CHECK(coefficients.shape_damping[lane] == settings[lane].shape_damping);
	}
}
