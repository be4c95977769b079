// SPDX-License-Identifier: MIT
// What keeps bodies from being crushed: what it changes, what it leaves alone, and what it bears.
#include "core/dynamics/shape_limits_lanes.h"

#include "core/base/constants.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/material.h"
#include "scenes/deformations.h"
#include "scenes/jelly.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A network of springs as the node makes it.
BodySettings limited_settings() {
	BodySettings settings = jelly_settings();
	set_default_limits(settings);
	return settings;
}

SoftBodyData limited_circle(Vec2 center) {
	return jelly_circle(center, limited_settings());
}

void stretch(SoftBodyData &body, Real along, Real across, Real angle) {
	const Rotation turn = Rotation::from_angle(angle);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 q = turn.apply_inverse(body.positions()[i]);
		REQUIRE(!body.set_point(i, turn.apply({ q.x * along, q.y * across }), body.velocities()[i]));
	}
}

double fill(const SoftBodyData &body) {
	return double(signed_area(body.hull())) / double(body.shape().rest_area());
}

// Thinnest extent over all directions, of a disk at rest 1.
double least_width(const SoftBodyData &body) {
	double least = 9;
	for (int k = 0; k < 90; ++k) {
		const Vec2 direction = Rotation::from_angle(Real(k) * Real(3.14159265 / 90)).apply({ 1, 0 });
		double low = 1e9;
		double high = -1e9;
		for (const Vec2 p : body.hull()) {
			low = std::min(low, double(dot(p, direction)));
			high = std::max(high, double(dot(p, direction)));
		}
		least = std::min(least, (high - low) / (2 * double(JELLY_RADIUS)));
	}
	return least;
}

void keep_for(SoftBodyData &body, int substeps) {
	for (int k = 0; k < substeps; ++k) {
		keep_whole(lanes_of(body), Real(1) / 240, true);
	}
}

// A new node's body: elastic modes, with limits.
SoftBodyData default_body(Vec2 center) {
	StructureOptions options;
	options.stiffness = 1;
	options.elastic = true;
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, options).value();
	BodySettings settings;
	set_default_limits(settings);
	REQUIRE(!apply_material({}, ElasticModel::MODES, *shape, settings));
	return SoftBodyData::create(shape, settings, Pose{ center, {} }).value();
}

} // namespace

TEST_CASE("bounds of nothing leave a body alone, however it lies") {
	SoftBodyData body = limited_circle({});
	BodySettings settings = body.settings();
	settings.least_area = 0;
	settings.least_stretch = 0;
	settings.most_stretch = 1000;
	REQUIRE(!body.set_settings(settings));
	stretch(body, Real(-1), Real(0.1), Real(0.4)); // mirrored, and nearly flat
	const std::vector<Vec2> before(body.positions().begin(), body.positions().end());
	keep_for(body, 10);
	for (std::size_t i = 0; i < before.size(); ++i) {
		CHECK(length(body.positions()[i] - before[i]) < 1e-3 * double(JELLY_RADIUS));
	}
}

TEST_CASE("a body within its limits is left alone to the bit") {
	SoftBodyData body = limited_circle({ 30, 40 });
	stretch(body, Real(1.3), Real(0.75), Real(0.4));
	const BodyState before = body.save_state();
	CHECK_FALSE(keep_whole(lanes_of(body), Real(1) / 240, true));
	CHECK(body.save_state() == before);
}

TEST_CASE("a body with a high least area that is not pressed keeps its wobble, and does not count as at rest earlier") {
	// Smoothing begins above the rest area there, at 1.35 of it.
	BodySettings settings = limited_settings();
	settings.least_area = Real(0.9);
	SoftBodyData body = jelly_circle({ 0, 0 }, settings);
	std::vector<Vec2> before;
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 at = body.positions()[i];
		REQUIRE(!body.set_point(i, at, { at.x, -at.y }));
		before.push_back({ at.x, -at.y });
	}
	keep_whole(lanes_of(body), Real(1) / 240, true);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		CHECK(length(body.velocities()[i] - before[i]) < Real(0.01)); // of 50 px/s
	}

	// 10 px/s on level ground without friction: faster than what falls asleep.
	WorldData world = pixel_world();
	REQUIRE(!world.add_border(floor_at(0)));
	settings.friction = 0;
	settings.rolling_resistance = 0;
	settings.linear_damp = 0;
	const BodyId id = world.add_soft_body(jelly_circle({ 0, -51 }, settings));
	Simulator simulator(world);
	for (int tick = 0; tick < 300; ++tick) {
		simulator.simulate(FRAME);
	}
	world.find(id)->wake();
	for (Vec2 &v : world.find(id)->mutable_velocities()) {
		v = { 10, 0 };
	}
	for (int tick = 0; tick < 300; ++tick) {
		simulator.simulate(FRAME);
	}
	CHECK_FALSE(world.find(id)->is_asleep());
}

