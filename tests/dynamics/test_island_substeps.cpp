// SPDX-License-Identifier: MIT
// Claims about contact substeps: a heap takes as many as the one of it that needs most, and what else there is in the world
// changes nothing about it, to the last bit.
#include "core/base/constants.h"
#include "core/dynamics/contact_substeps.h"
#include "core/dynamics/simulator.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <string>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real SOFT = JELLY_STIFFNESS;
constexpr Real STIFF = 40 * JELLY_STIFFNESS;
constexpr Real APART = 3000; ///< between islands [px]
constexpr Real TOUCHING = Real(1.98) * JELLY_RADIUS; ///< between the centers of two that are pressed together [px]

auto jelly_shape(Real stiffness) {
	return circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { JELLY_MASS, stiffness, JELLY_DAMPING, true }).value();
}

/// Of one shape for each stiffness, so that four of them make a batch.
BodyId add_jelly(WorldData &world, Vec2 center, Real stiffness, BodySettings settings = jelly_settings()) {
	static const auto soft = jelly_shape(SOFT);
	static const auto stiff = jelly_shape(STIFF);
	const auto shape = stiffness == SOFT ? soft : stiffness == STIFF ? stiff : jelly_shape(stiffness);
	return world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ center, {} }).value());
}

/// A row of bodies that press on one another, on the floor.
void add_row(WorldData &world, Real x, Real stiffness, int count) {
	for (int i = 0; i < count; ++i) {
		add_jelly(world, { x + TOUCHING * Real(i), -JELLY_RADIUS }, stiffness);
	}
}

std::uint32_t add_crate(WorldData &world, Vec2 center) {
	RigidBody crate;
	crate.pose.position = center;
	crate.inverse_mass = 1;
	crate.inverse_inertia = Real(0.001);
	crate.acceleration = world.gravity();
	crate.tag = 1 + world.rigid_bodies().size();
	const std::uint32_t place = world.add_rigid_body(crate).value();
	Collider box = box_collider({}, { 40, 40 });
	box.rigid_body = place;
	REQUIRE_FALSE(world.add_collider(box));
	return place;
}

WorldData floor_world() {
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	return world;
}

// All bodies start at rest shape.
int needed(WorldData &world, std::size_t place) {
	const SoftBodyData &body = world.soft_bodies()[place];
	return plan_near_rest(Simulator(world).plan(body, FRAME), body.shape(), body.settings(), FRAME).substeps;
}

enum class Elsewhere { NOTHING,
	STIFF_HEAP,
	STIFF_CHAIN,
	STIFF_ON_CRATE,
	EVERYTHING };

void add_elsewhere(WorldData &world, Elsewhere what) {
	const bool all = what == Elsewhere::EVERYTHING;
	if (all || what == Elsewhere::STIFF_HEAP) {
		add_row(world, 10 * APART, STIFF, 3);
	}
	if (all || what == Elsewhere::STIFF_CHAIN) {
		BodyId last = add_jelly(world, { 12 * APART, -500 }, STIFF);
		Joint hook;
		hook.first = JointAnchor::on_point(last, 0);
		hook.second = JointAnchor::at_place({ 12 * APART + 60, -500 });
		REQUIRE(world.add_joint(hook).has_value());
		const BodyId next = add_jelly(world, { 12 * APART - 110, -500 }, STIFF);
		Joint link;
		link.first = JointAnchor::on_point(last, JELLY_HULL_POINTS / 2);
		link.second = JointAnchor::on_point(next, 0);
		REQUIRE(world.add_joint(link).has_value());
	}
	if (all || what == Elsewhere::STIFF_ON_CRATE) {
		add_jelly(world, { 14 * APART, -JELLY_RADIUS }, STIFF);
		add_crate(world, { 14 * APART, -2 * JELLY_RADIUS - 45 });
	}
}

} // namespace

