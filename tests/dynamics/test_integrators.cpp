// SPDX-License-Identifier: MIT
// Claims about the integrators: their order, their limits, what they conserve, and their exact updates.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "scenes/deformations.h"
#include "scenes/integrator_facts.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

const std::vector<Integrator> ALL = { Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER,
	Integrator::MIDPOINT, Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET, Integrator::XPBD };

BodySettings stepped_by(Integrator integrator, int substeps = 1) {
	BodySettings settings;
	settings.integrator = integrator;
	settings.substeps = substeps;
	return settings;
}

// Two masses of 1 kg on a spring of k [N/m] oscillate at ω = sqrt(2k) with the damping rate 2c; the
// stretch obeys s'' = -2k s - 2c s'. Starts at rest, stretched by `start`.
WorldData oscillator(Integrator integrator, double k, double c, double start, int substeps = 1) {
	WorldData world;
	world.set_sleeping(false); // however small the motion
	SoftBodyData body = two_masses(1, 1, Real(k), Real(c), stepped_by(integrator, substeps));
	body.set_point(1, { Real(1 + start), 0 }, {});
	world.add_soft_body(std::move(body));
	return world;
}

double stretch_after(Integrator integrator, double k, double c, double start, double time, int steps) {
	WorldData world = oscillator(integrator, k, c, start);
	Simulator simulator(world);
	for (int i = 0; i < steps; ++i) {
		simulator.simulate(Real(time / steps));
	}
	return stretch(world.soft_bodies()[0]);
}

double exact_stretch(double k, double c, double start, double time) {
	const double decay = c; // half the rate 2c
	const double omega = std::sqrt(2 * k - decay * decay);
	return start * std::exp(-decay * time) * (std::cos(omega * time) + decay / omega * std::sin(omega * time));
}

} // namespace

TEST_CASE("halving the step divides an integrator's error by 2 to its order") {
	// Float rounds at about 1e-7 of the length; there only the low orders can be seen.
	const bool is_double = sizeof(Real) == 8;
	for (const Integrator integrator : ALL) {
		const IntegratorFacts &facts = integrator_facts(integrator);
		if ((!is_double && facts.order > 1) || integrator == Integrator::XPBD) {
			continue; // XPBD reaches its order only at tiny steps; see the next case
		}
		CAPTURE(std::string(facts.name));
		const double exact = exact_stretch(50, 0.3, 0.1, 1);
		// Fine enough for the leading error term, coarse enough to stand above rounding.
		const int steps = facts.order == 4 ? 100 : 2000;
		const double coarse = std::abs(stretch_after(integrator, 50, 0.3, 0.1, 1, steps) - exact);
		const double fine = std::abs(stretch_after(integrator, 50, 0.3, 0.1, 1, 2 * steps) - exact);
		CHECK(std::log2(coarse / fine) == doctest::Approx(facts.order).epsilon(0.05));
	}
}

TEST_CASE("XPBD converges to the same motion, at order 2 where damping is not strong") {
	// Every correction is a difference of positions over h, so rounding grows as 1/h: in float it stands above
	// the truncation of steps small enough to show the order.
	const bool is_double = sizeof(Real) == 8;
	const double exact = exact_stretch(50, 0.3, 0.1, 1);
	const double coarse = std::abs(stretch_after(Integrator::XPBD, 50, 0.3, 0.1, 1, is_double ? 4000 : 250) - exact);
	const double fine = std::abs(stretch_after(Integrator::XPBD, 50, 0.3, 0.1, 1, is_double ? 8000 : 500) - exact);
	CHECK(fine < coarse);
	CHECK(fine < (is_double ? 0.002 : 0.03));
	if (is_double) {
		CHECK(std::log2(coarse / fine) == doctest::Approx(2).epsilon(0.1));
	}
}

TEST_CASE("an undamped oscillator stays bounded just inside its limit and explodes just outside") {
	for (const Integrator integrator :
			{ Integrator::SEMI_IMPLICIT_EULER, Integrator::VELOCITY_VERLET, Integrator::RUNGE_KUTTA_4 }) {
		const IntegratorFacts &facts = integrator_facts(integrator);
		CAPTURE(std::string(facts.name));
		for (const double factor : { 0.99, 1.01 }) {
			CAPTURE(factor);
			// h = 1/60, so ω = limit · 60 and k = ω²/2. Small amplitude keeps the spring away from zero length.
			const double omega = facts.undamped_limit * factor * 60;
			WorldData world = oscillator(integrator, omega * omega / 2, 0, 1e-3);
			Simulator simulator(world);
			double largest = 0;
			for (int i = 0; i < 400; ++i) {
				simulator.simulate(Real(1) / 60);
				largest = std::fmax(largest, std::abs(stretch(world.soft_bodies()[0])));
			}
			// Inside: near the limit the orbit is long and thin, 1/sqrt(1 - 0.99²) ≈ 7 starts at most.
			if (factor < 1) {
				CHECK(largest < 0.02);
			} else {
				CHECK(largest > 0.1);
			}
		}
	}
}

