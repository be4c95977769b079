// SPDX-License-Identifier: MIT
// The state of a world: put back, everything goes on in the same bits; what does not belong to it is refused and changes nothing.
#include "core/dynamics/world_state.h"
#include "core/dynamics/simulator.h"
#include "scenes/jelly.h"
#include "scenes/mixed.h"
#include "scenes/netplay.h"
#include "support/compare.h"
#include "support/random.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <string>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TICK = Real(1) / 60;
constexpr std::size_t AT_CHECKSUM = 12;
constexpr std::size_t HEAD = 20;

using Bytes = std::vector<std::uint8_t>;

Bytes save(const Simulator &simulator, std::span<const std::uint8_t> base = {}) {
	return WorldState().save(simulator, {}, base).value();
}

Status restore(Simulator &simulator, std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> base = {}) {
	WorldState state;
	if (Status status = state.read(simulator, {}, bytes, base)) {
		return status;
	}
	state.put_back(simulator);
	return {};
}

/// The checksum of the format, written down once more.
void seal(Bytes &bytes) {
	std::uint64_t sums[4] = { 1, 2, 3, 4 };
	const auto add = [&](std::size_t lane, std::uint64_t word) {
		const std::uint64_t product = (sums[lane] ^ word) * 0x9e3779b97f4a7c15u;
		sums[lane] = product << 29 | product >> 35;
	};
	std::size_t at = HEAD;
	for (; at + 32 <= bytes.size(); at += 32) {
		for (std::size_t lane = 0; lane < 4; ++lane) {
			std::uint64_t word = 0;
			for (std::size_t i = 8; i-- > 0;) {
				word = word << 8 | bytes[at + 8 * lane + i];
			}
			add(lane, word);
		}
	}
	for (; at < bytes.size(); ++at) {
		add((at - HEAD) % 4, bytes[at]);
	}
	std::uint64_t sum = 0xcbf29ce484222325u;
	const auto take = [&](std::uint64_t value) { sum = (sum ^ value) * 0x100000001b3u; };
	for (const std::uint64_t each : sums) {
		std::uint64_t key = each ^ each >> 31;
		key *= 0x9e3779b97f4a7c15u;
		take(key ^ key >> 29);
	}
	take(bytes.size() - HEAD);
	sum = (sum ^ sum >> 32) | 1;
	for (std::size_t i = 0; i < 8; ++i) {
		bytes[AT_CHECKSUM + i] = std::uint8_t(sum >> (8 * i));
	}
}

/// The mixed world with joints, some of which break, bodies that dent, and a pair that passes through each other.
WorldData lively_world() {
	WorldData world = mixed_world(0, true);
	for (std::size_t i = 0; i + 1 < 8; i += 2) {
		Joint joint;
		joint.first = JointAnchor::on_point(world.id_at(i), 1);
		joint.second = i % 4 == 0 ? JointAnchor::on_point(world.id_at(i + 1), 4) : JointAnchor::at_place({ Real(0.9) * Real(i % 4), 4 });
		joint.stiffness = i % 4 == 0 ? INFINITE : Real(300);
		joint.break_force = i == 0 ? Real(8) : i == 4 ? Real(12) : INFINITE;
		REQUIRE(world.add_joint(joint));
	}
	for (std::size_t i = 20; i < 24; ++i) {
		BodySettings settings = world.soft_bodies()[i].settings();
		settings.yield_strain = Real(0.02);
		settings.flow_rate = 20;
		REQUIRE_FALSE(world.soft_bodies()[i].set_settings(settings));
	}
	REQUIRE_FALSE(world.add_collision_exception(world.id_at(12), world.id_at(13)));
	return world;
}

struct Course {
	std::vector<std::uint64_t> hashes; ///< of each tick
	Bytes end;
	std::size_t joints = 0;
	friend bool operator==(const Course &, const Course &) = default;
};

Course run(Simulator &simulator, int count) {
	Course course;
	for (int i = 0; i < count; ++i) {
		simulator.simulate(TICK);
		course.hashes.push_back(hash_of_state(simulator.world()));
		course.hashes.push_back(hash_of_contacts(simulator));
	}
	course.end = save(simulator);
	course.joints = simulator.world().joints().size();
	return course;
}

void put_rigid_bodies(WorldData &world, const std::vector<RigidBody> &bodies) {
	for (std::uint32_t i = 0; i < bodies.size(); ++i) {
		REQUIRE_FALSE(world.set_rigid_body(i, bodies[i]));
	}
}

