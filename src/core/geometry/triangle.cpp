// SPDX-License-Identifier: MIT
// Exact-as-possible tests on points, triangles and line segments.
#include "core/geometry/triangle.h"

#include <algorithm>

namespace softbody {

double signed_double_area(Vec2 a, Vec2 b, Vec2 c) {
	return (double(a.x) - c.x) * (double(b.y) - c.y) - (double(a.y) - c.y) * (double(b.x) - c.x);
}

bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
	const double whole = signed_double_area(a, b, c);
	if (whole == 0) {
		return false;
	}
	// The three sub-areas are the barycentric coordinates times the whole; p is inside when none of
	// them has the opposite sign.
	const double u = signed_double_area(p, b, c);
	const double v = signed_double_area(a, p, c);
	const double w = signed_double_area(a, b, p);
	return whole > 0 ? (u >= 0 && v >= 0 && w >= 0) : (u <= 0 && v <= 0 && w <= 0);
}

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
	// Both a and b lie on the line cd (all four collinear), or a segment is a point. Compare along
	// the longer axis of ab; for a point a = b both parameters of cd collapse onto it.
	const double dx = double(b.x) - a.x;
	const double dy = double(b.y) - a.y;
	const double size = dx * dx + dy * dy;
	if (size == 0) {
		const bool within = std::min(c.x, d.x) <= a.x && a.x <= std::max(c.x, d.x) && std::min(c.y, d.y) <= a.y &&
				a.y <= std::max(c.y, d.y);
		return within ? std::optional<Real>(Real(0)) : std::nullopt;
	}
	if (c_side != 0 || d_side != 0) {
		return {}; // cd is a single point off the line ab
	}
	const double tc = ((double(c.x) - a.x) * dx + (double(c.y) - a.y) * dy) / size;
	const double td = ((double(d.x) - a.x) * dx + (double(d.y) - a.y) * dy) / size;
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

} // namespace softbody
