// SPDX-License-Identifier: MIT
// Claims about one hull and one collider: what is found does not depend on which of them moves.
#include "core/collision/collider_contact.h"
#include "scenes/jelly.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real SLOP = Real(0.001);

std::vector<Vec2> bar(Real half_width, Real half_height, Vec2 center = {}) {
	return box_collider(center, { half_width, half_height }).vertices;
}

ColliderMotion motion_between(Vec2 from, Vec2 to) {
	return { { from, {} }, { to, {} }, false };
}

} // namespace

TEST_CASE("a needle that comes into a bar in one substep goes back out the way it came, past the middle or right through") {
	const Collider needle{ { { 0, 0 }, { -90, 1 }, { -90, -1 } }, 0, {} };
	for (const Real half : { Real(10), Real(3), Real(1) }) {
		const std::vector<Vec2> hull = bar(half, 60); // from (-, -) by (+, -) and (+, +): the left edge leaves point 3
		const Aabb box = bounding_box(hull);
		// From 2 px before the bar to 11 px on, a quarter up its height.
		const ColliderMotion motion = motion_between({ -half - 2, -30 }, { -half + 11, -30 });
		const auto contact = find_contact_of_corner({ hull, hull }, box, needle, 0, motion);
		REQUIRE(contact.has_value());
		CHECK(contact->place.a == 3);
		CHECK(contact->place.b == 0);
		CHECK(std::abs(double(contact->place.t) - 0.75) <= 8 * EPSILON);
		CHECK(distance(contact->normal, { 1, 0 }) <= 8 * EPSILON);
		CHECK(std::abs(double(contact->depth) - 11) <= 32 * EPSILON * 11);
		// The same with the bar coming to the needle.
		const std::vector<Vec2> before = bar(half, 60, { 100, 0 });
		const std::vector<Vec2> after = bar(half, 60, { 87, 0 });
		const Vec2 tip{ 100 - half - 2, -30 };
		const auto other = find_contact_of_corner({ before, after }, { { 0, -60 }, { 110, 60 } }, needle, 0, motion_between(tip, tip));
		REQUIRE(other.has_value());
		CHECK(other->place.a == 3);
		CHECK(std::abs(double(other->depth) - 11) <= 32 * EPSILON * 100);
		// On its way out again it is pushed no more than it is inside.
		CHECK_FALSE(find_contact_of_corner({ hull, hull }, box, needle, 0, motion_between({ 0, 0 }, { -half - 2, 0 })));
	}
}

TEST_CASE("a corner that stays outside is not touched, and one that stays inside leaves by the nearest edge") {
	const Collider needle{ { { 0, 0 }, { -90, 1 }, { -90, -1 } }, 0, {} };
	const std::vector<Vec2> hull = bar(10, 60);
	const Aabb box = bounding_box(hull);
	CHECK_FALSE(find_contact_of_corner({ hull, hull }, box, needle, 0, motion_between({ -20, 0 }, { -11, 0 })));
	CHECK_FALSE(find_contact_of_corner({ hull, hull }, box, needle, 0, motion_between({ -20, 70 }, { 20, 70 })));
	const auto inside = find_contact_of_corner({ hull, hull }, box, needle, 0, motion_between({ 0, 0 }, { 8, 1 }));
	REQUIRE(inside.has_value());
	CHECK(inside->place.a == 1);
	CHECK(distance(inside->normal, { -1, 0 }) <= 8 * EPSILON);
	CHECK(std::abs(double(inside->depth) - 2) <= 8 * EPSILON * 10);
}

TEST_CASE("a point against a moving collider is that point against the collider at rest, in its frame") {
	Random random(331);
	int hits = 0;
	for (int round = 0; round < 3000; ++round) {
		Collider collider = box_collider(random.vector(1), { random.real(0.2, 2), random.real(0.05, 2) });
		if (random.chance(0.3)) {
			collider = { { random.vector(1), random.vector(1) + Vec2{ 2, 0 } }, random.chance(0.5) ? random.real(0, 1) : Real(0), {} };
		}
		const std::vector<Vec2> from{ random.vector(3) };
		const std::vector<Vec2> to{ random.vector(3) };
		const Aabb bounds = collider.bounds().grown(SLOP);
		const auto still = find_contact_of_point({ from, to }, 0, collider, {}, bounds, SLOP);
		const Pose start{ random.vector(5), Rotation::from_angle(random.real(-3, 3)) };
		const Pose end{ random.vector(5), Rotation::from_angle(random.real(-3, 3)) };
		const std::vector<Vec2> moved_from{ start.apply(from[0]) };
		const std::vector<Vec2> moved_to{ end.apply(to[0]) };
		const auto moved = find_contact_of_point({ moved_from, moved_to }, 0, collider, { start, end, false }, bounds, SLOP);
		// Where the point is at the surface to within rounding, one may find what the other does not.
		if (still && moved && distance(end.rotation.apply(still->normal), moved->normal) < 0.01) {
			CHECK(std::abs(double(still->depth - moved->depth)) <= 64 * EPSILON * 10);
			++hits;
		} else {
			CHECK(still.has_value() == moved.has_value());
		}
	}
	CHECK(hits > 300);
}

// Found by scripts/mutate.sh: nothing noticed when no corner of a concave collider was looked at any more.
TEST_CASE("the tip of a concave collider inside a hull is a contact, the bottom of its dent is not") {
	Collider crown{ { { -3, -2 }, { 3, -2 }, { 3, -1 }, { 1, Real(-1.5) }, { 0, Real(0.25) }, { -1, Real(-1.5) }, { -3, -1 } }, 0, {} };
	crown.concave = true;
	REQUIRE_FALSE(check_collider(crown));
	const auto contact_of = [&](std::size_t corner, Real height) {
		const std::vector<Vec2> hull = { { -2, height }, { 2, height }, { 2, height + 4 }, { -2, height + 4 } };
		return find_contact_of_corner({ hull, hull }, bounding_box(hull), crown, corner, {});
	};
	constexpr std::size_t TIP = 4;
	constexpr std::size_t DENT = 3;
	const auto tip = contact_of(TIP, 0);
	REQUIRE(tip);
	CHECK(tip->normal == Vec2{ 0, 1 }); // the hull goes up
	CHECK(tip->depth == Real(0.25));
	CHECK_FALSE(contact_of(TIP, Real(0.5)));
	CHECK_FALSE(contact_of(DENT, Real(-1.75)));
}
