// SPDX-License-Identifier: MIT
// Claims about chains and concave polygons: bodies slide over their joints, lie in their dents, and come out by the way in.
#include "core/collision/collider_contact.h"
#include "core/collision/environment_contact_solver.h"
#include "core/collision/convex_query.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/chain.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real SLOP = Real(0.001);

// Corners at random distances from the middle, in order: simple, and dented nearly always.
Collider random_star(Random &random) {
	Collider star;
	star.concave = true;
	const int count = random.integer(5, 20);
	for (int i = 0; i < count; ++i) {
		const Rotation turn = Rotation::from_angle(Real(6.283185307179586 * i / count));
		star.vertices.push_back(turn.apply({ random.real(0.3, 3), 0 }));
	}
	REQUIRE_FALSE(check_collider(star));
	return star;
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
	const double dx = double(b.x) - a.x, dy = double(b.y) - a.y;
	double t = ((double(p.x) - a.x) * dx + (double(p.y) - a.y) * dy) / (dx * dx + dy * dy);
	t = std::fmin(1, std::fmax(0, t));
	return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

// Angle sum of the corners seen from p, in double: 2 pi inside, 0 outside.
bool is_inside(const std::vector<Vec2> &outline, Vec2 p) {
	double sum = 0;
	for (std::size_t i = 0; i < outline.size(); ++i) {
		const Vec2 a = outline[i] - p;
		const Vec2 b = outline[(i + 1) % outline.size()] - p;
		sum += std::atan2(double(a.x) * b.y - double(a.y) * b.x, double(a.x) * b.x + double(a.y) * b.y);
	}
	return sum > 3;
}

double distance_to_outline(const std::vector<Vec2> &outline, Vec2 p) {
	double least = 1e30;
	for (std::size_t i = 0; i < outline.size(); ++i) {
		least = std::fmin(least, distance_to_segment(p, outline[i], outline[(i + 1) % outline.size()]));
	}
	return least;
}

// A tub, open towards -y (up on the screen): floor at y = 0, walls 20 thick and 100 high, 160 between them.
Collider tub() {
	Collider collider;
	collider.concave = true;
	collider.vertices = { { -100, -100 }, { -80, -100 }, { -80, 0 }, { 80, 0 }, { 80, -100 }, { 100, -100 }, { 100, 20 }, { -100, 20 } };
	return collider;
}

} // namespace

TEST_CASE("a point deep inside a concave polygon comes out at the nearest place of its outline") {
	Random random(351);
	int inside = 0;
	for (int round = 0; round < 3000; ++round) {
		const Collider star = random_star(random);
		const Vec2 p = random.vector(3);
		const double distance = distance_to_outline(star.vertices, p);
		if (distance < 0.01) {
			continue;
		}
		const bool expected = is_inside(star.vertices, p);
		CHECK(std::abs(double(surface_distance(star, p).distance) - (expected ? -distance : distance)) <= 64 * EPSILON);
		const auto contact = find_point_contact(star, p, p, SLOP);
		REQUIRE(contact.has_value() == expected);
		if (contact) {
			++inside;
			CHECK(std::abs(double(contact->depth) - distance) <= 64 * EPSILON);
			CHECK(std::abs(double(length(contact->normal)) - 1) <= 16 * EPSILON);
			CHECK(distance_to_outline(star.vertices, p + contact->normal * contact->depth) <= 128 * EPSILON);
		}
	}
	CHECK(inside > 500);
}

TEST_CASE("a point that came into a concave polygon, or through it, goes out by the edge that it met first") {
	Random random(352);
	int entered = 0;
	for (int round = 0; round < 5000; ++round) {
		const Collider star = random_star(random);
		const Vec2 from = random.vector(4);
		const Vec2 to = random.vector(3);
		if (is_inside(star.vertices, from) || distance_to_outline(star.vertices, from) < 0.01) {
			continue;
		}
		// In double: the first edge on the way.
		double first = 2;
		std::size_t edge = 0;
		for (std::size_t i = 0; i < star.vertices.size(); ++i) {
			const Vec2 a = star.vertices[i];
			const Vec2 b = star.vertices[(i + 1) % star.vertices.size()];
			const double dx = double(to.x) - from.x, dy = double(to.y) - from.y, ex = double(b.x) - a.x, ey = double(b.y) - a.y;
			const double cross = dx * ey - dy * ex;
			const double t = ((double(a.x) - from.x) * ey - (double(a.y) - from.y) * ex) / cross;
			const double s = ((double(a.x) - from.x) * dy - (double(a.y) - from.y) * dx) / cross;
			if (s > -0.02 && s < 1.02 && t > -0.02 && t < 1.02 && (s < 0.02 || s > 0.98 || t > 0.98 || std::abs(cross) < 0.1)) {
				first = -1; // too close to a corner to be sure
				break;
			}
			if (s >= 0 && s <= 1 && t >= 0 && t <= 1 && t < first) {
				first = t;
				edge = i;
			}
		}
		if (first < 0) {
			continue;
		}
		const auto contact = find_point_contact(star, from, to, Real(1e-6));
		REQUIRE(contact.has_value() == (first <= 1));
		if (contact) {
			++entered;
			const Vec2 along = star.vertices[(edge + 1) % star.vertices.size()] - star.vertices[edge];
			const Vec2 normal = perpendicular(along) * (-1 / length(along));
			CHECK(distance(contact->normal, normal) <= 64 * EPSILON);
			CHECK(std::abs(double(contact->depth) + double(dot(normal, to - star.vertices[edge]))) <= 64 * EPSILON * 10);
		}
	}
	CHECK(entered > 500);
}

