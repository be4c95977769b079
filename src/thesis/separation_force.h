// SPDX-License-Identifier: MIT
// The thesis's response to a contact: a force that grows with the area of the overlap. Kept for comparison.
#pragma once

#include "core/base/error.h"
#include "core/model/world_data.h"

#include <cstddef>

namespace softbody {

/// Default strength of the separation force [force/length², times WorldData::length_unit]. Larger: bodies overlap less,
/// and take smaller steps to stay stable. Smaller: bodies of a pile sink into one another.
inline constexpr Real SEPARATION_STIFFNESS = 10000;

/// Queues the forces of one step that push overlapping soft bodies apart, F = κ A for each pair (thesis 4.4,
/// "CollisionHandling"). A is the area that the hulls share. κ is the `stiffness` [force/length², times
/// WorldData::length_unit]. The force points away from the other body. Where the thesis leaves details open, the simplest
/// reading completes it:
/// - A is the exact area, which for concave hulls may have several pieces. The thesis takes the points in the order in
///   which it finds them, which gives a different, mostly smaller number.
/// - "Away" is along the line between the means of the hulls' points.
/// - The force is shared equally by the hull points inside the other body, or by all hull points if none is inside.
/// - Both bodies get opposite forces of equal size. Momentum stays. Angular momentum does not: the two forces need not act
///   in one line.
/// - There is no friction, no damping and no restitution.
///
/// Call it before each step, in a world whose bodies do not collide by themselves (BodySettings::collision_layer 0), with
/// steps as small as a substep. Wakes bodies that overlap. Returns the number of overlapping pairs. Refuses a stiffness that
/// is not finite and >= 0. Its measured faults are in docs/accuracy.md. O(bodies² + product of hull points of pairs whose
/// boxes overlap).
Result<std::size_t> add_separation_forces(WorldData &world, Real stiffness = SEPARATION_STIFFNESS);

} // namespace softbody
