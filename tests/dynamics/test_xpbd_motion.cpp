// SPDX-License-Identifier: MIT
// Claims about what XPBD keeps of a body's rigid motion, whatever its constraints do.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/deformations.h"
#include "scenes/jelly.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;

BodySettings by_xpbd(Real stiffness, bool everything) {
	BodySettings settings;
	settings.integrator = Integrator::XPBD;
	settings.substeps = 8;
	if (everything) {
		settings.shape_stiffness = Real(0.4) * stiffness;
		settings.shape_damping = Real(0.1) * std::sqrt(stiffness);
		settings.pressure_stiffness = stiffness;
	}
	return settings;
}

} // namespace

TEST_CASE("XPBD keeps the spin of a turning, wobbling body to rounding, for any stiffness and with every term") {
	Random random(31);
	for (const Real k : { Real(1e2), Real(1e4), Real(1e6) }) {
		for (const bool everything : { false, true }) {
			CAPTURE(k);
			CAPTURE(everything);
			WorldData world;
			SoftBodyData body = thesis_body(thesis_shape_with_ratio(k, Real(0.05)), by_xpbd(k, everything));
			deform(body, Deformation::FLATTENED, random);
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				body.set_point(i, body.positions()[i], perpendicular(body.positions()[i]) * Real(3));
			}
			const Vec2 center = measure_frame(body).center;
			const double before = measure_momentum(body, center).angular;
			world.add_soft_body(std::move(body));
			Simulator simulator(world);
			for (int i = 0; i < 600; ++i) {
				simulator.simulate(TICK);
			}
			const SoftBodyData &after = world.soft_bodies()[0];
			// 4800 substeps, each of which rounds every velocity (about 1 m/s) and place (0.5 m) once or twice.
			const double rounding = 4800 * EPSILON * 0.5;
			CHECK(std::abs(measure_momentum(after, measure_frame(after).center).angular - before) < rounding);
		}
	}
}

TEST_CASE("a stretched body let go at rest under XPBD stays in place and does not begin to turn") {
	for (const Real k : { Real(1e2), Real(1e4), Real(1e6) }) {
		CAPTURE(k);
		WorldData world;
		SoftBodyData body = thesis_body(thesis_shape_with_ratio(k, Real(0.05)), by_xpbd(k, false), Pose{ { 3, -2 }, {} });
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			const Vec2 p = body.positions()[i] - Vec2{ 3, -2 };
			body.set_point(i, Vec2{ 3, -2 } + Vec2{ Real(1.15) * p.x + Real(0.1) * p.y, Real(0.9) * p.y }, {});
		}
		const Vec2 start = measure_frame(body).center;
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 600; ++i) {
			simulator.simulate(TICK);
		}
		const BodyFrame frame = measure_frame(world.soft_bodies()[0]);
		// Unrestored it turned by 0.002, 0.09 and 0.9 rad/s.
		CHECK(std::abs(double(frame.angular_velocity)) < 2000 * EPSILON);
		CHECK(distance(frame.center, start) < 20000 * EPSILON);
	}
}

TEST_CASE("a turning body in XPBD does not stray: the last digit of a place over h is no speed") {
	// Ten seconds at 3 rad/s; 2 to 5 cm in float before the mean velocity was kept.
	for (const Real k : { Real(1e2), Real(1e4) }) {
		CAPTURE(k);
		WorldData world;
		SoftBodyData body = thesis_body(thesis_shape_with_ratio(k, Real(0.05)), by_xpbd(k, false), Pose{ { 3, -2 }, {} });
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], perpendicular(body.positions()[i] - Vec2{ 3, -2 }) * Real(3));
		}
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int i = 0; i < 600; ++i) {
			simulator.simulate(TICK);
		}
		CHECK(distance(measure_frame(world.soft_bodies()[0]).center, { 3, -2 }) < 2000 * EPSILON);
	}
}

TEST_CASE("under XPBD forces give a body the momentum and spin that they have, in free fall too") {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	SoftBodyData body = thesis_body(thesis_shape_with_ratio(1000, Real(0.05)), by_xpbd(1000, true));
	const Vec2 arm = body.positions()[2];
	const Vec2 force{ 3, 1 };
	world.add_soft_body(std::move(body));
	Simulator simulator(world);
	REQUIRE_FALSE(world.soft_bodies()[0].add_external_force(2, force));
	simulator.simulate(TICK);
	const SoftBodyData &after = world.soft_bodies()[0];
	const Momentum momentum = measure_momentum(after, measure_frame(after).center);
	CHECK(std::abs(momentum.linear_x - 3.0 / 60) < 100 * EPSILON);
	CHECK(std::abs(momentum.linear_y - (1 - 9.81) / 60) < 100 * EPSILON);
	// The point moves relative to the center by less than 2 mm meanwhile, of 0.5 m.
	const double torque = double(arm.x) * double(force.y) - double(arm.y) * double(force.x);
	CHECK(std::abs(momentum.angular - torque / 60) < 0.004 * std::abs(torque) / 60);
}

