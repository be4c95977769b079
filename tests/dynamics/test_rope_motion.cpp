// SPDX-License-Identifier: MIT
// A rope swings, hangs and bends as theory says.
#include "core/dynamics/energy.h"
#include "core/dynamics/world_state.h"
#include "scenes/rope.h"
#include "support/compare.h"
#include "support/threads.h"
#include "thesis/momentum.h"

#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <numbers>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double PI = std::numbers::pi;

// Period of an oscillation about 0, from its zero crossings in `seconds`, each placed by linear interpolation.
double period_of(RopeWorld &scene, double seconds, const std::function<double()> &deflection) {
	std::vector<double> crossings;
	double last = deflection();
	for (int tick = 0; tick < int(seconds * 60); ++tick) {
		scene.simulator.simulate(Real(1) / 60);
		const double now = deflection();
		if ((last < 0) != (now < 0)) {
			crossings.push_back((tick + last / (last - now)) / 60);
		}
		last = now;
	}
	REQUIRE(crossings.size() > 4);
	return 2 * (crossings.back() - crossings.front()) / double(crossings.size() - 1);
}

double energy_of(RopeWorld &scene) {
	return measure_energy(scene.body(), scene.world.gravity()).total();
}

} // namespace

TEST_CASE("a rope of one link swings with the period of a pendulum") {
	constexpr double ANGLE = 0.3;
	RopeWorld scene(rope_along(line({ 0, 0 }, { Real(2 * std::sin(ANGLE)), Real(-2 * std::cos(ANGLE)) }, 2), Real(0.05), 1));
	scene.pin(0);
	// The point mass at its end; the series of the period in the amplitude.
	const double theory = 2 * PI * std::sqrt(2 / double(ROPE_GRAVITY)) * (1 + ANGLE * ANGLE / 16 + 11 * std::pow(ANGLE, 4) / 3072);
	CHECK(off(period_of(scene, 20, [&] { return double(center_place(scene.body(), 1).x); }), theory) < 0.003);
}

TEST_CASE("a hanging rope swings in its first mode with Bernoulli's frequency") {
	// Small deflections of a hanging chain are J0(2 ω sqrt(s / g)), s the height above its free end: at the first zero of J0 it is held.
	constexpr double ZERO_OF_J0 = 2.404825557695773;
	const double omega = ZERO_OF_J0 / 2 * std::sqrt(double(ROPE_GRAVITY) / 2);
	std::vector<Vec2> path;
	for (int i = 0; i < 40; ++i) {
		const double s = 2 - 2.0 * i / 39;
		path.push_back({ Real(0.05 * std::cyl_bessel_j(0, ZERO_OF_J0 * std::sqrt(s / 2))), Real(s - 2) });
	}
	BodySettings settings;
	settings.can_sleep = false; // the swing is slow at its ends
	RopeWorld scene(rope_along(path, Real(0.02), 1, settings));
	scene.pin(0);
	CHECK(off(period_of(scene, 20, [&] { return double(center_place(scene.body(), 39).x); }), 2 * PI / omega) < 0.01);
}

TEST_CASE("a rope between two posts hangs as a catenary") {
	constexpr double LENGTH = 3;
	constexpr double SPAN = 2;
	BodySettings settings;
	settings.linear_damp = 3;
	settings.can_sleep = false;
	// Laid out as a V of the right length.
	const double depth = std::sqrt(LENGTH * LENGTH - SPAN * SPAN) / 2;
	const std::vector<Vec2> v{ { -1, 0 }, { 0, Real(-depth) }, { 1, 0 } };
	const int count = 61;
	RopeWorld scene(rope_along(divide_path(v, count).value(), Real(0.01), 1, settings));
	scene.pin(0);
	scene.pin(count - 1);
	scene.run(30);
	// 2 a sinh(SPAN / 2a) = LENGTH.
	double low = 0.1;
	double high = 10;
	for (int i = 0; i < 200; ++i) {
		const double a = (low + high) / 2;
		(2 * a * std::sinh(SPAN / (2 * a)) > LENGTH ? low : high) = a;
	}
	const double a = low;
	double worst = 0;
	for (int i = 0; i < count; ++i) {
		const Vec2 p = center_place(scene.body(), std::size_t(i));
		worst = std::max(worst, std::abs(double(p.y) - a * (std::cosh(double(p.x) / a) - std::cosh(SPAN / (2 * a)))));
	}
	MESSAGE("catenary: largest distance " << worst << ", stretch " << stretch_of(scene.body()));
	CHECK(worst < 0.0003 * LENGTH); // 60 links stand for a curve
	CHECK(off(stretch_of(scene.body()), 1) < 1e-4);
}

