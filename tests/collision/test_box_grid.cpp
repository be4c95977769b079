// SPDX-License-Identifier: MIT
// Claims about the grid over boxes, against asking every box.
#include "core/collision/box_grid.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace softbody;
using namespace softbody::testing;

namespace {

std::vector<std::uint32_t> ask_every_box(std::span<const Aabb> boxes, std::span<const std::uint32_t> names, const Aabb &box) {
	std::vector<std::uint32_t> found;
	for (std::size_t i = 0; i < boxes.size(); ++i) {
		if (boxes[i].overlaps(box)) {
			found.push_back(names[i]);
		}
	}
	std::ranges::sort(found);
	return found;
}

std::vector<std::uint32_t> ask_grid(const BoxGrid &grid, const Aabb &box) {
	std::vector<std::uint32_t> found{};
	grid.collect(box, found);
	std::ranges::sort(found);
	return found;
}

Aabb box_at(Vec2 center, Real half_width, Real half_height) {
	return { { center.x - half_width, center.y - half_height }, { center.x + half_width, center.y + half_height } };
}

} // namespace

TEST_CASE("a grid of boxes of any size, asked with boxes of any size, names the boxes that overlap") {
	Random random(311);
	for (int round = 0; round < 200; ++round) {
		std::vector<Aabb> boxes;
		std::vector<std::uint32_t> names;
		const double spread = std::pow(10, double(random.real(-1, 4)));
		for (int i = random.integer(0, 300); i > 0; --i) {
			const double size = std::pow(10, double(random.real(-3, random.chance(0.05) ? 9 : 2)));
			boxes.push_back(box_at(random.vector(spread), random.real(0, size), random.real(0, size)));
			names.push_back(std::uint32_t(random.integer(0, 1000000)));
		}
		BoxGrid grid;
		grid.assign(boxes, names);
		CHECK(grid.empty() == boxes.empty());
		for (int question = 0; question < 50; ++question) {
			const double size = std::pow(10, double(random.real(-4, 5)));
			const Aabb box = box_at(random.vector(spread), random.real(0, size), random.real(0, size));
			const auto expected = ask_every_box(boxes, names, box);
			CHECK(ask_grid(grid, box) == expected);
			CHECK(grid.overlaps_any(box) == !expected.empty());
		}
	}
}

TEST_CASE("tiles that touch the question along a line or in a corner are named") {
	std::vector<Aabb> tiles;
	std::vector<std::uint32_t> names;
	for (int y = -20; y < 20; ++y) {
		for (int x = -20; x < 20; ++x) {
			names.push_back(std::uint32_t(tiles.size()));
			tiles.push_back(box_at({ Real(16 * x + 8), Real(16 * y + 8) }, 8, 8));
		}
	}
	BoxGrid grid;
	grid.assign(tiles, names);
	for (int y = -20; y <= 20; ++y) {
		for (int x = -20; x <= 20; ++x) {
			const Vec2 corner{ Real(16 * x), Real(16 * y) };
			CHECK(ask_grid(grid, { corner, corner }) == ask_every_box(tiles, names, { corner, corner }));
			const Aabb exact = box_at({ corner.x + 8, corner.y + 8 }, 8, 8);
			CHECK(ask_grid(grid, exact) == ask_every_box(tiles, names, exact));
		}
	}
}

TEST_CASE("points, boxes far away, and boxes that are no boxes do no harm") {
	const std::vector<Aabb> boxes{ { { 1, 1 }, { 1, 1 } }, { { 1, 1 }, { 1, 1 } }, box_at({ Real(1e20), 0 }, 1, 1),
		{ { NOT_A_NUMBER, 0 }, { 1, 1 } }, { { -INFINITE, -INFINITE }, { INFINITE, INFINITE } } };
	const std::vector<std::uint32_t> names{ 0, 1, 2, 3, 4 };
	BoxGrid grid;
	grid.assign(boxes, names);
	CHECK(ask_grid(grid, box_at({ 1, 1 }, 1, 1)) == std::vector<std::uint32_t>{ 0, 1, 4 });
	CHECK(ask_grid(grid, box_at({ Real(1e20), 0 }, 5, 5)) == std::vector<std::uint32_t>{ 2, 4 });
	CHECK(ask_grid(grid, { { NOT_A_NUMBER, NOT_A_NUMBER }, { 1, 1 } }).empty());
	CHECK(ask_grid(grid, { { -INFINITE, -INFINITE }, { INFINITE, INFINITE } }).size() >= 4);
	// Turned inside out across, and 2^31 cells high: visited cell by cell it would take minutes.
	CHECK(ask_grid(grid, { { Real(1e9), Real(-1e20) }, { Real(-1e9), Real(1e20) } }).size() <= 1);
	grid.assign({}, {});
	CHECK(grid.empty());
	CHECK(ask_grid(grid, box_at({ 1, 1 }, 1, 1)).empty());
}
