// SPDX-License-Identifier: MIT
// One-way colliders: held from the front, passed from behind and from the side, by whole bodies and at any tick rate.
#include "core/collision/one_way.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "scenes/chain.h"
#include "scenes/jelly.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <algorithm>
#include <array>
#include <doctest/doctest.h>
#include <string>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real R = JELLY_RADIUS;
constexpr Vec2 UP{ 0, -1 }; // pixels, y down
constexpr std::array<int, 3> RATES = { 30, 60, 240 };

enum class Platform {
	BOX,
	THICK_BOX,
	SEGMENT,
	CAPSULE,
	CHAIN,
	TILES,
	CONCAVE,
	LIFT, ///< a box on a kinematic body that rests
};
constexpr std::array<Platform, 8> PLATFORMS = { Platform::BOX, Platform::THICK_BOX, Platform::SEGMENT, Platform::CAPSULE,
	Platform::CHAIN, Platform::TILES, Platform::CONCAVE, Platform::LIFT };

// Its front at y = 0, from x = -200 to 200, turned about the origin.
void add_platform(WorldData &world, Platform kind, Vec2 direction = UP) {
	Collider collider = box_collider({ 0, 6 }, { 200, 6 });
	collider.one_way = direction;
	switch (kind) {
		case Platform::BOX:
			world.add_collider(collider);
			break;
		case Platform::THICK_BOX:
			collider.vertices = box_collider({ 0, 70 }, { 200, 70 }).vertices;
			world.add_collider(collider);
			break;
		case Platform::SEGMENT:
			collider.vertices = { { -200, 0 }, { 200, 0 } };
			world.add_collider(collider);
			break;
		case Platform::CAPSULE:
			collider.vertices = { { -190, 10 }, { 190, 10 } };
			collider.radius = 10;
			world.add_collider(collider);
			break;
		case Platform::CHAIN:
			REQUIRE_FALSE(add_chain(world, std::vector<Vec2>{ { -200, 0 }, { -110, 0 }, { -33, 0 }, { 41, 0 }, { 130, 0 }, { 200, 0 } }, false, collider));
			break;
		case Platform::TILES:
			for (int i = 0; i < 10; ++i) {
				collider.vertices = box_collider({ Real(-180 + 40 * i), 20 }, { 20, 20 }).vertices;
				world.add_collider(collider);
			}
			break;
		case Platform::CONCAVE: // an arch
			collider.vertices = { { -200, 0 }, { 200, 0 }, { 200, 40 }, { 170, 40 }, { 170, 15 }, { -170, 15 }, { -170, 40 }, { -200, 40 } };
			collider.concave = true;
			world.add_collider(collider);
			break;
		case Platform::LIFT:
			collider.rigid_body = world.add_rigid_body({}).value();
			world.add_collider(collider);
			break;
	}
}

struct Scene {
	WorldData world = pixel_world();
	Simulator simulator{ world };
	BodyId id;
	Real tick = FRAME;

	Scene(Platform kind, int rate, Vec2 center, Vec2 velocity) :
			tick(1 / Real(rate)) {
		add_platform(world, kind);
		id = world.add_soft_body(jelly_circle(center));
		throw_at(velocity);
	}
	SoftBodyData &body() { return *world.find(id); }
	void throw_at(Vec2 velocity) {
		for (std::uint32_t i = 0; i < body().point_count(); ++i) {
			body().set_point(i, body().positions()[i], velocity);
		}
	}
	void step(Real seconds) {
		for (Real t = 0; t < seconds; t += tick) {
			simulator.simulate(tick);
		}
	}
	Vec2 center() { return measure_frame(body()).center; }
	Real foot() { return std::ranges::max(body().hull(), {}, &Vec2::y).y; }
};

} // namespace

TEST_CASE("a body that comes from the front is held, also by a fast fall") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			for (const Real speed : { Real(0), 20 * R, 40 * R }) {
				CAPTURE(int(kind));
				CAPTURE(rate);
				CAPTURE(speed);
				Scene scene(kind, rate, { 7, -R - 60 }, { 0, speed });
				scene.step(Real(3));
				CHECK(scene.foot() < 3);
				CHECK(scene.foot() > -25); // and lies on it
			}
		}
	}
}

