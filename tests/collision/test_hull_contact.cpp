// SPDX-License-Identifier: MIT
// The exact test of a point against a hull agrees with a plain one that takes an edge at a time.
#include "core/collision/hull_contact.h"
#include "core/geometry/polygon.h"
#include "core/geometry/segment.h"
#include "support/compare.h"
#include "support/random.h"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A star-shaped hull of positive winding, in general concave.
std::vector<Vec2> random_hull(Random &random, int count) {
	std::vector<Vec2> hull;
	for (int i = 0; i < count; ++i) {
		const double angle = (i + double(random.real(0, 0.6))) * 6.283185307179586 / count;
		const double reach = double(random.real(0.3, 1));
		hull.push_back({ Real(reach * std::cos(angle)), Real(reach * std::sin(angle)) });
	}
	return hull;
}

struct Plain {
	std::size_t edge = 0;
	double distance = std::numeric_limits<double>::max();
};

Plain nearest_edge(const std::vector<Vec2> &hull, Vec2 p, Vec2 outward, bool facing_only) {
	Plain nearest;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		const Vec2 a = hull[i];
		const Vec2 b = hull[(i + 1) % hull.size()];
		const Vec2 normal{ b.y - a.y, a.x - b.x };
		if (facing_only && (!(dot(normal, outward) < 0) || cross(b - a, p - a) < 0)) {
			continue;
		}
		const double distance = double(length(p - (a + (b - a) * closest_parameter_on_segment(p, a, b))));
		if (distance < nearest.distance) {
			nearest = { i, distance };
		}
	}
	return nearest;
}

} // namespace

TEST_CASE("a point that has gone a little way is followed to the contact that a search finds: 60,000 ways beside 300 random hulls") {
	Random random(29);
	int inside = 0;
	int apart = 0;
	int lost = 0;
	int miss = 0;
	for (int round = 0; round < 300; ++round) {
		const auto hull = random_hull(random, random.integer(3, 21));
		HullEdges edges;
		edges.assign(hull);
		for (int i = 0; i < 200; ++i) {
			const std::size_t start = std::size_t(random.integer(0, int(hull.size()) - 1));
			const Vec2 on_edge = hull[start] + (hull[(start + 1) % hull.size()] - hull[start]) * random.real(0, 1);
			const Vec2 then = on_edge + random.vector(0.02);
			const Vec2 now = then + random.vector(0.02);
			HullContact contact;
			contact.edge = std::uint32_t(nearest_edge(hull, then, {}, false).edge);
			const Followed followed = follow_contact(hull, now, contact);
			const double distance = nearest_edge(hull, now, {}, false).distance;
			if (followed == Followed::LOST) {
				++lost; // it says so itself
			} else if (followed == Followed::APART) {
				++apart;
				CHECK((!edges.contains(now) || distance <= 0.03)); // at a sharp corner another edge may have been passed
				miss += edges.contains(now) && distance > 1e-5;
			} else {
				++inside;
				CHECK(contact.t >= 0);
				CHECK(contact.t <= 1);
				const Vec2 a = hull[contact.edge];
				const Vec2 b = hull[(contact.edge + 1) % hull.size()];
				CHECK(double(length(now + contact.normal * contact.depth - (a + (b - a) * contact.t))) <= 1e-5);
				if (edges.contains(now)) {
					CHECK(double(contact.depth) >= distance - 1e-5);
					CHECK(double(contact.depth) <= 0.06); // no farther than both ways
				}
			}
		}
	}
	CAPTURE(miss);
	CAPTURE(lost);
	CHECK(inside > 10000);
	CHECK(apart > 10000);
	CHECK(lost < 20000);
	CHECK(miss < 100);
}

TEST_CASE("a point is inside exactly when the plain test says so, for every number of edges") {
	Random random(21);
	for (int round = 0; round < 400; ++round) {
		const auto hull = random_hull(random, random.integer(3, 21));
		HullEdges edges;
		edges.assign(hull);
		for (int i = 0; i < 40; ++i) {
			const Vec2 p = random.vector(1);
			if (nearest_edge(hull, p, {}, false).distance > 1e-5) { // nearer, rounding may tell either
				CHECK(edges.contains(p) == point_in_polygon(p, hull));
				CHECK(edges.find(p, {}).has_value() == point_in_polygon(p, hull));
			}
		}
	}
}

TEST_CASE("a ray through a corner of the hull counts it once") {
	Random random(24);
	for (int round = 0; round < 2000; ++round) {
		auto hull = random_hull(random, random.integer(3, 21));
		const Vec2 away = random.vector(round % 2 == 0 ? 0 : 10);
		for (Vec2 &p : hull) {
			p += away;
		}
		HullEdges edges;
		edges.assign(hull);
		const Vec2 corner = hull[std::size_t(random.integer(0, int(hull.size()) - 1))];
		const Real beside = random.integer(-1, 1) == 0 ? corner.y : std::nextafter(corner.y, random.real(-20, 20));
		const Vec2 p{ away.x + random.real(-1, 1), beside };
		if (nearest_edge(hull, p, {}, false).distance > 1e-4) {
			CHECK(edges.contains(p) == point_in_polygon(p, hull));
		}
	}
}