TEST_CASE("a clamped strap sags by its weight as a cantilever beam") {
	constexpr double LENGTH = 1;
	constexpr double EI = 20;
	const int count = 41;
	BodySettings settings;
	settings.bending_stiffness = Real(EI);
	settings.linear_damp = 5;
	settings.can_sleep = false;
	RopeWorld scene(rope_along(line({ Real(-LENGTH / (count - 2)), 0 }, { LENGTH, 0 }, count), Real(0.02), 1, settings));
	scene.pin(0);
	scene.pin(1);
	scene.run(10);
	const double weight = 1.0 * (count - 2) / (count - 1) * double(ROPE_GRAVITY); // of the part beyond the clamp
	// w L^4 / 8 EI, with w L the weight; and the bend at the clamp goes on for half a link behind it: M (link / 2) L / EI, with M = w L^2 / 2.
	const double link = LENGTH / (count - 2);
	const double theory = weight * std::pow(LENGTH, 3) / (8 * EI) * (1 + 2 * link / LENGTH);
	CHECK(off(-double(center_place(scene.body(), count - 1).y), theory) < 0.01);
	SUBCASE("twice as stiff, half the sag") {
		settings.bending_stiffness = Real(2 * EI);
		CHECK(!scene.body().set_settings(settings));
		scene.run(10);
		CHECK(off(-double(center_place(scene.body(), count - 1).y), theory / 2) < 0.01);
	}
}

TEST_CASE("a strap that was designed bent bends back as far as it is told") {
	std::vector<Vec2> arc;
	for (int i = 0; i <= 20; ++i) {
		arc.push_back({ Real(std::sin(i * 0.1)), Real(std::cos(i * 0.1)) });
	}
	BodySettings settings;
	settings.bending_stiffness = 10;
	settings.chain_damping_time = Real(0.1);
	settings.gravity_scale = 0;
	for (const double bend : { 0.0, 0.5, 1.0 }) {
		settings.rest_bend = Real(bend);
		RopeWorld scene(rope_along(arc, Real(0.05), 1, settings));
		scene.run(5);
		const Vec2 first = center_place(scene.body(), 1) - center_place(scene.body(), 0);
		const Vec2 last = center_place(scene.body(), 20) - center_place(scene.body(), 19);
		const double turn = std::atan2(double(cross(first, last)), double(dot(first, last)));
		CHECK(std::abs(turn + 1.9 * bend) < 0.03);
	}
}

TEST_CASE("a rubber band stretches by its load over its axial stiffness") {
	BodySettings settings;
	settings.axial_stiffness = 100;
	settings.chain_damping_time = Real(0.05);
	settings.linear_damp = 2;
	RopeWorld scene(rope_along(line({ 0, 0 }, { 0, -2 }, 21), Real(0.05), Real(0.1), settings));
	scene.pin(0);
	const std::uint32_t weight = scene.add_weight({ 0, -2 }, 2);
	scene.tie(20, weight);
	scene.run(20);
	// The weight pulls everywhere, and half of the rope's own on average.
	CHECK(off(stretch_of(scene.body()) - 1, (2 + 0.05) * double(ROPE_GRAVITY) / 100) < 0.01);
}

