// SPDX-License-Identifier: MIT
// How deep two hulls lie in each other.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// Depth of the deepest point of either hull in the other [length]: its distance from the nearest edge of the hull that
/// it is in. 0 if no point of either lies in the other. Contacts of two bodies are solved at their points, so this is
/// the contact error that is left between them. Hulls are simple polygons of positive winding, as straight edges: the
/// bulge of round outlines does not count between bodies. O(points of a × points of b).
Real measure_overlap(std::span<const Vec2> a, std::span<const Vec2> b);

} // namespace softbody
