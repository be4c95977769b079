// SPDX-License-Identifier: MIT
// Claims about the sleep of what floats: it falls asleep where its weight is borne, and wakes when the fluid changes.
#include "core/creator/hulls.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/fluid_forces.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/world_state.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

/// A sea in a world in pixels, as the node `SoftBodyFluid2D` makes it: named before each step, and pushing what is awake.
struct Sea {
	WorldData world = pixel_world();
	Simulator simulator{ world };
	Fluid fluid{ Real(2) / (PIXELS_PER_METER * PIXELS_PER_METER), 1, 2, {}, { 0, PIXEL_GRAVITY } };
	Real surface = 0;
	std::uint64_t number = 1;

	std::vector<Vec2> region() const {
		return { { -5000, surface }, { 5000, surface }, { 5000, surface + 5000 }, { -5000, surface + 5000 } };
	}
	std::vector<Vec2> forces_on(const SoftBodyData &body, bool at_rest = false) const {
		std::vector<Vec2> forces(body.hull().size());
		std::vector<Vec2> velocities(body.velocities().begin(), body.velocities().begin() + std::ptrdiff_t(forces.size()));
		if (at_rest) {
			std::ranges::fill(velocities, Vec2{});
		}
		add_fluid_forces(fluid, region(), body.hull(), velocities, body.shape().total_mass() / Real(body.point_count()), FRAME, forces);
		return forces;
	}
	void step() {
		for (SoftBodyData &body : world.soft_bodies()) {
			body.set_fluids(number);
			if (!body.is_asleep()) {
				const std::vector<Vec2> forces = forces_on(body);
				for (std::uint32_t i = 0; i < forces.size(); ++i) {
					REQUIRE_FALSE(body.add_fluid_force(i, forces[i]));
				}
			}
		}
		simulator.simulate(FRAME);
	}
	/// Steps for that time at most [s]; when the body fell asleep, or -1.
	double sleep(BodyId id, double time) {
		for (int i = 0; i < int(time * 60); ++i) {
			step();
			if (world.find(id)->is_asleep()) {
				return i / 60.0;
			}
		}
		return -1;
	}
	/// The acceleration that nothing bears, as a share of gravity.
	double unborne(const SoftBodyData &body) const {
		Vec2 sum = world.gravity() * body.shape().total_mass();
		for (const Vec2 force : forces_on(body, true)) {
			sum += force;
		}
		return double(length(sum)) / double(PIXEL_GRAVITY * body.shape().total_mass());
	}
};

SoftBodyData disk(Real mass, Vec2 place, Real radius = JELLY_RADIUS, int points = 32) {
	const auto shape = circle_shape(radius, points, { mass, Real(400), Real(0.2), true });
	BodySettings settings = jelly_settings(400);
	return SoftBodyData::create(shape.value(), settings, Pose{ place, {} }).value();
}

// The d for which the part of a unit disk below a line at distance d above its middle has that share of its area, by halving.
double depth_of(double share) {
	double low = -1, high = 1;
	for (int i = 0; i < 60; ++i) {
		const double d = (low + high) / 2;
		const double below = (std::acos(-d) + d * std::sqrt(1 - d * d)) / 3.14159265358979323846;
		(below < share ? low : high) = d;
	}
	return low;
}

} // namespace

TEST_CASE("a disk dropped into still water falls asleep within twenty seconds, as deep as the circle's segment says") {
	for (const double share : { 0.25, 0.5, 0.8 }) { // of the water's density
		Sea sea;
		const double area = 3.14159265358979323846 * double(JELLY_RADIUS) * double(JELLY_RADIUS);
		const Real mass = Real(share * area * double(sea.fluid.density));
		const BodyId id = sea.world.add_soft_body(disk(mass, { 0, -120 }));
		const double asleep = sea.sleep(id, 20);
		CAPTURE(share);
		CHECK(asleep > 1); // after it has bobbed
		const SoftBodyData &body = *sea.world.find(id);
		CHECK(double(measure_frame(body).center.y) == doctest::Approx(depth_of(share) * double(JELLY_RADIUS)).epsilon(0.001).scale(1000)); // 1 px
		const std::vector<Vec2> before(body.positions().begin(), body.positions().end());
		for (int i = 0; i < 600; ++i) {
			sea.step();
		}
		CHECK(std::ranges::equal(before, body.positions()));
	}
}

