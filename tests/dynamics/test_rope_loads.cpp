// SPDX-License-Identifier: MIT
// A rope bears what hangs from it, and runs over what it lies on.
#include "core/collision/environment_contact_solver.h"
#include "scenes/rope.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <cmath>
#include <doctest/doctest.h>
#include <memory>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double PI = std::numbers::pi;

Collider disk(Vec2 center, Real radius, Real friction) {
	Collider collider;
	collider.vertices = { center };
	collider.radius = radius;
	collider.surface.friction = friction;
	return collider;
}

// A firm ball of radius 0.5.
SoftBodyData ball_at(Vec2 place) {
	BodySettings settings;
	settings.shape_stiffness = 800;
	settings.shape_damping = 8;
	settings.integrator = Integrator::SEMI_IMPLICIT_EULER;
	return thesis_body(thesis_shape_with_ratio(4000, Real(0.3)), settings, { place, {} });
}

// A rope over a disk of radius 0.5 about the origin, with two ends that hang down, and a weight at either.
std::unique_ptr<RopeWorld> over_a_disk(Real left, Real right, Real friction) {
	constexpr double RADIUS = 0.52; // the disk's and half of the rope's width
	std::vector<Vec2> path{ { Real(-RADIUS), -2 } };
	for (int i = 0; i <= 32; ++i) {
		const double angle = PI * (1 - i / 32.0);
		path.push_back({ Real(RADIUS * std::cos(angle)), Real(RADIUS * std::sin(angle)) });
	}
	path.push_back({ Real(RADIUS), -2 });
	BodySettings settings;
	settings.friction = 1;
	auto scene = std::make_unique<RopeWorld>(rope_along(divide_path(path, 60).value(), Real(0.04), 1, settings));
	REQUIRE(!scene->world.add_collider(disk({ 0, 0 }, Real(0.5), friction)));
	scene->tie(0, scene->add_weight({ Real(-RADIUS), -2 }, left));
	scene->tie(59, scene->add_weight({ Real(RADIUS), -2 }, right));
	return scene;
}

double height(const RopeWorld &scene, std::size_t weight) {
	return double(scene.world.rigid_bodies()[weight].pose.position.y);
}

} // namespace

TEST_CASE("a rope of 40 points holds 50 times its weight with less than 2 % stretch") {
	double longest = 1;
	SUBCASE("hanging, from the start on") {
		RopeWorld scene(rope_along(line({ 0, 0 }, { 0, -4 }, 40), Real(0.1), 1));
		SUBCASE("pinned") {
			scene.pin(0);
		}
		SUBCASE("joined to the world") {
			scene.hang(0, { 0, 0 });
		}
		const std::uint32_t weight = scene.add_weight({ 0, -4 }, 50);
		scene.tie(39, weight);
		for (int tick = 0; tick < 300; ++tick) {
			scene.simulator.simulate(Real(1) / 60);
			longest = std::max(longest, stretch_of(scene.body()));
		}
		MESSAGE("hanging: longest " << longest << ", weight at " << height(scene, 0));
		CHECK(std::abs(height(scene, 0) + 4) < 0.002);
	}
	SUBCASE("swinging down from the horizontal") {
		RopeWorld scene(rope_along(line({ 0, 0 }, { 4, 0 }, 40), Real(0.1), 1));
		scene.pin(0);
		const std::uint32_t weight = scene.add_weight({ 4, 0 }, 50);
		scene.tie(39, weight);
		double lowest = 0;
		for (int tick = 0; tick < 300; ++tick) {
			scene.simulator.simulate(Real(1) / 60);
			longest = std::max(longest, stretch_of(scene.body()));
			lowest = std::min(lowest, height(scene, 0));
		}
		MESSAGE("swinging: longest " << longest << ", lowest " << lowest);
		CHECK(std::abs(lowest + 4) < 0.01);
	}
	SUBCASE("a soft body hangs from it") {
		RopeWorld scene(rope_along(line({ 0, 0 }, { 0, -4 }, 40), Real(0.1), Real(0.02)));
		scene.pin(0);
		const BodyId jelly = scene.world.add_soft_body(ball_at({ 0, Real(-4.5) }));
		Joint joint;
		joint.first = JointAnchor::on_point(scene.rope, center_of(scene.body(), 39));
		joint.second = nearest_anchor(*scene.world.find(jelly), jelly, { 0, -4 });
		REQUIRE(scene.world.add_joint(joint));
		for (int tick = 0; tick < 300; ++tick) {
			scene.simulator.simulate(Real(1) / 60);
			longest = std::max(longest, stretch_of(scene.body()));
		}
		MESSAGE("jelly: longest " << longest);
	}
	CHECK(longest < 1.02);
}

