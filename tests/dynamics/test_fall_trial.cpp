// SPDX-License-Identifier: MIT
// Claims about falls: what a designer is told of a network is what its bodies do when they are dropped.
#include "core/dynamics/fall_trial.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/model/material.h"
#include "scenes/jelly.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <span>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Vec2 GRAVITY{ 0, PIXEL_GRAVITY };

// A node's network: damping of 0.12 N·s/m, and limits.
SoftBodyData network(int points, double stiffness, double shape_matching) {
	const auto shape = circle_shape(JELLY_RADIUS, points, { JELLY_MASS, 1, 1, true });
	BodySettings settings;
	settings.rolling_resistance = Real(0.03);
	CHECK_FALSE(apply_network({ stiffness, double(JELLY_DAMPING), shape_matching, 0.25 }, double(JELLY_MASS), *shape.value(), settings));
	set_default_limits(settings);
	return SoftBodyData::create(shape.value(), settings, {}).value();
}

// Whether the body is ruined 8 s after it was let go at that height above a floor, turned by that angle.
bool is_ruined_by(const SoftBodyData &body, Real height, Real turn) {
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	SoftBodyData dropped = SoftBodyData::create(body.shared_shape(), body.settings(), Pose{ { 0, -JELLY_RADIUS - height }, Rotation::from_angle(turn) }).value();
	const BodyId id = world.add_soft_body(std::move(dropped));
	Simulator simulator(world);
	for (int tick = 0; tick < 480 && !world.find(id)->is_asleep(); ++tick) {
		simulator.simulate(FRAME);
	}
	const std::span<const Vec2> hull = world.find(id)->hull();
	return signed_area(hull) < Real(0.8) * body.shape().rest_area() || is_folded(hull);
}

struct Counts {
	int ruined = 0;
	int whole = 0;
};

// The trial must call ruined what every drop ruins, and whole what none does. Between the two the way it falls decides.
Counts check_trial(std::initializer_list<int> point_counts, std::initializer_list<double> stiffnesses) {
	Counts counts;
	for (const int points : point_counts) {
		for (const double stiffness : stiffnesses) {
			for (const double shape_matching : { 0.0, 0.4 }) {
				CAPTURE(points);
				CAPTURE(stiffness);
				CAPTURE(shape_matching);
				const SoftBodyData body = network(points, stiffness, shape_matching);
				int ruined = 0;
				for (const Real turn : { Real(0), Real(0.1), Real(0.35) }) {
					ruined += int(is_ruined_by(body, 2 * JELLY_RADIUS, turn));
				}
				ruined += int(is_ruined_by(body, 0, 0));
				const bool keeps_shape = try_falls(body, GRAVITY, PIXELS_PER_METER, FRAME).keeps_shape();
				if (ruined == 4) {
					CHECK_FALSE(keeps_shape);
					++counts.ruined;
				} else if (ruined == 0) {
					CHECK(keeps_shape);
					++counts.whole;
				}
			}
		}
	}
	return counts;
}

} // namespace

TEST_CASE("a network that every drop ruins is told of, and one that none does is not") {
	const Counts counts = check_trial({ 16, 32, 64 }, { 50, 100, 200, 1000, 1e4 });
	CHECK(counts.ruined >= 4); // the hull of many points without shape matching crosses itself
	CHECK(counts.whole >= 20);
}

TEST_CASE("a network of very many points is told of if drops ruin it, whatever its strength" * doctest::test_suite("slow")) {
	const Counts counts = check_trial({ 128, 256 }, { 50, 400, 1e4 });
	CHECK(counts.ruined >= 5);
	CHECK(counts.whole >= 4);
}

TEST_CASE("a fall along a pull that is turned round is the same fall") {
	SoftBodyData body = network(64, 50, 0);
	CHECK_FALSE(try_falls(body, { PIXEL_GRAVITY, 0 }, PIXELS_PER_METER, FRAME).keeps_shape());
	BodySettings rising = body.settings();
	rising.gravity_scale = -1;
	CHECK_FALSE(body.set_settings(rising));
	CHECK_FALSE(try_falls(body, GRAVITY, PIXELS_PER_METER, FRAME).keeps_shape());
}

TEST_CASE("what cannot fall keeps its shape") {
	SoftBodyData body = network(64, 50, 0);
	CHECK(try_falls(body, {}, PIXELS_PER_METER, FRAME) == FallOutcome{});
	CHECK(try_falls(body, GRAVITY, PIXELS_PER_METER, 0) == FallOutcome{});
	CHECK(try_falls(body, GRAVITY, 0, FRAME) == FallOutcome{});
	CHECK_FALSE(body.set_pinned(0, true));
	CHECK(try_falls(body, GRAVITY, PIXELS_PER_METER, FRAME) == FallOutcome{});
}
