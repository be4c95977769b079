// SPDX-License-Identifier: MIT
// The edges of a hull that are near another body, and which of them its points are nearest to.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"
#include "core/geometry/edge_pack.h"
#include "core/geometry/aabb.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

// In a header so that all of it is inlined: it runs once a step for every pair of bodies that are near each other.
namespace softbody {

/// The edge that each of PACK_WIDTH points is nearest to, one point in each lane.
struct NearestEdge {
	RealPack distance; ///< squared [length²]; the largest number if no listed edge has a finite distance
	RealPack edge; ///< from hull point `edge` to the next; 0 if there is none
};

/// Number of points that `points_in` tests.
inline constexpr std::uint32_t POINT_BITS = 32;

/// Bit mask of up to POINT_BITS points from `first` on that lie in the box. O(POINT_BITS).
inline std::uint32_t points_in(const Aabb &box, std::span<const Vec2> points, std::uint32_t first) {
	const BasicVec2<RealPack> min = in_all_lanes<RealPack>(box.min);
	const BasicVec2<RealPack> max = in_all_lanes<RealPack>(box.max);
	const std::uint32_t end = std::min(std::uint32_t(points.size()), first + POINT_BITS);
	std::uint32_t inside = 0;
	std::uint32_t i = first;
	for (; i + PACK_WIDTH <= end; i += PACK_WIDTH) {
		const BasicVec2<RealPack> p = consecutive(&points[i]);
		inside |= bits(both(both(p.x > min.x, p.x < max.x), both(p.y > min.y, p.y < max.y))) << (i - first);
	}
	for (; i < end; ++i) {
		const Vec2 p = points[i];
		inside |= std::uint32_t(p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y) << (i - first);
	}
	return inside;
}

/// Edges of one hull near the points of another. Keeps its memory from one hull to the next.
class NearEdges {
public:
	/// Lists the edges of the hull whose own boxes overlap `box`, in the order of the hull. O(hull points).
	void assign(std::span<const Vec2> hull, const Aabb &box) {
		count_ = 0;
		if (edges_.size() < hull.size()) {
			edges_.resize(hull.size());
		}
		const BasicVec2<RealPack> min = in_all_lanes<RealPack>(box.min);
		const BasicVec2<RealPack> max = in_all_lanes<RealPack>(box.max);
		for (std::size_t first = 0; first < hull.size(); first += PACK_WIDTH) {
			const auto [start, end] = edges_at(hull, first);
			const PackMask in_x = both(!(lesser(start.x, end.x) > max.x), !(greater(start.x, end.x) < min.x));
			const PackMask in_y = both(!(lesser(start.y, end.y) > max.y), !(greater(start.y, end.y) < min.y));
			const std::size_t lanes = std::min(hull.size() - first, PACK_WIDTH);
			for (std::uint32_t near = bits(both(in_x, in_y)) & ((1u << lanes) - 1); near != 0; near &= near - 1) {
				add(hull, first + std::size_t(std::countr_zero(near)));
			}
		}
	}
	/// The nearest of the listed edges for each point, of several as near the first. O(listed edges).
	NearestEdge find(const BasicVec2<RealPack> &p) const {
		NearestEdge nearest{ RealPack(std::numeric_limits<Real>::max()), RealPack(0) };
		for (const Edge &edge : std::span(edges_.data(), count_)) {
			const BasicVec2<RealPack> way = in_all_lanes<RealPack>(edge.way);
			const BasicVec2<RealPack> offset = p - in_all_lanes<RealPack>(edge.start);
			// An edge of length 0 gives 0·∞, which `lesser` maps to 1; both ends are one place.
			const RealPack share = dot(offset, way) * RealPack(edge.inverse_length_squared);
			const RealPack t = greater(RealPack(0), lesser(share, RealPack(1)));
			const RealPack distance = length_squared(offset - way * t);
			const PackMask is_nearer = distance < nearest.distance;
			nearest.distance = select(is_nearer, distance, nearest.distance);
			nearest.edge = select(is_nearer, RealPack(edge.index), nearest.edge);
		}
		return nearest;
	}

private:
	struct Edge {
		Vec2 start;
		Vec2 way; ///< from its start to its end
		Real inverse_length_squared = 0;
		Real index = 0; ///< in the hull
	};

	void add(std::span<const Vec2> hull, std::size_t i) {
		const Vec2 way = hull[i + 1 == hull.size() ? 0 : i + 1] - hull[i];
		edges_[count_++] = { hull[i], way, 1 / length_squared(way), Real(i) };
	}

	// Room for 32 edges from the start keeps the buffers of different threads on separate cache lines.
	std::vector<Edge> edges_ = std::vector<Edge>(32);
	std::size_t count_ = 0;
};

} // namespace softbody
