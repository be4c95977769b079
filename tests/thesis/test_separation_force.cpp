// SPDX-License-Identifier: MIT
// The thesis's separation force, and that it has the faults it is kept for.
#include "thesis/separation_force.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "scenes/jelly.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"
#include "thesis/polygon_overlap.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// What keeps soft bodies apart.
enum class Response {
	POSITION_BASED, ///< the contacts in use
	SEPARATION_FORCE,
};
constexpr std::array RESPONSES = { Response::POSITION_BASED, Response::SEPARATION_FORCE };

// How often in a frame contacts are looked for, or the force is measured anew.
constexpr int SUBSTEPS = 8;

// The force takes the place of contacts: bodies do not meet, and a step is as short as a substep.
void use(Response response, WorldData &world, int substeps) {
	const bool is_force = response == Response::SEPARATION_FORCE;
	REQUIRE(!world.set_contact_substeps(is_force ? 1 : substeps));
	for (SoftBodyData &body : world.soft_bodies()) {
		BodySettings settings = body.settings();
		settings.collision_layer = is_force ? 0 : 1;
		settings.substeps = is_force ? 1 : substeps;
		REQUIRE(!body.set_settings(settings));
	}
}

void simulate_frame(Response response, Simulator &simulator, WorldData &world, int substeps) {
	if (response == Response::POSITION_BASED) {
		simulator.simulate(FRAME);
		return;
	}
	for (int i = 0; i < substeps; ++i) {
		REQUIRE(add_separation_forces(world));
		simulator.simulate(FRAME / Real(substeps));
	}
}

SoftBodyData ball(Vec2 center, Vec2 velocity = {}, Real damping_ratio = 0) {
	BodySettings settings;
	settings.shape_stiffness = 800;
	SoftBodyData body = thesis_body(thesis_shape_with_ratio(2000, damping_ratio), settings,
			{ center, Rotation::from_angle(Real(0.3927)) });
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
	return body;
}

// Energy after two undamped balls have met, with their wobble, over that at the start.
double energy_after_a_bounce(Response response, int substeps, Real offset) {
	WorldData world;
	world.set_sleeping(false);
	world.add_soft_body(ball({ -1, offset / 2 }, { 2, 0 }));
	world.add_soft_body(ball({ 1, -offset / 2 }, { -2, 0 }));
	use(response, world, substeps);
	for (SoftBodyData &body : world.soft_bodies()) {
		BodySettings settings = body.settings();
		settings.integrator = Integrator::SEMI_IMPLICIT_EULER;
		body.set_settings(settings);
	}
	const auto energy = [&] {
		return measure_energy(world.soft_bodies()[0], {}).total() + measure_energy(world.soft_bodies()[1], {}).total();
	};
	const double start = energy();
	Simulator simulator(world);
	for (int i = 0; i < 120; ++i) {
		simulate_frame(response, simulator, world, substeps);
	}
	CHECK(measure_momentum(world.soft_bodies()[0]).linear_x < 0); // they did bounce
	return energy() / start;
}

Vec2 sum_of_forces(const SoftBodyData &body) {
	Vec2 sum;
	for (const ExternalForce &external : body.external_forces()) {
		sum += external.force;
	}
	return sum;
}

} // namespace

TEST_CASE("the separation force is the coefficient times the shared area, equal and opposite, and away from the other") {
	Random random(3);
	for (int i = 0; i < 100; ++i) {
		WorldData world;
		world.add_soft_body(ball({ 0, 0 }));
		world.add_soft_body(ball(Rotation::from_angle(random.real(0, 6.283)).apply({ random.real(0.3, 0.9), 0 })));
		const SoftBodyData &a = world.soft_bodies()[0];
		const SoftBodyData &b = world.soft_bodies()[1];
		CHECK(add_separation_forces(world).value() == 1);
		const Vec2 on_a = sum_of_forces(a);
		const Vec2 on_b = sum_of_forces(b);
		const double size = double(SEPARATION_STIFFNESS) * overlap_area(a.hull(), b.hull());
		CHECK(double(length(on_a)) == doctest::Approx(size).epsilon(1e-4));
		CHECK(double(length(on_a + on_b)) <= 20 * EPSILON * size);
		CHECK(dot(on_a, a.positions()[8] - b.positions()[8]) > 0); // from center point to center point
	}
}

