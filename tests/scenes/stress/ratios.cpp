// SPDX-License-Identifier: MIT
// Heavy against light, stiff against soft: between bodies and within one.
#include "scenes/stress/bodies.h"
#include "thesis/damping_ratio.h"
#include "thesis/momentum.h"

namespace softbody::testing {

namespace {

// A heavy body as stiff for its mass as the light one flies into it without gravity.
StressScene collision_of_masses(const StressSetup &setup, double ratio) {
	StressScene scene(scene_name("mass_ratio/collision", ratio), weightless_world());
	SoftBodyData heavy = stress_ball({ -120, 10 }, setup, { Real(ratio), Real(100 * ratio) });
	set_velocity(heavy, { 250, 0 });
	scene.world.add_soft_body(std::move(heavy));
	scene.world.add_soft_body(stress_ball({ 0, 0 }, setup));
	const double momentum = ratio * 250;
	scene.judge = [momentum](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		double x = 0;
		for (const SoftBodyData &body : world.soft_bodies()) {
			x += measure_momentum(body).linear_x;
		}
		verdict.at_most("change of momentum", std::abs(x / momentum - 1), 1e-3);
		verdict.at_most("energy over start", log.most_energy / log.start_energy, 1.05);
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.at_most("deviation", worst_deviation(world), VISIBLE);
		// Parted: the light one is thrown ahead, or at least not left behind.
		const auto bodies = world.soft_bodies();
		verdict.at_least("way ahead", double(measure_frame(bodies[1]).center.x - measure_frame(bodies[0]).center.x), 90);
	};
	return scene;
}

// One hull point outweighs all others.
StressScene mass_within(const StressSetup &setup, double ratio) {
	StressScene scene(scene_name("mass_ratio/within", ratio), pixel_world());
	const std::vector<Vec2> hull = circle_hull(JELLY_RADIUS, JELLY_HULL_POINTS).value();
	SoftBodyShape::Description description;
	description.points = hull;
	description.points.push_back({});
	description.hull_count = hull.size();
	const Real stiffness = carrying_stiffness(Real(1 + ratio / 17), hull.size(), JELLY_RADIUS);
	description.masses.assign(description.points.size(), Real(1) / 17);
	description.masses[3] *= Real(ratio);
	for (std::uint32_t i = 0; i < hull.size(); ++i) {
		const std::uint32_t next = (i + 1) % std::uint32_t(hull.size());
		description.springs.push_back({ i, next, length(hull[next] - hull[i]), stiffness, Real(0.01) * std::sqrt(stiffness) });
		description.springs.push_back({ i, std::uint32_t(hull.size()), JELLY_RADIUS, stiffness, Real(0.01) * std::sqrt(stiffness) });
	}
	BodySettings settings = stress_settings(setup, { 1, stiffness }, 17);
	settings.shape_damping *= Real(std::sqrt(1 + ratio / 17));
	scene.world.add_border(floor_at(0));
	scene.world.add_soft_body(SoftBodyData::create(SoftBodyShape::create(description).value(), settings, { { 0, -80 }, {} }).value());
	scene.seconds = 8;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.7);
		verdict.rests("speed", worst_speed(world), 20);
	};
	return scene;
}

