// SPDX-License-Identifier: MIT
// What presses on bodies: a hundred others, closing walls, funnels, gravity out of bounds.
#include "scenes/stress/bodies.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace softbody::testing {

namespace {

double top_of(const WorldData &world) {
	double top = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		top = std::min(top, double(measure_frame(body).center.y));
	}
	return top;
}

// Soft squares in a shaft. The lowest carries all others by the sizing rule; so do they all, as they are alike.
StressScene stack(const StressSetup &setup) {
	const int count = setup.quick ? 20 : 100;
	StressScene scene(scene_name("load/stack", count), pixel_world());
	add_box_borders(scene.world, { 30, 50000 });
	scene.world.add_border(floor_at(0));
	const std::vector<Vec2> hull = box_hull({ 50, 50 }, 25).value();
	const Stuff stuff{ 1, carrying_stiffness(Real(count), hull.size(), 25) };
	for (int i = 0; i < count; ++i) {
		scene.world.add_soft_body(stress_body(hull, { Real(i % 2 == 0 ? 0 : 2), Real(-25.5 - 50.5 * i) }, setup, stuff));
	}
	scene.seconds = setup.quick ? 16 : 10;
	// Where all were a second before the end, and how far the top went up and down in each two seconds, which is the period of
	// the slowest swing of 100.
	struct Seen {
		std::vector<Vec2> then;
		std::vector<std::pair<double, double>> tops;
	};
	auto seen = std::make_shared<Seen>();
	scene.after_tick = [seen, last = scene.seconds - 1](const WorldData &world, double time) {
		if (seen->then.empty() && time >= last) {
			for (const SoftBodyData &body : world.soft_bodies()) {
				seen->then.push_back(measure_frame(body).center);
			}
		}
		const std::size_t window = std::size_t((time - 1e-6) / 2);
		seen->tops.resize(window + 1, { 0, -std::numeric_limits<double>::infinity() });
		auto &[highest, lowest] = seen->tops[window];
		highest = std::min(highest, top_of(world));
		lowest = std::max(lowest, top_of(world));
	};
	scene.judge = [count, seen](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), 2 * VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), verdict.promises_rest() ? 0.85 : 0.8);
		const double height = 50.0 * (count - 0.5);
		verdict.at_least("height over that of rigid boxes", -top_of(world) / height, 0.85);
		double way = 0;
		for (std::size_t i = 0; i < world.soft_bodies().size(); ++i) {
			way = std::max(way, distance(measure_frame(world.soft_bodies()[i]).center, seen->then[i]));
		}
		if (count <= 20) {
			// It has all but settled by then (measured: 0.3 to 1.1 px), and falls asleep within 25 s at 60 ticks or more.
			verdict.rests("way in the last second", way, 2);
			return;
		}
		// 100, 5000 px high, go on breathing, ever less: the slowest swing is hardly damped (docs/limits.md).
		std::vector<double> swings;
		for (const auto &[highest, lowest] : seen->tops) {
			swings.push_back(lowest - highest);
		}
		verdict.rests("swing in the last two seconds over the height", swings.back() / height, 0.03);
		verdict.rests("the same over the largest swing", swings.back() / *std::ranges::max_element(swings), 0.5);
	};
	return scene;
}

