// SPDX-License-Identifier: MIT
// A soft body can be pushed, turned and set in motion as the rigid body that it nearly is.
#include "core/base/constants.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

struct Motion {
	double mass = 0;
	double center_x = 0, center_y = 0;
	double momentum_x = 0, momentum_y = 0;
	double spin = 0; // angular momentum about the center
	double inertia = 0;
};

// Plain sums in double, apart from `measure_frame`.
Motion motion_of(const SoftBodyData &body) {
	Motion m;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = body.shape().masses()[i];
		m.mass += mass;
		m.center_x += mass * body.positions()[i].x;
		m.center_y += mass * body.positions()[i].y;
		m.momentum_x += mass * body.velocities()[i].x;
		m.momentum_y += mass * body.velocities()[i].y;
	}
	m.center_x /= m.mass;
	m.center_y /= m.mass;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const double mass = body.shape().masses()[i];
		const double x = body.positions()[i].x - m.center_x;
		const double y = body.positions()[i].y - m.center_y;
		m.spin += mass * (x * body.velocities()[i].y - y * body.velocities()[i].x);
		m.inertia += mass * (x * x + y * y);
	}
	return m;
}

// Dented, away from the origin, wobbling and turning.
SoftBodyData lively_body(std::uint64_t seed, const BodySettings &settings = {}) {
	SoftBodyData body = thesis_body(thesis_shape(500, 1), settings, { { 3, -2 }, Rotation::from_angle(1) });
	Random random(seed);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i] + random.vector(0.05), random.vector(1));
	}
	return body;
}

// What each point does besides the rigid motion.
std::vector<Vec2> wobble_of(const SoftBodyData &body) {
	const BodyFrame frame = measure_frame(body);
	std::vector<Vec2> wobble;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		wobble.push_back(body.velocities()[i] - frame.velocity -
				perpendicular(body.positions()[i] - frame.center) * frame.angular_velocity);
	}
	return wobble;
}

} // namespace

TEST_CASE("an impulse on a soft body changes its momenta by J and r x J and leaves its wobble alone") {
	for (std::uint64_t seed = 0; seed < 20; ++seed) {
		CAPTURE(seed);
		SoftBodyData body = lively_body(seed);
		const Motion before = motion_of(body);
		const std::vector<Vec2> wobble = wobble_of(body);
		const Vec2 impulse{ 2, Real(-0.7) };
		const Vec2 place{ 4, Real(-1.5) };
		REQUIRE(!apply_rigid_impulse(body, impulse, place));
		const Motion after = motion_of(body);
		CHECK(after.momentum_x - before.momentum_x == doctest::Approx(2).epsilon(20 * EPSILON));
		CHECK(after.momentum_y - before.momentum_y == doctest::Approx(-0.7).epsilon(60 * EPSILON));
		const double lever = (4 - before.center_x) * -0.7 - (-1.5 - before.center_y) * 2;
		CHECK(std::abs(after.spin - before.spin - lever) < 100 * EPSILON);
		CHECK(largest_distance(wobble_of(body), wobble) < 100 * EPSILON);
	}
}

TEST_CASE("an angular impulse turns about the center of mass and pushes nothing") {
	SoftBodyData body = lively_body(3);
	const Motion before = motion_of(body);
	const std::vector<Vec2> wobble = wobble_of(body);
	REQUIRE(!apply_angular_impulse(body, Real(0.4)));
	const Motion after = motion_of(body);
	CHECK(std::abs(after.spin - before.spin - 0.4) < 100 * EPSILON);
	CHECK(std::abs(after.momentum_x - before.momentum_x) < 20 * EPSILON);
	CHECK(std::abs(after.momentum_y - before.momentum_y) < 20 * EPSILON);
	CHECK(largest_distance(wobble_of(body), wobble) < 100 * EPSILON);
}

TEST_CASE("velocity and spin of a soft body can be set, each without the other and without the wobble") {
	SoftBodyData body = lively_body(5);
	const std::vector<Vec2> wobble = wobble_of(body);
	const double spin = motion_of(body).spin;
	REQUIRE(!set_linear_velocity(body, { 7, -3 }));
	Motion m = motion_of(body);
	CHECK(m.momentum_x / m.mass == doctest::Approx(7).epsilon(20 * EPSILON));
	CHECK(m.momentum_y / m.mass == doctest::Approx(-3).epsilon(20 * EPSILON));
	CHECK(std::abs(m.spin - spin) < 100 * EPSILON);
	REQUIRE(!set_angular_velocity(body, -4));
	m = motion_of(body);
	CHECK(m.spin / m.inertia == doctest::Approx(-4).epsilon(50 * EPSILON));
	CHECK(m.momentum_x / m.mass == doctest::Approx(7).epsilon(20 * EPSILON));
	CHECK(largest_distance(wobble_of(body), wobble) < 200 * EPSILON);
}

