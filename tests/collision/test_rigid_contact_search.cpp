// SPDX-License-Identifier: MIT
// Claims about which places of soft bodies and dynamic colliders are found to touch.
#include "core/collision/rigid_contact_search.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

Collider random_collider(Random &random) {
	Collider collider;
	switch (random.integer(0, 2)) {
		case 0:
			collider.vertices = { random.vector(10) };
			collider.radius = random.real(5, 50);
			break;
		case 1: {
			const Vec2 first = random.vector(50);
			const Real width = random.real(10, 50);
			collider.vertices = { first, first + Vec2{ width, random.real(-50, 50) } };
			collider.radius = random.chance(0.5) ? random.real(0, 25) : Real(0);
			break;
		}
		default: {
			const Vec2 center = random.vector(15);
			const Real half_width = random.real(5, 50);
			collider = box_collider(center, { half_width, random.real(5, 50) });
		}
	}
	collider.surface.layer = random.chance(0.8) ? 1u : 2u;
	return collider;
}

struct Found {
	std::uint32_t collider = 0;
	std::uint32_t feature = 0;
	Vec2 normal;
	Real depth = 0;
	friend bool operator==(const Found &, const Found &) = default;
};

// Every hull point and every corner of every collider, without boxes or lists.
std::vector<Found> touches_of(const WorldData &world, const HullMotion &hull, const std::vector<Pose> &from, Real slop) {
	std::vector<Found> all;
	for (std::uint32_t i = 0; i < world.colliders().size(); ++i) {
		const Collider &collider = world.colliders()[i];
		if (!notices(world.soft_bodies()[0], collider.surface)) {
			continue;
		}
		const ColliderMotion motion{ from[collider.rigid_body], world.rigid_bodies()[collider.rigid_body].pose, false };
		const Aabb everywhere{ { -1e5f, -1e5f }, { 1e5f, 1e5f } };
		for (std::uint32_t point = 0; point < hull.to.size(); ++point) {
			if (const auto at = find_contact_of_point(hull, point, collider, motion, everywhere, slop)) {
				all.push_back({ i, point, at->normal, at->depth });
			}
		}
		for (std::uint32_t corner = 0; corner < collider.vertices.size(); ++corner) {
			if (const auto at = find_contact_of_corner(hull, hull.box(), collider, corner, motion, slop)) {
				all.push_back({ i, ContactPoint::CORNER | corner, at->normal, at->depth });
			}
		}
	}
	return all;
}

} // namespace

TEST_CASE("what a body touches in each substep is what every point and corner asked for itself would touch") {
	Random random(61);
	constexpr int SUBSTEPS = 4;
	const Real h = FRAME / SUBSTEPS;
	int touches = 0;
	int far_moves = 0;
	for (int round = 0; round < 1500; ++round) {
		WorldData world = pixel_world();
		world.add_soft_body(jelly_circle({}));
		for (int k = random.integer(1, 12); k > 0; --k) {
			RigidBody body;
			const Vec2 place = random.vector(150);
			body.pose = { place, Rotation::from_angle(random.real(-3, 3)) };
			body.linear_velocity = random.vector(1000);
			body.angular_velocity = random.real(-10, 10);
			body.inverse_mass = 1;
			Collider collider = random_collider(random);
			collider.rigid_body = world.add_rigid_body(body).value();
			REQUIRE_FALSE(world.add_collider(collider));
		}
		ColliderIndex index;
		index.update(world, FRAME);
		RigidContactSearch search;
		search.begin_step(world, index);
		search.add_body(world.soft_bodies()[0], {});
		for (int substep = 0; substep < SUBSTEPS; ++substep) {
			SoftBodyData &body = world.soft_bodies()[0];
			const std::vector<Vec2> before(body.hull().begin(), body.hull().end());
			std::vector<Pose> from;
			search.begin_substep();
			for (RigidBody &rigid : world.mutable_rigid_bodies()) {
				from.push_back(rigid.pose);
				rigid.pose = rigid.pose_after(h);
			}
			const bool is_far = random.chance(0.2); // beyond the box for which colliders were listed
			far_moves += is_far ? 1 : 0;
			const Vec2 way = random.vector(is_far ? 100 : 2);
			for (Vec2 &p : body.mutable_positions()) {
				p += way + random.vector(1);
			}
			std::vector<Found> found;
			search.find(0, [&](const RigidTouch &touch) { found.push_back({ touch.collider, touch.feature, touch.at.normal, touch.at.depth }); });
			const std::vector<Found> expected = touches_of(world, { before, body.hull() }, from, LINEAR_SLOP * world.length_unit());
			CHECK(found == expected);
			touches += int(found.size());
		}
	}
	CHECK(touches > 10000);
	CHECK(far_moves > 1000);
}
