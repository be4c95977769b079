// SPDX-License-Identifier: MIT
// Claims about bodies and surroundings over whole steps: slopes, bounces, belts, masks, walls, corners.
#include "core/collision/collision_handling.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <numbers>

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
		ConvexCollider ledge = box_collider({ 0, 150 }, { 200, 10 });
		ledge.surface = surface;
		world.add_collider(ledge);
		world.add_soft_body(jelly_circle({ 0, 0 }, settings));
		Simulator simulator(world);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 120; ++n) {
			contacts += simulator.simulate(FRAME).contacts;
		}
		const double y = measure_frame(only_body(world)).centre.y;
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

TEST_CASE("a body shot at a thin wall from afar stays on its side, even when the shot begins within the step") {
	for (const bool pushed : { false, true }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_collider(box_collider({ 700, 0 }, { 2, 500 }));
		world.add_collider({ { { -700, -500 }, { -700, 500 } }, 0, {} });
		for (const Real side : { Real(1), Real(-1) }) {
			BodySettings settings;
			settings.substeps = 4;
			SoftBodyData body = loose_points(8, 1, {}, settings);
			for (std::uint32_t i = 0; i < 8; ++i) {
				body.set_point(i, body.positions()[i] * Real(50), pushed ? Vec2{} : Vec2{ side * 60000, 0 });
				if (pushed) { // no speed yet when the broad phase looks: 100, 300, 600, 1000 px within the step
					body.add_external_force(i, { side * 5760000, 0 });
				}
			}
			world.add_soft_body(std::move(body));
		}
		Simulator simulator(world);
		for (int n = 0; n < 5; ++n) {
			simulator.simulate(FRAME);
			for (const SoftBodyData &body : world.soft_bodies()) {
				for (const Vec2 p : body.positions()) {
					CHECK(std::abs(double(p.x)) <= 700);
				}
			}
		}
		CHECK(std::abs(double(only_body(world).positions()[0].x)) > 690); // they did get there
	}
}

TEST_CASE("a jelly that rests on a thin platform cannot be slammed through it") {
	WorldData world = pixel_world();
	world.add_collider(box_collider({ 0, 100 }, { 300, 2 }));
	world.add_soft_body(jelly_circle({ 0, 40 }));
	Simulator simulator(world);
	for (int n = 0; n < 240; ++n) {
		simulator.simulate(FRAME);
	}
	CHECK(measure_frame(only_body(world)).centre.y < 98);
	for (std::uint32_t i = 0; i < only_body(world).point_count(); ++i) {
		only_body(world).apply_impulse(i, { 0, Real(5000) / (JELLY_HULL_POINTS + 1) }); // 5000 px/s: 10 px in a substep of 8
	}
	for (int n = 0; n < 60; ++n) {
		simulator.simulate(FRAME);
	}
	for (const Vec2 p : only_body(world).hull()) {
		CHECK(p.y < 99); // a single point below would hang there for good
	}
}

TEST_CASE("a collider between two hull points cannot enter through the edge") {
	// A round pin and a pointed one, both far narrower than the edge of 100 px that comes down on them.
	for (const bool round : { true, false }) {
		WorldData world = pixel_world();
		for (const Real x : { Real(-20), Real(20) }) {
			if (round) {
				world.add_collider({ { { x, 0 } }, 3, {} });
			} else {
				world.add_collider({ { { x, 0 }, { x + 2, 40 }, { x - 2, 40 } }, 0, {} });
			}
		}
		const std::vector<Vec2> crate{ { -50, -50 }, { 50, -50 }, { 50, 0 }, { -50, 0 } };
		const auto shape = SoftBodyCreator::create_polygon(crate, { 1, 1000, 1, true }).value();
		world.add_soft_body(SoftBodyData::create(shape, jelly_settings(1000), Pose{ { 0, -60 }, {} }).value());
		Simulator simulator(world);
		double deepest = 0;
		for (int n = 0; n < 300; ++n) {
			simulator.simulate(FRAME);
			deepest = std::fmax(deepest, double(measure_penetration(world, only_body(world))));
		}
		const BodyFrame frame = measure_frame(only_body(world));
		CHECK(deepest < 0.5); // 1 % of half the edge; each pin is pushed out in turn, so some is left
		CHECK(frame.centre.y < 0);
		CHECK(double(length(frame.velocity)) < 5);
	}
}

