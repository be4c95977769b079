// SPDX-License-Identifier: MIT
// Chooses the points of a body that are joined by springs, if the user gives none.
#include "core/creator/structure.h"

#include "core/base/constants.h"
#include "core/geometry/aabb.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

// Number of nearest points that are tested first for lying between two others; usually one of them does.
constexpr std::size_t ASKED_FIRST = 16;

// Whether the way between two points meets an edge of the outline that ends at neither.
bool crosses_outline(std::span<const Vec2> points, std::size_t hull_count, std::uint32_t from, std::uint32_t to) {
	const Aabb way = Aabb::between(points[from], points[to]);
	for (std::size_t i = 0; i < hull_count; ++i) {
		const std::size_t next = (i + 1) % hull_count;
		if (i != to && next != to && way.overlaps(Aabb::between(points[i], points[next])) &&
				segment_intersection(points[from], points[to], points[i], points[next])) {
			return true;
		}
	}
	return false;
}

// Whether a third point lies inside the circle over the way between two points.
bool is_shadowed(std::span<const Vec2> points, Vec2 from, Vec2 to, std::span<const std::uint32_t> others) {
	const Real tolerance = CIRCLE_TOLERANCE * length_squared(to - from);
	return std::ranges::any_of(others, [&](std::uint32_t third) {
		return dot(from - points[third], to - points[third]) < -tolerance;
	});
}

} // namespace

std::vector<SpringEnds> automatic_springs(std::span<const Vec2> hull, std::span<const Vec2> inner_points,
		std::optional<Vec2> center) {
	const std::uint32_t hull_count = std::uint32_t(hull.size());
	const std::uint32_t inner_end = hull_count + std::uint32_t(inner_points.size());
	std::vector<SpringEnds> springs;
	for (std::uint32_t i = 0; i < hull_count; ++i) {
		springs.push_back({ i, (i + 1) % hull_count });
	}
	for (std::uint32_t i = 0; center && i < hull_count; ++i) {
		springs.push_back({ i, inner_end });
	}
	if (inner_points.empty()) {
		return springs;
	}

	std::vector<Vec2> points(hull.begin(), hull.end());
	points.insert(points.end(), inner_points.begin(), inner_points.end());
	if (center) {
		points.push_back(*center);
	}
	std::vector<std::uint32_t> others(points.size());
	std::iota(others.begin(), others.end(), 0u);
	for (std::uint32_t from = hull_count; from < inner_end; ++from) {
		const auto middle = others.begin() + std::ptrdiff_t(std::min(ASKED_FIRST, others.size()));
		std::ranges::partial_sort(others, middle, {}, [&](std::uint32_t i) {
			return std::pair(length_squared(points[i] - points[from]), i);
		});
		for (std::uint32_t to = 0; to < points.size(); ++to) {
			const bool is_pair_of_an_earlier_one = to >= hull_count && to < from;
			if (!is_pair_of_an_earlier_one && length_squared(points[to] - points[from]) > 0 &&
					!is_shadowed(points, points[from], points[to], others) && !crosses_outline(points, hull_count, from, to)) {
				springs.push_back({ from, to });
			}
		}
	}
	return springs;
}

} // namespace softbody
