// SPDX-License-Identifier: MIT
// Every stress scene under every integrator and tick rate: what holds, and what a method does not promise.
#include "bench.h"

#include "core/dynamics/integrators/integrator_step.h"
#include "scenes/stress/stress.h"

#include <array>
#include <chrono>

namespace bench {

namespace {

using nlohmann::json;
using softbody::Integrator;
using namespace softbody::testing;

constexpr std::array<int, 4> RATES = { 30, 60, 120, 240 };

} // namespace

json stress(const Options &options) {
	json result = { { "rows", json::array() } };
	for (int i = 0; i < softbody::INTEGRATOR_COUNT; ++i) {
		const Integrator integrator = Integrator(i);
		for (const int rate : RATES) {
			if (options.quick && (integrator != Integrator::AUTOMATIC || rate > 60)) {
				continue;
			}
			const StressSetup setup{ integrator, rate, options.quick };
			for (const StressFamily family : stress_families()) {
				for (StressScene &scene : family(setup)) {
					const std::string name = scene.name;
					const auto start = std::chrono::steady_clock::now();
					const StressResult outcome = run_stress(std::move(scene), setup);
					const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
					result["rows"].push_back({ { "name", outcome.name }, { "scene", name }, { "rate", rate },
							{ "integrator", integrator == Integrator::AUTOMATIC ? "automatic" : softbody::integrator_traits(integrator).name },
							{ "promised", outcome.expectation == StressExpectation::PASSES }, { "passed", outcome.passed },
							{ "met_all", outcome.met_all }, { "problems", outcome.problems }, { "seconds", took.count() } });
				}
			}
		}
	}
	return result;
}

} // namespace bench
