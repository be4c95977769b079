// SPDX-License-Identifier: MIT
// Edges of a hull side by side: which way they wind around a point, and which of them is the nearest to it.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

// In a header, as all of it is asked at every point of every pair of bodies that are near each other.
namespace softbody {

/// PACK_WIDTH edges. Both ends as they are, not a start and a way: two edges must agree to the bit about the point they
/// share.
struct EdgePack {
	BasicVec2<RealPack> start;
	BasicVec2<RealPack> end;
};

/// Edges of a hull from the one at `first` on. Lanes beyond the last are edges without length at the hull's first point,
/// never crossed nor alone the nearest.
inline EdgePack edges_at(std::span<const Vec2> hull, std::size_t first) {
	const Vec2 *begin = &hull[first];
	const std::size_t left = hull.size() - first;
	if (left > PACK_WIDTH) {
		return { consecutive(begin), consecutive(begin + 1) };
	}
	const Vec2 *home = hull.data();
	if (left == PACK_WIDTH) {
		return { consecutive(begin), gather<const Vec2>({ begin + 1, begin + 2, begin + 3, home }, 0) };
	}
	const auto point = [&](std::size_t i) { return i < left ? begin + i : home; };
	return { gather<const Vec2>({ begin, point(1), point(2), home }, 0),
		gather<const Vec2>({ point(1), point(2), home, home }, 0) };
}

/// How often the edges wind around p. The ray from p towards +x: an edge that passes it upwards with p on its inner side
/// counts +1, one that passes it downwards with p on the other side -1.
inline int winding_of(const EdgePack &edges, const BasicVec2<RealPack> &p) {
	const RealPack side = cross(edges.end - edges.start, p - edges.start);
	const PackMask starts_above = p.y < edges.start.y;
	const PackMask ends_above = p.y < edges.end.y;
	const PackMask rises = both(both(!starts_above, ends_above), side > RealPack(0));
	const PackMask falls = both(both(starts_above, !ends_above), side < RealPack(0));
	// Bits set in a number of PACK_WIDTH bits. Processors count them in one instruction that not all of them have.
	static_assert(PACK_WIDTH == 4);
	constexpr std::array<std::int8_t, 16> BIT_COUNT = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
	return BIT_COUNT[bits(rises)] - BIT_COUNT[bits(falls)];
}

/// Of p from each edge, squared, by `way` from its start to its end and `offset` from its start to p.
inline RealPack squared_distance(const BasicVec2<RealPack> &way, const BasicVec2<RealPack> &offset) {
	// Without length: 0/0, of which `lesser` makes 1; both ends are one place.
	const RealPack t = greater(RealPack(0), lesser(dot(offset, way) / length_squared(way), RealPack(1)));
	return length_squared(offset - way * t);
}

/// Of the edges that count, the nearest in each lane.
struct NearestEdges {
	static constexpr Real FAR = std::numeric_limits<Real>::max();
	RealPack distance{ FAR }; ///< squared
	RealPack number{ 0 }; ///< of the pack

	void consider(std::size_t i, RealPack other, PackMask counts) {
		const PackMask is_nearer = both(other < distance, counts);
		distance = select(is_nearer, other, distance);
		number = select(is_nearer, RealPack(Real(i)), number);
	}
};

/// The nearest edge on whose inner side p is and whose outward normal opposes `outward`; where none is such, the nearest
/// of all. None where nothing is a number.
inline std::optional<std::size_t> nearest_edge(std::span<const EdgePack> edges, const BasicVec2<RealPack> &p, Vec2 outward) {
	const BasicVec2<RealPack> out = in_all_lanes<RealPack>(outward);
	NearestEdges nearest;
	for (std::size_t i = 0; i < edges.size(); ++i) {
		const BasicVec2<RealPack> way = edges[i].end - edges[i].start;
		const BasicVec2<RealPack> offset = p - edges[i].start;
		// The outward normal of an edge is its way turned by -90 degrees; its product with `out` is cross(out, way).
		// Where p lies beyond an edge, the way to it leads through others first.
		nearest.consider(i, squared_distance(way, offset), both(cross(out, way) < RealPack(0), !(cross(way, offset) < RealPack(0))));
	}
	Real least = least_lane(nearest.distance);
	if (!(least < NearestEdges::FAR)) {
		for (std::size_t i = 0; i < edges.size(); ++i) {
			const RealPack distance = squared_distance(edges[i].end - edges[i].start, p - edges[i].start);
			nearest.consider(i, distance, distance < RealPack(NearestEdges::FAR));
		}
		least = least_lane(nearest.distance);
		if (!(least < NearestEdges::FAR)) {
			return {};
		}
	}
	const std::size_t lane = std::size_t(std::countr_zero(bits(!(nearest.distance > RealPack(least)))));
	return std::size_t(nearest.number[lane]) * PACK_WIDTH + lane;
}

} // namespace softbody
