// SPDX-License-Identifier: MIT
// Heaps of nodes with their default values between walls: whether bodies keep their shape, whether they sleep, what it costs.
#include "bench.h"
#include "elastic_bodies.h"
#include "soft_pile.h"

#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/aabb.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;
using softbody::SoftBodyData;
using softbody::Vec2;

constexpr int RATE = 60;
// Godot's project settings and the node's own defaults.
constexpr double GRAVITY = 980; // px/s²
constexpr double LINEAR_DAMP = 0.1; // 1/s
constexpr double ANGULAR_DAMP = 1; // 1/s
constexpr double RADIUS = 50; // px
constexpr int POINTS = 16;
constexpr double MASS = 1; // kg
constexpr double FLOOR = 600; // px, where the trial scene has it
constexpr double JITTER = 2; // px by which a seed moves a body at the start, in x and y
constexpr double LONGEST = 40; // s
// A heap whose steps take too long is given up after so much processor time [s], and its row says what was simulated.
constexpr double PATIENCE = 100;
constexpr double QUICK_PATIENCE = 5;
constexpr double FIRM = 10; // times the default's Young's modulus
constexpr double CRUSHED = 0.25; // share of its area below which a body counts as folded
constexpr double RUINED = 0.6; // share of its area below which the trial scene calls a body ruined

enum class Firmness { DEFAULT, SOFT, FIRM };

const char *name_of(Firmness firmness) {
	return firmness == Firmness::DEFAULT ? "default" : firmness == Firmness::SOFT ? "soft" : "firm";
}

softbody::Material material_of(Firmness firmness) {
	softbody::Material material;
	if (firmness == Firmness::FIRM) {
		material.youngs_modulus *= Real(FIRM);
	}
	return material;
}

const ModelChoice &model_of(Firmness firmness) {
	const std::span<const ModelChoice> models = elastic_models();
	return firmness == Firmness::SOFT
			? *std::find_if(models.begin(), models.end(), [](const ModelChoice &c) { return c.is_old_network; })
			: default_model();
}

ElasticBody node(const Points &hull, Firmness firmness, const ModelChoice &model) {
	ElasticBody body = elastic_body(model, hull, MASS, material_of(firmness));
	body.settings.friction = Real(0.4);
	body.settings.rolling_resistance = Real(0.03);
	body.settings.linear_damp = Real(LINEAR_DAMP);
	body.settings.angular_damp = Real(ANGULAR_DAMP);
	body.settings.collision_mask = 1;
	body.settings.can_sleep = true;
	body.settings.self_collision = softbody::has_deep_dents(hull);
	return body;
}

ElasticBody node(const Points &hull, Firmness firmness) {
	return node(hull, firmness, model_of(firmness));
}

struct Place {
	std::size_t body; ///< which of the heap's kinds
	Vec2 at;
};

struct Heap {
	std::string scene;
	int rows_high = 0;
	Firmness firmness = Firmness::DEFAULT;
	int seed = 0; ///< 0: bodies exactly in line
	std::vector<ElasticBody> kinds = {};
	std::vector<Place> places = {};
	double width = 0; ///< px, between the walls
	double seconds = LONGEST; ///< at most
	bool until_asleep = true;
};

softbody::Border wall(Vec2 at, Vec2 normal) {
	softbody::Border border;
	border.plane = { at, normal };
	return border;
}

// Rows of equal bodies, as the trial scene sets them.
void fill(Heap &heap, int columns, int rows, double radius, double step, double rise = 2.1) {
	Random random(std::uint64_t(heap.seed));
	const double jitter = heap.seed == 0 ? 0 : JITTER;
	heap.width = columns * step * radius;
	heap.rows_high = rows;
	for (int i = 0; i < columns * rows; ++i) {
		const double x = (i % columns + 0.5) * step * radius + random.uniform(-jitter, jitter);
		const double y = FLOOR - radius * rise / 2 - (i / columns) * rise * radius + random.uniform(-jitter, jitter);
		heap.places.push_back({ 0, { Real(x), Real(y) } });
	}
}

Heap heap_of(int columns, int rows, Firmness firmness, int seed) {
	Heap heap{ "heap", rows, firmness, seed, { node(circle(RADIUS, POINTS, false), firmness) } };
	fill(heap, columns, rows, RADIUS, 2.05);
	return heap;
}

