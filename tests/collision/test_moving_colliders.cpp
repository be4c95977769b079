// SPDX-License-Identifier: MIT
// Claims about colliders that move whatever is in their way: pistons, lifts, paddles, bullets.
#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

struct Kind {
	const char *name;
	Collider collider; ///< its top is at y = 0, wide enough for a jelly
};

std::vector<Kind> all_kinds() {
	Collider rounded = box_collider({ 0, 40 }, { 150, 30 });
	rounded.radius = 10;
	return { { "circle", { { { 0, 300 } }, 300, {} } }, { "segment", { { { -160, 0 }, { 160, 0 } }, 0, {} } },
		{ "capsule", { { { -160, 20 }, { 160, 20 } }, 20, {} } }, { "polygon", box_collider({ 0, 40 }, { 160, 40 }) },
		{ "rounded polygon", rounded } };
}

std::uint32_t add_moving(WorldData &world, Collider collider, const RigidBody &body) {
	const std::uint32_t index = world.add_rigid_body(body).value();
	collider.rigid_body = index;
	REQUIRE_FALSE(world.add_collider(collider));
	return index;
}

RigidBody moving(Vec2 position, Vec2 velocity, Real spin = 0) {
	RigidBody body;
	body.pose.position = position;
	body.linear_velocity = velocity;
	body.angular_velocity = spin;
	return body;
}

const SoftBodyData &only_body(const WorldData &world) {
	return world.soft_bodies()[0];
}

} // namespace

TEST_CASE("in a frame that moves along, a moving collider is one that stands still") {
	// A jelly falls on each kind, bounces, rolls and rests, in a frame at rest and in one that moves.
	for (const Kind &kind : all_kinds()) {
		for (const Vec2 velocity : { Vec2{ 300, 0 }, Vec2{ -100, 250 }, Vec2{ 0, -400 } }) {
			CAPTURE(kind.name);
			WorldData still = pixel_world();
			WorldData moved = pixel_world();
			BodySettings settings = jelly_settings();
			settings.restitution = Real(0.3);
			Collider collider = kind.collider;
			collider.surface.linear_velocity = { 20, 0 }; // a belt on top
			REQUIRE_FALSE(still.add_collider(collider));
			add_moving(moved, collider, moving({}, velocity));
			const SoftBodyData jelly = jelly_circle({ 10, -90 }, settings);
			still.add_soft_body(jelly);
			moved.add_soft_body(jelly);
			for (std::uint32_t i = 0; i < jelly.point_count(); ++i) {
				moved.soft_bodies()[0].set_point(i, jelly.positions()[i], velocity);
			}
			Simulator of_still(still);
			Simulator of_moved(moved);
			std::uint64_t contacts = 0;
			for (int n = 0; n < 45; ++n) {
				contacts += of_still.simulate(FRAME).contacts;
				of_moved.simulate(FRAME);
			}
			CHECK(contacts > 10);
			const Vec2 way = velocity * (FRAME * 45);
			CHECK(distance(moved.rigid_bodies()[0].pose.position, way) <= 45 * EPSILON * 400);
			for (std::size_t i = 0; i < jelly.point_count(); ++i) {
				// Roundings of coordinates up to 500, which contacts and wobble magnify: 60 substeps in touch.
				CHECK(distance(only_body(moved).positions()[i] - way, only_body(still).positions()[i]) <= 2000 * EPSILON * 500);
			}
		}
	}
}

TEST_CASE("an elastic wall that comes with speed u sends a resting particle off with 2u") {
	WorldData world;
	BodySettings settings;
	settings.restitution = 1;
	SoftBodyData body = loose_points(4, 1, {}, settings);
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, { Real(0.01), Real(i) }, {});
	}
	world.add_soft_body(std::move(body));
	add_moving(world, box_collider({ -1, 2 }, { 1, 5 }), moving({}, { 3, 0 }));
	Simulator simulator(world);
	simulator.simulate(FRAME);
	for (const Vec2 v : only_body(world).velocities()) {
		CHECK(distance(v, { 6, 0 }) <= 16 * EPSILON * 6);
	}
	CHECK(world.reactions()[0].impulse == Vec2{}); // it does not feel it
	CHECK(world.rigid_bodies()[0].linear_velocity == Vec2{ 3, 0 });
}

TEST_CASE("a lift carries a jelly up, a sledge carries it along, and without friction the sledge leaves it") {
	for (const Real friction : { Real(1), Real(0) }) {
		WorldData world = pixel_world();
		BodySettings settings = jelly_settings();
		settings.friction = friction;
		settings.rolling_resistance = Real(0.3);
		const std::vector<Vec2> crate{ { -50, -50 }, { 0, -50 }, { 50, -50 }, { 50, 0 }, { 0, 0 }, { -50, 0 } };
		const auto shape = SoftBodyCreator::create_polygon(crate, { 1, JELLY_STIFFNESS, 1, true }).value();
		world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ { 0, -1 }, {} }).value());
		add_moving(world, box_collider({ 0, 50 }, { 1000, 50 }), moving({}, { 60, -90 }));
		Simulator simulator(world);
		for (int n = 0; n < 180; ++n) {
			simulator.simulate(FRAME);
		}
		const BodyFrame frame = measure_frame(only_body(world));
		CHECK(double(frame.velocity.y) == doctest::Approx(-90).epsilon(0.02));
		CHECK(double(frame.velocity.x) == doctest::Approx(friction > 0 ? 60 : 0).epsilon(0.02).scale(60));
		CHECK(measure_penetration(world, only_body(world)) < 0.5);
	}
}

