// SPDX-License-Identifier: MIT
// Claims about rigid bodies that soft bodies push: impulses, momentum, mass ratios, rest, threads.
#include "core/collision/rigid_contacts.h"
#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/threads.h"
#include "thesis/damping_ratio.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

RigidBody box_body(Vec2 position, Real mass, Vec2 half) {
	RigidBody body;
	body.pose.position = position;
	body.inverse_mass = 1 / mass;
	body.inverse_inertia = 3 / (mass * (half.x * half.x + half.y * half.y));
	return body;
}

std::uint32_t add_rigid(WorldData &world, const RigidBody &body, std::vector<Collider> parts) {
	const std::uint32_t index = world.add_rigid_body(body).value();
	for (Collider &part : parts) {
		part.rigid_body = index;
		REQUIRE_FALSE(world.add_collider(std::move(part)));
	}
	return index;
}

// A box with its center of mass in its middle.
std::uint32_t add_box(WorldData &world, Vec2 position, Real mass, Vec2 half, Vec2 velocity = {}) {
	RigidBody body = box_body(position, mass, half);
	body.linear_velocity = velocity;
	body.acceleration = world.gravity();
	return add_rigid(world, body, { box_collider({}, half) });
}

struct Momentum {
	double x = 0;
	double y = 0;
	double angular = 0; ///< about the world's origin
	double size = 0; ///< what its roundings are measured by

	void add(double mass, Vec2 place, Vec2 velocity) {
		x += mass * velocity.x;
		y += mass * velocity.y;
		angular += mass * (double(place.x) * velocity.y - double(place.y) * velocity.x);
		size += mass * double(length(velocity));
	}
};

Momentum momentum_of(const WorldData &world) {
	Momentum sum;
	for (const SoftBodyData &body : world.soft_bodies()) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			sum.add(body.shape().masses()[i], body.positions()[i], body.velocities()[i]);
		}
	}
	for (const RigidBody &body : world.rigid_bodies()) {
		if (body.inverse_mass > 0) {
			sum.add(1 / double(body.inverse_mass), body.center(), body.linear_velocity);
		}
		if (body.inverse_inertia > 0) {
			sum.angular += double(body.angular_velocity) / double(body.inverse_inertia);
		}
	}
	return sum;
}

// Points without springs, one of which lies just in the top of a box; the others are far away.
WorldData particle_world(Vec2 place, Vec2 velocity, Real mass, Real friction, Real restitution) {
	WorldData world;
	BodySettings settings;
	settings.friction = friction;
	settings.restitution = restitution;
	settings.substeps = 4;
	SoftBodyData body = loose_points(4, mass, {}, settings);
	body.set_point(0, place, velocity);
	for (std::uint32_t i = 1; i < 4; ++i) { // far above, a triangle that cannot meet the box
		body.set_point(i, { Real(i), Real(-1000 - int(i % 2)) }, {});
	}
	world.add_soft_body(std::move(body));
	return world;
}

SoftBodyData stiff_jelly(Vec2 center, Real mass = 1) {
	const Real stiffness = 1000 * mass;
	const Real damping = damping_for_ratio(Real(0.3), stiffness, mass, JELLY_HULL_POINTS + 1);
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { mass, stiffness, damping, true });
	BodySettings settings = jelly_settings(stiffness);
	return SoftBodyData::create(shape.value(), settings, Pose{ center, {} }).value();
}

struct Kind {
	const char *name;
	std::vector<Collider> parts; ///< their top is at y = 0
};

std::vector<Kind> all_kinds() {
	Collider rounded = box_collider({ 0, 40 }, { 150, 30 });
	rounded.radius = 10;
	return { { "two circles", { { { { -60, 100 } }, 100, {} }, { { { 60, 100 } }, 100, {} } } },
		{ "segment", { { { { -160, 0 }, { 160, 0 } }, 0, {} } } },
		{ "capsule", { { { { -160, 20 }, { 160, 20 } }, 20, {} } } }, { "polygon", { box_collider({ 0, 40 }, { 160, 40 }) } },
		{ "rounded polygon", { rounded } } };
}

} // namespace

