// SPDX-License-Identifier: MIT
// Bodies that start on top of each other, inside out through each other, or pressed together: they must part.
#include "scenes/stress/bodies.h"

namespace softbody::testing {

namespace {

// Bodies that have their shape may still roll off one another.
void judge_parted(const WorldData &world, const StressLog &, StressVerdict &verdict) {
	verdict.at_least("area", least_area_share(world), 0.6);
	verdict.at_most("overlap", worst_overlap(world), 2 * VISIBLE);
	verdict.at_most("penetration", worst_penetration(world), VISIBLE);
}

// As a game does that makes bodies faster than it moves them away.
StressScene spawned_together(const StressSetup &setup) {
	StressScene scene("tangle/spawned_together", pixel_world());
	add_box_borders(scene.world, { 300, 300 });
	Random random(1000 * setup.seed + 11);
	for (int i = 0; i < 8; ++i) {
		scene.world.add_soft_body(stress_ball(random.vector(5), setup));
	}
	scene.seconds = 10;
	scene.judge = judge_parted;
	return scene;
}

// Two walls press four bodies to 40 % of their size and go back.
StressScene pressed_together(const StressSetup &setup) {
	StressScene scene("tangle/pressed_together", pixel_world());
	scene.world.add_border(floor_at(0));
	Random random(1000 * setup.seed + 12);
	for (const Real side : { Real(-1), Real(1) }) {
		RigidBody wall;
		wall.pose.position = { side * 110, 0 };
		Collider box = box_collider({ side * 40, -200 }, { 40, 220 });
		box.rigid_body = scene.world.add_rigid_body(wall).value();
		scene.world.add_collider(box);
	}
	scene.world.add_border({ { { 0, -220 }, { 0, 1 } }, {} });
	for (int i = 0; i < 4; ++i) {
		const Vec2 place{ Real(i % 2 == 0 ? -52 : 52), Real(i / 2 == 0 ? -52 : -158) };
		scene.world.add_soft_body(stress_ball(place + random.vector(5), setup));
	}
	scene.seconds = 14;
	scene.before_tick = [](WorldData &world, double time, Real dt) {
		const auto gap = [](double t) { return 220 * (1 - 0.6 * std::clamp(t < 2 ? t : (4 - t), 0.0, 1.0)); };
		for (const std::uint32_t i : { 0u, 1u }) {
			RigidBody wall = world.rigid_bodies()[i];
			const Real side = i == 0 ? Real(-1) : Real(1);
			wall.linear_velocity = { side * Real((gap(time + double(dt)) - gap(time)) / 2 / double(dt)), 0 };
			world.set_rigid_body(i, wall);
		}
	};
	scene.judge = judge_parted;
	return scene;
}

// Every second one is turned inside out where another lies.
StressScene inside_out_through_each_other(const StressSetup &setup) {
	StressScene scene("tangle/inside_out", pixel_world());
	add_box_borders(scene.world, { 300, 300 });
	Random random(1000 * setup.seed + 13);
	for (int i = 0; i < 6; ++i) {
		SoftBodyData body = stress_ball(Vec2{ Real(i / 2 - 1) * 120, 100 } + random.vector(30), setup);
		if (i % 2 == 0) {
			deform(body, Deformation(random.integer(0, DEFORMATION_COUNT - 1)), random);
		} else {
			deform(body, Deformation::MIRRORED, random);
		}
		scene.world.add_soft_body(std::move(body));
	}
	scene.seconds = 10;
	scene.judge = judge_parted;
	return scene;
}

} // namespace

std::vector<StressScene> tangle_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	scenes.push_back(spawned_together(setup));
	scenes.push_back(pressed_together(setup));
	scenes.push_back(inside_out_through_each_other(setup));
	return scenes;
}

} // namespace softbody::testing
