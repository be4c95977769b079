// SPDX-License-Identifier: MIT
// What a step computes depends on the state alone: put back, bodies go on in the same bits.
#include "core/dynamics/simulator.h"
#include "scenes/chain.h"
#include "scenes/jelly.h"
#include "scenes/mixed.h"
#include "support/threads.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;

// 60 bodies over a floor, a box, a chain and a lift that goes up and stays; some match their shape. In a lively world some
// bounce and some collide with themselves, in another all fall asleep.
WorldData pile_world(bool is_lively = true) {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	world.add_border({ { { -3, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 3, 0 }, { -1, 0 } }, {} });
	world.add_collider({ { { -1, 0 }, { 0, 0 }, { 0, Real(0.4) }, { -1, Real(0.6) } }, Real(0.05), {} });
	add_chain(world, std::vector<Vec2>{ { 1, 1 }, { 2, Real(0.6) }, { 3, Real(0.5) } }, false);
	RigidBody lift;
	lift.pose.position = { Real(-2.2), Real(0.1) };
	Collider box{ { { Real(-0.5), Real(-0.1) }, { Real(0.5), Real(-0.1) }, { Real(0.5), Real(0.1) }, { Real(-0.5), Real(0.1) } }, 0, {} };
	box.rigid_body = world.add_rigid_body(lift).value();
	world.add_collider(box);
	const auto firm = octagon(Real(0.25), 1000, 2);
	const auto soft = octagon(Real(0.2), 400, 1);
	for (int i = 0; i < 60; ++i) {
		BodySettings settings;
		settings.rolling_resistance = Real(0.05);
		settings.shape_stiffness = !is_lively || i % 3 == 0 ? 400 : 0;
		settings.shape_damping = !is_lively || i % 3 == 0 ? 4 : 0;
		settings.restitution = is_lively && i % 10 == 9 ? Real(0.5) : Real(0);
		settings.self_collision = is_lively && i % 20 == 7;
		world.add_soft_body(SoftBodyData::create(i % 2 ? firm : soft, settings,
				{ { Real(-2.6) + Real(0.56) * Real(i % 10) + Real(0.03) * Real(i / 10), Real(1.6) + Real(0.56) * Real(i / 10) }, {} })
						.value());
	}
	return world;
}

void drive(WorldData &world, int tick) {
	RigidBody lift = world.rigid_bodies()[0];
	lift.linear_velocity = { 0, tick < 40 ? Real(0.6) : tick < 620 ? Real(0) : Real(0.3) };
	lift.linear_velocity.y = tick > 640 ? Real(0) : lift.linear_velocity.y;
	world.set_rigid_body(0, lift);
}

struct Snapshot {
	std::vector<BodyState> bodies;
	RigidBody lift;
	int tick = 0;
};

Snapshot snapshot(const WorldData &world, int tick) {
	Snapshot result{ {}, world.rigid_bodies()[0], tick };
	for (const SoftBodyData &body : world.soft_bodies()) {
		result.bodies.push_back(body.save_state());
	}
	return result;
}

void restore(WorldData &world, const Snapshot &from) {
	world.set_rigid_body(0, from.lift);
	for (std::size_t i = 0; i < from.bodies.size(); ++i) {
		REQUIRE_FALSE(world.soft_bodies()[i].restore_state(from.bodies[i]));
	}
}

struct Run {
	std::vector<std::uint64_t> hashes; ///< of each tick
	std::vector<BodyState> end;
	std::size_t asleep = 0;
	std::size_t least_asleep = SIZE_MAX;
	friend bool operator==(const Run &, const Run &) = default;
};

Run run(WorldData &world, Simulator &simulator, int tick, int count) {
	Run result;
	for (int end = tick + count; tick < end; ++tick) {
		drive(world, tick);
		result.asleep = simulator.simulate(TICK).sleeping_bodies;
		result.least_asleep = std::min(result.least_asleep, result.asleep);
		result.hashes.push_back(hash_of_state(world));
	}
	result.end = snapshot(world, tick).bodies;
	return result;
}

} // namespace

constexpr int ASLEEP = 590; // the lift sets off again at 620

// Until all sleep.
void settle(WorldData &world, Simulator &simulator) {
	run(world, simulator, 0, 60);
	for (int i = 0; i < 40 && run(world, simulator, 60, 60).asleep < 60; ++i) {
	}
}

