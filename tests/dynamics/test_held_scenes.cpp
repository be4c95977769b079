// SPDX-License-Identifier: MIT
// Scenes in which contacts and joints must hold against everything else that moves points.
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/thesis_body.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("a crowd that is pressed onto a thin segment stays on its side: 100 columns of bodies that start half inside one another") {
	for (int seed = 0; seed < 100; ++seed) {
		CAPTURE(seed);
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		REQUIRE(!world.add_collider({ { { -20, 0 }, { 20, 0 } }, 0, {} }));
		Random random(std::uint64_t(seed) + 300);
		for (int i = 0; i < 8; ++i) { // the lowest point of the first lies on the segment to the last digit
			world.add_soft_body(thesis_body(thesis_shape_with_ratio(300, Real(0.05)), {}, { { random.real(-0.1, 0.1), Real(0.5 + 0.5 * i) }, {} }));
		}
		Simulator simulator(world);
		for (int step = 0; step < 120; ++step) {
			simulator.simulate(FRAME);
		}
		for (const SoftBodyData &body : world.soft_bodies()) {
			CHECK(std::ranges::all_of(body.hull(), [](Vec2 p) { return p.y > Real(-0.05); }));
		}
	}
}

TEST_CASE("nothing that is thrown at a floor of one segment gets through, at any length of the floor: 300 throws") {
	Random random(51);
	for (const Real size : { Real(4e3), Real(8e4), Real(1e6) }) {
		for (int n = 0; n < 100; ++n) {
			CAPTURE(size);
			CAPTURE(n);
			WorldData world = pixel_world();
			const Rotation turn = Rotation::from_angle(random.real(-0.3, 0.3));
			Collider floor;
			floor.vertices = { {}, turn.apply({ size, 0 }) };
			REQUIRE(!world.add_collider(floor));
			BodySettings settings = jelly_settings();
			settings.friction = Real(0.4);
			SoftBodyData body = jelly_circle(turn.apply({ random.real(1500, size - 1500), -200 }), settings); // slides by 1,000 px
			const Vec2 velocity = turn.apply({ random.real(-300, 300), random.real(300, 2500) });
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				REQUIRE(!body.set_point(i, body.positions()[i], velocity));
			}
			world.add_soft_body(std::move(body));
			Simulator simulator(world);
			for (int i = 0; i < 180; ++i) {
				simulator.simulate(FRAME);
			}
			for (const Vec2 p : world.soft_bodies()[0].hull()) {
				CHECK(signed_double_area(floor.vertices[0], floor.vertices[1], p) < 0);
			}
		}
	}
}

TEST_CASE("rigid joints hold where load draws bodies out past their limits") {
	for (const Real ball_mass : { Real(10), Real(100), Real(1000) }) {
		CAPTURE(ball_mass);
		WorldData world = pixel_world();
		BodySettings settings = jelly_settings();
		settings.collision_mask = 0;
		set_default_limits(settings);
		std::vector<BodyId> links;
		constexpr int LINKS = 10;
		for (int i = 0; i <= LINKS; ++i) {
			const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { i < LINKS ? JELLY_MASS : ball_mass, JELLY_STIFFNESS, JELLY_DAMPING, true });
			links.push_back(world.add_soft_body(SoftBodyData::create(shape.value(), settings, { { Real(2 * JELLY_RADIUS * i), 0 }, {} }).value()));
		}
		const auto right = [&](int i) { return world.find(links[std::size_t(i)])->positions()[0]; };
		const auto left = [&](int i) { return world.find(links[std::size_t(i)])->positions()[JELLY_HULL_POINTS / 2]; };
		Joint hook;
		hook.first = JointAnchor::at_place(left(0));
		hook.second = JointAnchor::on_point(links[0], JELLY_HULL_POINTS / 2);
		REQUIRE(world.add_joint(hook));
		for (int i = 0; i < LINKS; ++i) {
			Joint joint;
			joint.first = JointAnchor::on_point(links[std::size_t(i)], 0);
			joint.second = JointAnchor::on_point(links[std::size_t(i) + 1], JELLY_HULL_POINTS / 2);
			REQUIRE(world.add_joint(joint));
		}
		Simulator simulator(world);
		Real widest = 0;
		for (int step = 0; step < 600; ++step) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			for (int i = 0; i < LINKS; ++i) {
				widest = std::max(widest, length(right(i) - left(i + 1)));
			}
		}
		CHECK(widest < 1); // px
	}
}

TEST_CASE("a chain that is shaken by 100 px a tick keeps its joints, and has its shape back after 3 s: 20 ways to shake it") {
	for (int seed = 0; seed < 20; ++seed) {
		CAPTURE(seed);
		WorldData world = pixel_world();
		BodySettings settings = jelly_settings();
		set_default_limits(settings);
		std::vector<BodyId> links;
		constexpr int LINKS = 10;
		for (int i = 0; i < LINKS; ++i) {
			links.push_back(world.add_soft_body(jelly_circle({ Real(2 * JELLY_RADIUS * i), 0 }, settings)));
		}
		const Vec2 hook = world.find(links[0])->positions()[JELLY_HULL_POINTS / 2];
		REQUIRE(!world.find(links[0])->set_pinned(JELLY_HULL_POINTS / 2, true));
		for (int i = 0; i + 1 < LINKS; ++i) {
			Joint joint;
			joint.first = JointAnchor::on_point(links[std::size_t(i)], 0);
			joint.second = JointAnchor::on_point(links[std::size_t(i) + 1], JELLY_HULL_POINTS / 2);
			REQUIRE(world.add_joint(joint));
		}
		Simulator simulator(world);
		Random random(std::uint64_t(seed) + 900);
		for (int step = 0; step < 300; ++step) {
			if (step < 120) {
				REQUIRE(!world.find(links[0])->set_pin_target(JELLY_HULL_POINTS / 2, hook + random.vector(100)));
			}
			simulator.simulate(FRAME);
		}
		for (int i = 0; i < LINKS; ++i) {
			const SoftBodyData &body = *world.find(links[std::size_t(i)]);
			CHECK(signed_area(body.hull()) > Real(0.6) * signed_area(body.shape().rest_hull()));
			if (i + 1 < LINKS) {
				const SoftBodyData &next = *world.find(links[std::size_t(i) + 1]);
				CHECK(length(body.positions()[0] - next.positions()[JELLY_HULL_POINTS / 2]) < 1); // px
			}
		}
	}
}

