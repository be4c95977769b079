// SPDX-License-Identifier: MIT
// Bodies stepped side by side, on any number of threads, move as each would alone: to the last bit.
#include "core/base/constants.h"
#include "core/dynamics/simulator.h"
#include "scenes/chain.h"
#include "scenes/deformations.h"
#include "scenes/thesis_body.h"
#include "support/batches.h"
#include "support/random.h"
#include "support/threads.h"

#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

// Bodies that cannot touch one another, deformed and moving, partly through the ground at y = 0.
std::vector<SoftBodyData> loners(int count, const BodySettings &settings, Random &random) {
	BodySettings apart = settings;
	apart.collision_layer = 2;
	apart.collision_mask = 1;
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	std::vector<SoftBodyData> bodies;
	for (int i = 0; i < count; ++i) {
		Pose pose{ { Real(2 * i), random.real(0.2, 1.5) }, Rotation::from_angle(random.real(-3, 3)) };
		SoftBodyData body = thesis_body(shape, apart, pose);
		for (std::uint32_t point = 0; point < body.point_count(); ++point) {
			body.set_point(point, body.positions()[point] + random.vector(0.1), random.vector(3));
		}
		bodies.push_back(std::move(body));
	}
	return bodies;
}

void prepare(WorldData &world) {
	world.set_gravity({ 0, Real(-9.81) });
	Border ground;
	ground.plane = { { 0, 0 }, { 0, 1 } };
	ground.surface.angular_velocity = Real(0.1);
	ground.surface.linear_velocity = { Real(0.5), 0 };
	world.add_border(ground);
}

// The sums of what so many steps count; nobody may be reset in them.
StepReport run_steps(WorldData &world, int steps) {
	Simulator simulator(world);
	StepReport sums;
	for (int i = 0; i < steps; ++i) {
		const StepReport report = simulator.simulate(Real(1) / 60);
		CHECK(report.reset_bodies.empty());
		sums.contacts += report.contacts;
		sums.substeps += report.substeps;
	}
	return sums;
}

bool same_state(const SoftBodyData &a, const SoftBodyData &b) {
	return std::ranges::equal(a.positions(), b.positions()) && std::ranges::equal(a.velocities(), b.velocities()) &&
			a.rotation_memory().c == b.rotation_memory().c && a.rotation_memory().s == b.rotation_memory().s;
}

} // namespace

TEST_CASE("bodies side by side end in the same bits as each of them alone, with every integrator and term") {
	BodySettings springs;
	BodySettings everything;
	everything.shape_stiffness = 120;
	everything.shape_damping = Real(0.5);
	everything.pressure_stiffness = 200;
	everything.inflation = Real(1.1);
	everything.rolling_resistance = Real(0.03);
	everything.gravity_scale = Real(0.7);
	BodySettings bouncing = everything; // some touch the ground, others fly
	bouncing.restitution = Real(0.6);
	for (const BodySettings &model : { springs, everything, bouncing }) {
		for (int method = 0; method < INTEGRATOR_COUNT; ++method) {
			BodySettings settings = model;
			settings.integrator = Integrator(method);
			settings.substeps = method == 0 ? 0 : 12;
			CAPTURE(method);
			Random random(method);
			// Two batches that may go at once, a third, and two that are left over.
			const std::vector<SoftBodyData> bodies = loners(14, settings, random);
			WorldData together;
			prepare(together);
			for (const SoftBodyData &body : bodies) {
				together.add_soft_body(body);
			}
			const StepReport sums = run_steps(together, 60);
			StepReport alone_sums;
			for (std::size_t i = 0; i < bodies.size(); ++i) {
				WorldData alone;
				prepare(alone);
				alone.add_soft_body(bodies[i]);
				const StepReport single = run_steps(alone, 60);
				alone_sums.contacts += single.contacts;
				alone_sums.substeps += single.substeps;
				CHECK(same_state(alone.soft_bodies()[0], together.soft_bodies()[i]));
			}
			CHECK(sums.contacts > 0);
			CHECK(sums.contacts == alone_sums.contacts);
			CHECK(sums.substeps == alone_sums.substeps);
		}
	}
}

