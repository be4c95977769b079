// SPDX-License-Identifier: MIT
// Brute-force checks of cut polygons that share no code with the cutting.
#pragma once

#include "core/geometry/polygon_cut.h"

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace softbody::testing {

inline long double turn_of(Vec2 a, Vec2 b, Vec2 c) {
	return ((long double)(b.x) - a.x) * ((long double)(c.y) - a.y) - ((long double)(b.y) - a.y) * ((long double)(c.x) - a.x);
}

inline double shoelace(std::span<const Vec2> polygon) {
	long double sum = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2 a = polygon[i];
		const Vec2 b = polygon[(i + 1) % polygon.size()];
		sum += (long double)(a.x) * b.y - (long double)(a.y) * b.x;
	}
	return double(sum / 2);
}

/// Whether segments share a place, by the signs of four triangles.
inline bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	const auto within = [](Vec2 p, Vec2 q, Vec2 r) {
		return std::fmin(p.x, q.x) <= r.x && r.x <= std::fmax(p.x, q.x) && std::fmin(p.y, q.y) <= r.y && r.y <= std::fmax(p.y, q.y);
	};
	const long double one = turn_of(a, b, c), two = turn_of(a, b, d), three = turn_of(c, d, a), four = turn_of(c, d, b);
	if (((one > 0 && two < 0) || (one < 0 && two > 0)) && ((three > 0 && four < 0) || (three < 0 && four > 0))) {
		return true;
	}
	return (one == 0 && within(a, b, c)) || (two == 0 && within(a, b, d)) || (three == 0 && within(c, d, a)) || (four == 0 && within(c, d, b));
}

inline bool is_simple(std::span<const Vec2> polygon) {
	const std::size_t count = polygon.size();
	for (std::size_t i = 0; i < count; ++i) {
		for (std::size_t j = i + 2; j < count; ++j) {
			if ((j + 1) % count != i && segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % count])) {
				return false;
			}
		}
	}
	return true;
}

inline bool contains_place(std::span<const Vec2> polygon, Vec2 p) { // by winding
	int winding = 0;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2 a = polygon[i];
		const Vec2 b = polygon[(i + 1) % polygon.size()];
		if (a.y <= p.y && b.y > p.y) {
			winding += turn_of(a, b, p) > 0;
		} else if (a.y > p.y && b.y <= p.y) {
			winding -= turn_of(a, b, p) < 0;
		}
	}
	return winding != 0;
}

inline double distance_to_edges(std::span<const Vec2> polygon, Vec2 p) {
	double least = HUGE_VAL;
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		const Vec2 a = polygon[i];
		const Vec2 b = polygon[(i + 1) % polygon.size()];
		const double x = double(b.x) - a.x, y = double(b.y) - a.y;
		const double squared = x * x + y * y;
		const double t = squared > 0 ? std::fmin(1, std::fmax(0, ((double(p.x) - a.x) * x + (double(p.y) - a.y) * y) / squared)) : 0;
		least = std::fmin(least, std::hypot(double(p.x) - a.x - t * x, double(p.y) - a.y - t * y));
	}
	return least;
}

struct CutFacts {
	std::string violation; ///< the first one, or empty
	double area_error = 0; ///< of the sum of the pieces, over the whole; the larger of both states
};

/// All that holds for any cut.
inline CutFacts facts_of(std::span<const Vec2> polygon, std::span<const Vec2> twin, const CutLimits &limits, const PolygonCut &cut) {
	CutFacts facts;
	const auto claim = [&](bool holds, const char *text) {
		if (!holds && facts.violation.empty()) {
			facts.violation = text;
		}
	};
	double sums[2] = { 0, 0 };
	for (const std::vector<std::uint32_t> &piece : cut.pieces) {
		claim(piece.size() >= 3, "a piece has three corners");
		for (int state = 0; state < 2; ++state) {
			std::vector<Vec2> outline;
			for (const std::uint32_t point : piece) {
				outline.push_back(state == 0 ? cut.points[point].position : cut.points[point].twin);
			}
			const double area = shoelace(outline);
			sums[state] += area;
			claim(area > 0, "a piece has a positive area");
			claim(is_simple(outline), "a piece is simple");
			if (state == 1 && cut.pieces.size() > 1) {
				claim(area >= limits.least_area * (1 - 1e-6), "a piece is not below the smallest size");
			}
			for (std::size_t i = 0; cut.pieces.size() > 1 && i < outline.size(); ++i) {
				const std::size_t next = (i + 1) % outline.size();
				const bool are_old = piece[i] < polygon.size() && piece[next] < polygon.size();
				const double size = std::hypot(double(outline[next].x) - outline[i].x, double(outline[next].y) - outline[i].y);
				// Where a later cut ends on an earlier one, and where a bend was carried to the other state, points are nearer.
				claim(are_old || state == 1 || size >= 0.2 * limits.snap, "a new corner is not close to the next one");
			}
		}
	}
	facts.area_error = std::fmax(std::abs(sums[0] / shoelace(polygon) - 1), std::abs(sums[1] / shoelace(twin) - 1));
	claim(facts.area_error <= 1e-5, "areas of the pieces sum to that of the whole");
	for (std::size_t i = 0; i < polygon.size(); ++i) {
		claim(cut.points[i].position == polygon[i] && cut.points[i].twin == twin[i], "corners keep their places");
	}
	return facts;
}

} // namespace softbody::testing