// Each carries what lies on it by the sizing rule, or far less than that.
StressScene heavy_on_light(const StressSetup &setup, double ratio, bool carries) {
	StressScene scene(scene_name(carries ? "heavy_on_light/carried" : "heavy_on_light/crushed", ratio), pixel_world());
	scene.world.add_border(floor_at(0));
	add_box_borders(scene.world, { 55, 2000 });
	const Real strong = carrying_stiffness(Real(1 + ratio), JELLY_HULL_POINTS, JELLY_RADIUS);
	const Real heavy_stiffness = carrying_stiffness(Real(ratio), JELLY_HULL_POINTS, JELLY_RADIUS);
	scene.world.add_soft_body(stress_ball({ 0, -51 }, setup, { 1, carries ? strong : Real(100) }));
	const BodyId heavy = scene.world.add_soft_body(stress_ball({ 3, -154 }, setup, { Real(ratio), heavy_stiffness }));
	scene.seconds = 12;
	auto worst = std::make_shared<double>(0);
	auto under_load = std::make_shared<double>(0);
	scene.after_tick = [worst, under_load](const WorldData &world, double time) {
		if (time < 5.9) {
			*under_load = area_share(world.soft_bodies()[0]);
			*worst = worst_overlap(world);
		}
	};
	scene.before_tick = [heavy](WorldData &world, double time, Real) {
		if (time > 6 && world.find(heavy)) {
			world.remove_soft_body(heavy);
		}
	};
	scene.judge = [worst, under_load, carries](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		if (carries) {
			verdict.at_most("overlap under load", *worst, 2 * VISIBLE);
			verdict.at_least("area under load", *under_load, verdict.promises_rest() ? 0.8 : 0.7); // what trembles sinks in
		}
		// k = 100 sags by a fiftieth under itself.
		verdict.at_least("area after release", least_area_share(world), 0.9);
		verdict.at_most("deviation after release", worst_deviation(world), 0.2);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
	};
	return scene;
}

// A jelly and one far stiffer fall onto each other.
StressScene stiffness_between(const StressSetup &setup, double ratio, bool stiff_on_top) {
	StressScene scene(scene_name(stiff_on_top ? "stiffness_ratio/above" : "stiffness_ratio/below", ratio), pixel_world());
	add_box_borders(scene.world, { 60, 2000 });
	scene.world.add_border(floor_at(0));
	const Real soft = carrying_stiffness(2, JELLY_HULL_POINTS, JELLY_RADIUS);
	for (const int i : { 0, 1 }) {
		const bool is_stiff = (i == 1) == stiff_on_top;
		scene.world.add_soft_body(stress_ball({ Real(4 * i), Real(-60 - 130 * i) }, setup, { 1, is_stiff ? soft * Real(ratio) : soft }));
	}
	scene.seconds = 8;
	scene.judge = [](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), 20);
		// They fall 60 and 180 px: more than that much energy came from nowhere.
		verdict.at_most("energy gained", log.most_motion - log.start_motion, 0.05 * 980 * 240);
	};
	return scene;
}

// Springs of one body, every third stiffer than the others.
StressScene stiffness_within(const StressSetup &setup, double ratio) {
	StressScene scene(scene_name("stiffness_ratio/within", ratio), pixel_world());
	StructureOptions options{ 1, carrying_stiffness(1, JELLY_HULL_POINTS, JELLY_RADIUS), 0, true };
	for (int i = 0; i < 2 * JELLY_HULL_POINTS; ++i) {
		const bool is_stiff = i % 3 == 0;
		options.spring_stiffness_scales.push_back(is_stiff ? Real(ratio) : Real(1));
		options.spring_damping_scales.push_back(is_stiff ? std::sqrt(Real(ratio)) : Real(1));
	}
	options.damping = damping_for_ratio(Real(0.1), options.stiffness, 1, 17);
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, options).value();
	scene.world.add_border(floor_at(0));
	scene.world.add_soft_body(SoftBodyData::create(shape, stress_settings(setup, { 1, options.stiffness }, 17), { { 0, -120 }, {} }).value());
	scene.seconds = 8;
	scene.judge = [](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), 20);
		verdict.at_most("energy gained", log.most_motion - log.start_motion, 0.05 * 980 * 120);
	};
	return scene;
}

} // namespace

std::vector<StressScene> ratio_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	for (const double ratio : { 1.0, 10.0, 100.0, 1e3, 1e4 }) {
		scenes.push_back(collision_of_masses(setup, ratio));
		scenes.push_back(mass_within(setup, ratio));
	}
	for (const double ratio : { 10.0, 100.0 }) {
		scenes.push_back(heavy_on_light(setup, ratio, true));
		scenes.push_back(heavy_on_light(setup, ratio, false));
	}
	for (const double ratio : { 1.0, 100.0, 1e4, 1e6 }) {
		scenes.push_back(stiffness_between(setup, ratio, false));
		scenes.push_back(stiffness_between(setup, ratio, true));
		scenes.push_back(stiffness_within(setup, ratio));
	}
	return scenes;
}

} // namespace softbody::testing
