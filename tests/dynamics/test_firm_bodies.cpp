// SPDX-License-Identifier: MIT
// Claims about bodies of any size and weight that are dropped in: they are firm enough not to fold.
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/load_trial.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/firmness.h"
#include "core/model/material_values.h"
#include "core/model/model_choice.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

using Points = std::vector<Vec2>;

constexpr double DEFAULT_AREA = 7653.668; // of the default node, which has 1 kg [px²]
constexpr int FIVE_SECONDS = 300; // steps

struct Sample {
	Points outline;
	double radius = 0; // about [px]
	double mass = 1; // [kg]
	double modulus = MaterialValues().youngs_modulus; // as set [N/m]
	double gravity_scale = 1;
};

// An outline about as wide as two radii, at most twice as long as wide.
Points random_outline(Random &random, Real radius) {
	Points points;
	switch (random.integer(0, 4)) {
		case 0:
			return circle_hull(radius, random.integer(6, 40)).value();
		case 1:
			return box_hull({ 2 * radius, radius * random.real(1, 2) }, radius / 2).value();
		case 2:
			return capsule_hull(radius * Real(0.6), radius * random.real(1.4, 2.4), radius * Real(0.4)).value();
		case 3: { // a star
			const int arms = random.integer(4, 8);
			const Real inner = random.real(0.5, 0.8);
			for (int i = 0; i < 2 * arms; ++i) {
				const Real angle = std::numbers::pi_v<Real> * Real(i) / Real(arms);
				points.push_back(Vec2{ std::cos(angle), std::sin(angle) } * (i % 2 == 0 ? radius : inner * radius));
			}
			return points;
		}
		default: { // a potato
			const int count = random.integer(8, 30);
			for (int i = 0; i < count; ++i) {
				const Real angle = 2 * std::numbers::pi_v<Real> * Real(i) / Real(count);
				points.push_back(Vec2{ std::cos(angle), std::sin(angle) } * (radius * random.real(0.7, 1)));
			}
			return points;
		}
	}
}

double power(Random &random, double least, double most) {
	return least * std::pow(most / least, double(random.real(0, 1)));
}

Sample random_sample(std::uint64_t seed) {
	Random random(seed);
	Sample sample;
	sample.radius = power(random, 5, 500);
	sample.outline = random_outline(random, Real(sample.radius));
	sample.mass = random.chance(0.5) ? power(random, 0.01, 1000) : double(signed_area(sample.outline)) / DEFAULT_AREA;
	return sample;
}

// A body as the node makes it.
SoftBodyData node_body(const Sample &sample, Vec2 place, Real angle, bool firm_for_weight = true) {
	MaterialValues values;
	values.youngs_modulus = sample.modulus;
	StructureOptions options;
	options.mass = Real(sample.mass);
	options.stiffness = 1;
	options.damping = 1;
	const ElasticModel model = choose_elastic_model(sample.outline.size());
	options.elastic = model == ElasticModel::MODES;
	const auto shape = SoftBodyCreator::create_polygon(sample.outline, options).value();
	Material material = to_material(values);
	if (firm_for_weight) {
		const double load = load_of(sample.mass, double(PIXEL_GRAVITY) * sample.gravity_scale, double(shape->rest_area()));
		material.youngs_modulus = Real(sample.modulus * firmness_for(load, sample.modulus).factor);
	}
	BodySettings settings;
	REQUIRE_FALSE(apply_material(material, model, *shape, settings));
	set_default_limits(settings);
	settings.friction = Real(values.friction);
	settings.rolling_resistance = Real(values.rolling_resistance);
	settings.gravity_scale = Real(sample.gravity_scale);
	settings.self_collision = has_deep_dents(sample.outline);
	return SoftBodyData::create(shape, settings, Pose{ place, Rotation::from_angle(angle) }).value();
}

double area_of(const SoftBodyData &body) {
	return double(signed_area(body.hull())) / double(body.shape().rest_area());
}

bool is_whole(const SoftBodyData &body) {
	return !is_folded(body.hull()) && area_of(body) > 1 - double(FOLDED_AREA_LOSS);
}

