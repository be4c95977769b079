// SPDX-License-Identifier: MIT
// Exact twins of the geometric predicates on small integer coordinates, written by other formulas.
#pragma once

#include "core/base/vec2.h"
#include "support/random.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <vector>

namespace softbody::testing {

/// A point of the integer grid. On a small grid, random points are often equal or in line.
struct GridPoint {
	long x = 0;
	long y = 0;
	friend bool operator==(GridPoint a, GridPoint b) = default;
	friend GridPoint operator-(GridPoint a, GridPoint b) { return { a.x - b.x, a.y - b.y }; }
	operator Vec2() const { return { Real(x), Real(y) }; }
};

inline long grid_cross(GridPoint a, GridPoint b) {
	return a.x * b.y - a.y * b.x;
}

inline GridPoint random_grid_point(Random &random, int size) {
	const int x = random.integer(0, size);
	return { x, random.integer(0, size) };
}

inline std::vector<GridPoint> random_grid_polygon(Random &random, int count, int size) {
	std::vector<GridPoint> polygon;
	for (int i = 0; i < count; ++i) {
		polygon.push_back(random_grid_point(random, size));
	}
	return polygon;
}

inline std::vector<Vec2> to_real(const std::vector<GridPoint> &polygon) {
	return { polygon.begin(), polygon.end() };
}

/// Whether p lies on the closed segment ab.
inline bool grid_on_segment(GridPoint p, GridPoint a, GridPoint b) {
	return grid_cross(b - a, p - a) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
			std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

struct Fraction {
	long numerator = 0;
	long denominator = 1; ///< > 0
	double value() const { return double(numerator) / double(denominator); }
};

/// The first parameter t along ab at which it meets cd, by Cramer's rule; for parallel segments by
/// asking of each of the four end points whether the other segment contains it.
inline std::optional<Fraction> grid_intersection(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
	const long determinant = grid_cross(b - a, d - c);
	if (determinant != 0) {
		const long sign = determinant > 0 ? 1 : -1;
		const long t = grid_cross(c - a, d - c) * sign;
		const long s = grid_cross(c - a, b - a) * sign;
		if (t < 0 || t > determinant * sign || s < 0 || s > determinant * sign) {
			return {};
		}
		return Fraction{ t, determinant * sign };
	}
	const long size = std::max(1L, std::max(std::labs(b.x - a.x), std::labs(b.y - a.y)));
	std::optional<Fraction> first;
	const auto offer = [&](GridPoint p) {
		const long steps = std::max(std::labs(p.x - a.x), std::labs(p.y - a.y));
		if (!first || steps < first->numerator) {
			first = Fraction{ steps, size };
		}
	};
	if (grid_on_segment(a, c, d)) {
		offer(a);
	}
	if (grid_on_segment(b, c, d)) {
		offer(b);
	}
	if (grid_on_segment(c, a, b)) {
		offer(c);
	}
	if (grid_on_segment(d, a, b)) {
		offer(d);
	}
	return first;
}

/// Twice the signed area, by the shoelace sum about the origin.
inline long grid_double_area(const std::vector<GridPoint> &polygon) {
	long sum = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		sum += grid_cross(polygon[i], polygon[(i + 1) % polygon.size()]);
	}
	return sum;
}

/// Whether the closed polygon has no point twice: no coincident neighbors, adjacent edges share only
/// their corner, other edges nothing.
inline bool grid_is_simple(const std::vector<GridPoint> &polygon) {
	const std::size_t count = polygon.size();
	for (std::size_t i = 0; i < count; ++i) {
		const GridPoint a = polygon[i];
		const GridPoint b = polygon[(i + 1) % count];
		if (a == b) {
			return false;
		}
		for (std::size_t j = 0; j < count; ++j) {
			const GridPoint c = polygon[j];
			const GridPoint d = polygon[(j + 1) % count];
			if (j == (i + 1) % count) {
				if (grid_on_segment(d, a, b) || grid_on_segment(a, c, d)) {
					return false;
				}
			} else if (j != i && i != (j + 1) % count && grid_intersection(a, b, c, d)) {
				return false;
			}
		}
	}
	return true;
}

/// How often the polygon winds around p, by counting signed crossings of a ray; p must not be on the border.
inline int grid_winding_number(GridPoint p, const std::vector<GridPoint> &polygon) {
	int winding = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const GridPoint a = polygon[i];
		const GridPoint b = polygon[(i + 1) % polygon.size()];
		const long side = grid_cross(b - a, p - a);
		if (a.y <= p.y && b.y > p.y && side > 0) {
			winding++;
		} else if (a.y > p.y && b.y <= p.y && side < 0) {
			winding--;
		}
	}
	return winding;
}

inline bool grid_on_border(GridPoint p, const std::vector<GridPoint> &polygon) {
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		if (grid_on_segment(p, polygon[i], polygon[(i + 1) % polygon.size()])) {
			return true;
		}
	}
	return false;
}

} // namespace softbody::testing
