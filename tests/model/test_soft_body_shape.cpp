// SPDX-License-Identifier: MIT
// Claims about the immutable structure of a body: its derived measures, its frequency bound, its refusals.
#include "core/model/soft_body_shape.h"
#include "model/spring_hessian.h"
#include "scenes/thesis_body.h"
#include "support/compare.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <functional>

using namespace softbody;
using namespace softbody::testing;

namespace {

// A 4 x 3 rectangle with one inner point, unequal masses, and two springs.
SoftBodyShape::Description rectangle() {
	SoftBodyShape::Description description;
	description.points = { { 10, 20 }, { 14, 20 }, { 14, 23 }, { 10, 23 }, { 11, 21 } };
	description.masses = { 1, 2, 3, 4, 6 };
	description.hull_count = 4;
	description.springs = { { 0, 1, 4, 100, 1 }, { 1, 4, 3, 50, 2 } };
	return description;
}

} // namespace

TEST_CASE("a shape is stored about its center of mass, with area, inertia and radius to match") {
	const auto shape = SoftBodyShape::create(rectangle()).value();
	const auto description = rectangle();
	// Means weighted by 1, 2, 3, 4, 6 of 16.
	const Vec2 center{ Real((10 + 28 + 42 + 40 + 66) / 16.0), Real((20 + 40 + 69 + 92 + 126) / 16.0) };
	CHECK(distance(shape->origin_offset(), center) <= EPSILON * 24);
	CHECK(shape->total_mass() == 16);
	CHECK(shape->rest_area() == 12);
	CHECK(shape->point_count() == 5);
	CHECK(shape->hull_count() == 4);
	CHECK(shape->rest_hull().size() == 4);
	double x = 0;
	double y = 0;
	double inertia = 0;
	double radius = 0;
	for (std::size_t i = 0; i < 5; ++i) {
		const Vec2 q = shape->rest_positions()[i];
		CHECK(distance(q + center, description.points[i]) <= 2 * EPSILON * 24);
		const double mass = description.masses[i];
		CHECK(shape->masses()[i] == description.masses[i]);
		x += mass * q.x;
		y += mass * q.y;
		const double reach = distance(description.points[i], center);
		inertia += mass * reach * reach;
		radius = std::fmax(radius, reach);
	}
	CHECK(std::abs(x) <= 16 * EPSILON * 24); // every coordinate near 24 was rounded once
	CHECK(std::abs(y) <= 16 * EPSILON * 24);
	CHECK(relative_error(shape->rest_inertia(), inertia) <= 8 * EPSILON * 24);
	CHECK(relative_error(shape->radius(), radius) <= 8 * EPSILON * 24);
}

TEST_CASE("the frequency bound of the thesis body is (13 + sqrt 41)/2 k/m") {
	// The signless Laplacian of a wheel with 8 spokes, on vectors equal along the rim, is ((8, 8), (1, 5)):
	// λ² - 13 λ + 32 = 0. The iteration approaches the root from above.
	const double root = (13 + std::sqrt(41.0)) / 2;
	const Real k = 450;
	const Real c = 7;
	const auto shape = thesis_shape(k, c);
	const double mass = 1.0 / 9;
	CHECK(shape->spring_frequency_squared() >= root * k / mass * (1 - 8 * EPSILON));
	CHECK(shape->spring_frequency_squared() <= root * k / mass * 1.001);
	CHECK(shape->spring_damping_rate() >= root * c / mass * (1 - 8 * EPSILON));
	CHECK(shape->spring_damping_rate() <= root * c / mass * 1.001);
}

namespace {

// The chain 0-1-4 of `rectangle` with masses 1, 2 and 6 kg: largest eigenvalue of its mass-weighted
// Laplacian. A chain is bipartite, so the signless one has the same.
double chain_frequency_squared(double first, double second) {
	// λ³ - tr λ² + minors λ = 0, one root being 0 (rigid motion).
	const double trace = first + (first + second) / 2 + second / 6;
	const double minors = first * second / 2 + first * second / 6 + first * second / 12;
	return (trace + std::sqrt(trace * trace - 4 * minors)) / 2;
}

bool is_just_above(double bound, double value) {
	return bound >= value * (1 - 8 * EPSILON) && bound <= value * 1.01;
}

} // namespace

