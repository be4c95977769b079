// SPDX-License-Identifier: MIT
// Damping of the motion of a body as a whole.
#pragma once

#include "core/model/body_lanes.h"

namespace softbody {

/// Damps velocity and spin of a body as a whole by BodySettings::linear_damp and `angular_damp` over `h` [s]: they fall
/// by exp(-damp h), so the number of substeps does not matter. RigidBody2D's rule 1 - damp h is the first order of it,
/// and stops a body dead where damp h > 1. Motion relative to the rigid one and pinned points are unchanged. Several
/// bodies side by side get the bits of each alone. O(points).
template <class T>
void damp_rigid_motion(const BodyLanes<T> &body, Real h);

} // namespace softbody
