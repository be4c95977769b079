// SPDX-License-Identifier: MIT
// Claims about one answered contact: impulse, friction, restitution, position, and rolling resistance.
#include "core/collision/surface_constraint.h"
#include "core/dynamics/energy.h"
#include "core/model/body_frame.h"
#include "scenes/loose_points.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"
#include "thesis/momentum.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real H = Real(0.01);

// Four loose points of unequal mass, friction and restitution as given.
SoftBodyData points(Real friction, Real restitution, std::vector<Real> masses = { 1, 2, 3, 4 }) {
	SoftBodyShape::Description description;
	description.points = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
	description.masses = std::move(masses);
	description.hull_count = 4;
	BodySettings settings;
	settings.friction = friction;
	settings.restitution = restitution;
	return SoftBodyData::create(SoftBodyShape::create(description).value(), settings).value();
}

Surface surface_of(Real friction, Real restitution) {
	Surface surface;
	surface.friction = friction;
	surface.restitution = restitution;
	return surface;
}

Vec2 at_place(std::span<const Vec2> values, const HullPlace &place) {
	return values[place.a] * (1 - place.t) + values[place.b] * place.t;
}

// What contacts of this summed normal impulse leave behind, on surfaces of this spin.
ContactLoad load_of(Real normal_impulse, Real spin = 0) {
	ContactLoad load;
	Surface surface;
	surface.angular_velocity = spin;
	load.add(normal_impulse, { 0, 1 }, 0, {}, surface, 0);
	return load;
}

// A spinning thesis body for the rolling tests.
SoftBodyData spinning(Real resistance, Real spin) {
	BodySettings settings;
	settings.rolling_resistance = resistance;
	SoftBodyData body = thesis_body(thesis_shape(), settings);
	Random random(121);
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		const Vec2 p = body.positions()[i] + random.vector(0.05);
		body.set_point(i, p, Vec2{ 1, 2 } + perpendicular(p) * spin + random.vector(0.1));
	}
	return body;
}

double inertia_now(const SoftBodyData &body) {
	const Vec2 center = measure_frame(body).center;
	double inertia = 0;
	for (std::size_t i = 0; i < body.point_count(); ++i) {
		inertia += double(body.shape().masses()[i]) * double(length_squared(body.positions()[i] - center));
	}
	return inertia;
}

} // namespace

TEST_CASE("a contact obeys Coulomb's law, returns the restitution, and pushes with one impulse, at any place") {
	Random random(122);
	for (int round = 0; round < 2000; ++round) {
		const Real friction = random.real(0, 2);
		const Real restitution = random.real(0, 1);
		SoftBodyData body = points(friction, restitution);
		for (std::uint32_t i = 0; i < 4; ++i) {
			body.set_point(i, body.positions()[i], random.vector(3));
		}
		const bool edge = random.chance(0.5);
		HullPlace place{ 1, 1, 0 };
		if (edge) {
			place = { 1, 2, random.real(0, 1) };
		}
		Surface surface = surface_of(10, 0);
		surface.linear_velocity = random.vector(1);
		surface.angular_velocity = random.real(-1, 1);
		surface.velocity_origin = random.vector(1);
		const Vec2 normal = Rotation::from_angle(random.real(-3.1, 3.1)).apply({ 0, 1 });
		const Real depth = random.real(0, 0.1);
		const auto x = copy_of(body.positions());
		const auto v = copy_of(body.velocities());
		const Vec2 there = at_place(x, place);
		const Vec2 relative = at_place(v, place) - surface.velocity_at(there);
		const Real impulse = solve_surface_contact(body, { place, normal, depth }, surface, 0, H).normal;

		const Vec2 tangent = perpendicular(normal);
		const Vec2 after = at_place(body.velocities(), place) - surface.velocity_at(there);
		const double rounding = 100 * EPSILON * 10; // speeds up to 10, a dozen products
		const double approach = -double(dot(relative, normal));
		Vec2 brake;
		if (approach <= 0) {
			CHECK(impulse == 0);
			CHECK(identical(body.velocities(), v)); // it may leave as it likes
		} else {
			CHECK(std::abs(double(dot(after, normal)) - double(restitution) * approach) <= rounding);
			const double normal_change = (1 + double(restitution)) * approach;
			const double slide = dot(relative, tangent);
			const double slide_after = dot(after, tangent);
			const double expected = slide > 0 ? std::fmax(0, slide - double(friction) * normal_change) : std::fmin(0, slide + double(friction) * normal_change);
			CHECK(std::abs(slide_after - expected) <= rounding);
			brake = tangent * Real(slide_after - slide);
			// The momentum that each end got is its share of one impulse.
			Vec2 total;
			for (std::size_t i = 0; i < 4; ++i) {
				total += (body.velocities()[i] - v[i]) * body.shape().masses()[i];
			}
			CHECK(std::abs(double(dot(total, normal)) - impulse) <= rounding * 10); // masses up to 4
			CHECK(double(std::abs(dot(total, tangent))) <= double(friction) * impulse + rounding * 10);
			for (const std::size_t i : { place.a, place.b }) {
				const Real share = !edge ? 1 : (i == place.a ? 1 - place.t : place.t);
				const Vec2 got = (body.velocities()[i] - v[i]) * body.shape().masses()[i];
				CHECK(distance(got, total * share) <= rounding * 10);
			}
		}
		// The place moves out by the depth, and back by the way that friction took.
		const Vec2 moved = at_place(body.positions(), place) - there;
		CHECK(distance(moved, normal * depth + brake * H) <= rounding * double(H) + 100 * EPSILON);
		for (std::uint32_t i = 0; i < 4; ++i) {
			if (i != place.a && i != place.b) {
				CHECK(body.positions()[i] == x[i]);
				CHECK(body.velocities()[i] == v[i]);
			}
		}
	}
}