TEST_CASE("a force and a torque act during one whole step, exactly, however fast the body turns") {
	// All but explicit Euler, which gains spin in proportion to what it has.
	for (int i = int(Integrator::SEMI_IMPLICIT_EULER); i < INTEGRATOR_COUNT; ++i) {
		CAPTURE(i);
		for (const int substeps : { 4, 16 }) {
			CAPTURE(substeps);
			BodySettings settings;
			settings.integrator = Integrator(i);
			settings.substeps = substeps;
			settings.collision_layer = 0;
			settings.collision_mask = 0;
			// A few turns a second: a torque spread once would lose a twentieth of itself within the step. The second body
			// is left alone, as the midpoint method gains some spin by itself.
			WorldData world;
			for (int n = 0; n < 2; ++n) {
				SoftBodyData turning = thesis_body(thesis_shape(500, 1), settings, { { 3, -2 }, {} });
				REQUIRE(!set_angular_velocity(turning, 20));
				world.add_soft_body(std::move(turning));
			}
			SoftBodyData &body = world.soft_bodies()[0];
			Simulator simulator(world);
			const double dt = 1.0 / 60;
			const Motion before = motion_of(body);
			REQUIRE(!add_rigid_force(body, { 3, 1 }, { 3, -1 }));
			REQUIRE(!add_torque(body, Real(0.5)));
			simulator.simulate(Real(dt));
			const Motion after = motion_of(body);
			CHECK(std::abs(after.momentum_x - before.momentum_x - 3 * dt) < 200 * EPSILON);
			CHECK(std::abs(after.momentum_y - before.momentum_y - 1 * dt) < 200 * EPSILON);
			const double torque = 0.5 + (3 - before.center_x) * 1 - (-1 - before.center_y) * 3;
			// Methods with stages hold the force while the points move on: second order in the turn of a substep.
			const double turn = 20 * dt / substeps;
			const double gain = after.spin - motion_of(world.soft_bodies()[1]).spin;
			CHECK(std::abs(gain - torque * dt) < 4 * std::abs(torque) * dt * turn * turn + 500 * EPSILON);
			// And is then forgotten.
			simulator.simulate(Real(dt));
			CHECK(std::abs(motion_of(body).momentum_x - after.momentum_x) < 200 * EPSILON);
		}
	}
}

TEST_CASE("a force on a body at rest moves it without straining a spring") {
	WorldData world;
	SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape(500, 1), {})));
	Simulator simulator(world);
	for (int tick = 0; tick < 60; ++tick) {
		const Vec2 center = measure_frame(body).center;
		REQUIRE(!add_rigid_force(body, { 6, 0 }, center));
		simulator.simulate(Real(1) / 60);
	}
	const Energy energy = measure_energy(body, {});
	CHECK(energy.springs < 1e-4 * energy.kinetic);
	CHECK(measure_frame(body).velocity.x == doctest::Approx(6 / double(body.shape().total_mass())).epsilon(1e-4));
}

TEST_CASE("pinned points stay when a body is pushed as a whole") {
	SoftBodyData body = lively_body(1);
	REQUIRE(!body.set_pinned(2, true));
	const Vec2 free_before = body.velocities()[0];
	REQUIRE(!apply_rigid_impulse(body, { 1, 0 }, measure_frame(body).center));
	CHECK(body.velocities()[2] == Vec2{});
	CHECK(double(body.velocities()[0].x - free_before.x) ==
			doctest::Approx(1 / double(body.shape().total_mass())).epsilon(1e-4));
}

TEST_CASE("what is not finite is refused by name and moves nothing") {
	SoftBodyData body = lively_body(2);
	const std::vector<Vec2> velocities = copy_of(body.velocities());
	const Vec2 bad{ 0, NOT_A_NUMBER };
	const auto refuses = [&](const Status &status, const std::string &name) {
		REQUIRE(status.has_value());
		CHECK(mentions(status->message(), name));
	};
	refuses(apply_rigid_impulse(body, bad, {}), "impulse");
	refuses(apply_rigid_impulse(body, {}, bad), "position");
	refuses(apply_angular_impulse(body, INFINITE), "impulse");
	refuses(add_rigid_force(body, bad, {}), "force");
	refuses(add_rigid_force(body, {}, bad), "position");
	refuses(add_torque(body, NOT_A_NUMBER), "torque");
	refuses(set_linear_velocity(body, bad), "linear_velocity");
	refuses(set_angular_velocity(body, NOT_A_NUMBER), "angular_velocity");
	CHECK(identical(body.velocities(), velocities));
	CHECK(!body.is_pushed());
}

TEST_CASE("a body whose points lie in one place is pushed and not turned") {
	SoftBodyData body = lively_body(2);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, { 1, 1 }, {});
	}
	REQUIRE(!apply_rigid_impulse(body, { 1, 0 }, { 1, 5 }));
	CHECK(all_finite(body.velocities()));
	CHECK(double(body.velocities()[0].x) == doctest::Approx(1 / double(body.shape().total_mass())).epsilon(1e-5));
}
