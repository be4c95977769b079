// SPDX-License-Identifier: MIT
// Finds edges of convex polygons that lie against one another.
#pragma once

#include "core/model/surroundings.h"

#include <span>

namespace softbody {

/// Sets `Collider::internal_edges` of convex polygons without rounding that lie edge to edge: tiles, or the convex
/// pieces of a concave polygon. Two edges belong together if they go from corner to corner, in opposite directions,
/// within `tolerance` [length] > 0, belong to one rigid body or to none, and have equal layers. Edges that overlap only
/// in part are unchanged. O(n log n) in the number of edges.
void mark_internal_edges(std::span<Collider> colliders, Real tolerance);

} // namespace softbody
