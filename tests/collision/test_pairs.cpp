// SPDX-License-Identifier: MIT
// Soft bodies meet in a world: they part, keep momentum, stand on one another and hide behind layers.
#include "core/collision/hull_contact.h"
#include "core/creator/hulls.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "thesis/polygon_overlap.h"
#include "core/model/body_frame.h"
#include "scenes/thesis_body.h"
#include "support/random.h"
#include "support/threads.h"
#include "thesis/momentum.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60;

BodySettings pile_settings(double stiffness) {
	BodySettings settings;
	settings.shape_stiffness = Real(0.4 * stiffness);
	settings.shape_damping = Real(0.5 * std::sqrt(0.4 * stiffness / 9));
	settings.rolling_resistance = Real(0.03);
	return settings;
}

SoftBodyData ball(Vec2 place, double stiffness = 1000, Real angle = 0) {
	static const auto shape = thesis_shape_with_ratio(1000, Real(0.05));
	return thesis_body(stiffness == 1000 ? shape : thesis_shape_with_ratio(Real(stiffness), Real(0.05)),
			pile_settings(stiffness), { place, Rotation::from_angle(angle) });
}

void shoot(SoftBodyData &body, Vec2 velocity) {
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		body.set_point(i, body.positions()[i], velocity);
	}
}

void add_ground(WorldData &world) {
	world.set_gravity({ 0, Real(-9.81) });
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
}

double deepest_overlap(const WorldData &world) {
	double deepest = 0;
	const auto bodies = world.soft_bodies();
	for (std::size_t a = 0; a < bodies.size(); ++a) {
		for (std::size_t b = a + 1; b < bodies.size(); ++b) {
			deepest = std::max(deepest, penetration_depth(bodies[a].hull(), bodies[b].hull()));
		}
	}
	return deepest;
}

std::vector<Vec2> all_positions(const WorldData &world) {
	std::vector<Vec2> all;
	for (const SoftBodyData &body : world.soft_bodies()) {
		all.insert(all.end(), body.positions().begin(), body.positions().end());
	}
	return all;
}

// Ten wide and high between walls, more or less in rows.
void add_pile(WorldData &world, int count, double stiffness, Random &random) {
	add_ground(world);
	world.add_border({ { { 0, 0 }, { 1, 0 } }, {} });
	world.add_border({ { { 11, 0 }, { -1, 0 } }, {} });
	for (int i = 0; i < count; ++i) {
		const Vec2 place{ Real(0.6 + 1.05 * (i % 10)) + random.real(-0.02, 0.02), Real(0.6 + 1.1 * (i / 10)) };
		world.add_soft_body(ball(place, stiffness, random.real(-3, 3)));
	}
}

} // namespace

TEST_CASE("two bodies that meet part again, with the momentum and spin that they brought") {
	for (const Real aside : { Real(0), Real(0.4) }) {
		WorldData world;
		world.add_soft_body(ball({ -2, 0 }));
		world.add_soft_body(ball({ 2, aside }));
		shoot(world.soft_bodies()[0], { 5, 0 });
		shoot(world.soft_bodies()[1], { -3, 0 });
		Simulator simulator(world);
		std::uint64_t contacts = 0;
		for (int i = 0; i < 120; ++i) {
			contacts += simulator.simulate(FRAME).pair_contacts;
			CHECK(deepest_overlap(world) <= 0.1); // at 16 radii a second
		}
		CHECK(deepest_overlap(world) <= 0.025);
		CHECK(contacts > 0);
		const Momentum a = measure_momentum(world.soft_bodies()[0]);
		const Momentum b = measure_momentum(world.soft_bodies()[1]);
		CHECK(a.linear_x < b.linear_x);
		CHECK(b.linear_x > 0);
		CHECK(std::abs(a.linear_x + b.linear_x - 2) <= 1e-4);
		CHECK(std::abs(a.linear_y + b.linear_y) <= 1e-4);
		// Spin about the origin: r × p of the one that flew aside. Moving apart what is inside moves arms of momenta.
		CHECK(std::abs(a.angular + b.angular - 3 * double(aside)) <= 0.1);
	}
}