TEST_CASE("a rigid corner hits an edge anywhere between its ends: the place leaves as fast as restitution says") {
	Random random(342);
	for (int round = 0; round < 300; ++round) {
		CAPTURE(round);
		const Real mass = random.real(0.1, 5);
		const Real restitution = random.real(0, 1);
		BodySettings settings;
		settings.restitution = restitution;
		settings.friction = 0;
		settings.substeps = 4;
		// A large triangle of loose points, whose lower edge comes down, and may turn as it does.
		SoftBodyData body = loose_points(3, mass, {}, settings);
		const Vec2 falls{ random.real(-2, 2), -random.real(1, 4) };
		const Vec2 falls_too{ random.real(-2, 2), -random.real(1, 4) };
		body.set_point(0, { -20, 0 }, falls);
		body.set_point(1, { 20, 0 }, falls_too);
		body.set_point(2, { 0, 300 }, {});
		WorldData world;
		world.add_soft_body(std::move(body));
		const Real at = random.real(-18, 18);
		RigidBody wedge = box_body({ at, Real(-1e-4) }, random.real(0.1, 5), { 1, 1 });
		wedge.inverse_inertia = 0; // it does not turn
		Collider collider;
		collider.vertices = { { 0, 0 }, { -1, -3 }, { 1, -3 } };
		add_rigid(world, wedge, { collider });
		Simulator simulator(world);
		simulator.simulate(Real(1e-3)); // so short that nothing but the contact happens
		const Real t = (at + 20) / 40;
		const auto velocities = world.soft_bodies()[0].velocities();
		const double approach = -double((falls * (1 - t) + falls_too * t).y);
		const double leaving = double((velocities[0] * (1 - t) + velocities[1] * t).y - world.rigid_bodies()[0].linear_velocity.y);
		CHECK(std::abs(leaving - double(restitution) * approach) <= 0.02 * approach);
		// Each end gets its share.
		const double first = double(velocities[0].y - falls.y);
		const double second = double(velocities[1].y - falls_too.y);
		CHECK(std::abs(first * double(t) - second * double(1 - t)) <= 0.02 * (first + second));
	}
}

TEST_CASE("a particle hits a free box anywhere: restitution, Coulomb's law, one impulse in one place") {
	Random random(341);
	for (int round = 0; round < 1000; ++round) {
		const Real mass = random.real(0.1, 5);
		const Real friction = random.chance(0.5) ? random.real(0, 1.5) : Real(0);
		const Real restitution = random.real(0, 1);
		const Vec2 place{ random.real(-3, 3), Real(-0.5) }; // on the top of the box; y points down
		const Vec2 velocity{ random.real(-4, 4), random.real(1, 5) };
		WorldData world = particle_world(place, velocity, mass, friction, restitution);
		RigidBody box = box_body({}, random.real(0.1, 5), { 3, Real(0.5) });
		box.center_of_mass = random.vector(0.4);
		if (random.chance(0.2)) {
			box.inverse_inertia = 0; // it does not turn
		} else if (random.chance(0.2)) {
			box.inverse_mass = 0; // it turns about a nail
		}
		Collider collider = box_collider({}, { 3, Real(0.5) });
		const Real belt = random.real(-2, 2);
		collider.surface.linear_velocity = { belt, 0 };
		collider.surface.rough = true;
		collider.surface.friction = friction;
		add_rigid(world, box, { collider });
		const Momentum before = momentum_of(world);
		Simulator simulator(world);
		simulator.simulate(Real(1e-4)); // so short that nothing but the contact happens

		const RigidBody &after = world.rigid_bodies()[0];
		const Vec2 gained = (world.soft_bodies()[0].velocities()[0] - velocity) * mass; // the impulse on the particle
		const Vec2 arm = place - box.center_of_mass;
		const double rounding = 200 * EPSILON * 50 + 2e-3; // the places move by 1e-4 s of a speed of 5, levers of 3
		// The response matrix of both together, column by column.
		const double w = 1 / double(mass) + box.inverse_mass;
		const double nn = w + double(box.inverse_inertia) * arm.x * arm.x;
		const double tt = w + double(box.inverse_inertia) * arm.y * arm.y;
		const double nt = -double(box.inverse_inertia) * arm.x * arm.y;
		const double approach = velocity.y;
		const double slide = velocity.x - belt;
		// Where the box turns, friction changes the approach too, and both are sought in a few passes.
		const double jn = -double(gained.y);
		const double jt = gained.x;
		const double leaving = -(approach - nn * jn + nt * jt);
		const double sliding = slide - nt * jn + tt * jt;
		CHECK(std::abs(leaving - double(restitution) * approach) <= rounding + (friction > 0 ? 0.25 * approach : 0.0));
		CHECK(std::abs(jt) <= double(friction) * jn + rounding);
		if (std::abs(jt) < 0.97 * double(friction) * jn) { // it sticks
			CHECK(std::abs(sliding) <= rounding + 0.05 * (std::abs(slide) + approach));
		}
		// What the particle got, the box gave.
		const Reaction reaction = world.reactions()[0];
		CHECK(distance(reaction.impulse, -gained) <= 64 * EPSILON * 50);
		CHECK(distance(after.linear_velocity, reaction.impulse * box.inverse_mass) <= 64 * EPSILON * 50);
		CHECK(std::abs(double(reaction.angular_impulse - cross(arm, reaction.impulse))) <= 64 * EPSILON * 200 + 0.01);
		CHECK(std::abs(double(after.angular_velocity - reaction.angular_impulse * box.inverse_inertia)) <= 64 * EPSILON * 50);
		if (box.inverse_mass > 0) {
			const Momentum now = momentum_of(world);
			CHECK(std::abs(now.x - before.x) + std::abs(now.y - before.y) <= 64 * EPSILON * 50);
		}
	}
}

