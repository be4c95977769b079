// SPDX-License-Identifier: MIT
// Collision exceptions between bodies, and surroundings that a body ignores by their tag.
#include "core/dynamics/simulator.h"
#include "scenes/jelly.h"
#include "support/compare.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr std::uint64_t FLOOR = 7;
constexpr std::uint64_t SHELF = 9;

BodySettings monitoring() {
	BodySettings settings = jelly_settings();
	settings.contact_monitor = true;
	return settings;
}

Surface tagged(std::uint64_t tag) {
	Surface surface;
	surface.tag = tag;
	return surface;
}

Real lowest(const SoftBodyData &body) { // y is down
	return std::ranges::max(body.hull(), {}, &Vec2::y).y;
}

// Two circles, one on the other.
struct Tower {
	WorldData world = pixel_world();
	Simulator simulator{ world };
	BodyId below;
	BodyId above;

	Tower() {
		world.add_border(floor_at(0, tagged(FLOOR)));
		below = world.add_soft_body(jelly_circle({ 0, -52 }, monitoring()));
		above = world.add_soft_body(jelly_circle({ 0, -160 }, monitoring()));
	}
	StepReport step(int count) {
		StepReport report;
		for (int i = 0; i < count; ++i) {
			report = simulator.simulate(FRAME);
		}
		return report;
	}
};

} // namespace

TEST_CASE("bodies with an exception pass through each other, either way round, and collide again without it") {
	for (const bool swapped : { false, true }) {
		Tower tower;
		const BodyId a = swapped ? tower.above : tower.below;
		const BodyId b = swapped ? tower.below : tower.above;
		CHECK_FALSE(tower.world.has_collision_exception(a, b));
		REQUIRE_FALSE(tower.world.add_collision_exception(a, b));
		REQUIRE_FALSE(tower.world.add_collision_exception(b, a)); // twice is once
		CHECK(tower.world.collision_exceptions().size() == 1);
		CHECK(tower.world.has_collision_exception(a, b));
		CHECK(tower.world.has_collision_exception(b, a));
		std::uint64_t contacts = 0;
		for (int i = 0; i < 120; ++i) {
			contacts += tower.step(1).pair_contacts;
		}
		CHECK(contacts == 0);
		CHECK(std::abs(lowest(*tower.world.find(tower.above))) < 2); // on the floor, inside the other
		CHECK(tower.world.remove_collision_exception(b, a));
		CHECK_FALSE(tower.world.remove_collision_exception(b, a));
		CHECK_FALSE(tower.world.has_collision_exception(a, b));
		CHECK(tower.step(1).pair_contacts > 0);
	}
	Tower tower;
	tower.step(120);
	CHECK(lowest(*tower.world.find(tower.above)) < -50);
}

TEST_CASE("an exception wakes both bodies, ends their touch, and ends with either body") {
	Tower tower;
	for (int i = 0; i < 2000 && tower.step(1).sleeping_bodies < 2; ++i) {
	}
	REQUIRE(tower.world.find(tower.above)->is_asleep());
	const auto touches_each_other = [&] {
		return std::ranges::any_of(tower.simulator.touches(), [](const Touch &t) { return t.other.kind == ContactOther::Kind::SOFT_BODY; });
	};
	CHECK(touches_each_other());
	tower.world.add_collision_exception(tower.above, tower.below);
	CHECK(tower.step(1).sleeping_bodies == 0);
	CHECK_FALSE(touches_each_other());
	CHECK(std::ranges::count(tower.simulator.contact_events(), ContactEvent::Kind::END, &ContactEvent::kind) == 2);
	tower.step(60);
	CHECK(std::abs(lowest(*tower.world.find(tower.above))) < 2);
	tower.world.remove_soft_body(tower.above);
	CHECK(tower.world.collision_exceptions().empty());
	const BodyId next = tower.world.add_soft_body(jelly_circle({ 3, -160 })); // in the same slot
	CHECK(next.index == tower.above.index);
	CHECK_FALSE(tower.world.has_collision_exception(next, tower.below));
}