TEST_CASE("whatever floats falls asleep where its weight is borne: 300 bodies of any form, weight and fall, in any water" * doctest::test_suite("slow")) {
	double worst = 0;
	double longest = 0;
	for (std::uint64_t seed = 1; seed <= 300; ++seed) {
		Random random(seed);
		Sea sea;
		sea.fluid.drag = random.real(0.5, 2);
		sea.fluid.viscosity = random.real(1, 6);
		std::vector<Vec2> hull = random.chance(0.5) ? circle_hull(random.real(20, 90), random.integer(8, 32)).value() : box_hull({ random.real(40, 160), random.real(40, 160) }, 20).value();
		const Real flatness = random.real(0.5, 1);
		for (Vec2 &point : hull) {
			point.y *= flatness;
		}
		StructureOptions options;
		options.mass = random.real(0.15, 0.9) * std::abs(signed_area(hull)) * sea.fluid.density;
		options.stiffness = 400;
		options.damping = Real(0.2);
		const auto shape = SoftBodyCreator::create_polygon(hull, options);
		REQUIRE(shape);
		const Pose start{ { random.real(-200, 200), random.real(-300, 100) }, Rotation::from_angle(random.real(-3, 3)) };
		const BodyId id = sea.world.add_soft_body(SoftBodyData::create(shape.value(), jelly_settings(400), start).value());
		const double time = sea.sleep(id, 60);
		longest = std::max(longest, time);
		const double unborne = sea.unborne(*sea.world.find(id));
		CAPTURE(seed);
		CHECK(time >= 0);
		worst = std::max(worst, unborne);
	}
	CHECK(worst < 0.02); // of its weight; measured 0.0144
	CHECK(longest < 60); // [s]; measured 38
}

TEST_CASE("without drag and viscosity bodies bob on as high as they did, and no higher") {
	for (const double share : { 0.1, 0.3, 0.7 }) {
		Sea sea;
		sea.fluid.drag = 0;
		sea.fluid.viscosity = 0;
		sea.world.set_sleeping(false);
		StructureOptions options;
		options.mass = Real(share * 160 * 40 * double(sea.fluid.density));
		options.stiffness = 4000; // firm, so that it takes no energy
		options.damping = 0;
		BodySettings settings = jelly_settings(4000);
		settings.shape_damping = 0;
		const auto shape = SoftBodyCreator::create_polygon(box_hull({ 160, 40 }, 20).value(), options);
		REQUIRE(shape);
		const double level = 20 - 40 * share; // of its middle, where it floats
		const BodyId id = sea.world.add_soft_body(SoftBodyData::create(shape.value(), settings, Pose{ { 0, Real(level - 3 * share) }, {} }).value());
		double early = 0, late = 0;
		for (int i = 0; i < 60 * 30; ++i) {
			sea.step();
			double &most = i < 60 * 2 ? early : late;
			most = i == 60 * 28 ? 0 : std::max(most, std::abs(double(measure_frame(*sea.world.find(id)).center.y) - level));
		}
		CAPTURE(share);
		CHECK(late < 1.05 * early); // by the places at the start of each step: up to eleven times as high
	}
}

TEST_CASE("a floating body wakes when the fluid is another or elsewhere, and follows the level") {
	Sea sea;
	const BodyId id = sea.world.add_soft_body(disk(1, { 0, -50 }));
	REQUIRE(sea.sleep(id, 30) >= 0);
	const Vec2 before = measure_frame(*sea.world.find(id)).center;
	sea.surface = 40; // the water sinks
	sea.number = 2;
	sea.step();
	CHECK_FALSE(sea.world.find(id)->is_asleep());
	REQUIRE(sea.sleep(id, 30) >= 0);
	CHECK(double(measure_frame(*sea.world.find(id)).center.y - before.y) == doctest::Approx(40).epsilon(0.025));
	sea.number = 0; // it drains
	sea.fluid.density = 0;
	for (int i = 0; i < 30; ++i) {
		sea.step();
	}
	CHECK(double(measure_frame(*sea.world.find(id)).center.y - before.y) == doctest::Approx(40 + 122.5).epsilon(0.05)); // g t²/2
}

