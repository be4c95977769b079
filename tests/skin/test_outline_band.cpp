// SPDX-License-Identifier: MIT
// Claims about bands along outlines, judged by areas and distances.
#include "core/skin/outline_band.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace softbody;

namespace {

double area_of(const std::vector<Triangle> &triangles, const std::vector<Vec2> &vertices) {
	double sum = 0;
	for (const Triangle &t : triangles) {
		sum += std::abs(cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]])) / 2;
	}
	return sum;
}

std::vector<Vec2> placed(const OutlineBand &band, const std::vector<Vec2> &outline, Real side) {
	std::vector<Vec2> vertices(band.vertex_count());
	band.place(outline, side, vertices);
	return vertices;
}

Real distance_to_outline(Vec2 p, const std::vector<Vec2> &outline) {
	Real least = Real(1e9);
	for (std::size_t i = 0; i < outline.size(); ++i) {
		const Vec2 from = outline[i];
		const Vec2 edge = outline[(i + 1) % outline.size()] - from;
		const Real along = std::clamp(dot(p - from, edge) / std::max(length_squared(edge), Real(1e-9)), Real(0), Real(1));
		least = std::min(least, length(p - from - edge * along));
	}
	return least;
}

OutlineBand make_band(std::size_t corners, Real width, std::uint32_t corner_points = 5) {
	const OutlineBand::Rail rails[]{ { 0, 1 }, { width, corner_points } };
	return OutlineBand(corners, rails);
}

// A box with a narrow dent from above.
const std::vector<Vec2> DENTED{ { 0, 0 }, { 45, 0 }, { 50, 40 }, { 55, 0 }, { 100, 0 }, { 100, 80 }, { 0, 80 } };

} // namespace

TEST_CASE("the band inside a square is the square without a smaller one") {
	const std::vector<Vec2> square{ { 0, 0 }, { 100, 0 }, { 100, 100 }, { 0, 100 } };
	const OutlineBand band = make_band(4, 10);
	CHECK(area_of(band.triangles(), placed(band, square, 1)) == doctest::Approx(100 * 100 - 80 * 80));
}

TEST_CASE("the band inside a circle of points is a ring") {
	const std::vector<Vec2> circle = circle_hull(50, 64).value();
	const OutlineBand band = make_band(64, 8);
	// Moving the edges of a regular polygon scales it by its apothem.
	const double apothem = 50 * std::cos(std::numbers::pi / 64);
	const double scale = (apothem - 8) / apothem;
	CHECK(area_of(band.triangles(), placed(band, circle, 1)) ==
			doctest::Approx(signed_area(circle) * (1 - scale * scale)).epsilon(1e-4));
}

TEST_CASE("either winding gives the same band") {
	std::vector<Vec2> reversed = DENTED;
	std::ranges::reverse(reversed);
	const OutlineBand band = make_band(DENTED.size(), 6);
	CHECK(area_of(band.triangles(), placed(band, DENTED, 1)) ==
			doctest::Approx(area_of(band.triangles(), placed(band, reversed, -1))));
	for (const Vec2 p : placed(band, reversed, -1)) {
		CHECK((distance_to_outline(p, DENTED) < 0.01 || point_in_polygon(p, DENTED)));
	}
}

TEST_CASE("around the tip of a dent the band is round: nothing is farther from the outline than its width") {
	const Real width = 6;
	const OutlineBand band = make_band(DENTED.size(), width);
	const std::vector<Vec2> vertices = placed(band, DENTED, 1);
	band.for_vertices([&](std::size_t vertex, std::size_t corner, std::size_t rail) {
		if (corner == 2 && rail == 1) {
			CHECK(length(vertices[vertex] - DENTED[2]) == doctest::Approx(width));
			CHECK(vertices[vertex].y > DENTED[2].y - 2);
		}
	});
	// Evenly: five points on an arc of 166 degrees are 41 apart.
	const double chord = 2 * width * std::sin(41.4 / 2 / 180 * std::numbers::pi);
	std::vector<Vec2> arc;
	band.for_vertices([&](std::size_t vertex, std::size_t corner, std::size_t rail) {
		if (corner == 2 && rail == 1) {
			arc.push_back(vertices[vertex]);
		}
	});
	for (std::size_t k = 0; k + 1 < arc.size(); ++k) {
		CHECK(length(arc[k + 1] - arc[k]) == doctest::Approx(chord).epsilon(0.02));
	}
	// A mitre would reach more than 7 widths deep.
	const OutlineBand sharp = make_band(DENTED.size(), width, 1);
	for (const Vec2 p : placed(sharp, DENTED, 1)) {
		CHECK(distance_to_outline(p, DENTED) <= 4 * width + Real(0.01));
	}
}

TEST_CASE("a sharp tip keeps the band within the length of its edges") {
	const std::vector<Vec2> spike{ { 0, 0 }, { 200, 10 }, { 0, 20 } };
	const OutlineBand band = make_band(3, 8);
	for (const Vec2 p : placed(band, spike, 1)) {
		CHECK(p.x >= -1);
		CHECK(p.x <= 201);
	}
}

