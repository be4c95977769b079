// SPDX-License-Identifier: MIT
// Two bodies part with their restitution, and pay for it with their wobble.
#include "core/base/constants.h"
#include "core/collision/pair_bounce.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60;
constexpr Real SPEED = 2; // of each

SoftBodyData ball(double mass, double restitution, Vec2 center, Vec2 velocity, double stiffness = 1000) {
	const double k = stiffness * mass;
	const auto shape = circle_shape(Real(0.5), 8, { Real(mass), Real(k), Real(0.05 * std::sqrt(k * mass / 9)), true }).value();
	BodySettings settings;
	settings.shape_stiffness = Real(0.4 * k);
	settings.shape_damping = Real(0.5 * std::sqrt(0.4 * k * mass / 9));
	settings.restitution = Real(restitution);
	settings.friction = 0;
	SoftBodyData body = thesis_body(shape, settings, { center, {} });
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
	return body;
}

struct Sums {
	Vec2 momentum;
	double spin = 0;
	double energy = 0;
};

Sums sums_of(const WorldData &world) {
	Sums sums;
	for (const SoftBodyData &body : world.soft_bodies()) {
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			sums.momentum += body.velocities()[i] * body.shape().masses()[i];
			sums.spin += double(body.shape().masses()[i]) * cross(body.positions()[i], body.velocities()[i]);
		}
		sums.energy += measure_energy(body, {}).total();
	}
	return sums;
}

double parting_speed(const WorldData &world) {
	const BodyFrame a = measure_frame(world.soft_bodies()[0]);
	const BodyFrame b = measure_frame(world.soft_bodies()[1]);
	const Vec2 line = a.center - b.center;
	return double(dot(a.velocity - b.velocity, line * (1 / length(line))));
}

} // namespace

TEST_CASE("bodies part with at least their restitution, never gain energy, and keep momentum and spin") {
	for (const double mass : { 1.0, 4.0, 100.0 }) {
		for (const double restitution : { 0.0, 0.5, 0.9, 1.0 }) {
			for (const double offset : { 0.0, 0.2 }) {
				CAPTURE(mass);
				CAPTURE(restitution);
				CAPTURE(offset);
				WorldData world;
				world.add_soft_body(ball(1, restitution / 2, { -1, Real(offset) }, { SPEED, 0 }));
				world.add_soft_body(ball(mass, restitution / 2, { 1, 0 }, { -SPEED, 0 }));
				Simulator simulator(world);
				const Sums before = sums_of(world);
				double highest = 0;
				for (int i = 0; i < 60; ++i) {
					simulator.simulate(FRAME);
					highest = std::max(highest, sums_of(world).energy);
				}
				const Sums after = sums_of(world);
				// Seen from each other the centers approach at an angle; the share across it slides past.
				const double approach = 2 * SPEED * std::cos(std::asin(offset));
				CHECK(parting_speed(world) >= 0.8 * restitution * approach); // as far as there is energy for it
				CHECK(parting_speed(world) <= std::max(restitution, 0.8) * approach * 1.1); // or what springs return
				CHECK(highest <= before.energy * 1.03);
				CHECK(double(length(after.momentum - before.momentum)) <= 1e-5 * double(mass));
				CHECK(std::abs(after.spin - before.spin) <= 0.01 * SPEED); // of 2 m/s at 1 m
			}
		}
	}
}

TEST_CASE("an absorbent body takes its restitution from that of the other") {
	std::array<double, 3> speeds{};
	for (const int absorbent : { 0, 1, 2 }) { // the same sum, once without an absorbent body; 2 takes all away
		WorldData world;
		world.add_soft_body(ball(1, absorbent == 0 ? 0.9 : 1, { -1, 0 }, { SPEED, 0 }));
		SoftBodyData other = ball(1, absorbent == 0 ? 0 : absorbent == 1 ? 0.1 : 1, { 1, 0 }, { -SPEED, 0 });
		BodySettings settings = other.settings();
		settings.absorbent = absorbent != 0;
		REQUIRE(!other.set_settings(settings));
		world.add_soft_body(std::move(other));
		Simulator simulator(world);
		for (int i = 0; i < 60; ++i) {
			simulator.simulate(FRAME);
		}
		speeds[std::size_t(absorbent)] = parting_speed(world);
	}
	CHECK(speeds[1] == doctest::Approx(speeds[0]).epsilon(0.02));
	CHECK(speeds[2] < 0.9 * speeds[0]);
}