TEST_CASE("the separation force loads the points inside the other body alike, and all hull points where none is") {
	const auto loads = [](WorldData &world, std::size_t body) {
		REQUIRE(add_separation_forces(world).value() == 1);
		return world.soft_bodies()[body].external_forces();
	};
	WorldData pressed;
	pressed.add_soft_body(ball({ 0, 0 }));
	pressed.add_soft_body(ball({ Real(0.8), 0 }));
	const auto on_first = loads(pressed, 0);
	CHECK(on_first.size() == 2); // of eight, turned so that an edge faces the other
	for (const ExternalForce &each : on_first) {
		CHECK(each.force == on_first[0].force);
		CHECK(pressed.soft_bodies()[0].positions()[each.point].x > Real(0.3));
	}
	// Two planks across each other.
	const auto plank = [](Vec2 half) {
		const std::vector<Vec2> outline{ -half, { half.x, -half.y }, half, { -half.x, half.y } };
		return SoftBodyData::create(SoftBodyCreator::create_polygon(outline, { 1, 1000, 1, true }).value(), {}, {}).value();
	};
	WorldData crossed;
	crossed.add_soft_body(plank({ 2, Real(0.25) }));
	crossed.add_soft_body(plank({ Real(0.25), 2 }));
	CHECK(loads(crossed, 0).size() == 4);
	CHECK(double(length(sum_of_forces(crossed.soft_bodies()[1]))) == doctest::Approx(0.25 * SEPARATION_STIFFNESS).epsilon(1e-4));
}

TEST_CASE("without overlap there is no separation force") {
	WorldData world;
	world.add_soft_body(ball({ 0, 0 }));
	world.add_soft_body(ball({ Real(1.001), 0 }, { -1, 0 }));
	CHECK(add_separation_forces(world).value() == 0);
	for (const SoftBodyData &body : world.soft_bodies()) {
		CHECK(body.external_forces().empty());
	}
}

// Force and area depend on the shape in a way that no potential has: not the step is at fault but the force.
TEST_CASE("bodies that meet off center gain a seventh of their energy from the separation force, however small the step") {
	for (const int substeps : { 8, 16, 32, 64 }) {
		CHECK(energy_after_a_bounce(Response::SEPARATION_FORCE, substeps, Real(0.25)) == doctest::Approx(1.15).epsilon(0.02));
		CHECK(energy_after_a_bounce(Response::POSITION_BASED, substeps, Real(0.25)) < 1);
	}
}

TEST_CASE("bodies that meet head on keep their energy under the separation force") {
	for (const int substeps : { 8, 16, 32, 64 }) {
		CHECK(energy_after_a_bounce(Response::SEPARATION_FORCE, substeps, 0) == doctest::Approx(1).epsilon(0.02));
	}
}

TEST_CASE("bodies that meet off center come away from the separation force with a spin that nothing gave them") {
	for (const Response response : RESPONSES) {
		WorldData world;
		world.add_soft_body(ball({ -1, Real(0.125) }, { 2, 0 }));
		world.add_soft_body(ball({ 1, Real(-0.125) }, { -2, 0 }));
		use(response, world, SUBSTEPS);
		const auto both = [&](double Momentum::*part) {
			return measure_momentum(world.soft_bodies()[0]).*part + measure_momentum(world.soft_bodies()[1]).*part;
		};
		const double start = both(&Momentum::angular);
		Simulator simulator(world);
		for (int i = 0; i < 120; ++i) {
			simulate_frame(response, simulator, world, SUBSTEPS);
		}
		CHECK(std::abs(both(&Momentum::linear_x)) <= 100 * EPSILON);
		CHECK(std::abs(both(&Momentum::linear_y)) <= 100 * EPSILON);
		const double change = std::abs(both(&Momentum::angular) - start); // of 1 kg m²/s that a rigid disk would turn by
		CHECK((change > 0.2) == (response == Response::SEPARATION_FORCE));
		CHECK((change < 0.02) == (response == Response::POSITION_BASED));
	}
}

