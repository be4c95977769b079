// SPDX-License-Identifier: MIT
// Pins that are moved go straight to where they are sent, and the body feels how fast.
#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

BodySettings with(Integrator integrator, int substeps = 8) {
	BodySettings settings;
	settings.integrator = integrator;
	settings.substeps = substeps;
	return settings;
}

SoftBodyData pinned_body(const BodySettings &settings = {}) {
	SoftBodyData body = thesis_body(thesis_shape(500, 2), settings);
	body.set_pinned(2, true);
	return body;
}

} // namespace

TEST_CASE("a pin is where it was sent after the step, and then rests, in every integrator") {
	for (int i = 1; i < INTEGRATOR_COUNT; ++i) {
		for (const bool is_coupled : { false, true }) {
			CAPTURE(i);
			CAPTURE(is_coupled);
			WorldData world;
			world.add_soft_body(pinned_body(with(Integrator(i))));
			if (is_coupled) {
				world.add_soft_body(thesis_body(thesis_shape(500, 2), {}, { { Real(0.9), 0 }, {} }));
			}
			SoftBodyData &body = world.soft_bodies()[0];
			const Vec2 target = body.positions()[2] + Vec2{ Real(0.01), Real(0.02) };
			REQUIRE(!body.set_pin_target(2, target));
			Simulator simulator(world);
			simulator.simulate(Real(1) / 60);
			CHECK(body.positions()[2] == target);
			CHECK(body.velocities()[2] == Vec2{});
			CHECK(body.pin_targets().empty());
			for (int tick = 0; tick < 10; ++tick) {
				simulator.simulate(Real(1) / 60);
			}
			CHECK(body.positions()[2] == target);
			CHECK(length(body.velocities()[0]) > 0);
		}
	}
}

// A point on a spring of which the other end is driven: x'' = (k (u t - x) + c (u - x')) / m, from rest. With
// y = x - u t it is a damped oscillation that starts with the velocity -u.
TEST_CASE("a point on a damped spring follows a pin that moves evenly as the formula says") {
	const double m = 0.5, k = 200, c = 2, u = 0.6;
	const double rate = c / (2 * m);
	const double omega = std::sqrt(k / m - rate * rate);
	for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::VELOCITY_VERLET, Integrator::MIDPOINT,
				 Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::XPBD }) {
		CAPTURE(int(integrator));
		WorldData world;
		// In float, XPBD's corrections of a position drown in its rounding at thousands of substeps a second.
		BodySettings settings = with(integrator, integrator == Integrator::XPBD ? 16 : 64);
		settings.can_sleep = false;
		SoftBodyData &body = *world.find(world.add_soft_body(two_masses(Real(m), 1, Real(k), Real(c), settings)));
		REQUIRE(!body.set_pinned(0, true));
		Simulator simulator(world);
		for (int tick = 1; tick <= 30; ++tick) {
			REQUIRE(!body.set_pin_target(0, { Real(-u * tick / 60), 0 }));
			simulator.simulate(Real(1) / 60);
		}
		const double t = 0.5;
		const double expected = 1 - u * t + u / omega * std::exp(-rate * t) * std::sin(omega * t);
		// XPBD and Euler are of order 1 in the substep of one millisecond and a quarter of one, and XPBD damps.
		CHECK(double(body.positions()[1].x) == doctest::Approx(expected).epsilon(integrator == Integrator::XPBD ? 5e-3 : 1e-3));
	}
}

TEST_CASE("a body on a pin that goes round moves alike at 60 and at 240 ticks a second") {
	for (const Integrator integrator : { Integrator::AUTOMATIC, Integrator::SEMI_IMPLICIT_EULER, Integrator::XPBD }) {
		CAPTURE(int(integrator));
		Vec2 end[2];
		for (const int rate : { 60, 240 }) {
			WorldData world;
			world.set_gravity({ 0, -10 });
			SoftBodyData &body = *world.find(world.add_soft_body(pinned_body(with(integrator, rate == 60 ? 16 : 4))));
			const Vec2 start = body.positions()[2];
			Simulator simulator(world);
			for (int tick = 1; tick <= rate; ++tick) {
				const Rotation turn = Rotation::from_angle(Real(6.2831853 * tick / rate));
				REQUIRE(!body.set_pin_target(2, start + Vec2{ turn.c - 1, turn.s } * Real(0.3)));
				simulator.simulate(Real(1) / Real(rate));
			}
			end[rate == 240] = measure_frame(body).center;
		}
		// 60 chords to a circle fall short of it by 0.14 % of its radius.
		CHECK(distance(end[0], end[1]) < 0.005 * double(THESIS_RADIUS));
	}
}

TEST_CASE("a body with pins that are carried along together follows without wobbling, XPBD too") {
	for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::XPBD }) {
		CAPTURE(int(integrator));
		WorldData world;
		SoftBodyData start = thesis_body(thesis_shape(2000, 4), with(integrator));
		for (const std::uint32_t pin : { 0, 3, 5 }) {
			REQUIRE(!start.set_pinned(pin, true));
		}
		SoftBodyData &body = *world.find(world.add_soft_body(std::move(start)));
		const std::vector<Vec2> home = copy_of(body.positions());
		Simulator simulator(world);
		for (int tick = 1; tick <= 120; ++tick) {
			for (const std::uint32_t pin : { 0, 3, 5 }) {
				REQUIRE(!body.set_pin_target(pin, home[pin] + Vec2{ Real(tick) / 60, 0 }));
			}
			simulator.simulate(Real(1) / 60);
		}
		// After two seconds the start has died away: all move with the pins.
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			CHECK(distance(body.positions()[i], home[i] + Vec2{ 2, 0 }) < 0.005);
			if (!body.is_pinned(i)) {
				CHECK(double(body.velocities()[i].x) == doctest::Approx(1).epsilon(0.02));
			}
		}
	}
}