std::vector<RigidBody> rigid_bodies(const WorldData &world) {
	return { world.rigid_bodies().begin(), world.rigid_bodies().end() };
}

/// Two jellies, one of which lies on a floor.
WorldData small_world() {
	WorldData world = pixel_world();
	world.add_border(floor_at(100));
	for (const Real x : { 0, 30 }) {
		BodySettings settings = jelly_settings();
		settings.contact_monitor = true;
		settings.restitution = Real(0.5);
		world.add_soft_body(jelly_circle({ x, 49 - 5 * x }, settings));
	}
	Joint joint;
	joint.first = JointAnchor::on_point(world.id_at(0), 3);
	joint.second = JointAnchor::on_point(world.id_at(1), 5);
	joint.rest_length = 60;
	REQUIRE(world.add_joint(joint));
	return world;
}

} // namespace

TEST_CASE("a world that is put back goes on in the same bits, with its broken joints, dents and touches, here or in one built alike") {
	WorldData world = lively_world();
	Simulator simulator(world);
	int tick = 0;
	bool has_broken = false;
	bool has_dented = false;
	for (const int start : { 0, 12, 40, 160 }) {
		CAPTURE(start);
		run(simulator, start - tick);
		const Bytes state = save(simulator);
		const std::vector<RigidBody> rigid = rigid_bodies(world);
		const std::size_t joints = world.joints().size();
		const Course first = run(simulator, 60);
		has_broken |= first.joints < joints;
		has_dented |= std::ranges::any_of(world.soft_bodies(), [](const SoftBodyData &body) { return body.is_dented(); });
		REQUIRE_FALSE(restore(simulator, state));
		put_rigid_bodies(world, rigid);
		CHECK(world.joints().size() == joints);
		CHECK(save(simulator) == state);
		CHECK(run(simulator, 60) == first);
		WorldData other = lively_world();
		Simulator fresh(other);
		REQUIRE_FALSE(restore(fresh, state));
		put_rigid_bodies(other, rigid);
		CHECK(save(fresh) == state);
		CHECK(run(fresh, 60) == first);
		REQUIRE_FALSE(restore(simulator, state)); // once more, and go on from it
		put_rigid_bodies(world, rigid);
		tick = start;
	}
	CHECK(has_broken); // or else it says less than it promises
	CHECK(has_dented);
}

TEST_CASE("what users have done since the last step is part of the state of a world") {
	const auto meddle = [](WorldData &world) {
		world.soft_bodies()[3].add_external_force(1, { 30, 40 });
		world.soft_bodies()[30].wake();
		world.soft_bodies()[5].put_to_sleep();
		world.soft_bodies()[6].set_frozen(true);
		world.soft_bodies()[7].set_active(false);
		world.soft_bodies()[8].set_pinned(2, true);
		world.soft_bodies()[8].set_pin_target(2, { 1, 3 });
	};
	WorldData world = lively_world();
	Simulator simulator(world);
	run(simulator, 200);
	meddle(world);
	const Bytes state = save(simulator);
	const std::vector<RigidBody> rigid = rigid_bodies(world);
	const Course first = run(simulator, 50);
	world.soft_bodies()[6].set_frozen(false);
	world.soft_bodies()[7].set_active(true);
	world.soft_bodies()[9].set_pinned(2, true);
	world.soft_bodies()[10].put_to_sleep();
	REQUIRE_FALSE(restore(simulator, state));
	put_rigid_bodies(world, rigid);
	CHECK(save(simulator) == state);
	CHECK(run(simulator, 50) == first);
}

