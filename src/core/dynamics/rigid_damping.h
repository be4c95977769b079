// SPDX-License-Identifier: MIT
// Damping of the motion of a body as a whole.
#pragma once

#include "core/model/body_lanes.h"

namespace softbody {

/// Damps velocity and spin of a body as a whole by `linear_damp` and `angular_damp` over `h` [s]: by exp(-damp h),
/// independent of the number of substeps. Motion relative to the rigid one and pinned points are unchanged. Several
/// bodies side by side get the bits of each alone. O(points).
template <class T>
void damp_rigid_motion(const BodyLanes<T> &body, Real h);

} // namespace softbody
