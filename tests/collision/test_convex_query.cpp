// SPDX-License-Identifier: MIT
// Claims about points and rounded convex colliders, against distances computed edge by edge in double.
#include "core/collision/convex_query.h"
#include "core/geometry/polygon.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace softbody;
using namespace softbody::testing;

namespace {

enum class Kind { CIRCLE,
	SEGMENT,
	CAPSULE,
	POLYGON,
	ROUNDED };
const Kind ALL_KINDS[] = { Kind::CIRCLE, Kind::SEGMENT, Kind::CAPSULE, Kind::POLYGON, Kind::ROUNDED };

Collider random_collider(Random &random, Kind kind) {
	Collider collider;
	const Vec2 center = random.vector(3);
	if (kind == Kind::CIRCLE) {
		collider.vertices = { center };
	} else if (kind == Kind::SEGMENT || kind == Kind::CAPSULE) {
		const Vec2 way = Rotation::from_angle(random.real(-3.1, 3.1)).apply({ random.real(0.5, 4), 0 });
		collider.vertices = { center - way, center + way };
	} else { // corners on an ellipse, a third of the circle apart at most
		const int count = random.integer(3, 8);
		const Vec2 axes{ random.real(0.3, 3), random.real(0.3, 3) };
		for (int i = 0; i < count; ++i) {
			const double angle = (i + double(random.real(0, 0.45))) * 6.283185307179586 / count;
			collider.vertices.push_back(center + Vec2{ axes.x * Real(std::cos(angle)), axes.y * Real(std::sin(angle)) });
		}
	}
	if (kind == Kind::CIRCLE || kind == Kind::CAPSULE || kind == Kind::ROUNDED) {
		collider.radius = random.real(0.2, 2);
	}
	REQUIRE_FALSE(check_collider(collider));
	return collider;
}

// Distance to the segment: to an end where the angle there is obtuse, to the line otherwise.
double segment_distance(Vec2 p, Vec2 a, Vec2 b) {
	const double pa = distance(p, a);
	const double pb = distance(p, b);
	const double ab = distance(a, b);
	if (pa * pa + ab * ab <= pb * pb) {
		return pa;
	}
	if (pb * pb + ab * ab <= pa * pa) {
		return pb;
	}
	const double twice_area = (double(a.x) - p.x) * (double(b.y) - p.y) - (double(a.y) - p.y) * (double(b.x) - p.x);
	return std::abs(twice_area) / ab;
}

// Signed distance of p from the surface, exact everywhere.
double true_distance(const Collider &collider, Vec2 p, double least_radius = 0) {
	const auto &vertices = collider.vertices;
	const double radius = std::fmax(collider.radius, vertices.size() < 3 ? least_radius : 0);
	if (vertices.size() == 1) {
		return distance(p, vertices[0]) - radius;
	}
	double to_border = double(INFINITE);
	bool inside = vertices.size() > 2;
	for (std::size_t i = 0; i < vertices.size(); ++i) {
		const Vec2 a = vertices[i];
		const Vec2 b = vertices[(i + 1) % vertices.size()];
		to_border = std::fmin(to_border, segment_distance(p, a, b));
		inside &= (double(b.x) - a.x) * (double(p.y) - a.y) - (double(b.y) - a.y) * (double(p.x) - a.x) > 0;
	}
	return (inside ? -to_border : to_border) - radius;
}

// Coordinates up to 12, a few products each.
constexpr double ROUNDING = 32 * EPSILON * 12;
constexpr Real SLOP = Real(0.001);

} // namespace

TEST_CASE("the distance to a rounded shape, and inside a polygon, is the distance to its edges") {
	Random random(111);
	int inside = 0;
	for (int round = 0; round < 5000; ++round) {
		const Kind kind = ALL_KINDS[round % 5];
		const Collider collider = random_collider(random, kind);
		const Vec2 p = random.vector(8);
		const Real least_radius = kind == Kind::SEGMENT ? SLOP : Real(0);
		const SurfaceDistance found = surface_distance(collider, p, least_radius);
		const double expected = true_distance(collider, p, double(least_radius));
		inside += expected < 0;
		CAPTURE(int(kind));
		CHECK(std::abs(double(length(found.normal)) - 1) <= 8 * EPSILON);
		if (kind == Kind::POLYGON && expected > 0) {
			CHECK(found.distance > -ROUNDING); // a lower bound of the right sign
			CHECK(found.distance <= expected + ROUNDING);
			continue;
		}
		CHECK(std::abs(double(found.distance) - expected) <= ROUNDING);
		// The normal leads to the surface, from either side.
		CHECK(std::abs(true_distance(collider, p - found.normal * found.distance, double(least_radius))) <= 2 * ROUNDING);
	}
	CHECK(inside > 150);
}