TEST_CASE("a pinned body swings under XPBD: the pin takes up momentum and spin") {
	WorldData world;
	world.set_gravity({ 0, Real(-9.81) });
	SoftBodyData body = thesis_body(thesis_shape_with_ratio(1e4, Real(0.05)), by_xpbd(1e4, true));
	REQUIRE_FALSE(body.set_pinned(0, true)); // at (0.5, 0): the rest lies beside it and falls
	const Vec2 pin = body.positions()[0];
	world.add_soft_body(std::move(body));
	Simulator simulator(world);
	double lowest = 0;
	for (int i = 0; i < 120; ++i) {
		simulator.simulate(TICK);
		lowest = std::fmin(lowest, double(measure_frame(world.soft_bodies()[0]).center.y));
	}
	CHECK(world.soft_bodies()[0].positions()[0] == pin);
	CHECK(lowest < -0.4); // as deep as half the radius of the swing, which is 0.5
	CHECK(lowest > -0.6);
}

TEST_CASE("XPBD damps no more than the damping says: a free wobble keeps its energy, at the pace of the midpoint rule") {
	// Two points of 1 kg on a spring: the stretch s'' = -ω² s with ω² = 2 k / m.
	for (const double turn : { 0.5, 2.0, 4.0 }) { // ωh
		CAPTURE(turn);
		const double h = double(TICK) / 8;
		const double stiffness = turn * turn / (h * h) / 2;
		BodySettings settings;
		settings.integrator = Integrator::XPBD;
		settings.substeps = 8;
		SoftBodyData body = two_masses(Real(1), Real(2), Real(stiffness), Real(0), settings);
		REQUIRE(!body.set_point(0, body.positions()[0] - Vec2{ Real(0.02), 0 }, {}));
		REQUIRE(!body.set_point(1, body.positions()[1] + Vec2{ Real(0.02), 0 }, {}));
		WorldData world;
		world.set_sleeping(false);
		world.add_soft_body(std::move(body));
		const double first = measure_energy(world.soft_bodies()[0], {}).total();
		Simulator simulator(world);
		const double share = double(simulator.plan(world.soft_bodies()[0], TICK).implicit_share);
		CHECK(share < 0.52);
		double phase = 0;
		for (int i = 0; i < 30; ++i) {
			simulator.simulate(TICK);
			phase += 8 * 2 * std::atan(turn / 2); // exact for the midpoint rule
		}
		const double energy = measure_energy(world.soft_bodies()[0], {}).total();
		// The θ method shrinks the energy by about 1 - (2θ - 1) (ωh)² / (1 + (ωh)²/4) in a substep.
		const double least = std::pow(1 - (2 * share - 1) * turn * turn / (1 + turn * turn / 4), 240);
		CHECK(energy <= first * 1.001);
		CHECK(energy >= first * least * 0.98);
		const double stretch = double(world.soft_bodies()[0].positions()[1].x - world.soft_bodies()[0].positions()[0].x) - 2;
		CHECK(stretch == doctest::Approx(0.04 * std::sqrt(energy / first) * std::cos(phase)).epsilon(0.02 / 0.04));
	}
}

TEST_CASE("a body rises as high from the floor by XPBD as by semi-implicit Euler, at any rate of ticks") {
	for (const double stiffness : { 1e4, 4e4 }) {
		for (const int rate : { 60, 120, 240 }) {
			CAPTURE(stiffness);
			CAPTURE(rate);
			std::array<double, 2> heights{};
			for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::XPBD }) {
				WorldData world = pixel_world();
				world.set_sleeping(false);
				world.add_border(floor_at(0));
				const double damping = 0.012 * std::sqrt(stiffness);
				const auto shape = circle_shape(50, 16, { 1, Real(stiffness), Real(damping), true }).value();
				BodySettings settings;
				settings.integrator = integrator;
				settings.shape_stiffness = Real(0.4 * stiffness);
				settings.shape_damping = Real(0.05 * std::sqrt(stiffness));
				world.add_soft_body(SoftBodyData::create(shape, settings, Pose{ { 0, -350 }, {} }).value());
				Simulator simulator(world);
				double &height = heights[integrator == Integrator::XPBD];
				bool has_hit = false;
				for (int i = 0; i < 2 * rate; ++i) {
					simulator.simulate(Real(1) / Real(rate));
					const double above = -double(measure_frame(world.soft_bodies()[0]).center.y) - 50;
					has_hit |= above < 1;
					height = std::max(height, has_hit ? above : 0.0);
				}
			}
			CHECK(heights[0] > 60);
			CHECK(heights[1] == doctest::Approx(heights[0]).epsilon(0.05));
		}
	}
}
