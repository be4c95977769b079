// SPDX-License-Identifier: MIT
// Each value by itself: whatever a world remembers is in its state, and the hash of its motion has what moves and nothing else.
#include "core/dynamics/simulator.h"
#include "core/dynamics/world_state.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

using Bytes = std::vector<std::uint8_t>;
using Change = std::function<void(BodyState &)>;

Bytes save(const Simulator &simulator, std::uint64_t token = 0) {
	return WorldState().save(simulator, { token, {}, {}, {} }).value();
}

void restore(Simulator &simulator, const Bytes &bytes, std::uint64_t token = 0) {
	WorldState state;
	REQUIRE_FALSE(state.read(simulator, { token, {}, {}, {} }, bytes));
	state.put_back(simulator);
}

void put(SoftBodyData &body, BodyState state) {
	body.put_back(state);
}

/// What `save_state` leaves out, too.
BodyState state_of(const SoftBodyData &body) {
	BodyState state = body.save_state();
	state.rest.restored = body.memory().rest.restored;
	return state;
}

WorldData two_bodies() {
	WorldData world = pixel_world();
	world.add_soft_body(jelly_circle({ 0, 0 }));
	world.add_soft_body(jelly_circle({ 200, 0 }));
	return world;
}

/// No value is that of a new body, and no two numbers are equal.
BodyState strange_state(const SoftBodyData &body, BodyId other, std::uint64_t seed) {
	Random random(seed);
	BodyState state = body.save_state();
	const auto scatter = [&](std::vector<Vec2> &list, std::size_t count, double size) {
		list.clear();
		for (std::size_t i = 0; i < count; ++i) {
			list.push_back(random.vector(size));
		}
	};
	const std::size_t count = body.point_count();
	scatter(state.positions, count, 500);
	scatter(state.velocities, count, 300);
	scatter(state.previous_positions, count, 500);
	scatter(state.last_valid_hull, body.shape().hull_count(), 500);
	state.rest_positions.clear();
	const Real squeeze = random.real(0.8, 0.95);
	for (const Vec2 point : body.shape().rest_positions()) {
		state.rest_positions.push_back({ point.x * squeeze, point.y / squeeze });
	}
	const std::uint32_t pin = std::uint32_t(random.integer(1, 4));
	state.pinned_points = { pin, pin + 3 };
	state.pin_targets = { { pin, random.vector(90) }, { pin + 3, random.vector(90) } };
	state.external_forces = { { 2, random.vector(70) }, { 5, random.vector(70) } };
	state.load.force = random.vector(60);
	state.load.torque = random.real(1, 60);
	state.acceleration = random.vector(50);
	state.fluids = random.bits();
	const Real c = random.real(0.6, 0.8);
	state.rotation_memory = { c, std::sqrt(1 - c * c) };
	state.touch = {};
	state.touch.touching = true;
	state.touch.approach = random.real(1, 20);
	state.touch.restitution = random.real(0.1, 0.9);
	state.touch.normal = random.vector(1);
	state.touch.surface_velocity = random.vector(10);
	state.touch.account = double(random.real(1, 9));
	state.pair_touches = { { other, { true, random.real(1, 9), false, random.real(1, 9) } } };
	state.one_ways = { { random.bits(), true } };
	state.rest.rest_time = random.real(0.1, 0.4);
	state.rest.drowsy_center = random.vector(400);
	state.rest.drowsy_velocity = random.vector(4);
	state.rest.asleep = true;
	state.rest.island = random.bits();
	state.rest.surroundings = random.bits();
	state.rest.restored = std::uint32_t(random.integer(1, 9));
	state.damage_pause = random.real(0.1, 0.9);
	state.placed = false;
	state.active = false;
	state.frozen = true;
	return state;
}

struct NamedChange {
	const char *name;
	Change change;
	bool moves = false; ///< whether it is part of what `hash_of_motion` tells apart
};

