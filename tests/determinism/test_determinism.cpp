// SPDX-License-Identifier: MIT
// The same bits on any number of threads, and after a state was put back.
#include "core/dynamics/simulator.h"
#include "determinism/hashed_scenes.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <string>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("scenes end in the same bits on one to eight threads" * doctest::test_suite("threads")) {
	for (const HashedScene &scene : hashed_scenes()) {
		CAPTURE(std::string(scene.name));
		const std::uint64_t alone = run_hashed(scene, 90, {});
		for (const std::size_t threads : { 2, 3, 5, 8 }) {
			CAPTURE(threads);
			CHECK(run_hashed(scene, 90, on_threads(threads)) == alone);
		}
	}
}

TEST_CASE("scenes end in the same bits with a team whose helpers stay from call to call" * doctest::test_suite("threads")) {
	HelpedTeam team(2);
	for (const HashedScene &scene : hashed_scenes()) {
		CAPTURE(scene.name);
		CHECK(run_hashed(scene, 60, team.parallel_for()) == run_hashed(scene, 60, {}));
	}
}

TEST_CASE("saved, stepped for 600 ticks and put back, scenes go on in the same bits for 600 more" *
		doctest::test_suite("slow")) {
	for (const HashedScene &scene : hashed_scenes()) {
		CAPTURE(std::string(scene.name));
		const int ticks = 900;
		CHECK(run_hashed_with_detour(scene, ticks, 600, {}) == run_hashed_with_detour(scene, ticks, 0, {}));
	}
}
