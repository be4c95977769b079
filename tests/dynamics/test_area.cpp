// SPDX-License-Identifier: MIT
// The area as a compliant constraint: what it resists, what it keeps, and for which stiffness.
#include "core/dynamics/area_lanes.h"

#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/material.h"
#include "scenes/circle.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A ring of points that nothing but its area holds.
SoftBodyData ring(Real bulk_modulus, Real damping_time = 0) {
	StructureOptions options;
	options.stiffness = 0;
	options.damping = 0;
	options.center_point = false;
	BodySettings settings;
	settings.spring_stiffness_scale = 0;
	settings.spring_damping_scale = 0;
	settings.area_stiffness = bulk_modulus;
	settings.elastic_damping_time = damping_time;
	settings.can_sleep = false;
	return SoftBodyData::create(circle_shape(50, 16, options).value(), settings).value();
}

void blow_up(SoftBodyData &body, Real factor) {
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE(!body.set_point(i, body.positions()[i] * factor, body.velocities()[i]));
	}
}

// A body of elastic modes, alone and weightless, that turns at `spin` [rad/s].
WorldData spinning_world(Real spin, Real inflation) {
	StructureOptions options;
	options.elastic = true;
	const auto shape = circle_shape(50, 16, options).value();
	BodySettings settings;
	settings.inflation = inflation;
	settings.can_sleep = false;
	REQUIRE(!apply_material({}, ElasticModel::MODES, *shape, settings));
	WorldData world;
	world.add_soft_body(SoftBodyData::create(shape, settings).value());
	SoftBodyData &body = world.soft_bodies()[0];
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE(!body.set_point(i, body.positions()[i], perpendicular(body.positions()[i]) * spin));
	}
	return world;
}

double fill(const SoftBodyData &body) {
	return double(signed_area(body.hull())) / double(body.shape().rest_area());
}

} // namespace

TEST_CASE("the area swings with the frequency of its bulk modulus") {
	// Points of mass m / n at radius R breathe together: A = A0 s², energy K A0 (2 s - 2)² / 2 for small strains, so
	// ω² = 4 K A0 / (m R²).
	constexpr Real BULK = 1000;
	SoftBodyData body = ring(BULK);
	blow_up(body, Real(1.005));
	const double frequency = std::sqrt(4.0 * BULK * double(body.shape().rest_area()) / (1 * 50.0 * 50.0));
	const double quarter = std::numbers::pi / 2 / frequency;
	constexpr int STEPS = 2000; // an implicit method needs small steps to swing
	for (int k = 0; k < STEPS; ++k) {
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			REQUIRE(!body.set_point(i, body.positions()[i] + body.velocities()[i] * Real(quarter / STEPS), body.velocities()[i]));
		}
		hold_area<Real>(lanes_of(body), Real(quarter / STEPS));
	}
	// At its rest area after a quarter of a period; 10 % in K would leave 8 % of the swing.
	CHECK(std::abs(fill(body) - 1) < 0.01 * 0.03);
}

TEST_CASE("what rests on a body finds the pressure of its material, whatever the substep") {
	// Points that something holds at rest: in a substep each gains h p |∂A/∂x| / m, with p = K C' C / A0 for
	// C = A0 (J - 1/J) / 2. On a ring of n points at radius r, ∂A/∂x is r sin(2 pi / n) long.
	for (const Real damping_time : { Real(0), Real(0.01) }) {
		for (const Real size : { Real(0.9), Real(0.98), Real(1.03) }) {
			for (const Real rate : { Real(120), Real(240), Real(960) }) {
				CAPTURE(damping_time);
				CAPTURE(size);
				CAPTURE(rate);
				SoftBodyData body = ring(500, damping_time);
				const double mass = double(body.shape().masses()[0]);
				blow_up(body, size);
				const double ratio = double(size) * double(size);
				const double pressure = 500 * (1 + 1 / (ratio * ratio)) / 2 * (1 / ratio - ratio) / 2;
				const double force = pressure * 50 * double(size) * std::sin(2 * std::numbers::pi / 16);
				hold_area<Real>(lanes_of(body), 1 / rate);
				const Vec2 outward = body.positions()[0] * (1 / length(body.positions()[0]));
				CHECK(double(dot(body.velocities()[0], outward)) * double(rate) == doctest::Approx(force / mass).epsilon(2e-3));
			}
		}
	}
}

