// SPDX-License-Identifier: MIT
// Finds bodies near a limit of their shape, for any scalar type: included where it is instantiated.
#pragma once

#include "core/base/constants.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/shape_limits.h"

#include <algorithm>

namespace softbody {

// The diagonal of an ellipse's bounding box has one length at any angle: 2 a sqrt(s1² + s2²), with its radius a at rest
// and its stretches s1 and s2. At rest it is at most sqrt(8) radii, for any outline. A body with less than the least
// stretch s2 either shows a stretch s1 of NOTICED_STRETCH, or has less than NOTICED_STRETCH times s2 of its area.
inline constexpr Real NOTICED_STRETCH = Real(1.6);

template <class T>
MaskOf<T> may_break_limits(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions) {
	const SoftBodyShape &shape = body.shape;
	const ShapeBounds bounds = bounds_of(body.settings);
	const std::span<const BasicVec2<T>> hull = positions.first(shape.hull_count());
	const BasicVec2<T> base = hull[0];
	BasicVec2<T> low;
	BasicVec2<T> high;
	BasicVec2<T> last;
	T twice_area = T(0);
	for (std::size_t i = 1; i < hull.size(); ++i) {
		const BasicVec2<T> here = hull[i] - base;
		twice_area += cross(last, here);
		low = { select(here.x < low.x, here.x, low.x), select(here.y < low.y, here.y, low.y) };
		high = { select(here.x > high.x, here.x, high.x), select(here.y > high.y, here.y, high.y) };
		last = here;
	}
	const Real least_area = std::max(bounds.least_area * LIMIT_ONSET, NOTICED_STRETCH * bounds.least_stretch);
	const Real reach = std::min(NOTICED_STRETCH * std::max(body.settings.inflation, Real(1)), bounds.most_stretch);
	const Real diagonal = 4 * shape.radius() * shape.radius() * (1 + reach * reach);
	const MaskOf<T> is_small = twice_area < T(2 * least_area * shape.rest_area());
	const MaskOf<T> is_long = length_squared(high - low) > T(diagonal);
	return !both(!is_small, !is_long);
}

} // namespace softbody
