// SPDX-License-Identifier: MIT
// The elastic modes of an outline, against exact frequencies and finite elements.
#include "core/creator/elastic_modes.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace softbody;

namespace {

std::vector<Vec2> with_center(std::vector<Vec2> hull) {
	Vec2 mean;
	for (const Vec2 p : hull) {
		mean += p * (1 / Real(hull.size()));
	}
	hull.push_back(mean);
	return hull;
}

// Each edge of an outline in equal pieces.
std::vector<Vec2> divided(const std::vector<Vec2> &corners, const std::vector<int> &pieces) {
	std::vector<Vec2> points;
	for (std::size_t i = 0; i < corners.size(); ++i) {
		const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
		for (int k = 0; k < pieces[i]; ++k) {
			points.push_back(corners[i] + edge * (Real(k) / Real(pieces[i])));
		}
	}
	return points;
}

const std::vector<Vec2> L_CORNERS = { { 0, 0 }, { 100, 0 }, { 100, 40 }, { 40, 40 }, { 40, 100 }, { 0, 100 } };

ElasticReduction reduced(const std::vector<Vec2> &hull) {
	return reduce_solid(with_center(hull), hull.size());
}

// Square of the lowest frequency, times the mass, over the shear modulus, at Poisson's ratio 0.45.
double lowest(const ElasticReduction &reduction) {
	return double(reduction.modes->stiffness[0][2]);
}

} // namespace

TEST_CASE("the lowest frequency of a disk is the root of Bessel's equation, whatever the number of its points") {
	// Free disk in plane strain, two waves around, ν = 0.45: k_T R = 2.35251, so that ω² m / μ = π (k_T R)² (Love 1944,
	// art. 313; solved in bench/fem/test_fem.py).
	constexpr double EXACT = 17.3865;
	for (const int count : { 8, 12, 16, 24, 32, 64, 128 }) {
		CAPTURE(count);
		CHECK(lowest(reduced(circle_hull(50, count).value())) == doctest::Approx(EXACT).epsilon(0.01));
	}
}

TEST_CASE("the stiffness of a disk's lowest mode follows Poisson's ratio as its frequency does") {
	const ElasticReduction disk = reduced(circle_hull(50, 64).value());
	// As above for ν = 0 and 0.3.
	CHECK(double(disk.modes->stiffness[0][0]) == doctest::Approx(17.1458).epsilon(0.03));
	CHECK(double(disk.modes->stiffness[0][1]) == doctest::Approx(17.3189).epsilon(0.03));
}

TEST_CASE("the lowest frequency of an L and of a box is that of finite elements, whatever the number of points") {
	// bench/fem/references.json, family "mesh": (2 π f)² m / μ.
	for (const std::vector<int> &pieces : { std::vector{ 2, 1, 1, 1, 1, 2 }, std::vector{ 4, 2, 3, 3, 2, 4 }, std::vector{ 16, 7, 10, 10, 7, 16 } }) {
		const std::vector<Vec2> hull = divided(L_CORNERS, pieces);
		CAPTURE(hull.size());
		CHECK(lowest(reduced(hull)) == doctest::Approx(1.4518).epsilon(0.03));
	}
	for (const int pieces : { 2, 4, 16 }) {
		CAPTURE(pieces);
		const std::vector<Vec2> hull = divided({ { 0, 0 }, { 80, 0 }, { 80, 80 }, { 0, 80 } }, { pieces, pieces, pieces, pieces });
		CHECK(lowest(reduced(hull)) == doctest::Approx(15.7125).epsilon(0.02));
	}
}

TEST_CASE("modes are orthonormal by mass, free of rigid motion, and keep the area") {
	const std::vector<Vec2> hull = divided(L_CORNERS, { 3, 2, 2, 2, 2, 3 });
	const std::vector<Vec2> points = with_center(hull);
	const ElasticReduction reduction = reduce_solid(points, hull.size());
	const ElasticModes &modes = *reduction.modes;
	REQUIRE(modes.count > 4);
	double sum = 0;
	Vec2 center;
	for (std::size_t i = 0; i < points.size(); ++i) {
		sum += double(reduction.mass_shares[i]);
		center += points[i] * reduction.mass_shares[i];
	}
	CHECK(sum == doctest::Approx(1).epsilon(1e-5));
	for (std::size_t a = 0; a < modes.count; ++a) {
		Vec2 momentum;
		double spin = 0;
		double area = 0;
		for (std::size_t i = 0; i < points.size(); ++i) {
			const Vec2 weighted = modes.shape_of_point(i)[a];
			momentum += weighted;
			spin += double(cross(points[i] - center, weighted)) / 100;
			if (i < hull.size()) {
				area += double(dot(modes.dilation[i], weighted)) / double(reduction.mass_shares[i]) * 100;
			}
		}
		CAPTURE(a);
		CHECK(double(length(momentum)) < 1e-4);
		CHECK(std::abs(spin) < 1e-4);
		CHECK(std::abs(area) < 2e-3);
		for (std::size_t b = 0; b <= a; ++b) {
			double product = 0;
			for (std::size_t i = 0; i < points.size(); ++i) {
				product += double(dot(modes.shape_of_point(i)[a], modes.shape_of_point(i)[b])) / double(reduction.mass_shares[i]);
			}
			CHECK(product == doctest::Approx(a == b ? 1.0 : 0.0).epsilon(1e-3));
		}
	}
}

TEST_CASE("an outline has the same modes at any size") {
	const ElasticReduction large = reduced(circle_hull(500, 16).value());
	const ElasticReduction small = reduced(circle_hull(Real(0.02), 16).value());
	REQUIRE(large.modes->count == small.modes->count);
	for (std::size_t j = 0; j < large.modes->count; ++j) {
		CHECK(double(large.modes->stiffness[j][2]) == doctest::Approx(double(small.modes->stiffness[j][2])).epsilon(1e-3));
	}
}

TEST_CASE("outlines that are hard to fill with cells have finite modes of positive stiffness") {
	const std::vector<std::vector<Vec2>> outlines = {
		{ { 0, 0 }, { 1000, 0 }, { 1000, 1 }, { 0, 1 } }, // a strip
		{ { 0, 0 }, { 100, 49 }, { 0, 50 }, { 99, 51 }, { 0, 100 } }, // a slit
		{ { 0, 0 }, { 100, 0 }, { 0, Real(0.01) } }, // a needle
		{ { 0, 0 }, { 1, 0 }, { 0, 1 } },
	};
	for (const std::vector<Vec2> &hull : outlines) {
		for (const std::vector<Vec2> &points : { hull, with_center(hull) }) {
			const ElasticReduction reduction = reduce_solid(points, hull.size());
			CHECK(reduction.modes->count > 0);
			for (const std::array<Real, 3> &stiffness : reduction.modes->stiffness) {
				for (const Real value : stiffness) {
					CHECK(std::isfinite(value));
					CHECK(value > 0);
				}
			}
			for (const Real share : reduction.mass_shares) {
				CHECK(share > 0);
			}
			for (const Vec2 shape : reduction.modes->shapes) {
				CHECK(is_finite(shape));
			}
		}
	}
}
