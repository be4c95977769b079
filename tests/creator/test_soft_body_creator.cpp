// SPDX-License-Identifier: MIT
// Claims about the structures that are put inside an outline.
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "thesis/damping_ratio.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <set>

using namespace softbody;
using namespace softbody::testing;

namespace {

const std::vector<Vec2> L_SHAPE{ { 0, 0 }, { 4, 0 }, { 4, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };

// A rest position in the coordinates that the outline was given in.
Vec2 original(const SoftBodyShape &shape, std::size_t i) {
	return shape.rest_positions()[i] + shape.origin_offset();
}

} // namespace

TEST_CASE("the thesis's test body has nine points, eight hull springs and eight centre springs") {
	const auto shape = thesis_shape(100, 2);
	CHECK(shape->hull_count() == 8);
	CHECK(shape->point_count() == 9);
	REQUIRE(shape->springs().size() == 16);
	std::set<std::pair<unsigned, unsigned>> pairs;
	const double chord = 2 * 0.5 * std::sin(std::numbers::pi / 8);
	for (const Spring2D &spring : shape->springs()) {
		pairs.insert(std::minmax(spring.a, spring.b));
		const bool to_center = std::max(spring.a, spring.b) == 8;
		CHECK(std::abs(double(spring.rest_length) - (to_center ? 0.5 : chord)) <= 4 * EPSILON);
		CHECK(spring.stiffness == 100);
		CHECK(spring.damping == 2);
	}
	for (unsigned i = 0; i < 8; ++i) {
		CHECK(pairs.count(std::minmax(i, (i + 1) % 8)) == 1);
		CHECK(pairs.count({ i, 8 }) == 1);
	}
	for (const Real mass : shape->masses()) {
		CHECK(std::abs(double(mass) - 1.0 / 9) <= EPSILON);
	}
	CHECK(relative_error(shape->total_mass(), 1) <= 4 * EPSILON);
	CHECK(shape->rest_area() > 0);
	CHECK(distance(shape->rest_positions()[8], {}) <= EPSILON); // the center point, on the center of mass
}

TEST_CASE("springs are at rest in the shape they are made for, whatever the outline") {
	for (const bool center_point : { true, false }) {
		const auto shape = SoftBodyCreator::create_polygon(L_SHAPE, { 3, 10, 1, center_point }).value();
		CHECK(shape->springs().size() == (center_point ? 12 : 6));
		CHECK(shape->point_count() == (center_point ? 7 : 6));
		for (const Spring2D &spring : shape->springs()) {
			const double now = distance(shape->rest_positions()[spring.a], shape->rest_positions()[spring.b]);
			CHECK(std::abs(now - spring.rest_length) <= 4 * EPSILON * 5);
		}
		double sum = 0;
		for (const Real mass : shape->masses()) {
			sum += mass;
			CHECK(mass == shape->masses()[0]);
		}
		CHECK(relative_error(sum, 3) <= 8 * EPSILON);
		CHECK(shape->rest_area() == 6);
	}
}

TEST_CASE("the center point is the mean of the hull points") {
	const auto shape = SoftBodyCreator::create_polygon(L_SHAPE, {}).value();
	CHECK(distance(original(*shape, 6), { Real(10.0 / 6), Real(8.0 / 6) }) <= 4 * EPSILON * 2);
}

TEST_CASE("an outline of negative winding is reversed about its first point") {
	const std::size_t n = L_SHAPE.size();
	std::vector<Vec2> clockwise(n);
	for (std::size_t i = 0; i < n; ++i) {
		clockwise[i] = L_SHAPE[(n - i) % n];
	}
	const auto forward = SoftBodyCreator::create_polygon(L_SHAPE, {}).value();
	const auto reversed = SoftBodyCreator::create_polygon(clockwise, {}).value();
	CHECK(reversed->rest_area() == forward->rest_area());
	for (std::size_t i = 0; i < n; ++i) {
		CHECK(distance(original(*reversed, (n - i) % n), clockwise[i]) <= 4 * EPSILON * 4);
		CHECK(distance(original(*reversed, i), original(*forward, i)) <= 4 * EPSILON * 4);
	}
}

TEST_CASE("a positive outline keeps its order") {
	const auto shape = SoftBodyCreator::create_polygon(L_SHAPE, {}).value();
	for (std::size_t i = 0; i < L_SHAPE.size(); ++i) {
		CHECK(distance(original(*shape, i), L_SHAPE[i]) <= 4 * EPSILON * 4);
	}
}

TEST_CASE("bad outlines and material values are refused by name") {
	for (const Real bad : { Real(-1), NOT_A_NUMBER, INFINITE }) {
		CHECK(SoftBodyCreator::create_polygon(L_SHAPE, { bad, 1, 1, true }).error().name == "mass");
		CHECK(SoftBodyCreator::create_polygon(L_SHAPE, { 1, bad, 1, true }).error().name == "stiffness");
		CHECK(SoftBodyCreator::create_polygon(L_SHAPE, { 1, 1, bad, true }).error().name == "damping");
	}
	CHECK(SoftBodyCreator::create_polygon(L_SHAPE, { 0, 1, 1, true }).error().name == "mass");
	CHECK(SoftBodyCreator::create_polygon(L_SHAPE, { 1, 0, 0, true }).has_value());
	const std::vector<Vec2> bow{ { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 } };
	CHECK(SoftBodyCreator::create_polygon(bow, {}).error().name == "hull");
	CHECK(SoftBodyCreator::create_polygon({}, {}).error().name == "hull");
	CHECK(circle_shape(-1, 8, {}).error().name == "radius");
	CHECK(circle_shape(1, 2, {}).error().name == "point_count");
}

TEST_CASE("a hull point at the mean of all is refused by its index, unless there is no center point") {
	// The mean of these four is (0, 0), which is the third: a chevron.
	const std::vector<Vec2> simple{ { -3, -3 }, { 3, -3 }, { 0, 0 }, { 0, 6 } };
	const auto result = SoftBodyCreator::create_polygon(simple, {});
	REQUIRE_FALSE(result.has_value());
	CHECK(result.error().name == "hull[2]");
	CHECK(mentions(result.error().message(), "center"));
	CHECK(SoftBodyCreator::create_polygon(simple, { 1, 1, 1, false }).has_value());
}

TEST_CASE("inner points follow the hull, before the center point, and share the mass evenly") {
	StructureOptions options{ 8, 10, 1, true };
	options.inner_points = { { Real(0.5), Real(0.5) } };
	const auto shape = SoftBodyCreator::create_polygon(L_SHAPE, options).value();
	REQUIRE(shape->point_count() == 8);
	CHECK(distance(original(*shape, 6), { Real(0.5), Real(0.5) }) <= 8 * EPSILON);
	CHECK(distance(original(*shape, 7), { Real(10.0 / 6), Real(8.0 / 6) }) <= 8 * EPSILON);
	for (const Real mass : shape->masses()) {
		CHECK(mass == 1);
	}
}

TEST_CASE("given springs are all there are, joined to the points as they were given in either winding") {
	const std::size_t n = L_SHAPE.size();
	std::vector<Vec2> clockwise(n);
	for (std::size_t i = 0; i < n; ++i) {
		clockwise[i] = L_SHAPE[(n - i) % n];
	}
	StructureOptions options{ 1, 10, 2, false };
	options.inner_points = { { Real(0.25), 2 } };
	options.springs = { { 5, 6 }, { 1, 3 }, { 0, 6 } };
	options.spring_stiffness_scales = { 1, 2, Real(0.5) };
	options.spring_damping_scales = { 0, 1, 3 };
	options.spring_length_scales = { 1, Real(1.5), 1 };
	for (const std::vector<Vec2> &outline : { L_SHAPE, clockwise }) {
		std::vector<Vec2> given = outline;
		given.push_back(options.inner_points[0]);
		const auto shape = SoftBodyCreator::create_polygon(outline, options).value();
		REQUIRE(shape->springs().size() == 3);
		for (std::size_t i = 0; i < 3; ++i) {
			const Spring2D &spring = shape->springs()[i];
			const Vec2 a = given[options.springs[i][0]];
			const Vec2 b = given[options.springs[i][1]];
			CHECK(distance(original(*shape, spring.a), a) <= 16 * EPSILON);
			CHECK(distance(original(*shape, spring.b), b) <= 16 * EPSILON);
			CHECK(spring.stiffness == 10 * options.spring_stiffness_scales[i]);
			CHECK(spring.damping == 2 * options.spring_damping_scales[i]);
			CHECK(relative_error(spring.rest_length, distance(a, b) * options.spring_length_scales[i]) <= 4 * EPSILON);
		}
	}
}

TEST_CASE("scales count the automatic springs in the order of the outline, in either winding") {
	for (const Real up : { Real(1), Real(-1) }) {
		const std::vector<Vec2> outline{ { 0, 0 }, { 4, 0 }, { 4, 3 * up }, { 0, 3 * up } };
		StructureOptions options{ 1, 10, 2, false };
		options.spring_stiffness_scales = { 1, 2, 3, 4 };
		const auto shape = SoftBodyCreator::create_polygon(outline, options).value();
		for (std::size_t i = 0; i < 4; ++i) {
			const Spring2D &spring = shape->springs()[i];
			CHECK(spring.stiffness == Real(10 * (i + 1)));
			CHECK(distance(original(*shape, spring.a), outline[i]) <= 8 * EPSILON);
			CHECK(distance(original(*shape, spring.b), outline[(i + 1) % 4]) <= 8 * EPSILON);
		}
	}
}

TEST_CASE("a bad structure is refused by the name of what is wrong with it") {
	const auto refused = [](const auto &spoil) {
		StructureOptions options{ 1, 10, 1, false };
		options.inner_points = { { Real(0.5), Real(0.5) } };
		options.springs = { { 0, 1 }, { 0, 6 } };
		spoil(options);
		const auto result = SoftBodyCreator::create_polygon(L_SHAPE, options);
		return result ? std::string() : result.error().name;
	};
	CHECK(refused([](StructureOptions &) {}) == "");
	CHECK(refused([](StructureOptions &o) { o.springs[1] = { 0, 7 }; }) == "springs[1]");
	CHECK(refused([](StructureOptions &o) { o.springs[1] = { 3, 3 }; }) == "springs[1]");
	CHECK(refused([](StructureOptions &o) { o.springs[1] = { 1, 0 }; }) == "springs[1]");
	CHECK(refused([](StructureOptions &o) { o.inner_points[0] = L_SHAPE[0]; }) == "springs[1]");
	CHECK(refused([](StructureOptions &o) { o.inner_points[0].y = NOT_A_NUMBER; }) == "inner_points[0]");
	CHECK(refused([](StructureOptions &o) { o.inner_points.resize(MAX_HULL_POINTS + 1); }) == "inner_points");
	CHECK(refused([](StructureOptions &o) { o.spring_stiffness_scales = { 1 }; }) == "spring_stiffness_scales");
	CHECK(refused([](StructureOptions &o) { o.spring_damping_scales = { 1, 2, 3 }; }) == "spring_damping_scales");
	CHECK(refused([](StructureOptions &o) { o.spring_length_scales = { 1 }; }) == "spring_length_scales");
	CHECK(refused([](StructureOptions &o) { o.spring_stiffness_scales = { 1, -1 }; }) == "spring_stiffness_scales[1]");
	CHECK(refused([](StructureOptions &o) { o.spring_damping_scales = { INFINITE, 1 }; }) == "spring_damping_scales[0]");
	CHECK(refused([](StructureOptions &o) { o.spring_length_scales = { 1, 0 }; }) == "spring_length_scales[1]");
	CHECK(refused([](StructureOptions &o) { o.spring_stiffness_scales = { 0, 0 }; }) == "");
}

TEST_CASE("a damping ratio is c over sqrt(k m)") {
	// k = 100, m = 9/9 = 1: c = 0.05 * 10.
	CHECK(relative_error(damping_for_ratio(Real(0.05), 100, 9, 9), 0.5) <= 2 * EPSILON);
	CHECK(relative_error(damping_for_ratio(1, 50, 4, 2), 10) <= 2 * EPSILON);
	CHECK(damping_for_ratio(0, 50, 4, 2) == 0);
}

TEST_CASE("spring pairs that no structure can have are refused by the first of them") {
	using Indices = std::vector<std::int32_t>;
	CHECK(!check_spring_pairs("springs", Indices{}));
	CHECK(!check_spring_pairs("springs", Indices{ 0, 1, 1, 2 }));
	CHECK(check_spring_pairs("springs", Indices{ 0, 1, 2 })->name == "springs");
	CHECK(check_spring_pairs("springs", Indices{ 0, 1, -1, 2 })->name == "springs[1]");
	CHECK(check_spring_pairs("springs", Indices{ 0, 1, 2, 2 })->name == "springs[1]");
	CHECK(check_spring_pairs("springs", Indices{ 0, 1, 2, 3, 1, 0 })->value == "points 0 and 1 twice");
}

TEST_CASE("a refused part of a structure is left out, and factors with the springs that they belong to") {
	StructureOptions options;
	options.springs = { { 0, 1 } };
	options.spring_stiffness_scales = { 2 };
	options.spring_damping_scales = { 2 };
	options.spring_length_scales = { 2 };
	CHECK(leave_out(options, "spring_damping_scales[0]"));
	CHECK(options.spring_damping_scales.empty());
	CHECK_FALSE(leave_out(options, "spring_damping_scales"));
	CHECK_FALSE(leave_out(options, "springs[0].stiffness"));
	CHECK_FALSE(leave_out(options, "hull"));
	CHECK(options.spring_length_scales.size() == 1);
	CHECK(leave_out(options, "springs[0]"));
	CHECK(options == StructureOptions{});
	CHECK_FALSE(leave_out(options, "springs[0]"));
}
