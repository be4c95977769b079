// SPDX-License-Identifier: MIT
// Tests whether a body can continue, and restores the rest shape of one that cannot.
#pragma once

#include "core/base/vec2.h"
#include "core/dynamics/substep_plan.h"
#include "core/model/soft_body_data.h"

#include <cstddef>
#include <span>

namespace softbody {

/// Largest credible distance of two points of a body [length]. Infinite without springs, as such points may part.
Real credible_reach(const SoftBodyShape &shape, const SubstepPlan &plan);

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

/// Whether all positions and velocities are finite. O(points).
bool is_finite(const SoftBodyData &body);

/// Restores the rest shape of a body at its place, with its motion as far as that is credible within a step of `dt`
/// [s]. Pinned points that are finite stay. External forces and the memory of contacts are cleared. The deformation
/// before the failure is not restored, as it may have been the cause. O(points).
void reset_body(SoftBodyData &body, Real dt);

} // namespace softbody