TEST_CASE("whoever sleeps in a state sleeps on when it is put back, and wakes as it would have") {
	WorldData world = pixel_world();
	world.add_border(floor_at(200));
	world.add_border({ { { -145, 0 }, { 1, 0 } }, {} }); // walls that press three bodies together
	world.add_border({ { { 145, 0 }, { -1, 0 } }, {} });
	for (int i = 0; i < 3; ++i) {
		world.add_soft_body(jelly_circle({ Real(97 * (i - 1)), 150 }));
	}
	Simulator simulator(world);
	int tick = 0;
	while (simulator.simulate(TICK).sleeping_bodies < 3) {
		REQUIRE(++tick < 1500);
	}
	const Bytes asleep = save(simulator);
	world.soft_bodies()[1].wake(); // the next step wakes the others, too
	const Bytes woken = save(simulator);
	CHECK(simulator.simulate(TICK).sleeping_bodies == 0);
	const Course first = run(simulator, 20);
	REQUIRE_FALSE(restore(simulator, asleep));
	CHECK(simulator.simulate(TICK).sleeping_bodies == 3);
	REQUIRE_FALSE(restore(simulator, woken));
	CHECK(simulator.simulate(TICK).sleeping_bodies == 0);
	CHECK(run(simulator, 20) == first);
	// One that is as it was, while another one of its island is not.
	REQUIRE_FALSE(restore(simulator, asleep));
	CHECK(simulator.simulate(TICK).sleeping_bodies == 3);
	world.soft_bodies()[2].add_external_force(0, { 0, 1 });
	world.soft_bodies()[2].put_to_sleep();
	const Bytes pushed = save(simulator);
	REQUIRE_FALSE(restore(simulator, asleep));
	CHECK(simulator.simulate(TICK).sleeping_bodies == 3);
	REQUIRE_FALSE(restore(simulator, pushed));
	CHECK(save(simulator) == pushed);
	// One that is put back by itself wakes those that slept with it.
	REQUIRE_FALSE(restore(simulator, asleep));
	REQUIRE_FALSE(world.soft_bodies()[1].restore_state(world.soft_bodies()[1].save_state()));
	const Bytes alone = save(simulator);
	const Course second = run(simulator, 20);
	REQUIRE_FALSE(restore(simulator, alone));
	CHECK(run(simulator, 20) == second);
}

TEST_CASE("a hull from beside a collider says nothing of colliders that come later, also when it is put back") {
	const auto run_to_end = [](bool restores) {
		WorldData world = pixel_world();
		world.set_gravity({ 0, 0 });
		world.add_collider(box_collider({ 0, 300 }, { 50, 50 }));
		world.add_soft_body(jelly_circle({ 0, 0 }));
		world.add_soft_body(jelly_circle({ 90, 0 })); // pushes the first: its hull is kept
		Simulator simulator(world);
		run(simulator, 3);
		CHECK_FALSE(world.soft_bodies()[0].memory().last_valid_hull.empty());
		world.clear_environment();
		const Bytes state = save(simulator);
		run(simulator, 30);
		if (restores) {
			REQUIRE_FALSE(restore(simulator, state));
			run(simulator, 30);
		}
		const bool is_forgotten = world.soft_bodies()[0].memory().last_valid_hull.empty();
		world.add_collider(box_collider({ -60, 0 }, { 20, 50 }));
		run(simulator, 30);
		return std::pair(hash_of_state(world), is_forgotten);
	};
	CHECK(run_to_end(true) == run_to_end(false));
}

TEST_CASE("bodies that came since are removed before, and then come as they came the first time") {
	WorldData world = small_world();
	Simulator simulator(world);
	run(simulator, 5);
	const auto add_two = [&] {
		const BodyId a = world.add_soft_body(jelly_circle({ 200, 0 }));
		return std::pair(a, world.add_soft_body(jelly_circle({ 260, -20 })));
	};
	const Bytes state = save(simulator);
	const auto first_ids = add_two();
	const Course first = run(simulator, 40);
	const Bytes later = save(simulator);
	Status status = restore(simulator, state);
	REQUIRE(status);
	CHECK(status->name == "state.bodies");
	CHECK(status->remedy.find("remove first") == 0);
	CHECK(save(simulator) == later);
	world.remove_soft_body(first_ids.first);
	world.remove_soft_body(first_ids.second);
	REQUIRE_FALSE(restore(simulator, state));
	CHECK(save(simulator) == state);
	CHECK(add_two() == first_ids);
	CHECK(run(simulator, 40) == first);
	CHECK_FALSE(restore(simulator, later));
	world.remove_soft_body(world.id_at(0));
	status = restore(simulator, later);
	REQUIRE(status);
	CHECK(status->remedy.find("disable bodies") == 0);
	world.add_soft_body(jelly_circle({ 0, 49 }));
	status = restore(simulator, later); // as many, but not the same
	REQUIRE(status);
	CHECK(status->name == "state.bodies[0]");
}