const std::vector<NamedChange> &changes() {
	static const std::vector<NamedChange> list = {
		{ "positions", [](BodyState &state) { state.positions[3].y += 1; }, true },
		{ "velocities", [](BodyState &state) { state.velocities[3].x += 1; }, true },
		{ "rest_positions", [](BodyState &state) { state.rest_positions[3].x += Real(0.5); }, true },
		{ "no dents", [](BodyState &state) { state.rest_positions.clear(); }, true },
		{ "rotation_memory.c", [](BodyState &state) { state.rotation_memory.c += Real(0.01); }, true },
		{ "rotation_memory.s", [](BodyState &state) { state.rotation_memory.s += Real(0.01); }, true },
		{ "previous_positions", [](BodyState &state) { state.previous_positions[3].y += 1; } },
		{ "last_valid_hull", [](BodyState &state) { state.last_valid_hull[3].y += 1; } },
		{ "no last_valid_hull", [](BodyState &state) { state.last_valid_hull.clear(); } },
		{ "pinned_points", [](BodyState &state) { state.pinned_points.push_back(state.pinned_points[1] + 2); } },
		{ "pin_targets.point", [](BodyState &state) { state.pin_targets[0].point = state.pinned_points[1]; } },
		{ "pin_targets.position", [](BodyState &state) { state.pin_targets[0].position.x += 1; } },
		{ "no pin_targets", [](BodyState &state) { state.pin_targets.clear(); } },
		{ "external_forces.point", [](BodyState &state) { state.external_forces[0].point = 9; } },
		{ "external_forces.force", [](BodyState &state) { state.external_forces[0].force.y += 1; } },
		{ "no external_forces", [](BodyState &state) { state.external_forces.clear(); } },
		{ "load.force", [](BodyState &state) { state.load.force.x += 1; } },
		{ "load.torque", [](BodyState &state) { state.load.torque += 1; } },
		{ "acceleration", [](BodyState &state) { state.acceleration.x += 1; } },
		{ "fluids", [](BodyState &state) { state.fluids += 1; } },
		{ "touch.touching", [](BodyState &state) { state.touch.touching = false; }, true },
		{ "touch.approach", [](BodyState &state) { state.touch.approach += 1; } },
		{ "touch.restitution", [](BodyState &state) { state.touch.restitution += Real(0.01); } },
		{ "touch.normal", [](BodyState &state) { state.touch.normal.x += 1; } },
		{ "touch.surface_velocity", [](BodyState &state) { state.touch.surface_velocity.y += 1; } },
		{ "touch.account", [](BodyState &state) { state.touch.account += 1; }, true },
		{ "pair_touches.other", [](BodyState &state) { state.pair_touches[0].other.index += 1; } },
		{ "pair_touches.other.generation", [](BodyState &state) { state.pair_touches[0].other.generation += 1; } },
		{ "pair_touches.touching", [](BodyState &state) { state.pair_touches[0].touch.touching = false; } },
		{ "pair_touches.approach", [](BodyState &state) { state.pair_touches[0].touch.approach += 1; } },
		{ "pair_touches.missing", [](BodyState &state) { state.pair_touches[0].touch.missing += 1; } },
		{ "no pair_touches", [](BodyState &state) { state.pair_touches.clear(); } },
		{ "one_ways.collider", [](BodyState &state) { state.one_ways[0].collider += 1; } },
		{ "one_ways.held", [](BodyState &state) { state.one_ways[0].held = false; } },
		{ "no one_ways", [](BodyState &state) { state.one_ways.clear(); } },
		{ "rest.rest_time", [](BodyState &state) { state.rest.rest_time += Real(0.01); }, true },
		{ "rest.drowsy_center", [](BodyState &state) { state.rest.drowsy_center.x += 1; } },
		{ "rest.drowsy_velocity", [](BodyState &state) { state.rest.drowsy_velocity.y += 1; } },
		{ "rest.asleep", [](BodyState &state) { state.rest.asleep = false; }, true },
		{ "rest.island", [](BodyState &state) { state.rest.island += 1; } },
		{ "rest.surroundings", [](BodyState &state) { state.rest.surroundings += 1; } },
		{ "rest.restored", [](BodyState &state) { state.rest.restored += 1; } },
		{ "damage_pause", [](BodyState &state) { state.damage_pause += Real(0.01); }, true },
		{ "placed", [](BodyState &state) { state.placed = true; } },
		{ "active", [](BodyState &state) { state.active = true; }, true },
		{ "frozen", [](BodyState &state) { state.frozen = false; }, true },
	};
	return list;
}

