// SPDX-License-Identifier: MIT
// Bodies that collide with themselves: a hull does not pass through itself, from outside or from inside.
#include "core/collision/self_collision.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "scenes/chain.h"
#include "scenes/deformations.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "scenes/ribbon.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/threads.h"
#include "thesis/damping_ratio.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

BodySettings settings_with(bool self_collision, double shape_stiffness = 0) {
	BodySettings settings;
	settings.self_collision = self_collision;
	settings.shape_stiffness = Real(shape_stiffness);
	return settings;
}

SoftBodyData ribbon_body(const Ribbon &ribbon, const BodySettings &settings, const Pose &pose = {}) {
	return SoftBodyData::create(ribbon_shape(ribbon), settings, pose).value();
}

Vec2 unit(Vec2 a) {
	return a * (1 / length(a));
}

// In how many of its frames the hull is folded, by the check of all edges against all.
struct Outcome {
	int folded = 0;
	std::uint64_t contacts = 0;
	std::uint64_t resets = 0;
};

template <class BeforeFrame>
Outcome run(WorldData &world, int frames, const BeforeFrame &before_frame, const ParallelFor &parallel_for = {}) {
	world.set_sleeping(false);
	Simulator simulator(world, parallel_for);
	Outcome outcome;
	for (int i = 0; i < frames; ++i) {
		before_frame(i);
		const StepReport report = simulator.simulate(FRAME);
		outcome.contacts += report.self_contacts;
		outcome.resets += report.reset_bodies.size();
		for (const SoftBodyData &body : world.soft_bodies()) {
			outcome.folded += is_folded(body.hull());
		}
	}
	return outcome;
}

// Both ends are pulled round and round, each towards its left.
void curl(SoftBodyData &snake, Real force) {
	const std::uint32_t count = std::uint32_t(snake.shape().hull_count());
	const std::uint32_t head = count / 2 - 1;
	const std::span<const Vec2> p = snake.positions();
	snake.add_external_force(head, perpendicular(unit(p[head] - p[head - 2])) * force);
	snake.add_external_force(0, perpendicular(unit(p[2] - p[0])) * force);
}

WorldData world_with_snake(bool self_collision) {
	WorldData world;
	world.add_soft_body(ribbon_body({ 6, 0.15, 40 }, settings_with(self_collision)));
	return world;
}

// Two plates that close on a thin bar and open again.
Outcome press_between_plates(bool self_collision, SoftBodyData &pressed) {
	WorldData world;
	world.add_soft_body(ribbon_body({ 2, 0.2, 10, 0, 1, 200 }, settings_with(self_collision)));
	for (const Real side : { Real(1), Real(-1) }) {
		RigidBody plate;
		plate.pose = { { 0, side }, {} };
		const std::uint32_t index = world.add_rigid_body(plate).value();
		Collider collider = box_collider({}, { 2, Real(0.5) });
		collider.rigid_body = index;
		world.add_collider(collider);
	}
	const Outcome outcome = run(world, 300, [&](int frame) {
		for (std::uint32_t i = 0; i < 2; ++i) {
			const Real side = i == 0 ? Real(1) : Real(-1);
			RigidBody plate = world.rigid_bodies()[i];
			plate.linear_velocity = { 0, frame < 33 ? -side : frame < 60 ? Real(0) : side * Real(0.5) };
			world.set_rigid_body(i, plate);
		}
	});
	pressed = world.soft_bodies()[0];
	return outcome;
}

} // namespace

TEST_CASE("a snake that curls up for ten seconds stops at itself, and passes through itself if it may") {
	for (const bool self_collision : { false, true }) {
		WorldData world = world_with_snake(self_collision);
		const Outcome outcome = run(world, 600, [&](int) { curl(world.soft_bodies()[0], 2); });
		CHECK(outcome.resets == 0);
		CHECK((outcome.folded > 0) == !self_collision);
		CHECK((outcome.contacts > 0) == self_collision);
	}
}

