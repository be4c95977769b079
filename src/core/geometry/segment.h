// SPDX-License-Identifier: MIT
// Tests on line segments: where two meet, when a moving point hits a moving one.
#pragma once

#include "core/base/vec2.h"

#include <optional>

namespace softbody {

/// Where segments ab and cd meet, as the parameter t in [0, 1] along ab; empty when they do not.
/// Touching end points count. Collinear overlap gives the first shared point seen from a. A segment
/// may be a point. Source: thesis Alg. 4.7, with a + t(b - a) for its misprint and the touching cases
/// it misses.
std::optional<Real> segment_intersection(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// Parameter t in [0, 1] of the point a + t(b - a) closest to p; 0 when a and b coincide.
Real closest_parameter_on_segment(Vec2 p, Vec2 a, Vec2 b);

/// A point that moves from one place to another at constant velocity during a time of 1.
struct Motion {
	Vec2 from;
	Vec2 to;
};

/// When and where a point hits a segment.
struct SegmentImpact {
	Real time = 0; ///< in [0, 1]
	Real parameter = 0; ///< in [0, 1] along ab at that time
};

/// The first time in [0, 1] at which the point p lies on the segment ab, all three of them moving;
/// empty when it never does. Touching counts, at the very start (time 0) and end (1) too. Which side
/// the point came from is for the caller to ask: cross(b - a, p - a) at the start.
///
/// The segment may turn, shrink to a point or be one, and all may move along one line. So that no
/// point slips through the joint of two edges, a segment counts as longer by 1e-6 of itself at both
/// ends; a point counts as on it within 1e-9 of the distances covered. A miss by less may be called
/// a hit, a hit is not missed.
std::optional<SegmentImpact> point_segment_impact(const Motion &p, const Motion &a, const Motion &b);

} // namespace softbody
