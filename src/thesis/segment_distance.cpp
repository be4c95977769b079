// SPDX-License-Identifier: MIT
// Distance of two line segments.
#include "thesis/segment_distance.h"

#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

double closest_parameter(Vec2d p, Vec2d along) {
	const double size = dot(along, along);
	return size > 0 ? std::clamp(dot(p, along) / size, 0.0, 1.0) : 0.0;
}

} // namespace

SegmentDistance closest_points_on_segments(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	const Vec2d ab = difference(b, a);
	const Vec2d cd = difference(d, c);
	const Vec2d ac = difference(c, a);
	const Vec2d ad = difference(d, a);
	const Vec2d bc = difference(c, b);
	if (const auto meet = segment_intersection(a, b, c, d)) {
		return { 0, *meet, Real(closest_parameter(ab * double(*meet) - ac, cd)) };
	}
	// In the plane, two segments that do not intersect are closest at an end of one of them.
	double best_s = 0;
	double best_t = 0;
	double least = 0;
	bool first = true;
	const auto offer = [&](double s, double t) {
		const Vec2d gap = ac + cd * t - ab * s;
		if (first || dot(gap, gap) < least) {
			least = dot(gap, gap);
			best_s = s;
			best_t = t;
			first = false;
		}
	};
	offer(0, closest_parameter(ac * -1, cd));
	offer(1, closest_parameter(bc * -1, cd));
	offer(closest_parameter(ac, ab), 0);
	offer(closest_parameter(ad, ab), 1);
	return { Real(std::sqrt(least)), Real(best_s), Real(best_t) };
}

} // namespace softbody