TEST_CASE("balloons of which some are stretched, and so take more substeps, end in the same bits as each alone") {
	BodySettings settings;
	settings.pressure_stiffness = 6000;
	settings.collision_layer = 2;
	settings.collision_mask = 1;
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	for (int stretched = 0; stretched < 8; ++stretched) { // one of two batches that would else go at once
		CAPTURE(stretched);
		std::vector<SoftBodyData> bodies;
		for (int i = 0; i < 8; ++i) {
			SoftBodyData body = thesis_body(shape, settings, { { Real(9 * i), 9 }, {} });
			const Vec2 center = body.positions()[THESIS_HULL_POINTS];
			for (std::uint32_t point = 0; i == stretched && point < body.point_count(); ++point) {
				REQUIRE(!body.set_point(point, center + (body.positions()[point] - center) * 3, {}));
			}
			bodies.push_back(std::move(body));
		}
		WorldData together;
		prepare(together);
		for (const SoftBodyData &body : bodies) {
			together.add_soft_body(body);
		}
		const Real dt = Real(1) / 60;
		Simulator simulator(together);
		const SubstepPlan calm = simulator.plan(bodies[(stretched + 1) % 8], dt);
		REQUIRE(simulator.plan(bodies[std::size_t(stretched)], dt).substeps > calm.substeps);
		const std::vector<std::uint32_t> sizes = batch_sizes(together); // the stretched body takes another number of substeps
		REQUIRE(sizes.size() > 1);
		const StepReport sums = run_steps(together, 1); // in which it is stretched still
		std::uint64_t substeps = 0;
		for (std::size_t i = 0; i < bodies.size(); ++i) {
			WorldData alone;
			prepare(alone);
			alone.add_soft_body(bodies[i]);
			substeps += run_steps(alone, 1).substeps;
			CHECK(same_state(alone.soft_bodies()[0], together.soft_bodies()[i]));
		}
		CHECK(sums.substeps == substeps);
	}
}

TEST_CASE("what bodies feel apart from their batch reaches only them: a force, an impulse, a pin, a collider") {
	const auto run = [](bool all_together) {
		Random random(4);
		std::vector<SoftBodyData> bodies = loners(4, {}, random);
		std::vector<SoftBodyData> result;
		for (std::size_t first = 0; first < bodies.size(); first += all_together ? 4 : 1) {
			WorldData world;
			prepare(world);
			Collider ball{ { { 2, 0 } }, Real(0.3), {} };
			world.add_collider(ball);
			for (std::size_t i = first; i < first + (all_together ? 4 : 1); ++i) {
				world.add_soft_body(bodies[i]);
			}
			Simulator simulator(world);
			for (int step = 0; step < 40; ++step) {
				for (std::size_t i = 0; i < world.soft_bodies().size(); ++i) {
					SoftBodyData &body = world.soft_bodies()[i];
					const std::size_t which = first + i;
					if (which == 0 && step < 20) {
						body.add_external_force(3, { 5, 9 });
					} else if (which == 2 && step == 10) {
						body.set_pinned(1, true);
					} else if (which == 3 && step == 15) {
						body.apply_impulse(2, { 0, 1 });
					}
				}
				simulator.simulate(Real(1) / 60);
			}
			for (const SoftBodyData &body : world.soft_bodies()) {
				result.push_back(body);
			}
		}
		return result;
	};
	const auto together = run(true);
	const auto apart = run(false);
	REQUIRE(together.size() == apart.size());
	for (std::size_t i = 0; i < apart.size(); ++i) {
		CHECK(same_state(together[i], apart[i]));
	}
	Random random(4);
	CHECK_FALSE(same_state(together[0], loners(4, {}, random)[0]));
}