TEST_CASE("explicit Euler, midpoint and Heun gain energy without damping at the predicted rate") {
	struct Row {
		Integrator integrator;
		double gain; ///< factor on the energy a step at hω = 0.2
	};
	for (const Row &row : { Row{ Integrator::EXPLICIT_EULER, 1 + 0.04 }, Row{ Integrator::MIDPOINT, 1 + 0.0016 / 4 },
				 Row{ Integrator::HEUN, 1 + 0.0016 / 4 } }) {
		CAPTURE(std::string(integrator_facts(row.integrator).name));
		const double omega = 0.2 * 60;
		const int steps = 157; // five periods
		WorldData world = oscillator(row.integrator, omega * omega / 2, 0, 1e-3);
		Simulator simulator(world);
		const double start = measure_energy(world.soft_bodies()[0], {}).total();
		for (int i = 0; i < steps; ++i) {
			simulator.simulate(Real(1) / 60);
		}
		const double measured = std::log(measure_energy(world.soft_bodies()[0], {}).total() / start) / steps;
		// In float a stretch of 1e-3 on a length of 1 is known to 1e-4, its energy to 2e-4: over 157 steps 1e-6 a step.
		CHECK(measured == doctest::Approx(std::log(row.gain)).epsilon(0.02));
	}
}

TEST_CASE("every update is the one its formula says") {
	// Independent replay in one variable: the stretch s and its rate u of the damped oscillator.
	const double k = 40;
	const double c = 0.4;
	const double h = 0.01;
	const auto slope = [&](double s, double u) { return -2 * k * s - 2 * c * u; };
	for (const Integrator integrator : ALL) {
		CAPTURE(std::string(integrator_facts(integrator).name));
		double s = 0.1;
		double u = 0;
		double a = slope(s, u); // Verlet's last acceleration
		WorldData world = oscillator(integrator, k, c, s, 20);
		Simulator simulator(world);
		simulator.simulate(Real(20 * h));
		for (int i = 0; i < 20; ++i) {
			switch (integrator) {
				case Integrator::EXPLICIT_EULER: {
					const double old = u;
					u += h * slope(s, u);
					s += h * old;
				} break;
				case Integrator::SEMI_IMPLICIT_EULER:
					u += h * slope(s, u);
					s += h * u;
					break;
				case Integrator::MIDPOINT: {
					const double sm = s + h / 2 * u;
					const double um = u + h / 2 * slope(s, u);
					s += h * um;
					u += h * slope(sm, um);
				} break;
				case Integrator::HEUN: {
					const double se = s + h * u;
					const double ue = u + h * slope(s, u);
					const double mean = (slope(s, u) + slope(se, ue)) / 2;
					s += h * (u + ue) / 2;
					u += h * mean;
				} break;
				case Integrator::RUNGE_KUTTA_4: {
					const double s1 = u, u1 = slope(s, u);
					const double s2 = u + h / 2 * u1, u2 = slope(s + h / 2 * s1, u + h / 2 * u1);
					const double s3 = u + h / 2 * u2, u3 = slope(s + h / 2 * s2, u + h / 2 * u2);
					const double s4 = u + h * u3, u4 = slope(s + h * s3, u + h * u3);
					s += h / 6 * (s1 + 2 * s2 + 2 * s3 + s4);
					u += h / 6 * (u1 + 2 * u2 + 2 * u3 + u4);
				} break;
				case Integrator::VELOCITY_VERLET: {
					const double half = u + h / 2 * a;
					s += h * half;
					a = slope(s, half + h / 2 * a);
					u = half + h / 2 * a;
				} break;
				case Integrator::XPBD: {
					// One spring is one constraint: a linearly implicit Euler step to the share of the substep, and on from there.
					const double share = double(simulator.plan(world.soft_bodies()[0], Real(20 * h)).implicit_share);
					const double part = share * h;
					const double predicted = s + part * u;
					const double impulse = (k * part * part * predicted + c * part * (predicted - s)) / (1 + 2 * (k * part * part + c * part));
					const double mean = u - 2 * impulse / part;
					s += h * mean;
					u += (mean - u) / share;
				} break;
				case Integrator::AUTOMATIC:
					break;
			}
		}
		// Rounding of 20 steps on a length of about 1.
		CHECK(std::abs(stretch(world.soft_bodies()[0]) - s) < 200 * EPSILON);
	}
}

