// SPDX-License-Identifier: MIT
// Scenes made to break soft bodies: what their method promises holds.
#include "scenes/stress/stress.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

void run_all(const StressSetup &setup) {
	for (const StressFamily family : stress_families()) {
		for (StressScene &scene : family(setup)) {
			const StressResult result = run_stress(std::move(scene), setup);
			INFO(result.name << ": " << result.problems);
			CHECK(result.passed);
		}
	}
}

} // namespace

// All rates and integrators: scripts/bench.sh stress.
TEST_CASE("the automatic choice passes every stress scene at 60 ticks a second") {
	run_all({ Integrator::AUTOMATIC, 60, true });
}

TEST_CASE("what the other methods promise in stress scenes holds") {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		const StressSetup setup{ Integrator(i), 60, true };
		for (const StressFamily family : { start_scenes, theory_scenes }) {
			for (StressScene &scene : family(setup)) {
				const StressResult result = run_stress(std::move(scene), setup);
				INFO(result.name << ": " << result.problems);
				CHECK(result.passed);
			}
		}
	}
}
