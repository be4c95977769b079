// SPDX-License-Identifier: MIT
// Whether what a step has made of bodies can be believed.
#pragma once

#include "core/base/vec2.h"

#include <cstddef>
#include <span>

namespace softbody {

template <class T>
T zero_if_finite(BasicVec2<T> x, BasicVec2<T> v) {
	return ((x.x + v.x) + (x.y + v.y)) * T(0);
}

/// Whether all is finite and no point farther from the first than `reach` [length]. A blow-up is noticed by its
/// size long before it overflows: by then rounding has swamped the body's center. A sum of zeros is zero unless one of
/// them came from what is not finite: one test instead of four a point. O(points).
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
