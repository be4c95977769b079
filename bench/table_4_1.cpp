// SPDX-License-Identifier: MIT
// The thesis's table 4.1: how many of its test bodies a step of 1/60 s can hold before it takes longer than that.
#include "bench.h"
#include "bodies.h"
#include "task_clock.h"
#include "soft_pile.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;

constexpr int RATE = 60;
constexpr double FRAME = 1.0 / RATE; // s
constexpr int SETTLE_STEPS = 8 * RATE;
constexpr int TIMED_STEPS = 2 * RATE;
constexpr std::uint64_t SEED = 20150704;

struct Method {
	const char *name;
	int thesis_with; ///< bodies in the thesis's table, with collisions
	int thesis_without; ///< 0: not in it
};
constexpr Method METHODS[] = { { "explicit_euler", 132, 3534 }, { "midpoint", 72, 1817 }, { "runge_kutta_4", 36, 912 },
	{ "default", 0, 0 } };

Integrator integrator_of(const std::string &name) {
	return name == "explicit_euler" ? Integrator::EXPLICIT_EULER
			: name == "midpoint"    ? Integrator::MIDPOINT
			: name == "runge_kutta_4" ? Integrator::RUNGE_KUTTA_4
									  : Integrator::AUTOMATIC;
}

// With collisions: what a pile ten high needs, and the least damping with which each method is stable in a substep of
// 1/240 s. Midpoint and Runge-Kutta take the default's.
SoftPileSettings settings_with(const std::string &name) {
	constexpr double STIFFNESS = 600;
	if (name == "explicit_euler") {
		return explicit_euler_settings(STIFFNESS, FRAME / softbody::MIN_CONTACT_SUBSTEPS);
	}
	SoftPileSettings settings = default_settings(STIFFNESS);
	settings.integrator = integrator_of(name);
	settings.substeps = name == "default" ? 0 : settings.contact_substeps; // one force substep in each contact substep
	return settings;
}

// Without: springs soft enough for a single step a frame, for every method. The default decides about itself.
SoftPileSettings settings_without(const std::string &name) {
	SoftPileSettings settings;
	settings.integrator = integrator_of(name);
	settings.substeps = name == "default" ? 0 : 1;
	settings.stiffness = 60;
	settings.damping = 1.5;
	settings.bodies_collide = false;
	if (name != "default") {
		settings.rolling_resistance = 0; // the thesis knows none
	}
	return settings;
}

// Nothing keeps bodies apart that ignore each other. Strewn over a kilometer, as floats far out resolve little.
PileScene strewn_scene(std::size_t bodies) {
	PileScene scene;
	scene.has_walls = false;
	scene.width = 1000;
	scene.left = -scene.width / 2;
	Random random(SEED);
	for (std::size_t i = 0; i < bodies; ++i) {
		const double x = random.uniform(scene.left, -scene.left);
		const double y = random.uniform(0.6, 2);
		scene.bodies.push_back({ { softbody::Real(x), softbody::Real(y) }, random.uniform(0, 2 * std::numbers::pi) });
	}
	return scene;
}

// A heap on open ground, each row narrower than the one below by two bodies at each end. From the corners of an upright
// end bodies would fall ten high and spin, and explicit Euler spins whatever spins fast up until it bursts: its
// gain, h ω²/2 a second, outgrows friction.
PileScene open_pile_scene(std::size_t bodies) {
	constexpr std::size_t NARROWER = 4; // bodies a row
	PileScene scene;
	const std::size_t rows = std::size_t(scene.rows);
	const std::size_t missing = NARROWER * rows * (rows - 1) / 2;
	const std::size_t columns = std::max((bodies + missing + rows - 1) / rows, NARROWER * rows);
	scene = pile_scene(columns * rows, scene.rows);
	scene.has_walls = false;
	std::vector<PileScene::Place> heap;
	for (std::size_t i = 0; i < scene.bodies.size() && heap.size() < bodies; ++i) {
		const std::size_t row = i / columns;
		const std::size_t column = i % columns;
		if (column >= NARROWER / 2 * row && column + NARROWER / 2 * row < columns) {
			heap.push_back(scene.bodies[i]);
		}
	}
	scene.bodies = std::move(heap);
	return centered(scene);
}

struct Measured {
	std::size_t bodies = 0;
	StepTimes times;
	double kinetic_energy = 0;
	std::size_t resets = 0;
	PileQuality quality;
	double scheduled = 0; ///< median step if two free threads shared the tasks, by processor time [s]
	/// One thread is judged by its processor time, which is the clock's on a machine with nothing else to do.
	double judged(std::size_t threads) const { return threads == 1 ? times.cpu.median : times.wall.median; }
	double least(std::size_t threads) const { return threads == 1 ? times.cpu.least : times.wall.least; }
};

