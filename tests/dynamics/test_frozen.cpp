// SPDX-License-Identifier: MIT
// Frozen bodies: nothing moves them, others rest on them, and they cost no substep.
#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/dynamics/simulator.h"
#include "core/model/body_frame.h"
#include "core/model/rigid_motion.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real FRAME = Real(1) / 60;

SoftBodyData ball(Vec2 place) {
	BodySettings settings;
	settings.shape_stiffness = 400;
	settings.shape_damping = 4;
	settings.rolling_resistance = Real(0.05);
	return thesis_body(thesis_shape_with_ratio(1000, Real(0.1)), settings, { place, Rotation::from_angle(Real(0.39269908)) });
}

SoftBodyData plank(Vec2 place) {
	const auto shape = SoftBodyCreator::create_polygon(box_hull({ 3, 1 }, Real(0.5)).value(), { 2, 500, 1, true });
	return SoftBodyData::create(shape.value(), {}, { place, {} }).value();
}

struct Scene {
	WorldData world;
	Simulator simulator{ world };
	BodyId plank_id = world.add_soft_body(plank({ 0, 0 }));
	BodyId ball_id = world.add_soft_body(ball({ 0, 2 }));

	Scene() {
		world.set_gravity({ 0, Real(-9.81) });
		plank().set_frozen(true);
	}
	SoftBodyData &plank() { return *world.find(plank_id); }
	SoftBodyData &ball() { return *world.find(ball_id); }
	static SoftBodyData plank(Vec2 place) { return ::plank(place); }
	static SoftBodyData ball(Vec2 place) { return ::ball(place); }
	StepReport step(int count = 1) {
		StepReport report;
		for (int i = 0; i < count; ++i) {
			report = simulator.simulate(FRAME);
		}
		return report;
	}
	void sleep() {
		for (int i = 0; i < 1200 && !ball().is_asleep(); ++i) {
			step();
		}
		REQUIRE(ball().is_asleep());
	}
};

} // namespace

TEST_CASE("a frozen body takes no substeps, does not fall, and carries what falls on it") {
	Scene scene;
	const std::vector<Vec2> start = copy_of(scene.plank().positions());
	StepReport report = scene.step();
	const std::uint64_t of_ball = report.substeps;
	scene.world.find(scene.ball_id)->set_active(false);
	CHECK(scene.step().substeps == 0);
	scene.ball().set_active(true);
	CHECK(scene.step().substeps == of_ball);
	scene.step(300);
	CHECK(identical(scene.plank().positions(), start));
	CHECK(double(measure_frame(scene.ball()).center.y) == doctest::Approx(0.5 + 0.5).epsilon(0.1));
}

TEST_CASE("a body sleeps on a frozen one, which is neither asleep nor counted") {
	Scene scene;
	scene.sleep();
	CHECK(scene.step().sleeping_bodies == 1);
	CHECK(!scene.plank().is_asleep());
	CHECK(scene.plank().is_frozen());
}

TEST_CASE("who monitors and sleeps on a frozen body goes on touching it") {
	Scene scene;
	BodySettings settings = scene.ball().settings();
	settings.contact_monitor = true;
	REQUIRE(!scene.ball().set_settings(settings));
	scene.sleep();
	REQUIRE(scene.simulator.touches().size() == 1);
	for (int tick = 0; tick < 30; ++tick) {
		scene.step();
		CHECK(scene.simulator.contact_events().empty());
	}
	CHECK(scene.simulator.touches().size() == 1);
}

TEST_CASE("forces, impulses and velocities on a frozen body are forgotten") {
	Scene scene;
	SoftBodyData &plank = scene.plank();
	CHECK(!plank.add_external_force(0, { 100, 0 }));
	CHECK(!plank.apply_impulse(0, { 100, 0 }));
	CHECK(!apply_rigid_impulse(plank, { 100, 0 }, {}));
	CHECK(!add_rigid_force(plank, { 100, 0 }, {}));
	CHECK(!add_torque(plank, 100));
	CHECK(!set_linear_velocity(plank, { 100, 0 }));
	CHECK(!plank.is_pushed());
	plank.set_frozen(false);
	CHECK(length(measure_frame(plank).velocity) == 0);
	scene.step();
	CHECK(std::abs(measure_frame(plank).velocity.x) < 1e-5);
}

TEST_CASE("a body that is let go goes on at rest, with the pins it had and those it got") {
	Scene scene;
	SoftBodyData &plank = scene.plank();
	plank.set_frozen(false);
	REQUIRE(!plank.set_pinned(0, true));
	REQUIRE(!set_linear_velocity(plank, { 3, 0 }));
	plank.set_frozen(true);
	for (const Real w : plank.inverse_masses()) {
		CHECK(w == 0);
	}
	REQUIRE(!plank.set_pinned(1, true));
	scene.step(10);
	plank.set_frozen(false);
	CHECK(plank.inverse_masses()[0] == 0);
	CHECK(plank.inverse_masses()[1] == 0);
	CHECK(plank.inverse_masses()[2] > 0);
	for (const Vec2 v : plank.velocities()) {
		CHECK(v == Vec2{});
	}
	scene.step(5);
	CHECK(measure_frame(plank).velocity.y < 0); // it hangs down from its pins
}

