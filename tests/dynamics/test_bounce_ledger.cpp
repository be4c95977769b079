// SPDX-License-Identifier: MIT
// Claims about the energy of bounces: none is made, little is lost, and it does not depend on ticks.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real RADIUS = 50;

// A disc without friction. Its springs are damped by a share of what would stop one of them between two of its points.
SoftBodyData bouncing_disc(Real stiffness, Real restitution, Vec2 center, Vec2 velocity, Real mass = 1, Real damping_ratio = 0) {
	BodySettings settings;
	settings.shape_stiffness = Real(0.4) * stiffness;
	settings.restitution = restitution;
	settings.friction = 0;
	const auto shape = circle_shape(RADIUS, 16, { mass, stiffness, 2 * damping_ratio * std::sqrt(stiffness * mass / 17), true }).value();
	SoftBodyData body = SoftBodyData::create(shape, settings, Pose{ center, {} }).value();
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE(!body.set_point(i, body.positions()[i], velocity));
	}
	return body;
}

WorldData weightless() {
	WorldData world;
	REQUIRE(!world.set_length_unit(PIXELS_PER_METER));
	world.set_sleeping(false);
	return world;
}

double energy_of(const WorldData &world) {
	double energy = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		energy += measure_energy(body, world.gravity()).total();
	}
	return energy;
}

struct Course {
	double highest = 1; ///< as a share of the first energy
	double end = 1;
};

Course run(WorldData &world, double seconds, const ParallelFor &parallel_for = {}) {
	Simulator simulator(world, parallel_for);
	const double first = energy_of(world);
	Course course;
	for (int i = 0; i < int(60 * seconds); ++i) {
		simulator.simulate(FRAME);
		course.end = energy_of(world) / first;
		course.highest = std::max(course.highest, course.end);
	}
	return course;
}

// Sixteen discs of any stiffness, mass and speed in a box whose walls bounce more or less.
WorldData random_crowd(std::uint64_t seed, Real damping_ratio) {
	Random random{ seed };
	WorldData world = weightless();
	const Real width = 700;
	for (const Vec2 normal : { Vec2{ 1, 0 }, Vec2{ -1, 0 }, Vec2{ 0, 1 }, Vec2{ 0, -1 } }) {
		Border wall;
		wall.plane = { { normal.x < 0 ? width : 0, normal.y < 0 ? width : 0 }, normal };
		wall.surface.restitution = random.real(0, 1);
		REQUIRE(!world.add_border(wall));
	}
	const Real restitution = random.real(Real(0.5), 1);
	for (int i = 0; i < 16; ++i) {
		const Real angle = random.real(0, 2 * std::numbers::pi_v<Real>);
		const Real stiffness = std::pow(Real(10), random.real(2, Real(3.6)));
		const Vec2 velocity = Vec2{ std::cos(angle), std::sin(angle) } * random.real(50, 400);
		world.add_soft_body(bouncing_disc(stiffness, restitution, { Real(100 + 160 * (i % 4)), Real(100 + 160 * (i / 4)) }, velocity,
				random.real(Real(0.5), 2), damping_ratio));
	}
	return world;
}

} // namespace

TEST_CASE("a crowd in a closed box never gains energy, whatever it is made of: 200 random crowds" * doctest::test_suite("slow")) {
	int lively = 0;
	for (int seed = 1; seed <= 200; ++seed) {
		CAPTURE(seed);
		WorldData world = random_crowd(std::uint64_t(seed), 0);
		const Course course = run(world, 5);
		CHECK(course.highest <= 1.01); // of 3,000 crowds, one reached 1.048, and all others stay below 1.005
		lively += course.end > 0.5;
	}
	CHECK(lively >= 150);
}

TEST_CASE("nor does a crowd of bodies with a little damping, which take fewer substeps near their rest shape: 200 random crowds" * doctest::test_suite("slow")) {
	for (int seed = 1; seed <= 200; ++seed) {
		CAPTURE(seed);
		WorldData world = random_crowd(std::uint64_t(seed), Real(0.01));
		CHECK(run(world, 5).highest <= 1.01);
	}
}

