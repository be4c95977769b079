// SPDX-License-Identifier: MIT
// Bodies that start flattened, inverted, crumpled or anyhow.
#include "scenes/stress/bodies.h"

namespace softbody::testing {

namespace {

constexpr std::array<const char *, DEFORMATION_COUNT> NAMES = { "flattened", "pushed_through", "crumpled", "inverted" };

// Weightless: nothing but the body itself brings its shape back.
StressScene ruined_in_flight(const StressSetup &setup, int kind) {
	StressScene scene(std::string("start/") + NAMES[std::size_t(kind)], weightless_world());
	for (int i = 0; i < 6; ++i) {
		SoftBodyData body = stress_ball({ Real(400 * i), 0 }, setup);
		Random random(1000 * setup.seed + std::uint64_t(100 * kind + i));
		deform(body, Deformation(kind), random);
		scene.world.add_soft_body(std::move(body));
	}
	scene.seconds = 10;
	scene.judge = [](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		verdict.at_most("deviation", worst_deviation(world), VISIBLE);
		// Semi-implicit methods conserve an energy that differs from the true one by a share of hΩ, at most 1.3 here.
		verdict.at_most("energy over start", log.most_energy / log.start_energy, 1.5);
	};
	return scene;
}

StressScene ruined_on_the_floor(const StressSetup &setup, int kind) {
	StressScene scene(std::string("start_on_floor/") + NAMES[std::size_t(kind)], pixel_world());
	scene.world.add_border(floor_at(0));
	for (int i = 0; i < 6; ++i) {
		SoftBodyData body = stress_ball({ Real(400 * i), -52 }, setup);
		Random random(1000 * setup.seed + std::uint64_t(100 * kind + i));
		deform(body, Deformation(kind), random);
		scene.world.add_soft_body(std::move(body));
	}
	scene.seconds = 10;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		// One turned inside out springs back against the floor and may roll away. A hull of 16 points bobs as it rolls.
		verdict.rests("vertical speed", worst_vertical_speed(world), 40); // a hop of 0.8 px
	};
	return scene;
}

// Everything about them at random: structure, state, what they lie in.
StressScene random_heap(const StressSetup &setup) {
	StressScene scene("start/random", pixel_world());
	add_box_borders(scene.world, { 400, 300 });
	Random random(1000 * setup.seed + 7);
	for (int i = 0; i < 12; ++i) {
		const int count = random.integer(6, 20);
		std::vector<Vec2> hull;
		for (int k = 0; k < count; ++k) {
			const Real angle = Real(6.2831853) * (Real(k) + random.real(0, 0.5)) / Real(count);
			hull.push_back(Rotation::from_angle(angle).apply({ random.real(30, 50), 0 }));
		}
		SoftBodyData body = stress_body(hull, random.vector(200), setup, { random.real(0.5, 2), random.real(100, 2000) });
		for (std::uint32_t k = 0; k < body.point_count(); ++k) {
			const Vec2 place = body.positions()[k] + random.vector(15);
			body.set_point(k, place, random.vector(500));
		}
		scene.world.add_soft_body(std::move(body));
	}
	scene.seconds = 12;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_least("area", least_area_share(world), 0.6);
		verdict.at_most("overlap", worst_overlap(world), 2 * VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.rests("speed", worst_speed(world), 50);
	};
	return scene;
}

} // namespace

std::vector<StressScene> start_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	for (int kind = 0; kind < DEFORMATION_COUNT; ++kind) {
		scenes.push_back(ruined_in_flight(setup, kind));
		scenes.push_back(ruined_on_the_floor(setup, kind));
	}
	scenes.push_back(random_heap(setup));
	return scenes;
}

} // namespace softbody::testing
