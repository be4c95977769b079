// SPDX-License-Identifier: MIT
// Outlines of hundreds of points, simulated as drawn and by the few points that keep them within a tolerance: error and time.
#include "bench.h"
#include "detail_scenes.h"

#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/skin/outline_binding.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::Vec2;

// Bodies of the timed scene, which lie awake in two layers between walls, and how long it is.
constexpr int COLUMNS = 4;
constexpr int ROWS = 2;
constexpr double SPACING = 150; // px
constexpr double SECONDS = 4;
constexpr double QUICK_SECONDS = 1.5;
constexpr int REPEATS = 3; // of which the fastest counts, A and B in turns
constexpr int FEWER_POINTS = 6; // than the simplified hull has, tried for the over-modelling ratio
constexpr double SETTLE = 4; // s that a dropped body has to come to rest

softbody::Border wall(Vec2 at, Vec2 normal) {
	softbody::Border border;
	border.plane = { at, normal };
	return border;
}

// Microseconds a body a tick, the median of the second half of the scene: what lies and is pressed.
double time_of(const ElasticBody &kind, double seconds) {
	softbody::WorldData world = weighty_world();
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	check(world.add_border(wall({ 0, 0 }, { 1, 0 })));
	check(world.add_border(wall({ Real(COLUMNS * SPACING), 0 }, { -1, 0 })));
	for (int i = 0; i < COLUMNS * ROWS; ++i) {
		softbody::Pose pose;
		pose.position = { Real((i % COLUMNS + 0.5) * SPACING), Real(-SPACING * (0.6 + i / COLUMNS)) };
		world.add_soft_body(take(softbody::SoftBodyData::create(kind.shape, kind.settings, pose)));
	}
	softbody::Simulator simulator(world);
	std::vector<Duration> times;
	const int ticks = int(seconds / TICK);
	for (int tick = 0; tick < ticks; ++tick) {
		const Stopwatch watch;
		simulator.simulate(Real(TICK));
		if (tick >= ticks / 2) {
			times.push_back(watch.elapsed());
		}
	}
	return times_of(times).cpu.median * 1e6 / (COLUMNS * ROWS);
}

// The points of a body that was dropped on a floor and has come to rest.
Points settled(const ElasticBody &kind) {
	softbody::WorldData world = weighty_world();
	check(world.add_border(wall({ 0, 0 }, { 0, -1 })));
	softbody::Pose pose;
	pose.position = { 0, -100 };
	const softbody::BodyId id = world.add_soft_body(take(softbody::SoftBodyData::create(kind.shape, kind.settings, pose)));
	softbody::Simulator simulator(world);
	for (int tick = 0; tick < int(SETTLE / TICK); ++tick) {
		simulator.simulate(Real(TICK));
	}
	const softbody::SoftBodyData &body = *world.find(id);
	return Points(body.hull().begin(), body.hull().end());
}

json measure(const OutlineKind &kind, double tolerance, const Options &options) {
	const bool has_deep_dents = softbody::has_deep_dents(kind.outline);
	const double radius = softbody::radius_of_area(kind.outline);
	softbody::SimplifyOptions simplify;
	simplify.tolerance = tolerance;
	const Stopwatch watch;
	const softbody::SimplifiedOutline made = softbody::simplify_outline(kind.outline, simplify).value();
	const double simplify_ms = watch.elapsed().cpu * 1e3;
	const ElasticBody full = outline_body(kind.outline, has_deep_dents);
	const ElasticBody few = outline_body(made.hull, has_deep_dents);
	const double seconds = options.quick ? QUICK_SECONDS : SECONDS;
	double full_us = 1e30;
	double few_us = 1e30;
	for (int repeat = 0; repeat < (options.quick ? 1 : REPEATS); ++repeat) {
		full_us = std::min(full_us, time_of(full, seconds));
		few_us = std::min(few_us, time_of(few, seconds));
	}
	// The cheapest hull of fewer points that is still within the tolerance, where there is one.
	double cheapest_us = few_us;
	for (int fewer = 1; fewer <= FEWER_POINTS; ++fewer) {
		softbody::SimplifyOptions counted = simplify;
		counted.most_points = int(made.hull.size()) - fewer;
		const softbody::SimplifiedOutline other = softbody::simplify_outline(kind.outline, counted).value();
		if (!other.is_outline && other.error <= tolerance) {
			cheapest_us = std::min(cheapest_us, time_of(outline_body(other.hull, has_deep_dents), seconds));
		}
	}
	const Points full_rest = settled(full);
	const softbody::OutlineBinding binding(kind.outline, made.hull, made.places);
	Points drawn(kind.outline.size());
	const Points few_rest = settled(few);
	const Stopwatch placing;
	constexpr int PLACINGS = 1000;
	for (int i = 0; i < PLACINGS; ++i) {
		binding.place(few_rest, drawn);
	}
	const double place_us = placing.elapsed().cpu * 1e6 / PLACINGS;
	// Where the bodies lie is not compared, how they lie is.
	Points drawn_there = drawn;
	const Vec2 shift = softbody::area_centroid(full_rest) - softbody::area_centroid(drawn);
	for (Vec2 &p : drawn_there) {
		p = p + Vec2{ shift.x, 0 };
	}
	return { { "outline", kind.name }, { "tolerance_percent", 100 * tolerance }, { "points_drawn", kind.outline.size() },
		{ "points_simulated", made.hull.size() }, { "bound_percent", 100 * made.error },
		{ "outline_error_percent", 100 * outline_distance(kind.outline, made.hull) / radius },
		{ "area_error", std::abs(double(softbody::signed_area(made.hull)) / double(softbody::signed_area(kind.outline)) - 1) },
		{ "centroid_error", double(length(softbody::area_centroid(made.hull) - softbody::area_centroid(kind.outline))) / radius },
		{ "settled_error_percent", 100 * outline_distance(full_rest, drawn_there) / radius }, { "as_drawn_us", full_us },
		{ "simulated_us", few_us }, { "speedup", full_us / few_us }, { "over_modelling_ratio", few_us / cheapest_us }, { "place_us", place_us }, { "simplify_ms", simplify_ms } };
}

} // namespace

json detail(const Options &options) {
	json rows = json::array();
	const std::vector<double> tolerances = options.quick ? std::vector<double>{ DETAIL_TOLERANCE } : std::vector<double>{ 0.01, DETAIL_TOLERANCE, 0.1 };
	for (const OutlineKind &kind : fine_outlines(options.quick)) {
		for (const double tolerance : tolerances) {
			rows.push_back(measure(kind, tolerance, options));
		}
	}
	return { { "bodies", COLUMNS * ROWS }, { "rows", rows }, { "levels", detail_levels(options) }, { "refinement", detail_refinement(options) },
		{ "crowd", detail_crowd(options) } };
}

} // namespace bench
