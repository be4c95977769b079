// SPDX-License-Identifier: MIT
// Claims about a whole step: free fall, external forces, refused steps, failed bodies, reports.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/deformations.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "scenes/mixed.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <array>

using namespace softbody;
using namespace softbody::testing;

namespace {

BodySettings fixed_substeps(int substeps) {
	BodySettings settings;
	settings.substeps = substeps;
	settings.integrator = Integrator::SEMI_IMPLICIT_EULER; // whose discrete sums these claims write down
	return settings;
}

} // namespace

TEST_CASE("a falling body is where the discrete sum g h² n (n + 1) / 2 puts it, and within g t h / 2 of g t² / 2") {
	for (const int substeps : { 1, 5 }) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		const BodyId id = world.add_soft_body(thesis_body(thesis_shape(), fixed_substeps(substeps)));
		const auto start = copy_of(world.find(id)->positions());
		Simulator simulator(world);
		const int frames = 60;
		const double dt = 0.01;
		for (int n = 0; n < frames; ++n) {
			simulator.simulate(Real(dt));
		}
		const double steps = frames * substeps;
		const double h = dt / substeps;
		const double exact = -9.81 * h * h * steps * (steps + 1) / 2;
		const double t = dt * frames;
		// Each step rounds a velocity up to 6 m/s and a position up to 2 m, and h itself is rounded.
		const double tolerance = steps * EPSILON * 6 * h + steps * EPSILON * 2;
		for (std::size_t i = 0; i < start.size(); ++i) {
			const Vec2 moved = world.find(id)->positions()[i] - start[i];
			CHECK(std::abs(double(moved.x)) <= tolerance);
			CHECK(std::abs(double(moved.y) - exact) <= tolerance);
			CHECK(std::abs(double(moved.y) + 9.81 * t * t / 2) <= 9.81 * t * h / 2 + tolerance);
			CHECK(std::abs(double(world.find(id)->velocities()[i].y) + 9.81 * t) <= steps * EPSILON * 6);
		}
	}
}

TEST_CASE("external forces act during one step, every substep of it, and are then forgotten") {
	for (const int substeps : { 1, 4 }) {
		WorldData world;
		const BodyId id = world.add_soft_body(loose_points(4, 2, {}, fixed_substeps(substeps)));
		SoftBodyData &body = *world.find(id);
		const auto start = copy_of(body.positions());
		body.add_external_force(1, { 10, 0 });
		body.add_external_force(1, { 0, 20 });
		body.add_external_force(1, { -4, 0 });
		Simulator simulator(world);
		const double dt = 0.25;
		simulator.simulate(Real(dt));
		CHECK(body.external_forces().empty());
		// F/m = (3, 10): v = F t / m, and the discrete sum of the way; all of these are exact in binary.
		CHECK(body.velocities()[1] == Vec2{ Real(0.75), Real(2.5) });
		const double h = dt / substeps;
		const double way = h * h * substeps * (substeps + 1) / 2;
		CHECK(distance(body.positions()[1], start[1] + Vec2{ Real(3 * way), Real(10 * way) }) <= 4 * EPSILON);
		const Vec2 there = body.positions()[1];
		simulator.simulate(Real(dt));
		CHECK(body.velocities()[1] == Vec2{ Real(0.75), Real(2.5) });
		CHECK(distance(body.positions()[1], there + body.velocities()[1] * Real(dt)) <= 4 * substeps * EPSILON);
		for (const std::size_t i : { 0u, 2u, 3u }) {
			CHECK(body.positions()[i] == start[i]);
		}
	}
}

TEST_CASE("forces queued for one body do not reach the next") {
	WorldData world;
	const BodyId first = world.add_soft_body(loose_points(4, 1));
	const BodyId second = world.add_soft_body(loose_points(4, 1));
	world.find(first)->add_external_force(2, { 100, 100 });
	Simulator(world).simulate(Real(0.01));
	CHECK(world.find(first)->velocities()[2].x > 0);
	for (const Vec2 v : world.find(second)->velocities()) {
		CHECK(v == Vec2{});
	}
}

