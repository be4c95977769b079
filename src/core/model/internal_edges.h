// SPDX-License-Identifier: MIT
// Finds edges of convex polygons that lie against one another.
#pragma once

#include "core/model/surroundings.h"

#include <span>

namespace softbody {

/// Sets `Collider::internal_edges` of convex polygons without rounding that lie edge to edge: tiles, or pieces of a
/// concave polygon. Two edges match if they run from corner to corner in opposite directions within `tolerance`
/// [length] > 0, on one rigid body or none, with equal layers. O(n log n) in the number of edges.
void mark_internal_edges(std::span<Collider> colliders, Real tolerance);

} // namespace softbody