TEST_CASE("a body that comes from behind passes as a whole, undisturbed, and is held when it comes down again") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			for (const Real speed : { Real(850), 20 * R }) {
				CAPTURE(int(kind));
				CAPTURE(rate);
				CAPTURE(speed);
				Scene scene(kind, rate, { 7, 140 + R + 5 }, { 0, -speed });
				Scene alone(kind, rate, { 7, 140 + R + 5 }, { 0, -speed });
				alone.world.clear_environment();
				alone.world.add_collider(box_collider({ 9000, 9000 }, { 1, 1 })); // so that it takes as many substeps
				// Until it is through: 850 px/s reach 369 px, that is, 60 px above the front.
				Real largest = 0;
				for (Real t = 0; t < 2 && scene.foot() > Real(-5); t += scene.tick) {
					scene.simulator.simulate(scene.tick);
					alone.simulator.simulate(scene.tick);
					largest = std::max(largest, Real(largest_distance(scene.body().positions(), alone.body().positions())));
				}
				CHECK(scene.foot() <= -5);
				CHECK(largest <= 1); // [px]
				scene.step(4);
				CHECK(scene.foot() < 3);
				CHECK(scene.foot() > -25);
			}
		}
	}
}

TEST_CASE("a body that turns round half way up falls back through") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			CAPTURE(int(kind));
			CAPTURE(rate);
			const Real bottom = kind == Platform::THICK_BOX ? 140 : 40;
			// It rises 90 px: its top comes 60 px above the front of the thin ones, its center stays about there.
			Scene scene(kind, rate, { 7, 80 }, { 0, -std::sqrt(2 * PIXEL_GRAVITY * 90) });
			Real highest = 1000;
			for (Real t = 0; t < 2; t += scene.tick) {
				scene.simulator.simulate(scene.tick);
				highest = std::min(highest, scene.center().y);
			}
			CHECK(highest < 0);
			CHECK(highest > -R);
			CHECK(scene.foot() > bottom + 2 * R);
		}
	}
}

TEST_CASE("a body that comes from the side passes as a whole") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			for (const Real height : { Real(0), Real(-0.5) * R, Real(0.6) * R }) { // of its center
				CAPTURE(int(kind));
				CAPTURE(rate);
				CAPTURE(height);
				Scene scene(kind, rate, { -200 - R - 10, height }, { 600, 0 });
				Scene alone(kind, rate, { -200 - R - 10, height }, { 600, 0 });
				for (Scene *each : { &scene, &alone }) {
					each->world.set_gravity({});
				}
				alone.world.clear_environment();
				alone.world.add_collider(box_collider({ 9000, 9000 }, { 1, 1 }));
				scene.step(Real(0.9));
				alone.step(Real(0.9));
				CHECK(largest_distance(scene.body().positions(), alone.body().positions()) <= 3);
			}
		}
	}
}

TEST_CASE("a body that starts deeper in a platform than the margin is let pass, one that starts within it is held") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			CAPTURE(int(kind));
			CAPTURE(rate);
			Scene deep(kind, rate, { 7, Real(1.6) - R }, {});
			deep.step(2);
			CHECK(deep.foot() > 200);
			Scene shallow(kind, rate, { 7, Real(0.6) - R }, {});
			shallow.step(2);
			CHECK(shallow.foot() < 3);
		}
	}
	// The margin may be given.
	for (const Real margin : { Real(0), Real(20) }) {
		WorldData world = pixel_world();
		Collider collider = box_collider({ 0, 6 }, { 200, 6 });
		collider.one_way = UP;
		collider.one_way_margin = margin;
		world.add_collider(collider);
		const BodyId id = world.add_soft_body(jelly_circle({ 7, 5 - R }));
		Simulator simulator(world);
		for (int i = 0; i < 120; ++i) {
			simulator.simulate(FRAME);
		}
		CHECK((measure_frame(*world.find(id)).center.y < 0) == (margin > 5));
	}
}

