// SPDX-License-Identifier: MIT
// The fuzzer's targets on seeded bytes, and what fuzzing has found.
#include "fuzz/targets.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/skip.h"

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

using Target = void (*)(std::span<const std::uint8_t>);

void try_random(Target target, int count, std::uint64_t seed) {
	Random random(seed);
	for (int i = 0; i < count; ++i) {
		CAPTURE(i);
		std::vector<std::uint8_t> bytes(std::size_t(random.integer(0, 300)));
		for (std::uint8_t &byte : bytes) {
			byte = std::uint8_t(random.bits());
		}
		REQUIRE_NOTHROW(target(bytes));
	}
}

} // namespace

TEST_CASE("random bytes break none of the claims of a fuzz target") {
	try_random(fuzzing::fuzz_shape, 2000, 1);
	try_random(fuzzing::fuzz_state, 2000, 2);
	try_random(fuzzing::fuzz_geometry, 2000, 3);
	try_random(fuzzing::fuzz_world, 300, 4);
	try_random(fuzzing::fuzz_cut, 2000, 5);
}

// What reaches most code, chosen by libFuzzer, and whatever broke a claim (found_*).
TEST_CASE("the corpus breaks none of the claims") {
	const std::filesystem::path corpus = "tests/fuzz/corpus";
	if (!std::filesystem::is_directory(corpus)) {
		SKIP_TEST("no folder tests/fuzz/corpus here: run from the top of the repository");
	}
	const std::array<std::pair<const char *, Target>, 5> targets = { { { "shape", fuzzing::fuzz_shape },
			{ "state", fuzzing::fuzz_state }, { "geometry", fuzzing::fuzz_geometry }, { "world", fuzzing::fuzz_world }, { "cut", fuzzing::fuzz_cut } } };
	for (const auto &[name, target] : targets) {
		int count = 0;
		for (const auto &entry : std::filesystem::directory_iterator(corpus / name)) {
			CAPTURE(entry.path().string());
			std::ifstream file(entry.path(), std::ios::binary);
			const std::vector<char> read((std::istreambuf_iterator<char>(file)), {});
			REQUIRE(file.good());
			const std::vector<std::uint8_t> bytes(read.begin(), read.end());
			CHECK_NOTHROW(target(bytes));
			++count;
		}
		CHECK(count >= 8);
	}
}

// Found by fuzz_shape: each number is in range, and what follows from them is not.
TEST_CASE("a hull or mass whose area, inertia or inverse leaves the range of numbers is refused by name") {
	const bool is_float = sizeof(Real) == 4;
	const auto triangle_of = [](Real size) {
		const std::array<Vec2, 3> hull = { Vec2{ 0, 0 }, { size, 0 }, { 0, size } };
		return SoftBodyCreator::create_polygon(hull, {});
	};
	CHECK_FALSE(triangle_of(is_float ? Real(1e19) : Real(1e154))); // whose square is about the largest number
	const auto small = triangle_of(is_float ? Real(1e-19) : Real(1e-154)); // and this one's the least
	REQUIRE_FALSE(small);
	CHECK(small.error().name == "hull");
	const std::array<Vec2, 3> usual = { Vec2{ 0, 0 }, { 1, 0 }, { 0, 1 } };
	StructureOptions options;
	options.mass = std::numeric_limits<Real>::denorm_min() * 100; // its inverse is none
	const auto light = SoftBodyCreator::create_polygon(usual, options);
	REQUIRE_FALSE(light);
	CHECK(light.error().name == "mass");
	options = {};
	options.mass = std::numeric_limits<Real>::min() * 100;
	options.stiffness = 1000;
	const auto stiff = SoftBodyCreator::create_polygon(usual, options);
	REQUIRE_FALSE(stiff);
	CHECK(stiff.error().name == "stiffness");
	CHECK_FALSE(SoftBodyCreator::create_polygon(usual, {}).value()->resized(1, options.mass));
}

// Found by fuzz_shape: -0 passes as a damping, and the step that it grants an explicit method is -0 too.
TEST_CASE("a damping of -0 is planned like one of 0") {
	for (const Integrator method : { Integrator::EXPLICIT_EULER, Integrator::HEUN, Integrator::RUNGE_KUTTA_4 }) {
		BodySettings settings;
		settings.integrator = method;
		const SubstepPlan none = plan_substeps(*thesis_shape(100, 0), settings, Real(1) / 60, false);
		const SubstepPlan minus = plan_substeps(*thesis_shape(100, Real(-0.0)), settings, Real(1) / 60, false);
		CHECK(minus.substeps == none.substeps);
		CHECK(minus.safe == none.safe);
	}
}