TEST_CASE("whichever points of a hull of many meet the flat side of a large body, they are held") {
	constexpr int POINTS = 70; // more than are looked at together
	const auto wheel = circle_shape(Real(0.5), POINTS, { 1, 3000, 1, true }).value();
	// Four points and no more: nothing of it but the edge is near the wheel.
	const auto block = SoftBodyCreator::create_polygon(box_hull({ 20, 2 }, 20).value(), { 100, 100000, 10, true }).value();
	for (int first = 0; first < POINTS; first += 7) {
		CAPTURE(first);
		WorldData world;
		const Real turn = Real(6.283185307 * first / POINTS);
		world.add_soft_body(thesis_body(wheel, pile_settings(1000), { { 0, Real(0.52) }, Rotation::from_angle(turn) }));
		world.add_soft_body(thesis_body(block, {}, { { 0, -1 }, {} }));
		shoot(world.soft_bodies()[0], { 0, -2 });
		Simulator simulator(world);
		for (int i = 0; i < 60; ++i) {
			simulator.simulate(FRAME);
			REQUIRE(deepest_overlap(world) <= 0.05); // a tenth of its radius, at four radii a second
		}
		CHECK(measure_momentum(world.soft_bodies()[0]).linear_y > -0.1); // stopped: the block goes down by 0.02 a second
	}
}

TEST_CASE("two bodies of every pair of shapes meet and part, each in one piece, with the momentum that they brought") {
	const auto star = [] {
		std::vector<Vec2> hull;
		for (int i = 0; i < 10; ++i) {
			const Rotation turn = Rotation::from_angle(Real(i * 3.14159265 / 5));
			hull.push_back(turn.apply({ i % 2 == 0 ? Real(0.6) : Real(0.3), 0 }));
		}
		return hull;
	};
	const std::vector<std::vector<Vec2>> hulls = {
		{ { Real(-0.5), Real(-0.4) }, { Real(0.5), Real(-0.4) }, { 0, Real(0.5) } },
		box_hull({ 1, 1 }, Real(0.25)).value(),
		box_hull({ Real(1.6), Real(0.4) }, Real(0.2)).value(),
		circle_hull(Real(0.5), 8).value(),
		circle_hull(Real(0.5), 24).value(),
		capsule_hull(Real(0.3), Real(1.4), Real(0.2)).value(),
		star(),
		{ { Real(-0.5), Real(-0.5) }, { Real(0.5), Real(-0.5) }, { Real(0.5), Real(-0.2) }, { Real(-0.2), Real(-0.2) },
				{ Real(-0.2), Real(0.2) }, { Real(0.5), Real(0.2) }, { Real(0.5), Real(0.5) }, { Real(-0.5), Real(0.5) } },
	};
	for (std::size_t first = 0; first < hulls.size(); ++first) {
		for (std::size_t second = first; second < hulls.size(); ++second) {
			for (const Real angle : { Real(0), Real(0.7), Real(2.5) }) {
				CAPTURE(first);
				CAPTURE(second);
				CAPTURE(angle);
				WorldData world;
				const auto add = [&](std::size_t which, Vec2 place, Real turn, Vec2 velocity) {
					const auto shape = SoftBodyCreator::create_polygon(hulls[which], { 1, 2000, 3, false }).value();
					world.add_soft_body(thesis_body(shape, pile_settings(5000), { place, Rotation::from_angle(turn) }));
					shoot(world.soft_bodies().back(), velocity);
				};
				add(first, { -1, Real(0.1) }, angle, { 2, 0 });
				add(second, { 1, 0 }, 1 - angle, { -2, 0 });
				Simulator simulator(world);
				std::uint64_t contacts = 0;
				for (int i = 0; i < 150; ++i) {
					const StepReport report = simulator.simulate(FRAME);
					contacts += report.pair_contacts;
					CHECK(report.reset_bodies.empty());
				}
				CHECK(contacts > 0);
				CHECK(deepest_overlap(world) <= 0.025);
				Momentum all;
				for (const SoftBodyData &body : world.soft_bodies()) {
					const Momentum own = measure_momentum(body);
					all.linear_x += own.linear_x;
					all.linear_y += own.linear_y;
					CHECK(signed_area(body.hull()) > Real(0.6) * body.shape().rest_area());
				}
				CHECK(std::hypot(all.linear_x, all.linear_y) <= 1e-4);
				const BodyFrame a = measure_frame(world.soft_bodies()[0]);
				const BodyFrame b = measure_frame(world.soft_bodies()[1]);
				const Vec2 way = b.center - a.center;
				CHECK(dot(b.velocity - a.velocity, way) >= -Real(0.05)); // apart, or at rest with each other
			}
		}
	}
}

