// SPDX-License-Identifier: MIT
// What a body costs in memory, with all that a step needs.
#include "core/dynamics/simulator.h"
#include "scenes/thesis_body.h"
#include "support/allocations.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60;

void add_pile(WorldData &world, int count) {
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	BodySettings settings;
	settings.shape_stiffness = 240;
	settings.shape_damping = 3;
	settings.rolling_resistance = Real(0.03);
	const auto shape = thesis_shape(600, 1);
	const int columns = count / 10;
	for (int i = 0; i < count; ++i) {
		world.add_soft_body(thesis_body(shape, settings,
				{ { Real(1.05) * Real(i % columns), Real(0.55) + Real(1.05) * Real(i / columns) }, {} }));
	}
}

} // namespace

TEST_CASE("a thesis body in a pile takes at most one and a half kibibytes, in double twice that") {
	constexpr int COUNT = 4000;
	const std::size_t before = allocated_bytes();
	WorldData world;
	add_pile(world, COUNT);
	Simulator simulator(world);
	std::uint64_t contacts = 0;
	for (int i = 0; i < 40; ++i) {
		contacts = simulator.simulate(FRAME).pair_contacts;
	}
	CHECK(contacts > COUNT); // it is a pile
	const double bytes = double(allocated_bytes() - before) / COUNT;
	CAPTURE(bytes);
#ifdef _WIN32
	constexpr double PADDING = 16; // Structures are laid out as Microsoft's compiler does it there: 1,503 bytes instead of 1,487.
#else
	constexpr double PADDING = 0;
#endif
	CHECK(bytes <= 1536.0 * sizeof(Real) / sizeof(float) + PADDING);
	CHECK(bytes > 300); // or else nothing was counted
}

TEST_CASE("stepping on and on takes no more memory") {
	WorldData world;
	add_pile(world, 300);
	Simulator simulator(world);
	for (int i = 0; i < 300; ++i) {
		simulator.simulate(FRAME);
	}
	const std::size_t settled = allocated_bytes();
	for (int i = 0; i < 300; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(double(allocated_bytes()) <= 1.02 * double(settled));
}
