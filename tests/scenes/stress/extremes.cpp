// SPDX-License-Identifier: MIT
// Spin, sizes, places and pins out of the ordinary.
#include "scenes/stress/bodies.h"
#include "thesis/momentum.h"

namespace softbody::testing {

namespace {

constexpr Real SPIN = 50; ///< [rad/s]

void set_spin(SoftBodyData &body, Real spin) {
	const Vec2 center = measure_frame(body).center;
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], perpendicular(body.positions()[i] - center) * spin);
	}
}

// Held together by more than it takes: m ω² R is 42 N/m times R for each point.
StressScene spinning_free(const StressSetup &setup, double stiffness) {
	StressScene scene(scene_name("spin/free_k", stiffness), weightless_world());
	SoftBodyData body = stress_ball({ 0, 0 }, setup, { 1, Real(stiffness) });
	set_spin(body, SPIN);
	const double momentum = measure_momentum(body).angular;
	scene.world.add_soft_body(std::move(body));
	scene.judge = [momentum](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		const SoftBodyData &body = world.soft_bodies()[0];
		verdict.at_most("change of angular momentum", std::abs(measure_momentum(body).angular / momentum - 1), 0.01);
		verdict.at_most("energy over start", log.most_energy / log.start_energy, 1.1);
		verdict.at_least("area", area_share(body), 0.99);
		verdict.holds("in its shape", !is_folded(body.hull()));
	};
	return scene;
}

StressScene spinning_on_floor(const StressSetup &setup) {
	StressScene scene("spin/on_floor", pixel_world());
	add_box_borders(scene.world, { 400, 400 });
	SoftBodyData body = stress_ball({ 0, 348 }, setup, { 1, 1000 });
	set_spin(body, SPIN);
	scene.world.add_soft_body(std::move(body));
	scene.seconds = 8;
	scene.judge = [](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.at_most("energy gained over start", (log.most_motion - log.start_motion) / 3e6, 0.05); // of its spin
	};
	return scene;
}

StressScene tiny(const StressSetup &setup) {
	StressScene scene("size/tiny_64_points", pixel_world());
	scene.world.add_border(floor_at(0));
	scene.world.add_soft_body(stress_ball({ 0, -20 }, setup, { 1, carrying_stiffness(1, 64, 2) }, 2, 64));
	scene.seconds = 6;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), 20);
		// Its edges are 0.2 px long: what trembles by a tenth of that may cross them.
		verdict.holds("in its shape", !verdict.promises_rest() || !is_folded(world.soft_bodies()[0].hull()));
	};
	return scene;
}

StressScene tiny_pile(const StressSetup &setup) {
	StressScene scene("size/tiny_pile", pixel_world());
	add_box_borders(scene.world, { 8, 500 });
	scene.world.add_border(floor_at(0));
	for (int i = 0; i < 12; ++i) {
		scene.world.add_soft_body(stress_ball({ Real(-4.5 + 4.5 * (i % 3)), Real(-2.2 - 4.5 * (i / 3)) }, setup,
				{ 1, carrying_stiffness(8, 16, 2) }, 2, 16));
	}
	scene.seconds = 6;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), 2 * VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), 20);
	};
	return scene;
}

StressScene thousand_points(const StressSetup &setup) {
	StressScene scene("size/hull_of_1000", pixel_world());
	scene.world.add_border(floor_at(0));
	scene.world.add_soft_body(stress_ball({ 0, -260 }, setup, { 1, 20 }, 200, 1000));
	scene.seconds = 5;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.rests("speed", worst_speed(world), 20);
	};
	return scene;
}

// In single precision places are a sixteenth of a pixel apart here.
StressScene far_away(const StressSetup &setup, double place) {
	StressScene scene(scene_name("place/px", place), pixel_world());
	const Vec2 base{ Real(place), Real(place) };
	scene.world.add_border({ { base, { 0, -1 } }, {} });
	for (const Real side : { Real(-1), Real(1) }) {
		scene.world.add_collider(box_collider(base + Vec2{ 65 + side * 160, -200 }, { 20, 300 }));
	}
	for (int i = 0; i < 4; ++i) {
		scene.world.add_soft_body(stress_ball(base + Vec2{ Real(130 * (i / 2)), Real(-60 - 110 * (i % 2)) }, setup, { 1, 200 }));
	}
	scene.seconds = 8;
	// A point that trembles by the distance between two numbers in each of four substeps shows such a speed.
	const double rounding = place * EPSILON * 4 * setup.rate;
	scene.judge = [place, rounding](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), std::max(20.0, rounding));
		for (const SoftBodyData &body : world.soft_bodies()) {
			verdict.at_most("way from the middle", std::abs(double(measure_frame(body).center.x) - place - 65), 140);
		}
	};
	return scene;
}

// A pin is somewhere else from one tick to the next, again and again; a neighbor looks on.
StressScene pin_jumps(const StressSetup &setup, bool by_target) {
	StressScene scene(std::string("pins/") + (by_target ? "sent_across" : "set_across"), pixel_world());
	scene.world.add_border(floor_at(500));
	SoftBodyData body = stress_ball({ 0, 0 }, setup, { 1, 400 });
	BodySettings settings = body.settings();
	settings.linear_damp = 3; // or it would swing about the pin for long
	settings.angular_damp = 3;
	body.set_settings(settings);
	body.set_pinned(12, true);
	scene.world.add_soft_body(std::move(body));
	scene.world.add_soft_body(stress_ball({ 1000, 448 }, setup));
	scene.seconds = 8;
	auto jumps = std::make_shared<int>(0);
	scene.before_tick = [jumps, by_target](WorldData &world, double time, Real) {
		if (time < *jumps || *jumps >= 4) {
			return;
		}
		SoftBodyData &pinned = world.soft_bodies()[0];
		const Vec2 place{ *jumps % 2 == 0 ? Real(2000) : Real(0), Real(-50) };
		if (by_target) {
			pinned.set_pin_target(12, place);
		} else {
			pinned.set_point(12, place, {});
		}
		++*jumps;
	};
	scene.allowed_resets = 1000; // a target that no body can follow tears it: it is put back beside its pin
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		const SoftBodyData &pinned = world.soft_bodies()[0];
		verdict.at_most("distance of the pin from where it is to be", distance(pinned.positions()[12], { 0, -50 }), 0.01);
		verdict.at_most("distance of the body from its pin", distance(measure_frame(pinned).center, { 0, -50 }), 60);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("way of the neighbor", distance(measure_frame(world.soft_bodies()[1]).center, { 1000, 450 }), 10);
	};
	return scene;
}

} // namespace

std::vector<StressScene> extreme_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	scenes.push_back(spinning_free(setup, 100));
	scenes.push_back(spinning_free(setup, 1000));
	scenes.push_back(spinning_on_floor(setup));
	scenes.push_back(tiny(setup));
	scenes.push_back(tiny_pile(setup));
	scenes.push_back(thousand_points(setup));
	scenes.push_back(far_away(setup, 0));
	scenes.push_back(far_away(setup, 1e5));
	scenes.push_back(far_away(setup, 1e6));
	scenes.push_back(pin_jumps(setup, true));
	scenes.push_back(pin_jumps(setup, false));
	return scenes;
}

} // namespace softbody::testing