TEST_CASE("momentum of soft and rigid bodies together stays, through a thousand contacts") {
	Random random(342);
	for (int round = 0; round < 5; ++round) {
		WorldData world = pixel_world();
		world.set_gravity({});
		for (int i = 0; i < 6; ++i) {
			SoftBodyData body = jelly_circle(Vec2{ Real(110 * i), Real(-150) } + random.vector(5));
			for (std::uint32_t k = 0; k < body.point_count(); ++k) {
				body.set_point(k, body.positions()[k], { 0, 200 });
			}
			world.add_soft_body(std::move(body));
		}
		RigidBody plank = box_body({ 300, 0 }, random.real(0.2, 20), { 350, 20 });
		plank.angular_velocity = random.real(-1, 1);
		plank.linear_velocity = { 0, -200 };
		// Two convex parts of one body, and a ball of its own.
		add_rigid(world, plank, { box_collider({ -175, 0 }, { 175, 20 }), box_collider({ 175, 0 }, { 175, 20 }) });
		add_rigid(world, box_body({ 300, -300 }, 1, { 40, 40 }), { { { { 0, 0 } }, 40, {} } });
		const Momentum before = momentum_of(world);
		Simulator simulator(world);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 60; ++n) {
			contacts += simulator.simulate(FRAME).contacts;
		}
		CHECK(contacts > 200);
		const Momentum after = momentum_of(world);
		// A rounding each substep for every point, of its momentum.
		const double rounding = 60 * 4 * EPSILON * (before.size + after.size);
		CHECK(std::abs(after.x - before.x) <= rounding);
		CHECK(std::abs(after.y - before.y) <= rounding);
	}
}

TEST_CASE("an impact turns a box the way its lever says, and keeps angular momentum") {
	for (const Real side : { Real(1), Real(-1) }) {
		WorldData world = particle_world({ side * 2, Real(-0.5) }, { 0, 3 }, 1, 0, 1);
		add_rigid(world, box_body({}, 2, { 3, Real(0.5) }), { box_collider({}, { 3, Real(0.5) }) });
		const Momentum before = momentum_of(world);
		Simulator(world).simulate(Real(1e-4));
		CHECK(double(world.rigid_bodies()[0].angular_velocity * side) > 0.5);
		// The place is known to v h = 8e-5 of a lever of 2, and is moved by as much.
		CHECK(std::abs(momentum_of(world).angular - before.angular) <= 1e-3);
	}
}