TEST_CASE("a jelly lies in a tub, thrown against its walls it stays in, and beside it it stays out") {
	for (const Vec2 throw_speed : { Vec2{ 0, 0 }, Vec2{ 3000, 500 }, Vec2{ -3000, 500 } }) {
		WorldData world = pixel_world();
		REQUIRE_FALSE(world.add_collider(tub()));
		world.set_sleeping(false);
		world.add_soft_body(jelly_circle({ 0, -52 }));
		SoftBodyData beside = jelly_circle({ 170, -30 });
		world.add_soft_body(beside);
		world.add_border(floor_at(20));
		for (std::uint32_t i = 0; i < beside.point_count(); ++i) {
			world.soft_bodies()[0].set_point(i, world.soft_bodies()[0].positions()[i], throw_speed);
			world.soft_bodies()[1].set_point(i, world.soft_bodies()[1].positions()[i], { -1000, 0 });
		}
		Simulator simulator(world);
		for (int n = 0; n < 300; ++n) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			CHECK(double(measure_frame(world.soft_bodies()[1]).center.x) > 100);
		}
		const Vec2 center = measure_frame(world.soft_bodies()[0]).center;
		CHECK(std::abs(double(center.x)) < 80);
		CHECK(double(center.y) < 0);
		CHECK(double(center.y) > -60);
		CHECK(measure_penetration(world, world.soft_bodies()[0]) < 0.5);
	}
}

TEST_CASE("a body slides over the joints of a chain, or of an outline, as over one long segment") {
	const auto slide = [](int kind) {
		WorldData world = pixel_world();
		std::vector<Vec2> points;
		for (int i = -40; i <= 40; ++i) {
			points.push_back({ Real(25 * i), 0 });
		}
		if (kind == 0) {
			REQUIRE_FALSE(add_chain(world, std::vector<Vec2>{ points.front(), points.back() }, false));
		} else if (kind == 1) {
			REQUIRE_FALSE(add_chain(world, points, false));
		} else {
			Collider ground;
			ground.concave = true;
			ground.vertices = points;
			ground.vertices.push_back({ 1000, 100 });
			ground.vertices.push_back({ 0, 50 }); // the dent, below
			ground.vertices.push_back({ -1000, 100 });
			REQUIRE_FALSE(world.add_collider(ground));
		}
		BodySettings settings = jelly_settings();
		settings.friction = 0;
		settings.rolling_resistance = 0;
		SoftBodyData body = jelly_circle({ -700, Real(-50.5) }, settings);
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], { 400, 0 });
		}
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int n = 0; n < 200; ++n) {
			simulator.simulate(FRAME);
		}
		return measure_frame(world.soft_bodies()[0]);
	};
	const BodyFrame smooth = slide(0);
	for (const int kind : { 1, 2 }) {
		CAPTURE(kind);
		const BodyFrame jointed = slide(kind);
		CHECK(distance(jointed.center, smooth.center) < 1); // of 1333 px; roundings grow in a wobbling body
		CHECK(std::abs(double(jointed.velocity.x) - 400) < 0.1); // nothing brakes it
	}
}