TEST_CASE("a C that is squeezed shut keeps its arms apart, and opens again") {
	for (const bool self_collision : { false, true }) {
		WorldData world;
		const Ribbon ribbon{ 4, 0.3, 24, 4.5, 1, 500, 0.5 };
		BodySettings settings = settings_with(self_collision, 3);
		settings.shape_damping = Real(0.1);
		world.add_soft_body(ribbon_body(ribbon, settings));
		SoftBodyData &body = world.soft_bodies()[0];
		const std::uint32_t head = std::uint32_t(ribbon.cells);
		const Outcome outcome = run(world, 600, [&](int frame) {
			if (frame < 120) {
				const Vec2 shut = unit(body.positions()[head] - body.positions()[0]) * Real(10);
				body.add_external_force(0, shut);
				body.add_external_force(head, -shut);
			}
		});
		CHECK((outcome.folded > 0) == !self_collision);
		CHECK((outcome.contacts > 0) == self_collision);
		if (self_collision) {
			CHECK(deviation_from_rest(body) < 0.1 * double(body.shape().radius()));
		}
	}
}

TEST_CASE("a thin bar between plates that close does not fold through itself, and finds its shape when they open") {
	SoftBodyData body = ribbon_body({}, {});
	const Outcome without = press_between_plates(false, body);
	CHECK(without.folded > 0);
	const Outcome with = press_between_plates(true, body);
	CHECK(with.folded == 0);
	CHECK(with.resets == 0);
	CHECK(with.contacts > 0);
	CHECK(deviation_from_rest(body) < 0.05);
}

TEST_CASE("a thin bar under a heavy body does not fold through itself") {
	for (const bool self_collision : { false, true }) {
		for (const double mass : { 10.0, 100.0 }) {
			WorldData world;
			world.set_gravity({ 0, Real(-9.81) });
			world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
			world.add_soft_body(ribbon_body({ 2, 0.2, 10, 0, 1, 200 }, settings_with(self_collision), { { 0, Real(0.1) }, {} }));
			const auto heavy = thesis_shape_with_ratio(Real(2000 * mass), Real(0.3))->resized(1, Real(mass)).value();
			world.add_soft_body(thesis_body(heavy, settings_with(false, 800 * mass), { { 0, 1 }, {} }));
			const Outcome outcome = run(world, 180, [](int) {});
			CHECK((outcome.folded > 0) == !self_collision);
			CHECK(outcome.resets == 0);
		}
	}
}

TEST_CASE("a contact of a body with itself keeps momentum and angular momentum to rounding, also where a point is light") {
	Random random(7);
	int answered = 0;
	for (int i = 0; i < 200; ++i) {
		SoftBodyData body = ribbon_body({ 4, 0.3, 12, 5.5 }, settings_with(true));
		for (std::uint32_t p = 0; p < body.point_count(); ++p) {
			body.set_point(p, body.positions()[p], random.vector(3) + Vec2{ 5, -2 });
		}
		const std::vector<Vec2> before = copy_of(body.hull());
		const Real h = Real(0.02) + random.real(0, 0.1);
		for (std::uint32_t p = 0; p < body.point_count(); ++p) {
			body.set_point(p, body.positions()[p] + body.velocities()[p] * h, body.velocities()[p]);
		}
		const bool was_folded = is_folded(body.hull());
		const Momentum a = measure_momentum(body);
		const Vec2 center = measure_frame(body).center;
		const double kinetic = measure_energy(body, {}).kinetic;
		SelfCollision collision;
		const std::size_t contacts = collision.handle(body, before, h);
		answered += contacts > 0;
		CHECK((contacts > 0 || !was_folded));
		CHECK(!is_folded(body.hull()));
		const Momentum b = measure_momentum(body);
		// One kilogram at about 5 m/s and 2 m: some hundred roundings.
		CHECK(std::abs(a.linear_x - b.linear_x) <= 200 * EPSILON);
		CHECK(std::abs(a.linear_y - b.linear_y) <= 200 * EPSILON);
		CHECK(std::abs(a.angular - b.angular) <= 500 * EPSILON);
		// What is moved apart goes by its weights, so that the center stays.
		CHECK(double(length(measure_frame(body).center - center)) <= 20 * EPSILON);
		CHECK(measure_energy(body, {}).kinetic <= kinetic * 1.001); // turning back what pushing sideways has turned
	}
	CHECK(answered > 50);
}