TEST_CASE("a rope thrown through empty space keeps its momentum and spin, and gains no energy") {
	BodySettings settings;
	settings.bending_stiffness = Real(0.5);
	RopeWorld scene(rope_along(line({ 0, 0 }, { 2, Real(0.3) }, 30), Real(0.04), 2, settings));
	CHECK(!scene.world.set_gravity({}));
	for (std::uint32_t i = 0; i < scene.body().point_count(); ++i) {
		const Vec2 p = scene.body().positions()[i];
		CHECK(!scene.body().set_point(i, p, { 1 + 3 * std::sin(3 * p.x), 2 * p.x }));
	}
	scene.simulator.simulate(Real(1) / 60); // its sections are square to it from now on
	const Momentum start = measure_momentum(scene.body());
	const double energy = energy_of(scene); // it is nearly straight: bending holds little
	for (int second = 0; second < 10; ++second) {
		scene.run(1);
		const Momentum now = measure_momentum(scene.body());
		CHECK(std::hypot(now.linear_x - start.linear_x, now.linear_y - start.linear_y) < 1e-3);
		CHECK(std::abs(now.angular - start.angular) < 2e-3 * std::abs(start.angular)); // about the origin, of a body far away in floats
		CHECK(energy_of(scene) <= energy * 1.01);
	}
	CHECK(stretch_of(scene.body()) < 1.002);
}

TEST_CASE("a rope that falls from the horizontal never rises above its energy, and keeps its length") {
	RopeWorld scene(rope_along(line({ 0, 0 }, { 2, 0 }, 40), Real(0.03), 1));
	scene.pin(0);
	const double start = energy_of(scene);
	double most = start;
	double longest = 1;
	double at_two = 0;
	for (int tick = 0; tick < 600; ++tick) {
		scene.simulator.simulate(Real(1) / 60);
		most = std::max(most, energy_of(scene));
		longest = std::max(longest, stretch_of(scene.body()));
		if (tick == 120) {
			at_two = energy_of(scene);
		}
	}
	MESSAGE("whip: longest " << longest << ", energy at start " << start << ", most " << most << ", after 2 s " << at_two);
	CHECK(most < start + 0.02 * 10); // of 10 J between the highest and the lowest place
	CHECK(longest < 1.01);
}

TEST_CASE("a rope moves by the same bits on any number of threads, and again from a saved state") {
	const auto make = [](const ParallelFor &threads) {
		auto scene = std::make_unique<RopeWorld>(rope_along(line({ 0, 0 }, { 2, 0 }, 24), Real(0.05), 1), threads);
		scene->hang(0, { 0, 0 });
		const std::uint32_t weight = scene->add_weight({ 2, 0 }, 20);
		scene->tie(23, weight);
		(void)scene->world.add_soft_body(rope_along(line({ 0, -1 }, { 3, -1 }, 24), Real(0.05), 1));
		Border floor;
		floor.plane = { { 0, -3 }, { 0, 1 } };
		(void)scene->world.add_border(floor);
		return scene;
	};
	auto alone = make({});
	auto many = make(on_threads(4));
	alone->run(2);
	many->run(2);
	CHECK(identical(alone->body().positions(), many->body().positions()));
	WorldState states;
	const std::vector<std::uint8_t> saved = states.save(alone->simulator, {}).value();
	const std::vector<RigidBody> rigid(alone->world.rigid_bodies().begin(), alone->world.rigid_bodies().end());
	alone->run(2);
	const std::vector<Vec2> after = copy_of(alone->body().positions());
	REQUIRE(!states.read(alone->simulator, {}, saved));
	states.put_back(alone->simulator);
	for (std::uint32_t i = 0; i < rigid.size(); ++i) {
		REQUIRE(!alone->world.set_rigid_body(i, rigid[i]));
	}
	alone->run(2);
	CHECK(identical(alone->body().positions(), after));
}