/// As of objects that a monitored body has touched and touches.
std::vector<Touch> strange_touches(const WorldData &world) {
	Touch soft{ world.id_at(0), {}, Real(0.25) };
	soft.other.body = world.id_at(1);
	Touch solid{ world.id_at(1), {}, Real(0.125) };
	solid.other.kind = ContactOther::Kind::COLLIDER;
	solid.other.body = world.id_at(0);
	solid.other.tag = 9001;
	Touch border = solid;
	border.other.kind = ContactOther::Kind::BORDER;
	border.other.tag = 77;
	return { soft, solid, border };
}

bool are_alike(std::span<const Touch> a, std::span<const Touch> b) {
	return std::ranges::equal(a, b, [](const Touch &x, const Touch &y) {
		return x.body == y.body && x.other.kind == y.other.kind && x.other.body == y.other.body && x.other.tag == y.other.tag && x.apart == y.apart;
	});
}

bool are_alike(const WorldData::Memory &a, const WorldData::Memory &b) {
	const auto boxes_alike = [](const Aabb &x, const Aabb &y) { return x.min == y.min && x.max == y.max; };
	return a.bodies == b.bodies && a.exceptions == b.exceptions && a.joint_order == b.joint_order && a.joints == b.joints &&
			a.put_to_sleep == b.put_to_sleep && a.woken_islands == b.woken_islands &&
			std::ranges::equal(a.disturbed_boxes, b.disturbed_boxes, boxes_alike);
}

} // namespace

TEST_CASE("every value that a body remembers is in the state of its world, whatever else has changed, and in its own bytes") {
	for (std::uint64_t seed = 1; seed <= 40; ++seed) {
		CAPTURE(seed);
		WorldData world = two_bodies();
		Simulator simulator(world);
		SoftBodyData &body = world.soft_bodies()[0];
		const BodyState strange = strange_state(body, world.id_at(1), seed);
		put(body, strange);
		REQUIRE(state_of(body) == strange);
		BodyState unrestored = strange;
		unrestored.rest.restored = 0;
		BodyState read = body_state_from_bytes(to_bytes(strange)).value();
		read.rest.restored = 0;
		CHECK(read == unrestored);
		const Bytes bytes = save(simulator);
		restore(simulator, bytes);
		CHECK(state_of(body) == strange);
		for (const NamedChange &each : changes()) {
			CAPTURE(each.name);
			BodyState other = strange;
			each.change(other);
			put(body, other);
			REQUIRE_FALSE(state_of(body) == strange);
			CHECK(save(simulator) != bytes);
			restore(simulator, bytes);
			CHECK(state_of(body) == strange);
			CHECK(save(simulator) == bytes);
		}
		// All at once: a body as new, and then another body's memory in the scratch memory of one reader.
		WorldState reader;
		put(world.soft_bodies()[1], strange_state(world.soft_bodies()[1], world.id_at(0), seed + 1000));
		const BodyState second = state_of(world.soft_bodies()[1]);
		const Bytes both = save(simulator);
		put(body, jelly_circle({ 0, 0 }).save_state());
		put(world.soft_bodies()[1], jelly_circle({ 200, 0 }).save_state());
		const Bytes fresh = save(simulator);
		for (const Bytes &target : { both, fresh, both }) {
			REQUIRE_FALSE(reader.read(simulator, {}, target));
			reader.put_back(simulator);
			CHECK(save(simulator) == target);
		}
		CHECK(state_of(body) == strange);
		CHECK(state_of(world.soft_bodies()[1]) == second);
	}
}

TEST_CASE("what lasts for one step only does not come back with a state") {
	for (const bool has_pair_touch : { false, true }) {
		CAPTURE(has_pair_touch);
		WorldData world = two_bodies();
		Simulator simulator(world);
		SoftBodyData &body = world.soft_bodies()[0];
		BodyState plain = state_of(body);
		if (has_pair_touch) {
			plain.pair_touches = { { world.id_at(1), { true, 4, false, 3 } } };
			put(body, plain);
		}
		WorldState reader;
		const Bytes bytes = reader.save(simulator, {}).value();
		for (int round = 0; round < 2; ++round) { // the second one finds what the first has left in the reader's memory
			BodyState other = plain;
			other.positions[0].x += 1;
			other.touch.ended = true;
			other.touch.missing = 3;
			other.touch.work = 5;
			other.rest.restored = 4;
			other.pair_touches = { { world.id_at(1), { true, 2, true, 1 } } };
			put(body, other);
			REQUIRE_FALSE(reader.read(simulator, {}, bytes));
			reader.put_back(simulator);
			CHECK(state_of(body) == plain);
		}
	}
}