TEST_CASE("a flattened body comes back within its limits, in any direction") {
	for (const Real angle : { Real(0), Real(0.7), Real(2.5) }) {
		SoftBodyData body = limited_circle({ 0, 0 });
		stretch(body, Real(1.2), Real(0.02), angle);
		CHECK(keep_whole(lanes_of(body), Real(1) / 240, true));
		keep_for(body, 40);
		CAPTURE(angle);
		CHECK(least_width(body) > 0.98 * double(body.settings().least_stretch));
		CHECK(fill(body) > 0.45);
	}
}

TEST_CASE("a body drawn out comes back within its limits") {
	SoftBodyData body = limited_circle({ 0, 0 });
	stretch(body, 6, 1, Real(0.3));
	keep_for(body, 120);
	double longest = 0;
	for (const Vec2 p : body.hull()) {
		for (const Vec2 q : body.hull()) {
			longest = std::max(longest, double(length(p - q)));
		}
	}
	CHECK(longest < 1.02 * double(body.settings().most_stretch) * 2 * double(JELLY_RADIUS));
	CHECK(longest > 2 * 2 * double(JELLY_RADIUS)); // no further than it must
}

TEST_CASE("limits keep momentum, spin and the center of a free body") {
	SoftBodyData body = limited_circle({ 100, -50 });
	Random random(5);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 q = body.positions()[i] - Vec2{ 100, -50 };
		REQUIRE(!body.set_point(i, Vec2{ 100, -50 } + Vec2{ q.x, q.y * Real(0.1) } + random.vector(3), Vec2{ 200, 30 } + perpendicular(q) * 3 + random.vector(20)));
	}
	const BodyFrame frame = measure_frame(body);
	const Momentum before = measure_momentum(body, frame.center);
	REQUIRE(keep_whole(lanes_of(body), Real(1) / 240, true));
	const Momentum after = measure_momentum(body, frame.center);
	CHECK(after.linear_x == doctest::Approx(before.linear_x).epsilon(1e-4));
	CHECK(after.linear_y == doctest::Approx(before.linear_y).epsilon(1e-4));
	CHECK(after.angular == doctest::Approx(before.angular).epsilon(1e-3));
	CHECK(double(length(measure_frame(body).center - frame.center)) < 1e-3);
}

TEST_CASE("limits that are switched off do nothing") {
	SoftBodyData body = jelly_circle({ 0, 0 }); // as the core leaves them
	stretch(body, 1, Real(0.01), 0);
	CHECK_FALSE(keep_whole(lanes_of(body), Real(1) / 240, true));
}

TEST_CASE("a body that is no longer finite is left to be reset") {
	SoftBodyData body = limited_circle({ 0, 0 });
	stretch(body, 1, Real(0.01), 0);
	body.mutable_positions()[3].x = std::numeric_limits<Real>::quiet_NaN();
	keep_whole(lanes_of(body), Real(1) / 240, true);
	CHECK(std::isfinite(body.positions()[5].x));
}

TEST_CASE("a heap of springs far too soft for it stays a heap" * doctest::test_suite("slow")) {
	// Ten high, at a tenth of the stiffness that would hold it: it folded flat, all of it, and stayed so. 25 high a heap
	// folded that was brought back by at most a twentieth of its size in a substep.
	for (const int high : { 10, 25, 40 }) {
		if (high == 40 && sizeof(Real) == 8) {
			continue; // it is crushed as it lands, and 2 of 8 draws stay so: docs/limits.md
		}
		CAPTURE(high);
		WorldData world = pixel_world();
		REQUIRE(!world.add_border(floor_at(0)));
		REQUIRE(!world.add_border({ { { 0, 0 }, { 1, 0 } }, {} }));
		REQUIRE(!world.add_border({ { { 1050, 0 }, { -1, 0 } }, {} }));
		Random random{ std::uint64_t(high) };
		for (int i = 0; i < 10 * high; ++i) {
			const Vec2 place{ Real(i % 10) * 105 + 52, -Real(i / 10) * 105 - 55 };
			world.add_soft_body(jelly_circle(place + random.vector(2), limited_settings()));
		}
		Simulator simulator(world);
		for (int tick = 0; tick < 480; ++tick) {
			simulator.simulate(FRAME);
		}
		double highest = 0;
		for (const SoftBodyData &body : world.soft_bodies()) {
			CHECK(fill(body) > 0.3);
			for (const Vec2 p : body.hull()) {
				highest = std::max(highest, -double(p.y));
			}
		}
		CHECK(highest > 40 * high); // of 105 a row as laid out
	}
}

