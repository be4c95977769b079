// SPDX-License-Identifier: MIT
#include "core/creator/balanced_masses.h"

#include "core/creator/simplify_outline.h"
#include "core/creator/soft_body_creator.h"
#include "core/geometry/polygon.h"
#include "scenes/fine_outlines.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <vector>

using namespace softbody;
using namespace softbody::testing;

namespace {

Vec2d center_of(const std::vector<Vec2> &points, const std::vector<double> &masses, double &r_mass) {
	Vec2d sum;
	r_mass = 0;
	for (std::size_t i = 0; i < points.size(); ++i) {
		sum += Vec2d(points[i]) * masses[i];
		r_mass += masses[i];
	}
	return sum * (1 / r_mass);
}

} // namespace

TEST_CASE("balanced masses have the center that is asked for, the sum that they had, and the least factors that do it") {
	int balanced = 0;
	for (int seed = 0; seed < 200; ++seed) {
		CAPTURE(seed);
		Random random(96'000 + std::uint64_t(seed));
		std::vector<Vec2> points;
		std::vector<double> before;
		const int count = random.integer(4, 40);
		for (int i = 0; i < count; ++i) {
			points.push_back(random.vector(50) + Vec2{ 300, -200 });
			before.push_back(double(random.real(0.5, 2)));
		}
		double mass = 0;
		const Vec2d old_center = center_of(points, before, mass);
		const Vec2d center = old_center + Vec2d(random.vector(8));
		std::vector<double> after = before;
		if (!balance_masses(points, center, after)) {
			CHECK(after == before);
			continue;
		}
		++balanced;
		double new_mass = 0;
		const Vec2d arm = center_of(points, after, new_mass) - center;
		CHECK(std::sqrt(dot(arm, arm)) < 1e-9);
		CHECK(new_mass == doctest::Approx(mass).epsilon(1e-12));
		for (std::size_t i = 0; i < after.size(); ++i) {
			CHECK(after[i] >= 0.25 * before[i]);
		}
		// Any other masses of that sum and center differ from these by a change d of sum and moment 0. The cost falls along none.
		const auto cost = [&](const std::vector<double> &masses) {
			double sum = 0;
			for (std::size_t i = 0; i < masses.size(); ++i) {
				sum += before[i] * (masses[i] / before[i] - 1) * (masses[i] / before[i] - 1);
			}
			return sum;
		};
		// Four points: the areas of triangles of the other three, with alternating signs, are such a change.
		const auto area = [&](std::size_t a, std::size_t b, std::size_t c) { return cross(difference(points[b], points[a]), difference(points[c], points[a])); };
		const double change[] = { area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2) };
		for (const double step : { 1e-5, -1e-5 }) {
			std::vector<double> other = after;
			for (std::size_t i = 0; i < 4; ++i) {
				other[i] += step * change[i];
			}
			CHECK(cost(other) >= cost(after));
		}
	}
	CHECK(balanced > 150);
}

TEST_CASE("masses that cannot be balanced stay as they are") {
	const std::vector<Vec2> points = { { 0, 0 }, { 10, 0 }, { 10, 10 }, { 0, 10 } };
	std::vector<double> masses(4, 1.0);
	CHECK(!balance_masses(points, { 20, 5 }, masses)); // outside of the points
	CHECK(!balance_masses(points, { 9.9, 5 }, masses)); // two of them would weigh nothing
	const std::vector<Vec2> line = { { 0, 0 }, { 5, 0 }, { 10, 0 }, { 12, 0 } };
	CHECK(!balance_masses(line, { 6, 1 }, masses));
	CHECK(masses == std::vector<double>(4, 1.0));
}

TEST_CASE("a simplified character has its center of mass in the drawn outline's area centroid, under every model") {
	const std::vector<Vec2> outline = character_outline(200);
	const SimplifiedOutline made = simplify_outline(outline, {}).value();
	for (int model = 0; model < 3; ++model) {
		CAPTURE(model);
		StructureOptions options;
		options.balanced_mass = true;
		options.elastic = model == 1;
		options.elastic_triangles = model == 2;
		const auto shape = SoftBodyCreator::create_polygon(made.hull, options);
		REQUIRE(shape);
		// Rest positions lie around the center of mass.
		const Vec2 center = area_centroid(shape.value()->rest_positions().first(made.hull.size()));
		CHECK(length(center) < 2e-3);
		CHECK(shape.value()->total_mass() == doctest::Approx(1).epsilon(1e-5));
	}
}

TEST_CASE("masses are given center, sum and moment of inertia at once, or at least the center") {
	int all = 0;
	for (int seed = 0; seed < 200; ++seed) {
		CAPTURE(seed);
		Random random(12'000 + std::uint64_t(seed));
		std::vector<Vec2> points;
		std::vector<double> masses;
		for (int i = 0, count = random.integer(6, 40); i < count; ++i) {
			points.push_back(random.vector(50) + Vec2{ 300, -200 });
			masses.push_back(double(random.real(0.5, 2)));
		}
		double mass = 0;
		const Vec2d center = center_of(points, masses, mass) + Vec2d(random.vector(3));
		const auto inertia = [&] {
			double sum = 0;
			for (std::size_t i = 0; i < points.size(); ++i) {
				sum += masses[i] * dot(Vec2d(points[i]) - center, Vec2d(points[i]) - center);
			}
			return sum;
		};
		const std::vector<double> before = masses;
		const double wanted = inertia() * double(random.real(0.7, 1.2));
		if (!give_moments(points, points.size(), { 7, center, 7 * wanted / mass }, masses)) {
			CHECK(masses == before);
			continue;
		}
		double new_mass = 0;
		const Vec2d arm = center_of(points, masses, new_mass) - center;
		CHECK(std::sqrt(dot(arm, arm)) < 1e-8);
		CHECK(new_mass == doctest::Approx(mass).epsilon(1e-10));
		all += std::abs(inertia() / wanted - 1) < 1e-9 ? 1 : 0;
		CHECK(*std::ranges::min_element(masses) > 0);
	}
	CHECK(all > 100);
}
