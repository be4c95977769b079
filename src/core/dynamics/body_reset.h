// SPDX-License-Identifier: MIT
// Tells whether a body can go on, and gives back its rest shape to one that cannot.
#pragma once

#include "core/dynamics/substep_plan.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// How far apart two points of a body may be [length]. Infinite without springs, as points that nothing joins may part.
Real credible_reach(const SoftBodyShape &shape, const SubstepPlan &plan);

/// Whether all positions and velocities are finite. O(points).
bool is_finite(const SoftBodyData &body);

/// Gives a body its rest shape where it was, with the motion that it had as far as that can be believed within a step of
/// `dt` [s]. Pinned points that are finite stay. The body loses its external forces and its memory of contacts. The shape that
/// it had is not restored: the cause of the failure may have been in it, and would fail again. O(points).
void reset_body(SoftBodyData &body, Real dt);

} // namespace softbody