TEST_CASE("the frequency bound is that of the chain for unequal masses and stiffnesses") {
	const auto shape = SoftBodyShape::create(rectangle()).value();
	CHECK(is_just_above(shape->spring_frequency_squared(), chain_frequency_squared(100, 50)));
	CHECK(is_just_above(shape->spring_damping_rate(), chain_frequency_squared(1, 2)));
	auto free = rectangle();
	free.springs.clear();
	CHECK(SoftBodyShape::create(free).value()->spring_frequency_squared() == 0);
	CHECK(SoftBodyShape::create(free).value()->spring_damping_rate() == 0);
}

TEST_CASE("the highest frequency of the thesis body at rest is the known 5.12 k/m") {
	// From an independent eigenvalue computation (docs: 5.12); two decimals are known.
	const auto shape = thesis_shape(1);
	CHECK(std::abs(largest_frequency_squared(*shape, copy_of(shape->rest_positions())) * (1.0 / 9) - 5.12) <= 0.005);
}

TEST_CASE("no deformation has a frequency above the bound") {
	Random random(31);
	double highest = 0;
	for (int i = 0; i < 100; ++i) {
		auto shape = thesis_shape(100);
		if (i % 2 == 1) { // unequal masses and stiffnesses
			SoftBodyShape::Description description;
			description.points = copy_of(shape->rest_positions());
			description.hull_count = shape->hull_count();
			for (std::size_t k = 0; k < shape->point_count(); ++k) {
				description.masses.push_back(random.real(0.1, 2));
			}
			for (Spring2D spring : shape->springs()) {
				spring.stiffness = random.real(10, 500);
				description.springs.push_back(spring);
			}
			shape = SoftBodyShape::create(description).value();
		}
		std::vector<Vec2> positions = copy_of(shape->rest_positions());
		for (Vec2 &p : positions) {
			p += random.vector(i < 20 ? 0.05 : 1.5);
		}
		const double share = largest_frequency_squared(*shape, positions) / double(shape->spring_frequency_squared());
		highest = std::fmax(highest, share);
	}
	// The numeric Hessian is good to about 1e-6 of its size.
	CHECK(highest <= 1 + 1e-5);
	CHECK(highest > 0.6); // and the bound is not wasteful: 8.57 of 9.7 is known to occur
}