TEST_CASE("a reaction is of one step: the change of the rigid body's momentum, and nothing without a contact") {
	WorldData world = pixel_world();
	world.add_border(floor_at(60));
	world.add_soft_body(stiff_jelly({ 0, 0 }));
	const std::uint32_t crate = add_box(world, { 0, -90 }, 2, { 40, 20 });
	RigidBody idle;
	idle.linear_velocity = { 0, 5 };
	add_rigid(world, idle, { box_collider({ 900, 0 }, { 5, 5 }) });
	Simulator simulator(world);
	bool pressed = false;
	for (int n = 0; n < 60; ++n) {
		const RigidBody before = world.rigid_bodies()[crate];
		simulator.simulate(FRAME);
		const RigidBody &after = world.rigid_bodies()[crate];
		const Vec2 free = before.linear_velocity + before.acceleration * FRAME;
		const Reaction &reaction = world.reactions()[crate];
		CHECK(distance((after.linear_velocity - free) * 2, reaction.impulse) <= 64 * EPSILON * 1000);
		const double turned = double(after.angular_velocity - before.angular_velocity) / double(before.inverse_inertia);
		CHECK(std::abs(turned - double(reaction.angular_impulse)) <= 64 * EPSILON * 100000);
		CHECK(world.reactions()[1].impulse == Vec2{});
		pressed |= reaction.impulse.y < -1;
	}
	CHECK(pressed);
	world.remove_soft_body(world.id_at(0));
	simulator.simulate(FRAME);
	CHECK(world.reactions()[crate].impulse == Vec2{});
	CHECK(world.reactions()[crate].angular_impulse == 0);
}

TEST_CASE("a rigid body that meets nothing falls as it should, near soft bodies as far from them") {
	std::vector<Vec2> ends;
	for (const Real gap : { Real(1), Real(100000) }) {
		WorldData world = pixel_world();
		world.add_soft_body(jelly_circle({ 50 + gap + 20, 0 })); // falls beside it
		RigidBody body = box_body({ 0, 0 }, 3, { 20, 20 });
		body.acceleration = { 0, PIXEL_GRAVITY };
		body.linear_velocity = { 0, -100 };
		body.angular_velocity = Real(0.01);
		add_rigid(world, body, { box_collider({}, { 20, 20 }) });
		Simulator simulator(world);
		for (int n = 0; n < 60; ++n) {
			simulator.simulate(FRAME);
		}
		const RigidBody &now = world.rigid_bodies()[0];
		ends.push_back(now.pose.position);
		CHECK(double(now.linear_velocity.y) == doctest::Approx(880).epsilon(1e-4));
		// Of order 1: off by half a substep of gravity, g h t / 2.
		const double h = double(FRAME) / MIN_CONTACT_SUBSTEPS;
		CHECK(std::abs(double(now.pose.position.y) - (-100 + 980 / 2.0 - 980 * h / 2)) <= 0.1);
		CHECK(double(now.pose.rotation.angle()) == doctest::Approx(0.01).epsilon(0.001));
	}
	CHECK(distance(ends[0], ends[1]) <= 0.1);
}

TEST_CASE("of two that collide, the light one is turned round and the heavy one hardly notices") {
	struct Case {
		Real jelly;
		Real box;
	};
	for (const Case masses : { Case{ 1, 10 }, Case{ 10, 1 }, Case{ 1, 1 }, Case{ Real(0.01), 10 }, Case{ 10, Real(0.01) } }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		world.set_sleeping(false); // however slow the heavy one is
		world.add_soft_body(stiff_jelly({ 0, 0 }, masses.jelly));
		const double u = 300;
		add_box(world, { -100, 0 }, masses.box, { 40, 60 }, { Real(u), 0 });
		Simulator simulator(world);
		for (int n = 0; n < 60; ++n) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
		}
		const double total = double(masses.jelly) + double(masses.box);
		const double common = double(masses.box) * u / total;
		const double of_box = world.rigid_bodies()[0].linear_velocity.x;
		const double of_jelly = measure_frame(world.soft_bodies()[0]).velocity.x;
		CAPTURE(masses.box);
		// Between sticking together and bouncing without loss.
		const double least = (double(masses.box) - double(masses.jelly)) * u / total;
		CHECK(of_box <= common * 1.01 + 0.1);
		CHECK(of_box >= least - 0.01 * u);
		CHECK(of_jelly >= common * 0.99);
		CHECK(of_jelly <= 2 * common + 0.01 * u);
		CHECK(measure_penetration(world, world.soft_bodies()[0]) < 1);
	}
}

