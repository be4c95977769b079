// SPDX-License-Identifier: MIT
// A contact between two bodies keeps momentum and spin, and obeys Coulomb's law.
#include "core/collision/pair_constraint.h"
#include "core/base/constants.h"
#include "support/compare.h"
#include "support/random.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real H = Real(1) / 240;

// A triangle whose point 0 is above the edge from point 0 to 1 of another.
struct Meeting {
	std::array<Vec2, 3> upper{ Vec2{ Real(0.3), Real(-0.01) }, Vec2{ 1, 1 }, Vec2{ -1, 1 } };
	std::array<Vec2, 3> lower{ Vec2{ 1, 0 }, Vec2{ -1, 0 }, Vec2{ 0, -1 } };
	std::array<Vec2, 3> upper_velocities{};
	std::array<Vec2, 3> lower_velocities{};
	std::array<Real, 3> upper_masses{ 2, 1, 1 };
	std::array<Real, 3> lower_masses{ 1, 3, 1 };
	std::array<Real, 3> upper_inverse{};
	std::array<Real, 3> lower_inverse{};
	std::array<Vec2, 3> upper_before{};
	std::array<Vec2, 3> lower_before{};
	Real fresh_share = 1;
	Real whole_mass_counts = 1; // 0: as if a point were pinned
	bool velocity_leads = false;
	Real friction = 0;
	Real t = Real(0.35); // of the lower edge, under the upper point

	SolverBody touching(std::span<Vec2> positions, std::span<Vec2> velocities, std::span<const Real> inverse_masses,
			std::span<Vec2> before) const {
		SolverBody body;
		body.positions = positions;
		body.velocities = velocities;
		body.inverse_masses = inverse_masses;
		body.before = before;
		body.width = body.radius = body.rest_radius = 1;
		body.friction = friction;
		return body;
	}
	static Real total(const std::array<Real, 3> &masses) { return masses[0] + masses[1] + masses[2]; }
	Real solve(Real depth) {
		for (std::size_t i = 0; i < 3; ++i) {
			upper_inverse[i] = upper_masses[i] > 0 ? 1 / upper_masses[i] : Real(0);
			lower_inverse[i] = lower_masses[i] > 0 ? 1 / lower_masses[i] : Real(0);
		}
		SolverBody a = touching(upper, upper_velocities, upper_inverse, upper_before);
		SolverBody b = touching(lower, lower_velocities, lower_inverse, lower_before);
		a.inverse_mass = whole_mass_counts / total(upper_masses);
		b.inverse_mass = whole_mass_counts / total(lower_masses);
		a.velocity_leads = velocity_leads;
		for (std::size_t i = 0; i < 3; ++i) { // the whole depth comes from this substep unless a test says otherwise
			upper_before[i] = upper[i] + Vec2{ 0, fresh_share * depth };
			lower_before[i] = lower[i];
		}
		return solve_pair_contact(a, b, { 0, 0, 1, t, { 0, 1 }, depth }, H);
	}
	Vec2 place_velocity() const {
		return lower_velocities[0] * (1 - t) + lower_velocities[1] * t;
	}
	Vec2 relative() const { return upper_velocities[0] - place_velocity(); }
	double kinetic() const {
		double sum = 0;
		for (std::size_t i = 0; i < 3; ++i) {
			sum += double(upper_masses[i]) * length_squared(upper_velocities[i]) / 2;
			sum += double(lower_masses[i]) * length_squared(lower_velocities[i]) / 2;
		}
		return sum;
	}
	Vec2 momentum() const {
		Vec2 sum;
		for (std::size_t i = 0; i < 3; ++i) {
			sum += upper_velocities[i] * upper_masses[i] + lower_velocities[i] * lower_masses[i];
		}
		return sum;
	}
	// About the origin, with the places where the points were when they met.
	double spin(const Meeting &places) const {
		double sum = 0;
		for (std::size_t i = 0; i < 3; ++i) {
			sum += double(upper_masses[i]) * cross(places.upper[i], upper_velocities[i]);
			sum += double(lower_masses[i]) * cross(places.lower[i], lower_velocities[i]);
		}
		return sum;
	}
	Vec2 center() const {
		Vec2 sum;
		for (std::size_t i = 0; i < 3; ++i) {
			sum += upper[i] * upper_masses[i] + lower[i] * lower_masses[i];
		}
		return sum;
	}
};

Meeting random_meeting(Random &random) {
	Meeting meeting;
	meeting.upper[0].x = random.real(-0.95, 0.95);
	meeting.t = (1 - meeting.upper[0].x) / 2;
	meeting.upper[0].y = 0; // on the edge: so that the arms of the impulses agree
	meeting.friction = random.real(0, 1);
	meeting.velocity_leads = random.chance(0.5);
	for (std::size_t i = 0; i < 3; ++i) {
		meeting.upper_velocities[i] = random.vector(5);
		meeting.lower_velocities[i] = random.vector(5);
		meeting.upper_masses[i] = random.real(0.1, 10);
		meeting.lower_masses[i] = random.real(0.1, 10);
	}
	return meeting;
}

} // namespace