TEST_CASE("a least radius thickens what has no inside, and never thins anything") {
	const Collider segment{ { { 0, 0 }, { 4, 0 } }, 0, {} };
	CHECK(surface_distance(segment, { 2, 1 }, Real(0.25)).distance == Real(0.75));
	const Collider capsule{ { { 0, 0 }, { 4, 0 } }, Real(0.5), {} };
	CHECK(surface_distance(capsule, { 2, 1 }, Real(0.25)).distance == Real(0.5));
	const Collider circle{ { { 0, 0 } }, Real(0.5), {} };
	CHECK(surface_distance(circle, { 0, 2 }, 1).distance == 1);
}

TEST_CASE("at the very middle of a circle or segment there is still a normal") {
	const Collider circle{ { { 3, 4 } }, 1, {} };
	const Collider capsule{ { { 0, 0 }, { 4, 0 } }, 1, {} };
	CHECK(length(surface_distance(circle, { 3, 4 }).normal) == 1);
	CHECK(surface_distance(circle, { 3, 4 }).distance == -1);
	CHECK(length(surface_distance(capsule, { 2, 0 }).normal) == 1);
}

TEST_CASE("a contact puts the point outside, and where there is none it is outside already") {
	Random random(112);
	int found = 0;
	for (int round = 0; round < 20000; ++round) {
		const Kind kind = ALL_KINDS[round % 5];
		const Collider collider = random_collider(random, kind);
		const Vec2 from = random.vector(8);
		const Vec2 to = round % 3 == 0 ? from + random.vector(0.5) : random.vector(8);
		const double thickness = kind == Kind::SEGMENT ? double(SLOP) : 0;
		const auto contact = find_point_contact(collider, from, to, SLOP);
		CAPTURE(int(kind));
		CAPTURE(round);
		if (!contact) {
			CHECK(true_distance(collider, to, thickness) >= -ROUNDING);
			continue;
		}
		found++;
		CHECK(contact->depth > 0);
		// The swept circle divides by its radius, of at least 0.2.
		CHECK(std::abs(double(length(contact->normal)) - 1) <= (kind == Kind::CIRCLE ? ROUNDING : 8 * EPSILON));
		CHECK(true_distance(collider, to + contact->normal * contact->depth, thickness) >= -2 * ROUNDING);
		// Unless it started inside, the point is sent back towards where it came from.
		if (true_distance(collider, from, thickness) > ROUNDING) {
			if (kind == Kind::CIRCLE) { // never out of the far half
				CHECK(dot(contact->normal, from - collider.vertices[0]) > -ROUNDING);
			} else if (kind == Kind::POLYGON) { // out of a face that it came from the front of, or towards it
				CHECK(dot(contact->normal, from - to) > -ROUNDING);
			}
		}
	}
	CHECK(found > 2000);
}

TEST_CASE("a point that comes to lie right on a face is out, and no contact") {
	const Collider box = box_collider({ 0, 0 }, { 2, 1 });
	Collider dented = box;
	dented.concave = true;
	for (const Collider &collider : { box, dented }) {
		CHECK_FALSE(find_point_contact(collider, { Real(0.5), 2 }, { Real(0.5), 1 }, SLOP));
		CHECK_FALSE(find_point_contact(collider, { 3, Real(0.5) }, { 2, Real(0.5) }, SLOP));
		CHECK(find_point_contact(collider, { Real(0.5), 2 }, { Real(0.5), Real(0.99) }, SLOP));
	}
}

