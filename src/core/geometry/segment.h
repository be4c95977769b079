// SPDX-License-Identifier: MIT
// Tests on line segments: intersection, closest point, and the time at which a moving point hits a moving segment.
#pragma once

#include "core/base/vec2.h"

#include <optional>

namespace softbody {

/// The place where segments ab and cd meet, as the parameter t in [0, 1] along ab; empty when they do not meet.
/// Touching end points count. Collinear overlap gives the first shared point seen from a. A segment may be a point.
/// Source: thesis Alg. 4.7, with a + t(b - a) for its misprint, and the touching cases it misses.
std::optional<Real> segment_intersection(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// Parameter t in [0, 1] of the point a + t(b - a) closest to p; 0 when a and b coincide.
Real closest_parameter_on_segment(Vec2 p, Vec2 a, Vec2 b);

/// Motion of a point from one place to another at constant velocity during a time of 1.
struct Motion {
	Vec2 from;
	Vec2 to;
};

/// Time and place at which a point hits a segment.
struct SegmentImpact {
	Real time = 0; ///< in [0, 1]
	Real parameter = 0; ///< in [0, 1] along ab at that time
};

/// The first time in [0, 1] at which the point p lies on the segment ab, all three moving; empty when it never does.
/// Touching counts, also at times 0 and 1. The side from which p came is `cross(b - a, p - a)` at the start. The
/// segment may turn or be a point, and all may move along one line. It counts as longer by 1e-6 of itself at both ends,
/// so that no point slips through a joint; a point counts as on it within 1e-9 of the distances covered. A miss by less
/// may be called a hit; a hit is never missed.
std::optional<SegmentImpact> point_segment_impact(const Motion &p, const Motion &a, const Motion &b);

} // namespace softbody