TEST_CASE("everything that cannot be a body is refused by name") {
	struct Case {
		std::vector<std::string> parts;
		std::function<void(SoftBodyShape::Description &)> spoil;
	};
	const std::vector<Case> cases{
		{ { "hull_count" }, [](auto &d) { d.hull_count = 6; } },
		{ { "hull", "2 points" }, [](auto &d) { d.hull_count = 2; } },
		{ { "hull", "intersect" }, [](auto &d) { std::swap(d.points[0], d.points[1]); } },
		{ { "hull", "winding" }, [](auto &d) { std::swap(d.points[1], d.points[3]); } },
		{ { "hull[1]", "finite" }, [](auto &d) { d.points[1].x = NOT_A_NUMBER; } },
		{ { "points[4]", "nan", "finite" }, [](auto &d) { d.points[4].y = NOT_A_NUMBER; } },
		{ { "points[4]", "inf", "finite" }, [](auto &d) { d.points[4].x = INFINITE; } },
		{ { "masses", "4 entries", "5" }, [](auto &d) { d.masses.pop_back(); } },
		{ { "masses", "6 entries" }, [](auto &d) { d.masses.push_back(1); } },
		{ { "masses[2]", "0" }, [](auto &d) { d.masses[2] = 0; } },
		{ { "masses[4]", "-1" }, [](auto &d) { d.masses[4] = -1; } },
		{ { "masses[0]", "nan" }, [](auto &d) { d.masses[0] = NOT_A_NUMBER; } },
		{ { "springs[1]", "below 5" }, [](auto &d) { d.springs[1].a = 5; } },
		{ { "springs[0]", "below 5" }, [](auto &d) { d.springs[0].b = 5; } },
		{ { "springs[1]", "point 4 twice" }, [](auto &d) { d.springs[1].a = 4; } },
		{ { "springs[2]", "repeat spring 0" }, [](auto &d) { d.springs.push_back({ 0, 1, 2, 1, 1 }); } },
		{ { "springs[2]", "repeat spring 1" }, [](auto &d) { d.springs.push_back({ 4, 1, 2, 1, 1 }); } },
		{ { "springs[0].rest_length", "> 0" }, [](auto &d) { d.springs[0].rest_length = 0; } },
		{ { "springs[0].rest_length", "nan" }, [](auto &d) { d.springs[0].rest_length = NOT_A_NUMBER; } },
		{ { "springs[1].stiffness", "-1" }, [](auto &d) { d.springs[1].stiffness = -1; } },
		{ { "springs[1].stiffness", "inf" }, [](auto &d) { d.springs[1].stiffness = INFINITE; } },
		{ { "springs[1].damping", "-1" }, [](auto &d) { d.springs[1].damping = -1; } },
		{ { "springs[0].damping", "nan" }, [](auto &d) { d.springs[0].damping = NOT_A_NUMBER; } },
	};
	for (const Case &bad : cases) {
		auto description = rectangle();
		bad.spoil(description);
		const auto result = SoftBodyShape::create(description);
		REQUIRE_FALSE(result.has_value());
		CAPTURE(result.error().message());
		for (const std::string &part : bad.parts) {
			CAPTURE(part);
			CHECK(mentions(result.error().message(), part));
		}
	}
	CHECK(SoftBodyShape::create(rectangle()).has_value());
}

TEST_CASE("springs of zero stiffness and damping are allowed, and so is every spring once") {
	auto description = rectangle();
	description.springs = { { 0, 1, 1, 0, 0 }, { 2, 1, 1, 0, 0 }, { 0, 2, 1, 0, 0 }, { 4, 3, 1, 0, 0 } };
	CHECK(SoftBodyShape::create(description).has_value());
}

// Of a shape that was resized and one that was made at that size: all derived values.
void check_same(const SoftBodyShape &resized, const SoftBodyShape &made) {
	const Real tolerance = 64 * EPSILON;
	REQUIRE(resized.point_count() == made.point_count());
	for (std::size_t i = 0; i < made.point_count(); ++i) {
		CHECK(length(resized.rest_positions()[i] - made.rest_positions()[i]) <= tolerance * made.radius());
		CHECK(relative_error(resized.masses()[i], made.masses()[i]) <= tolerance);
	}
	for (std::size_t i = 0; i < made.springs().size(); ++i) {
		CHECK(relative_error(resized.springs()[i].rest_length, made.springs()[i].rest_length) <= tolerance);
		CHECK(resized.springs()[i].stiffness == made.springs()[i].stiffness);
	}
	CHECK(length(resized.origin_offset() - made.origin_offset()) <= tolerance * made.radius());
	CHECK(relative_error(resized.total_mass(), made.total_mass()) <= tolerance);
	CHECK(relative_error(resized.rest_area(), made.rest_area()) <= tolerance);
	CHECK(relative_error(resized.rest_inertia(), made.rest_inertia()) <= tolerance);
	CHECK(relative_error(resized.width(), made.width()) <= tolerance);
	CHECK(relative_error(resized.radius(), made.radius()) <= tolerance);
	CHECK(relative_error(resized.shortest_hull_edge(), made.shortest_hull_edge()) <= tolerance);
	CHECK(relative_error(resized.area_inverse_mass(), made.area_inverse_mass()) <= tolerance);
	CHECK(relative_error(1 + resized.spring_frequency_squared(), 1 + made.spring_frequency_squared()) <= tolerance);
}

std::vector<Vec2> enlarged(std::vector<Vec2> points, Real factor) {
	for (Vec2 &point : points) {
		point *= factor;
	}
	return points;
}

