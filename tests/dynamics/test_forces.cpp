// SPDX-License-Identifier: MIT
// Claims about the forces on a body's points, against energies and formulas evaluated elsewhere.
#include "core/base/constants.h"
#include "core/dynamics/forces_lanes.h"
#include "dynamics/replay.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> forces_on(const SoftBodyData &body, Vec2 gravity = {}) {
	std::vector<Vec2> forces(body.point_count(), { 1e9, 1e9 }); // to be overwritten
	const std::vector<Vec2> none(body.point_count());
	evaluate_forces<Real>(model_of(body), gravity, none, body.positions(), body.velocities(), forces);
	return forces;
}

std::vector<Vec2> spring_forces_on(const SoftBodyData &body) {
	std::vector<Vec2> forces(body.point_count());
	add_spring_forces<Real>(model_of(body), body.positions(), body.velocities(), forces);
	return forces;
}

std::vector<Vec2> shape_forces_on(const SoftBodyData &body) {
	std::vector<Vec2> forces(body.point_count());
	add_shape_forces<Real>(model_of(body), body.positions(), body.velocities(), forces);
	return forces;
}

double largest(const std::vector<Vec2> &forces) {
	double most = 0;
	for (const Vec2 f : forces) {
		most = std::fmax(most, double(length(f)));
	}
	return most;
}

// Rounding of a force on these bodies: at most eight springs of up to 200 N/m, moving at up to 3 m/s
// against 5 N·s/m, whose lengths come from coordinates up to 1.5.
constexpr double FORCE_ROUNDING = 100 * EPSILON * 8 * (200 * 1.5 + 5 * 6);

} // namespace

TEST_CASE("forces are minus the gradient of the energy") {
	Random random(71);
	const auto model = thesis_shape();
	for (int round = 0; round < 50; ++round) {
		SoftBodyData body = random_body(random, *model, 0.3, 0);
		const auto forces = forces_on(body);
		ReplayState state(body);
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			for (const Complex axis : { Complex(1, 0), Complex(0, 1) }) {
				const Complex here = state.z[i];
				const double step = 1e-6;
				state.z[i] = here + step * axis;
				const double ahead = replay_potential(body, state);
				state.z[i] = here - step * axis;
				const double behind = replay_potential(body, state);
				state.z[i] = here;
				const double slope = (ahead - behind) / (2 * step);
				// Energies near 100 J have 2e-14 J of rounding: 1e-8 N; the cubic term is smaller unless a
				// spring is folded to a millimeter.
				CHECK(std::abs(scalar_product(axis, to_complex(forces[i])) + slope) <= FORCE_ROUNDING + 1e-5);
			}
		}
	}
}

TEST_CASE("all forces together are those of the formulas") {
	Random random(72);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		const SoftBodyData body = random_body(random, *model, 0.3, 3);
		const Vec2 gravity = random.vector(10);
		const auto forces = forces_on(body, gravity);
		const auto expected = replay_forces(body, to_complex(gravity), ReplayState(body));
		for (std::size_t i = 0; i < forces.size(); ++i) {
			CHECK(std::abs(to_complex(forces[i]) - expected[i]) <= FORCE_ROUNDING);
		}
	}
}

TEST_CASE("a stretched spring pulls its ends together, a compressed one pushes them apart") {
	SoftBodyData body = two_masses(1, 2, 100, 0);
	body.set_point(1, { 3, 0 }, {});
	auto forces = spring_forces_on(body);
	CHECK(forces[0] == Vec2{ 100, 0 });
	CHECK(forces[1] == Vec2{ -100, 0 });
	CHECK(forces[2] == Vec2{});
	body.set_point(1, { 1, 0 }, {});
	forces = spring_forces_on(body);
	CHECK(forces[0] == Vec2{ -100, 0 });
	CHECK(forces[1] == Vec2{ 100, 0 });
}

TEST_CASE("springs damp the rate at which they change length, with power -c rate², and nothing else") {
	Random random(73);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		SoftBodyData body = random_body(random, *model, 0.3, 3);
		const auto moving = spring_forces_on(body);
		std::vector<Vec2> still(body.point_count());
		const std::vector<Vec2> rest(body.point_count());
		add_spring_forces<Real>(model_of(body), body.positions(), rest, still);
		double power = 0;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			power += scalar_product(to_complex(moving[i]) - to_complex(still[i]), to_complex(body.velocities()[i]));
		}
		double expected = 0;
		const ReplayState state(body);
		for (const Spring2D &spring : body.shape().springs()) {
			const Complex d = state.z[spring.b] - state.z[spring.a];
			const double rate = scalar_product(d / std::abs(d), state.w[spring.b] - state.w[spring.a]);
			expected -= double(spring.damping) * rate * rate;
		}
		CHECK(expected <= 0);
		CHECK(std::abs(power - expected) <= 9 * 2 * FORCE_ROUNDING * 4.3); // nine points at up to 4.3 m/s
	}
}

