// SPDX-License-Identifier: MIT
// A number that is none, wherever and whenever it comes in, harms one body at most: it is reported, put right or frozen, and
// whoever it does not touch moves in the same bits.
#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "core/model/rigid_motion.h"
#include "scenes/jelly.h"
#include "scenes/mixed.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr int PILES = 12; ///< 36 batches: two tasks
constexpr int BODIES_A_PILE = 3;
constexpr std::uint32_t VICTIM = 1; ///< in the middle of the first pile
constexpr int STRUCK_TICK = 40; ///< when piles lie on the ground and press

// Piles far from one another on a floor. No two bodies are alike, so that every one is a batch and a step is divided into
// many tasks. Every kind of body is among the victim's neighbors.
WorldData piles(Integrator integrator, FailureResponse response, bool is_free) {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	for (int pile = 0; pile < PILES; ++pile) {
		for (int i = 0; i < BODIES_A_PILE; ++i) {
			BodySettings settings;
			settings.shape_stiffness = 400;
			settings.shape_damping = 4;
			settings.rolling_resistance = Real(0.05);
			settings.restitution = Real(0.1) * Real(i);
			settings.contact_monitor = i == 2;
			settings.integrator = integrator;
			settings.failure_response = response;
			const Real apart = is_free ? Real(3) : Real(0.9);
			world.add_soft_body(SoftBodyData::create(octagon(Real(0.4), 1000 + Real(10 * pile + i), 2), settings,
					{ { Real(20 * pile) + Real(0.05) * Real(i), Real(0.5) + apart * Real(i) }, {} })
							.value());
		}
	}
	return world;
}

enum class Place { POSITION,
	ALL_POSITIONS,
	VELOCITY,
	PREVIOUS,
	ROTATION,
	TOUCH,
	QUEUED_FORCE };
constexpr std::array PLACES = { Place::POSITION, Place::ALL_POSITIONS, Place::VELOCITY, Place::PREVIOUS, Place::ROTATION,
	Place::TOUCH, Place::QUEUED_FORCE };

// As broken code or a broken machine would do it: the public interface refuses all of these.
void strike(SoftBodyData &body, Place place, Real value) {
	switch (place) {
		case Place::POSITION: body.mutable_positions()[2].x = value; break;
		case Place::ALL_POSITIONS: std::ranges::fill(body.mutable_positions(), Vec2{ value, value }); break;
		case Place::VELOCITY: body.mutable_velocities()[0].y = value; break;
		case Place::PREVIOUS: body.mutable_previous_positions()[1].y = value; break;
		case Place::ROTATION: body.set_rotation_memory({ value, 0 }); break;
		case Place::TOUCH: body.touch_memory().approach = value; break;
		case Place::QUEUED_FORCE: body.queue_load({ { value, 0 }, 0 }); break;
	}
}

struct Run {
	/// Of each body, after the tick in which the blow is noticed. Later, those who were near it lie otherwise.
	std::vector<std::vector<Vec2>> positions;
	std::vector<std::vector<Vec2>> ends; ///< of each body in the end
	std::vector<std::uint32_t> reports; ///< places of the bodies that were reset
	int calls = 0; ///< how often tasks were divided in the struck tick
	bool is_finite = true; ///< positions and velocities after every tick
	bool victim_is_frozen = false;
};

/// Strikes the victim before the given call for tasks within the tick; 0: before the tick, negative: never.
Run run(int call, Place place, Real value, Integrator integrator = Integrator::AUTOMATIC,
		FailureResponse response = FailureResponse::RESET, bool is_free = false) {
	WorldData world = piles(integrator, response, is_free);
	Run result;
	int tick = 0;
	Simulator simulator(world, [&](std::size_t count, const std::function<void(std::size_t)> &task) {
		if (tick == STRUCK_TICK && ++result.calls == call) {
			strike(world.soft_bodies()[VICTIM], place, value);
		}
		for (std::size_t i = 0; i < count; ++i) {
			task(i);
		}
	});
	for (; tick < STRUCK_TICK + 60; ++tick) {
		if (tick == STRUCK_TICK && call == 0) {
			strike(world.soft_bodies()[VICTIM], place, value);
		}
		const StepReport report = simulator.simulate(FRAME);
		for (const BodyId id : report.reset_bodies) {
			result.reports.push_back(std::uint32_t(world.find(id) - world.soft_bodies().data()));
		}
		for (const SoftBodyData &body : world.soft_bodies()) {
			result.is_finite &= all_finite(body.positions()) && all_finite(body.velocities());
			if (tick == STRUCK_TICK + 1) {
				result.positions.push_back(copy_of(body.positions()));
			}
		}
	}
	for (const SoftBodyData &body : world.soft_bodies()) {
		result.ends.push_back(copy_of(body.positions()));
	}
	result.victim_is_frozen = world.soft_bodies()[VICTIM].is_frozen();
	return result;
}