TEST_CASE("bodies whose layers do not meet pass through each other, and one that notices is enough to touch") {
	for (const bool notices : { false, true }) {
		WorldData world;
		world.add_soft_body(ball({ -1, 0 }));
		world.add_soft_body(ball({ 1, 0 }));
		BodySettings settings = pile_settings(1000);
		settings.collision_layer = 2;
		settings.collision_mask = notices ? 4 : 1;
		world.soft_bodies()[0].set_settings(settings);
		settings.collision_layer = 4;
		settings.collision_mask = 1;
		world.soft_bodies()[1].set_settings(settings);
		shoot(world.soft_bodies()[0], { 4, 0 });
		Simulator simulator(world);
		for (int i = 0; i < 60; ++i) {
			simulator.simulate(FRAME);
		}
		CHECK((measure_frame(world.soft_bodies()[0]).center.x < measure_frame(world.soft_bodies()[1]).center.x) == notices);
	}
}

TEST_CASE("a stack stands, at rest and with nothing inside anything else") {
	Random random(41);
	WorldData world;
	add_pile(world, 60, 1000, random);
	Simulator simulator(world);
	for (int i = 0; i < 1200; ++i) {
		CHECK(simulator.simulate(FRAME).reset_bodies.empty());
	}
	CHECK(deepest_overlap(world) <= 0.05 * 0.5);
	double kinetic = 0;
	for (const SoftBodyData &body : world.soft_bodies()) {
		CHECK(signed_area(body.hull()) > Real(0.7) * body.shape().rest_area());
		kinetic += measure_energy(body, {}).kinetic;
	}
	CHECK(kinetic / 60 < 0.005); // as at 0.1 m/s
	CHECK(measure_frame(world.soft_bodies()[59]).center.y > 4);
}

TEST_CASE("bodies that start in one place part without a jump") {
	for (const double apart : { 0.0, 1e-6, 0.01, 0.1, 0.3, 0.6 }) {
		CAPTURE(apart);
		WorldData world;
		world.add_soft_body(ball({ 0, 0 }));
		world.add_soft_body(ball({ Real(apart), 0 }, 1000, Real(0.2)));
		Simulator simulator(world);
		double fastest = 0;
		for (int i = 0; i < 180; ++i) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			for (const SoftBodyData &body : world.soft_bodies()) {
				fastest = std::max(fastest, double(length(measure_frame(body).velocity)));
			}
		}
		CHECK(deepest_overlap(world) <= 0.025);
		const Vec2 centers = measure_frame(world.soft_bodies()[1]).center - measure_frame(world.soft_bodies()[0]).center;
		CHECK(double(length(centers)) > 0.8);
		CHECK(fastest < 2);
		for (const SoftBodyData &body : world.soft_bodies()) {
			CHECK(signed_area(body.hull()) > Real(0.9) * body.shape().rest_area());
		}
	}
}

