// SPDX-License-Identifier: MIT
// A vector in double, for tests whose result depends on a small difference of large coordinates.
#pragma once

#include "core/base/vec2.h"

#include <cmath>

namespace softbody {

/// Two doubles, whatever `Real` is. Only an intermediate inside geometry: states and results are `Vec2`.
struct Vec2d {
	double x = 0;
	double y = 0;

	friend constexpr Vec2d operator+(Vec2d a, Vec2d b) { return { a.x + b.x, a.y + b.y }; }
	friend constexpr Vec2d operator-(Vec2d a, Vec2d b) { return { a.x - b.x, a.y - b.y }; }
	friend constexpr Vec2d operator*(Vec2d a, double factor) { return { a.x * factor, a.y * factor }; }
	explicit operator Vec2() const { return { Real(x), Real(y) }; }
};

/// p relative to `origin`, subtracted before any rounding: exact for float coordinates of like size.
constexpr Vec2d difference(Vec2 p, Vec2 origin) {
	return { double(p.x) - double(origin.x), double(p.y) - double(origin.y) };
}

constexpr double dot(Vec2d a, Vec2d b) {
	return a.x * b.x + a.y * b.y;
}

/// z component of the product: twice the signed area of the triangle 0, a, b.
constexpr double cross(Vec2d a, Vec2d b) {
	return a.x * b.y - a.y * b.x;
}

inline double length(Vec2d a) {
	return std::sqrt(dot(a, a));
}

} // namespace softbody
