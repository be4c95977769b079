// SPDX-License-Identifier: MIT
// Claims about which colliders are near a place: still ones, moving ones, and those that can be pushed.
#include "core/collision/collider_index.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("a collider stays within its bounds during the whole step, however its body moves") {
	Random random(321);
	for (int round = 0; round < 300; ++round) {
		WorldData world;
		RigidBody body;
		body.pose = { random.vector(10), Rotation::from_angle(random.real(-3, 3)) };
		body.center_of_mass = random.vector(3);
		body.linear_velocity = random.vector(100);
		body.angular_velocity = random.real(-300, 300); // up to 5 rad a step
		body.inverse_mass = random.chance(0.5) ? Real(1) : Real(0);
		Collider collider = box_collider(random.vector(3), { random.real(0.1, 5), random.real(0.1, 5) });
		collider.radius = random.real(0, 1);
		collider.rigid_body = world.add_rigid_body(body).value();
		REQUIRE_FALSE(world.add_collider(collider));
		ColliderIndex index;
		index.update(world, FRAME);
		const Aabb room = index.bounds(0).grown(Real(1e-4));
		for (int k = 0; k <= 50; ++k) {
			const Pose pose = body.pose_after(FRAME * Real(k) / 50);
			Aabb box;
			for (const Vec2 vertex : collider.vertices) {
				box.include(pose.apply(vertex));
			}
			CHECK(room.contains(box.grown(collider.radius)));
		}
	}
}

TEST_CASE("still and kinematic colliders come together in the order of the world, dynamic ones apart") {
	WorldData world;
	RigidBody body;
	const std::uint32_t kinematic = world.add_rigid_body(body).value();
	body.inverse_inertia = 1;
	const std::uint32_t dynamic = world.add_rigid_body(body).value();
	for (const std::uint32_t owner : { kinematic, NO_RIGID_BODY, dynamic, NO_RIGID_BODY, kinematic }) {
		Collider collider = box_collider({}, { 1, 1 });
		collider.rigid_body = owner;
		REQUIRE_FALSE(world.add_collider(collider));
	}
	ColliderIndex index;
	index.update(world, FRAME);
	const Aabb here{ { 0, 0 }, { 0, 0 } };
	const Aabb away{ { 5, 0 }, { 5, 0 } };
	std::vector<std::uint32_t> found;
	index.collect(here, found);
	CHECK(found == std::vector<std::uint32_t>{ 0, 1, 3, 4 });
	index.collect_dynamic(here, found);
	CHECK(found == std::vector<std::uint32_t>{ 2 });
	CHECK(index.has_dynamic_collider_in(here));
	index.collect(away, found);
	CHECK(found.empty());
	CHECK_FALSE(index.has_dynamic_collider_in(away));
	// A body that was pushable may become kinematic, and may move without anything being added.
	body.inverse_inertia = 0;
	body.pose.position = { 5, 0 };
	REQUIRE_FALSE(world.set_rigid_body(dynamic, body));
	index.update(world, FRAME);
	CHECK_FALSE(index.has_dynamic_colliders());
	index.collect(away, found);
	CHECK(found == std::vector<std::uint32_t>{ 2 });
	world.clear_environment();
	index.update(world, FRAME);
	CHECK_FALSE(index.has_colliders());
	index.collect(here, found);
	CHECK(found.empty());
}
