// SPDX-License-Identifier: MIT
// States of whole worlds: how long they take to save and to put back, how large they are, and whether two peers who roll back agree.
#include "bench.h"

#include "core/dynamics/simulator.h"
#include "core/dynamics/world_state.h"
#include "scenes/jelly.h"
#include "scenes/netplay.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace bench {

namespace {

using namespace softbody;
using namespace softbody::testing;

constexpr int BODIES = 300;
constexpr int ROW = 20;

// A wide heap of default nodes between walls.
WorldData heap() {
	WorldData world = pixel_world();
	world.add_border(floor_at(1000));
	world.add_border({ { { 0, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { Real(ROW) * 105, 0 }, { -1, 0 } }, {} });
	for (int i = 0; i < BODIES; ++i) {
		BodySettings settings = jelly_settings();
		set_default_limits(settings);
		world.add_soft_body(jelly_circle({ Real(52 + 105 * (i % ROW)), Real(940 - 102 * (i / ROW)) }, settings));
	}
	return world;
}

template <class Work>
double time_us(const Work &work) {
	const auto start = std::chrono::steady_clock::now();
	work();
	return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
	std::ranges::sort(values);
	return values[values.size() / 2];
}

struct Times {
	std::vector<double> save, restore, step, next_step;
};

/// Saves, goes on for eight ticks and puts the state back, over and over.
nlohmann::json measure(WorldData &world, Simulator &simulator, int rounds, bool uses_base) {
	WorldState state;
	const std::vector<std::uint8_t> base = uses_base ? state.save(simulator, {}).value() : std::vector<std::uint8_t>();
	std::vector<std::uint8_t> bytes;
	Times times;
	for (int round = 0; round < rounds; ++round) {
		simulator.simulate(FRAME);
		times.save.push_back(time_us([&] { bytes = state.save(simulator, {}, base, std::move(bytes)).value(); }));
		for (int tick = 0; tick < ROLLBACK_WINDOW; ++tick) {
			times.step.push_back(time_us([&] { simulator.simulate(FRAME); }));
		}
		times.restore.push_back(time_us([&] {
			if (!state.read(simulator, {}, bytes, base)) {
				state.put_back(simulator);
			}
		}));
		times.next_step.push_back(time_us([&] { simulator.simulate(FRAME); }));
	}
	return { { "bodies", world.soft_bodies().size() }, { "rounds", rounds }, { "save_us", median(times.save) },
		{ "restore_us", median(times.restore) }, { "step_us", median(times.step) }, { "step_after_restore_us", median(times.next_step) },
		{ "snapshot_bytes", bytes.size() } };
}

nlohmann::json measure_awake(int rounds) {
	WorldData world = heap();
	Simulator simulator(world);
	for (int tick = 0; tick < 60; ++tick) {
		simulator.simulate(FRAME);
	}
	return measure(world, simulator, rounds, false);
}

// All but one of twenty sleep; what is saved is what has changed since.
nlohmann::json measure_asleep(int rounds) {
	WorldData world = pixel_world();
	world.add_border(floor_at(100));
	for (int i = 0; i < BODIES; ++i) {
		world.add_soft_body(jelly_circle({ Real(200 * i), 51 }));
	}
	Simulator simulator(world);
	for (SoftBodyData &body : world.soft_bodies()) {
		body.put_to_sleep();
	}
	simulator.simulate(FRAME);
	for (std::size_t i = 0; i < BODIES; i += 20) {
		world.soft_bodies()[i].apply_impulse(3, { 100, -200 });
	}
	return measure(world, simulator, std::min(rounds, 20), true);
}

} // namespace

nlohmann::json rollback(const Options &options) {
	nlohmann::json result;
	result["awake"] = measure_awake(options.quick ? 40 : 200);
	result["asleep_on_base"] = measure_asleep(20);
	NetplayResult all;
	for (std::uint64_t seed = 1; seed <= (options.quick ? 1u : 4u); ++seed) {
		const NetplayResult one = play_over_network([] { return heap(); }, 300, { seed, options.quick ? 90 : 240, 0.25, 6 });
		all.ticks += one.ticks;
		all.rollbacks += one.rollbacks;
		all.replayed += one.replayed;
		all.deepest = std::max(all.deepest, one.deepest);
		all.stalls += one.stalls;
		all.mismatches += one.mismatches;
	}
	result["network"] = { { "ticks", all.ticks }, { "rollbacks", all.rollbacks }, { "replayed_ticks", all.replayed },
		{ "deepest", all.deepest }, { "stalls", all.stalls }, { "mismatches", all.mismatches } };
	return result;
}

} // namespace bench
