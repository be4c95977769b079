// SPDX-License-Identifier: MIT
// Claims about cut polygons, against brute force.
#include "core/creator/hulls.h"
#include "core/geometry/mean_value.h"
#include "core/geometry/polygon_cut.h"
#include "core/geometry/segment.h"
#include "scenes/cut_oracles.h"
#include "scenes/random_cuts.h"
#include "support/compare.h"

#include <doctest/doctest.h>

using namespace softbody;
using namespace softbody::testing;

namespace {

const std::vector<Vec2> SQUARE = { { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 } };
// A C, open to the right.
const std::vector<Vec2> CLAMP = { { 0, 0 }, { 30, 0 }, { 30, 10 }, { 10, 10 }, { 10, 20 }, { 30, 20 }, { 30, 30 }, { 0, 30 } };
const CutLimits PLAIN = { .least_area = 0.01, .snap = 0.1 };

PolygonCut cut(const std::vector<Vec2> &polygon, const std::vector<Vec2> &blade, const CutLimits &limits = PLAIN) {
	const PolygonCut result = cut_polygon(polygon, polygon, blade, limits);
	const CutFacts facts = facts_of(polygon, polygon, limits, result);
	CHECK(facts.violation == "");
	return result;
}

std::vector<double> areas(const PolygonCut &cut) {
	std::vector<double> found;
	for (const auto &piece : cut.pieces) {
		std::vector<Vec2> outline;
		for (const std::uint32_t point : piece) {
			outline.push_back(cut.points[point].position);
		}
		found.push_back(shoelace(outline));
	}
	return found;
}

} // namespace

TEST_CASE("a line parts a square into two rectangles, the larger first") {
	const PolygonCut result = cut(SQUARE, { { 3, -5 }, { 3, 15 } });
	const std::vector<double> found = areas(result);
	REQUIRE(found.size() == 2);
	CHECK(found[0] == doctest::Approx(70));
	CHECK(found[1] == doctest::Approx(30));
	CHECK(result.points.size() == 6);
	CHECK(result.refused.empty());
}

TEST_CASE("a blade that misses, ends inside, touches a corner or follows an edge cuts nothing, and nothing is refused") {
	for (const std::vector<Vec2> &blade : std::vector<std::vector<Vec2>>{ { { 20, 0 }, { 30, 10 } }, { { 5, -5 }, { 5, 5 } }, { { 4, 4 }, { 6, 6 } },
				 { { -5, 5 }, { 5, -5 } }, { { -5, 0 }, { 15, 0 } }, { { 0, 0 }, { 10, 0 } }, { { 10, 2 }, { 10, 8 } }, { { 3, 3 }, { 3, 3 } },
				 { { 5, -5 }, { 5, 5 }, { 6, 5 }, { 6, -5 } } }) {
		const PolygonCut result = cut(SQUARE, blade);
		if (blade.size() == 4) { // in and out through one side
			CHECK(result.pieces.size() == 2);
			continue;
		}
		CHECK(result.pieces.size() == 1);
		CHECK(result.refused.empty());
		CHECK(result.points.size() == SQUARE.size());
	}
}

TEST_CASE("a blade through two corners makes no new corner") {
	const PolygonCut result = cut(SQUARE, { { -5, -5 }, { 15, 15 } });
	CHECK(result.points.size() == 4);
	CHECK(areas(result) == std::vector<double>{ 50, 50 });
}

TEST_CASE("a blade close to a corner cuts at the corner") {
	const PolygonCut result = cut(SQUARE, { { Real(0.05), -5 }, { Real(9.95), 15 } });
	CHECK(result.points.size() <= 6);
	const PolygonCut near = cut(SQUARE, { { Real(-0.04), -1 }, { Real(10.04), 11 } });
	CHECK(near.pieces.size() <= 2);
}

TEST_CASE("a line across both arms of a clamp makes three pieces, and one across its back two") {
	CHECK(cut(CLAMP, { { 20, -5 }, { 20, 35 } }).pieces.size() == 3);
	CHECK(cut(CLAMP, { { -5, 15 }, { 35, 15 } }).pieces.size() == 2);
	CHECK(cut(CLAMP, { { 20, -5 }, { 20, 15 } }).pieces.size() == 2); // it ends between the arms
}

TEST_CASE("a bent blade is followed, and both sides get its bends") {
	const PolygonCut result = cut(SQUARE, { { 5, -5 }, { 5, 5 }, { 15, 5 } });
	const std::vector<double> found = areas(result);
	REQUIRE(found.size() == 2);
	CHECK(found[0] == doctest::Approx(75));
	CHECK(found[1] == doctest::Approx(25));
	CHECK(result.points.size() == 7);
}

