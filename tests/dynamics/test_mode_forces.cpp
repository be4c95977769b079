// SPDX-License-Identifier: MIT
// The forces of elastic modes: slope of their energy, without net push or turn, with the frequency and damping of the solid.
#include "core/dynamics/elastic_lanes.h"

#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/forces_lanes.h"
#include "core/dynamics/simulator.h"
#include "core/model/material.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::shared_ptr<const SoftBodyShape> shape_of(const std::vector<Vec2> &hull) {
	StructureOptions options;
	options.elastic = true;
	return SoftBodyCreator::create_polygon(hull, options).value();
}

SoftBodyData elastic_body(const std::vector<Vec2> &hull, const Material &material, Vec2 place = {}) {
	const auto shape = shape_of(hull);
	BodySettings settings;
	settings.can_sleep = false;
	REQUIRE(!apply_material(material, ElasticModel::MODES, *shape, settings));
	return SoftBodyData::create(shape, settings, { place, {} }).value();
}

const std::vector<Vec2> L_HULL = { { 0, 0 }, { 50, 0 }, { 100, 0 }, { 100, 40 }, { 70, 40 }, { 40, 40 }, { 40, 100 }, { 0, 100 }, { 0, 50 } };

void disturb(SoftBodyData &body, Random &random, double size, double speed) {
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE(!body.set_point(i, body.positions()[i] + random.vector(size), random.vector(speed)));
	}
}

std::vector<Vec2> forces_on(const SoftBodyData &body) {
	std::vector<Vec2> forces(body.point_count());
	add_mode_forces<Real>(model_of(body), body.positions(), body.velocities(), forces);
	return forces;
}

// Of the first mode, in a body that does not turn.
double amplitude(const SoftBodyData &body) {
	double sum = 0;
	const BodyFrame frame = measure_frame(body);
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		const Vec2 y = frame.rotation.apply_inverse(body.positions()[i] - frame.center) - body.shape().rest_positions()[i];
		sum += double(dot(body.shape().modes()->shape_of_point(i)[0], y));
	}
	return sum;
}

} // namespace

TEST_CASE("mode forces push and turn nothing as a whole, at rest and in motion") {
	Random random(1);
	for (const std::vector<Vec2> &hull : { circle_hull(50, 16).value(), L_HULL }) {
		SoftBodyData body = elastic_body(hull, { 300, Real(0.45), Real(0.3) });
		disturb(body, random, 15, 200);
		Vec2 sum;
		double torque = 0;
		double size = 0;
		const BodyFrame frame = measure_frame(body);
		const std::vector<Vec2> forces = forces_on(body);
		for (std::size_t i = 0; i < forces.size(); ++i) {
			sum += forces[i];
			torque += double(cross(body.positions()[i] - frame.center, forces[i]));
			size += double(length(forces[i]));
		}
		CHECK(double(length(sum)) < 1e-4 * size);
		CHECK(std::abs(torque) < 1e-4 * size * 50);
	}
}

TEST_CASE("mode forces are the slope of the modes' energy") {
	Random random(2);
	for (const std::vector<Vec2> &hull : { circle_hull(50, 12).value(), L_HULL }) {
		SoftBodyData body = elastic_body(hull, { 300, Real(0.3), 0 });
		disturb(body, random, 3, 0);
		const std::vector<Vec2> forces = forces_on(body);
		double scale = 0;
		for (const Vec2 force : forces) {
			scale = std::max(scale, double(length(force)));
		}
		const auto energy_with = [&](std::uint32_t point, Vec2 way) {
			SoftBodyData moved = body;
			REQUIRE(!moved.set_point(point, body.positions()[point] + way, {}));
			return measure_energy(moved, {}).modes;
		};
		constexpr Real STEP = Real(0.05);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			const double x = (energy_with(i, { STEP, 0 }) - energy_with(i, { -STEP, 0 })) / (2 * double(STEP));
			const double y = (energy_with(i, { 0, STEP }) - energy_with(i, { 0, -STEP })) / (2 * double(STEP));
			CHECK(std::abs(x + double(forces[i].x)) < 0.003 * scale); // a fortieth where the frame's turn is left out
			CHECK(std::abs(y + double(forces[i].y)) < 0.003 * scale);
		}
	}
}