TEST_CASE("the way out is the shortest among the edges that face the point") {
	Random random(22);
	int inside = 0;
	for (int round = 0; round < 2000; ++round) {
		const auto hull = random_hull(random, random.integer(3, 21));
		HullEdges edges;
		edges.assign(hull);
		const Vec2 p = random.vector(1);
		const Vec2 outward = round % 4 == 0 ? Vec2{} : random.vector(1);
		const auto contact = edges.find(p, outward);
		if (!contact) {
			continue;
		}
		++inside;
		Plain expected = nearest_edge(hull, p, outward, true);
		if (expected.distance == std::numeric_limits<double>::max()) {
			expected = nearest_edge(hull, p, outward, false);
		}
		const Vec2 a = hull[contact->edge];
		const Vec2 b = hull[(contact->edge + 1) % hull.size()];
		const Vec2 place = a + (b - a) * contact->t;
		CHECK(std::abs(double(length(place - p)) - expected.distance) <= 1e-5);
		CHECK(std::abs(double(contact->depth) - expected.distance) <= 1e-4);
		CHECK(std::abs(double(length(contact->normal)) - 1) <= 1e-5);
		CHECK(double(length(p + contact->normal * contact->depth - place)) <= 2e-3);
		CHECK(contact->t >= 0);
		CHECK(contact->t <= 1);
	}
	CHECK(inside > 300);
}

TEST_CASE("the way out of a hull of any size is the same, but for its length, also right beside a corner") {
	Random random(23);
	int beside_corner = 0;
	for (int round = 0; round < 4000; ++round) {
		const auto hull = random_hull(random, random.integer(3, 21));
		const Vec2 corner = hull[std::size_t(random.integer(0, int(hull.size()) - 1))];
		const Vec2 p = corner + random.vector(round % 2 == 0 ? 0.001 : 0.01);
		const Vec2 outward = round % 4 == 0 ? Vec2{} : random.vector(1);
		HullEdges edges;
		edges.assign(hull);
		const auto contact = edges.find(p, outward);
		beside_corner += contact && (contact->t == 0 || contact->t == 1);
		for (const Real scale : { Real(1024), Real(1) / 1024 }) { // a power of two rounds nothing
			auto scaled = hull;
			for (Vec2 &each : scaled) {
				each *= scale;
			}
			edges.assign(scaled);
			const auto other = edges.find(p * scale, outward);
			REQUIRE(other.has_value() == contact.has_value());
			if (contact) {
				CHECK(other->edge == contact->edge);
				CHECK(other->t == contact->t);
				CHECK(other->normal == contact->normal);
				CHECK(other->depth == contact->depth * scale);
			}
		}
	}
	CHECK(beside_corner > 200);
}

TEST_CASE("a point that was pushed through a thin body goes back the way it came") {
	// A plank from y = 0 to 0.2; the body above it points down, and its point is nearer to the underside.
	const std::vector<Vec2> plank = { { -1, 0 }, { 1, 0 }, { 1, Real(0.2) }, { -1, Real(0.2) } };
	HullEdges edges;
	edges.assign(plank);
	const auto contact = edges.find({ Real(0.1), Real(0.05) }, { 0, -1 });
	REQUIRE(contact);
	CHECK(contact->edge == 2);
	CHECK(contact->normal.y == doctest::Approx(1));
	CHECK(contact->depth == doctest::Approx(0.15));
	const auto without = edges.find({ Real(0.1), Real(0.05) }, {});
	REQUIRE(without);
	CHECK(without->edge == 0);
}

TEST_CASE("a hull without area or with coincident points contains nothing that is not near it, and gives finite answers") {
	HullEdges edges;
	const std::vector<Vec2> flat = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 1, 0 } };
	edges.assign(flat);
	CHECK_FALSE(edges.contains({ 1, Real(0.5) }));
	const std::vector<Vec2> point(6, Vec2{ 1, 1 });
	edges.assign(point);
	CHECK_FALSE(edges.find({ 1, 1 }, { 1, 0 }).has_value());
	const std::vector<Vec2> twice = { { 0, 0 }, { 1, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 1 } };
	edges.assign(twice);
	const auto contact = edges.find({ Real(0.9), Real(0.5) }, {});
	REQUIRE(contact);
	CHECK(contact->normal.x == doctest::Approx(1));
	CHECK(contact->depth == doctest::Approx(0.1));
}

TEST_CASE("out of a body is away from it") {
	const std::vector<Vec2> square = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }; // positive winding
	CHECK(outward_at(square, 0) == Vec2{ -1, -1 });
	CHECK(outward_at(square, 2) == Vec2{ 1, 1 });
}

TEST_CASE("a corner with a short edge leaves a body by the edge that it came in by: 20,000 corners") {
	// As a cut leaves them. Both edges of the corner rise out of the block's top, at any two angles; one is up to 50
	// times as long as the other.
	const std::vector<Vec2> block = { { -200, -40 }, { 200, -40 }, { 200, 0 }, { -200, 0 } }; // the top is y = 0
	HullEdges edges;
	edges.assign(block);
	Random random(31);
	int wrong = 0;
	for (int round = 0; round < 20000; ++round) {
		const double low = double(random.real(0.02, 3.0));
		const double high = double(random.real(Real(low + 0.02), Real(3.12)));
		const Real sizes[] = { random.real(0.02, 1), random.real(0.02, 1) };
		const Vec2 corner{ random.real(-30, 30), random.real(-35, Real(-0.01)) }; // nearest to the top, or to the bottom
		// Positive winding: the body lies left of the way, so that it comes down along the higher angle.
		const Vec2 before = corner + Vec2{ Real(std::cos(high)), Real(std::sin(high)) } * sizes[0];
		const Vec2 after = corner + Vec2{ Real(std::cos(low)), Real(std::sin(low)) } * sizes[1];
		const std::vector<Vec2> piece = { before, corner, after };
		const auto contact = edges.find(corner, outward_at(piece, 1));
		REQUIRE(contact);
		wrong += contact->edge != 2;
	}
	CHECK(wrong == 0);
}
