// SPDX-License-Identifier: MIT
// Claims about the restitution of a body as a whole: what it remembers of a touch, and what it gets back.
#include "core/collision/surface_constraint.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real THRESHOLD = Real(0.5);
constexpr Real SUBSTEP = Real(1) / 480;

// Four points of 1 kg with the velocities of a body that has just been stopped, or is on its way.
SoftBodyData points_moving(Vec2 velocity) {
	SoftBodyData body = loose_points(4, 1);
	for (std::uint32_t i = 0; i < 4; ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
	return body;
}

void set_velocity(SoftBodyData &body, Vec2 velocity) {
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
}

// A contact that took the summed impulse (0, size) from the body.
ContactLoad touch(Real size, Real restitution, const Surface &surface = {}) {
	ContactLoad load;
	load.add(size, { 0, 1 }, 0, {}, surface, restitution);
	return load;
}

} // namespace

TEST_CASE("a body that leaves too slowly lacks the rest of its restitution, and is told so once") {
	SoftBodyData body = points_moving({ 3, 0 });
	follow_bounce(body, touch(8, Real(0.75)), THRESHOLD, SUBSTEP); // 8 / 4 kg: it came with 2
	CHECK(body.touch_memory().touching);
	set_velocity(body, { 3, Real(0.5) });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.velocities()[0] == Vec2{ 3, Real(0.5) }); // paid at the end of the step
	CHECK_FALSE(body.touch_memory().touching);
	CHECK(body.touch_memory().ended);
	CHECK(body.touch_memory().missing == doctest::Approx(1));
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().missing == doctest::Approx(1));
}

TEST_CASE("a body that leaves fast enough by itself lacks nothing") {
	SoftBodyData body = points_moving({});
	follow_bounce(body, touch(8, Real(0.5)), THRESHOLD, SUBSTEP);
	set_velocity(body, { 0, Real(1.25) });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().ended);
	CHECK(body.touch_memory().missing == 0);
}

TEST_CASE("between two contacts of one touch the body waits, and its fastest approach counts") {
	SoftBodyData body = points_moving({});
	follow_bounce(body, touch(8, 1), THRESHOLD, SUBSTEP); // came with 2
	set_velocity(body, { 0, -1 });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP); // still going down
	CHECK(body.touch_memory().touching);
	set_velocity(body, { 0, Real(0.5) });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().missing == doctest::Approx(1.5));
	set_velocity(body, {});
	follow_bounce(body, touch(4, 1), THRESHOLD, SUBSTEP); // came with 1, in the same step: the touch goes on
	CHECK(body.touch_memory().touching);
	CHECK(body.touch_memory().missing == 0);
	set_velocity(body, { 0, Real(0.5) });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().missing == doctest::Approx(1.5));
}

TEST_CASE("slow approaches do not count, nor does a surface that does not bounce") {
	SoftBodyData slow = points_moving({});
	follow_bounce(slow, touch(2, 1), THRESHOLD, SUBSTEP); // came with 0.5
	set_velocity(slow, { 0, Real(0.125) });
	follow_bounce(slow, {}, THRESHOLD, SUBSTEP);
	CHECK(slow.touch_memory().missing == 0);
	SoftBodyData dull = points_moving({});
	follow_bounce(dull, touch(8, 0), THRESHOLD, SUBSTEP);
	set_velocity(dull, { 0, Real(0.125) });
	follow_bounce(dull, {}, THRESHOLD, SUBSTEP);
	CHECK(dull.touch_memory().missing == 0);
	CHECK_FALSE(dull.touch_memory().ended);
}

TEST_CASE("approach and departure are relative to the surface, whose work is noted") {
	Surface lift;
	lift.linear_velocity = { 0, 3 };
	SoftBodyData body = points_moving({ 0, 3 }); // carried by the lift, hit by it at rest
	follow_bounce(body, touch(12, 1, lift), THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().work == doctest::Approx(36)); // J·u
	set_velocity(body, { 0, 4 });
	follow_bounce(body, {}, THRESHOLD, SUBSTEP);
	CHECK(body.touch_memory().missing == doctest::Approx(2));
}

TEST_CASE("the load of several contacts is weighted by their impulses") {
	ContactLoad load;
	Surface belt;
	belt.linear_velocity = { 4, 0 };
	load.add(1, { 0, 1 }, 0, {}, {}, 1);
	load.add(3, { 1, 0 }, 2, {}, belt, Real(0.5));
	CHECK(load.normal_impulse == 4);
	CHECK(load.impulse == Vec2{ 3, 1 });
	CHECK(load.restitution == Real(2.5));
	CHECK(load.surface_velocity == Vec2{ 12, 0 });
	CHECK(load.work == 12); // the sliding impulse is across the belt's motion
}

TEST_CASE("a jelly leaves the ground with at least its restitution, and never rises above where it fell from") {
	for (const double e : { 0.0, 0.5, 0.8, 1.0 }) {
		WorldData world = pixel_world();
		world.add_border(floor_at(0));
		BodySettings settings = jelly_settings();
		settings.restitution = Real(e);
		world.add_soft_body(jelly_circle({ 0, -250 }, settings));
		const SoftBodyData &body = world.soft_bodies()[0];
		Simulator simulator(world);
		double fastest_down = 0;
		double fastest_up = 0;
		double highest = -250;
		for (int n = 0; n < 1200; ++n) {
			simulator.simulate(FRAME);
			const BodyFrame frame = measure_frame(body);
			if (n < 90) { // the first bounce: down at 0.64 s
				fastest_down = std::fmax(fastest_down, double(frame.velocity.y));
				fastest_up = std::fmax(fastest_up, -double(frame.velocity.y));
			}
			highest = std::fmin(highest, double(frame.center.y));
		}
		CAPTURE(e);
		// Seen once a frame, in which gravity changes the speed by 16 px/s of about 600.
		CHECK(fastest_up >= e * fastest_down - 2 * 980.0 / 60);
		CHECK(fastest_up <= fastest_down);
		CHECK(highest >= -250 * 1.01); // a bounce is timed to a substep: v h = 2 px
	}
}

TEST_CASE("a body that has come to rest has forgotten how it landed: a gentle jump is not boosted") {
	WorldData world = pixel_world();
	world.add_border(floor_at(0));
	BodySettings settings = jelly_settings();
	settings.restitution = Real(0.8);
	settings.shape_damping = 6; // damped so strongly that it never lifts off by itself
	const auto shape = circle_shape(JELLY_RADIUS, JELLY_HULL_POINTS, { JELLY_MASS, JELLY_STIFFNESS, 6, true }).value();
	world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ { 0, -250 }, {} }).value());
	SoftBodyData &body = world.soft_bodies()[0];
	Simulator simulator(world);
	for (int n = 0; n < 600; ++n) {
		simulator.simulate(FRAME);
	}
	CHECK(double(length(measure_frame(body).velocity)) < 1);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.apply_impulse(i, { 0, -60 * body.shape().masses()[i] }); // 60 px/s upwards
	}
	double fastest_up = 0;
	for (int n = 0; n < 30; ++n) {
		simulator.simulate(FRAME);
		fastest_up = std::fmax(fastest_up, -double(measure_frame(body).velocity.y));
	}
	CHECK(fastest_up <= 61);
}