TEST_CASE("holding the area keeps momentum and spin") {
	SoftBodyData body = ring(700, Real(0.01));
	Random random(3);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE(!body.set_point(i, body.positions()[i] + random.vector(10), random.vector(300)));
	}
	const Momentum before = measure_momentum(body);
	for (int k = 0; k < 10; ++k) {
		hold_area<Real>(lanes_of(body), Real(0.004));
	}
	const Momentum after = measure_momentum(body);
	CHECK(after.linear_x == doctest::Approx(before.linear_x).epsilon(1e-4));
	CHECK(after.linear_y == doctest::Approx(before.linear_y).epsilon(1e-4));
	CHECK(after.angular == doctest::Approx(before.angular).epsilon(5e-3)); // to first order in the way
}

TEST_CASE("no bulk modulus makes a body explode") {
	for (const Real bulk : { Real(1e2), Real(1e4), Real(1e6), Real(1e8) }) {
		WorldData world;
		world.add_soft_body(ring(bulk));
		blow_up(world.soft_bodies()[0], Real(1.2));
		Simulator simulator(world);
		double most = 0;
		for (int k = 0; k < 600; ++k) {
			CHECK(simulator.simulate(Real(1) / 60).reset_bodies.empty());
			most = std::max(most, std::abs(fill(world.soft_bodies()[0]) - 1));
		}
		CAPTURE(bulk);
		CHECK(most < 0.5);
		CHECK(std::abs(fill(world.soft_bodies()[0]) - 1) < 0.05);
	}
}

TEST_CASE("the area term aims at the inflation") {
	SoftBodyData data = ring(1000, Real(0.02));
	BodySettings settings = data.settings();
	settings.inflation = Real(1.5);
	REQUIRE(!data.set_settings(settings));
	WorldData world;
	world.add_soft_body(std::move(data));
	Simulator simulator(world);
	for (int k = 0; k < 300; ++k) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(fill(world.soft_bodies()[0]) == doctest::Approx(1.5).epsilon(0.01));
}

TEST_CASE("a body of elastic modes lets out all its air, spins fast and stays finite") {
	WorldData world = spinning_world(200, 0);
	Simulator simulator(world);
	for (int k = 0; k < 300; ++k) {
		CHECK(simulator.simulate(Real(1) / 60).reset_bodies.empty());
	}
}

TEST_CASE("a disk that spins in its plane keeps its spin") {
	WorldData world = spinning_world(4, 1);
	SoftBodyData &body = world.soft_bodies()[0];
	const double before = measure_momentum(body).angular;
	Simulator simulator(world);
	for (int k = 0; k < 120; ++k) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(measure_momentum(body).angular / before == doctest::Approx(1).epsilon(0.005)); // it lost a tenth a second
}

TEST_CASE("the area hardens as it goes to nothing, and pushes outward when turned inside out") {
	const auto push_at = [](Real factor) { // speed at which a point is driven outward in a substep
		SoftBodyData body = ring(100);
		blow_up(body, factor);
		hold_area<Real>(lanes_of(body), Real(0.001));
		return double(length(body.velocities()[0]));
	};
	// Half the size is a quarter of the area: C' C is (1 + 16)/2 · (4 - 1/4)/2 there, and a linear pressure would be 3/4.
	CHECK(push_at(Real(0.5)) > 4 * push_at(Real(0.8)));
	SoftBodyData mirrored = ring(100);
	for (std::uint32_t i = 0; i < mirrored.point_count(); ++i) {
		const Vec2 p = mirrored.positions()[i];
		REQUIRE(!mirrored.set_point(i, { p.x, -p.y }, {}));
	}
	hold_area<Real>(lanes_of(mirrored), Real(0.001));
	CHECK(dot(mirrored.velocities()[0], mirrored.positions()[0]) < 0); // through itself, as its area is negative
	CHECK(fill(mirrored) > -1);
}
