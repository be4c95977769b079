// SPDX-License-Identifier: MIT
// Claims about the measures of energy and momentum.
#include "core/dynamics/energy.h"
#include "dynamics/replay.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("energy is the sum of its formulas on any state") {
	Random random(101);
	const auto model = thesis_shape();
	for (int round = 0; round < 100; ++round) {
		const SoftBodyData body = random_body(random, *model, 0.3, 3);
		const Vec2 gravity = random.vector(10);
		const ReplayState state(body);
		const Energy energy = measure_energy(body, gravity);
		double kinetic = 0;
		double height = 0;
		for (std::size_t i = 0; i < body.point_count(); ++i) {
			const double mass = body.shape().masses()[i];
			kinetic += mass * std::norm(state.w[i]) / 2;
			height -= mass * double(body.settings().gravity_scale) * scalar_product(to_complex(gravity), state.z[i]);
		}
		CHECK(relative_error(energy.kinetic, kinetic) <= 1e-12); // both sums are in double
		// The product of gravity and its scale is a Real.
		CHECK(std::abs(energy.gravity - height) <= 2 * EPSILON * 18 * 28 * 2);
		// Frame and goals are Reals: strains near 1 m lose eps, at up to 100 N/m on nine points.
		const double potential = replay_potential(body, state);
		CHECK(std::abs(energy.springs + energy.shape - potential) <= 100 * EPSILON * 9 * 100);
		CHECK(energy.total() == energy.kinetic + energy.springs + energy.shape + energy.gravity);
	}
}

TEST_CASE("a stretched spring holds k s² / 2 and a body at rest holds nothing") {
	SoftBodyData body = two_masses(2, 1, 100, 0);
	body.set_point(1, { Real(1.5), 0 }, { 0, 3 });
	const Energy energy = measure_energy(body, {});
	CHECK(energy.springs == 12.5);
	CHECK(energy.kinetic == 9);
	CHECK(energy.shape == 0);
	CHECK(energy.gravity == 0);
	BodySettings settings;
	settings.shape_stiffness = 40;
	const Energy rest = measure_energy(thesis_body(thesis_shape(), settings), {});
	CHECK(rest.kinetic == 0);
	// Strains of a few eps, squared.
	CHECK(rest.springs <= 1e4 * EPSILON * EPSILON);
	CHECK(rest.shape <= 1e4 * EPSILON * EPSILON);
}

TEST_CASE("momentum is the sum of m v, angular momentum that of m r x v about the given origin") {
	SoftBodyData body = loose_points(3, 2);
	body.set_point(0, { 3, 0 }, { 0, 5 });
	body.set_point(1, { 0, 4 }, { 1, 0 });
	body.set_point(2, { 9, 9 }, { 0, 0 });
	const Momentum about_zero = measure_momentum(body);
	CHECK(about_zero.linear_x == 2);
	CHECK(about_zero.linear_y == 10);
	CHECK(about_zero.angular == 2 * (3 * 5 - 4 * 1));
	const Momentum about_other = measure_momentum(body, { 1, 2 });
	CHECK(about_other.angular == 2 * (2 * 5 - 2 * 1));
	CHECK(about_other.linear_x == 2);
}