TEST_CASE("a joint on a rope breaks by the load that it bears") {
	RopeWorld scene(rope_along(line({ 0, 0 }, { 0, -2 }, 20), Real(0.1), 1));
	scene.pin(0);
	const std::uint32_t weight = scene.add_weight({ 0, -2 }, 10);
	SUBCASE("not below it") {
		scene.tie(19, weight, {}, 105); // 10 kg at 10 m/s² are 100 N
		scene.run(2);
		CHECK(scene.world.joints().size() == 1);
	}
	SUBCASE("beyond it") {
		scene.tie(19, weight, {}, 95);
		scene.run(2);
		CHECK(scene.world.joints().empty());
	}
}

TEST_CASE("two weights on a rope over a smooth disk fall as Atwood's machine does") {
	const auto made = over_a_disk(10, 5, 0);
	RopeWorld &scene = *made;
	scene.run(0.5);
	// The rope's mass moves along; what of it changes sides in that time is less than its imbalance of 5 %.
	const double theory = (10 - 5) / (10 + 5 + 1.0) * double(ROPE_GRAVITY) * 0.5 * 0.5 / 2;
	MESSAGE("Atwood: " << -2 - height(scene, 0) << " and " << height(scene, 1) + 2 << ", theory " << theory << ", stretch " << stretch_of(scene.body()));
	CHECK(off(-2 - height(scene, 0), theory) < 0.03);
	CHECK(off(height(scene, 1) + 2, theory) < 0.05);
	CHECK(stretch_of(scene.body()) < 1.01);
}

TEST_CASE("a rope wound halfway around a rough disk nearly holds what Euler's capstan holds") {
	constexpr double MU = 0.3;
	const double ratio = std::exp(MU * PI); // 2.57
	SUBCASE("less creeps; without friction it would fall 7 m") {
		const auto made = over_a_disk(Real(10 * 0.85 * ratio), 10, Real(MU));
		RopeWorld &scene = *made;
		scene.run(2);
		MESSAGE("capstan: crept " << -height(scene, 0) - 2);
		CHECK(std::abs(height(scene, 0) + 2) < 0.1);
	}
	SUBCASE("more slides down, by what friction leaves") {
		const double heavy = 10 * 1.3 * ratio;
		const auto made = over_a_disk(Real(heavy), 10, Real(MU));
		RopeWorld &scene = *made;
		scene.run(0.5);
		// heavy (g - a) = ratio · 10 (g + a), without the rope's own mass.
		const double a = (heavy - 10 * ratio) / (heavy + 10 * ratio) * double(ROPE_GRAVITY);
		MESSAGE("capstan: fell " << -height(scene, 0) - 2 << ", theory " << a * 0.125);
		CHECK(off(-height(scene, 0) - 2, a * 0.125) < 0.4); // its passes do not find the last of which places slide
	}
}