TEST_CASE("a heap takes as many substeps as its neediest body, and nobody else takes more than it needs") {
	WorldData world = floor_world();
	world.set_sleeping(false);
	add_row(world, 0, SOFT, 2);
	add_row(world, APART, STIFF, 2);
	add_jelly(world, { 2 * APART, -JELLY_RADIUS }, SOFT); // of the same batch as the first two, and the next
	add_jelly(world, { 3 * APART, -JELLY_RADIUS }, SOFT);
	const std::uint64_t soft = std::uint64_t(needed(world, 0));
	const std::uint64_t stiff = std::uint64_t(needed(world, 2));
	REQUIRE(soft < stiff);
	REQUIRE(stiff <= std::uint64_t(MAX_CONTACT_SUBSTEPS));
	CHECK(Simulator(world).simulate(FRAME).substeps == 4 * soft + 2 * stiff);

	SUBCASE("a stiff body that comes to soft ones makes all of that heap take more") {
		add_jelly(world, { -TOUCHING, -JELLY_RADIUS }, STIFF);
		CHECK(Simulator(world).simulate(FRAME).substeps == 2 * soft + 5 * stiff);
	}
	SUBCASE("who is joined is of one heap") {
		Joint link;
		link.first = JointAnchor::on_point(world.id_at(1), 0);
		link.second = JointAnchor::on_point(world.id_at(2), JELLY_HULL_POINTS / 2);
		link.rest_length = APART;
		REQUIRE(world.add_joint(link).has_value());
		CHECK(Simulator(world).simulate(FRAME).substeps == 2 * soft + 4 * stiff);
	}
	SUBCASE("all who meet dynamic rigid bodies are one heap") {
		add_crate(world, { 0, -2 * JELLY_RADIUS - 41 });
		add_crate(world, { APART, -2 * JELLY_RADIUS - 41 });
		CHECK(Simulator(world).simulate(FRAME).substeps == 2 * soft + 4 * stiff);
	}
	SUBCASE("what lies on the same frozen body is one heap") {
		for (const std::size_t place : { std::size_t(1), std::size_t(3) }) {
			world.soft_bodies()[place].set_frozen(true); // it is stepped no more
		}
		CHECK(Simulator(world).simulate(FRAME).substeps == 3 * soft + stiff);
		add_jelly(world, { -TOUCHING, -JELLY_RADIUS }, STIFF);
		CHECK(Simulator(world).simulate(FRAME).substeps == 2 * soft + 3 * stiff);
	}
	SUBCASE("who may touch takes the world's contact substeps at least, who may not what it needs") {
		REQUIRE_FALSE(world.set_contact_substeps(int(stiff) + 3));
		CHECK(Simulator(world).simulate(FRAME).substeps == 4 * (stiff + 3) + 2 * soft);
	}
}

TEST_CASE("what a heap does depends on that heap alone, to the last bit") {
	struct Run {
		std::vector<Vec2> points;
		std::vector<Vec2> crate;
	};
	const auto run = [](Elsewhere what, Real failure, bool with_crate) {
		WorldData world = floor_world();
		add_row(world, 0, SOFT, 2); // one batch: two that touch, and two that touch nobody
		add_jelly(world, { APART, -3 * JELLY_RADIUS }, SOFT);
		add_jelly(world, { 2 * APART, Real(-1.5) * JELLY_RADIUS }, SOFT);
		const BodyId loose = add_jelly(world, { 3 * APART, -200 }, Real(1.3) * SOFT); // swings alone on its joint
		Joint hook;
		hook.first = JointAnchor::on_point(loose, 0);
		hook.second = JointAnchor::at_place({ 3 * APART + 60, -200 });
		REQUIRE(world.add_joint(hook).has_value());
		if (with_crate) {
			add_crate(world, { 4 * APART, -1e5 }); // which falls alone, or the heap of all crates is not to be told from it
		}
		const std::size_t watched = world.soft_bodies().size();
		add_elsewhere(world, what);
		Simulator simulator(world);
		Run result;
		for (int tick = 0; tick < 90; ++tick) {
			if (failure != 0 && tick == 20) {
				world.soft_bodies()[watched].mutable_positions()[3].x = failure;
			}
			simulator.simulate(FRAME);
			for (std::size_t i = 0; i < watched; ++i) {
				const auto positions = world.soft_bodies()[i].positions();
				result.points.insert(result.points.end(), positions.begin(), positions.end());
			}
			if (with_crate) {
				result.crate.push_back(world.rigid_bodies()[0].pose.position);
			}
		}
		return result;
	};
	for (const bool with_crate : { false, true }) {
		const Run alone = run(Elsewhere::NOTHING, 0, with_crate);
		for (const Elsewhere what : { Elsewhere::STIFF_HEAP, Elsewhere::STIFF_CHAIN, Elsewhere::STIFF_ON_CRATE, Elsewhere::EVERYTHING }) {
			CAPTURE(int(what));
			CAPTURE(with_crate);
			// Nor does a body that is everywhere, until it is reset, put all into one heap.
			for (const Real failure : { Real(0), INFINITE, -INFINITE, NOT_A_NUMBER }) {
				CAPTURE(failure);
				const Run beside = run(what, failure, with_crate);
				CHECK(identical(beside.points, alone.points));
				if (what == Elsewhere::STIFF_HEAP || what == Elsewhere::STIFF_CHAIN) {
					CHECK(identical(beside.crate, alone.crate));
				}
			}
		}
	}
}