TEST_CASE("every value that a world remembers beside its bodies is in its state") {
	WorldData world = two_bodies();
	for (int i = 0; i < 3; ++i) {
		world.add_soft_body(jelly_circle({ Real(400 + 200 * i), 0 }));
	}
	world.remove_soft_body(world.id_at(3)); // a place is free, and an id is of the second generation
	world.add_soft_body(jelly_circle({ 900, 0 }));
	world.remove_soft_body(world.id_at(2));
	Simulator simulator(world);
	std::vector<Joint> joints(4);
	joints[0] = { JointAnchor::on_edge(world.id_at(0), 2, Real(0.375)), JointAnchor::on_rigid_body(71, { 3, 4 }), 30, 250, Real(1.5), 700, true };
	joints[1] = { JointAnchor::on_point(world.id_at(1), 3), JointAnchor::on_edge(world.id_at(2), 4, Real(0.25)), 20, 150, Real(0.5), 900, true };
	joints[2] = { JointAnchor::at_place({ 10, 20 }), JointAnchor::on_point(world.id_at(0), 1), 10, 50, Real(0.25), 300, false };
	joints[3] = { JointAnchor::on_point(world.id_at(1), 6), JointAnchor::at_place({ 50, 60 }), 5, 25, Real(0.125), 100, true };
	for (const Joint &joint : joints) {
		REQUIRE(world.add_joint(joint));
	}
	world.remove_joint(world.joint_id_at(1));
	REQUIRE_FALSE(world.add_collision_exception(world.id_at(0), world.id_at(2)));
	WorldData::Memory memory = world.memory();
	memory.put_to_sleep = 4711;
	memory.woken_islands = { { 12345678901, 3 }, { 5, 1 } };
	memory.disturbed_boxes = { { { -1, -2 }, { 3, 4 } }, { { 5, 6 }, { 7, 8 } } };
	world.put_back(memory);
	REQUIRE(are_alike(world.memory(), memory));
	const std::vector<Touch> touches = strange_touches(world);
	simulator.put_back_touches(touches);
	REQUIRE(are_alike(simulator.touches(), touches));
	const Bytes bytes = save(simulator);

	const std::vector<std::function<void(WorldData::Memory &)>> meddle = {
		[](WorldData::Memory &other) { other.put_to_sleep = 1; },
		[](WorldData::Memory &other) { other.woken_islands[0].island++; },
		[](WorldData::Memory &other) { other.woken_islands[1].restored++; },
		[](WorldData::Memory &other) { other.woken_islands.clear(); },
		[](WorldData::Memory &other) { other.disturbed_boxes[0].min.x -= 1; },
		[](WorldData::Memory &other) { other.disturbed_boxes[1].max.y += 1; },
		[](WorldData::Memory &other) { other.disturbed_boxes.clear(); },
		[](WorldData::Memory &other) { other.exceptions.clear(); },
		[](WorldData::Memory &other) { std::ranges::reverse(other.joints); },
		[](WorldData::Memory &other) { other.joints[0].rest_length += 1; },
		[](WorldData::Memory &other) { other.joints[0].stiffness += 1; },
		[](WorldData::Memory &other) { other.joints[0].damping += 1; },
		[](WorldData::Memory &other) { other.joints[0].break_force += 1; },
		[](WorldData::Memory &other) { other.joints[0].collide_joined = false; },
		[](WorldData::Memory &other) { other.joints[0].first.point = 7; },
		[](WorldData::Memory &other) { other.joints[0].first.fraction = Real(0.5); },
		[](WorldData::Memory &other) { other.joints[0].second.tag = 8; },
		[](WorldData::Memory &other) { other.joints[0].second.position.y += 1; },
		[](WorldData::Memory &other) { other.joints[0].second.kind = JointAnchor::Kind::WORLD; },
		[](WorldData::Memory &other) { other.joints[0].first.body = other.bodies.ids[1]; },
		[](WorldData::Memory &other) {
			other.joints.clear();
			other.joint_order.ids.clear();
			other.joint_order.free = { 0, 1, 2, 3 };
			std::ranges::for_each(other.joint_order.generations, [](std::uint32_t &generation) { generation += 5; });
		},
	};
	for (std::size_t i = 0; i < meddle.size(); ++i) {
		CAPTURE(i);
		WorldData::Memory other = memory;
		meddle[i](other);
		world.put_back(other);
		CHECK_FALSE(are_alike(world.memory(), memory));
		CHECK(save(simulator) != bytes);
		restore(simulator, bytes);
		CHECK(are_alike(world.memory(), memory));
		CHECK(save(simulator) == bytes);
	}
	for (const auto &change : { std::function([](Touch &touch) { touch.apart += 1; }), std::function([](Touch &touch) { touch.other.tag += 1; }),
				 std::function([](Touch &touch) { touch.other.kind = ContactOther::Kind::BORDER; }),
				 std::function([](Touch &touch) { touch.body.index += 1; }), std::function([](Touch &touch) { touch.other.body.index += 1; }) }) {
		std::vector<Touch> others = touches;
		change(others[1]);
		simulator.put_back_touches(others);
		CHECK(save(simulator) != bytes);
		restore(simulator, bytes);
		CHECK(are_alike(simulator.touches(), touches));
	}
	// What comes next gets the ids that it would have got, also after others have come and gone.
	const BodyId coming = world.add_soft_body(jelly_circle({ 1200, 0 }));
	const JointId joint = world.add_joint(joints[1]).value();
	world.remove_joint(joint);
	world.remove_soft_body(coming);
	restore(simulator, bytes);
	CHECK(world.add_soft_body(jelly_circle({ 1200, 0 })) == coming);
}

