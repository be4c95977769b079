// SPDX-License-Identifier: MIT
// Two batches at once, where the processor can.
#include "core/dynamics/rigid_damping_lanes.h"
#include "core/dynamics/active_bodies.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/lane_stepper.h"
#include "scenes/thesis_body.h"
#include "support/random.h"
#include "support/skip.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real H = Real(1) / 600; // s

// Two batches above, at and below the ground at y = 0; `ruined` (if not too many) has a point that moves too fast to be true.
void fill(WorldData &world, std::size_t ruined, const BodySettings &settings = {}) {
	Random random(11);
	world.add_border({ { { 0, 0 }, { 0, 1 } }, {} });
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		SoftBodyData body = thesis_body(shape, settings, { { Real(3 * i), random.real(0.2, 1) }, Rotation::from_angle(Real(i)) });
		for (std::uint32_t point = 0; point < body.point_count(); ++point) {
			body.set_point(point, body.positions()[point] + random.vector(0.1), random.vector(3));
		}
		if (i == ruined) {
			body.set_point(2, body.positions()[2], { std::numeric_limits<Real>::max() / 2, 0 });
		}
		world.add_soft_body(std::move(body));
	}
}

std::vector<Vec2> state_of(WorldData &world) {
	std::vector<Vec2> all;
	for (const SoftBodyData &body : world.soft_bodies()) {
		all.insert(all.end(), body.positions().begin(), body.positions().end());
		all.insert(all.end(), body.velocities().begin(), body.velocities().end());
	}
	return all;
}

/// `touching`: whose extents it is to measure, or none.
LaneResult advance(LaneStepper &stepper, WorldData &world, Integrator integrator, std::span<SolverBody> touching = {}) {
	ActiveBodies bodies(world);
	bodies.update(H);
	Batch batch = bodies.batch_at(bodies.awake());
	REQUIRE(batch.count == WIDE_WIDTH);
	SubstepPlan plan = *batch.plan;
	plan.integrator = integrator;
	batch.plan = &plan;
	LaneSlice slice;
	slice.batch = &batch;
	slice.borders = world.borders();
	slice.gravity = { 0, Real(-9.81) };
	slice.h = H;
	slice.substeps = 3;
	slice.reach = 50;
	for (std::size_t lane = 0; lane < touching.size(); ++lane) {
		SoftBodyData &body = world.soft_bodies()[batch.body_indices[lane]];
		touching[lane].positions = body.mutable_positions();
		slice.solver_bodies[lane] = &touching[lane];
	}
	StatePrefetch prefetch;
	return stepper.advance(slice, prefetch);
}

} // namespace

TEST_CASE("two batches at once end in the bits of the scalar code, and count its contacts" * SINGLE_PRECISION_ONLY) {
	const auto stepper = make_wide_stepper();
	if (stepper == nullptr) {
		SKIP_TEST("no registers of that width here");
	}
	BodySettings everything;
	everything.shape_stiffness = 120;
	everything.shape_damping = Real(0.5);
	everything.pressure_stiffness = 200;
	everything.rolling_resistance = Real(0.03);
	everything.linear_damp = Real(0.8);
	everything.angular_damp = 3;
	for (const BodySettings &settings : { BodySettings{}, everything }) {
		for (const Integrator integrator : { Integrator::EXPLICIT_EULER, Integrator::SEMI_IMPLICIT_EULER, Integrator::MIDPOINT,
					 Integrator::HEUN, Integrator::RUNGE_KUTTA_4, Integrator::VELOCITY_VERLET }) {
			CAPTURE(int(integrator));
			WorldData world;
			fill(world, SIZE_MAX, settings);
			WorldData twin;
			fill(twin, SIZE_MAX, settings);
			const LaneResult result = advance(*stepper, world, integrator);
			REQUIRE(result.ruined == 0);
			ColliderIndex surroundings;
			surroundings.update(twin, 3 * H);
			EnvironmentContactSolver handling;
			IntegratorWorkspace workspace;
			std::uint64_t scalar_contacts = 0;
			for (SoftBodyData &body : twin.soft_bodies()) {
				workspace.begin_body(body.point_count());
				handling.begin_body(surroundings, body, 0, 3 * H);
				const std::vector<Vec2> external(body.point_count());
				for (int i = 0; i < 3; ++i) {
					const std::vector<Vec2> before(body.positions().begin(), body.positions().end());
					integrator_traits(integrator).step(body, { { 0, Real(-9.81) }, external, H }, workspace);
					if (settings.has_damp()) {
						damp_rigid_motion<Real>(lanes_of(body), H);
					}
					const std::size_t answered = handling.handle(body, before, { 0, Real(-9.81) }, H);
					workspace.forces_are_current = workspace.forces_are_current && answered == 0;
					scalar_contacts += answered;
				}
			}
			CHECK(state_of(world) == state_of(twin));
			CHECK(scalar_contacts > 0);
			CHECK(result.contacts == scalar_contacts);
		}
	}
}

TEST_CASE("two batches at once have the extents that each body would measure" * SINGLE_PRECISION_ONLY) {
	const auto stepper = make_wide_stepper();
	if (stepper == nullptr) {
		SKIP_TEST("no registers of that width here");
	}
	WorldData world;
	fill(world, SIZE_MAX);
	std::array<std::vector<Vec2>, WIDE_WIDTH> before;
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		const auto hull = world.soft_bodies()[i].hull();
		before[i].assign(hull.begin(), hull.end());
	}
	std::array<SolverBody, WIDE_WIDTH> touching;
	REQUIRE(advance(*stepper, world, Integrator::SEMI_IMPLICIT_EULER, touching).ruined == 0);
	for (SolverBody &body : touching) {
		const std::size_t place = std::size_t(std::ranges::find_if(world.soft_bodies(), [&](const SoftBodyData &data) {
			return data.positions().data() == body.positions.data();
		}) - world.soft_bodies().begin());
		SolverBody alone;
		alone.positions = body.positions;
		alone.before = before[place];
		alone.measure_extent();
		CHECK(alone.way > 0);
		CHECK(body.box.min == alone.box.min);
		CHECK(body.box.max == alone.box.max);
		CHECK(body.center == alone.center);
		CHECK(body.radius == alone.radius);
		CHECK(body.way == alone.way);
	}
}