// Up to the speeds at which none of four balls gets through, whichever part of the plank it hits. Faster ones do by chance.
TEST_CASE("a fast body does not pass through a thin one") {
	struct Shot {
		Real thickness;
		Real speed;
	};
	// 20 to 32 and 60 radii a second
	for (const auto [thickness, speed] : { Shot{ Real(0.1), 10 }, Shot{ Real(0.1), 16 }, Shot{ Real(0.2), 30 }, Shot{ Real(0.3), 10 }, Shot{ Real(0.3), 30 } }) {
		for (const Real aside : { Real(0), Real(0.07), Real(0.14), Real(0.21) }) {
			CAPTURE(speed);
			CAPTURE(thickness);
			CAPTURE(aside);
			WorldData world;
			constexpr int PARTS = 12;
			std::vector<Vec2> hull;
			for (int i = 0; i <= PARTS; ++i) {
				hull.push_back({ Real(-3 + 6.0 * i / PARTS), -thickness / 2 });
			}
			for (int i = PARTS; i >= 0; --i) {
				hull.push_back({ Real(-3 + 6.0 * i / PARTS), thickness / 2 });
			}
			const auto plank = SoftBodyCreator::create_polygon(hull, { 5, 5000, 5, true }).value();
			world.add_soft_body(SoftBodyData::create(plank, pile_settings(5000)).value());
			for (const std::uint32_t end : { 0, PARTS, PARTS + 1, 2 * PARTS + 1 }) {
				world.soft_bodies()[0].set_pinned(end, true);
			}
			world.add_soft_body(ball({ aside, 3 }));
			shoot(world.soft_bodies()[1], { 0, -speed });
			Simulator simulator(world);
			for (int i = 0; i < 60; ++i) {
				CHECK(simulator.simulate(FRAME).reset_bodies.empty());
			}
			CHECK(measure_frame(world.soft_bodies()[1]).center.y > 0);
		}
	}
}

TEST_CASE("a pile takes the same bits with any number of threads and in every run" * doctest::test_suite("threads")) {
	const auto run = [](ParallelFor parallel_for) {
		Random random(42);
		WorldData world;
		add_pile(world, 150, 600, random);
		Simulator simulator(world, parallel_for);
		std::uint64_t contacts = 0;
		for (int i = 0; i < 60; ++i) {
			contacts += simulator.simulate(FRAME).pair_contacts;
		}
		CHECK(contacts > 1000);
		return all_positions(world);
	};
	const auto reference = run({});
	for (const std::size_t threads : { 1, 2, 3, 8 }) {
		CHECK(run(on_threads(threads)) == reference);
	}
}

TEST_CASE("random crowds of bodies in each other's way stay finite and apart") {
	Random random(43);
	for (int round = 0; round < 40; ++round) {
		WorldData world;
		add_ground(world);
		const int count = random.integer(2, 8);
		for (int i = 0; i < count; ++i) {
			const double stiffness = 300 * std::pow(100.0, double(random.real(0, 1)));
			const double mass = std::pow(30.0, double(random.real(-0.5, 0.5)));
			const auto shape = circle_shape(random.real(0.2, 1), random.integer(3, 20),
					{ Real(mass), Real(stiffness), Real(0.1 * std::sqrt(stiffness * mass)), random.chance(0.7) })
									   .value();
			SoftBodyData body = thesis_body(shape, pile_settings(stiffness), { random.vector(1.5) + Vec2{ 0, 3 }, {} });
			shoot(body, random.vector(8));
			world.add_soft_body(std::move(body));
		}
		Simulator simulator(world);
		for (int i = 0; i < 240; ++i) {
			CHECK(simulator.simulate(FRAME).reset_bodies.empty());
		}
		for (const Vec2 p : all_positions(world)) {
			CHECK(is_finite(p));
		}
	}
}