TEST_CASE("forces inside a body change neither its momentum nor its angular momentum") {
	Random random(74);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		const SoftBodyData body = random_body(random, *model, 0.3, 3);
		for (const auto &forces : { spring_forces_on(body), shape_forces_on(body) }) {
			Complex sum;
			double torque = 0;
			for (std::size_t i = 0; i < forces.size(); ++i) {
				sum += to_complex(forces[i]);
				torque += std::imag(std::conj(to_complex(body.positions()[i])) * to_complex(forces[i]));
			}
			CHECK(largest(forces) > 1); // there was something to cancel
			CHECK(std::abs(sum) <= 9 * FORCE_ROUNDING);
			CHECK(std::abs(torque) <= 9 * FORCE_ROUNDING * 1.5);
		}
	}
}

TEST_CASE("shape matching leaves every rigid placement and every rigid motion alone") {
	Random random(75);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		SoftBodyData body = random_body(random, *model, 0, 0, random.vector(3));
		CHECK(largest(shape_forces_on(body)) <= 4 * FORCE_ROUNDING); // coordinates up to 5
		const Vec2 center = to_vec2(ReplayFrame(body.shape(), ReplayState(body)).center);
		const Vec2 velocity = random.vector(3);
		const Real spin = random.real(-5, 5);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			const Vec2 p = body.positions()[i];
			body.set_point(i, p, velocity + perpendicular(p - center) * spin);
		}
		CHECK(largest(shape_forces_on(body)) <= 4 * FORCE_ROUNDING);
		CHECK(largest(spring_forces_on(body)) <= 4 * FORCE_ROUNDING); // nor do springs damp it
	}
}

TEST_CASE("the damping of shape matching takes energy out of every other motion") {
	Random random(76);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		SoftBodyData body = random_body(random, *model, 0, 3);
		BodySettings settings = body.settings();
		settings.shape_stiffness = 0;
		settings.shape_damping = 4;
		body.set_settings(settings);
		const auto forces = shape_forces_on(body);
		double power = 0;
		for (std::size_t i = 0; i < forces.size(); ++i) {
			power += scalar_product(to_complex(forces[i]), to_complex(body.velocities()[i]));
		}
		CHECK(power < -0.1);
		// The term is evaluated even where the stiffness is zero.
		const auto all = forces_on(body);
		const auto springs = spring_forces_on(body);
		double difference = 0;
		for (std::size_t i = 0; i < all.size(); ++i) {
			difference = std::fmax(difference, distance(all[i] - springs[i], forces[i]));
		}
		CHECK(difference <= FORCE_ROUNDING);
	}
}

TEST_CASE("shape matching is scaled by the share of the mean mass") {
	// Two heavy and six light points: at equal strain the force goes with the mass.
	SoftBodyShape::Description description;
	description.points = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	description.masses = { 3, 1, 3, 1 };
	description.hull_count = 4;
	BodySettings settings;
	settings.shape_stiffness = 10;
	SoftBodyData body = SoftBodyData::create(SoftBodyShape::create(description).value(), settings).value();
	for (std::uint32_t i = 0; i < 4; ++i) { // inflated: no rotation, no shift
		body.set_point(i, body.positions()[i] * Real(1.5), {});
	}
	const auto forces = shape_forces_on(body);
	// m k_s / mean(m) = 3 * 10 / 2 and 1 * 10 / 2 times a strain of 0.5 per axis.
	CHECK(distance(forces[0], { Real(7.5), Real(7.5) }) <= 64 * EPSILON * 15);
	CHECK(distance(forces[1], { Real(-2.5), Real(2.5) }) <= 64 * EPSILON * 15);
}

TEST_CASE("gravity pulls every mass with the same acceleration, scaled by the body, beside external forces") {
	BodySettings settings;
	settings.gravity_scale = Real(0.5);
	SoftBodyData body = loose_points(4, 3, {}, settings);
	std::vector<Vec2> external(4);
	external[2] = { 100, 200 };
	std::vector<Vec2> forces(4, { 7, 7 });
	evaluate_forces<Real>(model_of(body), { 2, -10 }, external, body.positions(), body.velocities(), forces);
	CHECK(forces[0] == Vec2{ 3, -15 });
	CHECK(forces[2] == Vec2{ 103, 185 });
}

TEST_CASE("a spring without a length has no direction and no force, and a very short one still pushes") {
	SoftBodyData body = two_masses(1, 2, 100, 1);
	for (const Real length : { Real(0), DEGENERATE_LENGTH }) {
		body.set_point(1, { length, 0 }, { 5, 5 });
		const auto forces = spring_forces_on(body);
		CHECK(forces[0] == Vec2{});
		CHECK(forces[1] == Vec2{});
	}
	body.set_point(1, { 4 * DEGENERATE_LENGTH, 0 }, {});
	const auto forces = spring_forces_on(body);
	CHECK(std::abs(double(forces[1].x) - 200) <= 0.001); // the length itself is 8e-6 of the rest length
}
