// SPDX-License-Identifier: MIT
// Lists of candidates hold as long as they say, and bodies that use them part as bodies that search in every substep.
#include "core/base/constants.h"
#include "core/collision/environment_contact_solver.h"
#include "core/collision/pair_contact_solver.h"
#include "core/geometry/polygon.h"
#include "scenes/circle.h"
#include "support/random.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <span>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real H = Real(1) / 420; // s

// A ring of points without forces, as the solver of pairs sees it.
struct Ring {
	std::vector<Vec2> positions;
	std::vector<Vec2> before;
	std::vector<Vec2> velocities;
	std::vector<Real> inverse_masses;
	SolverBody body;

	Ring(Vec2 center, int points, Real angle, Vec2 velocity) {
		for (int i = 0; i < points; ++i) {
			positions.push_back(center + Rotation::from_angle(angle + Real(6.283185307179586 * i / points)).apply({ 1, 0 }));
		}
		before = positions;
		velocities.assign(std::size_t(points), velocity);
		inverse_masses.assign(std::size_t(points), 1);
	}
	SolverBody &solver_body() {
		body.positions = positions;
		body.before = before;
		body.velocities = velocities;
		body.inverse_masses = inverse_masses;
		body.inverse_mass = 1 / Real(positions.size());
		body.width = 1;
		body.rest_radius = 1;
		body.friction = Real(0.4);
		return body;
	}
	void move() {
		for (std::size_t i = 0; i < positions.size(); ++i) {
			positions[i] += velocities[i] * H;
		}
		body.measure_extent();
	}
};

} // namespace

TEST_CASE("bodies that keep their candidates through a step move as bodies without any do: 400 random pairs") {
	Random random(77);
	std::size_t contacts = 0;
	int differences = 0;
	int kept = 0;
	for (int round = 0; round < 400; ++round) {
		CAPTURE(round);
		const int points = random.integer(5, 40);
		const Vec2 aside = random.vector(0.5);
		const Vec2 speed{ random.real(0, 3), random.real(-2, 2) };
		const Ring left({ -1 + random.real(-0.02, 0.02), 0 }, points, random.real(0, 6), speed);
		const Ring right({ 1, aside.y }, random.integer(5, 40), random.real(0, 6), -speed);
		Ring a[2] = { left, left };
		Ring b[2] = { right, right };
		PairContactSolver solver;
		solver.begin_substep(H);
		PairCandidates candidates;
		constexpr int SUBSTEPS = 16;
		for (int substep = 0; substep < SUBSTEPS; ++substep) {
			std::size_t found[2] = {};
			for (const int way : { 0, 1 }) { // with a list, and without
				for (Ring *ring : { &a[way], &b[way] }) {
					SolverBody &body = ring->solver_body();
					if (substep == 0) {
						body.begin_step();
						body.pace = fastest(ring->velocities);
					} else {
						body.begin_substep();
					}
					ring->move();
				}
				PairCandidates none;
				const int left_over = way == 0 ? SUBSTEPS - substep - 1 : 0;
				kept += way == 0 && candidates.holds_at(a[0].body.path + a[0].body.way + b[0].body.path + b[0].body.way);
				found[way] = solver.handle(a[way].body, b[way].body, way == 0 ? candidates : none, left_over);
			}
			contacts += found[0];
			differences += found[0] != found[1]; // a point that lies on an edge may count as in or out
			for (std::size_t i = 0; i < a[0].positions.size(); ++i) {
				CHECK(double(length(a[0].positions[i] - a[1].positions[i])) <= 1e-5);
			}
		}
	}
	CHECK(contacts > 2000);
	CHECK(differences < 64); // of 6,400 substeps
	CHECK(kept > 3000);
}

namespace {

bool is_listed(std::span<const PairCandidate> list, std::size_t point) {
	return std::ranges::any_of(list, [&](const PairCandidate &each) { return each.point == point; });
}

// Longest summed path at which the list holds.
Real reach_of(const PairCandidates &candidates) {
	Real holds = 0;
	for (Real by = 1; by > Real(1e-6); by /= 2) {
		holds += candidates.holds_at(holds + by) ? by : 0;
	}
	return holds;
}

} // namespace