TEST_CASE("columns of bodies far too soft for their load come to rest") {
	// In a shaft hardly wider than they are, the lowest pressed to half their area: columns of nine and more trembled
	// for ever, by 30 to 50 px/s.
	for (const int count : { 6, 9, 12, 14 }) {
		for (const Real aside : { Real(0.5), Real(1), Real(3) }) {
			CAPTURE(count);
			CAPTURE(aside);
			WorldData world = pixel_world();
			REQUIRE(!world.add_border(floor_at(0)));
			REQUIRE(!world.add_border({ { { -55, 0 }, { 1, 0 } }, {} }));
			REQUIRE(!world.add_border({ { { 55, 0 }, { -1, 0 } }, {} }));
			for (int i = 0; i < count; ++i) {
				world.add_soft_body(jelly_circle({ aside * Real(i % 2), -Real(i) * 145 - 60 }, limited_settings()));
			}
			Simulator simulator(world);
			std::size_t asleep = 0;
			for (int tick = 0; tick < 40 * 60 && asleep < std::size_t(count); ++tick) {
				asleep = simulator.simulate(FRAME).sleeping_bodies;
			}
			CHECK(asleep == std::size_t(count));
			for (const SoftBodyData &body : world.soft_bodies()) {
				CHECK(fill(body) > 0.4);
			}
		}
	}
}

TEST_CASE("a heap of default bodies twenty high carries itself" * doctest::test_suite("slow")) {
	WorldData world = pixel_world();
	REQUIRE(!world.add_border(floor_at(0)));
	REQUIRE(!world.add_border({ { { 0, 0 }, { 1, 0 } }, {} }));
	REQUIRE(!world.add_border({ { { 410, 0 }, { -1, 0 } }, {} }));
	for (int i = 0; i < 80; ++i) {
		world.add_soft_body(default_body({ (Real(i % 4) + Real(0.5)) * Real(102.5), -Real(i / 4) * 105 - 53 }));
	}
	Simulator simulator(world);
	for (int tick = 0; tick < 600; ++tick) {
		simulator.simulate(FRAME);
	}
	for (const SoftBodyData &body : world.soft_bodies()) {
		CHECK(fill(body) > 0.5);
	}
}

TEST_CASE("a default body pressed to 0.3 of its height for ten minutes finds its shape again") {
	constexpr int CLOSING = 180; // ticks
	constexpr int HELD = 36000;
	constexpr int FREE = 600;
	constexpr double HELD_HALF = 0.3 * double(JELLY_RADIUS);
	WorldData world = pixel_world();
	REQUIRE(!world.set_gravity({}));
	world.add_soft_body(default_body({ 0, 0 }));
	const auto set_plates = [&](double half) {
		world.clear_environment();
		REQUIRE(!world.add_border(floor_at(Real(half))));
		REQUIRE(!world.add_border({ { { 0, Real(-half) }, { 0, 1 } }, {} }));
	};
	Simulator simulator(world);
	SoftBodyData &body = world.soft_bodies()[0];
	for (int tick = 1; tick <= CLOSING; ++tick) {
		set_plates(double(JELLY_RADIUS) + (HELD_HALF - double(JELLY_RADIUS)) * tick / CLOSING);
		simulator.simulate(FRAME);
	}
	std::size_t resets = 0;
	for (int tick = 0; tick < HELD; ++tick) {
		resets += simulator.simulate(FRAME).reset_bodies.size();
	}
	CHECK(resets == 0);
	for (const Vec2 p : body.hull()) {
		CHECK(std::fabs(double(p.y)) < HELD_HALF + 1); // it was between the plates all the time
	}
	world.clear_environment();
	for (int tick = 0; tick < FREE; ++tick) {
		simulator.simulate(FRAME);
	}
	CHECK(deviation_from_rest(body) < 0.01 * double(JELLY_RADIUS));
}
