// SPDX-License-Identifier: MIT
// What keeps a body from being crushed flat, drawn out or turned inside out, whatever presses on it.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/model/body_lanes.h"
#include "core/model/soft_body_data.h"

#include <span>

namespace softbody {

/// Keeps a body within its settings' `least_area`, `least_stretch` and `most_stretch`.
///
/// The stretch is that of the best-fitting affine map of the rest shape (Müller et al. 2005, sec. 4.2: F = A_pq A_qq^-1), by
/// its singular values. Where one is out of bounds the points move by (F' - F) q, F' having it at the bound, by at most
/// LIMIT_PUSH of the body's radius in a substep, and the rate at which it goes on is taken from the velocities, without a
/// rebound. The area likewise along its gradient. Momentum stays; angular momentum is given back. A body that is turned inside
/// out is left to its elasticity, which brings it back.
/// Pinned points stay. Returns whether anything changed. O(points) where the body is near a limit, O(hull points) else.
bool keep_whole(SoftBodyData &body, Real h);

/// Whether `keep_whole` might change anything, for several bodies side by side. O(hull points).
template <class T>
MaskOf<T> may_break_limits(const BodyModel<T> &body, std::span<const BasicVec2<T>> positions);

} // namespace softbody