TEST_CASE("friction holds a point that slides along its own hull, as far as Coulomb's law goes") {
	// A square of loose points: point 0 goes through the edge from 1 to 2, sliding along it.
	for (const Real friction : { Real(0), Real(0.25), Real(10) }) {
		BodySettings settings = settings_with(true);
		settings.friction = friction;
		SoftBodyData body = loose_points(6, 1, {}, settings);
		const std::array<Vec2, 6> hull = { { { -3, 0 }, { 3, 0 }, { 3, 3 }, { 0, Real(0.05) }, { -3, 3 }, { -4, 1 } } };
		for (std::uint32_t i = 0; i < 6; ++i) {
			body.set_point(i, hull[i], {});
		}
		const std::vector<Vec2> before = copy_of(body.hull());
		body.set_point(3, { Real(0.1), Real(-0.95) }, { Real(0.1), -1 });
		SelfCollision collision;
		CHECK(collision.handle(body, before, 1) > 0);
		CHECK(!is_folded(body.hull()));
		const Vec2 relative = body.velocities()[3] - (body.velocities()[0] + body.velocities()[1]) * Real(0.5);
		CHECK(std::abs(double(relative.y)) < 0.3); // the approach of 1 is gone, but for what turning the edge gives back
		if (friction == 0) {
			CHECK(double(relative.x) == doctest::Approx(0.1).epsilon(0.2));
		}
		if (friction == 10) {
			CHECK(std::abs(double(relative.x)) < 0.02);
		}
	}
}

TEST_CASE("a body that starts crossed, mirrored or crumpled unfolds as if it did not collide with itself") {
	int folded_at_start = 0;
	for (int seed = 0; seed < 40; ++seed) {
		WorldData world;
		const auto shape = thesis_shape_with_ratio(450, DEFAULT_DAMPING_RATIO);
		world.add_soft_body(thesis_body(shape, settings_with(true, 180)));
		Random random{ std::uint64_t(1000 + seed) };
		deform(world.soft_bodies()[0], Deformation(seed % DEFORMATION_COUNT), random);
		folded_at_start += is_folded(world.soft_bodies()[0].hull());
		run(world, 600, [](int) {});
		CHECK(deviation_from_rest(world.soft_bodies()[0]) < 0.02 * double(THESIS_RADIUS));
	}
	CHECK(folded_at_start >= 20);
}

TEST_CASE("arms that a script has put through each other come apart, and then stop at each other") {
	WorldData world;
	const Ribbon ribbon{ 4, 0.3, 24, 4.5, 1, 500, 0.2 };
	BodySettings settings = settings_with(true, 3);
	settings.shape_damping = Real(0.1);
	world.add_soft_body(ribbon_body(ribbon, settings));
	SoftBodyData &body = world.soft_bodies()[0];
	// Bent on about the middle, until the arms lie across each other.
	Ribbon closed = ribbon;
	closed.bend = 7.5;
	const std::vector<Vec2> crossed = ribbon_points(closed);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, crossed[i], {});
	}
	REQUIRE(is_folded(body.hull()));
	run(world, 600, [](int) {});
	CHECK(!is_folded(body.hull()));
	CHECK(deviation_from_rest(body) < 0.05);
	const Outcome outcome = run(world, 120, [&](int) {
		const Vec2 shut = unit(body.positions()[24] - body.positions()[0]) * Real(10);
		body.add_external_force(0, shut);
		body.add_external_force(24, -shut);
	});
	CHECK(outcome.folded == 0);
	CHECK(outcome.contacts > 0);
}

namespace {

// One arm of a C of 24 cells flies at the other.
void shut_fast(SoftBodyData &body) {
	const Vec2 shut = unit(body.positions()[24] - body.positions()[0]) * (20 * body.shape().radius());
	for (std::uint32_t i = 0; i < 50; ++i) {
		const std::uint32_t cell = i < 25 ? i : 49 - i;
		if (cell < 9) {
			body.set_point(i, body.positions()[i], shut);
		}
	}
}

} // namespace

TEST_CASE("an arm at 20 radii a second does not pass through the other") {
	for (const bool self_collision : { false, true }) {
		WorldData world;
		const Ribbon ribbon{ 4, 0.1, 24, 4.5, 1, 500 };
		world.add_soft_body(ribbon_body(ribbon, settings_with(self_collision)));
		SoftBodyData &body = world.soft_bodies()[0];
		shut_fast(body);
		const Outcome outcome = run(world, 60, [](int) {});
		CHECK((outcome.folded > 0) == !self_collision);
		CHECK(outcome.resets == 0);
	}
}

