// SPDX-License-Identifier: MIT
// The triangles that fill a body, and the colors and texture coordinates between its hull points.
#pragma once

#include "core/base/vec2.h"
#include "core/skin/triangulation.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace softbody {

/// The mesh of a body's inside. It is made once from the rest shape; a frame only places its vertices.
///
/// Vertices, in this order: the rim, which is the hull or a curve through it, and then those of the holes; the body's inner points; if there are
/// none and the middle sees the whole hull, a middle, the mean of the hull; with a shaded band, its outer line; with a
/// soft edge, the rim again, farther out. Triangles spread out from the middle if it sees the whole rim of a body that is not
/// slender, and otherwise are those of `triangulate`.
class FillMesh {
public:
	/// How the mesh is made.
	struct Options {
		/// Pieces of each hull edge. 1 draws it straight; more follow a smooth curve (Catmull and Rom 1974). A corner that is drawn
		/// sharper at rest than its neighbors stays one: beside it the curve does not swing out of straight sides.
		std::size_t pieces = 1;
		/// Width of the edge over which the body fades out, half of it inside [length]; 0 is a hard edge.
		Real soft_edge = 0;
		/// Without a soft edge: how far inside the rim the triangles end [length], for an outline that hides their edge.
		Real inset = 0;
		/// With a soft edge: width of a band along the rim, inside it, that can have other colors than the fill [length]; 0: none. Where a hole
		/// leaves less than that on both sides, the band is narrower.
		Real band = 0;

		friend bool operator==(const Options &, const Options &) = default;
	};

	FillMesh() = default;
	/// `rest` are all points at rest, the hull first, accepted by `check_hull`, of either winding. Usually O(rim²). `holes` are the numbers of
	/// points of its holes, which come next in `rest`, accepted by `check_holes`, each of the other winding than the hull.
	FillMesh(std::span<const Vec2> rest, std::size_t hull_count, const Options &options, std::span<const std::size_t> holes = {});

	/// Whether the constructor would make the same mesh of these.
	bool is_made_of(std::span<const Vec2> rest, std::size_t hull_count, const Options &options, std::span<const std::size_t> holes = {}) const {
		return hull_count == hull_count_ && options == options_ && std::ranges::equal(rest, rest_) && std::ranges::equal(holes, std::span(loops_).subspan(1));
	}

	std::size_t vertex_count() const { return vertex_count_; }
	std::size_t rim_count() const { return loop_points_ * options_.pieces; }
	/// Calls `each(start, count)` with the part of the rim that is the hull's, and then with those of the holes.
	void for_rims(const auto &each) const {
		std::size_t start = 0;
		for (const std::size_t loop : loops_) {
			each(start * options_.pieces, loop * options_.pieces);
			start += loop;
		}
	}
	/// First vertex of the band's outer line; `faded_start()` without a band.
	std::size_t band_start() const { return band_start_; }
	/// First vertex of the faded rim; `vertex_count()` without a soft edge.
	std::size_t faded_start() const { return faded_start_; }
	const std::vector<Triangle> &triangles() const { return triangles_; }
	/// 1 where the hull at rest has positive winding, else -1.
	Real side() const { return side_; }

	/// Writes the `rim_count()` places of the rim for a body whose points lie at `points`. O(rim).
	void place_rim(std::span<const Vec2> points, std::span<Vec2> rim) const;
	/// Writes the places of all vertices; `rim` is the result of `place_rim`. O(vertices), no allocation.
	void place(std::span<const Vec2> points, std::span<const Vec2> rim, std::span<Vec2> vertices) const;

	/// Gives every vertex a value, from values of the hull points: along the rim as `place_rim` does, inside by mean
	/// value coordinates of the rest shape (Floater 2003), which are smooth and reproduce linear maps; along the rims of holes by the values
	/// that its points have so.
	template <class Value>
	std::vector<Value> spread(std::span<const Value> hull_values) const;

private:
	void fill();
	void make_curve();
	/// `rim` is at rest.
	void limit_band(std::span<const Vec2> rim);
	/// Adds vertices along the rim again, and triangles from those that begin at `inner` to them.
	void add_ring(std::size_t inner);
	/// Calls `each` with the value of every rim vertex, in order, for values of the points of the hull and of the holes.
	template <class Value>
	void for_rim(std::span<const Value> values, const auto &each) const;
	template <class Value>
	Value mean_by(const std::vector<Real> &weights, std::span<const Value> hull_values) const;

	Options options_;
	std::vector<Vec2> rest_;
	std::size_t hull_count_ = 0;
	std::vector<std::size_t> loops_{ 0 }; ///< number of points of the hull and of each hole
	std::size_t loop_points_ = 0; ///< of the hull and the holes
	bool has_mean_ = false; ///< whether the middle is a vertex of its own
	Real side_ = 1;
	std::size_t band_start_ = 0;
	std::size_t faded_start_ = 0;
	std::size_t vertex_count_ = 0;
	std::vector<Triangle> triangles_;
	/// Four weights for each piece of an edge: of the points before, at, after, after that. Of every edge the same, or of each its own.
	std::vector<Real> curve_;
	std::size_t curve_step_ = 0; ///< from the weights of one edge to those of the next; 0 if all edges have the same
	std::vector<Real> band_widths_; ///< of each vertex of the rim; empty where it is `Options::band` everywhere
	std::vector<std::vector<Real>> hole_weights_; ///< of the hull points, for each point of a hole
	std::vector<std::vector<Real>> inner_weights_; ///< the same for each inner vertex
};

template <class Value>
void FillMesh::for_rim(std::span<const Value> values, const auto &each) const {
	const Value *loop_values = values.data();
	const Real *edge_weights = curve_.data();
	for (const std::size_t count : loops_) {
		Value before = loop_values[count - 1];
		Value at = loop_values[0];
		Value after = loop_values[1];
		for (std::size_t i = 0; i < count; ++i) {
			const Value next = loop_values[(i + 2) % count];
			for (std::size_t piece = 0; piece < options_.pieces; ++piece) {
				const Real *weight = edge_weights + 4 * piece;
				each(before * weight[0] + at * weight[1] + after * weight[2] + next * weight[3]);
			}
			edge_weights += curve_step_;
			before = at;
			at = after;
			after = next;
		}
		loop_values += count;
	}
}

template <class Value>
Value FillMesh::mean_by(const std::vector<Real> &weights, std::span<const Value> hull_values) const {
	Value sum = hull_values[0] * weights[0];
	for (std::size_t i = 1; i < hull_count_; ++i) {
		sum += hull_values[i] * weights[i];
	}
	return sum;
}

template <class Value>
std::vector<Value> FillMesh::spread(std::span<const Value> hull_values) const {
	std::vector<Value> values;
	values.reserve(vertex_count_);
	const auto add = [&](const Value &value) { values.push_back(value); };
	if (hole_weights_.empty()) {
		for_rim(hull_values, add);
	} else {
		std::vector<Value> of_loops(hull_values.begin(), hull_values.begin() + std::ptrdiff_t(hull_count_));
		for (const std::vector<Real> &weights : hole_weights_) {
			of_loops.push_back(mean_by(weights, hull_values));
		}
		for_rim(std::span<const Value>(of_loops), add);
	}
	for (const std::vector<Real> &weights : inner_weights_) {
		values.push_back(mean_by(weights, hull_values));
	}
	for (std::size_t i = 0; band_start_ + i < vertex_count_; ++i) {
		values.push_back(values[i % rim_count()]);
	}
	return values;
}

} // namespace softbody