// Bodies of two sizes, of which the smaller may lie deep inside the larger one, and hulls with dents.
TEST_CASE("while a list of candidates holds, no point that is not listed comes into the other hull: 2,000 random pairs") {
	Random random(79);
	int inside = 0;
	int lists = 0;
	std::size_t most = 0;
	for (int round = 0; round < 2000; ++round) {
		CAPTURE(round);
		Ring a({ 0, 0 }, random.integer(3, 40), random.real(0, 6), random.vector(4));
		Ring b(random.vector(2), random.integer(3, 40), random.real(0, 6), random.vector(4));
		const Real size = round % 2 == 0 ? Real(1) : random.real(0.1, 1);
		for (std::size_t i = 0; i < b.positions.size(); ++i) {
			b.positions[i] = b.before[0] + (b.positions[i] - b.before[0]) * (size * random.real(0.6, 1));
		}
		for (Ring *ring : { &a, &b }) {
			ring->solver_body().begin_step();
			ring->body.pace = fastest(ring->velocities);
			ring->move();
		}
		const std::vector<Vec2> start_a = a.before;
		const std::vector<Vec2> start_b = b.before;
		PairContactSolver solver;
		solver.begin_substep(H);
		PairCandidates candidates;
		solver.handle(a.body, b.body, candidates, random.integer(1, 8));
		if (!candidates.holds_at(0)) {
			continue;
		}
		++lists;
		most = std::max(most, candidates.of_first().size() + candidates.of_second().size());
		const Real reach = reach_of(candidates);
		for (int other_round = 0; other_round < 8; ++other_round) {
			const Real share = random.real(0, 1);
			const auto moved = [&](std::span<const Vec2> from, Real by) {
				std::vector<Vec2> to(from.begin(), from.end());
				const Vec2 way = random.vector(0.7) * by; // towards the other body or away, and every point by itself
				for (Vec2 &p : to) {
					p += way + random.vector(0.25) * (by * Real(0.4));
				}
				return to;
			};
			const std::vector<Vec2> hull_a = moved(start_a, reach * share);
			const std::vector<Vec2> hull_b = moved(start_b, reach * (1 - share));
			for (std::size_t i = 0; i < hull_a.size(); ++i) {
				inside += point_in_polygon(hull_a[i], hull_b);
				CHECK((is_listed(candidates.of_first(), i) || !point_in_polygon(hull_a[i], hull_b)));
			}
			for (std::size_t i = 0; i < hull_b.size(); ++i) {
				CHECK((is_listed(candidates.of_second(), i) || !point_in_polygon(hull_b[i], hull_a)));
			}
		}
	}
	CHECK(lists > 500);
	CHECK(inside > 1000);
	CHECK(most == PairCandidates::MOST);
}

TEST_CASE("a point that is nearer to the far side of a thin body is followed from the side through which it came") {
	for (const Real height : { Real(-0.6), Real(-0.95) }) { // farther from the far side than the margin, and nearer
		CAPTURE(height);
		Ring plank({ 0, 0 }, 4, 0, {});
		plank.positions = { { -3, -1 }, { 3, -1 }, { 3, 0 }, { -3, 0 } };
		Ring above({ 0, 0 }, 3, 0, { 0, Real(0.1) / H });
		above.positions = { { 0, height }, { 1, 2 }, { -1, 2 } };
		for (Ring *ring : { &plank, &above }) {
			ring->solver_body().begin_step();
			ring->move();
		}
		PairContactSolver solver;
		solver.begin_substep(H);
		PairCandidates candidates;
		solver.handle(plank.body, above.body, candidates, 3);
		REQUIRE(candidates.of_second().size() == 1);
		CHECK(candidates.of_second()[0].point == 0);
		CHECK(candidates.of_second()[0].edge == 2); // the upper one
		CHECK(above.positions[0].y > height);
	}
}

TEST_CASE("a list of candidates holds at the path that it was made for, and not once it has overflown") {
	PairCandidates candidates;
	CHECK_FALSE(candidates.holds_at(0));
	candidates.add({ 3, 4 });
	candidates.begin_second();
	candidates.add({ 5, 6 });
	candidates.hold_until(2);
	CHECK(candidates.holds_at(2));
	CHECK_FALSE(candidates.holds_at(Real(2.001)));
	REQUIRE(candidates.of_first().size() == 1);
	CHECK(candidates.of_first()[0].point == 3);
	REQUIRE(candidates.of_second().size() == 1);
	CHECK(candidates.of_second()[0].edge == 6);
	for (std::size_t i = 2; i < PairCandidates::MOST; ++i) {
		candidates.add({ std::uint16_t(i), 0 });
	}
	candidates.hold_until(2);
	CHECK(candidates.holds_at(2));
	CHECK(candidates.of_second().size() == PairCandidates::MOST - 1);
	candidates.add({ 1, 0 });
	candidates.hold_until(2);
	CHECK_FALSE(candidates.holds_at(0));
	candidates.clear();
	CHECK(candidates.of_first().empty());
	CHECK(candidates.of_second().empty());
	CHECK_FALSE(candidates.holds_at(0));
}

TEST_CASE("the path of a body counts what contacts and others have moved it, in any direction") {
	Random random(78);
	for (int round = 0; round < 100; ++round) {
		Ring ring({ 0, 0 }, random.integer(3, 20), 0, { 1, 0 });
		SolverBody &body = ring.solver_body();
		body.begin_step();
		CHECK(body.path == 0);
		double longest = 0;
		for (Vec2 &p : ring.positions) {
			const Vec2 by = random.vector(0.3);
			longest = std::max(longest, double(length(by)));
			p += by;
		}
		body.begin_substep();
		CHECK(double(body.path) >= longest * (1 - 1e-5));
		CHECK(double(body.path) <= longest * 1.4143);
		const Real path = body.path;
		body.begin_substep();
		CHECK(body.path == path); // nothing has moved since
	}
}
