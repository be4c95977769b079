// SPDX-License-Identifier: MIT
// Claims about edges of convex polygons that lie against one another.
#include "core/model/internal_edges.h"
#include "scenes/jelly.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <set>
#include <utility>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

constexpr Real TOLERANCE = Real(1) / 16;

} // namespace

TEST_CASE("of tiles on a grid exactly the edges towards another tile are inner ones") {
	Random random(71);
	for (int round = 0; round < 50; ++round) {
		std::vector<std::pair<int, int>> places;
		std::vector<Collider> tiles;
		for (int x = 0; x < 8; ++x) {
			for (int y = 0; y < 8; ++y) {
				if (random.integer(0, 2) > 0) {
					places.push_back({ x, y });
					tiles.push_back(box_collider({ Real(32 * x), Real(32 * y) }, { 16, 16 }));
				}
			}
		}
		mark_internal_edges(tiles, TOLERANCE);
		const std::set<std::pair<int, int>> set(places.begin(), places.end());
		for (std::size_t i = 0; i < tiles.size(); ++i) {
			const auto [x, y] = places[i];
			// The edges of a box in order: the upper one, right, lower, left.
			const std::uint32_t expected = std::uint32_t(set.contains({ x, y - 1 })) | std::uint32_t(set.contains({ x + 1, y })) << 1 |
					std::uint32_t(set.contains({ x, y + 1 })) << 2 | std::uint32_t(set.contains({ x - 1, y })) << 3;
			CHECK(tiles[i].internal_edges == expected);
		}
	}
}

TEST_CASE("pieces of a polygon, rounding or not, have their cuts inside, and marking twice is marking once") {
	// An L of two pieces, cut from its dent to the corner across, far from the origin.
	const Vec2 far{ Real(5000.1), Real(-3000.3) };
	std::vector<Collider> pieces(2);
	pieces[0].vertices = { far, far + Vec2{ 100, 0 }, far + Vec2{ 100, 50 }, far + Vec2{ 50, 50 } };
	pieces[1].vertices = { far + Vec2{ Real(0.01), Real(-0.01) }, far + Vec2{ Real(50.01), Real(49.99) }, far + Vec2{ 50, 100 }, far + Vec2{ 0, 100 } };
	for (int times = 0; times < 2; ++times) {
		mark_internal_edges(pieces, TOLERANCE);
		CHECK(pieces[0].internal_edges == 0b1000);
		CHECK(pieces[1].internal_edges == 0b0001);
	}
	pieces.pop_back();
	mark_internal_edges(pieces, TOLERANCE);
	CHECK(pieces[0].internal_edges == 0);
}

TEST_CASE("a box cut into two triangles has its diagonal inside") {
	std::vector<Collider> halves(2);
	halves[0].vertices = { { 0, 0 }, { 100, 0 }, { 100, 100 } };
	halves[1].vertices = { { 0, 0 }, { 100, 100 }, { 0, 100 } };
	mark_internal_edges(halves, TOLERANCE);
	CHECK(halves[0].internal_edges == 0b100);
	CHECK(halves[1].internal_edges == 0b001);
}

TEST_CASE("what only a part of the bodies notices, what moves apart, what is round or dented, and half an edge cover nothing") {
	const std::vector<Collider> pair = { box_collider({ 0, 0 }, { 16, 16 }), box_collider({ 32, 0 }, { 16, 16 }) };
	const auto inner = [](std::vector<Collider> tiles) {
		mark_internal_edges(tiles, TOLERANCE);
		return tiles[0].internal_edges | tiles[1].internal_edges;
	};
	CHECK(inner(pair) != 0);
	std::vector<Collider> changed = pair;
	changed[1].surface.layer = 3;
	CHECK(inner(changed) == 0);
	changed = pair;
	changed[1].rigid_body = 0;
	CHECK(inner(changed) == 0);
	changed[0].rigid_body = 0;
	CHECK(inner(changed) != 0);
	changed = pair;
	changed[0].radius = 1;
	CHECK(inner(changed) == 0);
	changed = pair;
	changed[0].concave = true;
	CHECK(inner(changed) == 0);
	changed = pair;
	changed[1] = box_collider({ 32, 0 }, { 16, 15 });
	CHECK(inner(changed) == 0);
	changed = pair;
	changed[1] = box_collider({ 33, 0 }, { 16, 16 });
	CHECK(inner(changed) == 0);
}

TEST_CASE("of a polygon with more than 32 corners the edges that have no bit stay as they are") {
	std::vector<Collider> pieces(2);
	for (int i = 0; i < 40; ++i) {
		const Rotation turn = Rotation::from_angle(Real(6.283185307179586 * i / 40));
		pieces[0].vertices.push_back(turn.apply({ 100, 0 }));
	}
	const Vec2 a = pieces[0].vertices[35];
	const Vec2 b = pieces[0].vertices[36];
	pieces[1].vertices = { b, a, (a + b) * Real(0.6) };
	REQUIRE_FALSE(check_collider(pieces[1]));
	mark_internal_edges(pieces, TOLERANCE);
	CHECK(pieces[0].internal_edges == 0);
	CHECK(pieces[1].internal_edges == 0);
}