TEST_CASE("bodies of one shape go side by side, some of them in a heap, in the bits in which each goes alone" * doctest::test_suite("slow")) {
	struct Run {
		std::vector<Vec2> points;
		std::vector<Real> contacts;
		std::uint64_t counts[3] = {};
		std::vector<std::size_t> resets;
	};
	const auto run = [](std::uint64_t seed, bool are_like, Integrator integrator) {
		Random random(seed);
		WorldData world = floor_world();
		REQUIRE_FALSE(world.set_contact_substeps(random.integer(5, 9))); // others than a body takes that touches nobody
		world.set_sleeping(random.chance(0.5));
		const Real restitution = random.chance(0.3) ? Real(0.4) : Real(0);
		const bool has_boxes = random.chance(0.5);
		const auto shape = jelly_shape(SOFT);
		BodySettings settings = jelly_settings();
		settings.integrator = integrator;
		settings.restitution = restitution;
		// Then each takes what its hull needs. One that fails goes on in the same step where that is divided, and alone it does not.
		const bool has_pressure = seed % 2 == 0;
		settings.pressure_stiffness = has_pressure ? random.real(2000, 60000) : Real(0);
		for (int i = 0; i < 24; ++i) {
			settings.contact_monitor = random.chance(0.3);
			const Vec2 center{ Real(250 * i), -JELLY_RADIUS - random.real(0, 100) };
			world.add_soft_body(SoftBodyData::create(are_like ? shape : jelly_shape(SOFT), settings, Pose{ center, {} }).value());
			if (has_boxes && random.chance(0.3)) {
				REQUIRE_FALSE(world.add_collider(box_collider({ center.x + 30, 0 }, { 20, 40 })));
			}
			if (random.chance(0.4)) { // another beside it
				world.add_soft_body(SoftBodyData::create(jelly_shape(SOFT), settings,
						Pose{ { center.x + TOUCHING, -JELLY_RADIUS }, {} }).value());
			}
		}
		Simulator simulator(world);
		Run result;
		for (int tick = 0; tick < 90; ++tick) {
			if (tick == 30 && !has_pressure) {
				world.soft_bodies()[std::size_t(random.integer(0, 20))].mutable_velocities()[2].x = NOT_A_NUMBER;
				world.soft_bodies()[std::size_t(random.integer(0, 20))].mutable_positions()[5].y = INFINITE;
			}
			const StepReport report = simulator.simulate(FRAME);
			result.counts[0] += report.substeps;
			result.counts[1] += report.contacts;
			result.counts[2] += report.pair_contacts;
			for (const BodyId id : report.reset_bodies) {
				result.resets.push_back(std::size_t(world.find(id) - world.soft_bodies().data()));
			}
			for (const Contact &contact : simulator.contacts()) {
				result.contacts.push_back(contact.point.x);
				result.contacts.push_back(contact.normal_impulse);
			}
			for (const SoftBodyData &body : world.soft_bodies()) {
				for (const auto points : { body.positions(), body.previous_positions(), body.velocities() }) {
					result.points.insert(result.points.end(), points.begin(), points.end());
				}
			}
		}
		return result;
	};
	for (const Integrator integrator : { Integrator::AUTOMATIC, Integrator::VELOCITY_VERLET, Integrator::RUNGE_KUTTA_4 }) {
		for (std::uint64_t seed = 1; seed <= 8; ++seed) {
			CAPTURE(int(integrator));
			CAPTURE(seed);
			const Run side_by_side = run(seed, true, integrator);
			const Run alone = run(seed, false, integrator);
			CHECK(identical(side_by_side.points, alone.points));
			CHECK(side_by_side.contacts == alone.contacts);
			CHECK(std::ranges::equal(side_by_side.counts, alone.counts));
			CHECK(side_by_side.resets == alone.resets);
			CHECK(alone.resets.empty() == (seed % 2 == 0));
		}
	}
}