TEST_CASE("nor does an arm pass through the other where another body is near, which is stepped together with it") {
	for (const bool self_collision : { false, true }) {
		WorldData world;
		const Ribbon ribbon{ 4, 0.1, 24, 4.5, 1, 500 };
		world.add_soft_body(ribbon_body(ribbon, settings_with(self_collision)));
		// Joined to what swings far away.
		world.add_soft_body(ribbon_body(ribbon, settings_with(false), { { 20, 0 }, {} }));
		Joint joint;
		joint.first = JointAnchor::on_point(world.id_at(0), 12);
		joint.second = JointAnchor::on_point(world.id_at(1), 12);
		joint.rest_length = 20;
		joint.stiffness = Real(1e-3);
		REQUIRE(world.add_joint(joint).has_value());
		SoftBodyData &body = world.soft_bodies()[0];
		shut_fast(body);
		int folded = 0;
		world.set_sleeping(false);
		Simulator simulator(world);
		for (int tick = 0; tick < 60; ++tick) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			folded += is_folded(world.soft_bodies()[0].hull());
		}
		CHECK((folded > 0) == !self_collision);
	}
}

TEST_CASE("two tips that come near each other are parted, whichever points they are, and nothing else moves") {
	// A C whose arms end in tips towards each other.
	const std::vector<Vec2> outline{ { -1, -1 }, { Real(1.2), -1 }, { Real(1.2), Real(-0.6) }, { 1, Real(-0.01) }, { Real(0.8), Real(-0.6) },
		{ Real(-0.5), Real(-0.6) }, { Real(-0.5), Real(0.6) }, { Real(0.8), Real(0.6) }, { 1, Real(0.01) }, { Real(1.2), Real(0.6) },
		{ Real(1.2), 1 }, { -1, 1 } };
	const std::uint32_t count = std::uint32_t(outline.size());
	for (std::uint32_t first = 0; first < count; ++first) {
		CAPTURE(first);
		std::vector<Vec2> hull = outline;
		std::rotate(hull.begin(), hull.begin() + first, hull.end());
		const std::uint32_t lower = (3 + count - first) % count;
		const std::uint32_t upper = (8 + count - first) % count;
		SoftBodyData body = SoftBodyData::create(SoftBodyCreator::create_polygon(hull, {}).value(), settings_with(true)).value();
		const std::vector<Vec2> before = copy_of(body.hull());
		const Real tip = Real(1e-6); // nearer than any gap that is kept
		const Vec2 middle = (before[lower] + before[upper]) * Real(0.5);
		body.set_point(lower, middle - Vec2{ 0, tip }, {});
		body.set_point(upper, middle + Vec2{ 0, tip }, {});
		const std::vector<Vec2> near = copy_of(body.hull());
		SelfCollision collision;
		CHECK(collision.handle(body, before, Real(0.01)) > 0);
		for (std::uint32_t i = 0; i < count; ++i) {
			const double moved = distance(body.hull()[i], near[i]);
			CAPTURE(moved);
			CHECK((i == lower || i == upper ? moved > 1e-4 : moved < 10 * EPSILON));
		}
	}
}

TEST_CASE("a hull so tangled that it is held as one piece keeps every distance while it moves and turns") {
	Random random(11);
	int whole = 0;
	for (int trial = 0; trial < 40; ++trial) {
		SoftBodyData body = ribbon_body({ 4, 0.2, 12 }, settings_with(true));
		const std::vector<Vec2> before = copy_of(body.hull());
		const Rotation rotation = Rotation::from_angle(random.real(-1.5, 1.5));
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, rotation.apply(body.positions()[i] * random.real(-3, 3)), {});
		}
		SelfCollision collision;
		REQUIRE(collision.handle(body, before, Real(0.01)) > 0);
		double change = 0; // of the distance of any two points
		for (std::size_t i = 0; i < before.size(); ++i) {
			for (std::size_t k = 0; k < i; ++k) {
				change = std::max(change, std::abs(distance(body.hull()[i], body.hull()[k]) - distance(before[i], before[k])));
			}
		}
		whole += change < 100 * EPSILON;
	}
	CHECK(whole > 5); // in the others some points are no part of it
}