TEST_CASE("a state of another world says nothing of its objects: tags are forgotten, and nothing else") {
	WorldData world = two_bodies();
	Simulator simulator(world);
	const BodyState strange = strange_state(world.soft_bodies()[0], world.id_at(1), 3);
	put(world.soft_bodies()[0], strange);
	const std::vector<Touch> touches = strange_touches(world);
	simulator.put_back_touches(touches);
	const Bytes bytes = save(simulator, 5);
	for (const bool is_foreign : { false, true }) {
		CAPTURE(is_foreign);
		BodyState other = strange;
		other.velocities[0].x += 1;
		put(world.soft_bodies()[0], other);
		simulator.put_back_touches({});
		restore(simulator, bytes, is_foreign ? 6 : 5);
		BodyState expected = strange;
		if (is_foreign) {
			expected.one_ways.clear();
			expected.rest.surroundings = 0;
		}
		CHECK(state_of(world.soft_bodies()[0]) == expected);
		CHECK(are_alike(simulator.touches(), std::span(touches).first(is_foreign ? 1 : 3)));
	}
}

TEST_CASE("the hash of motion has every value that moves, and none that names an object of the machine") {
	WorldData world = two_bodies();
	SoftBodyData &body = world.soft_bodies()[0];
	const BodyState strange = strange_state(body, world.id_at(1), 8);
	put(body, strange);
	const std::uint64_t hash = hash_of_motion(world);
	for (const NamedChange &each : changes()) {
		CAPTURE(each.name);
		BodyState other = strange;
		each.change(other);
		put(body, other);
		CHECK((hash_of_motion(world) != hash) == each.moves);
	}
	put(body, strange);
	CHECK(hash_of_motion(world) == hash);
	Joint joint;
	joint.first = JointAnchor::on_point(world.id_at(0), 3);
	joint.second = JointAnchor::on_point(world.id_at(1), 5);
	joint.rest_length = 60;
	const JointId id = world.add_joint(joint).value();
	put(body, strange); // the joint has woken it
	const std::uint64_t joined = hash_of_motion(world);
	CHECK(joined != hash);
	joint.rest_length = 61;
	REQUIRE_FALSE(world.set_joint(id, joint));
	put(body, strange);
	CHECK(hash_of_motion(world) != joined);
}
