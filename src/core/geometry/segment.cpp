// SPDX-License-Identifier: MIT
// Tests on line segments.
#include "core/geometry/segment.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace softbody {

namespace {

// Share of its length by which a segment counts as longer at each end.
constexpr double END_TOLERANCE = 1e-6;

// Distance at which a point counts as on the segment [of the largest distance in the query]. Far above the rounding of
// a root in double, which near a grazing hit is about 1e-8 in time but not in distance.
constexpr double GAP_TOLERANCE = 1e-9;

// All motion relative to the moving end a. Two motions are left: of the point and of the end b.
struct RelativeMotion {
	Vec2d point;
	Vec2d point_way;
	Vec2d end;
	Vec2d end_way;
	double scale = 0; // the largest distance in the query

	Vec2d point_at(double t) const { return point + point_way * t; }
	Vec2d end_at(double t) const { return end + end_way * t; }
};

RelativeMotion relative_motion(const Motion &p, const Motion &a, const Motion &b) {
	RelativeMotion motion;
	motion.point = difference(p.from, a.from);
	motion.end = difference(b.from, a.from);
	motion.point_way = difference(p.to, a.to) - motion.point;
	motion.end_way = difference(b.to, a.to) - motion.end;
	for (const Vec2d v : { motion.point, motion.end, motion.point_way, motion.end_way }) {
		motion.scale = std::max({ motion.scale, std::abs(v.x), std::abs(v.y) });
	}
	return motion;
}

// The time at which |p + t way| is least; NaN without a way.
double closest_time(Vec2d p, Vec2d way) {
	return -dot(p, way) / dot(way, way);
}

// Times at which a hit may begin. Point, a and b are in line when
//   f(t) = cross(end + t end_way, point + t point_way) = c0 + c1 t + c2 t² = 0.
// Beside its roots these are:
// - its extremum, the double root of a grazing hit when rounding leaves no real one;
// - the times when the point is nearest to a and to b: if f is 0 at all times, a hit begins at an end;
// - the start, for a point that is on the segment already.
// Each is checked by distance afterwards, so a superfluous one does no harm.
std::array<double, 6> candidate_times(const RelativeMotion &motion) {
	const double c0 = cross(motion.end, motion.point);
	const double c1 = cross(motion.end, motion.point_way) + cross(motion.end_way, motion.point);
	const double c2 = cross(motion.end_way, motion.point_way);
	// The root from the sum -c1 ± sqrt(c1² - 4 c0 c2) that does not cancel, and the other root from their product c0 /
	// c2. 0 / 0 is NaN and is rejected later.
	const double q = -(c1 + std::copysign(std::sqrt(c1 * c1 - 4 * c0 * c2), c1)) / 2;
	return { 0, q / c2, c0 / q, -c1 / (2 * c2), closest_time(motion.point, motion.point_way),
		closest_time(motion.point - motion.end, motion.point_way - motion.end_way) };
}

// Whether the boxes of both ways lie apart by more than any tolerance of a hit. Most edges of a hull are far from a
// point's way, and testing six candidates costs ten times as much as this.
bool ways_lie_apart(const RelativeMotion &motion) {
	const double margin = 4 * END_TOLERANCE * motion.scale;
	const auto apart = [margin](double from, double to, double end_from, double end_to) {
		return std::min(from, to) > std::max({ 0.0, end_from, end_to }) + margin ||
				std::max(from, to) < std::min({ 0.0, end_from, end_to }) - margin;
	};
	const Vec2d point = motion.point_at(1);
	const Vec2d end = motion.end_at(1);
	return apart(motion.point.x, point.x, motion.end.x, end.x) || apart(motion.point.y, point.y, motion.end.y, end.y);
}

} // namespace

std::optional<Real> segment_intersection(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	const double c_side = signed_double_area(a, b, c);
	const double d_side = signed_double_area(a, b, d);
	const double a_side = signed_double_area(c, d, a);
	const double b_side = signed_double_area(c, d, b);
	if ((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0) || (a_side > 0 && b_side > 0) ||
			(a_side < 0 && b_side < 0)) {
		return {};
	}
	if (a_side != b_side) {
		return Real(a_side / (a_side - b_side));
	}
	// Both sides are 0: the four points are in line, or a segment is a point on the line of the other. Compare along
	// ab; if ab is a point, test whether cd contains it.
	const Vec2d along = difference(b, a);
	const double size = dot(along, along);
	if (size == 0) {
		const bool within = std::min(c.x, d.x) <= a.x && a.x <= std::max(c.x, d.x) && std::min(c.y, d.y) <= a.y &&
				a.y <= std::max(c.y, d.y);
		return within ? std::optional<Real>(Real(0)) : std::nullopt;
	}
	const double tc = dot(difference(c, a), along) / size;
	const double td = dot(difference(d, a), along) / size;
	const double first = std::max(0.0, std::min(tc, td));
	const double last = std::min(1.0, std::max(tc, td));
	return first <= last ? std::optional<Real>(Real(first)) : std::nullopt;
}

Real closest_parameter_on_segment(Vec2 p, Vec2 a, Vec2 b) {
	const Vec2 along = b - a;
	const Real size = length_squared(along);
	if (!(size > 0)) {
		return 0;
	}
	return std::clamp(dot(p - a, along) / size, Real(0), Real(1));
}

std::optional<SegmentImpact> point_segment_impact(const Motion &p, const Motion &a, const Motion &b) {
	const RelativeMotion motion = relative_motion(p, a, b);
	if (ways_lie_apart(motion)) {
		return {};
	}
	std::optional<SegmentImpact> first;
	for (const double candidate : candidate_times(motion)) {
		// Rounding may put a time of the range's end outside of it. NaN stays NaN and fails the last test.
		const double t = std::clamp(candidate, 0.0, 1.0);
		if (first && !(t < double(first->time))) {
			continue;
		}
		const Vec2d point = motion.point_at(t);
		const Vec2d end = motion.end_at(t);
		const double size = dot(end, end);
		const double along = size > 0 ? std::clamp(dot(point, end) / size, -END_TOLERANCE, 1 + END_TOLERANCE) : 0.0;
		if (length(point - end * along) <= GAP_TOLERANCE * motion.scale) {
			first = SegmentImpact{ Real(t), Real(std::clamp(along, 0.0, 1.0)) };
		}
	}
	return first;
}

} // namespace softbody
