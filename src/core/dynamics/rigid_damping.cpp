// SPDX-License-Identifier: MIT
// Damping of the rigid part of a body's motion.
#include "core/dynamics/rigid_damping.h"

#include "core/dynamics/rigid_damping_lanes.h"

namespace softbody {

template void damp_rigid_motion(const BodyLanes<Real> &, Real);
template void damp_rigid_motion(const BodyLanes<RealPack> &, Real);

} // namespace softbody
