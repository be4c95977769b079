// SPDX-License-Identifier: MIT
// Claims about round bodies that roll: as rigid discs do, on any ground, at any tick rate, and not by themselves.
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "core/model/internal_edges.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double DEGREE = std::numbers::pi / 180;

enum class Ground { BORDER, BOX, SEGMENT, TILES, ONE_WAY };
constexpr std::array GROUNDS = { Ground::BORDER, Ground::BOX, Ground::SEGMENT, Ground::TILES, Ground::ONE_WAY };

struct Disc {
	int points = 16;
	Real stiffness = 10000;
	Ground ground = Ground::BORDER;
	int rate = 60;
	Real damping = 1; ///< of the default body's
};

// A disc with its lowest edge flat on level ground at y = 0.
WorldData world_with(const Disc &disc) {
	WorldData world = pixel_world();
	world.set_sleeping(false);
	Collider box = box_collider({ 0, 500 }, { 20000, 500 });
	switch (disc.ground) {
		case Ground::BORDER:
			world.add_border(floor_at(0));
			break;
		case Ground::ONE_WAY:
			box.one_way = { 0, -1 };
			[[fallthrough]];
		case Ground::BOX:
			world.add_collider(box);
			break;
		case Ground::SEGMENT:
			world.add_collider({ { { -20000, 0 }, { 20000, 0 } }, 0, {} });
			break;
		case Ground::TILES: {
			std::vector<Collider> tiles;
			for (int i = -20; i < 100; ++i) {
				tiles.push_back(box_collider({ Real(32 * i + 16), 16 }, { 16, 16 }));
			}
			mark_internal_edges(tiles, Real(1) / 16);
			for (const Collider &tile : tiles) {
				world.add_collider(tile);
			}
		}
	}
	const auto shape = circle_shape(JELLY_RADIUS, disc.points,
			{ JELLY_MASS, disc.stiffness, disc.damping * Real(0.012) * std::sqrt(disc.stiffness), true }).value();
	BodySettings settings = jelly_settings(disc.stiffness);
	settings.shape_damping *= disc.damping;
	settings.rolling_resistance = 0;
	settings.friction = 1;
	const double half = std::numbers::pi / disc.points;
	const Pose pose{ { 0, Real(-JELLY_RADIUS * std::cos(half)) }, Rotation::from_angle(Real(half)) };
	world.add_soft_body(SoftBodyData::create(shape, settings, pose).value());
	return world;
}

// How much farther than a rigid disc of its mass, inertia and radius it rolls in `seconds` from rest [1].
double lead_over_theory(const Disc &disc, double degrees, double seconds = 3) {
	WorldData world = world_with(disc);
	Simulator simulator(world);
	const SoftBodyData &body = world.soft_bodies()[0];
	for (int i = 0; i < disc.rate; ++i) { // a second to settle
		simulator.simulate(Real(1) / disc.rate);
	}
	const BodyFrame start = measure_frame(body);
	const double angle = degrees * DEGREE;
	world.set_gravity({ Real(PIXEL_GRAVITY * std::sin(angle)), Real(PIXEL_GRAVITY * std::cos(angle)) });
	for (int i = 0; i < int(seconds * disc.rate); ++i) {
		simulator.simulate(Real(1) / disc.rate);
	}
	const SoftBodyShape &shape = body.shape();
	const double ratio = double(shape.rest_inertia()) / (double(shape.total_mass()) * JELLY_RADIUS * JELLY_RADIUS);
	const double from_rest = PIXEL_GRAVITY * std::sin(angle) * seconds * seconds / 2 / (1 + ratio);
	const double on = (double(start.velocity.x) + ratio * JELLY_RADIUS * double(start.angular_velocity)) / (1 + ratio) * seconds;
	return double(measure_frame(body).center.x - start.center.x) / (from_rest + on) - 1;
}

} // namespace

TEST_CASE("a firm circle of 12 to 32 points rolls down a slope as a rigid disc does, within 5 %") {
	for (const int points : { 12, 16, 20, 24, 32 }) {
		for (const double degrees : { 5.0, 10.0, 20.0, 30.0 }) {
			CAPTURE(points);
			CAPTURE(degrees);
			CHECK(std::abs(lead_over_theory({ .points = points }, degrees)) < 0.05);
		}
	}
}

