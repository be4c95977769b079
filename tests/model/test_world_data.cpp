// SPDX-License-Identifier: MIT
// Claims about bodies under stable ids and about the world's own values.
#include "core/model/world_data.h"
#include "scenes/jelly.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("ids find their body through any order of adding and removing, and nothing once it is gone") {
	// Each body carries a number in its friction; the oracle is a map from numbers to ids.
	WorldData world;
	Random random(61);
	const auto shape = thesis_shape();
	std::map<int, BodyId> alive;
	std::vector<BodyId> gone;
	int next = 0;
	int wrong = 0;
	for (int round = 0; round < 3000; ++round) {
		if (alive.empty() || random.chance(0.51)) {
			BodySettings settings;
			settings.friction = Real(next);
			const BodyId id = world.add_soft_body(thesis_body(shape, settings));
			for (const auto &[number, other] : alive) {
				wrong += id == other;
			}
			alive[next++] = id;
		} else {
			auto victim = alive.begin();
			std::advance(victim, random.integer(0, int(alive.size()) - 1));
			wrong += !world.remove_soft_body(victim->second);
			gone.push_back(victim->second);
			alive.erase(victim);
		}
		wrong += world.soft_bodies().size() != alive.size();
		for (const auto &[number, id] : alive) {
			const SoftBodyData *body = world.find(id);
			wrong += !body || body->settings().friction != Real(number);
		}
		for (std::size_t i = 0; i < world.soft_bodies().size(); ++i) {
			wrong += world.find(world.id_at(i)) != &world.soft_bodies()[i];
		}
		for (int k = 0; k < 5 && !gone.empty(); ++k) {
			const BodyId id = gone[std::size_t(random.integer(0, int(gone.size()) - 1))];
			wrong += world.find(id) != nullptr || world.remove_soft_body(id);
		}
	}
	CHECK(wrong == 0);
	CHECK(gone.size() > 1000);
}

TEST_CASE("a body is replaced at its id and place, where joints end and exceptions stay") {
	WorldData world;
	const auto shape = thesis_shape();
	const BodyId first = world.add_soft_body(thesis_body(shape, {}));
	const BodyId second = world.add_soft_body(thesis_body(shape, {}));
	REQUIRE_FALSE(world.add_collision_exception(first, second));
	Joint joint;
	joint.first = JointAnchor::on_point(first, 0);
	joint.second = JointAnchor::on_point(second, 1);
	REQUIRE(world.add_joint(joint));
	world.find(first)->put_to_sleep();
	SoftBodyData other = thesis_body(shape, {});
	REQUIRE_FALSE(other.set_point(0, other.positions()[0] + Vec2{ Real(0.01), 0 }, {}));
	other.put_to_sleep();
	const Vec2 place = other.positions()[0];
	CHECK(world.replace_soft_body(first, other));
	CHECK(world.id_at(0) == first);
	CHECK(world.find(first)->positions()[0] == place);
	CHECK_FALSE(world.find(first)->is_asleep());
	CHECK(world.joints().empty());
	CHECK(world.has_collision_exception(first, second));
	CHECK(world.remove_soft_body(first));
	CHECK_FALSE(world.replace_soft_body(first, other));
	CHECK(world.soft_bodies().size() == 1);
}

TEST_CASE("an id that never was finds nothing") {
	WorldData world;
	CHECK(world.find({}) == nullptr);
	CHECK(world.find({ 0, 0 }) == nullptr);
	CHECK_FALSE(world.remove_soft_body({}));
	const BodyId id = world.add_soft_body(thesis_body(thesis_shape()));
	CHECK(world.find(id) != nullptr);
	CHECK(world.find({ id.index, id.generation + 1 }) == nullptr);
	CHECK(world.find({ id.index + 1, id.generation }) == nullptr);
	const WorldData &constant = world;
	CHECK(constant.find(id) == &constant.soft_bodies()[0]);
}

TEST_CASE("gravity and the length unit refuse what is not a number and stay as they were") {
	WorldData world;
	CHECK(world.gravity() == Vec2{});
	CHECK(world.length_unit() == 1);
	CHECK_FALSE(world.set_gravity({ 1, Real(-9.81) }));
	CHECK_FALSE(world.set_length_unit(100));
	for (const Real bad : { NOT_A_NUMBER, INFINITE, -INFINITE }) {
		const Status gravity = world.set_gravity({ 0, bad });
		REQUIRE(gravity.has_value());
		CHECK(gravity->name == "gravity");
		CHECK(world.set_gravity({ bad, 0 }));
		CHECK(world.set_length_unit(bad));
	}
	for (const Real bad : { Real(0), Real(-1) }) {
		const Status unit = world.set_length_unit(bad);
		REQUIRE(unit.has_value());
		CHECK(unit->name == "length_unit");
	}
	CHECK(world.gravity() == Vec2{ 1, Real(-9.81) });
	CHECK(world.length_unit() == 100);
}

TEST_CASE("surroundings are taken when valid, refused when not, and forgotten together") {
	WorldData world;
	CHECK_FALSE(world.add_border(floor_at(10)));
	CHECK_FALSE(world.add_collider(box_collider({ 0, 0 }, { 1, 1 })));
	CHECK(world.add_border({ { { 0, 0 }, { 0, 2 } }, {} }));
	CHECK(world.add_collider({}));
	CHECK(world.borders().size() == 1);
	CHECK(world.colliders().size() == 1);
	const BodyId id = world.add_soft_body(thesis_body(thesis_shape()));
	world.clear_environment();
	CHECK(world.borders().empty());
	CHECK(world.colliders().empty());
	CHECK(world.find(id) != nullptr);
}

TEST_CASE("a collider may belong to a rigid body that is there, and to no other") {
	WorldData world;
	Collider collider = box_collider({}, { 1, 1 });
	collider.rigid_body = 0;
	const Status status = world.add_collider(collider);
	REQUIRE(status.has_value());
	CHECK(status->name == "collider.rigid_body");
	CHECK(world.colliders().empty());
	RigidBody body;
	body.linear_velocity = { 3, 0 };
	CHECK(world.add_rigid_body(body).value() == 0);
	CHECK_FALSE(world.add_collider(collider));
	CHECK(world.reactions().size() == 1);
	body.inverse_mass = -1;
	CHECK_FALSE(world.add_rigid_body(body).has_value());
	CHECK(world.set_rigid_body(0, body));
	CHECK(world.rigid_bodies()[0].inverse_mass == 0);
	body.inverse_mass = 2;
	CHECK_FALSE(world.set_rigid_body(0, body));
	CHECK(world.rigid_bodies()[0].inverse_mass == 2);
	CHECK(world.set_rigid_body(1, body));
	world.clear_environment();
	CHECK(world.rigid_bodies().empty());
	CHECK(world.reactions().empty());
	CHECK(world.add_collider(collider));
}

TEST_CASE("no two states of the surroundings share a version") {
	WorldData a;
	WorldData b;
	std::vector<std::uint64_t> seen;
	for (WorldData *world : { &a, &b }) {
		world->add_border(floor_at(1));
		seen.push_back(world->environment_version());
		world->add_collider(box_collider({}, { 1, 1 }));
		seen.push_back(world->environment_version());
		world->clear_environment();
		seen.push_back(world->environment_version());
	}
	std::ranges::sort(seen);
	CHECK(std::ranges::adjacent_find(seen) == seen.end());
}