TEST_CASE("a state on top of another holds what has changed, and needs that one") {
	WorldData world = pixel_world();
	world.add_border(floor_at(100));
	for (int i = 0; i < 20; ++i) {
		world.add_soft_body(jelly_circle({ Real(200 * i), 50 }));
	}
	Simulator simulator(world);
	for (SoftBodyData &body : world.soft_bodies()) {
		body.put_to_sleep();
	}
	run(simulator, 2);
	const Bytes base = save(simulator);
	world.soft_bodies()[7].apply_impulse(3, { 200, -300 });
	run(simulator, 1);
	const Bytes whole = save(simulator);
	const Bytes part = save(simulator, base);
	CHECK(part.size() < whole.size() / 8);
	const Course first = run(simulator, 30);
	REQUIRE_FALSE(restore(simulator, part, base));
	CHECK(save(simulator) == whole);
	CHECK(run(simulator, 30) == first);
	const Bytes before = save(simulator);
	CHECK(restore(simulator, part)->name == "base");
	CHECK(restore(simulator, part, whole)->name == "base");
	CHECK(restore(simulator, part, part)->name == "base");
	CHECK(restore(simulator, part, Bytes(3, 1))->name == "base.magic");
	CHECK(WorldState().save(simulator, {}, part).error().name == "base");
	CHECK(save(simulator) == before);
}

TEST_CASE("a state of another version, precision, world or length is refused by name and changes nothing") {
	WorldData world = small_world();
	Simulator simulator(world);
	run(simulator, 10);
	const Bytes state = save(simulator);
	run(simulator, 10);
	const Bytes before = save(simulator);
	const auto changed = [&](std::size_t at, std::uint8_t value) {
		Bytes bytes = state;
		bytes[at] = value;
		return bytes;
	};
	const std::vector<std::pair<const char *, Bytes>> faults = {
		{ "state.magic", {} },
		{ "state.magic", changed(0, 'X') },
		{ "state.version", changed(4, 9) },
		{ "state.precision", changed(8, std::uint8_t(12 - sizeof(Real))) },
		{ "state.checksum", changed(AT_CHECKSUM, std::uint8_t(state[AT_CHECKSUM] + 1)) },
		{ "state.checksum", Bytes(state.begin(), state.end() - 1) },
		{ "state.checksum", Bytes(state.begin(), state.begin() + 15) },
		{ "state.checksum", changed(state.size() - 3, std::uint8_t(state[state.size() - 3] + 1)) },
	};
	for (const auto &[name, bytes] : faults) {
		CAPTURE(name);
		const Status status = restore(simulator, bytes);
		REQUIRE(status);
		CHECK(status->name == name);
		CHECK_FALSE(status->remedy.empty());
	}
	for (std::size_t at = HEAD; at < state.size(); at += 7) {
		REQUIRE(restore(simulator, changed(at, std::uint8_t(state[at] ^ 0x10))));
	}
	WorldData other = pixel_world();
	other.add_soft_body(jelly_circle({}));
	other.add_soft_body(SoftBodyData::create(circle_shape(40, 16, { 1, 100, Real(0.1), true }).value(), {}).value());
	Simulator stranger(other);
	Status status = restore(stranger, state);
	REQUIRE(status);
	CHECK(status->name == "state.bodies[1].structure");
	const WorldState::Companion named{ 0, {}, {}, [](std::size_t i) { return "body " + std::to_string(i); } };
	CHECK(WorldState().read(stranger, named, state)->name == "state.body 1.structure");
	const Bytes sound = save(stranger);
	world.soft_bodies()[1].mutable_velocities()[2].x = NOT_A_NUMBER;
	const Bytes broken = save(simulator);
	REQUIRE_FALSE(restore(simulator, before)); // also out of a state with NaN
	status = restore(simulator, broken);
	REQUIRE(status);
	CHECK(status->name == "state.bodies[1].velocities[2]");
	CHECK(save(simulator) == before);
	CHECK(save(stranger) == sound);
}

TEST_CASE("forged bytes are refused and change nothing, or make a world that can be stepped") {
	WorldData world = small_world();
	Simulator simulator(world);
	run(simulator, 10);
	const Bytes state = save(simulator);
	Random random(11);
	int accepted = 0;
	for (int round = 0; round < 3000; ++round) {
		Bytes forged = state;
		for (int i = 0; i < 1 + round % 3; ++i) {
			const std::size_t place = HEAD + std::size_t(random.integer(0, round % 2 ? 700 : int(forged.size() - HEAD - 1)));
			forged[place] = std::uint8_t(random.integer(0, 255));
		}
		if (round % 10 == 0) {
			forged.resize(HEAD + std::size_t(random.integer(0, int(2 * forged.size()))));
		}
		seal(forged);
		const Bytes before = save(simulator);
		if (const Status status = restore(simulator, forged)) {
			CHECK(status->name != "state.checksum");
			REQUIRE(save(simulator) == before);
		} else {
			accepted++;
			simulator.simulate(TICK);
			REQUIRE_FALSE(restore(simulator, state));
		}
	}
	CHECK(accepted > 100);
	CHECK(accepted < 2900);
}

