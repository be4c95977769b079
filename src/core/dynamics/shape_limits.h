// SPDX-License-Identifier: MIT
// Keeps a body from being crushed flat, drawn out or turned inside out.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/model/body_lanes.h"
#include "core/model/soft_body_data.h"

#include <algorithm>
#include <span>

namespace softbody {

/// Keeps a body within its settings' `least_area`, `least_stretch` and `most_stretch`. The stretches are the singular
/// values of the best-fitting affine map F of the rest shape (Müller et al. 2005, sec. 4.2: F = A_pq A_qq^-1). Out of
/// bounds, the points move by (F' - F) q, where F' has the stretch at the bound, by at most LIMIT_PUSH of the body's
/// size in a substep of `h` [s]. With an area below LIMIT_ONSET of its bound, points are drawn to their places in the
/// map. Velocities change by the motion over h; at most by LIMIT_SPEED where the body is crumpled or far out of bounds,
/// or where nothing can press on it (`bears_load`). Momentum, angular momentum, center and pinned points stay. Returns
/// whether anything changed. O(points) near a limit, else O(hull points).
bool keep_whole(SoftBodyData &body, Real h, bool bears_load);

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

/// Whether `keep_whole` might change anything, for several bodies side by side. O(hull points).
template <class T>
MaskOf<T> may_break_limits(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions);

} // namespace softbody
