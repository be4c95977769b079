// SPDX-License-Identifier: MIT
// Tests on points and triangles, robust to rounding.
#include "core/geometry/triangle.h"

namespace softbody {

double signed_double_area(Vec2 a, Vec2 b, Vec2 c) {
	return (double(a.x) - c.x) * (double(b.y) - c.y) - (double(a.y) - c.y) * (double(b.x) - c.x);
}

bool point_in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
	const double whole = signed_double_area(a, b, c);
	if (whole == 0) {
		return false;
	}
	// The sub-areas are the barycentric coordinates times the whole; p is inside when none has the opposite sign.
	const double u = signed_double_area(p, b, c);
	const double v = signed_double_area(a, p, c);
	const double w = signed_double_area(a, b, p);
	return whole > 0 ? (u >= 0 && v >= 0 && w >= 0) : (u <= 0 && v <= 0 && w <= 0);
}

} // namespace softbody
