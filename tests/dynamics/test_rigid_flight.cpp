// SPDX-License-Identifier: MIT
// Bodies that touch nothing and hardly wobble fly as rigid ones: nothing is gained, nothing jumps, and whatever comes near ends it.
#include "core/dynamics/rigid_flight.h"
#include "core/creator/soft_body_creator.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/simulator.h"
#include "core/dynamics/world_state.h"
#include "core/geometry/polygon.h"
#include "core/model/body_frame.h"
#include "core/model/material.h"
#include "core/model/rigid_motion.h"
#include "scenes/fine_outlines.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"
#include "support/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr double JUMP = 0.25; // px at a radius of about 50 px, which nobody sees

struct Kind {
	std::shared_ptr<const SoftBodyShape> shape;
	BodySettings settings;
};

// A body of elastic material, as a node is by default.
Kind elastic_kind(std::span<const Vec2> hull, ElasticModel model = ElasticModel::MODES) {
	StructureOptions options;
	options.stiffness = 1;
	options.damping = 1;
	options.elastic = model != ElasticModel::TRIANGLES;
	options.elastic_triangles = model == ElasticModel::TRIANGLES;
	Kind kind;
	kind.shape = SoftBodyCreator::create_polygon(hull, options).value();
	REQUIRE_FALSE(apply_material(Material(), model, *kind.shape, kind.settings));
	set_default_limits(kind.settings);
	return kind;
}

std::vector<Vec2> blob_of(int count, Random &random) {
	std::vector<Vec2> blob = random_blob(count, random);
	const Vec2 middle = area_centroid(blob);
	for (Vec2 &p : blob) {
		p = p - middle;
	}
	return blob;
}

Kind random_kind(Random &random) {
	const std::vector<Vec2> blob = blob_of(random.integer(8, 40), random);
	return elastic_kind(blob, random.chance(0.2) ? ElasticModel::TRIANGLES : ElasticModel::MODES);
}

SoftBodyData at(const Kind &kind, Vec2 place, Real angle = 0) {
	return SoftBodyData::create(kind.shape, kind.settings, Pose{ place, Rotation::from_angle(angle) }).value();
}

void throw_body(SoftBodyData &body, Vec2 velocity, Real spin) {
	REQUIRE_FALSE(set_linear_velocity(body, velocity));
	REQUIRE_FALSE(set_angular_velocity(body, spin));
}

// Bends and shakes the points by shares of the radius.
void disturb(SoftBodyData &body, double strain, double rate, Random &random) {
	const double radius = double(body.shape().radius());
	for (std::uint32_t i = 0; i < body.point_count(); ++i) {
		REQUIRE_FALSE(body.set_point(i, body.positions()[i] + random.vector(strain * radius / 2), body.velocities()[i] + random.vector(rate * radius / 2)));
	}
}

double angular_momentum(const SoftBodyData &body) {
	const BodyFrame frame = measure_frame(body);
	return double(frame.angular_velocity) * double(frame.inertia);
}

double area(const SoftBodyData &body) {
	return double(signed_area(body.hull()));
}

std::size_t step(WorldData &world, int count = 1) {
	Simulator simulator(world);
	std::size_t flying = 0;
	for (int i = 0; i < count; ++i) {
		flying = simulator.simulate(FRAME).flying_bodies;
	}
	return flying;
}

std::vector<Vec2> state_of(const WorldData &world) {
	std::vector<Vec2> all;
	for (const SoftBodyData &body : world.soft_bodies()) {
		all.insert(all.end(), body.positions().begin(), body.positions().end());
		all.insert(all.end(), body.velocities().begin(), body.velocities().end());
	}
	return all;
}

// A crowd of like and unlike bodies in the air, some calm and some not.
void fill_with_flyers(WorldData &world, std::uint64_t seed) {
	Random random(seed);
	for (int row = 0; row < 3; ++row) {
		const Kind kind = random_kind(random);
		const int count = random.integer(1, 19);
		for (int i = 0; i < count; ++i) {
			SoftBodyData body = at(kind, { Real(300 * i), Real(-2000 + 400 * row) }, random.real(-3, 3));
			throw_body(body, random.vector(40), random.real(-1, 1));
			if (random.chance(0.5)) {
				disturb(body, random.real(0, 0.012), random.real(0, 0.3), random);
			}
			world.add_soft_body(std::move(body));
		}
	}
}

} // namespace

