// SPDX-License-Identifier: MIT
// A circle around points.
#pragma once

#include "core/base/pack.h"
#include "core/geometry/aabb.h"

#include <cmath>
#include <span>

namespace softbody {

struct Circle {
	Vec2 center;
	Real radius = 0; ///< [length]
};

/// Mean of at least one point. O(points).
inline Vec2 mean_of(std::span<const Vec2> points) {
	Vec2 sum;
	for (const Vec2 p : points) {
		sum += p - points[0]; // keeps digits far from the origin
	}
	return points[0] + sum * (1 / Real(points.size()));
}

/// Circle around at least one point, about their mean. It turns with the points, as a box along the axes does not.
/// O(points).
inline Circle circle_around(std::span<const Vec2> points) {
	const Vec2 center = mean_of(points);
	const BasicVec2<RealPack> middle = in_all_lanes<RealPack>(center);
	RealPack farthest(0);
	for (std::size_t i = 0; i < packs_for(points.size()); ++i) {
		farthest = greater(length_squared(pack_of(points, i) - middle), farthest);
	}
	return { center, std::sqrt(greatest_lane(farthest)) };
}

} // namespace softbody