TEST_CASE("a folded or collapsed outline gives finite places near it") {
	const std::vector<std::vector<Vec2>> outlines{
		{ { 0, 0 }, { 100, 0 }, { 0, 0 }, { 0, 100 } }, // an edge back onto itself
		{ { 5, 5 }, { 5, 5 }, { 5, 5 }, { 5, 5 } },
		{ { 0, 0 }, { 100, 100 }, { 100, 0 }, { 0, 100 } }, // crossed
	};
	const OutlineBand band = make_band(4, 10);
	for (const std::vector<Vec2> &outline : outlines) {
		for (const Vec2 p : placed(band, outline, 1)) {
			CHECK(is_finite(p));
			CHECK(distance_to_outline(p, outline) < 110);
		}
	}
}

TEST_CASE("four rails are three bands side by side") {
	const std::vector<Vec2> square{ { 0, 0 }, { 100, 0 }, { 100, 100 }, { 0, 100 } };
	const OutlineBand::Rail rails[]{ { -1, 1 }, { 1, 1 }, { 9, 5 }, { 11, 5 } };
	const OutlineBand band(4, rails);
	CHECK(area_of(band.triangles(), placed(band, square, 1)) == doctest::Approx(102 * 102 - 78 * 78));
	std::size_t seen = 0;
	band.for_vertices([&](std::size_t vertex, std::size_t corner, std::size_t) {
		CHECK(vertex == seen++);
		CHECK(corner <= 4);
	});
	CHECK(seen == band.vertex_count());
}

TEST_CASE("a band from round corners to round or sharp ones covers what lies between them once") {
	const std::vector<Vec2> square{ { 0, 0 }, { 100, 0 }, { 100, 100 }, { 0, 100 } };
	constexpr std::uint32_t POINTS = 5;
	// Outside of the square corners are fans of a quarter circle, here a chain of POINTS - 1 chords.
	const double fan = (POINTS - 1) * std::sin(std::numbers::pi / 2 / (POINTS - 1)) / 2; // of radius 1
	const auto rounded = [&](double distance) { return 100 * 100 + 4 * 100 * distance + 4 * fan * distance * distance; };
	const auto band_area = [&](Real from, std::uint32_t from_points, Real to, std::uint32_t to_points) {
		const OutlineBand::Rail rails[]{ { from, from_points }, { to, to_points } };
		const OutlineBand band(4, rails);
		return area_of(band.triangles(), placed(band, square, 1));
	};
	CHECK(band_area(-20, POINTS, -10, POINTS) == doctest::Approx(rounded(20) - rounded(10)));
	CHECK(band_area(-20, POINTS, 0, 1) == doctest::Approx(rounded(20) - rounded(0)));
	CHECK(band_area(-20, POINTS, 10, 1) == doctest::Approx(rounded(20) - 80 * 80));
}

TEST_CASE("a band along some edges and one along the others cover together what goes all around, each its own edges") {
	const std::vector<Vec2> square = box_hull({ 100, 100 }, 100).value();
	REQUIRE(square.size() == 4);
	const OutlineBand::Rail rails[] = { { 0, 1 }, { 10, 4 } };
	const std::vector<std::uint8_t> some{ 1, 0, 0, 1 };
	const std::vector<std::uint8_t> others{ 0, 1, 1, 0 };
	const OutlineBand all(4, rails);
	const OutlineBand first(4, rails, some);
	const OutlineBand second(4, rails, others);
	CHECK(area_of(all.triangles(), placed(all, square, 1)) == doctest::Approx(10000 - 6400).epsilon(1e-4));
	CHECK(area_of(first.triangles(), placed(first, square, 1)) == doctest::Approx(1800).epsilon(1e-4)); // two trapezoids
	CHECK(area_of(second.triangles(), placed(second, square, 1)) == doctest::Approx(1800).epsilon(1e-4));
	const std::vector<Vec2> vertices = placed(first, square, 1);
	for (const Triangle &t : first.triangles()) {
		const Vec2 middle = (vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) * (Real(1) / 3);
		const auto off = [&](std::size_t edge) { return std::abs(cross(square[(edge + 1) % 4] - square[edge], middle - square[edge])) / 100; };
		CHECK(std::min(off(0), off(3)) < 10);
		CHECK(std::min(off(1), off(2)) > 3); // no triangle lies along an edge that was left out
	}
}

TEST_CASE("moved corners of a square are those of a larger one") {
	const std::vector<Vec2> square{ { 0, 0 }, { 100, 0 }, { 100, 100 }, { 0, 100 } };
	std::vector<Vec2> moved(4);
	move_corners(square, -5, moved);
	CHECK(length(moved[0] - Vec2{ -5, -5 }) < 1e-3);
	CHECK(length(moved[2] - Vec2{ 105, 105 }) < 1e-3);
}