TEST_CASE("momentum and angular momentum are kept by rigid flight, energy and area are never added" * doctest::test_suite("slow")) {
	int flown = 0;
	for (std::uint64_t seed = 0; seed < 400; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		const Kind kind = random_kind(random);
		WorldData world = pixel_world();
		world.set_rigid_flight(true);
		const bool is_weightless = random.chance(0.3);
		REQUIRE_FALSE(world.set_gravity({ 0, is_weightless ? Real(0) : PIXEL_GRAVITY }));
		const int count = random.integer(1, 9);
		for (int i = 0; i < count; ++i) {
			SoftBodyData body = at(kind, { Real(400 * i), 0 }, random.real(-3, 3));
			throw_body(body, random.vector(500), random.real(-2, 2));
			disturb(body, random.real(0, 0.006), random.real(0, 0.2), random);
			world.add_soft_body(std::move(body));
		}
		Simulator simulator(world);
		for (int tick = 0; tick < 20; ++tick) {
			std::vector<SoftBodyData> before(world.soft_bodies().begin(), world.soft_bodies().end());
			simulator.simulate(FRAME);
			for (std::size_t i = 0; i < before.size(); ++i) {
				if (!simulator.has_flown(world.id_at(i))) {
					continue;
				}
				++flown;
				const SoftBodyData &body = world.soft_bodies()[i];
				const double mass = double(body.shape().total_mass());
				const double speed = 1000; // px/s, of which digits are left
				const BodyFrame was = measure_frame(before[i]);
				const BodyFrame is = measure_frame(body);
				const Vec2 velocity = was.velocity + world.gravity() * FRAME;
				CHECK(distance(is.velocity, velocity) <= 40 * EPSILON * speed);
				const double radius = double(body.shape().radius());
				CHECK(std::abs(angular_momentum(body) - angular_momentum(before[i])) <= 40 * EPSILON * mass * radius * speed);
				const double fallen = double(is.center.y - was.center.y); // differences of large heights lose digits
				const double gained = measure_energy(body, {}).total() - measure_energy(before[i], {}).total() - mass * double(world.gravity().y) * fallen;
				CHECK(gained <= 40 * EPSILON * mass * speed * speed);
				CHECK(std::abs(area(body) / area(before[i]) - 1) <= 100 * EPSILON);
			}
		}
	}
	CHECK(flown > 10000);
}

TEST_CASE("a body in rigid flight is where a soft one would be, within a quarter of a pixel" * doctest::test_suite("slow")) {
	int entered = 0;
	for (std::uint64_t seed = 0; seed < 300; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		Kind kind = random_kind(random);
		kind.settings.linear_damp = random.chance(0.5) ? Real(0.1) : Real(0);
		kind.settings.angular_damp = random.chance(0.5) ? Real(1) : Real(0);
		WorldData flying = pixel_world();
		if (random.chance(0.5)) {
			flying.add_border(floor_at(100000)); // with an environment the automatic choice is another method
		}
		SoftBodyData body = at(kind, {}, random.real(-3, 3));
		throw_body(body, random.vector(600), random.real(-2, 2));
		disturb(body, random.real(0, 0.02), random.real(0, 0.5), random);
		const BodyId id = flying.add_soft_body(std::move(body));
		WorldData soft = flying;
		flying.set_rigid_flight(true);
		Simulator fly(flying);
		Simulator wobble(soft);
		for (int tick = 0; tick < 60; ++tick) {
			const bool flew = fly.has_flown(id);
			fly.simulate(FRAME);
			wobble.simulate(FRAME);
			const SoftBodyData &a = *flying.find(id);
			const SoftBodyData &b = *soft.find(id);
			entered += int(!flew && fly.has_flown(id));
			// Where it is, and its outline: the strain that it keeps, and that which the other then has.
			CHECK(distance(measure_frame(a).center, measure_frame(b).center) <= JUMP / 5);
			CHECK(largest_distance(a.positions(), b.positions()) <= 2 * JUMP * double(kind.shape->radius()) / 50);
		}
	}
	CHECK(entered > 250);
}

TEST_CASE("a body that begins to fly does not jump") {
	for (std::uint64_t seed = 0; seed < 200; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		const Kind kind = random_kind(random);
		WorldData world = pixel_world();
		SoftBodyData body = at(kind, {}, random.real(-3, 3));
		throw_body(body, random.vector(600), random.real(-2, 2));
		disturb(body, 0.05, 0.5, random);
		const BodyId id = world.add_soft_body(std::move(body));
		for (int tick = 0; tick < 240; ++tick) {
			WorldData soft = world;
			world.set_rigid_flight(true);
			Simulator fly(world);
			fly.simulate(FRAME);
			step(soft);
			// The first tick of every flight against the same tick without.
			CHECK(largest_distance(world.find(id)->positions(), soft.find(id)->positions()) <= JUMP * double(kind.shape->radius()) / 50);
			if (fly.has_flown(id)) {
				break;
			}
		}
	}
}

