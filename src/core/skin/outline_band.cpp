// SPDX-License-Identifier: MIT
// A band of triangles along a closed outline, whose corners are rounded where they spread.
#include "core/skin/outline_band.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace softbody {

namespace {

// Longest mitre on the side where edges spread, as a multiple of the distance. Longer mitres, of corners below 29
// degrees, are cut off, which takes a little from both edges.
constexpr Real LONGEST_MITRE = 4;

// A corner of the outline: its edges, their normals and mitre.
struct Corner {
	Vec2 place;
	Vec2 normal_before; ///< unit, to the left of the edge that comes in
	Vec2 normal_after;
	Real turn = 0; ///< sine of the angle between the edges, positive to the left
	Vec2 mitre; ///< from the corner to where the edges meet after moving left by 1
	Real shorter_edge = 0;
};

Vec2 normal_of(Vec2 edge, Real edge_length, Vec2 otherwise) {
	return edge_length > 0 ? perpendicular(edge) * (1 / edge_length) : otherwise;
}

Corner corner_of(Vec2 before, Vec2 place, Vec2 after) {
	const Vec2 in = place - before;
	const Vec2 out = after - place;
	const Real in_length = length(in);
	const Real out_length = length(out);
	Corner corner;
	corner.place = place;
	corner.normal_after = normal_of(out, out_length, normal_of(in, in_length, Vec2{ 0, 1 }));
	corner.normal_before = normal_of(in, in_length, corner.normal_after);
	corner.turn = cross(corner.normal_before, corner.normal_after);
	corner.shorter_edge = std::min(in_length, out_length);
	// The sum of two unit normals has the mitre's direction and length 2 cos(half the angle), the mitre 1 over that
	// cosine.
	const Vec2 sum = corner.normal_before + corner.normal_after;
	corner.mitre = sum * (2 / std::max(length_squared(sum), Real(1e-6)));
	return corner;
}

// The unit vector between two others; `otherwise` where they are opposite, as edges fold back onto each other.
Vec2 direction_between(Vec2 from, Vec2 to, Real share, Vec2 otherwise) {
	const Vec2 between = from * (1 - share) + to * share;
	const Real size = length(between);
	return size > Real(1e-3) ? between * (1 / size) : otherwise;
}

// Vertex `k` of `count` on an arc around the corner, from one normal to the other. In two halves, as a blend of vectors
// more than a right angle apart would crowd at the ends.
Vec2 arc_point(const Corner &corner, Real distance, std::uint32_t k, std::uint32_t count) {
	const Vec2 tip = perpendicular(corner.normal_before) * (distance > 0 ? Real(-1) : Real(1));
	const Vec2 half = direction_between(corner.normal_before, corner.normal_after, Real(0.5), tip);
	const Real share = 2 * Real(k) / Real(count - 1);
	return corner.place +
			(share < 1 ? direction_between(corner.normal_before, half, share, half)
					   : direction_between(half, corner.normal_after, share - 1, half)) *
			distance;
}

Vec2 mitre_point(const Corner &corner, Real distance) {
	const Vec2 arm = corner.mitre * distance;
	const bool spreads = corner.turn * distance < 0;
	const Real longest = spreads ? LONGEST_MITRE * std::abs(distance)
								 : std::sqrt(corner.shorter_edge * corner.shorter_edge + distance * distance);
	const Real size = length(arm);
	return corner.place + (size > longest ? arm * (longest / size) : arm);
}

} // namespace

void move_corners(std::span<const Vec2> outline, Real distance, std::span<Vec2> moved) {
	const std::size_t count = outline.size();
	for (std::size_t i = 0; i < count; ++i) {
		moved[i] = mitre_point(corner_of(outline[(i + count - 1) % count], outline[i], outline[(i + 1) % count]), distance);
	}
}

void move_corners(std::span<const Vec2> outline, std::span<const Real> distances, Real side, std::span<Vec2> moved) {
	const std::size_t count = outline.size();
	for (std::size_t i = 0; i < count; ++i) {
		moved[i] = mitre_point(corner_of(outline[(i + count - 1) % count], outline[i], outline[(i + 1) % count]), distances[i] * side);
	}
}

