// SPDX-License-Identifier: MIT
// Claims about the integrator: its discrete update, its frequency shift, its order, its stability limit.
#include "core/dynamics/energy.h"
#include "core/dynamics/integrators/lane_steps.h"
#include "core/dynamics/simulator.h"
#include "dynamics/replay.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

// One step without gravity or external forces.
void step(SoftBodyData &body, double h) {
	IntegratorWorkspace workspace;
	workspace.begin_body(body.point_count());
	const std::vector<Vec2> none(body.point_count());
	step_semi_implicit_euler<Real>(lanes_of(body), { {}, none, Real(h) }, workspace);
}

// Mean period of the stretch, from the times at which it crosses zero downwards.
double measured_period(SoftBodyData &body, double h, int periods) {
	double first = 0;
	int crossings = 0;
	double before = stretch(body);
	for (int n = 1;; ++n) {
		step(body, h);
		const double now = stretch(body);
		if (before > 0 && now <= 0) {
			const double time = (n - now / (now - before)) * h;
			if (crossings == 0) {
				first = time;
			}
			if (crossings++ == periods) {
				return (time - first) / periods;
			}
		}
		before = now;
	}
}

constexpr double MASS = 0.5;
constexpr double STIFFNESS = 100;
const double OMEGA = std::sqrt(2 * STIFFNESS / MASS); // reduced mass m/2

SoftBodyData oscillator(double damping = 0, double amplitude = 0.25) {
	SoftBodyData body = two_masses(Real(MASS), 1, Real(STIFFNESS), Real(damping));
	body.set_point(1, { Real(1 + amplitude), 0 }, {});
	return body;
}

} // namespace

TEST_CASE("one step is v += h F(x, v) / m, then x += h v with the new v") {
	Random random(81);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		SoftBodyData body = random_body(random, *model, 0.2, 3);
		body.set_pinned(4, true);
		const Vec2 gravity = random.vector(10);
		std::vector<Vec2> external(body.point_count());
		external[1] = random.vector(20);
		const double h = double(random.real(0.001, 0.02));
		ReplayState state(body);
		auto expected = replay_forces(body, to_complex(gravity), state);
		expected[1] += to_complex(external[1]);
		IntegratorWorkspace workspace;
		workspace.begin_body(body.point_count());
		step_semi_implicit_euler<Real>(lanes_of(body), { gravity, external, Real(h) }, workspace);
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			if (i != 4) {
				state.w[i] += h / double(body.shape().masses()[i]) * expected[i];
				state.z[i] += h * state.w[i];
			}
			// Forces up to 2600 N are good to 100 eps of that; masses are at least 0.2 kg, h at most 0.02 s.
			CHECK(distance(body.velocities()[i], to_vec2(state.w[i])) <= 100 * EPSILON * 2600 * 0.02 / 0.2);
			CHECK(distance(body.positions()[i], to_vec2(state.z[i])) <= 100 * EPSILON * 2600 * 0.02 * 0.02 / 0.2 + 2 * EPSILON);
		}
	}
}

TEST_CASE("a pinned point does not move, whatever pulls at it") {
	SoftBodyData body = oscillator();
	body.set_pinned(0, true);
	for (int n = 0; n < 100; ++n) {
		step(body, 0.01);
	}
	CHECK(body.positions()[0] == Vec2{ 0, 0 });
	CHECK(body.velocities()[0] == Vec2{});
	CHECK(std::abs(stretch(body)) > 1e-6);
}

TEST_CASE("two equal masses oscillate at sqrt(2k/m)") {
	// Small steps: the shift of the period is (ωh)²/24, here 1e-4.
	SoftBodyData body = oscillator();
	const double h = 0.05 / OMEGA;
	const double period = measured_period(body, h, 20);
	CHECK(std::abs(period * OMEGA / (2 * std::numbers::pi) - 1) <= 1.1 * 0.05 * 0.05 / 24);
}

TEST_CASE("large steps shorten the period to cos(ωd h) = 1 - (ωh)²/2") {
	for (const double wh : { 0.2, 0.5, 1.0, 1.5 }) {
		SoftBodyData body = oscillator();
		const double period = measured_period(body, wh / OMEGA, 200);
		const double angle = std::acos(1 - wh * wh / 2);
		// The crossing is interpolated linearly within a step: up to wh³/10 radians at each end of 200 periods.
		CHECK(std::abs(period * angle / wh * OMEGA / (2 * std::numbers::pi) - 1) <= 0.2 * wh * wh * wh / (400 * std::numbers::pi) + 200 * EPSILON);
	}
}

