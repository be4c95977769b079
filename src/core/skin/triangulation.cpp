// SPDX-License-Identifier: MIT
// Triangles that fill an outline, with points inside it as corners.
#include "core/skin/triangulation.h"

#include "core/geometry/polygon.h"
#include "core/skin/bridged_loops.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace softbody {

namespace {

constexpr std::uint32_t NONE = UINT32_MAX;

// How far inside a circle a point must lie to count [relative to the product of the lengths involved]. It keeps four
// points of one circle from being flipped forever.
constexpr double CIRCLE_TOLERANCE = 1e-7;

class Filling {
public:
	/// Further points begin at `first_inner`.
	Filling(std::span<const Vec2> points, std::size_t first_inner) :
			points_(points), first_inner_(std::uint32_t(first_inner)) {}

	/// `outline` are indices of a polygon of positive winding, which may run along a line there and back.
	std::vector<Triangle> make(std::vector<std::uint32_t> outline) {
		cut_ears(std::move(outline));
		for (std::uint32_t i = first_inner_; i < points_.size(); ++i) {
			insert(i);
		}
		join();
		flip_edges();
		return std::move(triangles_);
	}

private:
	double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
		return signed_double_area(points_[a], points_[b], points_[c]);
	}

	void cut_ears(std::vector<std::uint32_t> rest) {
		std::size_t at = 0;
		std::size_t misses = 0;
		while (rest.size() > 3) {
			const std::size_t count = rest.size();
			at %= count;
			// Every simple polygon has two ears. If rounding hides them, cutting any corner still ends with a filling.
			if (is_ear(rest, at) || misses > count) {
				triangles_.push_back({ rest[(at + count - 1) % count], rest[at], rest[(at + 1) % count] });
				rest.erase(rest.begin() + std::ptrdiff_t(at));
				misses = 0;
			} else {
				misses++;
			}
			// Continuing behind the neighbor keeps the triangles from fanning out around one corner.
			at++;
		}
		triangles_.push_back({ rest[0], rest[1], rest[2] });
	}

	bool is_ear(const std::vector<std::uint32_t> &rest, std::size_t at) const {
		const std::size_t count = rest.size();
		const std::uint32_t a = rest[(at + count - 1) % count];
		const std::uint32_t b = rest[at];
		const std::uint32_t c = rest[(at + 1) % count];
		if (!(area(a, b, c) > 0)) {
			return false;
		}
		// A point on the cut would leave a polygon that touches itself.
		return std::ranges::none_of(rest, [&](std::uint32_t p) {
			return p != a && p != b && p != c && point_in_triangle(points_[p], points_[a], points_[b], points_[c]);
		});
	}

	// Divides the triangle that holds the point. For a point on an edge one part is flat until the edge is flipped.
	void insert(std::uint32_t p) {
		const auto found = std::ranges::find_if(triangles_, [&](const Triangle &t) {
			return point_in_triangle(points_[p], points_[t[0]], points_[t[1]], points_[t[2]]);
		});
		if (found == triangles_.end()) {
			return;
		}
		const Triangle whole = *found;
		if (std::ranges::any_of(whole, [&](std::uint32_t corner) { return points_[corner] == points_[p]; })) {
			return;
		}
		*found = { whole[0], whole[1], p };
		triangles_.push_back({ whole[1], whole[2], p });
		triangles_.push_back({ whole[2], whole[0], p });
	}

