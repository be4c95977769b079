// SPDX-License-Identifier: MIT
// Soft bodies that carry a rigid body fall asleep when the engine that it comes from lets it sleep.
#include "core/dynamics/simulator.h"
#include "scenes/thesis_body.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60;
constexpr Vec2 GRAVITY = { 0, Real(-9.81) };

// A plank across two balls that do not touch each other.
struct Bridge {
	WorldData world;
	Simulator simulator{ world };
	std::vector<BodyId> ids;
	RigidBody plank;
	std::uint32_t index = 0;

	Bridge() {
		world.set_gravity(GRAVITY);
		BodySettings settings;
		settings.shape_stiffness = 400;
		settings.shape_damping = 4;
		settings.rolling_resistance = Real(0.05);
		const Rotation on_an_edge = Rotation::from_angle(Real(0.39269908));
		for (const Vec2 place : { Vec2{ -1, Real(0.5) }, Vec2{ 1, Real(0.5) } }) {
			ids.push_back(world.add_soft_body(
					thesis_body(thesis_shape_with_ratio(1000, Real(0.1)), settings, { place, on_an_edge })));
		}
		plank.pose.position = { 0, Real(1.05) };
		plank.inverse_mass = 4;
		plank.inverse_inertia = 3;
		plank.acceleration = GRAVITY;
		surround(true);
	}

	void surround(bool has_plank) {
		world.clear_environment();
		REQUIRE(!world.add_border({ { { 0, 0 }, { 0, 1 } }, {} }));
		if (has_plank) {
			index = world.add_rigid_body(plank).value();
			Collider collider;
			const Real half = Real(1.5);
			const Real thick = Real(0.1);
			collider.vertices = { { -half, -thick }, { half, -thick }, { half, thick }, { -half, thick } };
			collider.rigid_body = index;
			REQUIRE(!world.add_collider(collider));
		}
	}
	SoftBodyData &body(std::size_t i) { return *world.find(ids[i]); }
	std::size_t step(int count) {
		std::size_t asleep = 0;
		for (int i = 0; i < count; ++i) {
			asleep = simulator.simulate(FRAME).sleeping_bodies;
		}
		return asleep;
	}
	// As an engine does it that has put the plank to sleep: it is where it was, every step.
	std::size_t step_with_sleeping_plank(int count) {
		plank.asleep = true;
		plank.linear_velocity = {};
		plank.angular_velocity = 0;
		std::size_t asleep = 0;
		for (int i = 0; i < count; ++i) {
			REQUIRE(!world.set_rigid_body(index, plank));
			asleep = step(1);
			CHECK(world.rigid_bodies()[index].pose.position == plank.pose.position);
		}
		return asleep;
	}
	void sleep() {
		CHECK(step(1200) == 0); // beside what is awake nobody sleeps, or it would sink in
		plank = world.rigid_bodies()[index];
		REQUIRE(step_with_sleeping_plank(300) == 2);
	}
};

} // namespace

TEST_CASE("beside a rigid body that sleeps soft bodies fall asleep, and hold it from then on") {
	Bridge bridge;
	bridge.sleep();
	CHECK(bridge.world.reactions()[bridge.index].beside_sleeper);
	CHECK(bridge.world.reactions()[bridge.index].impulse == Vec2{});
	const Vec2 point = bridge.body(0).positions()[0];
	CHECK(bridge.step_with_sleeping_plank(60) == 2);
	CHECK(bridge.body(0).positions()[0] == point);

	bridge.plank.asleep = false; // something in the engine has hit it
	REQUIRE(!bridge.world.set_rigid_body(bridge.index, bridge.plank));
	CHECK(bridge.step(1) == 0);
	CHECK(!bridge.world.reactions()[bridge.index].beside_sleeper);
	CHECK(bridge.world.reactions()[bridge.index].impulse.y > 0);
}

TEST_CASE("what is beside the same sleeping rigid body wakes together, and not before it is touched") {
	Bridge bridge;
	bridge.sleep();
	bridge.body(0).wake();
	CHECK(bridge.step_with_sleeping_plank(2) == 0); // the first step ends with the other one woken
}

TEST_CASE("a sleeping rigid body that is taken away, or put elsewhere, wakes those that it lay on") {
	for (const bool is_moved : { true, false }) {
		CAPTURE(is_moved);
		Bridge bridge;
		bridge.sleep();
		bridge.surround(true); // a fresh list of the same
		CHECK(bridge.step_with_sleeping_plank(1) == 2);
		bridge.plank.pose.position.y += 5;
		bridge.surround(is_moved);
		CHECK(bridge.step(1) == 0);
	}
}

TEST_CASE("a sleeper is not pushed out of a rigid body that sleeps, however many others are stepped beside it") {
	for (const int others : { 0, 3 }) {
		CAPTURE(others);
		WorldData world;
		const auto shape = thesis_shape(1000, 1);
		const BodyId sleeper = world.add_soft_body(thesis_body(shape));
		for (int i = 1; i <= others; ++i) {
			const BodyId other = world.add_soft_body(thesis_body(shape, {}, { { Real(100 * i), 0 }, {} }));
			REQUIRE(!world.find(other)->apply_impulse(0, { 1, 0 }));
		}
		RigidBody crate;
		crate.inverse_mass = 1;
		crate.inverse_inertia = 1;
		crate.asleep = true;
		Collider collider;
		collider.vertices = { { -1, -1 }, { 1, -1 }, { 1, Real(-0.4) }, { -1, Real(-0.4) } }; // a fifth of the radius inside
		collider.rigid_body = world.add_rigid_body(crate).value();
		REQUIRE(!world.add_collider(collider));
		world.find(sleeper)->put_to_sleep();
		const std::vector<Vec2> before(world.find(sleeper)->positions().begin(), world.find(sleeper)->positions().end());
		Simulator simulator(world);
		for (int i = 0; i < 3; ++i) {
			CHECK(simulator.simulate(FRAME).contacts == 0);
		}
		CHECK(world.find(sleeper)->is_asleep());
		CHECK(std::ranges::equal(world.find(sleeper)->positions(), before));
		CHECK(world.reactions()[collider.rigid_body].impulse == Vec2{});
	}
}