TEST_CASE("a row of five bodies passes a shot on without making energy, and loses a tenth at most") {
	for (const Real stiffness : { Real(100), Real(1000), Real(4000) }) {
		for (const Real gap : { Real(0.05), Real(0.5), Real(5) }) {
			CAPTURE(stiffness);
			CAPTURE(gap);
			WorldData world = weightless();
			for (int i = 0; i < 5; ++i) {
				world.add_soft_body(bouncing_disc(stiffness, 1, { Real(i) * (2 * RADIUS + gap) - (i == 0 ? 100 : 0), 0 },
						{ i == 0 ? Real(300) : Real(0), 0 }));
			}
			const Course course = run(world, 3);
			CHECK(course.highest <= 1.01);
			CHECK(course.end >= 0.9);
			CHECK(double(measure_frame(world.soft_bodies()[4]).velocity.x) > 210);
		}
	}
}

TEST_CASE("two bodies of restitution 1 part as fast as they met, to a twentieth: 300 random pairs") {
	int parted_well = 0;
	for (int seed = 1; seed <= 300; ++seed) {
		CAPTURE(seed);
		Random random{ std::uint64_t(seed) };
		WorldData world = weightless();
		const Real speed = random.real(100, 600);
		const Real stiffness = std::pow(Real(10), random.real(2, Real(3.6)));
		world.add_soft_body(bouncing_disc(stiffness, 1, {}, { speed, 0 }, random.real(Real(0.5), 2)));
		world.add_soft_body(bouncing_disc(stiffness, 1, { 200, random.real(0, 70) }, {}, random.real(Real(0.5), 2)));
		const Course course = run(world, 3);
		CHECK(course.highest <= 1.01);
		const Vec2 parting = measure_frame(world.soft_bodies()[1]).velocity - measure_frame(world.soft_bodies()[0]).velocity;
		CHECK(double(length(parting) / speed) >= 0.9); // the rest is spin: hulls have corners
		parted_well += length(parting) >= Real(0.95) * speed;
	}
	CHECK(parted_well >= 285);
}

TEST_CASE("a bounce of 0.8 rises to 0.64 of the drop, at any rate of ticks, for soft bodies and stiff ones") {
	for (const Real stiffness : { Real(100), Real(1000), Real(10000) }) {
		double least = 1e9;
		double most = 0;
		for (const int rate : { 30, 60, 120, 240 }) {
			WorldData world = pixel_world();
			world.set_sleeping(false);
			REQUIRE(!world.add_border(floor_at(0)));
			BodySettings settings;
			settings.shape_stiffness = Real(0.4) * stiffness;
			settings.shape_damping = Real(0.05) * std::sqrt(stiffness);
			settings.restitution = Real(0.8);
			const auto shape = circle_shape(RADIUS, 16, { 1, stiffness, Real(0.012) * std::sqrt(stiffness), true }).value();
			world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ { 0, -RADIUS - 300 }, {} }).value());
			Simulator simulator(world);
			double height = 0;
			bool has_hit = false;
			for (int i = 0; i < 2 * rate; ++i) {
				simulator.simulate(Real(1) / Real(rate));
				const double above = -double(measure_frame(world.soft_bodies()[0]).center.y) - double(RADIUS);
				has_hit |= above < 0;
				height = std::max(height, has_hit ? above : 0.0);
			}
			least = std::min(least, height);
			most = std::max(most, height);
		}
		CAPTURE(stiffness);
		CHECK(least >= 0.97 * 0.64 * 300);
		CHECK(most <= 1.03 * least);
	}
}