TEST_CASE("a body under pressure that needs more substeps, and fails, changes no bit of another heap") {
	const auto run = [](bool fails, FailureResponse response) {
		WorldData world = floor_world();
		BodySettings settings = jelly_settings();
		settings.pressure_stiffness = 60000;
		settings.failure_response = response;
		add_jelly(world, { 0, -JELLY_RADIUS }, SOFT, settings);
		add_row(world, TOUCHING, SOFT, 1);
		add_row(world, APART, SOFT, 3);
		CHECK(needed(world, 0) > needed(world, 1));
		Simulator simulator(world);
		std::vector<Vec2> points;
		std::size_t resets = 0;
		for (int tick = 0; tick < 60; ++tick) {
			if (fails && tick == 10) {
				world.soft_bodies()[0].mutable_positions()[3].y = NOT_A_NUMBER;
			}
			resets += simulator.simulate(FRAME).reset_bodies.size();
			for (std::size_t i = 2; i < world.soft_bodies().size(); ++i) {
				const auto positions = world.soft_bodies()[i].positions();
				points.insert(points.end(), positions.begin(), positions.end());
			}
		}
		CHECK(resets == std::size_t(fails));
		return points;
	};
	const std::vector<Vec2> sound = run(false, FailureResponse::RESET);
	CHECK(identical(run(true, FailureResponse::RESET), sound));
	CHECK(identical(run(true, FailureResponse::FREEZE), sound));
}

TEST_CASE("islands are what is joined, directly or through others, and need what the neediest does") {
	Random random(20261122);
	for (int trial = 0; trial < 200; ++trial) {
		const std::uint32_t rows = std::uint32_t(random.integer(1, 40));
		IslandSubsteps islands;
		islands.begin(rows);
		std::vector<std::uint32_t> label(rows); // by painting over, as an oracle
		std::iota(label.begin(), label.end(), 0u);
		for (int i = random.integer(0, 30); i > 0; --i) {
			const std::uint32_t a = std::uint32_t(random.integer(0, int(rows) - 1));
			const std::uint32_t b = std::uint32_t(random.integer(0, int(rows) - 1));
			islands.join(a, b);
			const std::uint32_t painted = label[b];
			const std::uint32_t color = label[a];
			std::ranges::replace(label, painted, color);
		}
		std::vector<int> needs(rows, 0);
		for (std::uint32_t row = 0; row < rows; ++row) {
			if (random.integer(0, 3) > 0) {
				needs[row] = random.integer(1, 6);
				islands.need(row, needs[row]);
			}
		}
		islands.finish();
		std::vector<int> counts;
		for (std::uint32_t row = 0; row < rows; ++row) {
			int most = 0;
			for (std::uint32_t other = 0; other < rows; ++other) {
				most = label[other] == label[row] ? std::max(most, needs[other]) : most;
			}
			CHECK(islands.of(row) == (needs[row] > 0 ? most : 0));
			counts.push_back(islands.of(row));
		}
		std::ranges::sort(counts);
		counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
		std::erase(counts, 0);
		CHECK(std::ranges::equal(islands.counts(), counts));
		for (const int count : counts) {
			for (std::uint32_t row = 0; row < rows; ++row) {
				CHECK(islands.group(count).has(row) == (islands.of(row) == count));
			}
		}
		islands.set_common(7);
		CHECK(islands.of(0) == 7);
		CHECK(islands.group(7).has(rows - 1));
	}
}