TEST_CASE("a step of zero, negative or unknown length is refused and nothing moves") {
	WorldData world = pixel_world();
	const BodyId id = world.add_soft_body(jelly_circle({ 0, 0 }));
	SoftBodyData &body = *world.find(id);
	body.set_point(0, { 70, 0 }, { 3, 4 });
	body.add_external_force(1, { 1, 1 });
	const auto positions = copy_of(body.positions());
	const auto velocities = copy_of(body.velocities());
	const auto previous = copy_of(body.previous_positions());
	Simulator simulator(world);
	for (const Real dt : { Real(0), Real(-0.01), NOT_A_NUMBER, INFINITE, -INFINITE }) {
		const StepReport report = simulator.simulate(dt);
		REQUIRE(report.refused.has_value());
		CHECK(report.refused->name == "dt");
		CHECK(report.substeps == 0);
		CHECK(identical(body.positions(), positions));
		CHECK(identical(body.velocities(), velocities));
		CHECK(identical(body.previous_positions(), previous));
		CHECK(body.external_forces().size() == 1);
	}
	CHECK_FALSE(simulator.simulate(Real(0.01)).refused);
	CHECK_FALSE(identical(body.positions(), positions));
}

TEST_CASE("a body that loses its numbers gets its rest shape back where it was, and is reported; the others never notice") {
	for (const int way : { 0, 1, 2 }) {
		CAPTURE(way);
		WorldData sick = pixel_world();
		WorldData sound = pixel_world();
		std::array<BodyId, 3> ids;
		for (WorldData *world : { &sick, &sound }) {
			world->add_border(floor_at(100));
			for (int i = 0; i < 3; ++i) {
				ids[std::size_t(i)] = world->add_soft_body(jelly_circle({ Real(200 * i), 0 }));
			}
		}
		Simulator sick_simulator(sick);
		Simulator sound_simulator(sound);
		for (int n = 0; n < 40; ++n) {
			BodyFrame before;
			if (n == 20) {
				SoftBodyData &bad = *sick.find(ids[1]);
				before = measure_frame(bad);
				if (way == 0) {
					bad.mutable_velocities()[3].x = NOT_A_NUMBER;
				} else if (way == 1) { // finite, but not once divided by the mass of a point
					REQUIRE_FALSE(bad.apply_impulse(3, { std::numeric_limits<Real>::max() / 2, 0 }));
				} else { // finite, but not once squared
					REQUIRE_FALSE(bad.add_external_force(3, { 0, -std::numeric_limits<Real>::max() / 4 }));
				}
			}
			const StepReport report = sick_simulator.simulate(FRAME);
			sound_simulator.simulate(FRAME);
			if (n == 20) {
				REQUIRE(report.reset_bodies.size() == 1);
				CHECK(report.reset_bodies[0] == ids[1]);
				const SoftBodyData &bad = *sick.find(ids[1]);
				CHECK(distance(measure_frame(bad).center, before.center) <= 64 * EPSILON * 200); // at x = 200
				CHECK(deviation_from_rest(bad) <= 64 * EPSILON * 200);
				// What was changed before the step, to no number or by an impulse too large for any, is not believed.
				CHECK(double(length(before.velocity)) > 100);
				const Vec2 expected = way == 2 ? before.velocity : Vec2{};
				for (const Vec2 v : bad.velocities()) {
					CHECK(v == expected);
				}
			} else {
				CHECK(report.reset_bodies.empty());
			}
			for (const BodyId id : { ids[0], ids[2] }) {
				CHECK(identical(sick.find(id)->positions(), sound.find(id)->positions()));
				CHECK(identical(sick.find(id)->velocities(), sound.find(id)->velocities()));
			}
		}
		CHECK(all_finite(sick.find(ids[1])->positions()));
	}
}

namespace {

// Explicit Euler in one substep, far too stiff for it: blows up over several steps.
SoftBodyData doomed_body(Integrator integrator) {
	BodySettings settings;
	settings.integrator = integrator;
	settings.substeps = integrator == Integrator::AUTOMATIC ? 0 : 1;
	settings.shape_stiffness = 4000;
	SoftBodyData body = thesis_body(thesis_shape_with_ratio(10000, Real(0.05)), settings, Pose{ { 7, -3 }, {} });
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 arm = body.positions()[i] - Vec2{ 7, -3 };
		body.set_point(i, Vec2{ 7, -3 } + Vec2{ arm.x * Real(1.1), arm.y * Real(0.9) }, {});
	}
	return body;
}

} // namespace

TEST_CASE("a body that blew up over some steps is sane again as soon as its settings are") {
	WorldData world;
	const BodyId id = world.add_soft_body(doomed_body(Integrator::EXPLICIT_EULER));
	SoftBodyData &body = *world.find(id);
	Simulator simulator(world);
	int resets = 0;
	for (int n = 0; n < 600 && resets == 0; ++n) {
		resets += int(simulator.simulate(FRAME).reset_bodies.size());
	}
	REQUIRE(resets == 1);
	BodySettings mended = body.settings();
	mended.integrator = Integrator::AUTOMATIC;
	mended.substeps = 0;
	REQUIRE_FALSE(body.set_settings(mended));
	const double start = measure_energy(body, {}).total();
	for (int n = 0; n < 120; ++n) {
		CHECK(simulator.simulate(FRAME).reset_bodies.empty());
		CHECK(measure_energy(body, {}).total() <= start + 1e-6); // rounding of a body of 10 kN/m
		CHECK(deviation_from_rest(body) < 1e-3 * double(THESIS_RADIUS));
	}
}

