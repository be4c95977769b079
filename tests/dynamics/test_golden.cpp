// SPDX-License-Identifier: MIT
// A scene with nearly everything in it ends in the same bits: on any number of threads, in every run, by every compiler.
#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/lane_stepper.h"
#include "scenes/mixed.h"
#include "support/skip.h"
#include "support/threads.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr int TICKS = 240;

struct Outcome {
	std::uint64_t state = 0;
	std::uint64_t contacts = 0;
	std::size_t most_asleep = 0;
	std::size_t resets = 0;
	std::size_t events = 0;
	friend bool operator==(const Outcome &, const Outcome &) = default;
};

Outcome run(Real spin, const ParallelFor &threads) {
	WorldData world = mixed_world(spin);
	Simulator simulator(world, threads);
	Outcome result;
	for (int tick = 0; tick < TICKS; ++tick) {
		const StepReport report = simulator.simulate(Real(1) / 60);
		BitHash contacts;
		contacts.add(result.contacts);
		contacts.add(hash_of_contacts(simulator));
		result.contacts = contacts.value();
		result.most_asleep = std::max(result.most_asleep, report.sleeping_bodies);
		result.resets += report.reset_bodies.size();
		result.events += simulator.contact_events().size();
	}
	result.state = hash_of_state(world);
	return result;
}

} // namespace

TEST_CASE("a mixed scene ends in the same bits on 1, 2, 3 and 8 threads and in another run" *
		doctest::test_suite("threads")) {
	for (const Real spin : { Real(0), Real(2) }) {
		CAPTURE(spin);
		const Outcome alone = run(spin, {});
		CHECK(run(spin, {}) == alone);
		for (const std::size_t threads : { 2, 3, 8 }) {
			CHECK(run(spin, on_threads(threads)) == alone);
		}
		// Or else the scene says less than it promises.
		CHECK(alone.most_asleep > 0);
		CHECK(alone.resets == 0);
		CHECK(alone.events > 50);
	}
}

TEST_CASE("a mixed scene ends in the same bits with the widest registers of the processor and without" * SINGLE_PRECISION_ONLY) {
	if (make_wide_stepper() == nullptr) {
		SKIP_TEST("no registers of that width here");
	}
	const Outcome wide = run(0, {});
	allow_wide_steppers(false);
	CHECK(make_wide_stepper() == nullptr);
	const Outcome narrow = run(0, {});
	allow_wide_steppers(true);
	CHECK(narrow == wide);
}

// Sums of squares, roots, products and comparisons round alike everywhere, as long as nothing is contracted and vectors are
// used lane by lane. Functions of a library of mathematics need not, so the core has its own (core/base/elementary.h). Found
// with GCC 12 and Clang 14 at -O0, -O2 and -O3 on x86-64, and with GCC on arm64 and Windows. Who changes what a step computes, or the scene, writes the new numbers here; who did not mean to has found a fault.
TEST_CASE("a mixed scene ends in the bits that it always has ended in") {
#ifdef __GNUC__
	const Outcome result = run(0, {});
	const bool is_float = sizeof(Real) == sizeof(float);
	CHECK(result.state == (is_float ? 0x507775d6edcebc94u : 0x23958bfc5592ba4au));
	CHECK(result.contacts == (is_float ? 0x611d3377e1bdf64au : 0xbab0dd14c7d27e20u));
#else
	SKIP_TEST("these bits are known of GCC and Clang alone");
#endif
}