TEST_CASE("bodies of a batch end in the same bits as alone where some of them lie on colliders of every kind") {
	for (const Integrator integrator : { Integrator::AUTOMATIC, Integrator::EXPLICIT_EULER, Integrator::MIDPOINT,
				 Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET }) {
		for (const bool has_ground : { false, true }) {
			CAPTURE(int(integrator));
			CAPTURE(has_ground);
			BodySettings settings;
			settings.integrator = integrator;
			settings.substeps = integrator == Integrator::AUTOMATIC ? 0 : 12;
			settings.rolling_resistance = Real(0.03);
			settings.shape_stiffness = 50;
			settings.linear_damp = Real(0.2);
			Random random(21);
			// Bodies 2 apart from x = 0 on. Over a floor, over a moving plate, over nothing, over a platform that holds from one
			// side, over a ball that bounces, over a chain; and as many again over nothing or the ground.
			const std::vector<SoftBodyData> bodies = loners(12, settings, random);
			const auto prepare_colliders = [&](WorldData &world) {
				world.set_gravity({ 0, Real(-9.81) });
				if (has_ground) {
					prepare(world);
				}
				CHECK_FALSE(world.add_collider({ { { -1, -1 }, { 1, -1 }, { 1, 0 }, { -1, 0 } }, 0, {} }));
				RigidBody plate;
				plate.pose.position = { 2, Real(-0.2) };
				plate.linear_velocity = { Real(0.1), Real(0.3) };
				Collider on_plate{ { { Real(-0.8), -1 }, { Real(0.8), -1 }, { Real(0.8), 0 }, { Real(-0.8), 0 } }, 0, {} };
				on_plate.rigid_body = world.add_rigid_body(plate).value();
				CHECK_FALSE(world.add_collider(on_plate));
				Collider platform{ { { 5, -1 }, { 7, -1 } }, Real(0.02), {} };
				platform.one_way = { 0, 1 };
				CHECK_FALSE(world.add_collider(platform));
				Collider ball{ { { 8, Real(-0.3) } }, Real(0.5), {} };
				ball.surface.restitution = Real(0.5);
				CHECK_FALSE(world.add_collider(ball));
				const std::vector<Vec2> chain = { { 9, Real(0.2) }, { 10, 0 }, { 11, Real(0.3) } };
				CHECK_FALSE(add_chain(world, chain, false));
			};
			WorldData together;
			prepare_colliders(together);
			for (const SoftBodyData &body : bodies) {
				together.add_soft_body(body);
			}
			const StepReport sums = run_steps(together, 90);
			StepReport alone_sums;
			for (std::size_t i = 0; i < bodies.size(); ++i) {
				CAPTURE(i);
				WorldData alone;
				prepare_colliders(alone);
				alone.add_soft_body(bodies[i]);
				const StepReport single = run_steps(alone, 90);
				CHECK((single.contacts > 0 || i == 2 || i > 5)); // or else nothing is tested
				alone_sums.contacts += single.contacts;
				alone_sums.substeps += single.substeps;
				CHECK(same_state(alone.soft_bodies()[0], together.soft_bodies()[i]));
			}
			CHECK(sums.contacts == alone_sums.contacts);
			CHECK(sums.substeps == alone_sums.substeps);
		}
	}
}

TEST_CASE("a crushed body changes no bit of those beside it, whose forces Verlet keeps for the next substep") {
	BodySettings settings;
	settings.integrator = Integrator::VELOCITY_VERLET;
	settings.least_area = Real(0.5);
	settings.least_stretch = Real(0.3);
	settings.most_stretch = 4;
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	WorldData batches;
	WorldData singles;
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		SoftBodyData body = thesis_body(shape, settings, { { Real(3 * i), 0 }, {} });
		for (std::uint32_t point = 0; point < body.point_count(); ++point) {
			const Vec2 p = body.positions()[point];
			body.set_point(point, { p.x, i % 4 == 1 ? p.y / 10 : p.y * Real(0.9) }, { p.y, p.x / 50 });
		}
		batches.add_soft_body(body);
		const std::uint64_t nothing[] = { 12345 };
		body.set_ignored_tags(nothing); // and so it is in no batch
		singles.add_soft_body(std::move(body));
	}
	run_steps(batches, 2);
	run_steps(singles, 2);
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		CAPTURE(i);
		CHECK(same_state(batches.soft_bodies()[i], singles.soft_bodies()[i]));
	}
}