TEST_CASE("slow touches do not bounce, and one that lasts is forgotten") {
	const auto moving = [](Real place, Real speed) {
		SolverBody body;
		body.inverse_mass = 1;
		body.restitution = 1;
		body.pull = 10;
		body.mass_center = { place, 0 };
		body.mass_velocity = { speed, 0 };
		return body;
	};
	constexpr Real H = Real(1) / 40; // two of these make the threshold 0.5
	const SolverBody a = moving(-1, Real(-0.05));
	const SolverBody b = moving(1, Real(0.05));
	PairTouch slow{ true, Real(0.4) };
	follow_pair_bounce(a, b, {}, slow, H);
	CHECK(slow.missing == 0);
	CHECK(slow.ended);
	PairTouch fast{ true, 3 };
	follow_pair_bounce(a, b, {}, fast, H);
	CHECK(fast.missing == doctest::Approx(2.9));
	PairTouch lasting{ true, 3 };
	for (int i = 0; i < 120; ++i) { // 3 s in which contacts hold the two still
		follow_pair_bounce(a, b, { Real(-1e-4), 0 }, lasting, H);
	}
	CHECK(lasting.touching);
	CHECK(lasting.approach == 0);
}

TEST_CASE("an approach counts with what gravity adds in the substep, but not with the weight that a contact bears") {
	SolverBody above;
	above.inverse_mass = 1;
	above.restitution = 1;
	above.pull = 10;
	above.acceleration = { 0, -10 };
	above.mass_center = { 0, 1 };
	SolverBody floor = above; // pinned
	floor.inverse_mass = 0;
	floor.acceleration = {};
	floor.mass_center = {};
	constexpr Real H = Real(1) / 100;
	PairTouch falling;
	above.mass_velocity = { 0, -3 };
	follow_pair_bounce(above, floor, { 0, Real(3.1) }, falling, H);
	CHECK(falling.approach == doctest::Approx(3.1));
	PairTouch resting;
	above.mass_velocity = {};
	follow_pair_bounce(above, floor, { 0, 5 }, resting, H); // 50 bodies lie on it
	CHECK(resting.approach == 0);
	CHECK(resting.touching);
}

TEST_CASE("jumping balls take the same bits with any number of threads, though they meet and part all the time" *
		doctest::test_suite("threads")) {
	const auto run = [](ParallelFor parallel_for) {
		WorldData world;
		for (int i = 0; i < 60; ++i) {
			const Real side = i % 2 == 0 ? Real(1) : Real(-1);
			world.add_soft_body(ball(1, 1, { Real(1.3) * Real(i % 10), Real(1.3) * Real(i / 10) }, { 3 * side, side * Real(i % 7) }));
		}
		Simulator simulator(world, parallel_for);
		for (int i = 0; i < 120; ++i) {
			simulator.simulate(FRAME);
		}
		return sums_of(world);
	};
	const Sums reference = run({});
	for (const std::size_t threads : { 2, 8 }) {
		const Sums sums = run(on_threads(threads));
		CHECK(sums.momentum == reference.momentum);
		CHECK(sums.energy == reference.energy);
	}
}

TEST_CASE("a touch remembers the fastest approach above the threshold, and forgets it at rest: 20,000 random pairs and touches") {
	Random random(31);
	int changed = 0;
	int at_rest = 0;
	for (int trial = 0; trial < 20'000; ++trial) {
		SolverBody a;
		SolverBody b;
		for (SolverBody *body : { &a, &b }) {
			body->inverse_mass = random.real(0.1, 2);
			body->restitution = Real(0.3);
			body->mass_center = random.vector(1);
			const double fast = random.chance(0.5) ? 0.2 : 3;
			body->mass_velocity = random.vector(fast);
			body->acceleration = { 0, random.real(-10, 0) };
			body->pull = Real(9.81);
		}
		const Real h = Real(1) / 240;
		PairTouch touch;
		touch.touching = random.chance(0.8);
		touch.approach = random.chance(0.5) ? Real(0) : random.real(0.1, 2);
		const PairTouch before = touch;

		// By definition: along the line of the centers, with what their accelerations add in the substep.
		const double x = double(a.mass_center.x) - b.mass_center.x;
		const double y = double(a.mass_center.y) - b.mass_center.y;
		const double along_x = (double(a.mass_velocity.x) - b.mass_velocity.x) + (double(a.acceleration.x) - b.acceleration.x) * h;
		const double along_y = (double(a.mass_velocity.y) - b.mass_velocity.y) + (double(a.acceleration.y) - b.acceleration.y) * h;
		const double approach = -(along_x * x + along_y * y) / std::hypot(x, y);
		const double threshold = RESTITUTION_SUBSTEPS * h * 9.81;
		double remembered = before.touching ? double(before.approach) : 0;
		if (before.touching && std::abs(approach) <= threshold) {
			remembered *= 1 - h / BOUNCE_MEMORY;
		}
		remembered = std::max(remembered, approach);
		remembered = remembered > threshold ? remembered : 0;
		if (std::abs(std::abs(approach) - threshold) < 1e-4 || std::abs(remembered - threshold) < 1e-4) {
			continue; // either is right
		}
		follow_pair_bounce(a, b, { 0, 1 }, touch, h);
		REQUIRE(touch.touching);
		REQUIRE(touch.missing == 0);
		REQUIRE(double(touch.approach) == doctest::Approx(remembered).epsilon(1e-4));
		changed += before.touching && before.approach == 0 && touch.approach > 0;
		at_rest += before == touch;
	}
	CHECK(changed > 1000);
	CHECK(at_rest > 1000);
}