TEST_CASE("what a caller keeps beside its bodies comes back with them, and its token tells worlds apart") {
	WorldData world = small_world();
	Simulator simulator(world);
	std::vector<std::uint32_t> numbers = { 5, 6 };
	WorldState::Companion companion;
	companion.world_token = 77;
	companion.write_body = [&](std::size_t i, StateWriter &to) { to.visit(numbers[i]); };
	companion.write_world = [&](StateWriter &to) { to.visit(std::uint8_t(9)); };
	WorldState state;
	const Bytes bytes = state.save(simulator, companion).value();
	REQUIRE_FALSE(state.read(simulator, companion, bytes));
	CHECK(state.changed().empty());
	CHECK(state.companion().size() == 1);
	CHECK_FALSE(state.is_foreign());
	numbers[1] = 8;
	REQUIRE_FALSE(state.read(simulator, companion, bytes));
	REQUIRE(state.changed().size() == 1);
	CHECK(state.changed()[0].body == 1);
	CHECK(StateReader(state.changed()[0].companion).read<std::uint32_t>() == 6);
	companion.world_token = 78;
	REQUIRE_FALSE(state.read(simulator, companion, bytes));
	CHECK(state.is_foreign());
}

TEST_CASE("in another world with other tags sleepers sleep on, and the motion has one hash") {
	const auto make = [](std::uint64_t tag) {
		WorldData world = pixel_world();
		Border floor = floor_at(100);
		floor.surface.tag = tag;
		world.add_border(floor);
		world.add_soft_body(jelly_circle({ 0, 40 }));
		return world;
	};
	WorldData here = make(1);
	WorldData there = make(2);
	Simulator simulator(here);
	Simulator other(there);
	int tick = 0;
	while (simulator.simulate(TICK).sleeping_bodies == 0) {
		other.simulate(TICK);
		CHECK(hash_of_motion(here) == hash_of_motion(there));
		REQUIRE(++tick < 1500);
	}
	CHECK(hash_of_motion(here) != hash_of_motion(there));
	WorldState state;
	const Bytes bytes = state.save(simulator, { 1, {}, {}, {} }).value();
	REQUIRE_FALSE(state.read(other, { 2, {}, {}, {} }, bytes));
	state.put_back(other);
	CHECK(hash_of_motion(here) == hash_of_motion(there));
	CHECK(other.simulate(TICK).sleeping_bodies == 1);
	CHECK(simulator.simulate(TICK).sleeping_bodies == 1);
	CHECK(hash_of_motion(here) == hash_of_motion(there));
}

TEST_CASE("two peers who predict, roll back up to eight ticks and step again agree with the truth in every tick") {
	const auto make_world = [] {
		WorldData world = small_world();
		world.add_border({ { { -200, 0 }, { 1, 0 } }, {} });
		world.add_border({ { { 200, 0 }, { -1, 0 } }, {} });
		for (int i = 0; i < 6; ++i) {
			BodySettings settings = jelly_settings();
			settings.yield_strain = i % 2 ? Real(0.02) : Real(0);
			settings.flow_rate = 20;
			world.add_soft_body(jelly_circle({ Real(50 * (i % 3) - 50), Real(-120 - 100 * (i / 3)) }, settings));
		}
		return world;
	};
	int rollbacks = 0;
	int deepest = 0;
	for (std::uint64_t seed = 1; seed <= 12; ++seed) {
		CAPTURE(seed);
		const NetplayResult result = play_over_network(make_world, 400, { seed, 100, 0.1 * double(seed % 5), 1 + int(seed) });
		CHECK(result.ticks == 100);
		CHECK(result.mismatches == 0);
		rollbacks += result.rollbacks;
		deepest = std::max(deepest, result.deepest);
	}
	CHECK(rollbacks > 50); // or else it says less than it promises
	CHECK(deepest == ROLLBACK_WINDOW);
}