TEST_CASE("a crate rests on ten jellies, of a tenth of their mass or ten times: it neither trembles nor sinks") {
	for (const Real mass : { Real(0.1), Real(1), Real(10) }) {
		CAPTURE(mass);
		WorldData world = pixel_world();
		world.add_border(floor_at(0));
		for (int i = 0; i < 10; ++i) {
			world.add_soft_body(stiff_jelly({ Real(102 * i), -50 }));
		}
		const std::uint32_t crate = add_box(world, { 459, -160 }, mass, { 500, 30 });
		Simulator simulator(world);
		Vec2 supported;
		double highest = 1e9;
		double lowest = -1e9;
		double turned = 0;
		for (int n = 0; n < 600; ++n) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			if (n >= 540) {
				supported += world.reactions()[crate].impulse;
				const Pose pose = world.rigid_bodies()[crate].pose;
				highest = std::fmin(highest, double(pose.position.y));
				lowest = std::fmax(lowest, double(pose.position.y));
				turned = std::fmax(turned, std::abs(double(pose.rotation.angle())));
				for (const SoftBodyData &body : world.soft_bodies()) {
					CHECK(measure_penetration(world, body) < 0.5);
				}
			}
		}
		CHECK(lowest - highest < 0.05); // [px], over the last second of ten
		CHECK(turned < 1e-3);
		CHECK(lowest > -131); // it lies on them
		CHECK(lowest < -120);
		CHECK(double(supported.y) == doctest::Approx(-double(mass) * 980).epsilon(0.01)); // they carry all of it
		CHECK(std::abs(double(supported.x)) < 0.01 * double(mass) * 980);
	}
}

TEST_CASE("a jelly meets every kind of free shape, lies on it while it rises, and leaves it when it stops") {
	for (const Kind &kind : all_kinds()) {
		CAPTURE(kind.name);
		WorldData world = pixel_world();
		world.add_soft_body(stiff_jelly({ 0, -60 }));
		RigidBody body; // so heavy that the jelly hardly slows it; a rocket under it takes its weight
		body.inverse_mass = Real(0.001);
		body.linear_velocity = { 0, -200 };
		add_rigid(world, body, kind.parts);
		Simulator simulator(world);
		for (int n = 0; n < 240; ++n) {
			simulator.simulate(FRAME);
		}
		CHECK(double(measure_frame(world.soft_bodies()[0]).velocity.y) == doctest::Approx(-200).epsilon(0.05));
		CHECK(measure_penetration(world, world.soft_bodies()[0]) < 0.5);
		RigidBody lift = world.rigid_bodies()[0];
		lift.linear_velocity = { 0, 0 };
		REQUIRE_FALSE(world.set_rigid_body(0, lift));
		for (int n = 0; n < 10; ++n) {
			simulator.simulate(FRAME);
		}
		double lowest = -1e9;
		for (const Vec2 p : world.soft_bodies()[0].hull()) {
			lowest = std::fmax(lowest, double(p.y));
		}
		CHECK(lowest < double(world.rigid_bodies()[0].pose.position.y) + (kind.parts.size() > 1 ? 20 : -5)); // it lay deeper between circles
		CHECK(world.reactions()[0].impulse == Vec2{});
	}
}

TEST_CASE("a fast free plate, thin as a segment, is stopped by what it hits instead of passing through") {
	for (const bool thin : { false, true }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_soft_body(stiff_jelly({ 0, 0 }, 10));
		RigidBody body = box_body({ -160, 0 }, Real(0.5), { 2, 200 });
		body.linear_velocity = { 60 * JELLY_RADIUS, 0 };
		add_rigid(world, body, { thin ? Collider{ { { 0, -200 }, { 0, 200 } }, 0, {} } : box_collider({}, { 2, 200 }) });
		Simulator simulator(world);
		for (int n = 0; n < 30; ++n) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			for (const Vec2 p : world.soft_bodies()[0].hull()) {
				CHECK(p.x >= world.rigid_bodies()[0].pose.position.x - 1);
			}
		}
		CHECK(double(world.rigid_bodies()[0].linear_velocity.x) < 300);
	}
}