TEST_CASE("exceptions of bodies that are not there, or with oneself, are refused by name") {
	Tower tower;
	for (const Status &status : { tower.world.add_collision_exception(tower.above, {}), tower.world.add_collision_exception({}, tower.above),
				 tower.world.add_collision_exception(tower.above, tower.above) }) {
		REQUIRE(status);
		CHECK(status->name == "body");
	}
	CHECK(tower.world.collision_exceptions().empty());
}

TEST_CASE("an exception among many bodies concerns no other pair") {
	const auto run = [](bool has_exception) {
		WorldData world = pixel_world();
		world.add_border(floor_at(0));
		std::vector<BodyId> ids;
		for (int i = 0; i < 12; ++i) {
			ids.push_back(world.add_soft_body(jelly_circle({ Real(i % 3) * 101, -55 - Real(i / 3) * 104 })));
		}
		const BodyId far = world.add_soft_body(jelly_circle({ 5000, -300 }));
		if (has_exception) {
			world.add_collision_exception(ids[0], far); // who never meet
		}
		Simulator simulator(world);
		for (int i = 0; i < 120; ++i) {
			simulator.simulate(FRAME);
		}
		return copy_of(world.find(ids[7])->positions());
	};
	CHECK(identical(run(true), run(false)));
}

TEST_CASE("surroundings whose tag a body ignores do not exist for it, be they border, collider, mover or crate") {
	for (const int kind : { 0, 1, 2, 3 }) {
		CAPTURE(kind);
		WorldData world = pixel_world();
		world.add_border(floor_at(300));
		Collider shelf = box_collider({ 0, 10 }, { 400, 10 });
		shelf.surface.tag = SHELF;
		if (kind == 0) {
			world.add_border(floor_at(0, tagged(SHELF)));
		} else {
			if (kind > 1) {
				RigidBody body;
				body.inverse_mass = kind == 3 ? Real(1e-6) : Real(0);
				shelf.rigid_body = world.add_rigid_body(body).value();
			}
			world.add_collider(shelf);
		}
		std::array<BodyId, 8> ids;
		for (std::size_t i = 0; i < ids.size(); ++i) { // some of them would share a batch
			ids[i] = world.add_soft_body(jelly_circle({ Real(i) * 110 - 385, -60 }, monitoring()));
		}
		const std::array<std::uint64_t, 4> tags = { 0, 100, SHELF, SHELF };
		world.find(ids[2])->set_ignored_tags(tags);
		CHECK(world.find(ids[2])->ignored_tags().size() == 2);
		Simulator simulator(world);
		for (int tick = 0; tick < 150; ++tick) {
			simulator.simulate(FRAME);
		}
		for (std::size_t i = 0; i < ids.size(); ++i) {
			const Real foot = lowest(*world.find(ids[i]));
			CHECK((i == 2 ? foot > 280 : foot < 20));
		}
		CHECK(measure_penetration(world, *world.find(ids[2])) < 5);
		CHECK(std::ranges::none_of(simulator.touches(), [&](const Touch &t) { return t.body == ids[2] && t.other.tag == SHELF; }));
		// Not ignored any more, it is a body that starts below the shelf.
		world.find(ids[2])->set_ignored_tags({});
		CHECK(world.find(ids[2])->ignored_tags().empty());
	}
}

TEST_CASE("a body that sleeps on what it is told to ignore wakes, falls, and no longer touches it") {
	WorldData world = pixel_world();
	world.add_border(floor_at(300));
	world.add_border(floor_at(0, tagged(SHELF)));
	const BodyId id = world.add_soft_body(jelly_circle({ 0, -52 }, monitoring()));
	Simulator simulator(world);
	for (int tick = 0; tick < 2000 && simulator.simulate(FRAME).sleeping_bodies == 0; ++tick) {
	}
	REQUIRE(world.find(id)->is_asleep());
	REQUIRE(simulator.touches().size() == 1);
	const std::uint64_t tag = SHELF;
	world.find(id)->set_ignored_tags({ &tag, 1 });
	simulator.simulate(FRAME);
	CHECK_FALSE(world.find(id)->is_asleep());
	CHECK(simulator.touches().empty());
	for (int tick = 0; tick < 60; ++tick) {
		simulator.simulate(FRAME);
	}
	CHECK(lowest(*world.find(id)) > 250);
}