TEST_CASE("a link of a chain leaves a point beside the next link to that, and keeps one that is beside neither") {
	WorldData world;
	Collider like;
	like.radius = 1;
	// A level link, one that goes on level, and one that turns down (y up here) by a right angle.
	REQUIRE_FALSE(add_chain(world, std::vector<Vec2>{ { 0, 0 }, { 10, 0 }, { 20, 0 }, { 20, -10 } }, false, like));
	const auto touches = [&](std::size_t link, Vec2 p) {
		return find_point_contact(world.colliders()[link], p, p, SLOP).has_value();
	};
	CHECK_FALSE(touches(0, { Real(10.5), Real(0.5) }));
	CHECK(touches(1, { Real(10.5), Real(0.5) }));
	CHECK(touches(0, { Real(9.5), Real(0.5) }));
	CHECK_FALSE(touches(1, { Real(9.5), Real(0.5) }));
	CHECK(touches(1, { Real(20.5), Real(0.5) })); // round the corner: beside neither
	CHECK(touches(2, { Real(20.5), Real(0.5) }));
	CHECK(touches(0, { Real(-0.5), Real(0.5) })); // the free end is round
	CHECK(touches(2, { Real(20.5), Real(-10.5) }));
	// Closed, it has no free end.
	world.clear_environment();
	REQUIRE_FALSE(add_chain(world, std::vector<Vec2>{ { 0, 0 }, { 10, 0 }, { 10, 10 }, { -10, 10 }, { -10, 0 } }, true, like));
	CHECK_FALSE(touches(0, { Real(-0.5), Real(0.5) }));
	CHECK(touches(4, { Real(-0.5), Real(0.5) }));
}

TEST_CASE("the bottom of a dent does not push what has sunk over it; the polygon's points do") {
	const Collider shape = tub();
	const std::vector<Vec2> hull = box_collider({ -70, -10 }, { 30, 30 }).vertices;
	const Aabb box = bounding_box(hull);
	CHECK_FALSE(find_contact_of_corner({ hull, hull }, box, shape, 2, {}).has_value()); // (-80, 0), inside the hull
	Collider solid = box_collider({ -80, 20 }, { 20, 20 });
	CHECK(find_contact_of_corner({ hull, hull }, box, solid, 1, {}).has_value()); // (-60, 0), likewise
}

TEST_CASE("a closed chain keeps what is inside in and what is outside out") {
	WorldData world = pixel_world();
	world.set_gravity({});
	const std::vector<Vec2> box{ { -200, -200 }, { 200, -200 }, { 200, 200 }, { -200, 200 } };
	REQUIRE_FALSE(add_chain(world, box, true));
	CHECK(world.colliders().size() == 4);
	for (const Real x : { Real(0), Real(300) }) {
		SoftBodyData body = jelly_circle({ x, 0 });
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], x > 0 ? Vec2{ -3000, 0 } : Vec2{ 3000, 1700 });
		}
		world.add_soft_body(std::move(body));
	}
	Simulator simulator(world);
	for (int n = 0; n < 120; ++n) {
		simulator.simulate(FRAME);
		for (const Vec2 p : world.soft_bodies()[0].hull()) {
			CHECK((std::abs(double(p.x)) <= 200 && std::abs(double(p.y)) <= 200));
		}
		for (const Vec2 p : world.soft_bodies()[1].hull()) {
			CHECK(double(p.x) >= 200);
		}
	}
}

TEST_CASE("outlines that are none are refused by name") {
	Collider outline = tub();
	CHECK_FALSE(check_collider(outline));
	outline.radius = 1;
	CHECK(check_collider(outline)->name == "collider.radius");
	outline = tub();
	std::ranges::reverse(outline.vertices);
	CHECK(mentions(check_collider(outline)->message(), "reverse"));
	outline.vertices = { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 3 } };
	CHECK(check_collider(outline)->name == "collider.vertices");
	outline.vertices = { { 0, 0 }, { 2, 2 } };
	CHECK(check_collider(outline)->name == "collider.vertices");
	outline.vertices = { { 0, 0 }, { 1, 1 }, { 2, 2 } };
	CHECK(check_collider(outline).has_value());
}

TEST_CASE("bodies thrown at any angle into a closed chain stay inside: none of 400 at 40 radii a second") {
	int out = 0;
	for (std::uint32_t seed = 0; seed < 400; ++seed) {
		Random random(seed);
		WorldData world = pixel_world();
		world.set_gravity({});
		const std::vector<Vec2> box{ { -200, -200 }, { 200, -200 }, { 200, 200 }, { -200, 200 } };
		REQUIRE_FALSE(add_chain(world, box, true));
		SoftBodyData body = jelly_circle({ 0, 0 });
		const Vec2 velocity = Rotation::from_angle(random.real(0, 6.2831)).apply({ 40 * JELLY_RADIUS, 0 });
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i], velocity);
		}
		world.add_soft_body(std::move(body));
		Simulator simulator(world);
		for (int n = 0; n < 120; ++n) {
			simulator.simulate(FRAME);
		}
		out += std::ranges::any_of(world.soft_bodies()[0].hull(), [](Vec2 p) { return std::max(std::abs(p.x), std::abs(p.y)) > 201; });
	}
	CHECK(out == 0); // 31 before points were tried against earlier segments again
}