TEST_CASE("penetration is the depth of the deepest hull point or collider corner") {
	WorldData world;
	world.add_soft_body(loose_points(4, 1)); // a square on its tip: (1, 0), (0, 1), (-1, 0), (0, -1)
	const SoftBodyData &body = only_body(world);
	CHECK(measure_penetration(world, body) == 0);
	world.add_border({ { { 0, Real(-0.75) }, { 0, 1 } }, {} });
	CHECK(std::abs(double(measure_penetration(world, body)) - 0.25) <= 4 * EPSILON);
	world.add_collider({ { { Real(1.5), 0 } }, Real(0.875), {} }); // its rim reaches x = 0.625
	CHECK(std::abs(double(measure_penetration(world, body)) - 0.375) <= 8 * EPSILON);
	world.clear_surroundings();
	world.add_collider({ { { Real(0.25), Real(0.25) }, { 5, 4 }, { 4, 5 } }, 0, {} }); // a corner inside the hull
	CHECK(std::abs(double(measure_penetration(world, body)) - std::numbers::sqrt2 / 4) <= 8 * EPSILON);
	world.clear_surroundings();
	world.add_collider({ { { Real(0.75), Real(0.75) } }, Real(0.5), {} }); // round, touching an edge only
	CHECK(std::abs(double(measure_penetration(world, body)) - (0.5 - std::numbers::sqrt2 / 4)) <= 8 * EPSILON);
}

TEST_CASE("a corner inside the hull is answered by moving the edge that is nearest, outwards past it") {
	for (const bool inside : { true, false }) {
		WorldData world;
		world.add_soft_body(loose_points(4, 1));
		// The nearest edge runs from (1, 0) to (0, 1); a disc in its middle, its centre in or out.
		const Real x = inside ? Real(0.45) : Real(0.55);
		world.add_collider({ { { x, x } }, Real(0.2), {} });
		const Real before = measure_penetration(world, only_body(world));
		CHECK(before > 0.1);
		Simulator(world).simulate(Real(0.001));
		CHECK(measure_penetration(world, only_body(world)) <= 0.01 * double(before)); // four substeps of projection
		const auto p = only_body(world).positions();
		CHECK(p[0].x < 1); // both ends went inwards, alike
		CHECK(p[0].y < 0);
		CHECK(distance(p[0], { p[1].y, p[1].x }) <= 16 * EPSILON);
		CHECK(p[2] == only_body(world).previous_positions()[2]);
		CHECK(p[3] == only_body(world).previous_positions()[3]);
	}
}

TEST_CASE("a body starting half inside the ground comes out with no more energy than its squeezing holds") {
	for (const bool border : { true, false }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		if (border) {
			world.add_border(floor_at(0));
		} else {
			world.add_collider(box_collider({ 0, 500 }, { 1000, 500 }));
		}
		// What the springs hold once every point below the ground has been moved up to it.
		SoftBodyData squeezed = jelly_circle({ 0, 0 });
		for (std::uint32_t i = 0; i < squeezed.shape().hull_count(); ++i) {
			const Vec2 p = squeezed.positions()[i];
			squeezed.set_point(i, { p.x, std::min(p.y, Real(0)) }, {});
		}
		const double bound = measure_energy(squeezed, {}).total();
		world.add_soft_body(jelly_circle({ 0, 0 }));
		Simulator simulator(world);
		double most = 0;
		for (int n = 0; n < 120; ++n) {
			simulator.simulate(FRAME);
			most = std::fmax(most, measure_energy(only_body(world), {}).kinetic);
		}
		CHECK(most > 0);
		CHECK(most <= bound);
		CHECK(measure_penetration(world, only_body(world)) < 0.5);
	}
}