TEST_CASE("under the automatic choice the same body needs no reset and stays where it is") {
	WorldData world;
	const BodyId id = world.add_soft_body(doomed_body(Integrator::AUTOMATIC));
	Simulator simulator(world);
	for (int n = 0; n < 600; ++n) {
		CHECK(simulator.simulate(FRAME).reset_bodies.empty());
	}
	CHECK(distance(measure_frame(*world.find(id)).center, { 7, -3 }) < 1e-3);
}

TEST_CASE("a reset leaves a pinned point where it is pinned, and what hangs on it at rest") {
	WorldData world = pixel_world();
	const BodyId id = world.add_soft_body(jelly_circle({ 10, 20 }));
	SoftBodyData &body = *world.find(id);
	REQUIRE_FALSE(body.set_pinned(4, true));
	Simulator simulator(world);
	for (int n = 0; n < 20; ++n) {
		simulator.simulate(FRAME);
	}
	const Vec2 pin = body.positions()[4];
	body.mutable_velocities()[0].y = NOT_A_NUMBER;
	REQUIRE(simulator.simulate(FRAME).reset_bodies.size() == 1);
	CHECK(body.positions()[4] == pin);
	for (const Vec2 v : body.velocities()) {
		CHECK(v == Vec2{});
	}
	CHECK(simulator.simulate(FRAME).reset_bodies.empty());
	CHECK(body.positions()[4] == pin);
}

TEST_CASE("a body's step does not depend on the bodies before it") {
	WorldData alone = pixel_world();
	WorldData crowd = pixel_world();
	alone.add_border(floor_at(60));
	crowd.add_border(floor_at(60));
	const BodyId single = alone.add_soft_body(jelly_circle({ 0, 0 }));
	for (int i = 1; i < 5; ++i) {
		crowd.add_soft_body(thesis_body(thesis_shape(Real(1000 * i)), fixed_substeps(7 * i), Pose{ { Real(300 * i), 0 }, {} }));
	}
	const BodyId last = crowd.add_soft_body(jelly_circle({ 0, 0 }));
	Simulator one(alone);
	Simulator many(crowd);
	for (int n = 0; n < 30; ++n) {
		one.simulate(FRAME);
		many.simulate(FRAME);
	}
	CHECK(identical(alone.find(single)->positions(), crowd.find(last)->positions()));
}

TEST_CASE("the report counts substeps of active bodies, and the plan says how many") {
	WorldData world;
	const BodyId first = world.add_soft_body(thesis_body(thesis_shape(), fixed_substeps(3)));
	world.add_soft_body(thesis_body(thesis_shape(), fixed_substeps(5), { { 5, 0 }, {} }));
	const BodyId third = world.add_soft_body(thesis_body(thesis_shape(), {}, { { 10, 0 }, {} }));
	Simulator simulator(world);
	const int planned = simulator.plan(*world.find(third), Real(0.01)).substeps;
	CHECK(simulator.simulate(Real(0.01)).substeps == std::uint64_t(3 + 5 + planned));
	world.find(first)->set_active(false);
	const StepReport report = simulator.simulate(Real(0.01));
	CHECK(report.substeps == std::uint64_t(5 + planned));
	CHECK(report.contacts == 0);
	world.remove_soft_body(third);
	CHECK(simulator.simulate(Real(0.01)).substeps == 5);
}

TEST_CASE("the plan knows of contacts as soon as there are any surroundings") {
	WorldData world;
	const BodyId id = world.add_soft_body(thesis_body(thesis_shape(Real(0.001))));
	const Simulator simulator(world);
	CHECK(simulator.plan(*world.find(id), Real(0.01)).substeps == 1);
	world.add_border(floor_at(1000));
	CHECK(simulator.plan(*world.find(id), Real(0.01)).substeps == MIN_CONTACT_SUBSTEPS);
	world.clear_environment();
	world.add_collider(box_collider({ 1000, 0 }, { 1, 1 }));
	CHECK(simulator.plan(*world.find(id), Real(0.01)).substeps == MIN_CONTACT_SUBSTEPS);
}