/// A struck run against one in which nothing happens.
void check_harm(const Run &struck, const Run &sound) {
	CHECK(struck.is_finite);
	// What comes in after the body was last looked at in this tick is found in the next, and each time once.
	CHECK(struck.reports.size() <= 1);
	CHECK(std::ranges::all_of(struck.reports, [](std::uint32_t place) { return place == VICTIM; }));
	for (std::size_t i = 0; i < sound.positions.size(); ++i) {
		CAPTURE(i);
		if (i >= BODIES_A_PILE) {
			CHECK(identical(struck.positions[i], sound.positions[i]));
			CHECK(identical(struck.ends[i], sound.ends[i]));
		} else {
			// Who touches it feels that it has another shape now, and no more; the struck one may have turned.
			CHECK(largest_distance(struck.positions[i], sound.positions[i]) < (i == VICTIM ? 0.8 : 0.1));
		}
	}
}

} // namespace

TEST_CASE("a number that is none, in any part of a body and before any part of a tick, harms that body alone") {
	const Run sound = run(-1, Place::POSITION, 0);
	CHECK(sound.reports.empty());
	REQUIRE(sound.calls >= 8); // or else few points of a tick are tried
	for (const Place place : PLACES) {
		for (int call = 0; call <= sound.calls; call += call < 12 ? 1 : 5) {
			CAPTURE(int(place));
			CAPTURE(call);
			check_harm(run(call, place, call % 2 == 0 ? NOT_A_NUMBER : INFINITE), sound);
		}
	}
}

TEST_CASE("likewise for bodies that touch nothing else, and for every integrator" * doctest::test_suite("slow")) {
	for (int i = 0; i < INTEGRATOR_COUNT; ++i) {
		for (const bool is_free : { true, false }) {
			const Integrator integrator = Integrator(i);
			const Run sound = run(-1, Place::POSITION, 0, integrator, FailureResponse::RESET, is_free);
			for (const Place place : PLACES) {
				CAPTURE(i);
				CAPTURE(int(place));
				check_harm(run(0, place, NOT_A_NUMBER, integrator, FailureResponse::RESET, is_free), sound);
			}
		}
	}
}

TEST_CASE("a body that is to be frozen when it fails is, is told of once, and goes on when it is let go") {
	const Run struck = run(0, Place::POSITION, NOT_A_NUMBER, Integrator::AUTOMATIC, FailureResponse::FREEZE);
	CHECK(struck.reports == std::vector<std::uint32_t>{ VICTIM });
	CHECK(struck.victim_is_frozen);
	CHECK_FALSE(run(0, Place::POSITION, NOT_A_NUMBER).victim_is_frozen);

	WorldData world = piles(Integrator::AUTOMATIC, FailureResponse::FREEZE, true);
	Simulator simulator(world);
	SoftBodyData &body = world.soft_bodies()[VICTIM];
	strike(body, Place::VELOCITY, INFINITE);
	CHECK(simulator.simulate(FRAME).reset_bodies.size() == 1);
	const std::vector<Vec2> there = copy_of(body.positions());
	for (int tick = 0; tick < 5; ++tick) {
		CHECK(simulator.simulate(FRAME).reset_bodies.empty());
	}
	CHECK(identical(body.positions(), there));
	body.set_frozen(false);
	for (int tick = 0; tick < 15; ++tick) {
		CHECK(simulator.simulate(FRAME).reset_bodies.empty());
	}
	// A quarter of a second of free fall: g t² / 2 = 0.307 m, and g t h / 2 = 0.005 m more for the discrete method.
	CHECK(double(there[0].y - body.positions()[0].y) == doctest::Approx(0.307).epsilon(0.03));
}

TEST_CASE("a body that has lost all its numbers comes back where it was before the step, or beside its pins, not at the origin") {
	for (const bool is_pinned : { false, true }) {
		WorldData world;
		world.set_gravity({ 0, 0 });
		world.add_soft_body(SoftBodyData::create(octagon(Real(0.4), 1000, 2), {}, { { 30, 40 }, {} }).value());
		SoftBodyData &body = world.soft_bodies()[0];
		body.set_pinned(3, is_pinned);
		Simulator simulator(world);
		simulator.simulate(FRAME);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			if (i != 3) { // one point is left
				body.mutable_positions()[i] = { NOT_A_NUMBER, NOT_A_NUMBER };
			}
		}
		simulator.simulate(FRAME);
		CHECK(all_finite(body.positions()));
		CHECK(distance(body.positions()[3], { 30, 40 }) < 1); // a diameter and rounding
	}
}

TEST_CASE("a body torn off from several pins comes back amid all of them") {
	WorldData world;
	world.set_gravity({ 0, 0 });
	const auto shape = octagon(Real(0.4), 1000, 2);
	world.add_soft_body(SoftBodyData::create(shape, {}, { { 30, 40 }, {} }).value());
	SoftBodyData &body = world.soft_bodies()[0];
	for (const std::uint32_t pin : { 0, 2, 4 }) {
		body.set_pinned(pin, true);
	}
	body.mutable_positions()[3].x = NOT_A_NUMBER;
	CHECK(Simulator(world).simulate(FRAME).reset_bodies.size() == 1);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		CHECK(distance(body.positions()[i], shape->rest_positions()[i] + Vec2{ 30, 40 }) < 1e-3);
	}
}

