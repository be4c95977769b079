// SPDX-License-Identifier: MIT
// Scenes made to break soft bodies: what their method promises holds.
#include "scenes/stress/stress.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

void run_family(StressFamily family, const StressSetup &setup) {
	for (StressScene &scene : family(setup)) {
		const StressResult result = run_stress(std::move(scene), setup);
		INFO(result.name << ": " << result.problems);
		CHECK(result.passed);
	}
}

void run_all(const StressSetup &setup) {
	for (const StressFamily family : stress_families()) {
		run_family(family, setup);
	}
}

} // namespace

// All rates and integrators: scripts/bench.sh stress.
TEST_CASE("the automatic choice passes every stress scene at 60 ticks a second" * doctest::test_suite("slow")) {
	run_all({ Integrator::AUTOMATIC, 60, true });
}

TEST_CASE("bodies of the default material pass every stress scene at 60 ticks a second" * doctest::test_suite("slow")) {
	run_all({ .rate = 60, .quick = true, .elastic = true });
}

// Two hundred seeds of each: scripts/bench.sh stress.
TEST_CASE("ruined and tangled bodies of the default material are back in ten seconds, from fresh starts" *
		doctest::test_suite("slow")) {
	for (std::uint64_t seed = 1; seed <= 5; ++seed) {
		for (const StressFamily family : { start_scenes, tangle_scenes }) {
			run_family(family, { .rate = 60, .quick = true, .seed = seed, .elastic = true });
		}
	}
}

TEST_CASE("what the other methods promise in stress scenes holds" * doctest::test_suite("slow")) {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		const StressSetup setup{ Integrator(i), 60, true };
		for (const StressFamily family : { start_scenes, theory_scenes }) {
			run_family(family, setup);
		}
	}
}
