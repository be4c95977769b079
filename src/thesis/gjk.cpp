// SPDX-License-Identifier: MIT
// GJK: whether two convex sets are apart, and how far.
//
// Both functions search the point v closest to 0 of the set D = { b - a }. A simplex of at most three points of D is
// improved by the point w of D that lies least far along v. D lies wholly beyond the line through w across v, so v·w /
// |v| is a lower bound of the distance, and |v| is an upper bound. Only a positive lower bound makes the sets "apart".
// Rounding can mislead the search into missing a separation, but not into inventing one.
#include "thesis/gjk.h"


#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace softbody {

namespace {

// Sets closer than this touch, relative to the largest difference seen [1]. Some thousand times its rounding.
constexpr double TOUCH_TOLERANCE = 1e-12;

// The search ends when the upper and lower bound of the distance agree to this [1].
constexpr double CONVERGENCE = 1e-12;

struct Corner {
	Vec2d difference; // b - a
	Vec2d a;
	Vec2d b;
};

struct Simplex {
	std::array<Corner, 3> corners;
	int count = 0;
	// Once the simplex is reduced to at most two corners, the point closest to 0 is corners[0] + weight (corners[1] -
	// corners[0]).
	double weight = 0;

	Vec2d mix(Vec2d Corner::*member) const {
		const Vec2d first = corners[0].*member;
		return count < 2 ? first : first + (corners[1].*member - first) * weight;
	}
};

struct Search {
	std::span<const Vec2> a;
	std::span<const Vec2> b;
	Vec2 origin; // coordinates are relative to this: far from the origin of the world they would cancel

	// The point of D that lies least far along the axis.
	Corner support(Vec2d axis) const {
		Corner corner;
		double most = -std::numeric_limits<double>::max();
		for (const Vec2 p : a) {
			const Vec2d q = difference(p, origin);
			if (const double along = dot(q, axis); along > most) {
				most = along;
				corner.a = q;
			}
		}
		double least = std::numeric_limits<double>::max();
		for (const Vec2 p : b) {
			const Vec2d q = difference(p, origin);
			if (const double along = dot(q, axis); along < least) {
				least = along;
				corner.b = q;
			}
		}
		corner.difference = corner.b - corner.a;
		return corner;
	}
};

Simplex closest_on_edge(const Corner &p, const Corner &q) {
	Simplex edge{ { p, q, {} }, 2, 0 };
	const Vec2d along = q.difference - p.difference;
	const double way = -dot(p.difference, along);
	const double size = dot(along, along);
	if (!(way > 0)) {
		edge.count = 1;
	} else if (way >= size) {
		edge.corners[0] = q;
		edge.count = 1;
	} else {
		edge.weight = way / size;
	}
	return edge;
}

// Reduces two or three corners to those that span the edge point closest to 0. All three edges are tried: on a thin
// triangle the signs that would rule one out are noise. If 0 is inside the triangle, the search goes on from an edge
// and soon finds that it gets no closer.
Simplex reduced(const Simplex &simplex) {
	const auto &corners = simplex.corners;
	Simplex best = closest_on_edge(corners[0], corners[1]);
	if (simplex.count == 3) {
		for (const Simplex &edge : { closest_on_edge(corners[1], corners[2]), closest_on_edge(corners[2], corners[0]) }) {
			const Vec2d old_point = best.mix(&Corner::difference);
			const Vec2d new_point = edge.mix(&Corner::difference);
			if (dot(new_point, new_point) < dot(old_point, old_point)) {
				best = edge;
			}
		}
	}
	return best;
}

struct Answer {
	double lower = 0; // largest lower bound of the distance; > 0 only when the sets are apart
	Vec2d normal; // the axis of that bound
	Vec2d axis; // last search axis
	Simplex simplex;
	int iterations = 0;
	bool converged = false;
};

// Ends early once the distance is known to be above `margin`, or known not to be. Never ends early with a margin < 0.
Answer search(const Search &sets, Vec2d axis, int max_iterations, double margin) {
	Answer answer;
	double scale = 0;
	if (!(dot(axis, axis) > 0)) {
		axis = { 1, 0 };
	}
	double upper = std::numeric_limits<double>::max();
	while (answer.iterations < max_iterations) {
		answer.iterations++;
		answer.axis = axis;
		const Corner corner = sets.support(axis);
		const double size = length(axis);
		scale = std::fmax(scale, length(corner.difference));
		const double bound = dot(corner.difference, axis) / size - TOUCH_TOLERANCE * scale;
		if (bound > answer.lower) {
			answer.lower = bound;
			answer.normal = axis * (1 / size);
		}
		if (margin >= 0 && answer.lower > margin) {
			return answer;
		}
		Simplex &simplex = answer.simplex;
		if (simplex.count > 0 && upper - bound <= CONVERGENCE * upper + TOUCH_TOLERANCE * scale) {
			answer.converged = true;
			return answer;
		}
		Simplex next = simplex;
		next.corners[std::size_t(next.count++)] = corner;
		if (next.count > 1) {
			next = reduced(next);
		}
		const Vec2d closest = next.mix(&Corner::difference);
		const double distance = length(closest);
		if (!(distance < upper)) {
			answer.converged = true; // as close as rounding allows
			return answer;
		}
		simplex = next;
		upper = distance;
		axis = closest;
		if (upper <= TOUCH_TOLERANCE * scale || (margin >= 0 && upper <= margin)) {
			return answer;
		}
	}
	return answer;
}

} // namespace

GjkResult gjk(std::span<const Vec2> a, std::span<const Vec2> b, Vec2 first_axis, int max_iterations) {
	GjkResult result;
	if (a.empty() || b.empty()) {
		result.overlap = false;
		result.distance = std::numeric_limits<Real>::infinity();
		return result;
	}
	const Vec2 origin = a[0];
	const Vec2d axis = dot(first_axis, first_axis) > 0 ? difference(first_axis, {}) : difference(b[0], origin);
	const Answer answer = search({ a, b, origin }, axis, max_iterations, -1);
	result.iterations = answer.iterations;
	result.overlap = !(answer.lower > 0);
	if (!result.overlap) {
		const Vec2d from = answer.simplex.mix(&Corner::a);
		const Vec2d to = answer.simplex.mix(&Corner::b);
		const Vec2d base = difference(origin, {});
		result.distance = Real(answer.converged ? length(to - from) : answer.lower);
		result.normal = Vec2(answer.normal);
		result.closest_a = Vec2(base + from);
		result.closest_b = Vec2(base + to);
	}
	return result;
}

bool is_apart(std::span<const Vec2> a, std::span<const Vec2> b, Real margin, Vec2 *axis) {
	if (a.empty() || b.empty()) {
		return true;
	}
	const Vec2d first = axis && dot(*axis, *axis) > 0 ? difference(*axis, {}) : difference(b[0], a[0]);
	const Answer answer = search({ a, b, a[0] }, first, GJK_MAX_ITERATIONS, double(margin));
	if (axis) {
		*axis = Vec2(answer.axis * (1 / length(answer.axis)));
	}
	return answer.lower > double(margin);
}

} // namespace softbody