TEST_CASE("what touches itself gains no energy") {
	for (const Real friction : { Real(0), Real(0.4) }) {
		WorldData world;
		BodySettings settings = settings_with(true);
		settings.friction = friction;
		world.add_soft_body(ribbon_body({ 4, 0.2, 24, 4.5, 1, 500, 0.02 }, settings));
		SoftBodyData &body = world.soft_bodies()[0];
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			const std::uint32_t cell = i < 25 ? i : 49 - i;
			const Vec2 shut = unit(body.positions()[24] - body.positions()[0]) * Real(8);
			body.set_point(i, body.positions()[i], cell < 8 ? shut : cell > 16 ? -shut : Vec2{});
		}
		const double start = measure_energy(body, {}).total();
		double most = 0;
		const Outcome outcome = run(world, 300, [&](int) { most = std::max(most, measure_energy(body, {}).total()); });
		CHECK(outcome.contacts > 0);
		CHECK(most <= start * 1.01);
	}
}

TEST_CASE("500 random stars with random velocities never cross themselves, and stay finite") {
	int folded_without = 0;
	for (int seed = 0; seed < 500; ++seed) {
		for (const bool self_collision : { true, false }) {
			if (!self_collision && seed >= 50) {
				continue;
			}
			Random random{ std::uint64_t(100 + seed) };
			const int count = random.integer(4, 40);
			std::vector<Vec2> hull;
			for (int i = 0; i < count; ++i) {
				hull.push_back(Rotation::from_angle(Real(6.2831853 * i / count)).apply({ random.real(0.15, 1), 0 }));
			}
			const auto shape = SoftBodyCreator::create_polygon(hull, { 1, 100, Real(0.5), true }).value();
			WorldData world;
			world.add_soft_body(SoftBodyData::create(shape, settings_with(self_collision, random.chance(0.5) ? 40 : 0)).value());
			SoftBodyData &body = world.soft_bodies()[0];
			const double speed = double(random.real(1, 20));
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				body.set_point(i, body.positions()[i], random.vector(speed));
			}
			const double energy = measure_energy(body, {}).total();
			const Outcome outcome = run(world, 30, [](int) {});
			if (!self_collision) {
				folded_without += outcome.folded > 0;
				continue;
			}
			CHECK(outcome.folded == 0);
			CHECK(outcome.resets == 0);
			CHECK(all_finite(body.positions()));
			CHECK(measure_energy(body, {}).total() <= energy);
		}
	}
	CHECK(folded_without >= 20);
}

TEST_CASE("bodies that collide with themselves give the same bits for any number of threads" *
		doctest::test_suite("threads")) {
	std::vector<Vec2> first;
	for (const std::size_t threads : { 1, 2, 8 }) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
		for (int i = 0; i < 60; ++i) {
			const Ribbon ribbon{ 4, 0.2, 16, i % 3 == 0 ? 5.0 : 0.5 * (i % 3), 1, 60 };
			// Some stand alone, some fall on one another.
			world.add_soft_body(ribbon_body(ribbon, settings_with(true), { { Real(3 * (i % 20)), Real(2 + i / 20) }, {} }));
		}
		const Outcome outcome = run(world, 60, [](int) {}, threads == 1 ? ParallelFor{} : on_threads(threads));
		CHECK(outcome.contacts > 0);
		std::vector<Vec2> all;
		for (const SoftBodyData &body : world.soft_bodies()) {
			all.insert(all.end(), body.positions().begin(), body.positions().end());
			all.insert(all.end(), body.velocities().begin(), body.velocities().end());
		}
		if (first.empty()) {
			first = all;
		}
		CHECK(identical(first, all));
	}
}

TEST_CASE("where nothing comes near itself, self-collision changes no bit of how a body moves") {
	std::array<std::vector<Vec2>, 2> positions;
	for (const bool self_collision : { false, true }) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
		for (int i = 0; i < 8; ++i) {
			world.add_soft_body(thesis_body(thesis_shape_with_ratio(450, DEFAULT_DAMPING_RATIO),
					settings_with(self_collision, 180), { { Real(2 * i), Real(0.6 + 0.1 * i) }, {} }));
		}
		CHECK(run(world, 120, [](int) {}).contacts == 0);
		for (const SoftBodyData &body : world.soft_bodies()) {
			positions[self_collision].insert(positions[self_collision].end(), body.positions().begin(), body.positions().end());
		}
	}
	CHECK(identical(positions[0], positions[1]));
}

