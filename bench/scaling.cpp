// SPDX-License-Identifier: MIT
// How the time of a step grows with the number of bodies, what it goes into, and what a second thread saves.
#include "bench.h"
#include "soft_pile.h"
#include "task_clock.h"

#include "core/collision/broad_phase.h"
#include "core/collision/environment_contact_solver.h"
#include "scenes/circle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Real;

constexpr int RATE = 60;
constexpr int SETTLE_STEPS = 5 * RATE;
constexpr int TIMED_STEPS = RATE;

// The broad phase of the coming step once more, to see its pairs and how often it seeks them anew.
class BroadPhaseTwin {
public:
	void update(const SoftPile &pile, const softbody::WorldData &world) {
		bodies_.clear();
		for (const softbody::SoftBodyData &body : world.soft_bodies()) {
			const softbody::Circle circle = softbody::sweep_circle(body.hull(), softbody::fastest(body.velocities()), Real(pile.scene().time_step));
			bodies_.push_back({ circle.center, circle.radius,
					body.settings().collision_layer, body.settings().collision_mask });
		}
		broad_phase_.update(bodies_, 1);
	}
	std::uint64_t rebuilds() const { return broad_phase_.rebuild_count(); }
	std::size_t pairs() const { return broad_phase_.pairs().size(); }

private:
	softbody::BroadPhase broad_phase_;
	std::vector<softbody::BroadPhaseBody> bodies_;
};

std::unique_ptr<SoftPile> settled_pile(std::size_t bodies, const softbody::ParallelFor &parallel_for) {
	PileScene scene = centered(pile_scene(bodies));
	const SoftPileSettings settings = default_settings(carrying_stiffness(scene));
	auto pile = std::make_unique<SoftPile>(std::move(scene), settings, parallel_for);
	pile->run(SETTLE_STEPS);
	return pile;
}

json measure_size(std::size_t bodies, ThreadPool &pool) {
	TaskClock clock;
	const softbody::ParallelFor on_two = pool.parallel_for();
	const softbody::ParallelFor timed = clock.parallel_for();
	bool is_timed = false;
	const std::unique_ptr<SoftPile> pile = settled_pile(bodies, [&](std::size_t count, const auto &task) {
		(is_timed ? timed : on_two)(count, task);
	});
	is_timed = true;
	BroadPhaseTwin twin;
	twin.update(*pile, pile->world());
	std::vector<Duration> times;
	softbody::StepProfile spent; // of all steps
	std::vector<double> saved;
	const std::uint64_t rebuilds = twin.rebuilds();
	double contacts = 0;
	// As many body-steps for a small pile as for a large one, so that its figures are worth as much.
	const int steps = std::max<int>(TIMED_STEPS, int(100000 / bodies));
	for (int i = 0; i < steps; ++i) {
		twin.update(*pile, pile->world());
		times.push_back(pile->step());
		contacts += double(pile->report().contacts + pile->report().pair_contacts) / double(steps);
		spent.bodies += pile->report().profile.bodies;
		spent.broad_phase += pile->report().profile.broad_phase;
		spent.pair_contacts += pile->report().profile.pair_contacts;
		saved.push_back(clock.take_saved_by_two());
	}
	const StepTimes step = times_of(times);
	// Means: phases add up, and the broad phase has most to do in a few steps.
	const double ns = 1e9 / double(bodies);
	const double forces = spent.bodies / steps * ns;
	const double boxes = spent.broad_phase / steps * ns;
	const double contact = spent.pair_contacts / steps * ns;
	const double mean = step.cpu.mean * ns;
	json row = { { "bodies", bodies }, { "median_ms", 1e3 * step.cpu.median }, { "least_ms", 1e3 * step.cpu.least },
		{ "wall_median_ms", 1e3 * step.wall.median }, { "ns_per_body_step", step.cpu.median * ns }, { "mean_ns", mean },
		{ "contacts_per_body", contacts / double(bodies) }, { "pairs_per_body", double(twin.pairs()) / double(bodies) },
		{ "steps_per_rebuild", twin.rebuilds() == rebuilds ? json(nullptr) : json(double(steps) / double(twin.rebuilds() - rebuilds)) },
		{ "contact_substeps", pile->contact_substeps() } };
	row["forces_ns"] = forces;
	row["broad_phase_ns"] = boxes;
	row["contacts_ns"] = contact;
	row["rest_ns"] = mean - forces - boxes - contact;
	// By processor time, so independent of other programs; without the cost of waking a second thread. A small world is
	// stepped in one go, and its parallel-for never asked.
	const double saved_ns = statistics_of(saved).mean * ns;
	row["scheduled_speedup"] = saved_ns > 0 ? json(mean / (mean - saved_ns)) : json(nullptr);
	std::fprintf(stderr, "  %s\n", row.dump().c_str());
	return row;
}

