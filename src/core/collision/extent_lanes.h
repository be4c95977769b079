// SPDX-License-Identifier: MIT
// `SolverBody::measure_extent` for any scalar type.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/geometry/aabb.h"

#include <cstddef>
#include <span>

namespace softbody {

/// Extents as in `SolverBody`, one value for each lane.
template <class T>
struct BasicExtent {
	BasicVec2<T> min; ///< of the box
	BasicVec2<T> max;
	BasicVec2<T> center;
	T radius;
	T way;
};

/// Extents of hulls at `now` that were at `before`. Precondition: equal sizes, at least one point. O(points).
template <class T>
BasicExtent<T> measure_extent(std::span<const BasicVec2<T>> now, std::span<const BasicVec2<T>> before) {
	BasicVec2<T> min = in_all_lanes<T>(Aabb{}.min);
	BasicVec2<T> max = in_all_lanes<T>(Aabb{}.max);
	T longest(0);
	for (std::size_t i = 0; i < now.size(); ++i) {
		const BasicVec2<T> &p = now[i];
		min = { lesser(p.x, min.x), lesser(p.y, min.y) };
		max = { greater(p.x, max.x), greater(p.y, max.y) };
		longest = greater(length_squared(p - before[i]), longest);
	}
	BasicVec2<T> sum; // as in `mean_of`
	for (const BasicVec2<T> &p : now) {
		sum += p - now[0];
	}
	const BasicVec2<T> center = now[0] + sum * T(1 / Real(now.size()));
	T farthest(0);
	for (const BasicVec2<T> &p : now) {
		farthest = greater(length_squared(p - center), farthest);
	}
	const T way = sqrt(longest);
	const BasicVec2<T> margin{ way, way };
	return { min - margin, max + margin, center, sqrt(farthest) + way, way };
}

} // namespace softbody
