// SPDX-License-Identifier: MIT
// Tests whether a body can continue, and restores the rest shape of one that cannot.
#pragma once

#include "core/dynamics/substep_plan.h"
#include "core/model/soft_body_data.h"

namespace softbody {

/// Largest credible distance of two points of a body [length]. Infinite without springs, as such points may part.
Real credible_reach(const SoftBodyShape &shape, const SubstepPlan &plan);

/// Whether all positions and velocities are finite. O(points).
bool is_finite(const SoftBodyData &body);

/// Restores the rest shape of a body at its place, with its motion as far as that is credible within a step of `dt`
/// [s]. Pinned points that are finite stay. External forces and the memory of contacts are cleared. The deformation
/// before the failure is not restored, as it may have been the cause. O(points).
void reset_body(SoftBodyData &body, Real dt);

} // namespace softbody
