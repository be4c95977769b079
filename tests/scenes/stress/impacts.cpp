// SPDX-License-Identifier: MIT
// What bodies are thrown at: corners, seams, thin walls, thin bodies, piles.
#include "core/model/internal_edges.h"
#include "scenes/stress/bodies.h"

#include <vector>

namespace softbody::testing {

namespace {

constexpr Real SHOT = 50 * JELLY_RADIUS; ///< 50 radii a second [px/s]

StressScene onto_corner(const StressSetup &setup) {
	StressScene scene("impact/corner", pixel_world());
	scene.world.add_border(floor_at(0));
	scene.world.add_collider({ { { 0, -150 }, { 60, -90 }, { 0, -30 }, { -60, -90 } }, 0, {} });
	scene.world.add_soft_body(stress_ball({ 2, -400 }, setup, { 1, 200 }));
	scene.seconds = 16; // it rolls off the corner with up to 400 px/s, and rolling resistance takes 0.03 g, 29 px/s, a second
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.holds("in its shape", !is_folded(world.soft_bodies()[0].hull()));
		verdict.rests("speed", worst_speed(world), 5);
	};
	return scene;
}

// Rows of square tiles without friction. Marked, as the node marks those of tile maps, the edges between them are known.
void add_tiles(WorldData &world, int from, int to, bool are_marked) {
	std::vector<Collider> tiles;
	for (int i = from; i < to; ++i) {
		tiles.push_back(box_collider({ Real(64 * i + 32), 32 }, { 32, 32 }));
		tiles.back().surface.friction = 0;
	}
	if (are_marked) {
		mark_internal_edges(tiles, Real(0.1));
	}
	for (const Collider &tile : tiles) {
		world.add_collider(tile);
	}
}

StressScene onto_seam(const StressSetup &setup) {
	StressScene scene("impact/tile_seam", pixel_world());
	add_tiles(scene.world, -4, 4, false);
	scene.world.add_soft_body(stress_ball({ 0, -300 }, setup));
	scene.seconds = 6;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.9);
		verdict.rests("way aside", std::abs(double(measure_frame(world.soft_bodies()[0]).center.x)), 25);
	};
	return scene;
}

// It passes 25 seams.
StressScene along_seams(const StressSetup &setup, const char *name, bool are_marked, double least_share) {
	StressScene scene(std::string("impact/") + name, pixel_world());
	add_tiles(scene.world, -4, 40, are_marked);
	SoftBodyData body = stress_ball({ 0, -50 }, setup);
	set_velocity(body, { 400, 0 });
	scene.world.add_soft_body(std::move(body));
	scene.judge = [least_share](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("speed over start", double(measure_frame(world.soft_bodies()[0]).velocity.x) / 400, least_share);
	};
	return scene;
}

StressScene through_wall(const StressSetup &setup, const char *name, const Collider &wall) {
	StressScene scene(std::string("projectile/") + name, weightless_world());
	scene.world.add_collider(wall);
	SoftBodyData body = stress_ball({ -300, 7 }, setup, { 1, 1000 });
	set_velocity(body, { SHOT, 0 });
	scene.world.add_soft_body(std::move(body));
	scene.seconds = 3;
	scene.judge = [](const WorldData &world, const StressLog &log, StressVerdict &verdict) {
		double farthest = -1e9;
		for (const Vec2 p : world.soft_bodies()[0].hull()) {
			farthest = std::max(farthest, double(p.x));
		}
		verdict.at_most("farthest point beyond the wall", farthest, 0);
		verdict.at_most("deviation", worst_deviation(world), VISIBLE);
		verdict.at_most("energy over start", log.most_energy / log.start_energy, 1.05);
	};
	return scene;
}

// A plank as thin as a fifth of the ball's diameter, held at both ends.
StressScene through_thin_body(const StressSetup &setup) {
	StressScene scene("projectile/thin_body", weightless_world());
	const std::vector<Vec2> hull = box_hull({ 20, 300 }, 20).value();
	SoftBodyData plank = stress_body(hull, { 0, 0 }, setup, { 1, 2000, DEFAULT_SHAPE_MATCHING, Real(0.1), false });
	for (std::uint32_t i = 0; i < plank.point_count(); ++i) {
		if (std::abs(plank.positions()[i].y) > 145) {
			plank.set_pinned(i, true);
		}
	}
	scene.world.add_soft_body(std::move(plank));
	SoftBodyData body = stress_ball({ -300, 7 }, setup, { 1, 1000 });
	set_velocity(body, { SHOT, 0 });
	scene.world.add_soft_body(std::move(body));
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.holds("back on the side it came from", measure_frame(world.soft_bodies()[1]).center.x < 0);
		verdict.at_most("deviation", worst_deviation(world), 0.2); // the plank still swings
	};
	return scene;
}

StressScene into_pile(const StressSetup &setup) {
	StressScene scene("projectile/pile", pixel_world());
	add_box_borders(scene.world, { 400, 300 });
	for (int i = 0; i < 10; ++i) {
		scene.world.add_soft_body(stress_ball({ Real(-30 + 105 * (i % 4)), Real(245 - 95 * (i / 4)) }, setup, { 1, 400 }));
	}
	SoftBodyData body = stress_ball({ -340, 150 }, setup, { 2, 1000 });
	set_velocity(body, { SHOT, 0 });
	scene.world.add_soft_body(std::move(body));
	scene.seconds = 8;
	scene.judge = [](const WorldData &world, const StressLog &, StressVerdict &verdict) {
		verdict.at_most("overlap", worst_overlap(world), VISIBLE);
		verdict.at_most("penetration", worst_penetration(world), VISIBLE);
		verdict.at_least("area", least_area_share(world), 0.85);
		verdict.rests("speed", worst_speed(world), 30);
	};
	return scene;
}

} // namespace

std::vector<StressScene> impact_scenes(const StressSetup &setup) {
	std::vector<StressScene> scenes;
	scenes.push_back(onto_corner(setup));
	scenes.push_back(onto_seam(setup));
	// Without friction nothing slows it but seams that catch, each of which costs what one hull point carries, a
	// seventeenth: three of them leave 0.82.
	scenes.push_back(along_seams(setup, "sliding_over_seams", false, 0.8));
	scenes.push_back(along_seams(setup, "sliding_over_marked_seams", true, 0.999)); // nothing but roundings
	scenes.push_back(through_wall(setup, "line", { { { 0, -400 }, { 0, 400 } }, 0, {} }));
	scenes.push_back(through_wall(setup, "thin_box", box_collider({ 2, 0 }, { 2, 400 })));
	scenes.push_back(through_thin_body(setup));
	scenes.push_back(into_pile(setup));
	return scenes;
}

} // namespace softbody::testing
