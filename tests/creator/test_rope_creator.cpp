// SPDX-License-Identifier: MIT
// Ropes are made of paths, and bad paths are refused by name.
#include "core/creator/rope_creator.h"
#include "core/geometry/polygon.h"
#include "core/model/body_settings.h"
#include "support/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace softbody;
using namespace softbody::testing;

namespace {

const std::vector<Vec2> BENT{ { 0, 0 }, { 1, 0 }, { 2, 1 }, { 3, 1 } };
const std::vector<Real> WIDTHS{ Real(0.4), Real(0.3), Real(0.2), Real(0.2) };

} // namespace

TEST_CASE("a path is divided into equal parts") {
	const std::vector<Vec2> points = divide_path(std::vector<Vec2>{ { 0, 0 }, { 3, 0 }, { 3, 3 } }, 4).value();
	REQUIRE(points.size() == 4);
	CHECK(distance(points[1], { 2, 0 }) < 4 * EPSILON);
	CHECK(distance(points[2], { 3, 1 }) < 4 * EPSILON);
	CHECK(points[3] == Vec2{ 3, 3 });
}

TEST_CASE("a rope has two hull points and a center for each point of its path") {
	const auto shape = create_rope(BENT, WIDTHS, 2).value();
	REQUIRE(shape->chain() != nullptr);
	const ChainShape &chain = *shape->chain();
	CHECK(shape->hull_count() == 8);
	CHECK(shape->point_count() == 12);
	CHECK(chain.count() == 4);
	CHECK(signed_area(shape->rest_hull()) > 0);
	for (std::size_t i = 0; i < 4; ++i) {
		const auto [left, right, center] = chain.sections()[i];
		const Vec2 place = shape->rest_positions()[center] + shape->origin_offset();
		CHECK(distance(place, BENT[i]) < 8 * EPSILON);
		CHECK(distance((shape->rest_positions()[left] + shape->rest_positions()[right]) * Real(0.5), shape->rest_positions()[center]) < 8 * EPSILON);
		CHECK(distance(shape->rest_positions()[left], shape->rest_positions()[right]) == doctest::Approx(double(WIDTHS[i])).epsilon(1e-5));
		CHECK(chain.section_of(left) == i);
		CHECK(chain.section_of(center) == i);
	}
	CHECK(double(chain.total_length()) == doctest::Approx(2 + std::sqrt(2.0)).epsilon(1e-6));
	CHECK(double(shape->total_mass()) == doctest::Approx(2).epsilon(1e-6));
	// The first link is wider than the last, and longer than neither: its end is heavier.
	CHECK(chain.masses()[0] > chain.masses()[3]);
}

TEST_CASE("a mirrored outline makes the same rope, reversed about its first point") {
	std::vector<Vec2> outline = rope_outline(BENT, WIDTHS).value();
	std::vector<Vec2> path = BENT;
	for (std::vector<Vec2> *points : { &outline, &path }) {
		for (Vec2 &p : *points) {
			p.y = -p.y;
		}
	}
	const auto shape = create_rope_in(outline, path, 2).value();
	CHECK(signed_area(shape->rest_hull()) > 0);
	for (std::size_t i = 0; i < 4; ++i) {
		const auto [left, right, center] = shape->chain()->sections()[i];
		CHECK(distance(shape->rest_positions()[left] + shape->origin_offset(), outline[i]) < 8 * EPSILON);
		CHECK(distance(shape->rest_positions()[right] + shape->origin_offset(), outline[7 - i]) < 8 * EPSILON);
		CHECK(distance(shape->rest_positions()[center] + shape->origin_offset(), path[i]) < 8 * EPSILON);
	}
	CHECK(std::ranges::equal(shape->chain()->masses(), create_rope(BENT, WIDTHS, 2).value()->chain()->masses()));
}

TEST_CASE("a resized rope has links and widths of the new size") {
	const auto shape = create_rope(BENT, WIDTHS, 2).value()->resized(3, 5).value();
	CHECK(double(shape->chain()->total_length()) == doctest::Approx(3 * (2 + std::sqrt(2.0))).epsilon(1e-5));
	CHECK(double(std::abs(shape->chain()->half_widths()[0])) == doctest::Approx(0.6).epsilon(1e-5));
	CHECK(double(std::accumulate(shape->chain()->masses().begin(), shape->chain()->masses().end(), Real(0))) == doctest::Approx(5).epsilon(1e-5));
}

TEST_CASE("what cannot be a rope is refused by name") {
	const auto refused = [](std::vector<Vec2> path, std::vector<Real> widths, Real mass = 1) {
		const auto made = create_rope(path, widths, mass);
		return made ? std::string("accepted") : made.error().name;
	};
	CHECK(refused({ { 0, 0 } }, { 1 }) == "path");
	CHECK(refused({ { 0, 0 }, { 0, 0 } }, { 1, 1 }) == "path");
	CHECK(refused({ { 0, 0 }, { NOT_A_NUMBER, 0 } }, { 1, 1 }) == "path[1]");
	CHECK(refused({ { 0, 0 }, { 1, 0 } }, { 1 }) == "widths");
	CHECK(refused({ { 0, 0 }, { 1, 0 } }, { 1, 0 }) == "widths[1]");
	CHECK(refused({ { 0, 0 }, { 1, 0 } }, { 1, NOT_A_NUMBER }) == "widths[1]");
	CHECK(refused({ { 0, 0 }, { 1, 0 } }, { 1, 1 }, 0) == "mass");
	CHECK(refused({ { 0, 0 }, { 3, 0 }, { 3, 2 }, { 1, 2 }, { 1, -2 } }, std::vector<Real>(5, Real(0.1))) == "path"); // crosses itself
	CHECK(refused({ { 0, 0 }, { 1, 0 }, { Real(0.1), Real(0.01) } }, std::vector<Real>(3, Real(0.5))) == "path"); // bends back
	CHECK(divide_path(BENT, 1).error().name == "point_count");
	CHECK(divide_path(std::vector<Vec2>{ { 1, 1 }, { 1, 1 } }, 3).error().name == "path");
	SoftBodyShape::Description bad;
	bad.points = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { Real(0.5), Real(0.5) } };
	bad.masses.assign(5, 1);
	bad.hull_count = 4;
	bad.chain = { { 0, 3, 4 } };
	CHECK(SoftBodyShape::create(bad).error().name == "chain");
	bad.chain = { { 0, 3, 4 }, { 1, 2, 4 } };
	CHECK(SoftBodyShape::create(bad).error().name == "chain[1]");
	bad.chain = { { 0, 3, 4 }, { 1, 9, 4 } };
	CHECK(SoftBodyShape::create(bad).error().name == "chain[1]");
	BodySettings settings;
	settings.axial_stiffness = 0;
	CHECK(check_settings(settings)->name == "axial_stiffness");
	settings.axial_stiffness = INFINITE;
	CHECK(!check_settings(settings));
	settings.rest_bend = 2;
	CHECK(check_settings(settings)->name == "rest_bend");
}