TEST_CASE("a point in a box that is already leaving it is not held back, and one in two parts is moved out once") {
	for (const bool two_parts : { false, true }) {
		WorldData world = particle_world({ 1, Real(-0.45) }, { 0, two_parts ? Real(0.5) : Real(-2) }, 1, 0, 0);
		std::vector<Collider> parts{ box_collider({}, { 3, Real(0.5) }) };
		if (two_parts) {
			parts.push_back(parts[0]);
		}
		add_rigid(world, box_body({}, 1, { 3, Real(0.5) }), parts);
		Simulator(world).simulate(Real(1e-4));
		const Vec2 place = world.soft_bodies()[0].positions()[0];
		CHECK(std::abs(double(place.y) + 0.5) <= 1e-3); // out, but no further; it moves by 2e-4
		if (!two_parts) {
			CHECK(world.soft_bodies()[0].velocities()[0] == Vec2{ 0, -2 });
			CHECK(world.rigid_bodies()[0].linear_velocity == Vec2{});
		}
	}
}

TEST_CASE("friction takes back the way slid: a block does not creep over a box that pushes it") {
	// A particle pressed on a heavy box by gravity along and across its top, below the angle of friction.
	WorldData world = particle_world({ 0, Real(-0.5) }, {}, 1, 1, 0);
	REQUIRE_FALSE(world.set_gravity({ 4, Real(9.81) }));
	RigidBody box;
	box.inverse_mass = Real(1e-6);
	add_rigid(world, box, { box_collider({}, { 3, Real(0.5) }) });
	Simulator simulator(world);
	for (int n = 0; n < 300; ++n) {
		simulator.simulate(FRAME);
	}
	const Vec2 moved = world.soft_bodies()[0].positions()[0] - world.rigid_bodies()[0].pose.position;
	CHECK(std::abs(double(moved.x)) <= 1e-3); // 4 g h² a substep would be 0.08 of it
}

TEST_CASE("a velocity that is no number does not reach the rigid body") {
	WorldData world = particle_world({ 1, Real(-0.45) }, { 0, 1 }, 1, 1, 0);
	add_rigid(world, box_body({}, 1, { 3, Real(0.5) }), { box_collider({}, { 3, Real(0.5) }) });
	ColliderIndex index;
	index.update(world, FRAME);
	RigidContacts contacts;
	contacts.begin_step(world, index);
	contacts.add_body(world.soft_bodies()[0]);
	contacts.begin_substep(FRAME);
	world.soft_bodies()[0].mutable_velocities()[0].y = NOT_A_NUMBER;
	CHECK(contacts.solve({}) == 1);
	CHECK(world.rigid_bodies()[0].linear_velocity == Vec2{});
	CHECK(world.reactions()[0].impulse == Vec2{});
}

TEST_CASE("what a body does not notice, it does not push") {
	WorldData world = pixel_world();
	world.set_gravity({});
	BodySettings settings = jelly_settings();
	settings.collision_mask = 4;
	world.add_soft_body(jelly_circle({ 0, 0 }, settings));
	add_box(world, { -100, 0 }, 1, { 40, 60 }, { 300, 0 });
	Simulator simulator(world);
	for (int n = 0; n < 20; ++n) {
		CHECK(simulator.simulate(FRAME).contacts == 0);
	}
	CHECK(world.rigid_bodies()[0].linear_velocity == Vec2{ 300, 0 });
	CHECK(double(length(measure_frame(world.soft_bodies()[0]).velocity)) <= 1e-3); // roundings of its shape matching
}

TEST_CASE("bodies that have ceased to notice one another do not touch because a rigid body is near") {
	WorldData world = pixel_world();
	world.set_gravity({});
	world.add_soft_body(jelly_circle({ 0, 0 }));
	world.add_soft_body(jelly_circle({ 60, 0 })); // overlapping
	add_box(world, { 30, -80 }, 1, { 100, 20 });
	Simulator simulator(world);
	CHECK(simulator.simulate(FRAME).pair_contacts > 0);
	BodySettings settings = jelly_settings();
	settings.collision_layer = 2;
	settings.collision_mask = 1; // the box's layer
	for (SoftBodyData &body : world.soft_bodies()) {
		REQUIRE_FALSE(body.set_settings(settings));
	}
	CHECK(simulator.simulate(FRAME).pair_contacts == 0);
}