TEST_CASE("a body that rests on a platform and hangs over its end stays held, and so does one pressed by a heavy pile") {
	for (const Platform kind : PLATFORMS) {
		for (const int rate : RATES) {
			CAPTURE(int(kind));
			CAPTURE(rate);
			// A soft plank, a third of it over the end: as on a platform that holds from all sides.
			Scene scene(kind, rate, { 0, -200 }, {});
			scene.world.remove_soft_body(scene.id);
			const std::array<Vec2, 8> outline = { Vec2{ 0, -31 }, { 70, -31 }, { 140, -31 }, { 210, -31 }, { 210, -1 }, { 140, -1 }, { 70, -1 }, { 0, -1 } };
			const auto shape = SoftBodyCreator::create_polygon(outline, { 1, 200, Real(0.3), true }).value();
			BodySettings settings;
			settings.friction = 1;
			settings.shape_stiffness = 40;
			settings.shape_damping = Real(0.5);
			scene.id = scene.world.add_soft_body(SoftBodyData::create(shape, settings, { { 50, 0 }, {} }).value());
			scene.step(3);
			CHECK(scene.center().y < 0);
			CHECK(scene.foot() > 2); // it sags beside the end
		}
		for (const int rate : RATES) {
			CAPTURE(rate);
			CAPTURE(int(kind));
			Scene scene(kind, rate, { 7, -R - 1 }, {});
			const auto heavy = circle_shape(R, 16, { 4, 800, 2, true }).value();
			for (int i = 0; i < 3; ++i) {
				scene.world.add_soft_body(SoftBodyData::create(heavy, jelly_settings(), { { 7, -R - 1 - 110 * Real(i + 1) }, {} }).value());
			}
			scene.step(Real(0.7));
			CHECK(scene.center().y < 0);
		}
	}
}

TEST_CASE("a lift carries a body up and down, and one that comes up under it passes") {
	for (const int rate : RATES) {
		CAPTURE(rate);
		Scene scene(Platform::LIFT, rate, { 7, -R - 1 }, {});
		const auto drive = [&](Real speed, Real seconds) {
			for (Real t = 0; t < seconds; t += scene.tick) {
				RigidBody lift = scene.world.rigid_bodies()[0];
				lift.linear_velocity = { 0, speed };
				scene.world.set_rigid_body(0, lift);
				scene.simulator.simulate(scene.tick);
			}
		};
		drive(0, 1);
		for (const Real speed : { Real(-400), Real(400), Real(-400) }) {
			drive(speed, Real(0.8));
			drive(0, Real(2.5)); // it flies on when the lift stops
			CHECK(std::abs(scene.foot() - scene.world.rigid_bodies()[0].pose.position.y) < 15);
		}
		// Down onto a body that lies still in the air, and up through it.
		Scene below(Platform::LIFT, rate, { 7, 300 }, {});
		below.world.set_gravity({});
		for (const Real speed : { Real(900), Real(-900) }) {
			const Vec2 before = below.center();
			for (Real t = 0; t < Real(0.5) && speed > 0; t += below.tick) { // down through it
				RigidBody lift = below.world.rigid_bodies()[0];
				lift.linear_velocity = { 0, speed };
				below.world.set_rigid_body(0, lift);
				below.simulator.simulate(below.tick);
			}
			if (speed > 0) {
				CHECK(distance(below.center(), before) < 1); // it came from behind
				continue;
			}
			for (Real t = 0; t < Real(0.3); t += below.tick) {
				RigidBody lift = below.world.rigid_bodies()[0];
				lift.linear_velocity = { 0, speed };
				below.world.set_rigid_body(0, lift);
				below.simulator.simulate(below.tick);
			}
			CHECK(below.foot() < below.world.rigid_bodies()[0].pose.position.y + 3); // taken along from the front
		}
	}
}