TEST_CASE("an inactive body keeps its state and its queued forces, and stands still for drawing") {
	WorldData world = pixel_world();
	const BodyId id = world.add_soft_body(jelly_circle({ 0, 0 }));
	SoftBodyData &body = *world.find(id);
	Simulator simulator(world);
	simulator.simulate(FRAME);
	simulator.simulate(FRAME);
	CHECK_FALSE(identical(body.previous_positions(), body.positions()));
	body.set_active(false);
	body.add_external_force(0, { 1, 2 });
	const auto positions = copy_of(body.positions());
	const auto velocities = copy_of(body.velocities());
	simulator.simulate(FRAME);
	CHECK(identical(body.positions(), positions));
	CHECK(identical(body.velocities(), velocities));
	CHECK(identical(body.previous_positions(), positions));
	CHECK(body.external_forces().size() == 1);
	body.set_active(true);
	simulator.simulate(FRAME);
	CHECK_FALSE(identical(body.positions(), positions));
	CHECK(body.external_forces().empty());
}

TEST_CASE("previous positions are those before the step, not before its last substep") {
	WorldData world = pixel_world();
	const BodyId id = world.add_soft_body(jelly_circle({ 0, 0 }));
	Simulator simulator(world);
	simulator.simulate(FRAME);
	const auto before = copy_of(world.find(id)->positions());
	simulator.simulate(FRAME);
	CHECK(identical(world.find(id)->previous_positions(), before));
}

TEST_CASE("the same world steps to the same bits twice") {
	std::vector<Vec2> first;
	for (const int run : { 0, 1 }) {
		WorldData world = pixel_world();
		world.add_border(floor_at(80));
		world.add_collider(box_collider({ 30, 60 }, { 20, 20 }));
		const BodyId id = world.add_soft_body(jelly_circle({ 0, -50 }));
		Simulator simulator(world);
		for (int n = 0; n < 120; ++n) {
			simulator.simulate(FRAME);
		}
		if (run == 0) {
			first = copy_of(world.find(id)->positions());
		} else {
			CHECK(identical(first, world.find(id)->positions()));
		}
	}
}

TEST_CASE("a body that collapses to a point remembers how it was turned") {
	WorldData world;
	BodySettings settings;
	settings.shape_stiffness = Real(1e-3);
	const BodyId id = world.add_soft_body(loose_points(4, 1, {}, settings));
	SoftBodyData &body = *world.find(id);
	const Rotation turn = Rotation::from_angle(Real(0.8));
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, turn.apply(body.shape().rest_positions()[i]), {});
	}
	Simulator simulator(world);
	simulator.simulate(Real(0.01));
	CHECK(std::abs(double(body.rotation_memory().angle()) - 0.8) <= 8 * EPSILON);
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, { 5, 5 }, {});
	}
	simulator.simulate(Real(0.01));
	CHECK(std::abs(double(measure_frame(body).rotation.angle()) - 0.8) <= 8 * EPSILON);
}

TEST_CASE("what a body remembers is a rotation even after a step to an absurd, finite place") {
	// First the squares of these coordinates overflow, then their products with the rest positions do.
	const Real most = std::numeric_limits<Real>::max();
	for (const Real radius : { std::sqrt(most) * 10, most / 20 }) {
		WorldData world;
		const BodyId id = world.add_soft_body(jelly_circle({}));
		SoftBodyData &body = *world.find(id);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			REQUIRE_FALSE(body.set_point(i, body.shape().rest_positions()[i] * (radius / JELLY_RADIUS), {}));
		}
		Simulator(world).simulate(Real(0.01));
		const Rotation memory = body.rotation_memory();
		CHECK(std::abs(double(length(Vec2{ memory.c, memory.s })) - 1) <= 8 * EPSILON);
	}
}

TEST_CASE("a step divides its time over its phases by the clock that it is given, and tells none without") {
	// A clock that grows by one each time it is asked: the phases then count how often, and their sum is the last minus the first.
	WorldData world = mixed_world();
	double now = 0;
	Simulator simulator(world, {}, [&] { return now++; });
	const StepReport report = simulator.simulate(Real(1) / 60);
	CHECK(report.profile.total() == now - 1);
	CHECK(report.profile.begin == 1);
	CHECK(report.profile.broad_phase == 1);
	CHECK(report.profile.pair_contacts >= 4); // once a contact substep
	CHECK(report.profile.couplings == report.profile.pair_contacts);
	CHECK(report.profile.bodies > report.profile.pair_contacts);
	CHECK(report.profile.end == 1);
	Simulator blind(world);
	CHECK(blind.simulate(Real(1) / 60).profile.total() == 0);
}
