// SPDX-License-Identifier: MIT
// Which points of a body are joined by springs if nobody says so.
#include "core/creator/structure.h"

#include "core/base/constants.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <utility>

namespace softbody {

namespace {

struct Neighbour {
	Real distance_squared;
	std::uint32_t point;
};

// Whether the way from one point to another meets an edge of the outline that ends at neither.
bool crosses_outline(std::span<const Vec2> points, std::size_t hull_count, std::uint32_t from, std::uint32_t to) {
	for (std::size_t i = 0; i < hull_count; ++i) {
		const std::size_t next = (i + 1) % hull_count;
		if (i != to && next != to && segment_intersection(points[from], points[to], points[i], points[next])) {
			return true;
		}
	}
	return false;
}

// Whether a third point lies inside the circle over the way to neighbour `index`. It is then nearer than that one, and as
// a rule one of the nearest, so that few are looked at.
bool is_shadowed(std::span<const Vec2> points, Vec2 from, std::span<const Neighbour> sorted, std::size_t index) {
	const Vec2 to = points[sorted[index].point];
	const Real tolerance = CIRCLE_TOLERANCE * sorted[index].distance_squared;
	return std::ranges::any_of(sorted.first(index), [&](const Neighbour &third) {
		return dot(from - points[third.point], to - points[third.point]) < -tolerance;
	});
}

} // namespace

std::vector<SpringEnds> automatic_springs(std::span<const Vec2> hull, std::span<const Vec2> inner_points,
		std::optional<Vec2> centre) {
	const std::uint32_t hull_count = std::uint32_t(hull.size());
	const std::uint32_t inner_end = hull_count + std::uint32_t(inner_points.size());
	std::vector<SpringEnds> springs;
	for (std::uint32_t i = 0; i < hull_count; ++i) {
		springs.push_back({ i, (i + 1) % hull_count });
	}
	for (std::uint32_t i = 0; centre && i < hull_count; ++i) {
		springs.push_back({ i, inner_end });
	}
	if (inner_points.empty()) {
		return springs;
	}

	std::vector<Vec2> points(hull.begin(), hull.end());
	points.insert(points.end(), inner_points.begin(), inner_points.end());
	if (centre) {
		points.push_back(*centre);
	}
	std::vector<Neighbour> neighbours;
	for (std::uint32_t from = hull_count; from < inner_end; ++from) {
		neighbours.clear();
		for (std::uint32_t to = 0; to < points.size(); ++to) {
			const Real distance_squared = length_squared(points[to] - points[from]);
			if (distance_squared > 0) {
				neighbours.push_back({ distance_squared, to });
			}
		}
		std::ranges::sort(neighbours, {}, [](const Neighbour &each) { return std::pair(each.distance_squared, each.point); });
		for (std::size_t i = 0; i < neighbours.size(); ++i) {
			const std::uint32_t to = neighbours[i].point;
			const bool is_pair_of_an_earlier_one = to >= hull_count && to < from;
			if (!is_pair_of_an_earlier_one && !is_shadowed(points, points[from], neighbours, i) &&
					!crosses_outline(points, hull_count, from, to)) {
				springs.push_back({ from, to });
			}
		}
	}
	return springs;
}

} // namespace softbody