TEST_CASE("moving out of a deep overlap gives no velocity") {
	SoftBodyData body = points(1, 1);
	solve_surface_contact(body, { { 0, 0, 0 }, { 0, 1 }, 5 }, surface_of(1, 1), 0, H);
	CHECK(body.positions()[0] == Vec2{ -1, 4 });
	CHECK(body.velocities()[0] == Vec2{});
	solve_surface_contact(body, { { 1, 2, Real(0.5) }, { 0, 1 }, 5 }, surface_of(1, 1), 0, H);
	CHECK(body.velocities()[1] == Vec2{});
	CHECK(body.velocities()[2] == Vec2{});
	CHECK(body.positions()[1].y > -1);
}

TEST_CASE("pinned points do not move; on an edge the free end does all the moving") {
	SoftBodyData body = points(1, 0);
	body.set_point(2, body.positions()[2], { 0, -3 });
	body.set_pinned(1, true);
	const Vec2 pin = body.positions()[1];
	CHECK(solve_surface_contact(body, { { 1, 1, 0 }, { 0, 1 }, 1 }, {}, 0, H).normal == 0);
	CHECK(body.positions()[1] == pin);
	const HullPlace place{ 1, 2, Real(0.5) };
	const Vec2 before = at_place(body.positions(), place);
	CHECK(solve_surface_contact(body, { place, { 0, 1 }, 1 }, {}, 0, H).normal > 0);
	CHECK(body.positions()[1] == pin);
	CHECK(body.velocities()[1] == Vec2{});
	CHECK(distance(at_place(body.positions(), place), before + Vec2{ 0, 1 }) <= 8 * EPSILON);
	CHECK(std::abs(double(body.velocities()[2].y)) <= 8 * EPSILON);
}

TEST_CASE("an edge contact beside a pinned end does not throw the free end away") {
	// Moving the place by the depth would move the free end by depth / t, without bound as t goes to 0.
	for (const Real t : { Real(0.01), Real(0.0001) }) {
		SoftBodyData body = points(0, 0);
		body.set_pinned(1, true);
		body.set_point(2, body.positions()[2], { 0, -1 });
		const Vec2 before = body.positions()[2];
		solve_surface_contact(body, { { 1, 2, t }, { 0, 1 }, Real(0.5) }, {}, 0, H);
		CHECK(distance(body.positions()[2], before) <= 10 * 0.5);
		CHECK(double(length(body.velocities()[2])) <= 10);
	}
}

TEST_CASE("a contact at the end of an edge is a contact of that point") {
	for (const Real t : { Real(0), Real(1) }) {
		SoftBodyData body = points(0, 0);
		const std::uint32_t end = t == 0 ? 1 : 2;
		body.set_point(end, body.positions()[end], { 0, -3 });
		const Real impulse = solve_surface_contact(body, { { 1, 2, t }, { 0, 1 }, Real(0.5) }, {}, 0, H).normal;
		CHECK(impulse == 3 * body.shape().masses()[end]);
		CHECK(body.velocities()[1] == Vec2{});
		CHECK(body.velocities()[2] == Vec2{});
		CHECK(body.positions()[t == 0 ? 2 : 1] == body.shape().rest_positions()[t == 0 ? 2 : 1] + body.shape().origin_offset());
	}
}

TEST_CASE("approach speeds up to the threshold do not bounce") {
	for (const Real speed : { Real(0.5), Real(1), Real(1.5) }) {
		SoftBodyData body = points(0, 1, { 1, 1, 1, 1 });
		body.set_point(0, { 0, 0 }, { 0, -speed });
		solve_surface_contact(body, { { 0, 0, 0 }, { 0, 1 }, 0 }, surface_of(0, 0), 1, H);
		CHECK(body.velocities()[0].y == (speed > 1 ? speed : 0));
	}
}