TEST_CASE("a contact between bodies keeps linear and angular momentum and adds no energy") {
	Random random(31);
	for (int i = 0; i < 2000; ++i) {
		const Meeting before = random_meeting(random);
		Meeting after = before;
		after.solve(random.real(0, 0.05));
		CHECK(double(length(after.momentum() - before.momentum())) <= 1e-4);
		CHECK(std::abs(after.spin(before) - before.spin(before)) <= 1e-4);
		CHECK(after.kinetic() <= before.kinetic() * (1 + 1e-5));
		CHECK(double(length(after.center() - before.center())) <= 1e-4);
	}
}

TEST_CASE("point and edge part by the depth along the normal, and no further than the longest push") {
	Meeting meeting;
	const auto gap = [&] {
		const Real t = (1 - Real(0.3)) / 2;
		return double(meeting.upper[0].y - (meeting.lower[0].y * (1 - t) + meeting.lower[1].y * t));
	};
	CHECK(gap() == doctest::Approx(-0.01));
	CHECK(meeting.solve(Real(0.01)) == 0); // at rest: moved, without an impulse
	CHECK(gap() == doctest::Approx(0).epsilon(1e-6));
	for (const Vec2 v : meeting.upper_velocities) {
		CHECK(v == Vec2{});
	}
}

TEST_CASE("what is deep inside parts as a whole: no point moves against its neighbors further than a tenth of a radius") {
	Meeting meeting;
	meeting.fresh_share = 0;
	const Meeting before = meeting;
	meeting.solve(Real(0.5));
	const Vec2 way = meeting.upper[1] - before.upper[1];
	CHECK(way == meeting.upper[2] - before.upper[2]);
	CHECK(way.y > 0);
	CHECK(double(length((meeting.upper[0] - before.upper[0]) - way)) <= 0.1 + 1e-6);
	CHECK(meeting.lower[2].y < before.lower[2].y);
	CHECK(double(length(meeting.center() - before.center())) <= 1e-5);
	for (const Vec2 v : meeting.upper_velocities) {
		CHECK(v == Vec2{});
	}
	Meeting pinned;
	pinned.fresh_share = 0;
	pinned.whole_mass_counts = 0; // then the points have to part alone
	pinned.solve(Real(0.5));
	CHECK(pinned.upper[1] == before.upper[1]);
	CHECK(double(pinned.upper[0].y - (pinned.lower[0].y * Real(0.65) + pinned.lower[1].y * Real(0.35))) ==
			doctest::Approx(0.49));
}

TEST_CASE("the approach is taken as far as it brought the point inside, and never turned") {
	Meeting meeting;
	meeting.upper_velocities[0] = { 0, -2 };
	meeting.solve(Real(0.5) * H); // inside since a quarter of the substep
	CHECK(double(meeting.relative().y) == doctest::Approx(-1.5));
	meeting = {};
	meeting.upper_velocities[0] = { 0, -2 };
	meeting.solve(Real(0.09)); // far deeper than it came by itself
	CHECK(double(meeting.relative().y) == doctest::Approx(0).epsilon(1e-6));
	meeting = {};
	meeting.upper_velocities[0] = { 0, 3 };
	CHECK(meeting.solve(Real(0.09)) == 0);
	CHECK(double(meeting.relative().y) == doctest::Approx(3)); // already leaving
}

TEST_CASE("of a velocity that is ahead of the way, the approach that no way has shown yet is taken too") {
	// The point went 0.5 H in this substep, a quarter of what it would at its speed of 2, and all of it inside.
	for (const bool velocity_leads : { false, true }) {
		Meeting meeting;
		meeting.velocity_leads = velocity_leads;
		meeting.upper_velocities[0] = { 0, -2 };
		meeting.solve(Real(0.5) * H);
		CHECK(double(meeting.relative().y) == doctest::Approx(velocity_leads ? 0 : -1.5).epsilon(1e-6));
	}
	// It went all of its way, and only a quarter of that inside: the forces had no part in it.
	Meeting meeting;
	meeting.velocity_leads = true;
	meeting.fresh_share = 4;
	meeting.upper_velocities[0] = { 0, -2 };
	meeting.solve(Real(0.5) * H);
	CHECK(double(meeting.relative().y) == doctest::Approx(-1.5).epsilon(1e-5));
}

TEST_CASE("sliding loses at most the friction coefficient times the normal change, and then stops") {
	Meeting slides;
	slides.friction = Real(0.5);
	slides.upper_velocities[0] = { 3, -2 };
	slides.solve(Real(0.09));
	CHECK(double(slides.relative().x) == doctest::Approx(2)); // 3 - 0.5 * 2
	Meeting sticks;
	sticks.friction = 2;
	sticks.upper_velocities[0] = { 3, -2 };
	const Real x = sticks.upper[0].x;
	sticks.solve(Real(0.09));
	CHECK(double(sticks.relative().x) == doctest::Approx(0).epsilon(1e-6));
	CHECK(sticks.upper[0].x < x); // the way slid in the substep is taken back too
}

