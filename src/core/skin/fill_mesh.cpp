// SPDX-License-Identifier: MIT
// The triangles that fill a body, and the colors and texture coordinates between its hull points.
#include "core/skin/fill_mesh.h"

#include "core/base/elementary.h"
#include "core/geometry/polygon.h"
#include "core/skin/outline_band.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace softbody {

namespace {

Vec2 mean_of(std::span<const Vec2> points) {
	Vec2 sum;
	for (const Vec2 p : points) {
		sum += p;
	}
	return sum * (1 / Real(points.size()));
}

// Mean value coordinates of a place inside a polygon: w_i = (tan(α_{i-1}/2) + tan(α_i/2)) / r_i, normalized. r_i is the
// distance of corner i, α_i the signed angle under which the edge after it is seen.
std::vector<Real> mean_value_weights(Vec2 place, std::span<const Vec2> polygon) {
	const std::size_t count = polygon.size();
	std::vector<double> weights(count, 0.0);
	double sum = 0;
	for (std::size_t i = 0; i < count; ++i) {
		const std::size_t next = (i + 1) % count;
		const Vec2 a = polygon[i] - place;
		const Vec2 b = polygon[next] - place;
		const double ra = hypotenuse(double(a.x), double(a.y));
		const double rb = hypotenuse(double(b.x), double(b.y));
		const double cosine = double(a.x) * b.x + double(a.y) * b.y;
		const double sine = double(a.x) * b.y - double(a.y) * b.x;
		const double divisor = ra * rb + cosine;
		if (!(ra > 0) || !(divisor > 1e-9 * ra * rb)) {
			// On a corner or edge the values are those of the edge.
			std::vector<Real> on_edge(count, Real(0));
			const double share = ra + rb > 0 ? ra / (ra + rb) : 0;
			on_edge[i] = Real(1 - share);
			on_edge[next] += Real(share);
			return on_edge;
		}
		const double half_tangent = sine / divisor;
		weights[i] += half_tangent / ra;
		weights[next] += rb > 0 ? half_tangent / rb : 0;
		sum += half_tangent / ra + (rb > 0 ? half_tangent / rb : 0);
	}
	std::vector<Real> normalized;
	for (const double weight : weights) {
		// Outside the hull the sum may vanish. Nothing is drawn there, so any number is fine.
		normalized.push_back(std::abs(sum) > 0 ? Real(weight / sum) : 1 / Real(count));
	}
	return normalized;
}

// A slender body bends so far that its middle no longer sees its ends: 4 π area over the square of the perimeter is 0.50 for a
// rectangle of 1 : 4, and 1 for a disk.
bool is_slender(std::span<const Vec2> hull) {
	constexpr Real LEAST_COMPACTNESS = Real(0.5);
	const Real around = perimeter(hull);
	return 4 * std::numbers::pi_v<Real> * std::abs(signed_area(hull)) < LEAST_COMPACTNESS * around * around;
}

// How much sharper a corner is than its neighbors, as a difference of 1 - cos of the turns: 1 for a right angle in straight sides, 0 in
// every regular polygon. The curve's tangent is that of Catmull and Rom up to the first, and none from the second on.
constexpr Real ROUNDED = Real(0.15);
constexpr Real SHARP = Real(0.5);

// 1 - cos of the turn at each point of a closed outline: 0 to 2.
std::vector<Real> turns_of(std::span<const Vec2> loop) {
	const std::size_t count = loop.size();
	std::vector<Real> turns;
	for (std::size_t i = 0; i < count; ++i) {
		const Vec2 in = loop[i] - loop[(i + count - 1) % count];
		const Vec2 out = loop[(i + 1) % count] - loop[i];
		const Real size = length(in) * length(out);
		turns.push_back(size > 0 ? 1 - dot(in, out) / size : 0);
	}
	return turns;
}

// Share of the tangent that each point of a closed outline has.
void append_tangents(std::span<const Vec2> loop, std::vector<Real> &tangents) {
	const std::vector<Real> turns = turns_of(loop);
	const std::size_t count = loop.size();
	for (std::size_t i = 0; i < count; ++i) {
		const Real excess = turns[i] - (turns[(i + count - 1) % count] + turns[(i + 1) % count]) / 2;
		tangents.push_back(std::clamp((SHARP - excess) / (SHARP - ROUNDED), Real(0), Real(1)));
	}
}

// Uniform Catmull-Rom: passes through the points, with the mean of the two chords as tangent, or with a share of it at the begin and
// the end of the edge.
void append_curve_weights(std::size_t pieces, Real begin, Real end, std::vector<Real> &weights) {
	for (std::size_t piece = 0; piece < pieces; ++piece) {
		const Real t = Real(piece) / Real(pieces);
		const Real t2 = t * t;
		const Real t3 = t2 * t;
		const Real leaving = begin * (t - 2 * t2 + t3) / 2;
		const Real arriving = end * (t3 - t2) / 2;
		weights.insert(weights.end(), { -leaving, 1 - 3 * t2 + 2 * t3 - arriving, 3 * t2 - 2 * t3 + leaving, arriving });
	}
}

Real square_distance(Vec2 place, Vec2 a, Vec2 b) {
	const Vec2 edge = b - a;
	const Real square = length_squared(edge);
	const Real share = square > 0 ? std::clamp(dot(place - a, edge) / square, Real(0), Real(1)) : 0;
	return length_squared(a + edge * share - place);
}

// The distance between two edges that do not meet: from an end of one to the other.
Real edge_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
	return std::sqrt(std::min({ square_distance(a, c, d), square_distance(b, c, d), square_distance(c, a, b), square_distance(d, a, b) }));
}

} // namespace

