// SPDX-License-Identifier: MIT
// Claims about bodies and surroundings over whole steps: slopes, bounces, belts, masks.
#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double GRAVITY = 9.81;

// Four particles that lie on a line at the given angle, under gravity towards -y, with friction 0.4.
WorldData slope_world(double angle, Real restitution = 0) {
	WorldData world;
	world.set_gravity({ 0, Real(-GRAVITY) });
	const Rotation turn = Rotation::from_angle(Real(angle));
	world.add_border({ { {}, turn.apply({ 0, 1 }) }, {} });
	BodySettings settings;
	settings.restitution = restitution;
	SoftBodyData body = loose_points(4, Real(0.25), {}, settings);
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, turn.apply({ Real(i), 0 }), {});
	}
	world.add_soft_body(std::move(body));
	return world;
}

SoftBodyData &only_body(WorldData &world) {
	return world.soft_bodies()[0];
}

} // namespace

TEST_CASE("a block holds on a slope below the angle of friction") {
	const double friction = 0.4;
	for (const double share : { 0.0, 0.5, 0.99, -0.99 }) {
		const double angle = std::atan(friction * share);
		WorldData world = slope_world(angle);
		const auto start = copy_of(only_body(world).positions());
		Simulator simulator(world);
		for (int n = 0; n < 600; ++n) {
			simulator.simulate(FRAME);
		}
		// 2400 substeps, each with a few roundings of coordinates up to 3.
		CHECK(largest_distance(only_body(world).positions(), start) <= 2400 * 4 * EPSILON * 3);
	}
}

TEST_CASE("a block on a steeper slope slides with g (sin a - mu cos a)") {
	const double friction = 0.4;
	for (const double angle : { 0.5, 1.0, -0.7 }) {
		WorldData world = slope_world(angle);
		const auto start = copy_of(only_body(world).positions());
		Simulator simulator(world);
		const int frames = 60;
		std::uint64_t steps = 0;
		for (int n = 0; n < frames; ++n) {
			steps += simulator.simulate(FRAME).substeps;
		}
		const double h = double(FRAME) * frames / double(steps);
		const double acceleration = GRAVITY * (std::sin(std::abs(angle)) - friction * std::cos(angle));
		const double way = acceleration * h * h * double(steps) * double(steps + 1) / 2;
		const Vec2 downhill = Rotation::from_angle(Real(angle)).apply({ angle > 0 ? Real(-1) : Real(1), 0 });
		for (std::size_t i = 0; i < 4; ++i) {
			const Vec2 moved = only_body(world).positions()[i] - start[i];
			// 240 substeps of roundings of coordinates up to 7 and speeds up to 8.
			CHECK(distance(moved, downhill * Real(way)) <= 240 * 4 * EPSILON * 8);
		}
	}
}

TEST_CASE("a body that hits flat with restitution e rises to e² of its height") {
	for (const double e : { 0.25, 0.5, 1.0 }) {
		WorldData world = slope_world(0, Real(e));
		SoftBodyData &body = only_body(world);
		const double height = 2;
		for (std::uint32_t i = 0; i < 4; ++i) {
			body.set_point(i, { Real(i), Real(height) }, {});
		}
		Simulator simulator(world);
		double h = 0;
		double highest = 0;
		bool bounced = false;
		for (int n = 0; n < 200; ++n) {
			const Real before = body.velocities()[0].y;
			h = double(FRAME) / double(simulator.simulate(FRAME).substeps);
			bounced |= before < 0 && body.velocities()[0].y > 0;
			if (bounced) {
				highest = std::fmax(highest, double(body.positions()[0].y));
				if (body.velocities()[0].y < 0) {
					break;
				}
			}
		}
		// The moment of impact is known to one substep: v h of height, for the fall and for the rise; the
		// top is seen once a frame: g dt² / 8.
		const double impact = std::sqrt(2 * GRAVITY * height);
		CHECK(bounced);
		CHECK(std::abs(highest - e * e * height) <= 2 * impact * h + GRAVITY * double(FRAME * FRAME) / 8);
	}
}

TEST_CASE("a resting body does not bounce, however elastic") {
	WorldData world = slope_world(0, 1);
	Simulator simulator(world);
	for (int n = 0; n < 120; ++n) {
		simulator.simulate(FRAME);
		for (const Vec2 p : only_body(world).positions()) {
			CHECK(std::abs(double(p.y)) <= 16 * EPSILON);
		}
	}
}

