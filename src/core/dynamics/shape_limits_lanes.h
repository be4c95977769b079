// SPDX-License-Identifier: MIT
// Keeps bodies within the limits of their shape, for any scalar type: included where it is instantiated.
#pragma once

#include "core/base/constants.h"
#include "core/dynamics/pressure_lanes.h"
#include "core/dynamics/state_lanes.h"
#include "core/model/body_lanes.h"

#include <algorithm>
#include <span>
#include <type_traits>

namespace softbody {

/// Keeps a body within its settings' `least_area`, `least_stretch` and `most_stretch`. The stretches are the singular
/// values of the best-fitting affine map F of the rest shape (Müller et al. 2005, sec. 4.2: F = A_pq A_qq^-1). Out of
/// bounds, the points move by (F' - F) q, where F' has the stretch at the bound, by at most LIMIT_PUSH of the body's
/// size in a substep of `h` [s]. With an area below LIMIT_ONSET of its bound, points are drawn to their places in the
/// map. While the body is pressed (`pressed_area`) or out of bounds, the motion of its points against the body as a whole
/// dies away by LIMIT_DAMPING. Velocities change by the motion over h; at most by LIMIT_SPEED where the body is crumpled or far out of bounds,
/// or where nothing can press on it (`bears_load`). Momentum, angular momentum, center and pinned points stay. Returns
/// whether anything changed. O(points) near a limit, else O(hull points).
bool keep_whole(const BodyLanes<Real> &body, Real h, bool bears_load);

/// The limits of a body with its inflation: an inflated body may be as much larger, a deflated one as much smaller.
struct ShapeBounds {
	Real least_area = 0;
	Real least_stretch = 0;
	Real most_stretch = 0;
};
inline ShapeBounds bounds_of(const BodySettings &settings) {
	const Real larger = std::max(settings.inflation, Real(1));
	const Real smaller = std::min(settings.inflation, Real(1));
	return { settings.least_area * smaller, settings.least_stretch * smaller, settings.most_stretch * larger };
}

/// The area, as a share of the rest area, below which a body counts as pressed: LIMIT_ONSET times its least area, but not
/// more than halfway from there to the area at rest. 0 without a least area.
inline Real pressed_area(const BodySettings &settings) {
	const Real least = settings.least_area;
	return least > 0 ? std::min(least * LIMIT_ONSET, (1 + least) / 2) * std::min(settings.inflation, Real(1)) : Real(0);
}

// The diagonal of an ellipse's bounding box has one length at any angle: 2 a sqrt(s1² + s2²), with its radius a at rest
// and its stretches s1 and s2. At rest it is at most sqrt(8) radii, for any outline. A body with less than the least
// stretch s2 either shows a stretch s1 of NOTICED_STRETCH, or has less than NOTICED_STRETCH times s2 of its area.
inline constexpr Real NOTICED_STRETCH = Real(1.6);

/// Whether `keep_whole` might change anything. O(hull points).
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

/// Calls `keep_whole` for bodies side by side. Returns which bodies it may have changed. `scratch` has room for the
/// positions and velocities of one body, unless T is `Real`.
template <class T>
MaskOf<T> keep_whole_in_lanes(const BodyLanes<T> &bodies, Real h, bool bears_load, std::span<Vec2> scratch) {
	if constexpr (std::is_same_v<T, Real>) {
		return keep_whole(bodies, h, bears_load);
	} else {
		const MaskOf<T> crushed = may_break_limits<T>(bodies.model, bodies.positions);
		const std::size_t count = bodies.positions.size();
		for (std::size_t lane = 0; any(crushed) && lane < LANES<T>; ++lane) { // one at a time, as few are crushed at once
			if (!crushed[lane]) {
				continue;
			}
			const BodyLanes<Real> body{ { bodies.model.shape, bodies.model.settings, {}, {} }, bodies.inverse_masses,
				scratch.first(count), scratch.subspan(count, count) };
			for (std::size_t i = 0; i < count; ++i) {
				body.positions[i] = lane_of(bodies.positions[i], lane);
				body.velocities[i] = lane_of(bodies.velocities[i], lane);
			}
			keep_whole(body, h, bears_load);
			for (std::size_t i = 0; i < count; ++i) {
				set_lane(bodies.positions[i], lane, body.positions[i]);
				set_lane(bodies.velocities[i], lane, body.velocities[i]);
			}
		}
		return crushed;
	}
}

} // namespace softbody
