// SPDX-License-Identifier: MIT
// Every stress scene under every integrator and tick rate: what holds, and what a method does not promise. Fresh seeds of those
// in which bodies start ruined or tangled.
#include "bench.h"

#include "scenes/integrator_facts.h"
#include "scenes/stress/stress.h"

#include <array>
#include <chrono>
#include <map>
#include <string>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;
using namespace softbody::testing;

constexpr std::array<int, 4> RATES = { 30, 60, 120, 240 };

constexpr int SEEDS = 200;
constexpr int QUICK_SEEDS = 10;

/// Runs every scene of the setup and appends a row for each.
void run_all(const StressSetup &setup, json &rows) {
	for (const StressFamily family : stress_families()) {
		for (StressScene &scene : family(setup)) {
			const std::string name = scene.name;
			const auto start = std::chrono::steady_clock::now();
			const StressResult outcome = run_stress(std::move(scene), setup);
			const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
			rows.push_back({ { "name", outcome.name }, { "scene", name }, { "rate", setup.rate },
					{ "bodies", setup.elastic ? "default_material" : "springs" },
					{ "integrator", softbody::integrator_facts(setup.integrator).name },
					{ "promised", outcome.expectation == StressExpectation::PASSES }, { "passed", outcome.passed },
					{ "met_all", outcome.met_all }, { "problems", outcome.problems }, { "seconds", took.count() } });
		}
	}
}

/// How many of `seeds` fresh starts of each scene of the families fail under the automatic choice.
void run_seeds(int seeds, bool elastic, json &rows) {
	std::map<std::string, json> failed;
	for (int seed = 1; seed <= seeds; ++seed) {
		const StressSetup setup{ .quick = true, .seed = std::uint64_t(seed), .elastic = elastic };
		for (const StressFamily family : { start_scenes, tangle_scenes }) {
			for (StressScene &scene : family(setup)) {
				json &problems = failed.try_emplace(scene.name, json::object()).first->second;
				const StressResult outcome = run_stress(std::move(scene), setup);
				if (!outcome.passed) {
					problems[std::to_string(seed)] = outcome.problems;
				}
			}
		}
	}
	for (const auto &[scene, problems] : failed) {
		rows.push_back({ { "scene", scene }, { "bodies", elastic ? "default_material" : "springs" }, { "seeds", seeds },
				{ "failed", problems.size() }, { "problems", problems } });
	}
}

} // namespace

json stress(const Options &options) {
	json result = { { "rows", json::array() }, { "seeds", json::array() } };
	for (int i = 0; i < softbody::INTEGRATOR_COUNT; ++i) {
		const Integrator integrator = Integrator(i);
		for (const int rate : RATES) {
			if (options.quick && (integrator != Integrator::AUTOMATIC || rate > 60)) {
				continue;
			}
			run_all({ integrator, rate, options.quick }, result["rows"]);
			if (integrator == Integrator::AUTOMATIC) {
				run_all({ .rate = rate, .quick = options.quick, .elastic = true }, result["rows"]);
			}
		}
	}
	for (const bool elastic : { false, true }) {
		run_seeds(options.quick ? QUICK_SEEDS : SEEDS, elastic, result["seeds"]);
	}
	return result;
}

} // namespace bench