Measured measure(std::size_t bodies, const SoftPileSettings &settings, std::size_t threads, ThreadPool &pool, bool quick) {
	const bool collide = settings.bodies_collide;
	TaskClock clock;
	const softbody::ParallelFor on_pool = pool.parallel_for();
	const softbody::ParallelFor timed = clock.parallel_for();
	bool is_timed = false;
	const softbody::ParallelFor parallel_for = [&](std::size_t count, const auto &task) {
		(is_timed ? timed : on_pool)(count, task);
	};
	SoftPile pile(collide ? open_pile_scene(bodies) : strewn_scene(bodies), settings, parallel_for);
	pool.set_in_use(true); // the results are the same for any number of threads
	const int settle = collide ? SETTLE_STEPS : SETTLE_STEPS / 4;
	pile.run(quick ? settle / 5 : settle);
	pool.set_in_use(threads > 1);
	Measured measured;
	measured.bodies = bodies;
	measured.times = pile.run(quick ? TIMED_STEPS / 5 : TIMED_STEPS);
	if (threads == 2) {
		is_timed = true;
		std::vector<double> scheduled;
		for (int i = 0; i < TIMED_STEPS / 5; ++i) {
			const double took = pile.step().cpu;
			scheduled.push_back(took - clock.take_saved_by_two());
		}
		measured.scheduled = statistics_of(std::move(scheduled)).median;
	}
	measured.kinetic_energy = pile.kinetic_energy();
	measured.resets = pile.resets();
	if (collide) {
		measured.quality = pile.quality();
	} else {
		// They lie in one another, as they should: only their own shape is judged.
		for (const softbody::SoftBodyData &body : pile.world().soft_bodies()) {
			measured.quality.folded += softbody::is_folded(body.hull()) ? 1 : 0;
		}
	}
	return measured;
}

// The largest count whose settled median step fits into a frame. The time is so nearly in proportion to the count that a
// trial tells where the next must be; a few trials close in from both sides.
json search(const Method &method, bool collide, std::size_t threads, ThreadPool &pool, bool quick) {
	const SoftPileSettings settings = collide ? settings_with(method.name) : settings_without(method.name);
	const int trials = quick ? 2 : 6;
	std::size_t count = collide ? (quick ? 1000 : 4000) : (quick ? 20000 : 100000);
	std::optional<Measured> best; // fits
	std::optional<Measured> least_misfit;
	Measured last;
	for (int trial = 0; trial < trials; ++trial) {
		last = measure(count, settings, threads, pool, quick);
		const bool fits = last.judged(threads) <= FRAME;
		std::fprintf(stderr, "  %s, %s collisions, %zu threads: %zu bodies, %.2f ms\n", method.name,
				collide ? "with" : "without", threads, count, 1e3 * last.judged(threads));
		if (fits && (!best || count > best->bodies)) {
			best = last;
		}
		if (!fits && (!least_misfit || count < least_misfit->bodies)) {
			least_misfit = last;
		}
		const double predicted = double(count) * FRAME / last.judged(threads) * (quick ? 0.85 : 0.99);
		std::size_t next = std::size_t(predicted);
		if (best && least_misfit) {
			if (best->bodies >= least_misfit->bodies || double(least_misfit->bodies) < 1.02 * double(best->bodies)) {
				break; // known to 2 %, or as closely as the noise of the machine allows
			}
			next = std::clamp(next, best->bodies + 1, least_misfit->bodies - 1);
		} else if (best && double(next) < 1.02 * double(best->bodies)) {
			break;
		}
		count = next;
	}
	const Measured &counted = best ? *best : last;
	const double bodies = double(counted.bodies);
	json row = { { "method", method.name }, { "collisions", collide }, { "threads", threads },
		{ "bodies", best ? json(best->bodies) : json(nullptr) },
		{ "thesis_bodies", method.thesis_with == 0 ? json(nullptr) : json(collide ? method.thesis_with : method.thesis_without) },
		// What the least step time would allow.
		{ "bodies_by_least", std::size_t(bodies * FRAME / counted.least(threads)) },
		// And what two threads would do that had the machine for themselves.
		{ "bodies_by_schedule", threads == 2 ? json(std::size_t(bodies * FRAME / counted.scheduled)) : json(nullptr) },
		{ "median_ms", 1e3 * counted.judged(threads) }, { "least_ms", 1e3 * counted.least(threads) },
		{ "median_wall_ms", 1e3 * counted.times.wall.median }, { "ns_per_body_step", 1e9 * counted.judged(threads) / bodies },
		{ "kinetic_energy", counted.kinetic_energy }, { "resets", counted.resets }, { "settings", to_json(settings) } };
	row.update(to_json(counted.quality));
	std::fprintf(stderr, "  %s\n", row.dump().c_str());
	return row;
}

} // namespace

json table_4_1(const Options &options) {
	ThreadPool pool(1);
	json rows = json::array();
	for (const Method &method : METHODS) {
		for (const bool collide : { true, false }) {
			for (const std::size_t threads : { std::size_t(1), std::size_t(2) }) {
				rows.push_back(search(method, collide, threads, pool, options.quick));
			}
		}
	}
	return { { "frame_ms", 1e3 * FRAME }, { "rows", rows } };
}

} // namespace bench