TEST_CASE("a body that goes out of all numbers does not take a rigid body along") {
	WorldData world = pixel_world();
	world.add_soft_body(jelly_circle({ 0, 0 }));
	const std::uint32_t crate = add_box(world, { 0, -60 }, 1, { 40, 20 });
	for (int n = 0; n < 3; ++n) {
		const Real huge = std::numeric_limits<Real>::max();
		world.soft_bodies()[0].add_external_force(4, { huge, -huge });
		world.soft_bodies()[0].add_external_force(5, { -huge, huge });
		Simulator(world).simulate(FRAME);
		CHECK(is_finite(world.rigid_bodies()[crate].pose.position));
		CHECK(is_finite(world.rigid_bodies()[crate].linear_velocity));
		CHECK(std::isfinite(world.rigid_bodies()[crate].angular_velocity));
		CHECK(is_finite(world.reactions()[crate].impulse));
		CHECK(all_finite(world.soft_bodies()[0].positions()));
	}
}

TEST_CASE("rigid bodies that are as fast as numbers go, and faster and faster, keep a place and a velocity") {
	const Real most = std::numeric_limits<Real>::max();
	for (const bool is_dynamic : { false, true }) {
		WorldData world = pixel_world();
		world.add_soft_body(jelly_circle({ 0, 0 }));
		RigidBody crate = box_body({ 0, -60 }, 1, { 40, 20 });
		if (!is_dynamic) {
			crate.inverse_mass = crate.inverse_inertia = 0;
		}
		crate.linear_velocity = { most, -most };
		crate.angular_velocity = most;
		crate.acceleration = { most, -most };
		add_rigid(world, crate, { box_collider({}, { 40, 20 }) });
		Simulator simulator(world);
		for (int n = 0; n < 4; ++n) {
			simulator.simulate(1);
			CHECK(is_finite(world.rigid_bodies()[0].pose.position));
			CHECK(is_finite(world.rigid_bodies()[0].linear_velocity));
			CHECK(std::isfinite(world.rigid_bodies()[0].angular_velocity));
			CHECK(all_finite(world.soft_bodies()[0].positions()));
		}
	}
}

TEST_CASE("a pinned body is a support that a crate bounces off or rests on") {
	WorldData world = pixel_world();
	SoftBodyData anvil = jelly_circle({ 0, 0 });
	for (std::uint32_t i = 0; i < anvil.point_count(); ++i) {
		anvil.set_pinned(i, true);
	}
	const auto start = copy_of(anvil.positions());
	world.add_soft_body(std::move(anvil));
	RigidBody crate = box_body({ 0, -120 }, 5, { 60, 20 });
	crate.inverse_inertia = 0;
	crate.acceleration = { 0, PIXEL_GRAVITY };
	add_rigid(world, crate, { box_collider({}, { 60, 20 }) });
	Simulator simulator(world);
	for (int n = 0; n < 120; ++n) {
		simulator.simulate(FRAME);
	}
	CHECK(identical(world.soft_bodies()[0].positions(), start));
	const double y = world.rigid_bodies()[0].pose.position.y;
	CHECK(y > -71); // its lower side on the highest point
	CHECK(y < -60); // an impact at 440 px/s is found within 1.8 px, and nothing moves it out again
	CHECK(std::abs(double(world.rigid_bodies()[0].linear_velocity.y)) < 5);
}

