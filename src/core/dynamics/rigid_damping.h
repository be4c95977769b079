// SPDX-License-Identifier: MIT
// Damping of what a body does as a whole.
#pragma once

#include "core/model/body_lanes.h"

namespace softbody {

/// Takes from the velocity and the spin of a body as a whole what BodySettings::linear_damp and `angular_damp` take in `h`
/// [s]: they fall by exp(-damp h), so that it does not matter into how many substeps a step is divided. RigidBody2D's rule
/// 1 - damp h is the first order of it, and stops a body dead where damp h > 1. The motion relative to the rigid one stays,
/// and pinned points do. Of several bodies side by side the same bits as of each alone. O(points).
template <class T>
void damp_rigid_motion(const BodyLanes<T> &body, Real h);

} // namespace softbody
