// SPDX-License-Identifier: MIT
// Whether piles of bodies stay apart and come to rest, and what a step of one costs.
#include "bench.h"
#include "soft_pile.h"

#include "core/geometry/polygon.h"
#include "thesis/polygon_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;

constexpr int RATE = 60;
constexpr double SLOW = 0.05; // m/s
constexpr double REST_SHARE = 0.99;
constexpr int REST_STEPS = RATE / 2;

struct Case {
	std::size_t bodies;
	int rows;
	double heavy; ///< mass of every second body, over that of the others
	int seconds;
};

SoftPileSettings settings_of(const Case &c, const PileScene &scene) {
	SoftPileSettings settings = default_settings(carrying_stiffness(scene, (1 + c.heavy) / 2));
	settings.heavy = c.heavy;
	return settings;
}

// The same pile once more, in which bodies may fall asleep: after what time most have, and what a step then costs.
json run_to_sleep(const Case &c) {
	const PileScene scene = centered(pile_scene(c.bodies, c.rows));
	SoftPileSettings settings = settings_of(c, scene);
	settings.may_sleep = true;
	SoftPile pile(scene, settings);
	std::size_t most = 0;
	for (int i = 0; i < c.seconds * RATE; ++i) {
		pile.step();
		most = std::max(most, pile.report().sleeping_bodies);
		if (double(pile.report().sleeping_bodies) >= REST_SHARE * double(c.bodies)) {
			const StepTimes asleep = pile.run(REST_STEPS);
			return { { "seconds_to_sleep", double(i + 1) / RATE }, { "most_asleep", most },
				{ "asleep_ns", asleep.cpu.median * 1e9 / double(c.bodies) } };
		}
	}
	return { { "seconds_to_sleep", nullptr }, { "most_asleep", most }, { "asleep_ns", nullptr } };
}

json run_case(const Case &c) {
	const PileScene scene = centered(pile_scene(c.bodies, c.rows));
	const SoftPileSettings settings = settings_of(c, scene);
	SoftPile pile(scene, settings);
	std::vector<Duration> times;
	int slow_steps = 0;
	json seconds_to_rest = nullptr;
	double energy_at_rest = 0; // over the last second
	for (int i = 0; i < c.seconds * RATE; ++i) {
		times.push_back(pile.step());
		slow_steps = pile.share_slower(SLOW) >= REST_SHARE ? slow_steps + 1 : 0;
		if (slow_steps == REST_STEPS && seconds_to_rest.is_null()) {
			seconds_to_rest = double(i + 1 - REST_STEPS) / RATE;
		}
		if (i >= (c.seconds - 1) * RATE) {
			energy_at_rest += pile.kinetic_energy() / RATE;
		}
	}
	const StepTimes whole = times_of(times);
	const StepTimes settled = times_of(std::span(times).last(times.size() / 4));
	const double ns = 1e9 / double(c.bodies);
	json row = { { "bodies", c.bodies }, { "rows", c.rows }, { "mass_ratio", c.heavy }, { "seconds", c.seconds },
		{ "settings", to_json(settings) }, { "contact_substeps", pile.contact_substeps() },
		{ "ns_per_body_step", whole.cpu.mean * ns }, { "worst_ns", whole.cpu.worst * ns },
		{ "settled_median_ns", settled.cpu.median * ns }, { "settled_least_ns", settled.cpu.least * ns },
		{ "settled_wall_ns", settled.wall.median * ns }, { "energy_at_rest", energy_at_rest }, { "resets", pile.resets() },
		{ "seconds_to_rest", seconds_to_rest } };
	row.update(run_to_sleep(c));
	row.update(to_json(pile.quality()));
	std::fprintf(stderr, "  %s\n", row.dump().c_str());
	return row;
}

// One light body in a shaft that just holds it, a heavy one on top, at a stiffness that can carry it.
json run_heavy_on_light(double ratio) {
	PileScene scene = centered(pile_scene(2, 2));
	SoftPileSettings settings = default_settings(carrying_stiffness(pile_scene(1, 1), ratio));
	settings.top = ratio;
	SoftPile pile(scene, settings);
	double fastest = 0;
	double deepest = 0;
	double least_distance = 1e30; // of the upper center above the lower one, over R
	double highest = 0; // point of either [m]
	bool folded = false;
	for (int i = 0; i < 10 * RATE; ++i) {
		pile.step();
		const auto bodies = pile.world().soft_bodies();
		for (const softbody::SoftBodyData &body : bodies) {
			folded = folded || softbody::is_folded(body.hull());
			highest = std::max(highest, double(softbody::bounding_box(body.hull()).max.y));
			for (const softbody::Vec2 v : body.velocities()) {
				fastest = std::max(fastest, double(length(v)));
			}
		}
		deepest = std::max(deepest, softbody::penetration_depth(bodies[0].hull(), bodies[1].hull()) / scene.radius);
		const double distance = double(
				softbody::area_centroid(bodies[1].hull()).y - softbody::area_centroid(bodies[0].hull()).y);
		least_distance = std::min(least_distance, distance / scene.radius);
	}
	json result = { { "mass_ratio", ratio }, { "settings", to_json(settings) }, { "fastest", fastest },
		{ "deepest_ever", deepest }, { "least_distance", least_distance },
		{ "highest", highest }, { "ever_folded", folded },
		{ "resets", pile.resets() }, { "energy_at_rest", pile.kinetic_energy() } };
	result.update(to_json(pile.quality()));
	std::fprintf(stderr, "  %s\n", result.dump().c_str());
	return result;
}

} // namespace

json pile(const Options &options) {
	std::vector<Case> cases = { { 30, 10, 1, 20 }, { 30, 10, 10, 20 }, { 300, 10, 1, 20 }, { 300, 10, 10, 20 } };
	if (options.quick) {
		cases.push_back({ 1000, 50, 1, 5 });
	} else {
		cases.insert(cases.end(), { { 3000, 10, 1, 20 }, { 3000, 10, 10, 20 }, { 10000, 10, 1, 20 }, { 10000, 10, 10, 20 },
										  { 1000, 50, 1, 20 } });
	}
	json rows = json::array();
	for (const Case &c : cases) {
		rows.push_back(run_case(c));
	}
	return { { "threads", 1 }, { "slow", SLOW }, { "rows", rows }, { "heavy_on_light", run_heavy_on_light(100) } };
}

} // namespace bench