// Found by fuzz_world: a body came back where there are no numbers.
TEST_CASE("a body whose pins were put to the end of all numbers comes back where numbers are") {
	constexpr Real END = std::numeric_limits<Real>::max();
	WorldData world;
	world.add_soft_body(SoftBodyData::create(octagon(Real(0.4), 1000, 2), {}, { { 30, 40 }, {} }).value());
	SoftBodyData &body = world.soft_bodies()[0];
	for (const std::uint32_t pin : { 0, 2 }) {
		REQUIRE_FALSE(body.set_pinned(pin, true));
		REQUIRE_FALSE(body.set_point(pin, { END, END }, {}));
	}
	Simulator simulator(world);
	for (int tick = 0; tick < 5; ++tick) {
		simulator.simulate(FRAME);
		CHECK(all_finite(body.positions()));
		CHECK(all_finite(body.velocities()));
	}
}

TEST_CASE("a body that is put right has forgotten what it was pushed through, and by itself") {
	WorldData world;
	world.set_gravity({ 0, 0 });
	BodySettings settings;
	settings.self_collision = true;
	world.add_soft_body(SoftBodyData::create(octagon(Real(0.4), 1000, 2), settings, { { 30, 40 }, {} }).value());
	SoftBodyData &body = world.soft_bodies()[0];
	body.last_valid_hull().assign(body.hull().begin(), body.hull().end());
	body.touch_memory().touching = true;
	body.mutable_velocities()[3].x = NOT_A_NUMBER;
	CHECK(Simulator(world).simulate(FRAME).reset_bodies.size() == 1);
	CHECK(body.last_valid_hull().empty());
	CHECK_FALSE(body.touch_memory().touching);
}

// Found by fuzz_state: a body that came back in its rest shape came back 1e38 times as large.
TEST_CASE("a body that has lost its numbers comes back in its size, whatever it remembers of its rotation") {
	for (const Vec2 memory : { Vec2{ Real(1e30), 0 }, Vec2{ 0, 0 }, Vec2{ 0, 1 } }) {
		WorldData world;
		world.set_gravity({ 0, 0 });
		const auto shape = octagon(Real(0.4), 1000, 2);
		world.add_soft_body(SoftBodyData::create(shape, {}, { { 30, 40 }, {} }).value());
		SoftBodyData &body = world.soft_bodies()[0];
		body.mutable_positions()[2].x = NOT_A_NUMBER;
		body.set_rotation_memory({ memory.x, memory.y });
		CHECK(Simulator(world).simulate(FRAME).reset_bodies.size() == 1);
		for (std::uint32_t i = 1; i < body.point_count(); ++i) {
			const double rest = distance(shape->rest_positions()[i], shape->rest_positions()[0]);
			CHECK(distance(body.positions()[i], body.positions()[0]) == doctest::Approx(rest).epsilon(1e-4)); // roundings at 50
		}
	}
}

TEST_CASE("every entrance refuses what is no number, by name, and the next step is the same to the last bit") {
	WorldData world = piles(Integrator::AUTOMATIC, FailureResponse::RESET, false);
	WorldData untouched = piles(Integrator::AUTOMATIC, FailureResponse::RESET, false);
	Simulator simulator(world);
	Simulator other(untouched);
	SoftBodyData &body = world.soft_bodies()[VICTIM];
	for (const Real bad : { NOT_A_NUMBER, INFINITE, -INFINITE }) {
		const Vec2 vector{ 0, bad };
		const std::array<Status, 17> refusals = { body.add_external_force(0, vector), body.apply_impulse(0, vector),
			body.set_point(0, vector, {}), body.set_point(0, {}, vector), body.teleport({ vector, {} }, {}),
			body.teleport({}, { {}, { bad, 0 } }), body.set_acceleration(vector), apply_rigid_impulse(body, vector, {}),
			apply_rigid_impulse(body, {}, vector), apply_angular_impulse(body, bad), add_rigid_force(body, vector, {}),
			add_torque(body, bad), set_linear_velocity(body, vector), set_angular_velocity(body, bad),
			world.set_gravity(vector), world.set_length_unit(bad), world.add_border({ { vector, { 0, 1 } }, {} }) };
		for (std::size_t i = 0; i < refusals.size(); ++i) {
			CAPTURE(i);
			REQUIRE(refusals[i]);
			CHECK_FALSE(refusals[i]->name.empty());
		}
		CHECK(simulator.simulate(bad).refused);
	}
	for (int tick = 0; tick < 10; ++tick) {
		simulator.simulate(FRAME);
		other.simulate(FRAME);
	}
	CHECK(hash_of_state(world) == hash_of_state(untouched));
}