TEST_CASE("no body flies in a step in which it touches anything" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 0; seed < 200; ++seed) {
		CAPTURE(seed);
		Random random(seed);
		const Kind kind = random_kind(random);
		WorldData world = pixel_world();
		world.set_rigid_flight(true);
		const int what = int(seed % 4);
		if (what == 0) {
			world.add_border(floor_at(0));
		} else if (what == 1) {
			REQUIRE_FALSE(world.add_collider(box_collider({ 0, 200 }, { 400, 200 })));
		} else if (what == 2) {
			SoftBodyData lower = at(elastic_kind(circle_hull(60, 16).value()), { 0, 0 });
			lower.set_frozen(true);
			world.add_soft_body(std::move(lower));
		} else {
			RigidBody rigid;
			rigid.inverse_mass = Real(0.1);
			rigid.inverse_inertia = Real(1e-5);
			Collider box = box_collider({}, { 100, 40 });
			box.rigid_body = world.add_rigid_body(rigid).value();
			REQUIRE_FALSE(world.add_collider(box));
		}
		SoftBodyData body = at(kind, { random.real(-30, 30), Real(-500) }, random.real(-3, 3));
		throw_body(body, { 0, random.real(0, 2000) }, random.real(-2, 2));
		const BodyId id = world.add_soft_body(std::move(body));
		Simulator simulator(world);
		bool has_flown = false;
		bool has_touched = false;
		for (int tick = 0; tick < 60; ++tick) {
			const StepReport report = simulator.simulate(FRAME);
			const bool touches = report.contacts + report.pair_contacts > 0;
			has_flown |= simulator.has_flown(id);
			has_touched |= touches;
			CHECK_FALSE((touches && simulator.has_flown(id)));
		}
		CHECK(has_flown);
		CHECK(has_touched);
	}
}

TEST_CASE("whatever acts on a flying body alone ends its flight in the next step") {
	Random random(5);
	const Kind kind = elastic_kind(blob_of(16, random));
	const auto flies_after = [&](auto &&change) {
		WorldData world = pixel_world();
		world.set_rigid_flight(true);
		const BodyId id = world.add_soft_body(at(kind, {}));
		Simulator simulator(world);
		simulator.simulate(FRAME);
		REQUIRE(simulator.has_flown(id));
		change(world, id);
		simulator.simulate(FRAME);
		return simulator.has_flown(id);
	};
	CHECK(flies_after([](WorldData &, BodyId) {}));
	CHECK(flies_after([](WorldData &world, BodyId) { REQUIRE_FALSE(world.set_gravity({ 300, 0 })); }));
	CHECK(flies_after([](WorldData &world, BodyId id) { throw_body(*world.find(id), { 400, 0 }, 1); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { REQUIRE_FALSE(world.find(id)->apply_impulse(0, { 5, 0 })); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { REQUIRE_FALSE(world.find(id)->add_external_force(0, { 5, 0 })); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { REQUIRE_FALSE(add_torque(*world.find(id), 100)); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { REQUIRE_FALSE(world.find(id)->set_acceleration({ 5, 0 })); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { REQUIRE_FALSE(world.find(id)->set_pinned(0, true)); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) {
		REQUIRE_FALSE(world.find(id)->set_point(0, world.find(id)->positions()[0] + Vec2{ 3, 0 }, {}));
	}));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) { throw_body(*world.find(id), {}, 30); })); // its spin would stretch it
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) {
		Joint joint;
		joint.first = JointAnchor::on_point(id, 0);
		joint.second = JointAnchor::at_place({ 0, -200 });
		joint.rest_length = 200;
		REQUIRE(world.add_joint(joint));
	}));
	CHECK_FALSE(flies_after([&](WorldData &world, BodyId) { world.add_soft_body(at(kind, { 105, 0 })); }));
	CHECK_FALSE(flies_after([&](WorldData &world, BodyId) { REQUIRE_FALSE(world.add_collider(box_collider({ 0, 90 }, { 300, 30 }))); }));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) {
		BodySettings settings = world.find(id)->settings();
		settings.can_fly_rigid = false;
		REQUIRE_FALSE(world.find(id)->set_settings(settings));
	}));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) {
		BodySettings settings = world.find(id)->settings();
		settings.inflation = Real(1.2);
		REQUIRE_FALSE(world.find(id)->set_settings(settings));
	}));
	CHECK_FALSE(flies_after([](WorldData &world, BodyId id) {
		BodySettings settings = world.find(id)->settings();
		settings.yield_strain = Real(0.2);
		REQUIRE_FALSE(world.find(id)->set_settings(settings));
	}));
}

