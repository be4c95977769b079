// SPDX-License-Identifier: MIT
// Boxes along the axes hold what they were given, however many points at a time.
#include "core/geometry/aabb.h"
#include "support/random.h"

#include <doctest/doctest.h>
#include <limits>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

TEST_CASE("the box around any number of points touches the outermost on each side") {
	Random random(31);
	for (int count = 1; count <= 19; ++count) {
		std::vector<Vec2> points;
		for (int i = 0; i < count; ++i) {
			points.push_back(random.vector(10));
		}
		Aabb expected;
		for (const Vec2 p : points) {
			expected.include(p);
		}
		const Aabb box = bounding_box(points);
		CHECK(box.min == expected.min);
		CHECK(box.max == expected.max);
	}
	const Aabb none = bounding_box({});
	CHECK(none.min.x > none.max.x);
	CHECK_FALSE(none.overlaps({ { -1, -1 }, { 1, 1 } }));
}

TEST_CASE("a point that is no number leaves the box of the others") {
	const Real nan = std::numeric_limits<Real>::quiet_NaN();
	for (std::size_t at = 0; at < 6; ++at) {
		std::vector<Vec2> points = { { 0, 5 }, { 1, 4 }, { 2, 3 }, { 3, 2 }, { 4, 1 }, { 5, 0 } };
		points[at] = { nan, nan };
		const Aabb box = bounding_box(points);
		CHECK(box.min == Vec2{ Real(at == 0 ? 1 : 0), Real(at == 5 ? 1 : 0) });
		CHECK(box.max == Vec2{ Real(at == 5 ? 4 : 5), Real(at == 0 ? 4 : 5) });
	}
}

TEST_CASE("boxes that touch overlap, and a box contains itself but not what sticks out by a hair") {
	const Aabb unit{ { 0, 0 }, { 1, 1 } };
	CHECK(unit.overlaps({ { 1, 1 }, { 2, 2 } }));
	CHECK_FALSE(unit.overlaps({ { Real(1.001), 0 }, { 2, 1 } }));
	CHECK_FALSE(unit.overlaps({ { 0, Real(-1) }, { 1, Real(-0.001) } }));
	CHECK(unit.contains(unit));
	CHECK_FALSE(unit.contains({ { 0, 0 }, { 1, Real(1.001) } }));
	CHECK(unit.grown(2).contains({ { -2, -2 }, { 3, 3 } }));
	CHECK_FALSE(unit.grown(Real(-0.25)).contains(unit));
}

TEST_CASE("packs of points hold every point, in places that are known") {
	for (std::size_t count = 1; count <= 13; ++count) {
		std::vector<Vec2> points;
		for (std::size_t i = 0; i < count; ++i) {
			points.push_back({ Real(i), -Real(i) });
		}
		std::vector<int> seen(count);
		for (std::size_t i = 0; i < packs_for(count); ++i) {
			const BasicVec2<RealPack> pack = pack_of(points, i);
			for (std::size_t lane = 0; lane < PACK_WIDTH; ++lane) {
				CHECK(pack.y[lane] == -pack.x[lane]);
				++seen.at(std::size_t(pack.x[lane]));
			}
		}
		for (const int times : seen) {
			CHECK(times >= 1);
		}
	}
}