TEST_CASE("depth counts what the collider and the hull share, along the direction that holds") {
	const std::vector<Vec2> hull = { { -10, -10 }, { 10, -10 }, { 10, 10 }, { -10, 10 } };
	Collider bar;
	bar.one_way = UP;
	const auto depth_of = [&](std::vector<Vec2> vertices, Real radius = 0) {
		bar.vertices = std::move(vertices);
		bar.radius = radius;
		return one_way_depth(hull, bar);
	};
	CHECK(depth_of({ { -50, 7 }, { 50, 7 } }) == doctest::Approx(3));
	CHECK(depth_of({ { -50, 11 }, { 50, 11 } }) == 0);
	CHECK(depth_of({ { -50, -12 }, { 50, -12 } }) == 0); // all of it behind, apart
	CHECK(depth_of({ { -50, -7 }, { 50, -7 } }) == doctest::Approx(17));
	CHECK(depth_of({ { 11, 0 }, { 50, 0 } }) == 0); // beside its end
	CHECK(depth_of({ { 4, 6 }, { 50, 6 } }) == doctest::Approx(4));
	CHECK(depth_of({ { -2, 6 }, { 2, 6 } }) == doctest::Approx(4)); // no hull point beside it
	CHECK(depth_of({ { -50, 11 }, { 50, 11 } }, 4) == doctest::Approx(3));
	CHECK(depth_of({ { 0, 12 } }, 4) == doctest::Approx(2));
	CHECK(depth_of({ { -50, -40 }, { 50, -40 }, { 50, 40 }, { -50, 40 } }) == doctest::Approx(50)); // all inside
	CHECK(one_way_depth(hull, bar, 0) == doctest::Approx(50));
	bar.vertices = { { -50, 11 }, { 50, 11 } };
	bar.radius = 0;
	CHECK(one_way_depth(hull, bar, 2) == doctest::Approx(1));
	bar.one_way = { 1, 0 };
	CHECK(depth_of({ { -4, -50 }, { -4, 50 } }) == doctest::Approx(6));
}

namespace {

// How far a convex rounded collider reaches along a direction, beside a place across it: by halving the way down to it from
// far off, and the distance to each of its segments.
double reach_of(const Collider &collider, double across) {
	const std::vector<Vec2> &v = collider.vertices;
	const double dx = double(collider.one_way.x), dy = double(collider.one_way.y);
	const auto outside = [&](double along) {
		const double x = dx * along - dy * across, y = dy * along + dx * across;
		double nearest = 1e9;
		bool is_inside = v.size() > 2;
		for (std::size_t i = 0; i < v.size(); ++i) {
			const Vec2 a = v[i], b = v[(i + 1) % v.size()];
			const double ex = double(b.x) - double(a.x), ey = double(b.y) - double(a.y);
			const double size = ex * ex + ey * ey;
			const double px = x - double(a.x), py = y - double(a.y);
			const double t = size > 0 ? std::clamp((px * ex + py * ey) / size, 0.0, 1.0) : 0;
			nearest = std::min(nearest, std::hypot(px - ex * t, py - ey * t));
			is_inside = is_inside && ex * py - ey * px >= 0;
		}
		return is_inside ? -nearest : nearest - double(collider.radius);
	};
	// Downwards in steps that the distance allows.
	double along = 20;
	while (along > -20) {
		const double free = outside(along);
		if (free < 1e-9) {
			return along;
		}
		along -= free;
	}
	return -20;
}

} // namespace