TEST_CASE("a body whose springs are tense by design takes its own shape in the air") {
	Random random(9);
	const std::vector<Vec2> blob = blob_of(16, random);
	StructureOptions options;
	options.elastic = true;
	options.stiffness = 200;
	options.spring_length_scales.assign(SoftBodyCreator::create_polygon(blob, options).value()->springs().size(), Real(0.8));
	Kind kind;
	kind.shape = SoftBodyCreator::create_polygon(blob, options).value();
	REQUIRE_FALSE(apply_material(Material(), ElasticModel::MODES, *kind.shape, kind.settings));
	kind.settings.spring_stiffness_scale = 1;
	WorldData world = pixel_world();
	world.set_rigid_flight(true);
	const BodyId id = world.add_soft_body(at(kind, {}));
	const double before = area(*world.find(id));
	step(world, 60);
	CHECK(area(*world.find(id)) < 0.98 * before);
}

TEST_CASE("without rigid flight no body flies, and the bits are those of a world that knows none") {
	WorldData world = pixel_world();
	fill_with_flyers(world, 3);
	WorldData other = world;
	CHECK(step(world, 30) == 0);
	other.set_rigid_flight(true);
	other.set_rigid_flight(false);
	step(other, 30);
	CHECK(identical(state_of(world), state_of(other)));
}

TEST_CASE("rigid flight gives the same bits alone, in batches, and on any number of threads" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 0; seed < 40; ++seed) {
		CAPTURE(seed);
		WorldData world = pixel_world();
		world.set_rigid_flight(true);
		world.add_border(floor_at(2000));
		fill_with_flyers(world, seed);
		WorldData threaded = world;
		WorldData narrow = world;
		CHECK(step(world, 40) > 0);
		HelpedTeam team(3);
		Simulator simulator(threaded, team.parallel_for());
		for (int i = 0; i < 40; ++i) {
			simulator.simulate(FRAME);
		}
		CHECK(identical(state_of(world), state_of(threaded)));
		allow_wide_steppers(false);
		step(narrow, 40);
		allow_wide_steppers(true);
		CHECK(identical(state_of(world), state_of(narrow)));
		// One body alone.
		WorldData lonely = pixel_world();
		lonely.set_rigid_flight(true);
		lonely.add_border(floor_at(2000));
		WorldData crowd = lonely;
		fill_with_flyers(crowd, seed);
		lonely.add_soft_body(crowd.soft_bodies()[0]);
		step(lonely, 40);
		CHECK(identical(lonely.soft_bodies()[0].positions(), world.soft_bodies()[0].positions()));
	}
}

TEST_CASE("a world whose state is put back in mid-flight goes on in the same bits" * doctest::test_suite("slow")) {
	for (std::uint64_t seed = 0; seed < 20; ++seed) {
		CAPTURE(seed);
		WorldData world = pixel_world();
		world.set_rigid_flight(true);
		world.add_border(floor_at(200));
		fill_with_flyers(world, seed);
		Simulator simulator(world);
		for (int i = 0; i < 25; ++i) {
			simulator.simulate(FRAME);
		}
		const auto saved = WorldState().save(simulator, {}, {}).value();
		for (int i = 0; i < 90; ++i) {
			simulator.simulate(FRAME);
		}
		const std::vector<Vec2> first = state_of(world);
		WorldState state;
		REQUIRE_FALSE(state.read(simulator, {}, saved, {}));
		state.put_back(simulator);
		for (int i = 0; i < 90; ++i) {
			simulator.simulate(FRAME);
		}
		CHECK(identical(first, state_of(world)));
	}
}

TEST_CASE("a weightless body in rigid flight comes to rest and falls asleep as others do") {
	const Kind kind = elastic_kind(circle_hull(50, 16).value());
	WorldData world = pixel_world();
	world.set_rigid_flight(true);
	REQUIRE_FALSE(world.set_gravity({}));
	const BodyId id = world.add_soft_body(at(kind, {}));
	step(world, 90);
	CHECK(world.find(id)->is_asleep());
	const BodyId other = world.add_soft_body(at(kind, { 500, 0 }));
	throw_body(*world.find(other), { 30, 0 }, 0);
	step(world, 90);
	CHECK_FALSE(world.find(other)->is_asleep());
	CHECK(double(measure_frame(*world.find(other)).center.x) == doctest::Approx(500 + 45).epsilon(1e-4));
}

TEST_CASE("a body in rigid flight is an island of its own in reports, as any body in the air") {
	const Kind kind = elastic_kind(circle_hull(50, 16).value());
	WorldData world = pixel_world();
	world.set_rigid_flight(true);
	for (int i = 0; i < 3; ++i) {
		world.add_soft_body(at(kind, { Real(400 * i), 0 }));
	}
	Simulator simulator(world);
	simulator.set_reporting_islands(true);
	const StepReport report = simulator.simulate(FRAME);
	CHECK(report.flying_bodies == 3);
	CHECK(report.islands.size() == 3);
}