TEST_CASE("any number of threads gives the same bits" * doctest::test_suite("threads")) {
	const auto run = [](ParallelFor parallel_for) {
		Random random(8);
		WorldData world;
		prepare(world);
		for (const SoftBodyData &body : loners(150, {}, random)) {
			world.add_soft_body(body);
		}
		Simulator simulator(world, parallel_for);
		std::uint64_t contacts = 0;
		for (int i = 0; i < 30; ++i) {
			contacts += simulator.simulate(Real(1) / 60).contacts;
		}
		CHECK(contacts > 500);
		return world;
	};
	const WorldData reference = run({});
	for (const std::size_t threads : { 1, 2, 3, 8 }) {
		const WorldData world = run(on_threads(threads));
		for (std::size_t i = 0; i < world.soft_bodies().size(); ++i) {
			CHECK(same_state(world.soft_bodies()[i], reference.soft_bodies()[i]));
		}
	}
}

TEST_CASE("a batch is full, of one shape and equal settings, and pinned or inactive bodies are in none") {
	Random random(3);
	WorldData world;
	std::vector<BodyId> ids;
	for (const SoftBodyData &body : loners(11, {}, random)) {
		ids.push_back(world.add_soft_body(body));
	}
	BodySettings other = world.soft_bodies()[0].settings();
	other.friction = Real(0.9);
	for (int i = 0; i < 4; ++i) {
		world.find(ids[i])->set_settings(other);
	}
	world.find(ids[4])->set_pinned(0, true);
	world.find(ids[5])->set_active(false);
	ActiveBodies bodies(world);
	REQUIRE(bodies.update(Real(1) / 60));
	int full = 0;
	int single = 0;
	for (const Batch &batch : batches_of(bodies)) {
		(batch.count == PACK_WIDTH ? full : single)++;
		for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
			const SoftBodyData &body = world.soft_bodies()[batch.body_indices[lane]];
			CHECK(body.settings() == *batch.settings);
			CHECK(&body.shape() == batch.shape);
			CHECK(body.positions().data() == batch.states[lane]);
			CHECK(body.velocities().data() == batch.velocities(lane));
			CHECK((batch.count == 1 || !body.has_pins()));
			CHECK(body.is_active());
		}
	}
	CHECK(full == 2); // the four that were changed, and four of the five others
	CHECK(single == 2); // the fifth, and the pinned one

	const std::uint64_t version = bodies.version();
	CHECK_FALSE(bodies.update(Real(1) / 60));
	CHECK(bodies.version() == version);
	world.find(ids[4])->set_pinned(0, false);
	CHECK(bodies.update(Real(1) / 60));
	CHECK(bodies.version() == version + 1);
	CHECK(batches_of(bodies).size() == 4);
	world.remove_soft_body(ids[0]);
	CHECK(bodies.update(Real(1) / 60));
	CHECK(bodies.awake().size() == 9);
}

TEST_CASE("only awake bodies are in batches, whichever rest") {
	Random random(8);
	for (int trial = 0; trial < 200; ++trial) {
		WorldData world;
		for (const SoftBodyData &body : loners(20, {}, random)) {
			const BodyId id = world.add_soft_body(body);
			if (random.integer(0, 1) == 1) {
				BodySettings other = body.settings();
				other.friction = Real(0.9);
				world.find(id)->set_settings(other);
			}
		}
		ActiveBodies bodies(world);
		bodies.update(Real(1) / 60);
		std::vector<char> rests(20);
		for (int change = 0; change < 30; ++change) {
			const std::uint32_t i = std::uint32_t(random.integer(0, 19));
			rests[i] = char(random.integer(0, 1));
			bodies.set_resting(i, rests[i] != 0);
		}
		std::vector<std::uint32_t> seen;
		for (const Batch &batch : batches_of(bodies)) {
			for (std::uint32_t lane = 0; lane < batch.count; ++lane) {
				const std::uint32_t i = batch.active_indices[lane];
				seen.push_back(i);
				CHECK(world.soft_bodies()[batch.body_indices[lane]].settings() == *batch.settings);
				CHECK(bodies.data(i).positions().data() == batch.states[lane]);
			}
		}
		std::ranges::sort(seen);
		std::vector<std::uint32_t> awake;
		for (std::uint32_t i = 0; i < 20; ++i) {
			CHECK(bodies.is_resting(i) == (rests[i] != 0));
			if (rests[i] == 0) {
				awake.push_back(i);
			}
		}
		CHECK(seen == awake);
		CHECK(bodies.resting_count() == 20 - awake.size());
	}
}