TEST_CASE("a pile held apart by the separation force never comes to rest, and its bodies stay in one another" * doctest::test_suite("slow")) {
	for (const Response response : RESPONSES) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		world.set_sleeping(false);
		world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
		world.add_border({ { { 0, 0 }, { 1, 0 } }, {} });
		world.add_border({ { { Real(4.2), 0 }, { -1, 0 } }, {} });
		for (int i = 0; i < 24; ++i) {
			SoftBodyData body = ball({ Real(0.55 + 1.03 * (i % 4)), Real(0.6 + 1.1 * (i / 4)) }, {}, Real(0.05));
			BodySettings settings = body.settings();
			settings.shape_damping = 5;
			body.set_settings(settings);
			world.add_soft_body(std::move(body));
		}
		use(response, world, SUBSTEPS);
		Simulator simulator(world);
		for (int i = 0; i < 20 * 60; ++i) {
			simulate_frame(response, simulator, world, SUBSTEPS);
		}
		double kinetic = 0;
		double deepest = 0;
		for (const SoftBodyData &body : world.soft_bodies()) {
			kinetic += measure_energy(body, {}).kinetic / 24;
			for (const SoftBodyData &other : world.soft_bodies()) {
				if (&body != &other) {
					deepest = std::max(deepest, penetration_depth(body.hull(), other.hull()));
				}
			}
		}
		const bool is_force = response == Response::SEPARATION_FORCE;
		CHECK((kinetic > 0.01) == is_force);
		CHECK((kinetic < 1e-3) == !is_force);
		CHECK((deepest > 0.02) == is_force);
	}
}

TEST_CASE("the separation force means the same in meters as in pixels") {
	std::vector<Vec2> meters;
	for (const Real unit : { Real(1), Real(128) }) {
		WorldData world;
		world.set_sleeping(false);
		world.set_length_unit(unit);
		for (const Real side : { Real(-1), Real(1) }) {
			const auto shape = circle_shape(THESIS_RADIUS * unit, THESIS_HULL_POINTS, { 1, 2000, 0, true }).value();
			SoftBodyData body = SoftBodyData::create(shape, {}, { { side * unit, 0 }, {} }).value();
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				body.set_point(i, body.positions()[i], { -2 * side * unit, 0 });
			}
			world.add_soft_body(body);
		}
		use(Response::SEPARATION_FORCE, world, SUBSTEPS);
		Simulator simulator(world);
		for (int i = 0; i < 30; ++i) {
			simulate_frame(Response::SEPARATION_FORCE, simulator, world, SUBSTEPS);
		}
		const std::span<const Vec2> now = world.soft_bodies()[0].positions();
		if (meters.empty()) {
			meters = copy_of(now);
			continue;
		}
		for (std::size_t i = 0; i < now.size(); ++i) {
			CHECK(distance(now[i] * (1 / unit), meters[i]) < 1e-3);
		}
	}
}

TEST_CASE("a separation stiffness that is negative, infinite or NaN is refused, and nothing is pushed") {
	WorldData world;
	world.add_soft_body(ball({ 0, 0 }));
	world.add_soft_body(ball({ Real(0.5), 0 }));
	for (const Real bad : { Real(-1), NOT_A_NUMBER, INFINITE }) {
		const auto refused = add_separation_forces(world, bad);
		REQUIRE(!refused);
		CHECK(mentions(refused.error().message(), "separation_stiffness"));
		CHECK(world.soft_bodies()[0].external_forces().empty());
	}
	CHECK(add_separation_forces(world, 0).value() == 0);
}
