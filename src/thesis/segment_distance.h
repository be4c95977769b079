// SPDX-License-Identifier: MIT
// How far two line segments are apart.
#pragma once

#include "core/base/vec2.h"

namespace softbody {

/// Two closest points of two segments.
struct SegmentDistance {
	Real distance = 0; ///< [length], 0 when they meet
	Real s = 0; ///< parameter in [0, 1] along ab
	Real t = 0; ///< parameter in [0, 1] along cd
};

/// How far segments ab and cd are apart, and where. Where several pairs are closest (parallel
/// segments) one of them is given. A segment may be a point.
SegmentDistance closest_points_on_segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

} // namespace softbody