TEST_CASE("a pin that is dragged along a body takes it along by friction") {
	WorldData world;
	BodySettings settings;
	settings.friction = 1;
	// A stiff plate of pinned points slides under a ball that lies on it.
	SoftBodyData plate = SoftBodyData::create(SoftBodyCreator::create_polygon(box_hull({ 4, Real(0.2) }, 1).value(), { 1, 500, 1, true }).value(),
			settings, { { 0, Real(-0.1) }, {} }).value();
	for (std::uint32_t i = 0; i < plate.point_count(); ++i) {
		REQUIRE(!plate.set_pinned(i, true));
	}
	world.set_gravity({ 0, -10 });
	const BodyId plate_id = world.add_soft_body(std::move(plate));
	BodySettings rough = settings;
	rough.rolling_resistance = 1;
	const BodyId ball_id = world.add_soft_body(thesis_body(thesis_shape(2000, 10), rough, { { 0, Real(0.47) }, Rotation::from_angle(Real(0.39269908)) }));
	Simulator simulator(world);
	for (int tick = 0; tick < 30; ++tick) {
		simulator.simulate(Real(1) / 60);
	}
	for (int tick = 0; tick < 60; ++tick) {
		SoftBodyData &moving = *world.find(plate_id);
		for (std::uint32_t i = 0; i < moving.point_count(); ++i) {
			REQUIRE(!moving.set_pin_target(i, moving.positions()[i] + Vec2{ Real(0.01), 0 }));
		}
		simulator.simulate(Real(1) / 60);
	}
	CHECK(double(measure_frame(*world.find(ball_id)).velocity.x) == doctest::Approx(0.6).epsilon(0.1));
}

TEST_CASE("a body sleeps on pins that stand still, and wakes when one is sent elsewhere") {
	WorldData world;
	world.set_gravity({ 0, -10 });
	SoftBodyData &body = *world.find(world.add_soft_body(pinned_body()));
	Simulator simulator(world);
	for (int tick = 0; tick < 3000 && !body.is_asleep(); ++tick) {
		REQUIRE(!body.set_pin_target(2, body.positions()[2]));
		simulator.simulate(Real(1) / 60);
	}
	REQUIRE(body.is_asleep());
	REQUIRE(!body.set_pin_target(2, body.positions()[2] + Vec2{ Real(0.001), 0 }));
	CHECK(!body.is_asleep());
	simulator.simulate(Real(1) / 60);
	CHECK(!body.is_asleep());
}

TEST_CASE("a pin sent across the scene takes its body along, in one piece") {
	for (const double way : { 5.0, 100.0, 1e4, 1e6 }) {
		for (const Integrator integrator : { Integrator::AUTOMATIC, Integrator::VELOCITY_VERLET, Integrator::XPBD }) {
			CAPTURE(way);
			CAPTURE(int(integrator));
			WorldData world;
			BodySettings settings = with(integrator);
			settings.shape_stiffness = 400;
			settings.shape_damping = 4;
			settings.linear_damp = 1; // what is yanked swings about its pin until something brakes it
			settings.angular_damp = 1;
			SoftBodyData &body = *world.find(world.add_soft_body(pinned_body(settings)));
			const Vec2 target = body.positions()[2] + Vec2{ Real(way), 0 };
			REQUIRE(!body.set_pin_target(2, target));
			Simulator simulator(world);
			std::size_t resets = 0;
			for (int tick = 0; tick < 1200; ++tick) {
				resets += simulator.simulate(Real(1) / 60).reset_bodies.size();
				REQUIRE(all_finite(body.positions()));
			}
			CHECK(resets <= 2);
			CHECK(body.positions()[2] == target);
			CHECK(distance(measure_frame(body).center, target) < 1.5 * double(THESIS_RADIUS));
		}
	}
}

TEST_CASE("targets are refused for points that are not pinned and places that are not finite, and forgotten with the pin") {
	SoftBodyData body = pinned_body();
	CHECK(mentions(body.set_pin_target(0, {})->message(), "pinned"));
	CHECK(mentions(body.set_pin_target(99, {})->message(), "point"));
	CHECK(mentions(body.set_pin_target(2, { NOT_A_NUMBER, 0 })->message(), "position"));
	CHECK(body.pin_targets().empty());
	REQUIRE(!body.set_pin_target(2, { 1, 1 }));
	REQUIRE(!body.set_pin_target(2, { 2, 2 })); // the last one counts
	REQUIRE(body.pin_targets().size() == 1);
	CHECK(body.pin_targets()[0].position == Vec2{ 2, 2 });
	REQUIRE(!body.set_pinned(2, false));
	CHECK(body.pin_targets().empty());
	REQUIRE(!body.set_pinned(2, true));
	body.set_frozen(true);
	REQUIRE(!body.set_pin_target(2, { 1, 1 }));
	CHECK(body.pin_targets().empty());
}