TEST_CASE("a snake that curls up in a box of thin walls stays in it, however hard it presses itself against them") {
	for (const double stiffness : { 300.0, 2000.0 }) {
		WorldData world;
		world.set_gravity({ 0, -30 });
		const std::array<Vec2, 4> box = { { { Real(-3.2), Real(-0.5) }, { Real(3.2), Real(-0.5) }, { Real(3.2), Real(0.5) },
				{ Real(-3.2), Real(0.5) } } };
		add_chain(world, box, true);
		world.add_soft_body(ribbon_body({ 6, 0.15, 40, 0, 1, stiffness }, settings_with(true)));
		SoftBodyData &body = world.soft_bodies()[0];
		const Outcome outcome = run(world, 600, [&](int) { curl(body, 30); });
		CHECK(outcome.folded == 0);
		CHECK(outcome.contacts > 0);
		for (const Vec2 p : body.hull()) {
			// What the hull pushes itself by is undone by the wall in the next substep.
			CHECK(std::abs(double(p.x)) < 3.2 + 0.06);
			CHECK(std::abs(double(p.y)) < 0.5 + 0.06);
		}
		// Where a script puts it, it is: the way there is no way.
		body.teleport({}, { { 100, 0 }, {} });
		run(world, 1, [](int) {});
		for (const Vec2 p : body.hull()) {
			CHECK(p.x > 90);
		}
	}
}

TEST_CASE("pinned points are not moved by what touches them") {
	WorldData world = world_with_snake(true);
	SoftBodyData &body = world.soft_bodies()[0];
	body.set_pinned(20, true);
	body.set_pinned(61, true);
	const Vec2 there = body.positions()[20];
	const Outcome outcome = run(world, 600, [&](int) { curl(body, 2); });
	CHECK(outcome.folded == 0);
	CHECK(outcome.contacts > 0);
	CHECK(body.positions()[20] == there);
}

TEST_CASE("pins that a script puts through each other's edge go back to where they were, wherever that is") {
	for (const Vec2 place : { Vec2{ 0, 0 }, Vec2{ 40, -25 } }) {
		SoftBodyData body = loose_points(6, 1, {}, settings_with(true));
		const std::array<Vec2, 6> hull = { { { -3, 0 }, { 3, 0 }, { 3, 3 }, { 0, Real(0.5) }, { -3, 3 }, { -4, 1 } } };
		for (std::uint32_t i = 0; i < 6; ++i) {
			REQUIRE_FALSE(body.set_point(i, hull[i] + place, {}));
		}
		const std::vector<Vec2> before = copy_of(body.hull());
		// Point 3 through the edge from 0 to 1; the others drift, so that the middle of the hull does.
		REQUIRE_FALSE(body.set_point(3, place + Vec2{ 0, -1 }, { 0, -1 }));
		for (const std::uint32_t i : { 2, 4, 5 }) {
			REQUIRE_FALSE(body.set_point(i, body.hull()[i] + Vec2{ Real(0.2), Real(0.1) }, { 1, 1 }));
		}
		for (const std::uint32_t i : { 0, 1, 3 }) {
			REQUIRE_FALSE(body.set_pinned(i, true));
		}
		REQUIRE(is_folded(body.hull()));
		SelfCollision collision;
		CHECK(collision.handle(body, before, 1) > 0);
		CHECK(!is_folded(body.hull()));
		for (const std::uint32_t i : { 0, 1, 3 }) {
			CHECK(double(length(body.hull()[i] - before[i])) <= 50 * 4 * EPSILON); // coordinates up to 50, some roundings
			CHECK(body.velocities()[i] == Vec2{});
		}
	}
}

TEST_CASE("a body far from the world's origin does not cross itself by rounding") {
	WorldData world;
	world.add_soft_body(ribbon_body({ 600, 15, 40 }, settings_with(true), { { 100000, -50000 }, {} }));
	const Outcome outcome = run(world, 600, [&](int) { curl(world.soft_bodies()[0], 200); });
	CHECK(outcome.folded == 0);
	CHECK(outcome.contacts > 0);
}