	// Finds the neighbor across each edge; edge k of a triangle is opposite to its corner k.
	void join() {
		struct Side {
			std::uint32_t from, to, triangle, edge;
		};
		std::vector<Side> sides;
		for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
			for (std::uint32_t k = 0; k < 3; ++k) {
				const std::uint32_t a = triangles_[t][(k + 1) % 3];
				const std::uint32_t b = triangles_[t][(k + 2) % 3];
				sides.push_back({ std::min(a, b), std::max(a, b), t, k });
			}
		}
		std::ranges::sort(sides, [](const Side &a, const Side &b) {
			return std::array{ a.from, a.to, a.triangle } < std::array{ b.from, b.to, b.triangle };
		});
		neighbors_.assign(triangles_.size(), { NONE, NONE, NONE });
		for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
			const Side &a = sides[i];
			const Side &b = sides[i + 1];
			if (a.from == b.from && a.to == b.to) {
				neighbors_[a.triangle][a.edge] = b.triangle;
				neighbors_[b.triangle][b.edge] = a.triangle;
			}
		}
	}

	void flip_edges() {
		std::vector<std::uint32_t> suspects(triangles_.size());
		std::iota(suspects.begin(), suspects.end(), 0u);
		// Lawson's flips end by themselves, after a quadratic number at worst; the bound guards against rounding.
		std::size_t flips_left = 1000 + 64 * triangles_.size();
		while (!suspects.empty() && flips_left > 0) {
			const std::uint32_t t = suspects.back();
			suspects.pop_back();
			for (std::uint32_t k = 0; k < 3; ++k) {
				const std::uint32_t other = neighbors_[t][k];
				if (other != NONE && flip(t, k, other)) {
					suspects.push_back(t);
					suspects.push_back(other);
					flips_left--;
					break;
				}
			}
		}
	}

	// The two triangles a b p and b a q with the edge ab between them become a q p and q b p, if that is better.
	bool flip(std::uint32_t t, std::uint32_t k, std::uint32_t other) {
		const std::uint32_t p = triangles_[t][k];
		const std::uint32_t a = triangles_[t][(k + 1) % 3];
		const std::uint32_t b = triangles_[t][(k + 2) % 3];
		const std::uint32_t edge = std::uint32_t(std::ranges::find(neighbors_[other], t) - neighbors_[other].begin());
		const std::uint32_t q = triangles_[other][edge];
		if (!(area(a, q, p) > 0 && area(q, b, p) > 0)) {
			return false;
		}
		const bool is_flat = area(a, b, p) <= 0 || area(b, a, q) <= 0;
		if (!is_flat && !is_in_circle(a, b, p, q)) {
			return false;
		}
		const std::uint32_t beyond_bp = neighbors_[t][(k + 1) % 3];
		const std::uint32_t beyond_pa = neighbors_[t][(k + 2) % 3];
		const std::uint32_t beyond_aq = neighbors_[other][(edge + 1) % 3];
		const std::uint32_t beyond_qb = neighbors_[other][(edge + 2) % 3];
		triangles_[t] = { a, q, p };
		neighbors_[t] = { other, beyond_pa, beyond_aq };
		triangles_[other] = { q, b, p };
		neighbors_[other] = { beyond_bp, t, beyond_qb };
		replace_neighbor(beyond_aq, other, t);
		replace_neighbor(beyond_bp, t, other);
		return true;
	}

	void replace_neighbor(std::uint32_t triangle, std::uint32_t old, std::uint32_t fresh) {
		if (triangle != NONE) {
			std::ranges::replace(neighbors_[triangle], old, fresh);
		}
	}

	// Whether q lies within the circle through a, b and p (positive winding).
	bool is_in_circle(std::uint32_t a, std::uint32_t b, std::uint32_t p, std::uint32_t q) const {
		std::array<std::array<double, 3>, 3> rows{};
		double largest = 0;
		const std::array<std::uint32_t, 3> corners{ a, b, p };
		for (std::size_t i = 0; i < 3; ++i) {
			const double x = double(points_[corners[i]].x) - points_[q].x;
			const double y = double(points_[corners[i]].y) - points_[q].y;
			rows[i] = { x, y, x * x + y * y };
			largest = std::max(largest, rows[i][2]);
		}
		const double determinant = rows[0][2] * (rows[1][0] * rows[2][1] - rows[2][0] * rows[1][1]) +
				rows[1][2] * (rows[2][0] * rows[0][1] - rows[0][0] * rows[2][1]) +
				rows[2][2] * (rows[0][0] * rows[1][1] - rows[1][0] * rows[0][1]);
		return determinant > CIRCLE_TOLERANCE * largest * largest;
	}

	std::span<const Vec2> points_;
	std::uint32_t first_inner_;
	std::vector<Triangle> triangles_;
	std::vector<Triangle> neighbors_; ///< across the edge opposite to each corner
};

} // namespace

std::vector<Triangle> triangulate(std::span<const Vec2> points, std::size_t hull_count) {
	assert(hull_count >= 3 && hull_count <= points.size());
	std::vector<std::uint32_t> outline(hull_count);
	std::iota(outline.begin(), outline.end(), 0u);
	if (signed_area(points.first(hull_count)) < 0) { // of negative winding it is read backwards
		std::ranges::reverse(outline);
	}
	return Filling(points, hull_count).make(std::move(outline));
}

std::vector<Triangle> triangulate(std::span<const Vec2> points, std::span<const std::size_t> loops) {
	std::size_t count = 0;
	for (const std::size_t loop : loops) {
		count += loop;
	}
	assert(!loops.empty() && count <= points.size());
	return Filling(points, count).make(bridge_loops(points, loops));
}

} // namespace softbody
