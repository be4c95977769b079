// SPDX-License-Identifier: MIT
// The thesis's separation force, and that it has the faults it is kept for.
#include "core/collision/separation_force.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon_overlap.h"
#include "scenes/jelly.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real STRENGTH = 10000; ///< [N/m²]

// A body as contacts see it, with the hull that it had before.
struct Touching {
	explicit Touching(SoftBodyData &body) :
			before(body.hull().begin(), body.hull().end()) {
		view.positions = body.mutable_positions();
		view.velocities = body.mutable_velocities();
		view.inverse_masses = body.inverse_masses();
		view.before = before;
	}
	std::vector<Vec2> before;
	SolverBody view;
};

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
double energy_after_a_bounce(ContactResponse response, int substeps, Real offset) {
	WorldData world;
	world.set_sleeping(false);
	world.set_contact_response(response);
	world.set_contact_substeps(substeps);
	world.add_soft_body(ball({ -1, offset / 2 }, { 2, 0 }));
	world.add_soft_body(ball({ 1, -offset / 2 }, { -2, 0 }));
	for (SoftBodyData &body : world.soft_bodies()) {
		BodySettings settings = body.settings();
		settings.integrator = Integrator::SEMI_IMPLICIT_EULER;
		settings.substeps = substeps;
		body.set_settings(settings);
	}
	const auto energy = [&] {
		return measure_energy(world.soft_bodies()[0], {}).total() + measure_energy(world.soft_bodies()[1], {}).total();
	};
	const double start = energy();
	Simulator simulator(world);
	for (int i = 0; i < 120; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(measure_momentum(world.soft_bodies()[0]).linear_x < 0); // they did bounce
	return energy() / start;
}

} // namespace

TEST_CASE("the separation force is the coefficient times the shared area, equal and opposite, and away from the other") {
	Random random(3);
	for (int i = 0; i < 100; ++i) {
		SoftBodyData a = ball({ 0, 0 });
		SoftBodyData b = ball(Rotation::from_angle(random.real(0, 6.283)).apply({ random.real(0.3, 0.9), 0 }));
		Touching first(a);
		Touching second(b);
		SeparationForce force;
		const Real h = Real(0.01);
		force.begin_substep(STRENGTH, h);
		const Real size = force.handle(first.view, second.view);
		CHECK(double(size) == doctest::Approx(double(STRENGTH) * overlap_area(a.hull(), b.hull())).epsilon(1e-5));
		const Momentum of_a = measure_momentum(a);
		const Momentum of_b = measure_momentum(b);
		CHECK(std::abs(of_a.linear_x + of_b.linear_x) <= 20 * EPSILON * double(size * h));
		CHECK(std::abs(of_a.linear_y + of_b.linear_y) <= 20 * EPSILON * double(size * h));
		CHECK(std::hypot(of_a.linear_x, of_a.linear_y) == doctest::Approx(double(size * h)).epsilon(1e-4));
		const Vec2 away = a.positions()[8] - b.positions()[8]; // of the center points
		CHECK(of_a.linear_x * double(away.x) + of_a.linear_y * double(away.y) > 0);
	}
}

TEST_CASE("without overlap there is no separation force") {
	SoftBodyData a = ball({ 0, 0 });
	SoftBodyData b = ball({ Real(1.001), 0 }, { -1, 0 });
	Touching first(a);
	Touching second(b);
	SeparationForce force;
	force.begin_substep(STRENGTH, 1);
	CHECK(force.handle(first.view, second.view) == 0);
	for (std::size_t i = 0; i < a.point_count(); ++i) {
		CHECK(a.velocities()[i] == Vec2{ 0, 0 });
		CHECK(b.velocities()[i] == Vec2{ -1, 0 });
	}
}

// Force and area depend on the shape in a way that no potential has: not the step is at fault but the force.
TEST_CASE("bodies that meet off center gain a seventh of their energy from the separation force, however small the step") {
	for (const int substeps : { 8, 16, 32, 64 }) {
		CHECK(energy_after_a_bounce(ContactResponse::SEPARATION_FORCE, substeps, Real(0.25)) == doctest::Approx(1.15).epsilon(0.02));
		CHECK(energy_after_a_bounce(ContactResponse::POSITION_BASED, substeps, Real(0.25)) < 1);
	}
}

TEST_CASE("bodies that meet head on keep their energy under the separation force") {
	for (const int substeps : { 8, 16, 32, 64 }) {
		CHECK(energy_after_a_bounce(ContactResponse::SEPARATION_FORCE, substeps, 0) == doctest::Approx(1).epsilon(0.02));
	}
}