TEST_CASE("a piston at sixty radii a second, a wall or as thin as a segment, does not pass through a jelly") {
	const Real speed = 60 * JELLY_RADIUS;
	for (const bool thin : { false, true }) {
		for (const Real side : { Real(1), Real(-1) }) {
			CAPTURE(thin);
			WorldData world = pixel_world();
			world.set_gravity({});
			world.add_soft_body(jelly_circle({ 0, 0 }));
			const Collider wall = thin ? Collider{ { { 0, -200 }, { 0, 200 } }, 0, {} } : box_collider({}, { 2, 200 });
			const std::uint32_t piston = add_moving(world, wall, moving({ -side * 160, 0 }, { side * speed, 0 }));
			Simulator simulator(world);
			for (int n = 0; n < 20; ++n) {
				CHECK(simulator.simulate(FRAME).reset_bodies.empty());
				const Real x = world.rigid_bodies()[piston].pose.position.x;
				for (const Vec2 p : only_body(world).hull()) {
					CHECK(double((p.x - x) * side) >= -0.01); // rounding of x up to 1000
				}
			}
			CHECK(double(measure_frame(only_body(world)).velocity.x * side) > 0.9 * double(speed));
		}
	}
}

TEST_CASE("a paddle that turns fast sweeps a jelly before it and never has it behind") {
	for (const Real spin : { Real(30), Real(-30) }) { // its middle moves at 60 radii a second: 7 degrees a substep
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_soft_body(jelly_circle({ 70, spin > 0 ? Real(75) : Real(-75) }));
		add_moving(world, box_collider({ 100, 0 }, { 100, 2 }), moving({}, {}, spin));
		Simulator simulator(world);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 3; ++n) { // a quarter of a turn
			contacts += simulator.simulate(FRAME).contacts;
		}
		CHECK(contacts > 20);
		const Pose pose = world.rigid_bodies()[0].pose;
		for (const Vec2 p : only_body(world).hull()) {
			const Vec2 own = pose.apply_inverse(p);
			if (own.x > 0 && own.x < 200) {
				CHECK(double(own.y * spin) > 0); // in front of the middle of the blade
			}
		}
	}
}

TEST_CASE("a small ball shot at a jelly pushes in the edge that it meets, and does not come in by another") {
	// Between two hull points; in one substep it goes an eighth of the jelly's width.
	for (const bool pointed : { false, true }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_soft_body(jelly_circle({ 0, 0 }));
		const Collider ball = pointed ? Collider{ { { 0, 0 }, { -20, 1 }, { -20, -1 } }, 0, {} }
											: Collider{ { { 0, 0 } }, 3, {} };
		add_moving(world, ball, moving({ -80, 5 }, { 3000, 0 }));
		Simulator simulator(world);
		for (int n = 0; n < 2; ++n) {
			simulator.simulate(FRAME);
		}
		CHECK(double(world.rigid_bodies()[0].pose.position.x) > 15); // more than half through where the jelly was
		CHECK(double(measure_penetration(world, only_body(world))) < 2); // each edge is pushed out in turn
		CHECK_FALSE(is_folded(only_body(world).hull()));
	}
}

TEST_CASE("a jelly that a collider leaves behind flies on by itself") {
	for (const Kind &kind : all_kinds()) {
		CAPTURE(kind.name);
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_soft_body(jelly_circle({ 0, -60 }));
		const std::uint32_t lift = add_moving(world, kind.collider, moving({}, { 0, -300 }));
		Simulator simulator(world);
		for (int n = 0; n < 30; ++n) {
			simulator.simulate(FRAME);
		}
		RigidBody body = world.rigid_bodies()[lift];
		body.linear_velocity = { 0, 500 };
		REQUIRE_FALSE(world.set_rigid_body(lift, body));
		simulator.simulate(FRAME);
		const Vec2 momentum = measure_frame(only_body(world)).velocity;
		CHECK(double(momentum.y) < -290);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 30; ++n) {
			contacts += simulator.simulate(FRAME).contacts;
		}
		CHECK(contacts == 0);
		CHECK(distance(measure_frame(only_body(world)).velocity, momentum) <= 240 * EPSILON * 400);
	}
}

TEST_CASE("bodies that take their substeps together meet a moving collider where the others do") {
	// Two jellies beside each other that never touch, or alone; the same number of substeps either way.
	std::vector<std::vector<Vec2>> ends;
	for (const bool together : { true, false }) {
		WorldData world = pixel_world();
		BodySettings settings = jelly_settings();
		settings.substeps = 8;
		world.add_soft_body(jelly_circle({ 0, -60 }, settings));
		if (together) {
			world.add_soft_body(jelly_circle({ 102, -60 }, settings));
		}
		add_moving(world, box_collider({ 0, 50 }, { 51, 50 }), moving({}, { 0, -300 }, Real(0.5)));
		Simulator simulator(world);
		for (int n = 0; n < 8; ++n) {
			simulator.simulate(FRAME);
		}
		ends.push_back(copy_of(only_body(world).positions()));
	}
	CHECK(largest_distance(ends[0], ends[1]) <= 500 * EPSILON * 100);
}