TEST_CASE("waves keep a floating body awake, and what sinks slowly in thick fluid does not fall asleep on its way") {
	Sea sea;
	const BodyId id = sea.world.add_soft_body(disk(1, { 0, -50 }));
	for (int i = 0; i < 60 * 60; ++i) {
		sea.surface = 3 * std::sin(Real(i) / 20);
		sea.number = std::uint64_t(i + 1);
		sea.step();
		REQUIRE_FALSE(sea.world.find(id)->is_asleep());
	}

	for (const double speed : { 1.5, 3.0, 4.5 }) { // px/s, slower than what counts as rest
		Sea honey;
		honey.surface = -1000;
		const double area = 3.14159265358979323846 * double(JELLY_RADIUS) * double(JELLY_RADIUS);
		const double displaced = area * double(honey.fluid.density);
		const double mass = 1.05 * displaced;
		honey.fluid.drag = 0;
		honey.fluid.viscosity = Real((mass - displaced) * double(PIXEL_GRAVITY) / (displaced * speed));
		REQUIRE(honey.fluid.viscosity * Real(displaced / mass) * FRAME < 10);
		const BodyId stone = honey.world.add_soft_body(disk(Real(mass), { 0, 0 }));
		for (int i = 0; i < 60 * 20; ++i) {
			honey.step();
			REQUIRE_FALSE(honey.world.find(stone)->is_asleep());
		}
		const double way = double(measure_frame(*honey.world.find(stone)).center.y) / (20 * speed);
		CHECK(way > 0.6); // drowsiness takes a part of it: measured 0.93, 0.79 and 0.67
		CHECK(way < 1.05);
	}
}

TEST_CASE("a body that a script puts to sleep in a fluid sleeps on, and wakes when the fluid is another") {
	Sea sea;
	const BodyId id = sea.world.add_soft_body(disk(1, { 0, -200 }));
	sea.world.find(id)->put_to_sleep();
	sea.step();
	sea.step();
	CHECK(sea.world.find(id)->is_asleep());
	sea.number = 2;
	sea.step();
	CHECK_FALSE(sea.world.find(id)->is_asleep());
	// In a world whose fluids nobody names, none is taken for none.
	sea.world.find(id)->put_to_sleep();
	sea.simulator.simulate(FRAME);
	CHECK(sea.world.find(id)->fluids() == 0);
	CHECK(sea.world.find(id)->is_asleep());
}

TEST_CASE("a world put back to before the water changed goes on in the same bits, asleep and awake") {
	Sea sea;
	const BodyId id = sea.world.add_soft_body(disk(1, { 0, -50 }));
	REQUIRE(sea.sleep(id, 30) >= 0);
	const std::vector<std::uint8_t> saved = WorldState().save(sea.simulator, {}).value();
	std::vector<std::uint64_t> hashes;
	for (int round = 0; round < 2; ++round) {
		for (int i = 0; i < 90; ++i) {
			sea.surface = Real(i < 30 ? 0 : 25);
			sea.number = i < 30 ? 1 : 2;
			sea.step();
			CHECK(sea.world.find(id)->is_asleep() == (i < 30));
			hashes.push_back(hash_of_motion(sea.world));
		}
		WorldState state;
		REQUIRE_FALSE(state.read(sea.simulator, {}, saved));
		state.put_back(sea.simulator);
	}
	CHECK(std::equal(hashes.begin(), hashes.begin() + 90, hashes.begin() + 90));
}

TEST_CASE("a force of a fluid is refused as any other, and neither wakes nor moves what sleeps") {
	Sea sea;
	const BodyId id = sea.world.add_soft_body(disk(1, {}));
	SoftBodyData &body = *sea.world.find(id);
	CHECK(body.add_fluid_force(500, {}));
	CHECK(body.add_fluid_force(0, { Real(NAN), 0 }));
	body.put_to_sleep();
	CHECK_FALSE(body.add_fluid_force(0, { 100, 0 }));
	CHECK(body.is_asleep());
	CHECK(body.external_forces().empty());
}