FillMesh::FillMesh(std::span<const Vec2> rest, std::size_t hull_count, const Options &options, std::span<const std::size_t> holes) :
		options_(options), rest_(rest.begin(), rest.end()), hull_count_(hull_count), loops_{ hull_count }, loop_points_(hull_count) {
	for (const std::size_t hole : holes) {
		loops_.push_back(hole);
		loop_points_ += hole;
	}
	assert(hull_count >= 3 && loop_points_ <= rest.size() && options.pieces >= 1);
	side_ = signed_area(rest.first(hull_count)) < 0 ? Real(-1) : Real(1);
	make_curve();
	fill();
	for (std::size_t i = hull_count; i < rest_.size(); ++i) {
		(i < loop_points_ ? hole_weights_ : inner_weights_).push_back(mean_value_weights(rest_[i], rest.first(hull_count)));
	}
	if (has_mean_) {
		inner_weights_.push_back(std::vector<Real>(hull_count, 1 / Real(hull_count)));
	}
	band_start_ = rim_count() + inner_weights_.size();
	faded_start_ = band_start_;
	vertex_count_ = band_start_;
	const bool has_band = options_.soft_edge > 0 && options_.band > 0;
	if (has_band) {
		add_ring(0);
		faded_start_ = vertex_count_;
	}
	if (options_.soft_edge > 0) {
		add_ring(has_band ? band_start_ : 0);
	}
}

void FillMesh::add_ring(std::size_t inner) {
	const std::size_t outer = vertex_count_;
	vertex_count_ += rim_count();
	for_rims([&](std::size_t start, std::size_t count) {
		const std::uint32_t inside = std::uint32_t(inner + start);
		const std::uint32_t outside = std::uint32_t(outer + start);
		const std::uint32_t rim = std::uint32_t(count);
		for (std::uint32_t i = 0; i < rim; ++i) {
			const std::uint32_t next = (i + 1) % rim;
			triangles_.push_back({ inside + i, inside + next, outside + next });
			triangles_.push_back({ inside + i, outside + next, outside + i });
		}
	});
}

void FillMesh::make_curve() {
	std::vector<Real> tangents;
	std::size_t start = 0;
	for (const std::size_t loop : loops_) {
		append_tangents(std::span<const Vec2>(rest_).subspan(start, loop), tangents);
		start += loop;
	}
	if (options_.pieces == 1 || std::ranges::all_of(tangents, [](Real share) { return share == 1; })) {
		append_curve_weights(options_.pieces, 1, 1, curve_);
		return;
	}
	curve_step_ = 4 * options_.pieces;
	start = 0;
	for (const std::size_t loop : loops_) {
		for (std::size_t i = 0; i < loop; ++i) {
			append_curve_weights(options_.pieces, tangents[start + i], tangents[start + (i + 1) % loop], curve_);
		}
		start += loop;
	}
}

