// SPDX-License-Identifier: MIT
// Bodies that are put across colliders: they come out on the side of their middle.
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/circle.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

enum class Thin { SEGMENT, ROUNDED, PLATE };

// A floor through the origin, along `along`, no thicker than a tenth of a body's radius.
Collider thin_floor(Thin kind, Vec2 along) {
	const Vec2 far = along * Real(4000);
	Collider floor;
	floor.vertices = { -far, far };
	floor.radius = kind == Thin::ROUNDED ? Real(2) : Real(0);
	if (kind == Thin::PLATE) {
		const Vec2 down = perpendicular(along) * Real(5);
		floor.vertices = { -far, far, far + down, -far + down };
	}
	return floor;
}

// How far the lowest hull point lies under the floor.
Real depth_under(const SoftBodyData &body, Vec2 up) {
	Real lowest = 0;
	for (const Vec2 p : body.hull()) {
		lowest = std::max(lowest, -dot(p, up));
	}
	return lowest;
}

SoftBodyData jelly_of(int points, Vec2 place) {
	const auto shape = circle_shape(JELLY_RADIUS, points, { .elastic = true });
	BodySettings settings;
	settings.shear_modulus = 100;
	settings.area_stiffness = 1000;
	settings.poisson_ratio = Real(0.45);
	settings.elastic_damping_time = Real(0.01);
	set_default_limits(settings);
	return SoftBodyData::create(shape.value(), settings, { place, {} }).value();
}

} // namespace

TEST_CASE("a body put across a thin collider comes out on the side of its middle and slides down: 300 random slopes and depths" * doctest::test_suite("slow")) {
	Random random(19);
	for (int n = 0; n < 300; ++n) {
		CAPTURE(n);
		const Thin kind = Thin(n % 3);
		const Real angle = random.real(0.05, 0.8);
		const Vec2 along{ std::cos(angle), std::sin(angle) };
		const Vec2 up{ along.y, -along.x };
		WorldData world = pixel_world();
		Collider floor = thin_floor(kind, along);
		floor.surface.friction = 0;
		REQUIRE(!world.add_collider(floor));
		const Vec2 place = up * (JELLY_RADIUS * random.real(0.1, 0.99)) + along * random.real(-300, 300);
		SoftBodyData body = jelly_of(8 + 2 * (n % 13), n % 2 == 0 ? place : place + Vec2{ 5000, -9000 });
		if (n % 2 != 0) { // sent there
			REQUIRE(!body.teleport({ place + Vec2{ 5000, -9000 }, {} }, { place, {} }));
		}
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int step = 0; step < 120; ++step) {
			simulator.simulate(FRAME);
		}
		const SoftBodyData &landed = world.soft_bodies()[0];
		CHECK(depth_under(landed, up) < Real(0.02) * JELLY_RADIUS + floor.radius);
		// Two seconds from rest without friction: g sin(a) 2 s². What it sinks in first throws it up, not back.
		const Real way = dot(measure_frame(landed).center - place, along);
		CHECK(way / (PIXEL_GRAVITY * std::sin(angle) * 2) == doctest::Approx(1).epsilon(0.1));
	}
}

TEST_CASE("a body around a bar, without touching it, stays where it was put") {
	// A C whose opening is to the right, about a post and a line that end in the middle of it.
	const std::vector<Vec2> outline = { { -60, -60 }, { 0, -60 }, { 60, -60 }, { 60, -30 }, { 0, -30 }, { -30, -30 }, { -30, 30 }, { 0, 30 }, { 60, 30 },
		{ 60, 60 }, { 0, 60 }, { -60, 60 }, { -60, 0 } };
	for (const bool is_line : { true, false }) {
		CAPTURE(is_line);
		WorldData world = pixel_world();
		world.set_gravity({});
		Collider bar;
		bar.vertices = is_line ? std::vector<Vec2>{ { -20, 0 }, { 500, 0 } } : std::vector<Vec2>{ { 0, -10 }, { 20, -10 }, { 20, 10 }, { 0, 10 } };
		REQUIRE(!world.add_collider(bar));
		const auto shape = SoftBodyCreator::create_polygon(outline, { .elastic = true });
		REQUIRE(shape);
		SoftBodyData body = SoftBodyData::create(shape.value(), {}, {}).value();
		const std::vector<Vec2> before(body.hull().begin(), body.hull().end());
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int step = 0; step < 10; ++step) {
			simulator.simulate(FRAME);
		}
		for (std::size_t i = 0; i < before.size(); ++i) {
			CHECK(length(world.soft_bodies()[0].hull()[i] - before[i]) < Real(1e-3));
		}
	}
}

TEST_CASE("a turn on the spot that corrects a rotation, as of a locked body, does not count as being put there") {
	SoftBodyData body = jelly_circle({ 0, -200 });
	body.set_placed(false);
	REQUIRE(!body.teleport({ { 0, -200 }, {} }, { { 0, -200 }, Rotation::from_angle(Real(0.05)) }));
	CHECK_FALSE(body.is_placed());
	REQUIRE(!body.teleport({ { 0, -200 }, {} }, { { 0, -200 }, Rotation::from_angle(Real(0.5)) }));
	CHECK(body.is_placed());
}

TEST_CASE("a body across a one-way platform, its middle above, goes on through it as before it was put there") {
	WorldData world = pixel_world();
	Collider platform = thin_floor(Thin::PLATE, { 1, 0 });
	platform.one_way = { 0, -1 };
	platform.one_way_margin = 2;
	REQUIRE(!world.add_collider(platform));
	world.add_soft_body(jelly_of(16, { 0, -20 }));
	Simulator simulator(world);
	for (int step = 0; step < 60; ++step) {
		simulator.simulate(FRAME);
	}
	CHECK(measure_frame(world.soft_bodies()[0]).center.y > 200);
}