// What each model costs in company: the bodies do not sleep, and the mean is that of ten seconds.
Heap heap_of_model(const ModelChoice &model, Firmness firmness, int points) {
	Heap heap{ "model " + model.name, 10, firmness, 1, { node(circle(RADIUS, points, false), firmness, model) } };
	heap.kinds[0].settings.can_sleep = false;
	heap.seconds = 10;
	fill(heap, 10, 10, RADIUS, 2.05);
	return heap;
}

// The player's first try, without a seed: `ruined` is judged after 15 s.
Heap trial(int columns, int rows, double radius, double step) {
	Heap heap{ "trial", rows, Firmness::DEFAULT, 0, { node(circle(radius, POINTS, false), Firmness::DEFAULT) } };
	fill(heap, columns, rows, radius, step);
	heap.seconds = 15;
	heap.until_asleep = false;
	return heap;
}

Points star() {
	Points corners;
	for (int i = 0; i < 10; ++i) {
		const double angle = std::numbers::pi * (i / 5.0 - 0.5);
		const double radius = i % 2 == 0 ? RADIUS : RADIUS / 2;
		corners.push_back({ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
	}
	return corners;
}

Heap concave(const std::string &letter, int rows, int seed) {
	constexpr int CORNERS = 13;
	Points corners = star();
	if (letter == "L") {
		corners = { { -40, -40 }, { 0, -40 }, { 0, 0 }, { 40, 0 }, { 40, 40 }, { -40, 40 } };
	} else if (letter == "U") {
		corners = { { -40, -40 }, { -14, -40 }, { -14, 12 }, { 14, 12 }, { 14, -40 }, { 40, -40 }, { 40, 40 }, { -40, 40 } };
	}
	Heap heap{ "concave " + letter, rows, Firmness::DEFAULT, seed, { node(divided(corners, CORNERS), Firmness::DEFAULT) } };
	fill(heap, 10, rows, RADIUS, 2.05);
	return heap;
}

// 300 nodes scaled to radii of 5 to 100 px, each of 1 kg, in shelves from the floor up.
Heap mixed(int seed) {
	Heap heap{ "mixed radii", 0, Firmness::DEFAULT, seed, {} };
	heap.width = 20 * RADIUS;
	Random random{ std::uint64_t(seed) };
	double left = 0;
	double base = 0; // of the shelf, above the floor
	double tallest = 0; // of the shelf
	for (std::size_t i = 0; i < 300; ++i) {
		const double radius = random.uniform(5, 100);
		const double size = 2.1 * radius;
		if (left + size > heap.width) {
			base += tallest;
			left = tallest = 0;
			++heap.rows_high;
		}
		heap.kinds.push_back(node(circle(radius, POINTS, false), Firmness::DEFAULT));
		heap.places.push_back({ i, { Real(left + size / 2), Real(FLOOR - base - size / 2) } });
		left += size;
		tallest = std::max(tallest, size);
	}
	++heap.rows_high;
	return heap;
}

json judge(std::span<const SoftBodyData> bodies) {
	std::size_t folded = 0;
	std::size_t crossed = 0;
	std::size_t ruined = 0;
	double least = 1e30;
	double mean = 0;
	double top = FLOOR;
	for (const SoftBodyData &body : bodies) {
		const double share = double(softbody::signed_area(body.hull())) / double(body.shape().rest_area());
		const bool crosses = softbody::is_self_intersecting(body.hull());
		crossed += crosses ? 1 : 0;
		folded += crosses || !(share >= CRUSHED) ? 1 : 0;
		ruined += !(share >= RUINED) ? 1 : 0;
		least = std::min(least, share);
		mean += share / double(bodies.size());
		top = std::min(top, double(softbody::bounding_box(body.hull()).min.y));
	}
	return { { "folded", folded }, { "crossed", crossed }, { "ruined", ruined }, { "least_area", least }, { "mean_area", mean },
		{ "height_px", FLOOR - top } };
}

json run(const Heap &heap, double patience) {
	softbody::WorldData world;
	check(world.set_length_unit(Real(PIXELS_A_METER)));
	check(world.set_gravity({ 0, Real(GRAVITY) }));
	check(world.add_border(wall({ 0, Real(FLOOR) }, { 0, -1 })));
	check(world.add_border(wall({ 0, 0 }, { 1, 0 })));
	check(world.add_border(wall({ Real(heap.width), 0 }, { -1, 0 })));
	for (const Place &place : heap.places) {
		const ElasticBody &kind = heap.kinds[place.body];
		softbody::Pose pose;
		pose.position = place.at;
		world.add_soft_body(take(SoftBodyData::create(kind.shape, kind.settings, pose)));
	}
	softbody::Simulator simulator(world);
	std::vector<Duration> awake;
	std::size_t resets = 0;
	std::size_t most_asleep = 0;
	json asleep_after = nullptr;
	double least_ever = 1e30;
	int tick = 0;
	const Stopwatch whole;
	while (tick < int(heap.seconds * RATE) && whole.elapsed().cpu < patience) {
		++tick;
		const Stopwatch watch;
		const softbody::StepReport report = simulator.simulate(Real(TICK));
		if (asleep_after.is_null()) {
			awake.push_back(watch.elapsed());
		}
		resets += report.reset_bodies.size();
		most_asleep = std::max(most_asleep, report.sleeping_bodies);
		for (const SoftBodyData &body : world.soft_bodies()) {
			least_ever = std::min(least_ever, double(softbody::signed_area(body.hull())) / double(body.shape().rest_area()));
		}
		if (asleep_after.is_null() && report.sleeping_bodies == heap.places.size()) {
			asleep_after = tick / double(RATE);
			if (heap.until_asleep) {
				break;
			}
		}
	}
	const StepTimes times = times_of(awake);
	json row = { { "scene", heap.scene }, { "bodies", heap.places.size() }, { "rows_high", heap.rows_high },
		{ "firmness", name_of(heap.firmness) }, { "seed", heap.seed }, { "asleep_after_s", asleep_after },
		{ "most_asleep", most_asleep }, { "mean_step_ms", times.cpu.mean * 1e3 }, { "median_step_ms", times.cpu.median * 1e3 },
		{ "worst_step_ms", times.cpu.worst * 1e3 }, { "resets", resets }, { "least_area_ever", least_ever },
		{ "simulated_s", tick / double(RATE) }, { "given_up", !asleep_after.is_number() && tick < int(heap.seconds * RATE) } };
	row.update(judge(world.soft_bodies()));
	std::fprintf(stderr, "  %s\n", row.dump().c_str());
	return row;
}

} // namespace

json heap(const Options &options) {
	json rows = json::array();
	const int seeds = options.quick ? 1 : 3;
	const double patience = options.quick ? QUICK_PATIENCE : PATIENCE;
	for (const int high : { 10, 20 }) {
		for (const Firmness firmness : { Firmness::FIRM, Firmness::DEFAULT, Firmness::SOFT }) {
			for (int seed = 1; seed <= seeds; ++seed) {
				rows.push_back(run(heap_of(10, high, firmness, seed), patience));
			}
		}
	}
	if (!options.quick) {
		for (const Firmness firmness : { Firmness::FIRM, Firmness::DEFAULT, Firmness::SOFT }) {
			const int large_seeds = firmness == Firmness::DEFAULT ? 2 : 1;
			for (int seed = 1; seed <= large_seeds; ++seed) {
				rows.push_back(run(heap_of(40, 25, firmness, seed), patience));
			}
		}
	}
	for (const ModelChoice &model : elastic_models()) {
		for (const Firmness firmness : { Firmness::DEFAULT, Firmness::FIRM }) {
			for (const int points : { 8, 16, 32 }) {
				if (!model.is_old_network && (!options.quick || points == POINTS)) {
					rows.push_back(run(heap_of_model(model, firmness, points), patience));
					rows.back()["points"] = points;
				}
			}
		}
	}
	for (const char *letter : { "L", "star", "U" }) {
		for (const int high : { 5, 10 }) {
			for (int seed = 1; seed <= seeds; ++seed) {
				rows.push_back(run(concave(letter, high, seed), patience));
			}
		}
	}
	for (int seed = 1; seed <= seeds; ++seed) {
		rows.push_back(run(mixed(seed), patience));
	}
	rows.push_back(run(trial(10, 10, RADIUS, 2.05), patience));
	rows.push_back(run(trial(6, 6, RADIUS, 2.04), patience));
	rows.push_back(run(trial(10, 3, 20, 2.1), patience));
	return { { "jitter_px", JITTER }, { "crushed", CRUSHED }, { "firm_times", FIRM }, { "rows", rows } };
}

} // namespace bench