TEST_CASE("a blade that comes back cuts again, across its own cut, too") {
	CHECK(cut(SQUARE, { { 5, -5 }, { 5, 15 }, { 15, 15 }, { 15, 5 }, { -5, 5 } }).pieces.size() == 4);
	CHECK(cut(SQUARE, { { 3, -5 }, { 3, 15 }, { 7, 15 }, { 7, -5 } }).pieces.size() == 3);
}

TEST_CASE("a blade that crosses itself inside leaves its loop out") {
	const PolygonCut result = cut(SQUARE, { { 5, -5 }, { 5, 6 }, { 7, 6 }, { 7, 3 }, { 3, 3 }, { 3, 15 } });
	CHECK(result.pieces.size() == 2);
}

TEST_CASE("a piece that would be too small is refused with its area, and the rest is cut") {
	CutLimits limits = PLAIN;
	limits.least_area = 25;
	const PolygonCut small = cut(SQUARE, { { 2, -5 }, { 2, 15 } }, limits);
	CHECK(small.pieces.size() == 1);
	REQUIRE(small.refused.size() == 1);
	CHECK(small.refused[0].reason == RefusedSpan::Reason::SMALL);
	CHECK(small.refused[0].value == doctest::Approx(20));
	CHECK(small.points.size() == 4);
	const PolygonCut part = cut(SQUARE, { { 2, -5 }, { 2, 15 }, { 6, 15 }, { 6, -5 } }, limits);
	CHECK(part.pieces.size() == 2);
	CHECK(part.refused.size() == 1);
	limits = PLAIN;
	limits.least_width = 3;
	const PolygonCut thin = cut(SQUARE, { { 1, -5 }, { 1, 15 } }, limits);
	REQUIRE(thin.refused.size() == 1);
	CHECK(thin.refused[0].reason == RefusedSpan::Reason::THIN);
	CHECK(thin.refused[0].value == doctest::Approx(2 * 10.0 / 22));
}

TEST_CASE("there are never more pieces than allowed") {
	CutLimits limits = PLAIN;
	limits.most_pieces = 3;
	const PolygonCut result = cut(SQUARE, { { 2, -5 }, { 2, 15 }, { 4, 15 }, { 4, -5 }, { 6, -5 }, { 6, 15 }, { 8, 15 }, { 8, -5 } }, limits);
	CHECK(result.pieces.size() == 3);
	CHECK_FALSE(result.refused.empty());
}

TEST_CASE("points along a cut are evenly spaced, on both sides") {
	CutLimits limits = PLAIN;
	limits.spacing = 2;
	const PolygonCut result = cut(SQUARE, { { 5, -5 }, { 5, 15 } }, limits);
	REQUIRE(result.pieces.size() == 2);
	CHECK(result.pieces[0].size() == 2 + 2 + 4);
	CHECK(result.pieces[1].size() == 2 + 2 + 4);
	for (std::size_t i = 6; i < result.points.size(); ++i) {
		CHECK(result.points[i].position.x == 5);
		CHECK(result.points[i].position.y == doctest::Approx(2.0 * double(i - 5)));
	}
}

TEST_CASE("mean value weights give back any linear function, inside, on the outline and at corners") {
	Random random(5);
	for (int i = 0; i < 500; ++i) {
		const std::vector<Vec2> outline = random_outline(OutlineKind(i % OUTLINE_KIND_COUNT), 24, random);
		Vec2 place = random.vector(60);
		if (i % 3 == 1) {
			place = outline[0];
		} else if (i % 3 == 2) {
			place = (outline[0] + outline[1]) * Real(0.5);
		} else if (!contains_place(outline, place)) {
			continue;
		}
		const std::vector<double> weights = mean_value_weights(outline, place);
		double sum = 0, x = 0, y = 0;
		for (std::size_t k = 0; k < outline.size(); ++k) {
			sum += weights[k];
			x += weights[k] * double(outline[k].x);
			y += weights[k] * double(outline[k].y);
		}
		CHECK(sum == doctest::Approx(1).epsilon(1e-9));
		CHECK(std::hypot(x - double(place.x), y - double(place.y)) < 1e-3 * (sizeof(Real) == 4 ? 1 : 1e-6));
	}
}