TEST_CASE("no path through the core of a collider goes unnoticed, and no path beside a collider is stopped") {
	// For a circle the core is taken as the middle: a path that only shaves the rim far from its ends
	// may pass.
	Random random(113);
	int through = 0;
	int beside = 0;
	for (int round = 0; round < 20000; ++round) {
		const Kind kind = ALL_KINDS[round % 5];
		Collider collider = random_collider(random, kind);
		const Vec2 from = random.vector(9);
		const Vec2 to = random.vector(9);
		Collider core = collider;
		core.radius = kind == Kind::CIRCLE ? collider.radius * Real(0.7) : 0;
		if (true_distance(collider, from) <= 0 || true_distance(collider, to) <= 0) {
			continue;
		}
		double deepest = double(INFINITE);
		for (int k = 1; k < 400; ++k) {
			deepest = std::fmin(deepest, true_distance(core, from + (to - from) * (Real(k) / 400)));
		}
		// Samples are up to 0.07 apart, so a path whose samples keep a distance of 0.1 keeps clear of the slop.
		if (deepest - (double(collider.radius) - double(core.radius)) > 0.1) {
			beside++;
			CHECK_FALSE(find_point_contact(collider, from, to, SLOP).has_value());
		}
		bool crosses = deepest < 0;
		if (kind == Kind::SEGMENT || kind == Kind::CAPSULE) { // no inside to sample: the sides of both lines
			const auto side = [](Vec2 a, Vec2 b, Vec2 p) { return double(cross(b - a, p - a)); };
			const Vec2 a = collider.vertices[0];
			const Vec2 b = collider.vertices[1];
			crosses = side(a, b, from) * side(a, b, to) < 0 && side(from, to, a) * side(from, to, b) < 0;
		}
		if (crosses) {
			through++;
			const auto contact = find_point_contact(collider, from, to, SLOP);
			CAPTURE(int(kind));
			REQUIRE(contact.has_value());
			const Vec2 back = to + contact->normal * contact->depth;
			CHECK(true_distance(collider, back) >= -2 * ROUNDING);
			CHECK(dot(contact->normal, from - to) > 0);
		}
	}
	CHECK(through > 1000);
	CHECK(beside > 1000);
}

TEST_CASE("a fast point returns to the side of a thin plate that it came from") {
	const Collider plate = box_collider({ 0, 0 }, { 10, Real(0.01) });
	const Collider segment{ { { -10, 0 }, { 10, 0 } }, 0, {} };
	for (const Real side : { Real(1), Real(-1) }) {
		for (const Real end : { Real(0.005), Real(0), Real(-0.005), Real(-3) }) { // half in, half through, far beyond
			const Vec2 from{ 1, side * 2 };
			const Vec2 to{ 2, side * end };
			const auto on_plate = find_point_contact(plate, from, to, SLOP);
			REQUIRE(on_plate.has_value());
			CHECK(on_plate->normal == Vec2{ 0, side });
			CHECK(std::abs(double(on_plate->depth) - (0.01 - double(end))) <= 8 * EPSILON * 4);
		}
		const auto on_segment = find_point_contact(segment, { 1, side * 2 }, { 2, side * -3 }, SLOP);
		REQUIRE(on_segment.has_value());
		CHECK(on_segment->normal == Vec2{ 0, side });
		CHECK(std::abs(double(on_segment->depth) - 3.001) <= 8 * EPSILON * 4);
	}
}

TEST_CASE("a point that rests on a thin plate and is slammed through it in one substep returns to its side") {
	// Contacts put a resting point onto the face, to rounding: just in front, on it, or just behind.
	const Collider plate = box_collider({ 0, 0 }, { 10, 1 });
	const Collider segment{ { { -10, 0 }, { 10, 0 } }, 0, {} };
	for (const Real side : { Real(1), Real(-1) }) {
		for (const Real offset : { Real(0.0001), Real(0), Real(-0.0001) }) {
			CAPTURE(offset);
			const auto on_plate = find_point_contact(plate, { 1, side * (1 + offset) }, { 2, side * -3 }, SLOP);
			CHECK(on_plate.has_value());
			if (on_plate) {
				CHECK(on_plate->normal == Vec2{ 0, side });
				CHECK(std::abs(double(on_plate->depth) - 4) <= 16 * EPSILON);
			}
			const auto on_segment = find_point_contact(segment, { 1, side * (SLOP + offset) }, { 2, side * -3 }, SLOP);
			REQUIRE(on_segment.has_value());
			CHECK(on_segment->normal == Vec2{ 0, side });
		}
	}
}