TEST_CASE("bodies that meet off center come away from the separation force with a spin that nothing gave them") {
	for (const ContactResponse response : { ContactResponse::POSITION_BASED, ContactResponse::SEPARATION_FORCE }) {
		WorldData world;
		world.set_contact_response(response);
		world.add_soft_body(ball({ -1, Real(0.125) }, { 2, 0 }));
		world.add_soft_body(ball({ 1, Real(-0.125) }, { -2, 0 }));
		const auto both = [&](double Momentum::*part) {
			return measure_momentum(world.soft_bodies()[0]).*part + measure_momentum(world.soft_bodies()[1]).*part;
		};
		const double start = both(&Momentum::angular);
		Simulator simulator(world);
		for (int i = 0; i < 120; ++i) {
			simulator.simulate(FRAME);
		}
		CHECK(std::abs(both(&Momentum::linear_x)) <= 100 * EPSILON);
		CHECK(std::abs(both(&Momentum::linear_y)) <= 100 * EPSILON);
		const double change = std::abs(both(&Momentum::angular) - start); // of 1 kg m²/s that a rigid disk would turn by
		CHECK((change > 0.2) == (response == ContactResponse::SEPARATION_FORCE));
		CHECK((change < 0.02) == (response == ContactResponse::POSITION_BASED));
	}
}

TEST_CASE("a pile held apart by the separation force never comes to rest, and its bodies stay in one another") {
	for (const ContactResponse response : { ContactResponse::POSITION_BASED, ContactResponse::SEPARATION_FORCE }) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		world.set_contact_response(response);
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
		Simulator simulator(world);
		for (int i = 0; i < 20 * 60; ++i) {
			simulator.simulate(FRAME);
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
		const bool is_force = response == ContactResponse::SEPARATION_FORCE;
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
		world.set_contact_response(ContactResponse::SEPARATION_FORCE);
		for (const Real side : { Real(-1), Real(1) }) {
			const auto shape = SoftBodyCreator::create_circle(THESIS_RADIUS * unit, THESIS_HULL_POINTS, { 1, 2000, 0, true }).value();
			SoftBodyData body = SoftBodyData::create(shape, {}, { { side * unit, 0 }, {} }).value();
			for (std::uint32_t i = 0; i < body.point_count(); ++i) {
				body.set_point(i, body.positions()[i], { -2 * side * unit, 0 });
			}
			world.add_soft_body(body);
		}
		Simulator simulator(world);
		for (int i = 0; i < 30; ++i) {
			simulator.simulate(FRAME);
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

TEST_CASE("the separation force gives the same bits for any number of threads" * doctest::test_suite("threads")) {
	std::vector<Vec2> first;
	for (const std::size_t threads : { 1, 2, 8 }) {
		WorldData world;
		world.set_gravity({ 0, Real(-9.81) });
		world.set_contact_response(ContactResponse::SEPARATION_FORCE);
		world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
		Random random(5);
		for (int i = 0; i < 100; ++i) {
			world.add_soft_body(ball({ Real(i % 10) + random.real(0, 0.1), Real(0.6 + i / 10) }, {}, Real(0.05)));
		}
		Simulator simulator(world, threads == 1 ? ParallelFor{} : on_threads(threads));
		std::uint64_t contacts = 0;
		for (int i = 0; i < 60; ++i) {
			contacts += simulator.simulate(FRAME).pair_contacts;
		}
		CHECK(contacts > 0);
		std::vector<Vec2> all;
		for (const SoftBodyData &body : world.soft_bodies()) {
			all.insert(all.end(), body.positions().begin(), body.positions().end());
		}
		if (first.empty()) {
			first = all;
		}
		CHECK(identical(first, all));
	}
}

TEST_CASE("a world refuses a separation stiffness that is negative or no number, and keeps what it had") {
	WorldData world;
	CHECK(world.contact_response() == ContactResponse::POSITION_BASED);
	for (const Real bad : { Real(-1), NOT_A_NUMBER, INFINITE }) {
		const Status refused = world.set_separation_stiffness(bad);
		REQUIRE(refused);
		CHECK(mentions(refused->message(), "separation_stiffness"));
		CHECK(world.separation_stiffness() == SEPARATION_STIFFNESS);
	}
	CHECK(!world.set_separation_stiffness(0));
}