// Drops one body from a height of twice its radius, and returns it after five seconds.
SoftBodyData dropped(const Sample &sample, Real angle, bool firm_for_weight = true) {
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	const BodyId id = world.add_soft_body(node_body(sample, { 0, -3 * Real(sample.radius) }, angle, firm_for_weight));
	Simulator simulator(world);
	for (int step = 0; step < FIVE_SECONDS; ++step) {
		simulator.simulate(FRAME);
	}
	return *world.find(id);
}

// Ten alike fall into a shaft of four times their width, two side by side.
struct Heap {
	int folded = 0;
	double least_area = 1;
};
Heap heap_of_ten(const Sample &sample) {
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	const Real radius = Real(sample.radius);
	world.add_border({ { { -4 * radius, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 4 * radius, 0 }, { -1, 0 } }, {} });
	for (int i = 0; i < 10; ++i) {
		const Vec2 place{ (i % 2 == 0 ? Real(-1.3) : Real(1.2)) * radius, -radius * (3 + Real(2.6) * Real(i / 2)) };
		world.add_soft_body(node_body(sample, place, Real(0.7) * Real(i)));
	}
	Simulator simulator(world);
	for (int step = 0; step < FIVE_SECONDS; ++step) {
		simulator.simulate(FRAME);
	}
	Heap heap;
	for (const SoftBodyData &body : world.soft_bodies()) {
		heap.folded += is_folded(body.hull());
		heap.least_area = std::min(heap.least_area, area_of(body));
	}
	return heap;
}

} // namespace

TEST_CASE("the default node has the firmness of its material, and a disk of any size and mass sags no more than it") {
	Sample node{ circle_hull(50, 16).value(), 50 };
	const double own = load_of(1, double(PIXEL_GRAVITY), double(signed_area(node.outline)));
	CHECK(firmness_for(own, node.modulus).factor == 1);
	CHECK(node_body(node, {}, 0).settings() == node_body(node, {}, 0, false).settings());
	const auto sag_of = [](const Sample &sample) {
		const auto made = node_body(sample, {}, 0);
		auto trial = LoadTrial::create(made, { 0, PIXEL_GRAVITY }, PIXELS_PER_METER, FRAME);
		while (trial.value().step()) {
		}
		return double(trial.value().outcome().sag);
	};
	const double usual = sag_of(node);
	CHECK(usual == doctest::Approx(0.045).epsilon(0.05));
	for (const double radius : { 5.0, 50.0, 500.0 }) {
		for (const double mass : { 0.01, 1.0, 1000.0 }) {
			CAPTURE(radius);
			CAPTURE(mass);
			// Contacts hold points a slop of 0.1 px above the floor, which a small body takes for sag.
			CHECK(sag_of({ circle_hull(Real(radius), 16).value(), radius, mass }) <= 1.1 * usual + 0.1 / radius);
		}
	}
}

TEST_CASE("a body of any size, mass and outline dropped on a floor does not fold" * doctest::test_suite("slow")) {
	int softened = 0;
	for (std::uint64_t seed = 1; seed <= 300; ++seed) {
		CAPTURE(seed);
		const Sample sample = random_sample(seed);
		const Real angle = Random(seed + 1000).real(0, 6.28);
		CHECK(is_whole(dropped(sample, angle)));
		softened += !is_whole(dropped(sample, angle, false));
	}
	CHECK(softened > 20); // without it, where the mass is large for the size
}

TEST_CASE("whatever its Young's modulus and gravity, a body dropped on a floor does not fold" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 1; seed <= 200; ++seed) {
		CAPTURE(seed);
		Sample sample = random_sample(seed + 5000);
		Random random(seed + 6000);
		sample.modulus = power(random, 1, 10000);
		sample.gravity_scale = double(random.real(-5, 5));
		if (sample.gravity_scale < 0) { // upwards is downwards of the same body
			sample.gravity_scale = -sample.gravity_scale;
		}
		const SoftBodyData body = dropped(sample, random.real(0, 6.28));
		CHECK_FALSE(is_folded(body.hull()));
		CHECK(area_of(body) > 0.7);
	}
}

TEST_CASE("ten of any size, mass and outline in a heap do not fold" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 1; seed <= 100; ++seed) {
		CAPTURE(seed);
		const Heap heap = heap_of_ten(random_sample(seed + 9000));
		CHECK(heap.folded == 0);
		CHECK(heap.least_area > 0.6);
	}
}