// Bands of two outlines that are near each other would overlap, and the inner line of one would be drawn over the other. A vertex goes in by
// less than half of what is between its two edges and the nearest of another outline.
void FillMesh::limit_band(std::span<const Vec2> rim) {
	constexpr Real MOST_OF_GAP = Real(0.45);
	band_widths_.assign(rim.size(), options_.band);
	for_rims([&](std::size_t start, std::size_t count) {
		for_rims([&](std::size_t other, std::size_t other_count) {
			for (std::size_t i = 0; i < count && other != start; ++i) {
				const std::size_t next = start + (i + 1) % count;
				for (std::size_t k = 0; k < other_count; ++k) {
					const Real gap = edge_distance(rim[start + i], rim[next], rim[other + k], rim[other + (k + 1) % other_count]);
					band_widths_[start + i] = std::min(band_widths_[start + i], MOST_OF_GAP * gap);
					band_widths_[next] = std::min(band_widths_[next], MOST_OF_GAP * gap);
				}
			}
		});
	});
	if (std::ranges::all_of(band_widths_, [&](Real width) { return width == options_.band; })) {
		band_widths_.clear();
	}
}

void FillMesh::fill() {
	std::vector<Vec2> points(rim_count());
	place_rim(rest_, points);
	if (loops_.size() > 1 && options_.band > 0 && options_.soft_edge > 0) {
		limit_band(points);
	}
	const std::uint32_t rim = std::uint32_t(points.size());
	if (loops_.size() > 1) {
		std::vector<std::size_t> rims;
		for_rims([&](std::size_t, std::size_t count) { rims.push_back(count); });
		points.insert(points.end(), rest_.begin() + std::ptrdiff_t(loop_points_), rest_.end());
		triangles_ = triangulate(points, rims);
		return;
	}
	const std::size_t inner = rest_.size() - hull_count_;
	const Vec2 middle = inner == 1 ? rest_.back() : mean_of(std::span<const Vec2>(rest_).first(hull_count_));
	const bool is_slim = is_slender(std::span<const Vec2>(rest_).first(hull_count_));
	if (inner <= 1 && !is_slim && is_star_shaped_about(middle, points)) {
		has_mean_ = inner == 0;
		for (std::uint32_t i = 0; i < rim; ++i) {
			triangles_.push_back({ rim, i, (i + 1) % rim });
		}
		return;
	}
	if (inner == 1 && is_slim) { // a center point may be left beside the bend
		triangles_ = triangulate(points, rim);
		return;
	}
	points.insert(points.end(), rest_.begin() + std::ptrdiff_t(hull_count_), rest_.end());
	triangles_ = triangulate(points, rim);
}

void FillMesh::place_rim(std::span<const Vec2> points, std::span<Vec2> rim) const {
	if (options_.pieces == 1) {
		std::copy_n(points.begin(), loop_points_, rim.begin());
		return;
	}
	Vec2 *write = rim.data();
	for_rim(points, [&](Vec2 place) { *write++ = place; });
}

void FillMesh::place(std::span<const Vec2> points, std::span<const Vec2> rim, std::span<Vec2> vertices) const {
	assert(points.size() >= rest_.size() && vertices.size() >= vertex_count_);
	std::ranges::copy(rim, vertices.begin());
	const std::span<const Vec2> inner = points.subspan(loop_points_, rest_.size() - loop_points_);
	std::ranges::copy(inner, vertices.begin() + std::ptrdiff_t(rim.size()));
	if (has_mean_) {
		vertices[rim.size()] = mean_of(points.first(hull_count_));
	}
	if (options_.soft_edge > 0) {
		const Real half = options_.soft_edge / 2 * side_;
		for_rims([&](std::size_t start, std::size_t count) {
			const std::span<const Vec2> loop = rim.subspan(start, count);
			if (faded_start_ != band_start_) {
				if (!band_widths_.empty()) {
					move_corners(loop, std::span<const Real>(band_widths_).subspan(start, count), side_, vertices.subspan(start, count));
					move_corners(loop, half, vertices.subspan(band_start_ + start, count));
					move_corners(loop, -half, vertices.subspan(faded_start_ + start, count));
					return;
				}
				move_corners(loop, { options_.band * side_, half, -half }, { vertices.subspan(start, count), vertices.subspan(band_start_ + start, count), vertices.subspan(faded_start_ + start, count) });
				return;
			}
			move_corners(loop, half, vertices.subspan(start, count));
			move_corners(loop, -half, vertices.subspan(faded_start_ + start, count));
		});
	} else if (options_.inset > 0) {
		for_rims([&](std::size_t start, std::size_t count) { move_corners(rim.subspan(start, count), options_.inset * side_, vertices.subspan(start, count)); });
	}
}

} // namespace softbody