TEST_CASE("a ruined body of two batches is named and left as it was, whichever it is, and the others move" * SINGLE_PRECISION_ONLY) {
	const auto stepper = make_wide_stepper();
	if (stepper == nullptr) {
		SKIP_TEST("no registers of that width here");
	}
	WorldData sane;
	fill(sane, SIZE_MAX);
	REQUIRE(advance(*stepper, sane, Integrator::SEMI_IMPLICIT_EULER).ruined == 0);
	for (std::size_t ruined = 0; ruined < WIDE_WIDTH; ++ruined) {
		WorldData world;
		fill(world, ruined);
		const SoftBodyData before = world.soft_bodies()[ruined];
		CHECK(advance(*stepper, world, Integrator::SEMI_IMPLICIT_EULER).ruined == 1u << ruined);
		for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
			const SoftBodyData &expected = i == ruined ? before : sane.soft_bodies()[i];
			CHECK(std::ranges::equal(world.soft_bodies()[i].positions(), expected.positions()));
			CHECK(std::ranges::equal(world.soft_bodies()[i].velocities(), expected.velocities()));
		}
	}
}

TEST_CASE("a body of two batches that is ruined is reset, and the other seven move as if it were not there") {
	constexpr std::size_t RUINED = 5;
	WorldData world;
	fill(world, RUINED);
	WorldData sane;
	fill(sane, SIZE_MAX);
	const StepReport report = Simulator(world).simulate(Real(1) / 60);
	CHECK(Simulator(sane).simulate(Real(1) / 60).reset_bodies.empty());
	REQUIRE(report.reset_bodies.size() == 1);
	CHECK(report.reset_bodies[0] == world.id_at(RUINED));
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		const bool same = std::ranges::equal(world.soft_bodies()[i].positions(), sane.soft_bodies()[i].positions());
		CHECK(same == (i != RUINED));
	}
}

TEST_CASE("a body whose points define no rotation turns by its own memory, side by side as alone") {
	BodySettings settings;
	settings.shape_stiffness = 120;
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	const auto collapsed = [&](std::size_t i) {
		SoftBodyData body = thesis_body(shape, settings, { { Real(3 * i), 0 }, {} });
		for (std::uint32_t point = 0; point < body.point_count(); ++point) {
			body.set_point(point, { Real(3 * i), 0 }, {});
		}
		body.set_rotation_memory(Rotation::from_angle(Real(0.7) * Real(i)));
		return body;
	};
	WorldData together;
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		together.add_soft_body(collapsed(i));
	}
	Simulator(together).simulate(H);
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		CAPTURE(i);
		WorldData alone;
		alone.add_soft_body(collapsed(i));
		Simulator(alone).simulate(H);
		const SoftBodyData &one = alone.soft_bodies()[0];
		const SoftBodyData &other = together.soft_bodies()[i];
		CHECK(std::ranges::equal(one.positions(), other.positions()));
		CHECK(std::ranges::equal(one.velocities(), other.velocities()));
		// Each point is pulled to its place in a shape turned by that angle.
		const Vec2 pulled = other.velocities()[0];
		const Vec2 place = Rotation::from_angle(Real(0.7) * Real(i)).apply(shape->rest_positions()[0]);
		CHECK(length(pulled) > 0);
		CHECK(dot(pulled, place) >= Real(0.999) * length(pulled) * length(place));
	}
}

TEST_CASE("monitored bodies side by side on a border tell of the contacts that each has alone") {
	BodySettings settings;
	settings.contact_monitor = true;
	const auto shape = thesis_shape_with_ratio(300, Real(0.05));
	const auto on_ground = [&](std::size_t i) {
		// Turned by different angles, so that other points touch, some of them deeper.
		return thesis_body(shape, settings, { { Real(3 * i), Real(0.45) + Real(0.005) * Real(i) }, Rotation::from_angle(Real(i)) });
	};
	const auto add_ground = [](WorldData &world) { world.add_border({ { { 0, 0 }, { 0, 1 } }, {} }); };
	WorldData together;
	add_ground(together);
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		together.add_soft_body(on_ground(i));
	}
	Simulator all(together);
	all.simulate(H);
	for (std::size_t i = 0; i < WIDE_WIDTH; ++i) {
		CAPTURE(i);
		WorldData alone;
		add_ground(alone);
		alone.add_soft_body(on_ground(i));
		Simulator single(alone);
		single.simulate(H);
		std::vector<Contact> told;
		std::ranges::copy_if(all.contacts(), std::back_inserter(told),
				[&](const Contact &contact) { return contact.body == together.id_at(i); });
		REQUIRE(told.size() == single.contacts().size());
		CHECK(told.size() >= 1);
		for (std::size_t k = 0; k < told.size(); ++k) {
			CHECK(told[k].hull_point == single.contacts()[k].hull_point);
			CHECK(told[k].point == single.contacts()[k].point);
			CHECK(told[k].depth == single.contacts()[k].depth);
			CHECK(told[k].normal_impulse == single.contacts()[k].normal_impulse);
		}
	}
}