TEST_CASE("restitution adds up to at most one; an absorbent surface takes its own away, to at least none") {
	struct Case {
		Real body, surface;
		bool absorbent;
		Real expected;
	};
	for (const Case &each : { Case{ Real(0.25), Real(0.5), false, Real(0.75) }, Case{ Real(0.75), Real(0.5), false, 1 }, Case{ Real(0.75), Real(0.5), true, Real(0.25) }, Case{ Real(0.25), Real(0.5), true, 0 } }) {
		SoftBodyData body = points(0, each.body, { 1, 1, 1, 1 });
		body.set_point(0, { 0, 0 }, { 0, -4 });
		Surface surface = surface_of(0, each.surface);
		surface.absorbent = each.absorbent;
		solve_surface_contact(body, { { 0, 0, 0 }, { 0, 1 }, 0 }, surface, 0, H);
		CHECK(body.velocities()[0].y == each.expected * 4);
	}
}

TEST_CASE("the smaller friction counts, unless the surface is rough") {
	struct Case {
		Real body, surface;
		bool rough;
		Real expected;
	};
	for (const Case &each : { Case{ Real(0.5), Real(0.25), false, Real(0.25) }, Case{ Real(0.25), Real(0.5), false, Real(0.25) }, Case{ Real(0.25), Real(0.5), true, Real(0.5) }, Case{ Real(0.5), Real(0.25), true, Real(0.25) } }) {
		SoftBodyData body = points(each.body, 0, { 1, 1, 1, 1 });
		body.set_point(0, { 0, 0 }, { 8, -4 });
		Surface surface = surface_of(each.surface, 0);
		surface.rough = each.rough;
		solve_surface_contact(body, { { 0, 0, 0 }, { 0, 1 }, 0 }, surface, 0, H);
		CHECK(body.velocities()[0].x == 8 - each.expected * 4);
	}
}

TEST_CASE("a body may be rough or absorbent, too; of two rough sides the larger friction counts") {
	struct Case {
		Real body, surface;
		bool is_rough;
		Real expected;
	};
	for (const Case &each : { Case{ Real(0.5), Real(0.25), false, Real(0.5) }, Case{ Real(0.25), Real(0.5), false, Real(0.25) }, Case{ Real(0.25), Real(0.5), true, Real(0.5) }, Case{ Real(0.5), Real(0.25), true, Real(0.5) } }) {
		BodySettings settings;
		settings.friction = each.body;
		settings.rough = true;
		Surface surface = surface_of(each.surface, 0);
		surface.rough = each.is_rough;
		CHECK(combined_friction(settings, surface) == each.expected);
		settings.restitution = each.body;
		settings.absorbent = true;
		surface.restitution = each.surface;
		surface.absorbent = each.is_rough;
		CHECK(combined_restitution(settings, surface) == (each.is_rough ? 0 : std::max(each.surface - each.body, Real(0))));
	}
}

TEST_CASE("rolling resistance takes at most r R J / I off the spin, keeps linear momentum, never reverses") {
	for (const Real spin : { Real(4), Real(-4), Real(0.001) }) {
		for (const Real impulse : { Real(0.1), Real(1), Real(1000) }) {
			const Real resistance = Real(0.25);
			SoftBodyData body = spinning(resistance, spin);
			const Momentum before = measure_momentum(body, measure_frame(body).center);
			const auto positions = copy_of(body.positions());
			const double most = double(resistance) * double(body.shape().radius()) * double(impulse) / inertia_now(body);
			resist_rolling<Real>(lanes_of(body), load_of(impulse));
			const Momentum after = measure_momentum(body, measure_frame(body).center);
			const double rounding = 100 * EPSILON * 4;
			CHECK(std::abs(after.linear_x - before.linear_x) <= rounding);
			CHECK(std::abs(after.linear_y - before.linear_y) <= rounding);
			const double inertia = inertia_now(body);
			const double spin_before = before.angular / inertia;
			const double expected = spin_before > 0 ? std::fmax(0, spin_before - most) : std::fmin(0, spin_before + most);
			CHECK(std::abs(after.angular / inertia - expected) <= rounding);
			CHECK(identical(body.positions(), positions));
		}
	}
}

TEST_CASE("on a turning surface the spin tends to that of the surface, weighted by impulse") {
	SoftBodyData body = spinning(1, 0);
	ContactLoad load = load_of(300, 6);
	Surface slower;
	slower.angular_velocity = 2;
	load.add(100, { 0, 1 }, 0, {}, slower, 0);
	CHECK(load.normal_impulse == 400);
	resist_rolling<Real>(lanes_of(body), load);
	CHECK(std::abs(double(measure_frame(body).angular_velocity) - 5) <= 100 * EPSILON * 5);
}

TEST_CASE("without resistance or load nothing changes, and pinned points stay still") {
	SoftBodyData free = spinning(0, 4);
	const auto before = copy_of(free.velocities());
	resist_rolling<Real>(lanes_of(free), load_of(10));
	CHECK(identical(free.velocities(), before));
	SoftBodyData flying = spinning(1, 4);
	resist_rolling<Real>(lanes_of(flying), {});
	CHECK(identical(flying.velocities(), before));
	flying.set_pinned(3, true);
	resist_rolling<Real>(lanes_of(flying), load_of(10));
	CHECK(flying.velocities()[3] == Vec2{});
	CHECK_FALSE(flying.velocities()[2] == before[2]);
}