TEST_CASE("a body that spins so fast that it is drawn out keeps its spin") {
	const Material jelly;
	SoftBodyData data = elastic_body(circle_hull(50, 16).value(), jelly);
	for (std::uint32_t i = 0; i < data.point_count(); ++i) {
		REQUIRE(!data.set_point(i, data.positions()[i], perpendicular(data.positions()[i]) * Real(50)));
	}
	const double before = measure_momentum(data).angular;
	WorldData world;
	world.set_gravity({});
	world.add_soft_body(std::move(data));
	Simulator simulator(world);
	for (int k = 0; k < 120; ++k) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(measure_momentum(world.soft_bodies()[0]).angular / before == doctest::Approx(1).epsilon(0.002)); // else it gains a fifth
}

TEST_CASE("a free disk wobbles with the solid's frequency and dies away by its damping ratio") {
	const Material material{ 300, Real(0.45), Real(0.05) };
	for (const Integrator integrator : { Integrator::SEMI_IMPLICIT_EULER, Integrator::RUNGE_KUTTA_4, Integrator::AUTOMATIC }) {
		SoftBodyData data = elastic_body(circle_hull(50, 16).value(), material);
		BodySettings settings = data.settings();
		settings.integrator = integrator;
		settings.substeps = integrator == Integrator::AUTOMATIC ? 0 : 16;
		REQUIRE(!data.set_settings(settings));
		for (std::uint32_t i = 0; i < data.point_count(); ++i) {
			const Vec2 weighted = data.shape().modes()->shape_of_point(i)[0];
			const Vec2 way = weighted * (data.shape().total_mass() * data.shape().inverse_masses()[i]);
			REQUIRE(!data.set_point(i, data.positions()[i] + way, {}));
		}
		WorldData world;
		world.add_soft_body(std::move(data));
		const SoftBodyData &body = world.soft_bodies()[0];
		Simulator simulator(world);
		const double first = amplitude(body);
		// Bessel's root for ν = 0.45, as in creator/test_elastic_modes.cpp.
		const double period = 2 * std::numbers::pi / std::sqrt(17.3865 * double(material.shear_modulus()));
		constexpr int STEPS = 480;
		constexpr double PERIODS = 3;
		for (int k = 0; k < STEPS; ++k) {
			simulator.simulate(Real(PERIODS * period / STEPS));
		}
		CAPTURE(int(integrator));
		// After whole periods it is where it was but for the damping: by a wrong frequency it would be past its height, too.
		const double ratio = amplitude(body) / first;
		REQUIRE(ratio > 0);
		CHECK(std::abs(std::log(ratio) / (-2 * std::numbers::pi * PERIODS) - 0.05) < 0.003);
	}
}

TEST_CASE("elastic bodies side by side get the bits that each would get alone") {
	const auto run = [](std::size_t count, std::size_t wanted) {
		WorldData world;
		REQUIRE(!world.set_gravity({ 0, 980 }));
		for (std::size_t i = 0; i < count; ++i) {
			SoftBodyData body = elastic_body(circle_hull(50, 16).value(), {}, { Real(i) * 400, 0 });
			Random random(i);
			disturb(body, random, 10, 100);
			world.add_soft_body(std::move(body));
		}
		if (count == 1) { // the one that is wanted, at its place
			SoftBodyData body = elastic_body(circle_hull(50, 16).value(), {}, { Real(wanted) * 400, 0 });
			Random random(wanted);
			disturb(body, random, 10, 100);
			world.soft_bodies()[0] = std::move(body);
		}
		Simulator simulator(world);
		for (int k = 0; k < 60; ++k) {
			simulator.simulate(Real(1) / 60);
		}
		return copy_of(world.soft_bodies()[count == 1 ? 0 : wanted].positions());
	};
	for (const std::size_t wanted : { 0u, 3u, 8u }) {
		CHECK(identical(run(11, wanted), run(1, wanted)));
	}
}

TEST_CASE("a body of many points takes no more substeps than one of few") {
	const auto substeps_of = [](int count) {
		const SoftBodyData body = elastic_body(circle_hull(50, count).value(), {});
		const SubstepPlan plan = plan_substeps(body, Real(1) / 60, true);
		CHECK(plan.safe);
		return plan.substeps;
	};
	CHECK(substeps_of(256) <= substeps_of(16) + 3);
	CHECK(substeps_of(16) <= 8);
}
