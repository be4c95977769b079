// SPDX-License-Identifier: MIT
// The triangles that fill a body, and the colors and texture coordinates between its hull points.
#include "core/skin/fill_mesh.h"

#include "core/base/elementary.h"
#include "core/geometry/polygon.h"
#include "core/skin/outline_band.h"

#include <algorithm>
#include <cassert>
#include <cmath>
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

// Uniform Catmull-Rom: passes through the points, with the mean of the two chords as tangent.
std::vector<Real> curve_weights(std::size_t pieces) {
	std::vector<Real> weights;
	for (std::size_t piece = 0; piece < pieces; ++piece) {
		const Real t = Real(piece) / Real(pieces);
		const Real t2 = t * t;
		const Real t3 = t2 * t;
		weights.insert(weights.end(), { (-t + 2 * t2 - t3) / 2, (2 - 5 * t2 + 3 * t3) / 2, (t + 4 * t2 - 3 * t3) / 2,
												(t3 - t2) / 2 });
	}
	return weights;
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
	curve_ = curve_weights(options_.pieces);
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

void FillMesh::fill() {
	std::vector<Vec2> points(rim_count());
	place_rim(rest_, points);
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