TEST_CASE("any number of threads gives the same bits with rigid bodies pushed by many" *
		doctest::test_suite("threads")) {
	const auto run = [](ParallelFor parallel_for) {
		Random random(343);
		WorldData world = pixel_world();
		world.add_border(floor_at(100));
		for (int i = 0; i < 80; ++i) {
			BodySettings settings = jelly_settings();
			settings.collision_layer = i % 2 == 0 ? 1 : 2; // half of them pass each other
			settings.collision_mask = i % 2 == 0 ? 1 : 1;
			world.add_soft_body(jelly_circle(Vec2{ Real(60 * i), Real(0) } + random.vector(10), settings));
		}
		for (int i = 0; i < 12; ++i) {
			add_box(world, { Real(400 * i), -120 }, random.real(0.3, 10), { 190, 20 });
		}
		Simulator simulator(world, parallel_for);
		std::uint64_t contacts = 0;
		for (int n = 0; n < 60; ++n) {
			contacts += simulator.simulate(FRAME).contacts;
		}
		CHECK(contacts > 5000);
		return world;
	};
	const WorldData reference = run({});
	for (const std::size_t threads : { 1, 2, 3, 8 }) {
		const WorldData world = run(on_threads(threads));
		for (std::size_t i = 0; i < world.soft_bodies().size(); ++i) {
			CHECK(identical(world.soft_bodies()[i].positions(), reference.soft_bodies()[i].positions()));
			CHECK(identical(world.soft_bodies()[i].velocities(), reference.soft_bodies()[i].velocities()));
		}
		for (std::size_t i = 0; i < world.rigid_bodies().size(); ++i) {
			CHECK(world.rigid_bodies()[i].pose.position == reference.rigid_bodies()[i].pose.position);
			CHECK(world.rigid_bodies()[i].angular_velocity == reference.rigid_bodies()[i].angular_velocity);
			CHECK(world.reactions()[i].impulse == reference.reactions()[i].impulse);
		}
	}
}

TEST_CASE("what holds a rigid body takes its share of a push, and of none that lifts it") {
	for (const Real share : { Real(0), Real(0.25), Real(0.5), Real(1) }) {
		for (const bool is_from_above : { true, false }) {
			CAPTURE(share);
			CAPTURE(is_from_above);
			const Real speed = is_from_above ? Real(10) : Real(-10);
			WorldData world = particle_world({ 0, is_from_above ? Real(-0.99) : Real(0.99) }, { 0, speed }, 1, 0, 0);
			RigidBody box = box_body({ 0, 0 }, 2, { 1, 1 });
			box.support = { 0, -share };
			const std::uint32_t index = add_rigid(world, box, { box_collider({}, { 1, 1 }) });
			Simulator(world).simulate(Real(0.001));
			// Inelastic, against a mass of 2 / (1 - share); the particle weighs a quarter.
			const double mass = world.soft_bodies()[0].shape().masses()[0];
			const double held = is_from_above ? double(share) : 0;
			const double impulse = double(speed) / (1 / mass + (1 - held) / 2);
			CHECK(double(world.reactions()[index].impulse.y) == doctest::Approx(impulse).epsilon(1e-4));
			CHECK(double(world.rigid_bodies()[index].linear_velocity.y) == doctest::Approx(impulse * (1 - held) / 2).epsilon(1e-4));
			CHECK(double(world.soft_bodies()[0].velocities()[0].y) == doctest::Approx(double(speed) - impulse / mass).epsilon(1e-4).scale(10));
		}
	}
}

TEST_CASE("a support takes no push across it, and can keep a body from turning") {
	for (const Real turn_support : { Real(0), Real(1) }) {
		WorldData world = particle_world({ Real(-0.99), Real(-0.5) }, { 10, 0 }, 1, 0, 0);
		RigidBody box = box_body({ 0, 0 }, 2, { 1, 1 });
		box.support = { Real(-0.6), Real(-0.8) }; // leans against the push with 0.6 of its direction
		box.turn_support = turn_support;
		const std::uint32_t index = add_rigid(world, box, { box_collider({}, { 1, 1 }) });
		Simulator(world).simulate(Real(0.001));
		const double mass = world.soft_bodies()[0].shape().masses()[0];
		const double inertia = 1 / double(box.inverse_inertia);
		const double lever = 0.5;
		const double impulse = 10 / (1 / mass + (1 - 0.36) / 2 + (1 - double(turn_support)) * lever * lever / inertia);
		CHECK(double(world.reactions()[index].impulse.x) == doctest::Approx(impulse).epsilon(1e-3));
		CHECK((world.rigid_bodies()[index].angular_velocity == 0) == (turn_support == 1));
		// Along the support it has got nothing.
		const Vec2 velocity = world.rigid_bodies()[index].linear_velocity;
		CHECK(std::abs(double(dot(velocity, box.support))) < 1e-4);
	}
}