TEST_CASE("where gravity does not pull a body, its slowest approach bounces") {
	// The threshold is two substeps of the body's own free fall, here of none.
	for (const bool weightless : { true, false }) {
		WorldData world = slope_world(0);
		BodySettings settings;
		settings.restitution = 1;
		settings.gravity_scale = weightless ? Real(0) : Real(1);
		SoftBodyData &body = only_body(world);
		REQUIRE_FALSE(body.set_settings(settings));
		for (std::uint32_t i = 0; i < 4; ++i) {
			body.set_point(i, { Real(i), 0 }, { 0, Real(-0.01) });
		}
		Simulator(world).simulate(FRAME);
		CHECK((body.velocities()[0].y > 0) == weightless);
	}
}

TEST_CASE("the report counts every answered contact of every substep") {
	WorldData world = slope_world(0);
	const StepReport report = Simulator(world).simulate(FRAME);
	CHECK(report.contacts == 4 * report.substeps);
}

TEST_CASE("a border holds hull points, and a body far in front of it is not touched") {
	WorldData world = pixel_world();
	world.set_gravity({});
	world.add_border(floor_at(50));
	world.add_soft_body(jelly_circle({ 0, -Real(0.01) })); // its lowest point at 49.99
	CHECK(Simulator(world).simulate(FRAME).contacts == 0);
}

TEST_CASE("a body notices only surroundings whose layer is in its mask") {
	for (const bool noticed : { true, false }) {
		WorldData world = pixel_world();
		BodySettings settings = jelly_settings();
		settings.collision_mask = noticed ? 6 : 5;
		Surface surface;
		surface.layer = 2;
		world.add_border(floor_at(400, surface));
		Collider ledge = box_collider({ 0, 150 }, { 200, 10 });
		ledge.surface = surface;
		world.add_collider(ledge);
		world.add_soft_body(jelly_circle({ 0, 0 }, settings));
		Simulator simulator(world);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 120; ++n) {
			contacts += simulator.simulate(FRAME).contacts;
		}
		const double y = measure_frame(only_body(world)).center.y;
		if (noticed) {
			CHECK(y < 140);
			CHECK(contacts > 0);
		} else {
			CHECK(y == doctest::Approx(980.0 * 2 * 2 / 2).epsilon(0.01)); // free fall
			CHECK(contacts == 0);
			CHECK(measure_penetration(world, only_body(world)) == 0);
		}
	}
}

TEST_CASE("a conveyor carries a body along at its own speed") {
	WorldData world = pixel_world();
	Surface belt;
	belt.linear_velocity = { 120, 0 };
	world.add_border(floor_at(0, belt));
	const std::vector<Vec2> crate{ { -50, -50 }, { 0, -50 }, { 50, -50 }, { 50, 0 }, { 0, 0 }, { -50, 0 } };
	const auto shape = SoftBodyCreator::create_polygon(crate, { 1, JELLY_STIFFNESS, 1, true }).value();
	world.add_soft_body(SoftBodyData::create(shape, jelly_settings(), Pose{ { 0, -2 }, {} }).value());
	Simulator simulator(world);
	for (int n = 0; n < 180; ++n) {
		simulator.simulate(FRAME);
	}
	// Friction brings it to speed within v / (mu g) = 0.3 s; what is left is wobble.
	CHECK(double(measure_frame(only_body(world)).velocity.x) == doctest::Approx(120).epsilon(0.01));
}

TEST_CASE("a body remembers how the surface moved at the place of the contact") {
	WorldData world = slope_world(0);
	BodySettings settings;
	settings.restitution = 1;
	settings.substeps = 1;
	Surface turning;
	turning.velocity_origin = { -10, 0 };
	turning.angular_velocity = Real(0.5);
	turning.friction = 0; // or the place would slide on
	world.clear_environment();
	REQUIRE_FALSE(world.add_border({ { {}, { 0, 1 } }, turning }));
	SoftBodyData &body = only_body(world);
	REQUIRE_FALSE(body.set_settings(settings));
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, { 20, 0 }, {}); // 30 from the origin of the turning
	}
	Simulator(world).simulate(FRAME);
	CHECK(body.touch_memory().touching);
	CHECK(distance(body.touch_memory().surface_velocity, { 0, 15 }) <= 16 * EPSILON * 15);
}
