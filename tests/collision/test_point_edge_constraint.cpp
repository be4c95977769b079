// SPDX-License-Identifier: MIT
// Claims about a point on a hull edge: how impulses move it, Coulomb's law along a tangent, and what is thrown back.
#include "core/collision/point_edge_constraint.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<Vec2> random_points(Random &random) {
	return { random.vector(2), random.vector(2), random.vector(2) };
}

} // namespace

TEST_CASE("an impulse at a place on an edge changes its velocity by the inverse mass of the place, and no more momentum") {
	Random random(11);
	for (int i = 0; i < 200; ++i) {
		const std::vector<Real> inverse_masses{ random.real(0.5, 2), random.real(0.5, 2), random.real(0.5, 2) };
		const HullPlace at{ 2, 0, random.real(0, 1) };
		const PointOnEdge place(at, inverse_masses);
		std::vector<Vec2> velocities = random_points(random);
		const std::vector<Vec2> before = velocities;
		const Vec2 impulse = random.vector(3);
		place.push(velocities, impulse);
		const Vec2 change = place.of(velocities) - position_of(at, before);
		CHECK(distance(change, impulse * place.inverse_mass) <= 40 * EPSILON);
		const Vec2 momentum = (velocities[2] - before[2]) * (1 / inverse_masses[2]) + (velocities[0] - before[0]) * (1 / inverse_masses[0]);
		CHECK(distance(momentum, impulse) <= 60 * EPSILON);
		CHECK(velocities[1] == before[1]);
		// Likewise, told by what shall become of the place.
		velocities = before;
		place.change(velocities, impulse);
		CHECK(distance(place.of(velocities) - place.of(before), impulse) <= 40 * EPSILON);
	}
}

TEST_CASE("a hull point is a place on an edge of no length, and moves exactly as it shall") {
	const std::array<Real, 2> inverse_masses = { Real(0.3), 7 };
	const PointOnEdge place({ 1, 1, 0 }, inverse_masses);
	CHECK(place.inverse_mass == 7);
	std::array<Vec2, 2> points = { Vec2{ 1, 2 }, Vec2{ 3, 4 } };
	place.change(points, { Real(0.1), Real(0.2) });
	CHECK(points[0] == Vec2{ 1, 2 });
	CHECK(points[1] == Vec2{ 3 + Real(0.1), 4 + Real(0.2) });
}

TEST_CASE("no end of an edge moves more than five times as far as the place, however heavy or pinned the other end") {
	for (const Real heavy : { Real(0), Real(1e-6), Real(0.01), Real(0.1) }) {
		for (int i = 0; i <= 1000; ++i) {
			const std::array<Real, 2> inverse_masses = { heavy, 2 };
			const PointOnEdge place({ 0, 1, Real(i) / 1000 }, inverse_masses);
			std::array<Vec2, 2> points = {};
			place.change(points, { 1, 0 });
			CHECK(points[1].x <= 5 * (1 + 4 * Real(EPSILON)));
			CHECK(place.of(points).x <= 1 + 4 * Real(EPSILON)); // at most what was wanted
		}
	}
}

TEST_CASE("the bound on how far ends move changes nothing where their masses differ less than 24 times") {
	for (int i = 0; i <= 1000; ++i) {
		const std::array<Real, 2> inverse_masses = { 1, 24 };
		const Real t = Real(i) / 1000;
		const PointOnEdge place({ 0, 1, t }, inverse_masses);
		CHECK(place.inverse_mass == 1 * (1 - t) * (1 - t) + 24 * t * t);
	}
}

TEST_CASE("a point and a place on an edge part by what an impulse gives both, and together keep momentum") {
	Random random(12);
	for (int i = 0; i < 200; ++i) {
		const std::vector<Real> inverse_masses{ random.real(0.5, 2), random.real(0.5, 2), random.real(0.5, 2) };
		const PointAgainstEdge sides{ 0, inverse_masses[0], PointOnEdge({ 1, 2, random.real(0, 1) }, inverse_masses) };
		std::vector<Vec2> points = random_points(random);
		const std::vector<Vec2> before = points;
		const Vec2 impulse = random.vector(1);
		sides.part(points, points, impulse);
		const Vec2 apart = (points[0] - sides.edge.of(points)) - (before[0] - sides.edge.of(before));
		CHECK(distance(apart, impulse * sides.inverse_mass()) <= 40 * EPSILON);
		Vec2 momentum;
		for (std::size_t k = 0; k < 3; ++k) {
			momentum += (points[k] - before[k]) * (1 / inverse_masses[k]);
		}
		CHECK(distance(momentum, {}) <= 40 * EPSILON);
	}
}