TEST_CASE("a point that rests on a circle and is slammed through it in one substep returns to its side") {
	const Collider circle{ { { 0, 0 } }, 1, {} };
	for (const Real offset : { Real(0.0001), Real(0), Real(-0.0001) }) {
		const auto contact = find_point_contact(circle, { 0, 1 + offset }, { 0, -3 }, SLOP);
		REQUIRE(contact.has_value());
		CHECK(distance(contact->normal, { 0, 1 }) <= 4 * EPSILON);
		CHECK(std::abs(double(contact->depth) - 4) <= 16 * EPSILON);
	}
}

TEST_CASE("a fast point returns to the side of a circle that it came from") {
	const Collider circle{ { { 0, 0 } }, 1, {} };
	const auto contact = find_point_contact(circle, { -3, 0 }, { 4, 0 }, SLOP);
	REQUIRE(contact.has_value());
	CHECK(distance(contact->normal, { -1, 0 }) <= 4 * EPSILON);
	CHECK(std::abs(double(contact->depth) - 5) <= 16 * EPSILON);
	// Off the middle: it entered at (-0.8, 0.6).
	const auto above = find_point_contact(circle, { -3, Real(0.6) }, { 4, Real(0.6) }, SLOP);
	REQUIRE(above.has_value());
	CHECK(distance(above->normal, { Real(-0.8), Real(0.6) }) <= 16 * EPSILON);
}

TEST_CASE("a point that slides over the seam of two tiles is not stopped by the hidden side") {
	const Collider next = box_collider({ 1, 1 }, { 1, 1 }); // from (0, 0) to (2, 2), its top at y = 0
	for (const Real start : { Real(-0.0005), Real(0), Real(0.0005) }) { // resting on the tile before, to the slop
		const auto contact = find_point_contact(next, { Real(-0.01), start }, { Real(0.02), Real(0.004) }, SLOP);
		REQUIRE(contact.has_value());
		CHECK(contact->normal == Vec2{ 0, -1 });
		CHECK(std::abs(double(contact->depth) - 0.004) <= EPSILON);
	}
	// From below the top by more than the slop it is a wall.
	const auto wall = find_point_contact(next, { Real(-0.01), Real(0.5) }, { Real(0.02), Real(0.5) }, SLOP);
	REQUIRE(wall.has_value());
	CHECK(wall->normal == Vec2{ -1, 0 });
	CHECK(std::abs(double(wall->depth) - 0.02) <= 4 * EPSILON);
}

TEST_CASE("a point that starts inside leaves by the nearest face") {
	const Collider box = box_collider({ 0, 0 }, { 2, 3 });
	const auto contact = find_point_contact(box, { Real(1.5), 1 }, { Real(1.6), 1 }, SLOP);
	REQUIRE(contact.has_value());
	CHECK(contact->normal == Vec2{ 1, 0 });
	CHECK(std::abs(double(contact->depth) - 0.4) <= 8 * EPSILON);
	Collider rounded = box;
	rounded.radius = Real(0.5);
	CHECK(std::abs(double(find_point_contact(rounded, { Real(1.5), 1 }, { Real(1.6), 1 }, SLOP)->depth) - 0.9) <= 8 * EPSILON);
	CHECK_FALSE(find_point_contact(box, { Real(1.5), 1 }, { 3, 1 }, SLOP).has_value()); // on its way out
}

// A point close to a long segment had the direction from its nearest place as normal, which is rounding.
TEST_CASE("beside a segment of any length its own normal counts, on both sides") {
	for (const Real size : { Real(10), Real(1e4), Real(1e6) }) {
		for (const Real angle : { Real(0), Real(0.3), Real(-1.2) }) {
			const Rotation turn = Rotation::from_angle(angle);
			Collider segment;
			segment.vertices = { turn.apply({ -size / 2, 0 }), turn.apply({ size / 2, 0 }) };
			const Vec2 up = turn.apply({ 0, 1 });
			for (const Real along : { Real(-0.4), Real(0.07), Real(0.33) }) {
				for (const Real side : { Real(-1), Real(1) }) {
					const Vec2 p = turn.apply({ along * size, side });
					const SurfaceDistance found = surface_distance(segment, p, Real(2));
					CAPTURE(size);
					CAPTURE(angle);
					CHECK(double(dot(found.normal, up * side)) >= 1 - 1e-6);
					CHECK(std::abs(double(found.distance) + 1) <= 4 * double(EPSILON) * double(size));
				}
			}
		}
	}
}