// Two walls close until nothing is left between them, wait, and open again.
StressScene squeeze(const StressSetup &setup, bool has_lid, double least_gap) {
	StressScene scene(scene_name(has_lid ? "load/squeeze_closed" : "load/squeeze_open", least_gap), pixel_world());
	scene.world.add_border(floor_at(0));
	if (has_lid) {
		scene.world.add_border({ { { 0, -110 }, { 0, 1 } }, {} });
	}
	for (const Real side : { Real(-1), Real(1) }) {
		RigidBody wall;
		wall.pose.position = { side * 100, 0 };
		Collider box = box_collider({ side * 40, -200 }, { 40, 220 });
		box.rigid_body = scene.world.add_rigid_body(wall).value();
		scene.world.add_collider(box);
	}
	scene.world.add_soft_body(stress_ball({ 0, -51 }, setup, { 1, 200 }));
	scene.seconds = 10;
	scene.before_tick = [least_gap](WorldData &world, double time, Real dt) {
		const auto gap = [least_gap](double t) {
			const double closed = std::clamp(t < 3 ? t / 2 : (5 - t) / 2, 0.0, 1.0);
			return 200 + (least_gap - 200) * closed;
		};
		for (const std::uint32_t i : { 0u, 1u }) {
			RigidBody wall = world.rigid_bodies()[i];
			const Real side = i == 0 ? Real(-1) : Real(1);
			wall.linear_velocity = { side * Real((gap(time + double(dt)) - gap(time)) / 2 / double(dt)), 0 };
			world.set_rigid_body(i, wall);
		}
	};
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.at_most("deviation", worst_deviation(world), 0.2);
		verdict.rests("speed", worst_speed(world), 20);
	};
	return scene;
}

StressScene funnel(const StressSetup &setup, double gap) {
	StressScene scene(scene_name("load/funnel", gap), pixel_world());
	for (const Real side : { Real(-1), Real(1) }) {
		Collider wall;
		wall.radius = 2; // see docs/decisions/environment-contacts.md for lines without thickness
		wall.surface.friction = Real(0.2);
		const Real lip = side * Real(gap * JELLY_RADIUS + 2);
		const std::vector<Vec2> points = { { lip, 0 }, { lip + side * 200, -200 }, { lip + side * 200, -800 } };
		scene.world.add_chain(points, false, wall);
	}
	scene.world.add_border(floor_at(400));
	scene.world.add_soft_body(stress_ball({ 10, -200 }, setup, { 1, 100 }));
	scene.seconds = 12;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		const SoftBodyData &body = world.soft_bodies()[0];
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.holds("in its shape", !is_folded(body.hull()));
		verdict.at_least("area", area_share(body), 0.75); // wedged
		const Vec2 center = measure_frame(body).center;
		verdict.holds("between the walls or below them", center.y > 0 || std::abs(center.x) < 40 - center.y);
		verdict.rests("speed", worst_speed(world), 20);
	};
	return scene;
}

StressScene wild_gravity(const StressSetup &setup, const char *name, Real first, Real second) {
	StressScene scene(std::string("gravity/") + name, pixel_world());
	add_box_borders(scene.world, { 300, 300 });
	for (int i = 0; i < 8; ++i) {
		scene.world.add_soft_body(stress_ball({ Real(-160 + 105 * (i % 4)), Real(220 - 105 * (i / 4)) }, setup,
				{ 1, carrying_stiffness(20, JELLY_HULL_POINTS, JELLY_RADIUS) }));
	}
	scene.seconds = 20;
	scene.before_tick = [first, second](WorldData &world, double time, Real) {
		const Real factor = time > 6 ? Real(1) : std::fmod(time, 2) < 1 ? first : second;
		world.set_gravity({ 0, factor * PIXEL_GRAVITY });
	};
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.rests("speed", worst_speed(world), 30);
	};
	return scene;
}

} // namespace

std::vector<StressScene> load_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	scenes.push_back(stack(setup));
	for (const double gap : { 30.0, 2.0, 0.0 }) {
		scenes.push_back(squeeze(setup, false, gap));
		scenes.push_back(squeeze(setup, true, gap));
	}
	for (const double gap : { 0.5, 0.8, 1.1 }) {
		scenes.push_back(funnel(setup, gap));
	}
	scenes.push_back(wild_gravity(setup, "tenfold", 10, 1));
	scenes.push_back(wild_gravity(setup, "reversed", 1, -1));
	scenes.push_back(wild_gravity(setup, "tenfold_reversed", 10, -10));
	return scenes;
}

} // namespace softbody::testing
