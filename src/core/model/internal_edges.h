// SPDX-License-Identifier: MIT
// Which edges of convex polygons lie against one another.
#pragma once

#include "core/model/surroundings.h"

#include <span>

namespace softbody {

/// Sets `Collider::internal_edges` of convex polygons without rounding that lie edge to edge: tiles, or the convex pieces
/// of a concave polygon. Two edges belong together if they go from corner to corner, in opposite directions, within
/// `tolerance` [length] > 0, belong to the same rigid body or to none, and are of the same layers. Edges that only overlap in
/// part stay as they are. O(n log n) in the number of edges.
void mark_internal_edges(std::span<Collider> colliders, Real tolerance);

} // namespace softbody
