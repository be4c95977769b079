// SPDX-License-Identifier: MIT
// Distance of two line segments.
#pragma once

#include "core/base/vec2.h"

namespace softbody {

/// Two closest points of two segments.
struct SegmentDistance {
	Real distance = 0; ///< [length], 0 when the segments intersect
	Real s = 0; ///< parameter in [0, 1] along ab
	Real t = 0; ///< parameter in [0, 1] along cd
};

/// Distance of the segments ab and cd, and the closest points. Where several pairs of points are closest (parallel
/// segments), one pair is given. A segment may be a point.
SegmentDistance closest_points_on_segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

} // namespace softbody