TEST_CASE("who sleeps on a frozen body wakes when that is let go, moved, pinned, switched off or removed, or another frozen one comes") {
	for (int change = 0; change < 6; ++change) {
		CAPTURE(change);
		Scene scene;
		scene.sleep();
		scene.step(10);
		REQUIRE(scene.ball().is_asleep());
		switch (change) {
			case 0:
				scene.plank().set_frozen(false);
				break;
			case 1:
				scene.plank().teleport({}, { { 10, 0 }, {} });
				break;
			case 2:
				scene.plank().set_active(false);
				break;
			case 3:
				scene.world.remove_soft_body(scene.plank_id);
				break;
			case 4:
				for (std::uint32_t i = 0; i < scene.plank().point_count(); ++i) {
					scene.plank().set_point(i, scene.plank().positions()[i] - Vec2{ 0, 4 }, {});
				}
				break;
			case 5: {
				SoftBodyData other = ball({ 20, 0 });
				other.set_frozen(true);
				SoftBodyData &comer = *scene.world.find(scene.world.add_soft_body(std::move(other)));
				scene.step(3);
				REQUIRE(scene.ball().is_asleep());
				comer.teleport({}, { measure_frame(scene.ball()).center - Vec2{ Real(19.3), 0 }, {} });
				break;
			}
		}
		const Vec2 before = measure_frame(scene.ball()).center;
		scene.step(5);
		CHECK(!scene.ball().is_asleep());
		CHECK(distance(measure_frame(scene.ball()).center, before) > (change == 5 ? 0.001 : 0.01));
	}
}

TEST_CASE("a frozen body carries what falls on it where its points were set, or its state put back") {
	for (const bool is_restored : { false, true }) {
		CAPTURE(is_restored);
		Scene scene;
		scene.step();
		const BodyState there = scene.plank().save_state();
		const Vec2 way{ 20, 0 };
		for (std::uint32_t i = 0; i < scene.plank().point_count(); ++i) {
			REQUIRE(!scene.plank().set_point(i, scene.plank().positions()[i] + way, {}));
		}
		scene.step();
		if (is_restored) {
			REQUIRE(!scene.plank().restore_state(there));
		} else {
			REQUIRE(!scene.ball().teleport({}, { way, {} }));
		}
		scene.step(180);
		CHECK(double(measure_frame(scene.ball()).center.y) == doctest::Approx(0.5 + 0.46).epsilon(0.1)); // on half the plank
	}
}

TEST_CASE("two piles on one frozen body do not wake each other") {
	Scene scene;
	scene.world.add_soft_body(ball({ Real(-1.2), 2 }));
	scene.ball().teleport({}, { { Real(1.2), 0 }, {} });
	SoftBodyData &first = scene.world.soft_bodies()[2];
	for (int i = 0; i < 1200 && !(scene.ball().is_asleep() && first.is_asleep()); ++i) {
		scene.step();
	}
	REQUIRE(scene.ball().is_asleep());
	REQUIRE(first.is_asleep());
	REQUIRE(!set_linear_velocity(first, { 0, 1 }));
	scene.step(3);
	CHECK(scene.ball().is_asleep());
}

TEST_CASE("a dynamic rigid body comes to rest on a frozen soft body, alone in the world with it") {
	WorldData world;
	world.set_gravity({ 0, -10 });
	SoftBodyData &body = *world.find(world.add_soft_body(plank({ 0, 0 })));
	body.set_frozen(true);
	const std::vector<Vec2> start = copy_of(body.positions());
	RigidBody crate;
	crate.pose.position = { 0, Real(1.5) };
	crate.inverse_mass = Real(0.5);
	crate.inverse_inertia = 1;
	crate.acceleration = { 0, -10 };
	const std::uint32_t index = world.add_rigid_body(crate).value();
	Collider box{ { { Real(-0.4), Real(-0.4) }, { Real(0.4), Real(-0.4) }, { Real(0.4), Real(0.4) }, { Real(-0.4), Real(0.4) } }, 0, {} };
	box.rigid_body = index;
	REQUIRE(!world.add_collider(box));
	Simulator simulator(world);
	for (int i = 0; i < 120; ++i) {
		simulator.simulate(FRAME);
	}
	CHECK(identical(body.positions(), start));
	CHECK(double(world.rigid_bodies()[0].pose.position.y) == doctest::Approx(0.9).epsilon(0.03));
	// Its weight, for the time of the step.
	CHECK(double(world.reactions()[0].impulse.y) == doctest::Approx(2 * 10.0 / 60).epsilon(0.02));
}

TEST_CASE("a body bounces off a frozen one as off a wall") {
	Scene scene;
	scene.world.set_gravity({});
	BodySettings bouncy = scene.ball().settings();
	bouncy.restitution = 1;
	REQUIRE(!scene.ball().set_settings(bouncy));
	REQUIRE(!set_linear_velocity(scene.ball(), { 0, -3 }));
	scene.step(120);
	CHECK(measure_frame(scene.ball()).velocity.y > Real(2));
	CHECK(length(measure_frame(scene.plank()).velocity) == 0);
}
