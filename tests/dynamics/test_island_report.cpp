// SPDX-License-Identifier: MIT
// Claims about the report of islands: which bodies an island has, its contact substeps, and the contact error that they leave,
// beside a measurement by brute force.
#include "core/dynamics/simulator.h"
#include "core/collision/hull_overlap.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
	const double ax = a.x, ay = a.y, wx = double(b.x) - ax, wy = double(b.y) - ay;
	const double size = wx * wx + wy * wy;
	const double t = size > 0 ? std::clamp(((double(p.x) - ax) * wx + (double(p.y) - ay) * wy) / size, 0.0, 1.0) : 0.0;
	return std::hypot(double(p.x) - ax - t * wx, double(p.y) - ay - t * wy);
}

// Whether the hull winds around p, by the angles under which p sees its edges.
bool winds_around(std::span<const Vec2> hull, Vec2 p) {
	double turn = 0;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 a = hull[i] - p;
		const Vec2 b = hull[(i + 1) % hull.size()] - p;
		turn += std::atan2(double(a.x) * b.y - double(a.y) * b.x, double(a.x) * b.x + double(a.y) * b.y);
	}
	return std::abs(turn) > 1;
}

double overlap_by_force(std::span<const Vec2> a, std::span<const Vec2> b) {
	double deepest = 0;
	for (const auto &[points, hull] : { std::pair(a, b), std::pair(b, a) }) {
		for (const Vec2 p : points) {
			if (!winds_around(hull, p)) {
				continue;
			}
			double nearest = INFINITY;
			for (std::size_t i = 0; i < hull.size(); ++i) {
				nearest = std::min(nearest, distance_to_segment(p, hull[i], hull[(i + 1) % hull.size()]));
			}
			deepest = std::max(deepest, nearest);
		}
	}
	return deepest;
}

WorldData heaps(std::uint64_t seed, Real stiffness) {
	Random random(seed);
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { JELLY_MASS, stiffness, JELLY_DAMPING, true }).value();
	for (int heap = 0; heap < 3; ++heap) {
		for (int i = 0; i < 8; ++i) {
			const Vec2 center{ Real(heap) * 2000 + Real(random.real(-60, 60)), -JELLY_RADIUS * Real(1 + 2 * i) };
			world.add_soft_body(SoftBodyData::create(shape, jelly_settings(), Pose{ center, {} }).value());
		}
	}
	return world;
}

} // namespace

TEST_CASE("the overlap of two hulls is that of a search by brute force") {
	Random random(19);
	int overlapping = 0;
	for (int trial = 0; trial < 500; ++trial) {
		CAPTURE(trial);
		std::vector<Vec2> hulls[2];
		for (std::vector<Vec2> &hull : hulls) { // stars, so dents too
			const int points = 5 + int(random.real(0, 30));
			const Vec2 center{ Real(random.real(-30, 30)), Real(random.real(-30, 30)) };
			for (int i = 0; i < points; ++i) {
				const double angle = 2 * std::numbers::pi * i / points;
				const double radius = random.real(15, 40);
				hull.push_back(center + Vec2{ Real(radius * std::cos(angle)), Real(radius * std::sin(angle)) });
			}
		}
		const double expected = overlap_by_force(hulls[0], hulls[1]);
		overlapping += expected > 0;
		CHECK(std::abs(double(measure_overlap(hulls[0], hulls[1])) - expected) < 1e-3);
		CHECK(measure_overlap(hulls[0], hulls[1]) == measure_overlap(hulls[1], hulls[0]));
	}
	CHECK(overlapping > 300);
}

TEST_CASE("islands are reported with their bodies, substeps and contact error, and reporting moves nothing") {
	for (const std::uint64_t seed : { 1, 2, 3, 4 }) {
		CAPTURE(seed);
		WorldData world = heaps(seed, seed % 2 == 0 ? 10 * JELLY_STIFFNESS : 30 * JELLY_STIFFNESS);
		WorldData twin = heaps(seed, seed % 2 == 0 ? 10 * JELLY_STIFFNESS : 30 * JELLY_STIFFNESS);
		Simulator simulator(world);
		Simulator silent(twin);
		simulator.set_reporting_islands(true);
		double deepest = 0;
		for (int tick = 0; tick < 120; ++tick) {
			const StepReport report = simulator.simulate(FRAME);
			CHECK(silent.simulate(FRAME).islands.empty());
			std::uint32_t moved = 0;
			double overlap = 0;
			double penetration = 0;
			std::set<std::size_t> names;
			for (const IslandReport &island : report.islands) {
				moved += island.bodies;
				overlap = std::max(overlap, double(island.overlap));
				penetration = std::max(penetration, double(island.penetration));
				const SoftBodyData *first = world.find(island.first);
				REQUIRE(first != nullptr);
				CHECK(world.find(island.deepest) != nullptr);
				CHECK(names.insert(std::size_t(first - world.soft_bodies().data())).second);
				CHECK(island.bodies <= 8); // the heaps are far from one another
				CHECK(island.contact_substeps >= 1);
			}
			REQUIRE(moved <= 24);
			double expected = 0;
			for (std::size_t i = 0; i < 24; ++i) {
				for (std::size_t j = 0; j < i; ++j) {
					expected = std::max(expected, overlap_by_force(world.soft_bodies()[i].hull(), world.soft_bodies()[j].hull()));
				}
				const auto a = world.soft_bodies()[i].positions();
				const auto b = twin.soft_bodies()[i].positions();
				REQUIRE(std::ranges::equal(a, b));
			}
			if (moved == 24) { // else what rests overlaps, too
				CHECK(std::abs(overlap - expected) < 1e-3);
			}
			deepest = std::max(deepest, overlap + penetration);
		}
		CHECK(deepest > 0.001);
	}
}

TEST_CASE("more contact substeps leave less error, and the report says how much: 20 heaps" * doctest::test_suite("slow")) {
	std::map<int, double> left;
	for (std::uint64_t seed = 1; seed <= 20; ++seed) {
		for (const int substeps : { 4, 32 }) {
			WorldData world = heaps(seed, 4 * JELLY_STIFFNESS);
			REQUIRE_FALSE(world.set_contact_substeps(substeps));
			Simulator simulator(world);
			simulator.set_reporting_islands(true);
			double worst = 0;
			for (int tick = 0; tick < 120; ++tick) {
				for (const IslandReport &island : simulator.simulate(FRAME).islands) {
					worst = std::max(worst, double(island.overlap));
					CHECK((island.bodies == 1 || island.contact_substeps >= substeps));
				}
			}
			left[substeps] += worst / 20;
		}
	}
	MESSAGE("left by 4: " << left[4] << " px, by 32: " << left[32] << " px, of 20 heaps each");
	CHECK(3 * left[32] < 2 * left[4]);
}