TEST_CASE("friction takes the sliding velocity, or as much of it as Coulomb's law allows, as the quotient by its size would") {
	Random random(13);
	int held = 0;
	for (int i = 0; i < 500; ++i) {
		const Vec2 normal = Rotation::from_angle(random.real(-3.1, 3.1)).apply({ 1, 0 });
		const Vec2 relative = random.vector(3);
		const Real friction = random.real(0, 2);
		const Real normal_change = random.real(0, 2);
		const Real h = Real(0.01);
		const ContactChange<Real> change = contact_change(relative, normal, Real(0.1), normal_change, friction, h);
		const Vec2 slide = relative - normal * dot(relative, normal);
		const Real most = std::min(length(slide), friction * normal_change);
		const Vec2 brake = slide * (-most / length(slide));
		CHECK(distance(change.velocity, normal * normal_change + brake) <= 20 * EPSILON);
		CHECK(distance(change.position, normal * Real(0.1) + brake * h) <= 20 * EPSILON);
		held += most == length(slide);
	}
	CHECK(held > 50);
	CHECK(held < 450);
	// Without sliding there is no direction to divide by, and no need for one.
	const ContactChange<Real> straight = contact_change(Vec2{ 0, -2 }, Vec2{ 0, 1 }, Real(0), Real(2), Real(1), Real(1));
	CHECK(straight.velocity == Vec2{ 0, 2 });
	// NaN slides nowhere where nothing presses.
	const ContactChange<Real> none = contact_change(Vec2{ NOT_A_NUMBER, NOT_A_NUMBER }, Vec2{ 0, 1 }, Real(1), Real(0), Real(1), Real(1));
	CHECK(none.velocity == Vec2{});
	CHECK(none.position == Vec2{ 0, 1 });
}

TEST_CASE("bodies side by side get the bits that each gets alone") {
	Random random(14);
	for (int i = 0; i < 100; ++i) {
		std::array<Vec2, PACK_WIDTH> relative;
		std::array<Real, PACK_WIDTH> normal_change;
		BasicVec2<RealPack> packed;
		RealPack packed_change(0);
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			relative[lane] = random.vector(3);
			normal_change[lane] = random.chance(0.3) ? Real(0) : random.real(0, 2);
			set_lane(packed, lane, relative[lane]);
			packed_change.set(lane, normal_change[lane]);
		}
		const Vec2 normal = Rotation::from_angle(random.real(-3.1, 3.1)).apply({ 1, 0 });
		const ContactChange<RealPack> change = contact_change(packed, in_all_lanes<RealPack>(normal), RealPack(Real(0.1)),
				packed_change, Real(0.5), Real(0.01));
		for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
			const ContactChange<Real> alone = contact_change(relative[lane], normal, Real(0.1), normal_change[lane], Real(0.5), Real(0.01));
			const std::array<Vec2, 2> one = { alone.position, alone.velocity };
			const std::array<Vec2, 2> of_many = { lane_of(change.position, lane), lane_of(change.velocity, lane) };
			CHECK(identical(one, of_many));
		}
	}
}

TEST_CASE("what comes faster than the threshold is thrown back by its restitution, and nothing else") {
	CHECK(rebound_speed(Real(2), Real(0.5), Real(1)) == 1);
	CHECK(rebound_speed(Real(1), Real(0.5), Real(1)) == 0);
	CHECK(rebound_speed(Real(-2), Real(0.5), Real(1)) == 0);
	CHECK(rebound_speed(NOT_A_NUMBER, Real(0.5), Real(1)) == 0);
	CHECK(rebound_speed(RealPack(2), Real(1), INFINITE)[0] == 0);
}

TEST_CASE("a touch remembers its fastest approach, forgets it while the body hardly moves, and begins anew") {
	struct {
		bool touching = false;
		Real approach = 9;
		bool ended = false;
		Real missing = 0;
	} touch;
	remember_approach(touch, Real(2), Real(1), Real(0.01));
	CHECK(touch.touching);
	CHECK(touch.approach == 2); // not what another touch left behind
	remember_approach(touch, Real(-3), Real(1), Real(0.01));
	CHECK(touch.approach == 2);
	remember_approach(touch, Real(3), Real(1), Real(0.01));
	CHECK(touch.approach == 3);
	remember_approach(touch, Real(-1), Real(1), BOUNCE_MEMORY / 4);
	CHECK(double(touch.approach) == doctest::Approx(3 * 0.75));
	remember_approach(touch, Real(0), Real(1), 2 * BOUNCE_MEMORY);
	CHECK(touch.approach == 0);
}