// An outline without symmetry, off the origin, wound positively.
const std::vector<Vec2> UNEVEN = { { 10, 5 }, { 60, 0 }, { 90, 30 }, { 70, 55 }, { 75, 90 }, { 30, 80 }, { 0, 40 } };

TEST_CASE("a resized shape is the shape that is made at that size, for springs, modes and triangles") {
	for (const Real factor : { Real(0.02), Real(0.5), Real(3) }) {
		for (const int model : { 0, 1, 2 }) {
			CAPTURE(factor);
			CAPTURE(model);
			StructureOptions options;
			options.mass = 2;
			options.elastic = model == 1;
			options.elastic_triangles = model == 2;
			const auto small = SoftBodyCreator::create_polygon(UNEVEN, options).value();
			options.mass = 5;
			const auto made = SoftBodyCreator::create_polygon(enlarged(UNEVEN, factor), options).value();
			const auto resized = small->resized(factor, 5).value();
			check_same(*resized, *made);
			CHECK((resized->modes() == nullptr) == (model != 1));
			CHECK((resized->triangles() == nullptr) == (model != 2));
			if (model == 1) {
				// The eigenvectors of two eigenproblems may differ in sign; their products with lengths do not.
				for (std::size_t j = 0; j < made->modes()->count; ++j) {
					CHECK(relative_error(resized->modes()->stiffness[j][1], made->modes()->stiffness[j][1]) <= Real(1e-3));
					CHECK(std::abs(std::abs(resized->modes()->dilation_overlap[j]) - std::abs(made->modes()->dilation_overlap[j])) <=
							Real(1e-3) * made->radius());
				}
				for (std::size_t i = 0; i < made->hull_count(); ++i) {
					CHECK(length(resized->modes()->dilation[i] - made->modes()->dilation[i]) * made->radius() <= Real(1e-4));
				}
			}
			if (model == 2) {
				REQUIRE(resized->triangles()->triangles.size() == made->triangles()->triangles.size());
				for (std::size_t i = 0; i < made->triangles()->triangles.size(); ++i) {
					const ElasticTriangle &a = resized->triangles()->triangles[i];
					const ElasticTriangle &b = made->triangles()->triangles[i];
					CHECK(relative_error(a.area, b.area) <= Real(1e-3));
					CHECK(length(a.gradients[0] - b.gradients[0]) <= Real(1e-3) * length(b.gradients[0]));
					CHECK(length(a.gradients[1] - b.gradients[1]) <= Real(1e-3) * length(b.gradients[1]));
				}
				CHECK(relative_error(resized->triangle_shear_inverse_mass(), made->triangle_shear_inverse_mass()) <= Real(1e-3));
				CHECK(relative_error(resized->triangle_dilation_inverse_mass(), made->triangle_dilation_inverse_mass()) <= Real(1e-3));
			}
			for (const Real bad : { Real(0), Real(-1), NOT_A_NUMBER, INFINITE }) {
				CHECK(small->resized(bad, 1).error().name == "factor");
			}
		}
	}
}

TEST_CASE("another total mass scales every mass, the inertia, and the frequency bound inversely") {
	const auto shape = SoftBodyShape::create(rectangle()).value();
	const auto other = shape->resized(1, 4).value();
	CHECK(relative_error(other->total_mass(), 4) <= 4 * EPSILON);
	for (std::size_t i = 0; i < 5; ++i) {
		CHECK(relative_error(other->masses()[i], shape->masses()[i] / 4) <= 2 * EPSILON);
	}
	CHECK(relative_error(other->rest_inertia(), shape->rest_inertia() / 4) <= 16 * EPSILON);
	CHECK(relative_error(other->spring_frequency_squared(), shape->spring_frequency_squared() * 4) <= 8 * EPSILON);
	CHECK(shape->total_mass() == 16);
	for (const Real bad : { Real(0), Real(-1), NOT_A_NUMBER, INFINITE }) {
		CHECK(shape->resized(1, bad).error().name == "mass");
	}
}