TEST_CASE("2,000 random cuts of random outlines leave simple pieces that sum to the whole") {
	Random random(11);
	int cuts = 0;
	for (int i = 0; i < 2000; ++i) {
		CAPTURE(i);
		const std::vector<Vec2> rest = random_outline(OutlineKind(i % OUTLINE_KIND_COUNT), i % 7 == 0 ? 200 : 32, random);
		const std::vector<Vec2> outline = random.chance(0.5) ? bent_outline(rest, random) : rest;
		const std::vector<Vec2> blade = random_blade(outline, 8, random);
		const double edge = double(perimeter(rest)) / double(rest.size());
		const CutLimits limits{ .least_area = double(random.real(0, 0.1)) * shoelace(rest), .spacing = random.chance(0.5) ? edge : 0, .snap = 0.1 * edge };
		const PolygonCut result = cut_polygon(outline, rest, blade, limits);
		const CutFacts facts = facts_of(outline, rest, limits, result);
		CHECK(facts.violation == "");
		cuts += result.pieces.size() > 1;
		// A place of the whole lies in exactly one piece.
		for (int k = 0; k < 20; ++k) {
			const Vec2 place = random.vector(70);
			int holders = 0;
			double nearest = HUGE_VAL;
			for (const auto &piece : result.pieces) {
				std::vector<Vec2> corners;
				for (const std::uint32_t point : piece) {
					corners.push_back(result.points[point].position);
				}
				holders += contains_place(corners, place);
				nearest = std::fmin(nearest, distance_to_edges(corners, place));
			}
			CHECK((nearest < 1e-3 || holders == int(contains_place(outline, place))));
		}
	}
	CHECK(cuts > 1000);
}

TEST_CASE("each edge of a piece tells the edge of the polygon on which it lies, or that a cut made it: 500 random cuts, by distances") {
	int made = 0;
	int kept = 0;
	for (int seed = 0; seed < 500; ++seed) {
		CAPTURE(seed);
		Random random{ std::uint64_t(seed) };
		const std::vector<Vec2> polygon = random_outline(OutlineKind(seed % OUTLINE_KIND_COUNT), 30, random);
		const PolygonCut result = cut_polygon(polygon, polygon, random_blade(polygon, 6, random), { .least_area = 1, .spacing = 8, .snap = 1 });
		for (const auto &piece : result.pieces) {
			const auto sources = source_edges(result, polygon.size(), piece);
			REQUIRE(sources.size() == piece.size());
			for (std::size_t i = 0; i < piece.size(); ++i) {
				const Vec2 a = result.points[piece[i]].position;
				const Vec2 b = result.points[piece[(i + 1) % piece.size()]].position;
				const auto distance_to = [&](Vec2 p, std::size_t edge) {
					const Vec2 from = polygon[edge];
					const Vec2 to = polygon[(edge + 1) % polygon.size()];
					return double(length(from + (to - from) * closest_parameter_on_segment(p, from, to) - p));
				};
				const Vec2 middle = (a + b) * Real(0.5);
				if (sources[i]) {
					++kept;
					CHECK(std::max(distance_to(a, *sources[i]), distance_to(b, *sources[i])) < 1e-3);
				} else {
					++made;
					bool is_on_outline = false;
					for (std::size_t edge = 0; edge < polygon.size(); ++edge) {
						is_on_outline |= std::max({ distance_to(a, edge), distance_to(b, edge), distance_to(middle, edge) }) < 1e-5;
					}
					CHECK_FALSE(is_on_outline);
				}
			}
		}
	}
	CHECK(made > 2000);
	CHECK(kept > 8000);
}

TEST_CASE("a long straight blade leaves every piece on one side of it, unless a part was refused") {
	Random random(12);
	int cuts = 0;
	for (int i = 0; i < 2000; ++i) {
		CAPTURE(i);
		const std::vector<Vec2> outline = random_outline(OutlineKind(i % OUTLINE_KIND_COUNT), 40, random);
		const Vec2 middle = random.vector(40);
		const Vec2 way = Rotation::from_angle(random.real(0, 6.28)).apply({ 1, 0 });
		const double edge = double(perimeter(outline)) / double(outline.size());
		const CutLimits limits{ .least_area = 1e-4 * shoelace(outline), .snap = 0.05 * edge };
		const PolygonCut result = cut_polygon(outline, outline, std::vector<Vec2>{ middle - way * 500, middle + way * 500 }, limits);
		CHECK(facts_of(outline, outline, limits, result).violation == "");
		cuts += result.pieces.size() > 1;
		if (!result.refused.empty()) {
			continue;
		}
		for (const auto &piece : result.pieces) {
			double left = 0, right = 0;
			for (const std::uint32_t point : piece) {
				const double side = double(cross(way, result.points[point].position - middle));
				left = std::fmax(left, side);
				right = std::fmax(right, -side);
			}
			// Ends move by `snap`, and a triangle of less area than its length times `snap` is left, twice that high.
			CHECK(std::fmin(left, right) <= 3 * limits.snap + 1e-3);
		}
	}
	CHECK(cuts > 1000);
}
