// SPDX-License-Identifier: MIT
// Claims about pressure: its work, its symmetry, and what it does to a body.
#include "core/dynamics/energy.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "scenes/deformations.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <span>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

BodySettings with_pressure(Real stiffness, Real inflation = 1) {
	BodySettings settings;
	settings.pressure_stiffness = stiffness;
	settings.inflation = inflation;
	return settings;
}

std::vector<Vec2> forces_on(const SoftBodyData &body) {
	std::vector<Vec2> forces(body.point_count());
	add_pressure_forces<Real>(body.shape(), body.settings(), body.positions(), forces);
	return forces;
}

std::vector<Vec2> gradient_of(std::span<const Vec2> hull) {
	std::vector<Vec2> gradient(hull.size());
	for (std::size_t i = 0; i < hull.size(); ++i) {
		gradient[i] = area_derivative<Real>(hull, i);
	}
	return gradient;
}

} // namespace

TEST_CASE("the area gradient is the derivative of the area") {
	Random random(1);
	SoftBodyData body = thesis_body(thesis_shape(), with_pressure(1));
	deform(body, Deformation::PUSHED_THROUGH, random);
	std::vector<Vec2> hull = copy_of(body.hull());
	const std::vector<Vec2> gradient = gradient_of(hull);
	const double area = hull_area<Real>(hull);
	CHECK(std::abs(area - signed_area(hull)) < 8 * EPSILON);
	for (std::size_t i = 0; i < hull.size(); ++i) {
		// Area is linear in each coordinate, so the difference quotient is exact up to rounding.
		const Vec2 kept = hull[i];
		hull[i] = kept + Vec2{ 1, 0 };
		CHECK(std::abs(signed_area(hull) - area - gradient[i].x) < 20 * EPSILON);
		hull[i] = kept + Vec2{ 0, 1 };
		CHECK(std::abs(signed_area(hull) - area - gradient[i].y) < 20 * EPSILON);
		hull[i] = kept;
	}
}

TEST_CASE("the work of the pressure over a small change is p dA, and that is the energy lost") {
	Random random(2);
	SoftBodyData body = thesis_body(thesis_shape(), with_pressure(80, Real(1.3)));
	deform(body, Deformation::FLATTENED, random);
	const std::vector<Vec2> forces = forces_on(body);
	const double area = signed_area(body.hull());
	const double energy = measure_energy(body, {}).pressure;
	double work = 0;
	const double size = 1e-3;
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 way = random.vector(size);
		work += double(forces[i].x) * way.x + double(forces[i].y) * way.y;
		body.set_point(i, body.positions()[i] + way, {});
	}
	const double change = signed_area(body.hull()) - area;
	const double pressure = body.settings().pressure_stiffness * (body.settings().inflation - area / body.shape().rest_area());
	// Second-order terms: 1e-6 m² times the pressure's 100 N/m and its slope, on a work of about 0.05 J.
	CHECK(work == doctest::Approx(pressure * change).epsilon(0.05));
	CHECK(energy - measure_energy(body, {}).pressure == doctest::Approx(work).epsilon(0.05));
}

TEST_CASE("pressure pushes outward below the target area and pulls inward above it") {
	SoftBodyData body = thesis_body(thesis_shape(), with_pressure(10, 2));
	const std::vector<Vec2> forces = forces_on(body);
	for (std::size_t i = 0; i < body.hull().size(); ++i) {
		CHECK(dot(forces[i], body.hull()[i]) > 0);
	}
	body.set_settings(with_pressure(10, Real(0.5)));
	for (std::size_t i = 0; i < body.hull().size(); ++i) {
		CHECK(dot(forces_on(body)[i], body.hull()[i]) < 0);
	}
}

TEST_CASE("pressure adds no momentum and no spin") {
	Random random(3);
	for (int round = 0; round < 20; ++round) {
		SoftBodyData body = thesis_body(thesis_shape(), with_pressure(100, Real(1.5)));
		deform(body, Deformation::CRUMPLED, random);
		Vec2 sum;
		double torque = 0;
		const std::vector<Vec2> forces = forces_on(body);
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			sum += forces[i];
			torque += cross(body.positions()[i], forces[i]);
		}
		CHECK(length(sum) < 2000 * EPSILON); // forces of about 100 N
		CHECK(std::abs(torque) < 2000 * EPSILON);
	}
}

TEST_CASE("an inverted hull is pushed back out, not further in") {
	SoftBodyData body = thesis_body(thesis_shape(), with_pressure(100));
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 p = body.positions()[i];
		body.set_point(i, { p.x, -p.y / 10 }, {}); // slightly negative area
	}
	REQUIRE(signed_area(body.hull()) < 0);
	const std::vector<Vec2> forces = forces_on(body);
	double area_rate = 0; // dA/dt if the points moved along the forces
	const std::vector<Vec2> gradient = gradient_of(body.hull());
	for (std::size_t i = 0; i < gradient.size(); ++i) {
		area_rate += dot(gradient[i], forces[i]);
	}
	CHECK(area_rate > 0);
}

TEST_CASE("a ring without inner springs keeps its area by pressure alone") {
	StructureOptions options;
	options.stiffness = 100;
	options.damping = 1;
	options.center_point = false;
	const auto shape = circle_shape(Real(0.5), 16, options);
	WorldData world;
	world.set_gravity({ 0, Real(9.81) });
	world.add_border({ { { 0, Real(0.5) }, { 0, -1 } }, {} });
	SoftBodyData body = SoftBodyData::create(shape.value(), with_pressure(2000)).value();
	world.add_soft_body(std::move(body));
	Simulator simulator(world);
	for (int i = 0; i < 600; ++i) {
		simulator.simulate(Real(1) / 60);
	}
	// Hydrostatics: weight 9.81 N on a contact of about 0.5 m needs p of about 20 N/m, 1 % of 2000.
	const double ratio = signed_area(world.soft_bodies()[0].hull()) / shape.value()->rest_area();
	CHECK(ratio > 0.95);
	CHECK(ratio < 1.02);
}

TEST_CASE("a term that is off changes nothing, to the bit") {
	const auto run = [](const BodySettings &settings) {
		WorldData world;
		world.set_gravity({ 0, Real(9.81) });
		world.add_soft_body(thesis_body(thesis_shape(100, 1), settings));
		Simulator simulator(world);
		simulator.simulate(Real(1) / 60);
		return copy_of(world.soft_bodies()[0].positions());
	};
	BodySettings inflated;
	inflated.inflation = 3; // without pressure stiffness it means nothing
	CHECK(identical(run({}), run(inflated)));
}