// What a second thread would save if nothing had to be done in order: arithmetic on numbers of its own.
double arithmetic(const softbody::ParallelFor &parallel_for) {
	std::array<double, 32> results{};
	const Stopwatch watch;
	parallel_for(results.size(), [&](std::size_t task) {
		double x = 0.5;
		for (int i = 0; i < 40000; ++i) {
			x = 3.7 * x * (1 - x);
		}
		results[task] = x;
	});
	const double wall = watch.elapsed().wall;
	return *std::max_element(results.begin(), results.end()) <= 1 ? wall : 0; // so that it is computed
}

json measure_threads(std::size_t bodies, bool quick) {
	constexpr int TURN = 5;
	const int turns = quick ? 6 : 40;
	ThreadPool pool(1);
	const std::unique_ptr<SoftPile> pile = settled_pile(bodies, pool.parallel_for());
	std::array<std::vector<double>, 2> steps;
	std::array<std::vector<double>, 2> plain;
	std::vector<double> cpu;
	for (int turn = 0; turn < turns; ++turn) {
		for (const std::size_t two : { 0, 1 }) {
			pool.set_in_use(two == 1);
			for (int i = 0; i < TURN; ++i) {
				const Duration took = pile->step();
				steps[two].push_back(took.wall);
				if (two == 0) {
					cpu.push_back(took.cpu);
				}
				plain[two].push_back(arithmetic(pool.parallel_for()));
			}
		}
	}
	const Statistics one = statistics_of(steps[0]);
	const Statistics two = statistics_of(steps[1]);
	const Statistics plain_one = statistics_of(plain[0]);
	const Statistics plain_two = statistics_of(plain[1]);
	return { { "bodies", bodies }, { "one_thread_ms", 1e3 * one.median }, { "two_threads_ms", 1e3 * two.median },
		{ "one_thread_cpu_ms", 1e3 * statistics_of(cpu).median }, { "one_thread_least_ms", 1e3 * one.least },
		{ "two_threads_least_ms", 1e3 * two.least }, { "speedup_by_median", one.median / two.median },
		{ "speedup_by_least", one.least / two.least }, { "arithmetic_speedup_by_median", plain_one.median / plain_two.median },
		{ "arithmetic_speedup_by_least", plain_one.least / plain_two.least } };
}

// What stiff bodies elsewhere cost a pile that has nothing to do with them: the same pile alone and beside them, in turns.
json measure_beside_stiff(bool quick) {
	constexpr std::size_t BODIES = 1000;
	constexpr int STIFF_PAIRS = 10;
	constexpr int TURN = 5;
	constexpr double STIFFER = 25;
	const std::unique_ptr<SoftPile> alone = settled_pile(BODIES, {});
	const std::unique_ptr<SoftPile> beside = settled_pile(BODIES, {});
	const PileScene &scene = beside->scene();
	const double stiffness = STIFFER * carrying_stiffness(scene);
	const auto shape = softbody::testing::circle_shape(Real(scene.radius), std::size_t(scene.hull_points),
			{ 1, Real(stiffness), Real(0.1), true }).value();
	softbody::BodySettings floating;
	floating.gravity_scale = 0;
	for (int i = 0; i < 2 * STIFF_PAIRS; ++i) { // high above, each near enough to another for a touch to be looked for
		const Real x = Real(scene.radius * (10 * (i / 2) + 2.02 * (i % 2)));
		beside->world().add_soft_body(softbody::SoftBodyData::create(shape, floating, { { x, 1000 }, {} }).value());
	}
	const softbody::SubstepPlan plan = beside->simulator().plan(beside->world().soft_bodies().back(), Real(scene.time_step));
	std::array<std::vector<double>, 2> times;
	for (int turn = 0; turn < (quick ? 6 : 24); ++turn) {
		for (int i = 0; i < TURN; ++i) {
			times[0].push_back(alone->step().cpu);
		}
		for (int i = 0; i < TURN; ++i) {
			times[1].push_back(beside->step().cpu);
		}
	}
	const double apart = statistics_of(times[0]).median;
	const double together = statistics_of(times[1]).median;
	return { { "bodies", BODIES }, { "stiff_pairs", STIFF_PAIRS }, { "stiff_substeps", plan.substeps }, { "alone_ms", 1e3 * apart },
		{ "beside_ms", 1e3 * together }, { "times", together / apart },
		{ "substeps_a_body", double(beside->report().substeps) / double(BODIES + 2 * STIFF_PAIRS) } };
}

} // namespace

json scaling(const Options &options) {
	ThreadPool pool(1);
	json rows = json::array();
	std::vector<std::size_t> sizes = { 100, 300, 1000, 3000 };
	if (!options.quick) {
		sizes.insert(sizes.end(), { 10000, 30000, 100000 });
	}
	for (const std::size_t bodies : sizes) {
		rows.push_back(measure_size(bodies, pool));
	}
	return { { "rows", rows }, { "threads", measure_threads(options.quick ? 2000 : 10000, options.quick) },
		{ "beside_stiff", measure_beside_stiff(options.quick) } };
}

} // namespace bench
