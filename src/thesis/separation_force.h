// SPDX-License-Identifier: MIT
// The thesis's response to a contact: a force that grows with the area of the overlap. Kept to be compared with.
#pragma once

#include "core/base/error.h"
#include "core/model/world_data.h"

#include <cstddef>

namespace softbody {

/// Default strength of the separation force [force/length², times WorldData::length_unit]. Larger: bodies overlap less, and
/// take smaller steps to stay stable. Smaller: piles sink into one another.
inline constexpr Real SEPARATION_STIFFNESS = 10000;

/// Queues the forces of one step that push overlapping soft bodies apart, F = κ A for each pair (thesis 4.4,
/// "EnvironmentContactSolver"): A the area that their hulls share, κ the `stiffness` [force/length², times
/// WorldData::length_unit], the direction away from the other body. Where the thesis leaves details open, the simplest
/// reading completes it:
/// - A is the exact area, which for concave hulls may be several pieces. The thesis takes the found points in the order in
///   which it finds them, which gives another, mostly smaller number.
/// - "Away" is the line between the means of the hulls' points.
/// - The points loaded are the hull points inside the other body, in equal shares; all hull points where none is inside.
/// - Both bodies get the same force, one its opposite. Momentum stays. Angular momentum does not: the two forces need not
///   act in one line.
/// - There is no friction, no damping and no restitution.
///
/// To be called before each step, for a world whose bodies do not collide by themselves (BodySettings::collision_layer 0), in
/// steps as small as a substep. Wakes bodies that overlap. Returns how many pairs do; refuses a stiffness that is not finite
/// and >= 0. Its measured faults are in docs/accuracy.md. O(bodies² + product of hull points of pairs whose boxes overlap).
Result<std::size_t> add_separation_forces(WorldData &world, Real stiffness = SEPARATION_STIFFNESS);

} // namespace softbody