void move_corners(std::span<const Vec2> outline, const std::array<Real, 3> &distances, const std::array<std::span<Vec2>, 3> &moved) {
	const std::size_t count = outline.size();
	Vec2 before = outline[count - 1];
	for (std::size_t i = 0; i < count; ++i) {
		const Corner corner = corner_of(before, outline[i], outline[i + 1 < count ? i + 1 : 0]);
		before = outline[i];
		for (std::size_t line = 0; line < distances.size(); ++line) {
			moved[line][i] = mitre_point(corner, distances[line]);
		}
	}
}

OutlineBand::OutlineBand(std::size_t corner_count, std::span<const Rail> rails, std::span<const std::uint8_t> edges) :
		corner_count_(corner_count), rails_(rails.begin(), rails.end()) {
	assert(corner_count >= 3 && rails.size() >= 2 && (edges.empty() || edges.size() == corner_count));
	const auto has_edge = [&](std::size_t corner) { return edges.empty() || edges[corner % corner_count] != 0; };
	std::vector<std::uint32_t> starts;
	for (const Rail &rail : rails_) {
		starts.push_back(std::uint32_t(vertex_count_));
		vertex_count_ += (corner_count + 1) * rail.corner_points;
	}
	for (std::size_t r = 0; r + 1 < rails_.size(); ++r) {
		const std::uint32_t near_points = rails_[r].corner_points;
		const std::uint32_t far_points = rails_[r + 1].corner_points;
		const auto near_vertex = [&](std::size_t corner, std::uint32_t k) {
			return starts[r] + std::uint32_t(corner) * near_points + std::min(k, near_points - 1);
		};
		const auto far_vertex = [&](std::size_t corner, std::uint32_t k) {
			return starts[r + 1] + std::uint32_t(corner) * far_points + std::min(k, far_points - 1);
		};
		for (std::size_t corner = 0; corner < corner_count; ++corner) {
			const bool has_corner = has_edge(corner) || has_edge(corner + corner_count - 1);
			for (std::uint32_t k = 0; has_corner && k + 1 < std::max(near_points, far_points); ++k) {
				if (far_vertex(corner, k) != far_vertex(corner, k + 1)) {
					triangles_.push_back({ near_vertex(corner, k), far_vertex(corner, k), far_vertex(corner, k + 1) });
				}
				if (near_vertex(corner, k) != near_vertex(corner, k + 1)) {
					triangles_.push_back({ near_vertex(corner, k), far_vertex(corner, k + 1), near_vertex(corner, k + 1) });
				}
			}
			if (!has_edge(corner)) {
				continue;
			}
			const std::uint32_t near_last = near_vertex(corner, near_points - 1);
			const std::uint32_t far_last = far_vertex(corner, far_points - 1);
			triangles_.push_back({ near_last, far_last, far_vertex(corner + 1, 0) });
			triangles_.push_back({ near_last, far_vertex(corner + 1, 0), near_vertex(corner + 1, 0) });
		}
	}
}

void OutlineBand::place(std::span<const Vec2> outline, Real side, std::span<Vec2> vertices) const {
	assert(outline.size() == corner_count_ && vertices.size() >= vertex_count_);
	std::size_t start = 0;
	for (std::size_t i = 0; i <= corner_count_; ++i) {
		const std::size_t at = i % corner_count_;
		const Corner corner = corner_of(outline[(at + corner_count_ - 1) % corner_count_], outline[at],
				outline[(at + 1) % corner_count_]);
		start = 0;
		for (const Rail &rail : rails_) {
			const std::uint32_t count = rail.corner_points;
			const Real distance = rail.distance * side;
			const bool spreads = count > 1 && corner.turn * distance < 0;
			for (std::uint32_t k = 0; k < count; ++k) {
				vertices[start + i * count + k] =
						spreads ? arc_point(corner, distance, k, count) : mitre_point(corner, distance);
			}
			start += (corner_count_ + 1) * count;
		}
	}
}

} // namespace softbody
