// SPDX-License-Identifier: MIT
// Claims about the motion of rigid bodies of the surroundings, and about what is refused.
#include "core/model/rigid_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

RigidBody random_body(Random &random) {
	RigidBody body;
	body.pose = { random.vector(10), Rotation::from_angle(random.real(-3.1, 3.1)) };
	body.center_of_mass = random.vector(2);
	body.linear_velocity = random.vector(5);
	body.angular_velocity = random.real(-4, 4);
	return body;
}

} // namespace

TEST_CASE("a rigid body turns about its center of mass, which moves in a straight line") {
	Random random(301);
	for (int round = 0; round < 500; ++round) {
		const RigidBody body = random_body(random);
		const double time = random.real(0, 2);
		const Pose later = body.pose_after(Real(time));
		const Vec2 local = random.vector(3);
		// In double, from the angle.
		const double angle = std::atan2(double(body.pose.rotation.s), double(body.pose.rotation.c)) + body.angular_velocity * time;
		const Vec2 arm = local - body.center_of_mass;
		const double x = body.center().x + body.linear_velocity.x * time + arm.x * std::cos(angle) - arm.y * std::sin(angle);
		const double y = body.center().y + body.linear_velocity.y * time + arm.x * std::sin(angle) + arm.y * std::cos(angle);
		CHECK(distance(later.apply(local), { Real(x), Real(y) }) <= 32 * EPSILON * 25);
	}
}

// Found by fuzz_world: a velocity that is a number, and no place a second later.
TEST_CASE("a motion that leads out of the range of numbers is not made") {
	const Real most = std::numeric_limits<Real>::max();
	RigidBody body;
	body.pose = { { most / 2, 7 }, Rotation::from_angle(1) };
	body.linear_velocity = { most, 0 };
	CHECK(body.pose_after(1).position == body.pose.position);
	CHECK(body.pose_after(Real(0.25)).position == Vec2{ most / 2 + most / 4, 7 });
	body.linear_velocity = {};
	body.angular_velocity = most;
	const Pose turned = body.pose_after(2); // an angle that is none
	CHECK(is_finite(turned.position));
	CHECK(turned.rotation == body.pose.rotation);

	body.linear_velocity = { most, 1 };
	CHECK_FALSE(body.change_velocities({ most, 1 }, 1));
	CHECK_FALSE(body.change_velocities({ 0, 1 }, most));
	CHECK_FALSE(body.change_velocities({ NOT_A_NUMBER, 1 }, 0));
	CHECK(body.linear_velocity == Vec2{ most, 1 });
	CHECK(body.angular_velocity == most);
	CHECK(body.change_velocities({ -most, 1 }, -most));
	CHECK(body.linear_velocity == Vec2{ 0, 2 });
	CHECK(body.angular_velocity == 0);
}

TEST_CASE("the velocity of a place is how fast the material there moves") {
	Random random(302);
	for (int round = 0; round < 200; ++round) {
		const RigidBody body = random_body(random);
		const Vec2 local = random.vector(3);
		const double span = 0.01;
		const Vec2 way = body.pose_after(Real(span)).apply(local) - body.pose_after(Real(-span)).apply(local);
		const Vec2 expected = way * Real(0.5 / span);
		// A central difference is off by (ω span)² / 6 of the speed; roundings of 15 length units over the span.
		CHECK(distance(body.velocity_at(body.pose.apply(local), body.pose), expected) <= 0.005 + 8 * EPSILON * 15 / span);
	}
}

TEST_CASE("a kinematic body between two poses begins at one and ends at the other, the shorter way round") {
	Random random(303);
	for (int round = 0; round < 500; ++round) {
		const Pose from{ random.vector(10), Rotation::from_angle(random.real(-3.1, 3.1)) };
		const Pose to{ random.vector(10), Rotation::from_angle(random.real(-3.1, 3.1)) };
		const Real dt = random.real(0.01, 1);
		const RigidBody body = kinematic_between(from, to, dt);
		CHECK_FALSE(body.is_dynamic());
		CHECK(std::abs(double(body.angular_velocity * dt)) <= 3.1416);
		const Vec2 local = random.vector(3);
		CHECK(distance(body.pose_after(0).apply(local), from.apply(local)) <= 16 * EPSILON * 15);
		CHECK(distance(body.pose_after(dt).apply(local), to.apply(local)) <= 32 * EPSILON * 30);
	}
}

TEST_CASE("a belt on a moving body moves with the sum of both velocities") {
	Random random(304);
	for (int round = 0; round < 500; ++round) {
		const RigidBody body = random_body(random);
		const Pose at = body.pose_after(random.real(0, 1));
		Surface belt;
		belt.linear_velocity = random.vector(3);
		belt.angular_velocity = random.real(-3, 3);
		belt.velocity_origin = random.vector(2);
		belt.friction = random.real(0, 1);
		const Surface moved = surface_in_motion(belt, body, at);
		const Vec2 place = random.vector(15);
		const Vec2 expected = body.velocity_at(place, at) + at.rotation.apply(belt.velocity_at(at.apply_inverse(place)));
		CHECK(distance(moved.velocity_at(place), expected) <= 64 * EPSILON * 200); // arms up to 30, spins up to 7
		CHECK(moved.friction == belt.friction);
	}
}

TEST_CASE("every bad value of a rigid body is refused by name") {
	const std::vector<std::pair<std::string, std::function<void(RigidBody &)>>> cases{
		{ "rigid_body.position", [](RigidBody &b) { b.pose.position.x = NOT_A_NUMBER; } },
		{ "rigid_body.rotation", [](RigidBody &b) { b.pose.rotation = { 2, 0 }; } },
		{ "rigid_body.rotation", [](RigidBody &b) { b.pose.rotation.s = NOT_A_NUMBER; } },
		{ "rigid_body.center_of_mass", [](RigidBody &b) { b.center_of_mass.y = INFINITE; } },
		{ "rigid_body.linear_velocity", [](RigidBody &b) { b.linear_velocity.y = INFINITE; } },
		{ "rigid_body.angular_velocity", [](RigidBody &b) { b.angular_velocity = NOT_A_NUMBER; } },
		{ "rigid_body.acceleration", [](RigidBody &b) { b.acceleration.x = NOT_A_NUMBER; } },
		{ "rigid_body.inverse_mass", [](RigidBody &b) { b.inverse_mass = -1; } },
		{ "rigid_body.inverse_mass", [](RigidBody &b) { b.inverse_mass = NOT_A_NUMBER; } },
		{ "rigid_body.inverse_inertia", [](RigidBody &b) { b.inverse_inertia = Real(-0.5); } },
	};
	CHECK_FALSE(check_rigid_body({}));
	for (const auto &[name, spoil] : cases) {
		CAPTURE(name);
		RigidBody body;
		spoil(body);
		const Status status = check_rigid_body(body);
		REQUIRE(status.has_value());
		CHECK(status->name == name);
	}
}