// With springs solved in one direction only, and as implicit Euler from a damping of half the wobble on, 64 points lost up to 6 %.
TEST_CASE("a firm circle of 32 or 64 points rolls as a rigid disc does, within 2 %, damped or not") {
	for (const int points : { 32, 64 }) {
		for (const double degrees : { 5.0, 10.0, 20.0, 30.0 }) {
			for (const Real damping : { Real(0), Real(1) }) {
				CAPTURE(points);
				CAPTURE(degrees);
				CAPTURE(damping);
				CHECK(std::abs(lead_over_theory({ .points = points, .damping = damping }, degrees)) < 0.02);
			}
		}
	}
}

// One direction turned it: 28 px/s after 20 s.
TEST_CASE("a circle that XPBD steps on level ground is not turned by the order of its springs") {
	WorldData world = world_with({ .points = 64, .stiffness = 1000 });
	Simulator simulator(world);
	for (int i = 0; i < 1200; ++i) {
		simulator.simulate(Real(1) / 60);
	}
	CHECK(std::abs(measure_frame(world.soft_bodies()[0]).velocity.x) < 5); // it rocks
	CHECK(std::abs(measure_frame(world.soft_bodies()[0]).center.x) < 10);
}

TEST_CASE("it rolls alike on a half-plane, a box, a segment, tiles and a one-way platform, at 30 to 240 ticks") {
	for (const Ground ground : GROUNDS) {
		for (const int rate : { 30, 60, 120, 240 }) {
			CAPTURE(int(ground));
			CAPTURE(rate);
			CHECK(std::abs(lead_over_theory({ .ground = ground, .rate = rate }, 10)) < 0.05);
		}
	}
}

TEST_CASE("round bodies dropped at random come to rest and sleep, and nothing gains energy: 200 seeds" * doctest::test_suite("slow")) {
	for (std::uint32_t seed = 0; seed < 200; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		Disc disc;
		disc.points = random.integer(12, 40);
		disc.stiffness = Real(std::pow(10, double(random.real(2, 4))));
		disc.ground = GROUNDS[std::size_t(random.integer(0, int(GROUNDS.size()) - 1))];
		WorldData world = world_with(disc);
		world.set_sleeping(true);
		SoftBodyData &body = *world.find(world.id_at(0));
		BodySettings settings = body.settings();
		settings.rolling_resistance = Real(0.03);
		REQUIRE_FALSE(body.set_settings(settings));
		const Vec2 rise{ 0, -random.real(0, 100) };
		const Vec2 velocity{ random.real(-200, 200), 0 };
		for (std::uint32_t i = 0; i < body.point_count(); ++i) {
			body.set_point(i, body.positions()[i] + rise, velocity);
		}
		const auto energy = [&] { // of the whole motion: in the middle of an impact the elastic part says nothing
			const Energy each = measure_energy(body, world.gravity());
			return each.kinetic + each.gravity;
		};
		const double first = energy();
		const double scale = PIXEL_GRAVITY * JELLY_RADIUS;
		Simulator simulator(world);
		double most = 0;
		int ticks = 0;
		while (!body.is_asleep() && ticks < 60 * 20) {
			simulator.simulate(FRAME);
			most = std::max(most, energy() - first);
			++ticks;
		}
		CHECK(body.is_asleep());
		CHECK(most < 0.002 * scale);
		CHECK(measure_penetration(world, body) < Real(0.1));
	}
}

TEST_CASE("a round body hides its corners in contacts only: at rest it lies as deep as its polygon") {
	for (const Ground ground : GROUNDS) {
		for (const int points : { 12, 16, 24, 32 }) {
			CAPTURE(int(ground));
			CAPTURE(points);
			WorldData world = world_with({ .points = points, .stiffness = 400, .ground = ground });
			Simulator simulator(world);
			for (int i = 0; i < 600; ++i) {
				simulator.simulate(FRAME);
			}
			Real lowest = -100;
			for (const Vec2 p : world.soft_bodies()[0].hull()) {
				lowest = std::max(lowest, p.y);
			}
			const double bulge = JELLY_RADIUS * (1 - std::cos(std::numbers::pi / points));
			CHECK(lowest < Real(0.1));
			CHECK(double(lowest) > -bulge - 0.15); // a bare segment is a slop thick
		}
	}
}