TEST_CASE("energy that a body has passed on is not paid out to it again") {
	// The first stops, as the second takes its energy to a third: a bounce of the first two would make it twice.
	WorldData world = weightless();
	for (int i = 0; i < 3; ++i) {
		world.add_soft_body(bouncing_disc(1000, 1, { Real(i) * 2 * RADIUS - (i == 0 ? 60 : 0), 0 }, { i == 0 ? Real(300) : Real(0), 0 }));
	}
	const Course course = run(world, 2);
	CHECK(course.highest <= 1.01);
	CHECK(double(measure_frame(world.soft_bodies()[2]).velocity.x) > 240);
	CHECK(double(std::abs(measure_frame(world.soft_bodies()[0]).velocity.x)) < 60);
}

TEST_CASE("a bat that swings gives a body its speed: work of a moving surface is not taken back from the wobble") {
	WorldData world = weightless();
	RigidBody mover;
	mover.linear_velocity = { 200, 0 };
	Collider bat = box_collider({ -50, 0 }, { 50, 200 });
	bat.surface.restitution = 1;
	bat.rigid_body = world.add_rigid_body(mover).value();
	REQUIRE(!world.add_collider(bat));
	world.add_soft_body(bouncing_disc(1000, 0, { RADIUS + 2, 0 }, { -100, 0 }));
	Simulator simulator(world);
	for (int i = 0; i < 30; ++i) {
		simulator.simulate(FRAME);
	}
	// It came with 300 px/s relative to the surface and leaves with 300 relative to it.
	CHECK(double(measure_frame(world.soft_bodies()[0]).velocity.x) == doctest::Approx(500).epsilon(0.05));
}

TEST_CASE("a body at rest saves up nothing, and what a touch has taken is forgotten in flight") {
	WorldData world = pixel_world();
	world.set_sleeping(false);
	REQUIRE(!world.add_border(floor_at(0)));
	BodySettings settings = jelly_settings(1000);
	settings.restitution = Real(0.2);
	world.add_soft_body(jelly_circle({ 0, -RADIUS - 200 }, settings));
	SoftBodyData &body = world.soft_bodies()[0];
	Simulator simulator(world);
	bool has_touched = false;
	double first_account = 0;
	int flight = 0;
	for (int i = 0; i < 120 && flight < 10; ++i) {
		simulator.simulate(FRAME);
		const TouchMemory &touch = body.touch_memory();
		has_touched |= touch.touching;
		if (has_touched && !touch.touching) {
			first_account = flight == 0 ? touch.account : first_account;
			++flight;
		}
	}
	REQUIRE(flight == 10);
	CHECK(first_account > 1000); // of m g h = 196000; the springs gave the rest back
	CHECK(body.touch_memory().account == doctest::Approx(first_account * std::pow(1 - 1 / (60 * 0.3), 9)).epsilon(0.01));
	for (int i = 0; i < 600; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(body.touch_memory().touching);
	CHECK(body.touch_memory().account < 200); // of 196000 that are gone
}

TEST_CASE("work of forces from outside is no gain of a touch: a body that is shaken wobbles on any floor alike") {
	std::array<double, 2> farthest{};
	for (const bool bounces : { false, true }) {
		WorldData world = pixel_world();
		world.set_sleeping(false);
		REQUIRE(!world.add_border(floor_at(0)));
		BodySettings settings = jelly_settings(1000);
		settings.restitution = bounces ? Real(0.1) : Real(0);
		world.add_soft_body(jelly_circle({ 0, -RADIUS }, settings));
		SoftBodyData &body = world.soft_bodies()[0];
		Simulator simulator(world);
		for (int i = 0; i < 120; ++i) {
			simulator.simulate(FRAME);
		}
		for (int i = 0; i < 60; ++i) {
			REQUIRE(!body.add_external_force(16, { i % 8 < 4 ? Real(2000) : Real(-2000), 0 })); // its center
			simulator.simulate(FRAME);
			const double offset = double(body.positions()[16].x - measure_frame(body).center.x);
			farthest[bounces] = std::max(farthest[bounces], std::abs(offset));
		}
	}
	CHECK(farthest[0] > 3);
	CHECK(farthest[1] == doctest::Approx(farthest[0]).epsilon(0.001));
}
