// SPDX-License-Identifier: MIT
// Claims about staying out: thin walls, pins between hull points, edges, slop, overlap at the start.
#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

SoftBodyData &only_body(WorldData &world) {
	return world.soft_bodies()[0];
}

} // namespace

TEST_CASE("a body shot at a thin wall from afar stays on its side, even when the shot begins within the step") {
	for (const bool pushed : { false, true }) {
		WorldData world = pixel_world();
		world.set_gravity({});
		world.add_collider(box_collider({ 700, 0 }, { 2, 500 }));
		world.add_collider({ { { -700, -500 }, { -700, 500 } }, 0, {} });
		for (const Real side : { Real(1), Real(-1) }) {
			BodySettings settings;
			settings.substeps = 4;
			settings.collision_layer = 0; // the two start in one place and must not notice each other
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
	CHECK(measure_frame(only_body(world)).center.y < 98);
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
		CHECK(frame.center.y < 0);
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
	world.clear_environment();
	world.add_collider({ { { Real(0.25), Real(0.25) }, { 5, 4 }, { 4, 5 } }, 0, {} }); // a corner inside the hull
	CHECK(std::abs(double(measure_penetration(world, body)) - std::numbers::sqrt2 / 4) <= 8 * EPSILON);
	world.clear_environment();
	world.add_collider({ { { Real(0.75), Real(0.75) } }, Real(0.5), {} }); // round, touching an edge only
	CHECK(std::abs(double(measure_penetration(world, body)) - (0.5 - std::numbers::sqrt2 / 4)) <= 8 * EPSILON);
	world.clear_environment();
	world.add_collider({ { { Real(0.5), Real(0.5) } }, Real(0.25), {} }); // its center on the edge
	CHECK(std::abs(double(measure_penetration(world, body)) - 0.25) <= 8 * EPSILON);
}

TEST_CASE("a collider in an edge moves the two ends of that edge out of its way, and no other point") {
	// A disc in the middle of each edge in turn, its center in, on, or out of the hull.
	for (std::size_t edge = 0; edge < 4; ++edge) {
		for (const Real x : { Real(0.45), Real(0.5), Real(0.55) }) {
			WorldData world;
			world.add_soft_body(loose_points(4, 1)); // a square on its tip: (1, 0), (0, 1), (-1, 0), (0, -1)
			const SoftBodyData &body = only_body(world);
			const auto start = copy_of(body.positions());
			const Vec2 outwards = start[edge] + start[(edge + 1) % 4]; // length sqrt(2); its half is on the edge
			world.add_collider({ { outwards * x }, Real(0.2), {} });
			const double before = measure_penetration(world, body);
			CHECK(std::abs(before - (0.2 + std::numbers::sqrt2 * (0.5 - double(x)))) <= 16 * EPSILON);
			Simulator(world).simulate(Real(0.001));
			CHECK(double(measure_penetration(world, body)) <= 16 * EPSILON);
			for (std::size_t i = 0; i < 4; ++i) {
				const Vec2 moved = body.positions()[i] - start[i];
				if (i == edge || i == (edge + 1) % 4) { // inwards by the depth, both alike
					CHECK(distance(moved, outwards * Real(-before / std::numbers::sqrt2)) <= 32 * EPSILON);
				} else {
					CHECK(distance(moved, {}) <= 2 * EPSILON);
				}
			}
		}
	}
}

TEST_CASE("points rest at the slop's distance from a bare segment, and the slop scales with the length unit") {
	for (const Real unit : { Real(1), Real(100) }) {
		WorldData world;
		world.set_length_unit(unit);
		world.add_collider({ { { -10, 0 }, { 10, 0 } }, 0, {} });
		SoftBodyData body = loose_points(4, 1);
		for (std::uint32_t i = 0; i < 4; ++i) {
			body.set_point(i, { Real(i), LINEAR_SLOP * unit / 2 }, {});
		}
		world.add_soft_body(std::move(body));
		Simulator(world).simulate(FRAME);
		for (const Vec2 p : only_body(world).positions()) {
			CHECK(std::abs(double(p.y) - double(LINEAR_SLOP * unit)) <= 4 * EPSILON);
		}
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