TEST_CASE("a pinned point or edge does not move, and two of them leave each other alone") {
	Meeting meeting;
	meeting.lower_masses = { 0, 0, 1 }; // 0 stands for infinite here
	meeting.upper_velocities[0] = { 0, -2 };
	meeting.solve(Real(0.01));
	CHECK(meeting.lower[0] == Vec2{ 1, 0 });
	CHECK(meeting.lower_velocities[1] == Vec2{});
	CHECK(double(meeting.upper[0].y) == doctest::Approx(0).epsilon(1e-6));
	Meeting stuck;
	stuck.lower_masses = { 0, 0, 1 };
	stuck.upper_masses[0] = 0;
	stuck.upper_velocities[0] = { 0, -2 };
	CHECK(stuck.solve(Real(0.01)) == 0);
	CHECK(stuck.upper[0] == Vec2{ Real(0.3), Real(-0.01) });
}

TEST_CASE("an edge contact beside a pinned or heavy end does not throw the free end away, and keeps momentum") {
	// A heavy point on the edge next to an end that hardly moves: to make way alone the light end would go by depth / (1 - t).
	for (const Real heavy : { Real(0), Real(1e6) }) { // 0: pinned
		for (const Real t : { Real(0.99), Real(0.9999) }) {
			CAPTURE(heavy);
			Meeting meeting;
			meeting.lower_masses = { 1, heavy, 1 };
			meeting.upper_masses[0] = 1e6;
			meeting.t = t;
			meeting.upper_velocities[0] = { 0, -3 };
			Meeting after = meeting;
			CHECK(after.solve(Real(0.01)) > 0);
			CHECK(distance(after.lower[0], meeting.lower[0]) <= 5.01 * 0.01);
			CHECK(double(length(after.lower_velocities[0])) <= 5.01 * 3);
			const Vec2 change = after.momentum() - meeting.momentum();
			CHECK((heavy == 0 || double(length(change)) <= 4 * EPSILON * 3e6));
		}
	}
}

TEST_CASE("rolling resistance between bodies brakes their relative spin by at most r R J, and keeps angular momentum") {
	const auto spinning = [](Real spin, Real inertia) {
		SolverBody body;
		body.spin = spin;
		body.inertia = inertia;
		body.rolling_resistance = Real(0.1);
		body.rest_radius = 2;
		return body;
	};
	SolverBody a = spinning(5, 2);
	SolverBody b = spinning(-1, 4);
	resist_pair_rolling(a, b, 3); // at most 0.1 * 2 * 3 = 0.6
	CHECK(double(a.spin) == doctest::Approx(5 - 0.6 / 2));
	CHECK(double(b.spin) == doctest::Approx(-1 + 0.6 / 4));
	CHECK(double(a.spin_change) == doctest::Approx(-0.3));
	resist_pair_rolling(a, b, 1000); // enough to end it: both as one, with the spin of all
	CHECK(double(a.spin) == doctest::Approx((5 * 2 - 1 * 4) / 6.0));
	CHECK(double(b.spin) == doctest::Approx(double(a.spin)));
	SolverBody pinned = spinning(0, 0); // no inertia stands for what cannot turn
	a = spinning(5, 2);
	resist_pair_rolling(a, pinned, 1000);
	CHECK(a.spin == 0);
	CHECK(pinned.spin == 0);
	b = spinning(1, 1);
	b.rolling_resistance = 0;
	a = spinning(5, 2);
	resist_pair_rolling(a, b, 1000);
	CHECK(a.spin == 5);
}

TEST_CASE("what is about to be reset hands no number that is none to the body that it touches") {
	for (const Real bad : { NOT_A_NUMBER, INFINITE, -INFINITE }) {
		for (const bool is_place : { false, true }) {
			Meeting meeting;
			meeting.friction = Real(0.5);
			meeting.velocity_leads = true; // then all of an endless approach would count
			(is_place ? meeting.upper[0] : meeting.upper_velocities[0]) = { 0, bad };
			const std::array<Vec2, 3> places = meeting.lower;
			const Real impulse = meeting.solve(Real(0.01));
			CHECK(std::isfinite(impulse));
			CHECK(all_finite(meeting.lower));
			CHECK(all_finite(meeting.lower_velocities));
			CHECK(largest_distance(meeting.lower, places) < 0.02); // the depth, and no more than twice
		}
		SolverBody spinning;
		SolverBody other;
		for (SolverBody *body : { &spinning, &other }) {
			body->inertia = 1;
			body->rolling_resistance = Real(0.1);
			body->rest_radius = 1;
		}
		spinning.spin = bad;
		resist_pair_rolling(spinning, other, 1);
		CHECK(std::isfinite(other.spin));
		CHECK(std::isfinite(other.spin_change));
	}
}
