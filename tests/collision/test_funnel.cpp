// SPDX-License-Identifier: MIT
// A body in a funnel of two segments: it squeezes through where its weight can press it, and rests where it cannot.
// `docs/decisions/environment-contacts.md` tells of the one that it does not rest in: of segments without radius, frictionless, and half as
// wide as the body.
#include "core/base/constants.h"
#include "core/collision/environment_contact_solver.h"
#include "core/dynamics/simulator.h"
#include "core/geometry/polygon.h"
#include "core/geometry/segment.h"
#include "core/model/body_frame.h"
#include "scenes/deformations.h"
#include "scenes/thesis_body.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;
constexpr Real HEIGHT = 2; ///< of the funnel's walls, as wide as high [m]

struct Funnel {
	WorldData world;
	std::array<std::array<Vec2, 2>, 2> walls; ///< from the lip upwards

	/// Walls at 45 degrees, whose ends leave `gap` [m] between them.
	Funnel(Real gap, Real friction, Real radius) {
		world.set_gravity({ 0, Real(-9.81) });
		for (const int side : { 0, 1 }) {
			const Real sign = side == 0 ? Real(-1) : Real(1);
			const Real lip = gap / 2 + radius;
			walls[std::size_t(side)] = { Vec2{ sign * lip, 0 }, { sign * (lip + HEIGHT), HEIGHT } };
			Collider wall{ { walls[std::size_t(side)][0], walls[std::size_t(side)][1] }, radius, {} };
			wall.surface.friction = friction;
			REQUIRE_FALSE(world.add_collider(wall));
		}
	}
	BodyId drop(Real stiffness, Real friction) {
		BodySettings settings;
		settings.friction = friction;
		settings.shape_stiffness = DEFAULT_SHAPE_MATCHING * stiffness;
		settings.shape_damping = Real(0.5);
		const auto shape = thesis_shape_with_ratio(stiffness, Real(0.1));
		return world.add_soft_body(thesis_body(shape, settings, { { 0, Real(1.5) }, Rotation::from_angle(Real(0.3)) }));
	}
	/// How far a wall reaches into a body: its lip, as a depth, or the wall itself, from the lip to where an edge crosses it.
	Real penetration(const SoftBodyData &body) const {
		Real deepest = measure_penetration(world, body);
		const std::span<const Vec2> hull = body.hull();
		for (const auto &[lip, top] : walls) {
			for (std::size_t i = 0; i < hull.size(); ++i) {
				if (const auto t = segment_intersection(lip, top, hull[i], hull[(i + 1) % hull.size()])) {
					deepest = std::max(deepest, *t * length(top - lip));
				}
			}
		}
		return deepest;
	}
};

} // namespace

TEST_CASE("a soft body without friction squeezes through a funnel narrower than itself, and has its shape back below it") {
	for (const Real radius : { Real(0), Real(0.02) }) {
		for (const Real gap : { Real(0.6), Real(0.7), Real(0.8) }) { // of its width
			CAPTURE(radius);
			CAPTURE(gap);
			Funnel funnel(gap * 2 * THESIS_RADIUS, 0, radius);
			const BodyId id = funnel.drop(100, 0);
			const SoftBodyData &body = *funnel.world.find(id);
			Simulator simulator(funnel.world);
			int tick = 0;
			for (; tick < 600 && measure_frame(body).center.y > -20; ++tick) {
				REQUIRE(simulator.simulate(TICK).reset_bodies.empty());
				REQUIRE_FALSE(is_folded(body.hull()));
				REQUIRE(funnel.penetration(body) < 0.05 * THESIS_RADIUS);
			}
			CHECK(tick < 600);
			CHECK(deviation_from_rest(body) < 0.1 * THESIS_RADIUS);
		}
	}
}

TEST_CASE("a body that a funnel is too narrow for comes to rest in it, unfolded, and stays on its side of the walls") {
	struct Case {
		Real friction, radius;
	};
	for (const auto &[friction, radius] : { Case{ 0, Real(0.02) }, Case{ Real(0.5), Real(0.02) }, Case{ Real(0.5), 0 }, Case{ 0, 0 } }) {
		for (const Real gap : { Real(0.3), Real(0.4), Real(0.5), Real(0.6) }) {
			if (friction == 0 && radius == 0 && gap < Real(0.45)) {
				continue; // it catches there
			}
			CAPTURE(friction);
			CAPTURE(radius);
			CAPTURE(gap);
			Funnel funnel(gap * 2 * THESIS_RADIUS, friction, radius);
			const BodyId id = funnel.drop(1000, friction);
			const SoftBodyData &body = *funnel.world.find(id);
			Simulator simulator(funnel.world);
			for (int tick = 0; tick < 900; ++tick) {
				REQUIRE(simulator.simulate(TICK).reset_bodies.empty());
				REQUIRE_FALSE(is_folded(body.hull()));
				REQUIRE(funnel.penetration(body) < 0.05 * THESIS_RADIUS);
			}
			CHECK(measure_frame(body).center.y > 0);
			CHECK(body.is_asleep());
		}
	}
}