TEST_CASE("beside any place of a rounded collider, depth begins where the collider does") {
	Random random(8);
	int met = 0;
	for (int i = 0; i < 400; ++i) {
		CAPTURE(i);
		const Rotation turned = Rotation::from_angle(random.real(0, 6.28));
		Collider collider;
		collider.one_way = turned.apply({ 0, 1 });
		collider.radius = random.chance(0.3) ? Real(0) : random.real(0.1, 1.5);
		const int corners = random.integer(collider.radius > 0 ? 1 : 2, 6);
		double angle = double(random.real(0, 6.28));
		for (int k = 0; k < corners; ++k) {
			angle += 6.28 / corners * double(random.real(0.6, 1));
			collider.vertices.push_back(Rotation::from_angle(Real(angle)).apply({ 3, 0 }));
		}
		// A tall narrow body through all of it, along the direction: nothing but the collider's front beside its lower corners
		// and between them decides. A hair wider above, as beside its outermost points a hull has no height.
		const double middle = double(random.real(-4.5, 4.5));
		const double half = double(random.real(0.05, 0.5));
		const Vec2 sideways = perpendicular(collider.one_way);
		std::vector<Vec2> hull;
		std::vector<double> looked_at = { middle - half, middle + half };
		for (const auto &[across, along] : { std::pair(-half - 1e-3, 10), std::pair(-half, -10), std::pair(half, -10), std::pair(half + 1e-3, 10) }) {
			hull.push_back(sideways * Real(middle + across) + collider.one_way * Real(along));
		}
		for (const Vec2 vertex : collider.vertices) {
			const double across = double(dot(vertex, sideways));
			if (std::abs(across - middle) < half) {
				looked_at.push_back(across);
			}
		}
		// Where its flank is steep, the place counts for more than the height: a thousandth to both sides, and ten times that
		// for a corner in between.
		double least = 0, most = 0;
		for (const double across : looked_at) {
			const double left = reach_of(collider, across - 1e-3) + 10, right = reach_of(collider, across + 1e-3) + 10;
			least = std::max(least, std::min(left, right));
			most = std::max({ most, left, right, reach_of(collider, across) + 10 });
		}
		const double depth = double(one_way_depth(hull, collider));
		CHECK(depth >= least - 1e-2);
		CHECK(depth <= most + 1e-2);
		met += depth > 0;
	}
	CHECK(met > 200);
}

TEST_CASE("in a world of meters too a body comes up through a platform undisturbed") {
	WorldData world;
	Collider collider;
	collider.vertices = { { -4, 0 }, { 4, 0 } };
	collider.one_way = { 0, 1 };
	REQUIRE_FALSE(world.add_collider(collider));
	const BodyId id = world.add_soft_body(thesis_body(thesis_shape(), {}, { { 0, Real(-0.8) }, {} }));
	for (std::uint32_t i = 0; i < world.find(id)->point_count(); ++i) {
		REQUIRE_FALSE(world.find(id)->set_point(i, world.find(id)->positions()[i], { 0, 3 }));
	}
	Simulator simulator(world);
	for (int i = 0; i < 60; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(double(measure_frame(*world.find(id)).center.y) == doctest::Approx(2.2)); // after a second
}

TEST_CASE("a platform that is taken away is forgotten, though its neighbor stays") {
	const Collider stays = [] {
		Collider collider = box_collider({ 100, 20 }, { 100, 20 });
		collider.one_way = UP;
		return collider;
	}();
	Collider goes = stays;
	goes.vertices = box_collider({ -100, 20 }, { 100, 20 }).vertices;
	WorldData world = pixel_world();
	REQUIRE_FALSE(world.add_collider(stays));
	REQUIRE_FALSE(world.add_collider(goes));
	const BodyId id = world.add_soft_body(jelly_circle({ 5, -R }));
	Simulator simulator(world);
	const auto remembers = [&](const Collider &collider) {
		return std::ranges::count(world.find(id)->one_ways(), one_way_name(collider), &OneWayMemory::collider) == 1;
	};
	for (int i = 0; i < 30; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(remembers(stays));
	REQUIRE(remembers(goes));
	world.clear_environment();
	REQUIRE_FALSE(world.add_collider(stays));
	simulator.simulate(FRAME);
	CHECK(remembers(stays));
	CHECK_FALSE(remembers(goes));
}

TEST_CASE("a direction that is no unit vector and a margin that is no number are refused by name") {
	WorldData world;
	Collider collider = box_collider({ 0, 0 }, { 1, 1 });
	for (const Vec2 direction : { Vec2{ 0, 2 }, Vec2{ NOT_A_NUMBER, 0 }, Vec2{ Real(0.1), 0 } }) {
		collider.one_way = direction;
		const Status status = world.add_collider(collider);
		REQUIRE(status);
		CHECK(status->name == "collider.one_way");
	}
	collider.one_way = UP;
	collider.one_way_margin = NOT_A_NUMBER;
	const Status status = world.add_collider(collider);
	REQUIRE(status);
	CHECK(status->name == "collider.one_way_margin");
}
