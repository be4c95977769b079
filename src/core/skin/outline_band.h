// SPDX-License-Identifier: MIT
// A band of triangles along a closed outline, whose corners are rounded where they spread.
#pragma once

#include "core/base/vec2.h"
#include "core/skin/triangulation.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace softbody {

/// Moves every edge of a closed outline by `distance` [length] to its left, which is into a polygon of positive
/// winding. Corners move to where their edges meet, within a limit (see `OutlineBand`). O(n).
void move_corners(std::span<const Vec2> outline, Real distance, std::span<Vec2> moved);
/// The same with a distance of its own for each corner, times `side`.
void move_corners(std::span<const Vec2> outline, std::span<const Real> distances, Real side, std::span<Vec2> moved);
/// The same for three distances, in one pass.
void move_corners(std::span<const Vec2> outline, const std::array<Real, 3> &distances, const std::array<std::span<Vec2>, 3> &moved);

/// Lines along an outline at fixed distances from it; the band fills the space between neighboring lines. The triangles
/// never change, only the places of their corners: a frame computes nothing else.
///
/// A corner has `corner_points` vertices on each line. On the side where the two edges spread apart they lie on an arc
/// around the corner, so that a dent does not spike. On the side where the edges close they meet in one point, the
/// mitre, at most as far from the corner as the shorter edge allows, so that a sharp tip does not spike.
class OutlineBand {
public:
	/// A line of the band.
	struct Rail {
		Real distance = 0; ///< from the outline [length], positive into a polygon of positive winding
		std::uint32_t corner_points = 1; ///< >= 1; 1 is the mitre on both sides
	};

	OutlineBand() = default;
	/// `corner_count` >= 3 points of the outline; at least two rails, in order of distance. `edges` has an entry for the edge
	/// from each corner to the next; where it is 0 there are no triangles. Empty: the band goes all around.
	OutlineBand(std::size_t corner_count, std::span<const Rail> rails, std::span<const std::uint8_t> edges = {});

	std::size_t vertex_count() const { return vertex_count_; }
	const std::vector<Triangle> &triangles() const { return triangles_; }

	/// Calls `visit(vertex, corner, rail)` for every vertex. The corner after the last is the first corner again, where
	/// the band closes, so that a texture can end and begin there.
	template <class Visit>
	void for_vertices(const Visit &visit) const {
		std::size_t vertex = 0;
		for (std::size_t rail = 0; rail < rails_.size(); ++rail) {
			for (std::size_t corner = 0; corner <= corner_count_; ++corner) {
				for (std::uint32_t k = 0; k < rails_[rail].corner_points; ++k) {
					visit(vertex++, corner, rail);
				}
			}
		}
	}

	/// Writes the places of the vertices for an outline of this object's number of corners. `side` is 1 for positive winding,
	/// -1 for negative. Neighboring points may coincide. O(vertices), no allocation.
	void place(std::span<const Vec2> outline, Real side, std::span<Vec2> vertices) const;

private:
	std::size_t corner_count_ = 0;
	std::size_t vertex_count_ = 0;
	std::vector<Rail> rails_;
	std::vector<Triangle> triangles_;
};

} // namespace softbody
