// SPDX-License-Identifier: MIT
// Edges of a hull in SIMD lanes: their winding around a point, and the edge nearest to it.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

// In a header so that all of it is inlined: it runs for every point of every pair of bodies that are near each other.
namespace softbody {

/// PACK_WIDTH edges. Both ends are stored, not start and direction: adjacent edges must agree to the bit about the
/// point that they share.
struct EdgePack {
	BasicVec2<RealPack> start;
	BasicVec2<RealPack> end;
};

/// Edges of a hull from the edge `first` on. Lanes beyond the last edge hold edges of length 0 at the hull's first
/// point. Those are never crossed, and never nearer than an edge that ends there.
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

/// Winding of the edges around p, by a ray from p towards +x. An edge that rises past p with p on its inner side counts
/// +1. An edge that falls past p with p on its outer side counts -1.
inline int winding_of(const EdgePack &edges, const BasicVec2<RealPack> &p) {
	const RealPack side = cross(edges.end - edges.start, p - edges.start);
	const PackMask starts_above = p.y < edges.start.y;
	const PackMask ends_above = p.y < edges.end.y;
	const PackMask rises = both(both(!starts_above, ends_above), side > RealPack(0));
	const PackMask falls = both(both(starts_above, !ends_above), side < RealPack(0));
	// Number of bits set. Not all processors have an instruction for that.
	static_assert(PACK_WIDTH == 4);
	constexpr std::array<std::int8_t, 16> BIT_COUNT = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
	return BIT_COUNT[bits(rises)] - BIT_COUNT[bits(falls)];
}

/// Squared distance of p from each edge. `way` is the edge from start to end, `offset` is p relative to the start.
inline RealPack squared_distance(const BasicVec2<RealPack> &way, const BasicVec2<RealPack> &offset) {
	// An edge of length 0 gives 0/0, which `lesser` maps to 1; both ends are one place.
	const RealPack t = greater(RealPack(0), lesser(dot(offset, way) / length_squared(way), RealPack(1)));
	return length_squared(offset - way * t);
}

/// The nearest of the considered edges, for each lane.
struct NearestEdges {
	static constexpr Real FAR = std::numeric_limits<Real>::max();
	RealPack distance{ FAR }; ///< squared
	RealPack number{ 0 }; ///< index of the pack

	void consider(std::size_t i, RealPack other, PackMask counts) {
		const PackMask is_nearer = both(other < distance, counts);
		distance = select(is_nearer, other, distance);
		number = select(is_nearer, RealPack(Real(i)), number);
	}
	/// The edge of some lane that is nearest. None if no distance was less than FAR, as of a point that is not finite.
	std::optional<std::size_t> any() const {
		const Real least = least_lane(distance);
		return least < FAR ? std::optional(edge_in(least_lane_at(least))) : std::nullopt;
	}
	/// The same; of several edges that are as near, the first.
	std::optional<std::size_t> first() const {
		const Real least = least_lane(distance);
		if (!(least < FAR)) {
			return {};
		}
		std::size_t edge = std::numeric_limits<std::size_t>::max();
		for (std::uint32_t lanes = bits(!(distance > RealPack(least))); lanes != 0; lanes &= lanes - 1) {
			edge = std::min(edge, edge_in(std::size_t(std::countr_zero(lanes))));
		}
		return edge;
	}

private:
	std::size_t least_lane_at(Real least) const { return std::size_t(std::countr_zero(bits(!(distance > RealPack(least))))); }
	std::size_t edge_in(std::size_t lane) const { return std::size_t(number[lane]) * PACK_WIDTH + lane; }
};

/// Searches the edges of a hull from the point p, in one pass: whether the hull contains p, the edge nearest to p, and the
/// nearest one that faces p: p is on its inner side, and its outward normal opposes `outward`.
class EdgeSearch {
public:
	EdgeSearch(Vec2 p, Vec2 outward) : p_(in_all_lanes<RealPack>(p)), out_(in_all_lanes<RealPack>(outward)) {}

	void consider(std::size_t i, const EdgePack &edges) {
		const BasicVec2<RealPack> way = edges.end - edges.start;
		const BasicVec2<RealPack> offset = p_ - edges.start;
		const RealPack distance = squared_distance(way, offset);
		winding_ += winding_of(edges, p_);
		// The outward normal of an edge is its direction turned by -90 degrees; its product with `out_` is cross(out_,
		// way). If p lies on the outer side of an edge, the way to it crosses other edges first.
		facing_.consider(i, distance, both(cross(out_, way) < RealPack(0), !(cross(way, offset) < RealPack(0))));
		nearest_.consider(i, distance, distance < RealPack(NearestEdges::FAR));
	}
	/// Inside a hull, the nearest edge that faces p, or the nearest of all if none does. None outside, or if all
	/// distances are NaN or infinite.
	std::optional<std::size_t> found() const {
		if (winding_ == 0) {
			return {};
		}
		const std::optional<std::size_t> facing = facing_.any();
		return facing ? facing : nearest_.any();
	}

private:
	BasicVec2<RealPack> p_;
	BasicVec2<RealPack> out_;
	int winding_ = 0;
	NearestEdges nearest_;
	NearestEdges facing_;
};

} // namespace softbody
