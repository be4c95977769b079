// SPDX-License-Identifier: MIT
// Tests whether the state of bodies after a step is credible.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <span>

namespace softbody {

template <class T>
T zero_if_finite(BasicVec2<T> x, BasicVec2<T> v) {
	return ((x.x + v.x) + (x.y + v.y)) * T(0);
}

/// Whether all values are finite and no point is farther from the first than `reach` [length]. The distance detects a
/// blow-up long before it overflows; at overflow, rounding would have swamped the body's center. x·0 is NaN for a
/// non-finite x, so one comparison replaces four per point. O(points).
template <class T>
MaskOf<T> is_finite_within(std::span<const BasicVec2<T>> positions, std::span<const BasicVec2<T>> velocities, Real reach) {
	T sum = T(0);
	T farthest = T(0);
	for (std::size_t i = 0; i < positions.size(); ++i) {
		sum += zero_if_finite(positions[i], velocities[i]);
		farthest = greater(farthest, length_squared(positions[i] - positions[0]));
	}
	return both(sum < T(1), !(farthest > T(reach * reach)));
}

} // namespace softbody
