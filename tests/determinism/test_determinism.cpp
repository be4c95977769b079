// SPDX-License-Identifier: MIT
// The same bits on any number of threads, and after a state was put back.
#include "core/dynamics/simulator.h"
#include "determinism/hashed_scenes.h"
#include "support/skip.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
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

// The numbers are those of x86-64. Who changes what a step computes, or a scene, writes the new ones here, in a commit that says
// why; a platform on which they differ has found a fault.
TEST_CASE("scenes end in the bits that they always have ended in, on every processor and system" * SINGLE_PRECISION_ONLY) {
	struct Golden {
		std::string scene;
		std::uint64_t hash;
	};
	const std::array<Golden, 9> golden = { {
			{ "mixed", 0x47487506aca3fef0u },
			{ "chain", 0xfec3670d30c8f09bu },
			{ "ribbons", 0xb6d72f83592125e6u },
			{ "pile", 0xf2b922e7bd0b2159u },
			{ "metal", 0x41008d39aeeb81a5u },
			{ "turning", 0x6fe2ea410686c536u },
			{ "carts", 0xec721fc486ef4dcau },
			{ "characters", 0x04b878be783d55b1u },
			{ "flyers", 0x2b112a7a3d5a586bu },
	} };
	REQUIRE(hashed_scenes().size() == golden.size());
	for (std::size_t i = 0; i < golden.size(); ++i) {
		CAPTURE(golden[i].scene);
		REQUIRE(golden[i].scene == hashed_scenes()[i].name);
		CHECK(run_hashed(hashed_scenes()[i], 90, {}) == golden[i].hash);
	}
}

TEST_CASE("the hashed flyers fly, bend in the air and lie on the floor") {
	const HashedScene &scene = hashed_scenes().back();
	WorldData world = scene.make();
	Simulator simulator(world);
	std::size_t changes = 0, last = 0, most = 0;
	for (int tick = 0; tick < 240; ++tick) {
		scene.drive(world, tick);
		const std::size_t flying = simulator.simulate(Real(1) / 60).flying_bodies;
		changes += (flying > 0) != (last > 0);
		most = std::max(most, flying);
		last = flying;
	}
	CHECK(most >= 20);
	CHECK(changes >= 4);
	CHECK(last == 0);
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