TEST_CASE("60 bodies in a pile go on in the same bits when they are put back, here or in a world built alike" *
		doctest::test_suite("slow threads")) {
	HelpedTeam team(2);
	for (const std::size_t threads : { 1, 3 }) {
		const ParallelFor parallel_for = threads == 1 ? ParallelFor{} : team.parallel_for();
		for (const bool is_lively : { true, false }) {
			WorldData world = pile_world(is_lively);
			Simulator simulator(world, parallel_for);
			int tick = 0;
			for (const int start : { 20, 45, 150, ASLEEP }) { // in the fall, as they land, settling, and asleep
				CAPTURE(start);
				CAPTURE(is_lively);
				if (start == ASLEEP && !is_lively) {
					settle(world, simulator);
				} else {
					run(world, simulator, tick, start - tick);
				}
				const Snapshot from = snapshot(world, start);
				const Run first = run(world, simulator, start, 300);
				if (start == ASLEEP && !is_lively) { // or else it says less than it promises
					CHECK(std::ranges::all_of(from.bodies, [](const BodyState &state) { return state.rest.asleep; }));
					CHECK(first.least_asleep < 60); // the lift has woken some
				}
				restore(world, from);
				CHECK(run(world, simulator, start, 300) == first);
				// Only the bodies are put back, and only once, into a world that has never made a step.
				WorldData other = pile_world(is_lively);
				Simulator fresh(other, threads == 1 ? team.parallel_for() : ParallelFor{});
				restore(other, from);
				CHECK(run(other, fresh, start, 300) == first);
				// And through bytes.
				restore(world, from);
				for (std::size_t i = 0; i < from.bodies.size(); ++i) {
					world.soft_bodies()[i].restore_state(body_state_from_bytes(to_bytes(from.bodies[i])).value());
				}
				tick = start;
			}
		}
	}
}

TEST_CASE("external forces, a pin and a touch that bounces are part of a state") {
	WorldData world = pile_world();
	Simulator simulator(world);
	const auto is_touching = [](const SoftBodyData &body) { return body.save_state().touch.touching; };
	int start = 60;
	run(world, simulator, 0, start);
	for (; std::ranges::none_of(world.soft_bodies(), is_touching) && start < 180; ++start) {
		run(world, simulator, start, 1);
	}
	world.soft_bodies()[3].set_pinned(1, true);
	for (SoftBodyData &body : world.soft_bodies()) {
		body.add_external_force(0, { 20, 30 });
	}
	const Snapshot from = snapshot(world, start);
	bool has_touch = false;
	bool has_pair_touch = false;
	for (const BodyState &state : from.bodies) {
		has_touch |= state.touch.touching;
		has_pair_touch |= !state.pair_touches.empty();
	}
	CHECK(has_touch);
	CHECK(has_pair_touch);
	const Run first = run(world, simulator, start, 120);
	world.soft_bodies()[3].set_pinned(1, false);
	world.soft_bodies()[4].set_pinned(1, true);
	run(world, simulator, start + 120, 30);
	restore(world, from);
	CHECK(run(world, simulator, start, 120) == first);
}

TEST_CASE("whoever slept on a body that is put back alone wakes; a state put back twice wakes nobody") {
	WorldData world = pile_world(false);
	Simulator simulator(world);
	settle(world, simulator);
	REQUIRE(run(world, simulator, 60, 1).asleep == 60);
	const Snapshot from = snapshot(world, 590);
	restore(world, from);
	restore(world, from);
	CHECK(simulator.simulate(TICK).sleeping_bodies == 60);
	const std::uint64_t island = world.soft_bodies()[0].rest_state().island;
	world.soft_bodies()[0].restore_state(from.bodies[0]);
	simulator.simulate(TICK);
	for (std::size_t i = 1; i < 60; ++i) {
		CHECK((from.bodies[i].rest.island != island || !world.soft_bodies()[i].is_asleep()));
	}
	restore(world, from); // a force wakes what was put back as one, too
	world.soft_bodies()[0].add_external_force(0, { 0, 1 });
	simulator.simulate(TICK);
	for (std::size_t i = 0; i < 60; ++i) {
		CHECK((from.bodies[i].rest.island != island || !world.soft_bodies()[i].is_asleep()));
	}
}

TEST_CASE("a body put back asleep into a world without sleep wakes") {
	WorldData world = pile_world(false);
	Simulator simulator(world);
	settle(world, simulator);
	const Snapshot from = snapshot(world, 590);
	REQUIRE(from.bodies[0].rest.asleep);
	world.set_sleeping(false);
	restore(world, from);
	CHECK(simulator.simulate(TICK).sleeping_bodies == 0);
}

TEST_CASE("a bounce owed by a surface that is gone is given back in a batch as to a body alone") {
	const auto height_after = [](int count) {
		WorldData world;
		world.set_gravity({ 0, 0 });
		Collider plate{ { { -20, -1 }, { 20, -1 }, { 20, 0 }, { -20, 0 } }, 0, {} };
		plate.surface.restitution = 1;
		world.add_collider(plate);
		const auto shape = octagon(Real(0.4), 200, 4);
		for (int i = 0; i < count; ++i) {
			SoftBodyData body = SoftBodyData::create(shape, {}, { { Real(2 * i), Real(0.6) }, {} }).value();
			for (std::uint32_t p = 0; p < body.point_count(); ++p) {
				body.set_point(p, body.positions()[p], { 0, -4 });
			}
			world.add_soft_body(std::move(body));
		}
		Simulator simulator(world);
		int tick = 0;
		while (!world.soft_bodies()[0].touch_memory().touching) {
			REQUIRE(++tick < 60);
			simulator.simulate(TICK);
		}
		world.clear_environment();
		for (tick = 0; tick < 30; ++tick) {
			simulator.simulate(TICK);
		}
		return world.soft_bodies()[0].positions()[0].y;
	};
	CHECK(height_after(4) == height_after(1));
}
