// SPDX-License-Identifier: MIT
// A plain two-dimensional vector and the few products the simulation needs.
#pragma once

#include "core/base/real.h"

#include <cmath>

namespace softbody {

/// Two-dimensional vector: a position [length], velocity [length/s] or force [mass·length/s²].
/// Aggregate without invariants; arrays of it are contiguous pairs of `Real`.
struct Vec2 {
	Real x = 0;
	Real y = 0;

	constexpr Vec2 &operator+=(Vec2 other) {
		x += other.x;
		y += other.y;
		return *this;
	}
	constexpr Vec2 &operator-=(Vec2 other) {
		x -= other.x;
		y -= other.y;
		return *this;
	}
	constexpr Vec2 &operator*=(Real factor) {
		x *= factor;
		y *= factor;
		return *this;
	}
	friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return { a.x + b.x, a.y + b.y }; }
	friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return { a.x - b.x, a.y - b.y }; }
	friend constexpr Vec2 operator-(Vec2 a) { return { -a.x, -a.y }; }
	friend constexpr Vec2 operator*(Vec2 a, Real factor) { return { a.x * factor, a.y * factor }; }
	friend constexpr Vec2 operator*(Real factor, Vec2 a) { return { a.x * factor, a.y * factor }; }
	friend constexpr bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
};

constexpr Real dot(Vec2 a, Vec2 b) {
	return a.x * b.x + a.y * b.y;
}

/// z component of the three-dimensional cross product: twice the signed area of the triangle 0, a, b.
constexpr Real cross(Vec2 a, Vec2 b) {
	return a.x * b.y - a.y * b.x;
}

/// `a` turned by +90 degrees (from x towards y); the velocity field of a unit spin is this of the arm.
constexpr Vec2 perpendicular(Vec2 a) {
	return { -a.y, a.x };
}

constexpr Real length_squared(Vec2 a) {
	return dot(a, a);
}

inline Real length(Vec2 a) {
	return std::sqrt(length_squared(a));
}

inline bool is_finite(Vec2 a) {
	return std::isfinite(a.x) && std::isfinite(a.y);
}

/// A rotation kept as cosine and sine: no trigonometry in the step, and no wrap-around.
struct Rotation {
	Real c = 1;
	Real s = 0;

	static Rotation from_angle(Real radians) { return { std::cos(radians), std::sin(radians) }; }
	/// Angle in (-pi, pi], positive from x towards y.
	Real angle() const { return std::atan2(s, c); }
	constexpr Vec2 apply(Vec2 a) const { return { c * a.x - s * a.y, s * a.x + c * a.y }; }
	constexpr Vec2 apply_inverse(Vec2 a) const { return { c * a.x + s * a.y, c * a.y - s * a.x }; }
};

} // namespace softbody
