// SPDX-License-Identifier: MIT
// Damping of a body as a whole, and accelerations that bodies have of their own.
#include "core/base/constants.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/rigid_damping_lanes.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

BodySettings damped(Real linear, Real angular) {
	BodySettings settings;
	settings.linear_damp = linear;
	settings.angular_damp = angular;
	settings.collision_layer = 0;
	settings.collision_mask = 0;
	return settings;
}

// A border far below: as something to fall onto, it brings at least four substeps.
WorldData world_with_floor(Vec2 gravity, Real height) {
	WorldData world;
	world.set_gravity(gravity);
	world.add_border({ { { 0, height }, { 0, 1 } }, {} });
	return world;
}

} // namespace

TEST_CASE("velocity and spin of a body fall by exp(-damp t), whatever the tick and the integrator") {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		for (const int rate : { 60, 240 }) {
			CAPTURE(i);
			CAPTURE(rate);
			BodySettings settings = damped(2, 3);
			settings.integrator = Integrator(i);
			settings.substeps = i == int(Integrator::EXPLICIT_EULER) ? 16 : 4; // as it needs, not to blow up
			WorldData world;
			SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape(500, 1), settings)));
			REQUIRE(!set_linear_velocity(body, { 5, 1 }));
			REQUIRE(!set_angular_velocity(body, Real(0.5)));
			Simulator simulator(world);
			for (int tick = 0; tick < rate; ++tick) {
				simulator.simulate(Real(1) / Real(rate));
			}
			const BodyFrame frame = measure_frame(body);
			CHECK(double(frame.velocity.x) == doctest::Approx(5 * std::exp(-2.0)).epsilon(1e-4));
			CHECK(double(frame.velocity.y) == doctest::Approx(std::exp(-2.0)).epsilon(1e-4));
			// The body draws in a little as it turns less.
			CHECK(double(frame.angular_velocity) == doctest::Approx(0.5 * std::exp(-3.0)).epsilon(5e-3));
		}
	}
}

TEST_CASE("damping of a body as a whole takes nothing from its wobble") {
	SoftBodyData body = thesis_body(thesis_shape(500, 1), damped(20, 30));
	Random random(7);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i] + random.vector(0.05), random.vector(1));
	}
	const auto wobble = [&] {
		const BodyFrame frame = measure_frame(body);
		std::vector<Vec2> result;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			result.push_back(body.velocities()[i] - frame.velocity -
					perpendicular(body.positions()[i] - frame.center) * frame.angular_velocity);
		}
		return result;
	};
	const BodyFrame before = measure_frame(body);
	const std::vector<Vec2> wobble_before = wobble();
	damp_rigid_motion(lanes_of(body), Real(0.1));
	const BodyFrame after = measure_frame(body);
	CHECK(largest_distance(wobble(), wobble_before) < 50 * EPSILON);
	CHECK(double(length(after.velocity)) == doctest::Approx(double(length(before.velocity)) * std::exp(-2.0)).epsilon(1e-4));
	CHECK(double(after.angular_velocity) == doctest::Approx(double(before.angular_velocity) * std::exp(-3.0)).epsilon(1e-4));
}

TEST_CASE("a falling body that is damped reaches the speed g / damp") {
	WorldData world;
	world.set_gravity({ 0, -10 });
	SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape(500, 1), damped(4, 0))));
	Simulator simulator(world);
	for (int tick = 0; tick < 300; ++tick) {
		simulator.simulate(Real(1) / 60);
	}
	// Between two substeps, gravity comes before the damping: at one substep a tick, 4/60 of it at most.
	CHECK(double(measure_frame(body).velocity.y) == doctest::Approx(-2.5).epsilon(4.0 / 60));
}

TEST_CASE("a pinned body that is damped swings less and keeps its pin") {
	double swing[2];
	for (const bool is_damped : { false, true }) {
		WorldData world;
		world.set_gravity({ 0, -10 });
		SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape(5000, 10), damped(0, is_damped ? 2 : 0))));
		REQUIRE(!body.set_pinned(0, true));
		const Vec2 pin = body.positions()[0];
		Simulator simulator(world);
		double fastest = 0;
		for (int tick = 0; tick < 300; ++tick) {
			simulator.simulate(Real(1) / 60);
			fastest = tick > 200 ? std::fmax(fastest, double(length(measure_frame(body).velocity))) : 0;
		}
		CHECK(body.positions()[0] == pin);
		swing[is_damped] = fastest;
	}
	CHECK(swing[1] < swing[0] / 4);
}

TEST_CASE("bodies that are damped side by side end in the bits of one alone") {
	const auto shape = thesis_shape(500, 1);
	const auto start = [&](int i) {
		SoftBodyData body = thesis_body(shape, damped(1, 2), { { Real(3 * i), 5 }, {} });
		set_linear_velocity(body, { Real(i), 2 });
		set_angular_velocity(body, Real(i) - 2);
		return body;
	};
	WorldData batch = world_with_floor({ 0, -10 }, 0);
	for (int i = 0; i < 4; ++i) {
		batch.add_soft_body(start(i));
	}
	Simulator batch_simulator(batch);
	for (int tick = 0; tick < 90; ++tick) {
		batch_simulator.simulate(Real(1) / 60);
	}
	for (int i = 0; i < 4; ++i) {
		WorldData alone = world_with_floor({ 0, -10 }, 0);
		alone.add_soft_body(start(i));
		Simulator simulator(alone);
		for (int tick = 0; tick < 90; ++tick) {
			simulator.simulate(Real(1) / 60);
		}
		CHECK(identical(batch.soft_bodies()[i].positions(), alone.soft_bodies()[0].positions()));
	}
}

