// SPDX-License-Identifier: MIT
// GJK: whether two convex sets are apart, and how far. Thesis Alg. 4.1 and 4.2 in a corrected form.
#pragma once

#include "core/base/vec2.h"

#include <span>

namespace softbody {

/// Most iterations of GJK [1]. Sets of up to 4096 points on a circle take at most about 20. Past the cap the result is
/// that the sets may overlap.
inline constexpr int GJK_MAX_ITERATIONS = 64;

/// Result of GJK for two sets A and B.
struct GjkResult {
	/// False only when an axis has been found that separates the sets. True when the sets overlap or touch (within
	/// 1e-12 of the differences of points looked at), and when the iterations ran out first.
	bool overlap = true;
	/// Least distance [length], rounded; 0 on overlap. A lower bound if the iterations ran out.
	Real distance = 0;
	/// Unit axis from A to B along which the sets are `distance` apart; 0 on overlap.
	Vec2 normal;
	Vec2 closest_a; ///< closest points, in the convex hulls of A and B; 0 on overlap
	Vec2 closest_b;
	int iterations = 0; ///< iterations taken
};

/// Distance of the convex hulls of two sets of points. The sets need no order. Points may be collinear, coincident or
/// single, so a span of hull points can be passed directly; for a concave body this is the distance of its convex hull.
/// `first_axis`, of any length, is the first search axis; it does not change the result. Empty sets are infinitely far
/// apart. Precondition: finite points. No allocation, O((|A| + |B|) · iterations).
/// Source: Gilbert, Johnson and Keerthi 1988, stopped by the bound v·w / |v| of van den Bergen 1999. The thesis ends
/// when a triangle encloses the origin or can be moved no further, for sets that do not touch and points that are not
/// collinear. Here only a separating axis makes sets apart.
GjkResult gjk(std::span<const Vec2> a, std::span<const Vec2> b, Vec2 first_axis = {},
		int max_iterations = GJK_MAX_ITERATIONS);

/// True only when the sets are certain to be apart by more than `margin` [length], >= 0. Ends at the first axis that
/// shows it, so it is cheaper than the distance. `axis`, if given, is the first search axis and receives the last one.
/// With an axis kept for each pair, most pairs that stay apart cost a single iteration.
bool is_apart(std::span<const Vec2> a, std::span<const Vec2> b, Real margin, Vec2 *axis = nullptr);

} // namespace softbody