TEST_CASE("a damped oscillator follows the discrete solution, whose amplitude decays by sqrt(1 - 2hc/m) a step") {
	const double damping = 0.4;
	const double h = 0.2 / OMEGA;
	SoftBodyData body = oscillator(damping);
	const double rate = 2 * damping / MASS;
	// x'' - trace x' + det x = 0 for the step matrix of v += h (-ω² x - γ v), x += h v.
	const double trace = 2 - h * rate - h * h * OMEGA * OMEGA;
	const double determinant = 1 - h * rate;
	double before = 0.25; // at rest: the step before the first would not have moved it
	double now = 0.25 - h * h * OMEGA * OMEGA * 0.25;
	step(body, h);
	for (int n = 1; n < 300; ++n) {
		CHECK(std::abs(stretch(body) - now) <= 200 * EPSILON); // lengths of 1 are rounded in each of 300 steps
		const double next = trace * now - determinant * before;
		before = now;
		now = next;
		step(body, h);
	}
}

TEST_CASE("damping decays like exp(-ct/m), to first order in the step") {
	const double damping = 0.4;
	double error_before = 0;
	for (const double wh : { 0.04, 0.02, 0.01 }) {
		SoftBodyData body = oscillator(damping);
		const double h = wh / OMEGA;
		const int steps = int(std::lround(3 / h / OMEGA * 2)); // six radians
		for (int n = 0; n < steps; ++n) {
			step(body, h);
		}
		const double t = steps * h;
		const double decay = damping / MASS;
		const double damped = std::sqrt(OMEGA * OMEGA - decay * decay);
		const double exact = 0.25 * std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t));
		const double error = std::abs(stretch(body) - exact);
		CHECK(error <= 0.25 * wh);
		if (error_before > 0) {
			CHECK(error / error_before == doctest::Approx(0.5).epsilon(0.05)); // order 1
		}
		error_before = error;
	}
}

TEST_CASE("without damping the step is stable just inside hω = 2 and unstable just outside") {
	for (const bool inside : { true, false }) {
		const double wh = inside ? 1.99 : 2.01;
		BodySettings settings;
		settings.substeps = 1;
		WorldData world;
		world.set_sleeping(false);
		SoftBodyData made = two_masses(Real(MASS), 1, Real(STIFFNESS), 0, settings);
		made.set_point(1, { Real(1.001), 0 }, {});
		const BodyId id = world.add_soft_body(std::move(made));
		Simulator simulator(world);
		const Real dt = Real(wh / OMEGA);
		CHECK(simulator.plan(*world.find(id), dt).safe == inside);
		double largest = 0;
		for (int n = 0; n < (inside ? 20000 : 40); ++n) {
			simulator.simulate(dt);
			largest = std::fmax(largest, std::abs(stretch(*world.find(id))));
		}
		if (inside) {
			// The ellipse of the discrete orbit is longer than its start by 1 / sqrt(1 - (hω/2)²) = 10.
			CHECK(largest <= 0.001 * 11);
		} else {
			CHECK(largest > 0.1); // grows by 1.22 a step: 1.22^40 = 2800 while the spring is linear
		}
	}
}

TEST_CASE("a body thrown through empty space keeps its momentum, its spin and, undamped, its energy") {
	BodySettings settings;
	settings.shape_stiffness = 40;
	SoftBodyData body = thesis_body(thesis_shape(100), settings);
	Random random(82);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 p = body.positions()[i];
		body.set_point(i, p + random.vector(0.05), Vec2{ 1, 2 } + perpendicular(p) * Real(3));
	}
	const Momentum before = measure_momentum(body);
	const double energy = measure_energy(body, {}).total();
	const double h = 1.0 / 600;
	double drift = 0;
	for (int n = 0; n < 6000; ++n) {
		step(body, h);
		drift = std::fmax(drift, std::abs(measure_energy(body, {}).total() - energy) / energy);
	}
	const Momentum after = measure_momentum(body);
	// 6000 additions of rounded forces; they behave like a random walk, far below their sum.
	const double tolerance = 6000 * EPSILON;
	CHECK(std::abs(after.linear_x - before.linear_x) <= tolerance);
	CHECK(std::abs(after.linear_y - before.linear_y) <= tolerance);
	// The origin is 20 m behind at the end, so is the rounding of the velocity.
	CHECK(std::abs(after.angular - before.angular) <= tolerance * 22);
	// A symplectic method's energy swings by at most hω/2 of the part that oscillates, without drift.
	CHECK(drift <= 0.05);
}