TEST_CASE("a rope comes to rest on a floor and sleeps, and nothing of it is below") {
	BodySettings settings;
	settings.friction = Real(0.5);
	RopeWorld scene(rope_along(line({ -1, 1 }, { 1, Real(1.6) }, 40), Real(0.06), 1, settings));
	Border floor;
	floor.plane = { { 0, 0 }, { 0, 1 } };
	REQUIRE(!scene.world.add_border(floor));
	double deepest = 0;
	for (int tick = 0; tick < 600; ++tick) {
		scene.simulator.simulate(Real(1) / 60);
		deepest = std::max(deepest, double(measure_penetration(scene.world, scene.body())));
	}
	MESSAGE("floor: deepest " << deepest);
	CHECK(deepest < 0.01);
	CHECK(scene.body().is_asleep());
	CHECK(off(stretch_of(scene.body()), 1) < 0.01);
}

TEST_CASE("a rope that falls on a thin line, a post and a corner passes none of them; a line at thirty of its lengths a second, the others at seven") {
	for (const double speed : { 0.0, 2.0, 5.0, 15.0, 20.0, 60.0 }) {
		for (int kind = 0; kind < (speed > 15 ? 1 : 3); ++kind) { // a corner may stay in a faster rope by half of its width
			CAPTURE(speed);
			CAPTURE(kind);
			RopeWorld scene(rope_along(line({ -1, 2 }, { 1, Real(2.2) }, 40), Real(0.05), 1));
			Collider obstacle;
			switch (kind) {
				case 0: obstacle.vertices = { { -30, 0 }, { 30, 0 } }; break; // it may slide far
				case 1: obstacle = disk({ Real(0.03), 0 }, Real(0.04), 1); break;
				case 2: obstacle.vertices = { { 0, 0 }, { Real(-0.3), -1 }, { Real(0.3), -1 } }; break;
			}
			REQUIRE(!scene.world.add_collider(obstacle));
			for (std::uint32_t i = 0; i < scene.body().point_count(); ++i) {
				REQUIRE(!scene.body().set_point(i, scene.body().positions()[i], { 0, Real(-speed) }));
			}
			double deepest = 0;
			const double fall = (std::sqrt(speed * speed + 2 * double(ROPE_GRAVITY) * 2) - speed) / double(ROPE_GRAVITY);
			for (int tick = 0; tick < 60; ++tick) {
				scene.simulator.simulate(Real(1) / 60);
				deepest = std::max(deepest, double(measure_penetration(scene.world, scene.body())));
				if (tick == int(fall * 60) + 3 && kind != 0) { // before its ends swing through below, or it slides off
					bool is_above = false;
					for (std::size_t i = 1; i < 40; ++i) {
						const Vec2 a = center_place(scene.body(), i - 1);
						const Vec2 b = center_place(scene.body(), i);
						is_above |= (a.x < 0) != (b.x < 0) && std::min(a.y, b.y) > 0;
					}
					CHECK(is_above);
				}
			}
			CHECK(deepest < (speed > 5 ? 0.06 : 0.02)); // for a moment a thin post sinks into a fast rope by its width
			CHECK(measure_penetration(scene.world, scene.body()) < Real(0.01));
			if (kind == 0) {
				for (const Vec2 p : scene.body().hull()) {
					CHECK(p.y > -0.02);
				}
			}
		}
	}
}

TEST_CASE("a ball rests on a rope bridge") {
	BodySettings settings;
	RopeWorld scene(rope_along(line({ -2, 0 }, { 2, 0 }, 40), Real(0.1), 1, settings));
	scene.hang(0, { Real(-1.9), 0 });
	scene.hang(39, { Real(1.9), 0 });
	const BodyId ball = scene.world.add_soft_body(ball_at({ 0, Real(0.6) }));
	double longest = 1;
	for (int tick = 0; tick < 600; ++tick) {
		scene.simulator.simulate(Real(1) / 60);
		longest = std::max(longest, stretch_of(scene.body()));
	}
	double lowest = 10;
	for (const Vec2 p : scene.world.find(ball)->hull()) {
		lowest = std::min(lowest, double(p.y));
	}
	MESSAGE("bridge: longest " << longest << ", ball's lowest " << lowest << ", middle of the bridge " << center_place(scene.body(), 20).y);
	CHECK(longest < 1.02);
	CHECK(lowest > double(center_place(scene.body(), 20).y) - 0.1);
}