TEST_CASE("where other bodies have pushed a body is forgotten when they or the colliders near it are gone") {
	for (const bool without_neighbor : { true, false }) {
		CAPTURE(without_neighbor);
		WorldData world = pixel_world();
		Collider floor;
		floor.vertices = { { -400, 0 }, { 400, 0 } };
		REQUIRE(!world.add_collider(floor));
		const BodyId below = world.add_soft_body(jelly_circle({ 0, -JELLY_RADIUS }));
		const BodyId above = world.add_soft_body(jelly_circle({ 0, Real(-2.9) * JELLY_RADIUS }));
		Simulator simulator(world);
		for (int step = 0; step < 20; ++step) {
			simulator.simulate(FRAME);
		}
		CHECK(!world.find(below)->last_valid_hull().empty());
		if (without_neighbor) {
			world.remove_soft_body(above);
		} else {
			world.clear_environment();
		}
		simulator.simulate(FRAME);
		CHECK(world.find(below)->last_valid_hull().empty());
	}
}

TEST_CASE("a stack of twenty squares stands for a minute, and sleeps within 20 s: of 8e4 and 1.6e5 N/m, five starts each" * doctest::test_suite("slow")) {
	const std::vector<Vec2> outline = { { -30, -30 }, { 0, -30 }, { 30, -30 }, { 30, 0 }, { 30, 30 }, { 0, 30 }, { -30, 30 }, { -30, 0 } };
	constexpr int HIGH = 20;
	for (const Real stiffness : { Real(8e4), Real(1.6e5) }) {
		for (int seed = 0; seed < 5; ++seed) {
			CAPTURE(stiffness);
			CAPTURE(seed);
			WorldData world = pixel_world();
			world.add_border(floor_at(0));
			Random random(std::uint64_t(seed) + 70);
			const auto shape = SoftBodyCreator::create_polygon(outline, { 1, stiffness, Real(0.012) * std::sqrt(stiffness), true });
			BodySettings settings;
			settings.shape_stiffness = DEFAULT_SHAPE_MATCHING * stiffness;
			settings.shape_damping = Real(0.5) * std::sqrt(settings.shape_stiffness / 9);
			settings.friction = Real(0.4);
			settings.rolling_resistance = Real(0.03);
			for (int i = 0; i < HIGH; ++i) {
				world.add_soft_body(SoftBodyData::create(shape.value(), settings, { { random.real(-1, 1), Real(-30 - 60 * i) }, {} }).value());
			}
			Simulator simulator(world);
			int step = 0;
			while (simulator.simulate(FRAME).sleeping_bodies < HIGH && step < 1200) {
				++step;
			}
			CHECK(step < 1200); // what sleeps stands for good
			CHECK(double(measure_frame(world.soft_bodies()[HIGH - 1]).center.y) == doctest::Approx(-60 * (HIGH - 0.5)).epsilon(0.05));
		}
	}
}

TEST_CASE("stiff bodies that walls press from all sides come to rest, though their springs take 32 substeps") {
	constexpr int SIDE = 4;
	WorldData world = pixel_world();
	world.set_gravity({});
	const Real stiffness = 9000;
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { JELLY_MASS, stiffness, Real(0.012) * std::sqrt(stiffness), true });
	for (int i = 0; i < SIDE * SIDE; ++i) {
		const Vec2 place{ Real(100 * (i % SIDE)) - 150, Real(100 * (i / SIDE)) - 150 };
		world.add_soft_body(SoftBodyData::create(shape.value(), jelly_settings(stiffness), { place, {} }).value());
	}
	Simulator simulator(world);
	REQUIRE(simulator.plan(world.soft_bodies()[0], FRAME).substeps > 16);
	REQUIRE(simulator.plan(world.soft_bodies()[0], FRAME).integrator != Integrator::XPBD);
	for (int step = 0; step < 360; ++step) {
		const Real half = std::max(Real(200 - step), Real(182)); // 16 discs fill 95 % of the rest
		world.clear_environment();
		for (const Vec2 inward : { Vec2{ 1, 0 }, Vec2{ -1, 0 }, Vec2{ 0, 1 }, Vec2{ 0, -1 } }) {
			world.add_border({ { inward * -half, inward }, {} });
		}
		simulator.simulate(FRAME);
	}
	for (const SoftBodyData &body : world.soft_bodies()) {
		CHECK(double(measure_frame(body).velocity.x) == doctest::Approx(0).epsilon(1).scale(1)); // px/s
		CHECK(std::ranges::all_of(body.velocities(), [](Vec2 v) { return length(v) < 5; }));
	}
}
