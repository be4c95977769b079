// SPDX-License-Identifier: MIT
// Differences between computed and expected values, in double, for checks with a stated tolerance.
#pragma once

#include "core/base/vec2.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace softbody::testing {

/// Distance between 1 and the next Real: the unit of every tolerance that covers rounding.
inline constexpr double EPSILON = double(std::numeric_limits<Real>::epsilon());

inline constexpr Real NOT_A_NUMBER = std::numeric_limits<Real>::quiet_NaN();
inline constexpr Real INFINITE = std::numeric_limits<Real>::infinity();

/// |a - b| [length]; NaN when either is.
inline double distance(Vec2 a, Vec2 b) {
	return std::hypot(double(a.x) - b.x, double(a.y) - b.y);
}

/// |a - b| / max(|b|, 1): a relative error that does not blow up near zero.
inline double relative_error(double a, double b) {
	return std::abs(a - b) / std::fmax(std::abs(b), 1);
}

/// Largest distance between points of the same index.
inline double largest_distance(std::span<const Vec2> a, std::span<const Vec2> b) {
	double largest = a.size() == b.size() ? 0 : double(INFINITE);
	for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
		const double each = distance(a[i], b[i]);
		if (!(each <= largest)) { // keeps a NaN
			largest = each;
		}
	}
	return largest;
}

/// Whether both hold the same numbers, to the last bit of each.
inline bool identical(std::span<const Vec2> a, std::span<const Vec2> b) {
	if (a.size() != b.size()) {
		return false;
	}
	for (std::size_t i = 0; i < a.size(); ++i) {
		if (!(a[i] == b[i]) || std::signbit(a[i].x) != std::signbit(b[i].x) || std::signbit(a[i].y) != std::signbit(b[i].y)) {
			return false;
		}
	}
	return true;
}

inline std::vector<Vec2> copy_of(std::span<const Vec2> points) {
	return { points.begin(), points.end() };
}

inline bool all_finite(std::span<const Vec2> points) {
	for (const Vec2 p : points) {
		if (!is_finite(p)) {
			return false;
		}
	}
	return true;
}

/// Whether `text` contains `part`; messages are checked for what they name, not for their wording.
inline bool mentions(const std::string &text, const std::string &part) {
	return text.find(part) != std::string::npos;
}

} // namespace softbody::testing