TEST_CASE("damping below zero is refused by name") {
	BodySettings settings;
	settings.linear_damp = -1;
	REQUIRE(check_settings(settings).has_value());
	CHECK(mentions(check_settings(settings)->message(), "linear_damp"));
	settings = {};
	settings.angular_damp = NOT_A_NUMBER;
	REQUIRE(check_settings(settings).has_value());
	CHECK(mentions(check_settings(settings)->message(), "angular_damp"));
}

TEST_CASE("a body falls with gravity and its own acceleration together, in every integrator, and its neighbors do not") {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		CAPTURE(i);
		BodySettings settings = damped(0, 0);
		settings.integrator = Integrator(i);
		settings.substeps = 16;
		settings.gravity_scale = Real(0.5);
		const auto shape = thesis_shape(500, 1);
		WorldData worlds[2];
		for (WorldData &world : worlds) {
			world.set_gravity({ 0, -10 });
			for (int n = 0; n < 4; ++n) {
				world.add_soft_body(thesis_body(shape, settings, { { Real(3 * n), 0 }, {} }));
			}
		}
		REQUIRE(!worlds[0].soft_bodies()[2].set_acceleration({ 3, 1 }));
		const std::uint64_t arrangement = worlds[0].change_counts().arrangement;
		for (WorldData &world : worlds) {
			Simulator simulator(world);
			for (int tick = 0; tick < 60; ++tick) {
				simulator.simulate(Real(1) / 60);
			}
		}
		const BodyFrame frame = measure_frame(worlds[0].soft_bodies()[2]);
		CHECK(double(frame.velocity.x) == doctest::Approx(3).epsilon(1e-4));
		CHECK(double(frame.velocity.y) == doctest::Approx(-4).epsilon(1e-4));
		CHECK(worlds[0].change_counts().arrangement == arrangement);
		for (const int n : { 0, 1, 3 }) {
			CHECK(identical(worlds[0].soft_bodies()[n].positions(), worlds[1].soft_bodies()[n].positions()));
		}
	}
}

TEST_CASE("a body lies and sleeps on a floor towards which its own acceleration pulls it") {
	WorldData world = world_with_floor({}, 0);
	BodySettings settings;
	settings.shape_stiffness = 400;
	settings.shape_damping = 4;
	SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape_with_ratio(1000, Real(0.1)), settings,
			{ { 0, Real(0.6) }, Rotation::from_angle(Real(0.39269908)) })));
	REQUIRE(!body.set_acceleration({ 0, -10 }));
	Simulator simulator(world);
	for (int tick = 0; tick < 600 && !body.is_asleep(); ++tick) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(body.is_asleep());
	CHECK(measure_frame(body).center.y < Real(0.5));

	REQUIRE(!body.set_acceleration({ 0, -10 }));
	CHECK(body.is_asleep()); // nothing changed
	REQUIRE(!body.set_acceleration({ 0, 10 }));
	CHECK(!body.is_asleep());
	for (int tick = 0; tick < 60; ++tick) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(measure_frame(body).center.y > 4); // up half of 10 m/s²
}

TEST_CASE("what drifts where gravity is canceled is not at rest") {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	SoftBodyData &body = *world.find(world.add_soft_body(thesis_body(thesis_shape(500, 1))));
	REQUIRE(!body.set_acceleration({ 0, Real(9.81) }));
	REQUIRE(!set_linear_velocity(body, { (SLEEP_SPEED + SLEEP_SPEED_WEIGHTLESS) / 2, 0 }));
	CHECK(body.total_acceleration(world.gravity()) == Vec2{});
	Simulator simulator(world);
	for (int tick = 0; tick < 120; ++tick) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(!body.is_asleep());
	CHECK(double(measure_frame(body).velocity.x) == doctest::Approx(double(SLEEP_SPEED + SLEEP_SPEED_WEIGHTLESS) / 2).epsilon(1e-4));
}

TEST_CASE("gravity and an acceleration that cancels it but for rounding add up to nothing") {
	SoftBodyData body = thesis_body(thesis_shape(500, 1));
	REQUIRE(!body.set_acceleration({ 0, Real(9.81) * (1 + 2 * Real(EPSILON)) }));
	CHECK(body.total_acceleration({ 0, Real(-9.81) }) == Vec2{});
	REQUIRE(!body.set_acceleration({ 0, Real(9.82) }));
	CHECK(body.total_acceleration({ 0, Real(-9.81) }).y > 0);
	CHECK(body.set_acceleration({ NOT_A_NUMBER, 0 }).has_value());
	CHECK(body.acceleration().y == Real(9.82));
}
