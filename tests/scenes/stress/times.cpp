// SPDX-License-Identifier: MIT
// Ticks that last too long, hardly anything, or nothing.
#include "scenes/stress/bodies.h"

namespace softbody::testing {

namespace {

WorldData heap(const StressSetup &setup) {
	WorldData world = pixel_world();
	add_box_borders(world, { 250, 300 });
	for (int i = 0; i < 6; ++i) {
		world.add_soft_body(stress_ball({ Real(-120 + 110 * (i % 3)), Real(240 - 110 * (i / 3)) }, setup, { 1, 400 }));
	}
	return world;
}

void judge_heap(const WorldData &world, StressVerdict &verdict) {
	verdict.at_most("overlap", worst_overlap(world), 2 * VISIBLE);
	verdict.at_most("penetration", worst_penetration(world), VISIBLE);
	verdict.at_least("area", least_area_share(world), 0.85);
}

// One tick of a second, while bodies fall and while they rest.
StressScene hitch(const StressSetup &setup, double when) {
	StressScene scene(scene_name("time/hitch_at", when), heap(setup));
	const int at = int(when * setup.rate);
	scene.time_step = [at](int tick, Real dt) { return tick == at ? Real(1) : dt; };
	scene.seconds = 14;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		judge_heap(world, verdict);
		verdict.rests("speed", worst_speed(world), 30);
	};
	return scene;
}

StressScene time_scale(const StressSetup &setup, double scale) {
	StressScene scene(scene_name("time/scale", scale), heap(setup));
	scene.time_step = [scale](int, Real dt) { return Real(scale) * dt; };
	scene.seconds = scale < 1 ? 0.1 : 10;
	const double start = scene.world.soft_bodies()[0].positions()[0].y;
	scene.judge = [scale, start](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		judge_heap(world, verdict);
		if (scale == 0) {
			verdict.holds("refused in every step", log.refused > 0 && double(log.time) > 0);
			verdict.holds("where it was", double(world.soft_bodies()[0].positions()[0].y) == start);
		} else {
			verdict.at_most("refused steps", log.refused, 0);
		}
		if (scale > 1) {
			verdict.rests("speed", worst_speed(world), 30);
		}
	};
	return scene;
}

} // namespace

std::vector<StressScene> time_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	for (const double when : { 0.1, 0.4, 3.0 }) {
		scenes.push_back(hitch(setup, when));
	}
	for (const double scale : { 0.0, 0.01, 10.0 }) {
		scenes.push_back(time_scale(setup, scale));
	}
	return scenes;
}

} // namespace softbody::testing