TEST_CASE("every integrator keeps the momentum of a free body to rounding") {
	Random random(11);
	for (const Integrator integrator : ALL) {
		CAPTURE(std::string(integrator_facts(integrator).name));
		BodySettings settings = stepped_by(integrator, 8);
		settings.shape_stiffness = 40;
		settings.shape_damping = Real(0.3);
		settings.pressure_stiffness = 50;
		settings.inflation = Real(1.2);
		WorldData world;
		SoftBodyData body = thesis_body(thesis_shape(100, Real(0.2)), settings);
		deform(body, Deformation::FLATTENED, random);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], Vec2{ 1, 2 } + random.vector(1));
		}
		const Momentum before = measure_momentum(body);
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 60; ++i) {
			simulator.simulate(Real(1) / 240);
		}
		const Momentum after = measure_momentum(world.soft_bodies()[0]);
		const double scale = 3000 * EPSILON; // 480 substeps of about 50 force pairs each, random signs
		CHECK(std::abs(after.linear_x - before.linear_x) < scale);
		CHECK(std::abs(after.linear_y - before.linear_y) < scale);
	}
}

TEST_CASE("the symplectic methods keep angular momentum to rounding") {
	// The others keep it to their order only: x × (v + h a) is not what the new x is crossed with.
	Random random(12);
	for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::VELOCITY_VERLET }) {
		CAPTURE(std::string(integrator_facts(integrator).name));
		WorldData world;
		SoftBodyData body = thesis_body(thesis_shape(100), stepped_by(integrator, 8));
		deform(body, Deformation::PUSHED_THROUGH, random);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], random.vector(1));
		}
		const double before = measure_momentum(body).angular;
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 60; ++i) {
			simulator.simulate(Real(1) / 240);
		}
		CHECK(std::abs(measure_momentum(world.soft_bodies()[0]).angular - before) < 3000 * EPSILON);
	}
}

TEST_CASE("a damped body loses energy with every integrator that is stable for it") {
	Random random(13);
	for (const Integrator integrator : ALL) {
		CAPTURE(std::string(integrator_facts(integrator).name));
		WorldData world;
		SoftBodyData body = thesis_body(thesis_shape_with_ratio(100, Real(0.3)), stepped_by(integrator, 64));
		deform(body, Deformation::FLATTENED, random);
		const double start = measure_energy(body, {}).total();
		double last = start;
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 40; ++i) {
			simulator.simulate(Real(1) / 60);
			const double now = measure_energy(world.soft_bodies()[0], {}).total();
			// Each method conserves a nearby energy; at hω = 0.009 they differ by less than 2 %.
			CHECK(now < 1.02 * last + 1e-9);
			last = now;
		}
		CHECK(last < 0.5 * start);
	}
}

TEST_CASE("XPBD never gains energy, for any stiffness, damping and step") {
	Random random(14);
	for (const double k : { 1e2, 1e4, 1e6, 1e8 }) {
		for (const double ratio : { 0.0, 0.05, 5.0 }) {
			CAPTURE(k);
			CAPTURE(ratio);
			WorldData world;
			BodySettings settings = stepped_by(Integrator::XPBD, 4);
			settings.shape_stiffness = Real(0.4 * k);
			settings.pressure_stiffness = Real(2 * k);
			SoftBodyData body = thesis_body(thesis_shape_with_ratio(Real(k), Real(ratio)), settings);
			deform(body, Deformation::CRUMPLED, random);
			const double start = measure_energy(body, {}).total();
			world.add_soft_body(std::move(body));
			Simulator simulator(world);
			for (int i = 0; i < 120; ++i) {
				simulator.simulate(Real(1) / 60);
				CHECK(measure_energy(world.soft_bodies()[0], {}).total() <= 1.01 * start);
			}
		}
	}
}

TEST_CASE("a contact makes Verlet forget the forces it kept") {
	// With a floor under it, a body stepped in 8 substeps must move as if every substep were a step of its own,
	// where nothing is kept.
	const auto run = [](int substeps, int steps) {
		WorldData world;
		world.set_gravity({ 0, Real(9.81) });
		world.add_border({ { { 0, Real(0.5) }, { 0, -1 } }, {} });
		world.add_soft_body(thesis_body(thesis_shape(500, 1), stepped_by(Integrator::VELOCITY_VERLET, substeps)));
		Simulator simulator(world);
		for (int i = 0; i < steps; ++i) {
			simulator.simulate(Real(substeps) / 512); // exact in binary: the same h
		}
		return copy_of(world.soft_bodies()[0].positions());
	};
	// The predicted velocity differs from the final one by O(h²) while nothing touches; the rest is equal.
	CHECK(largest_distance(run(8, 16), run(1, 128)) < 1e-4);
}
