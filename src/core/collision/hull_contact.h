// SPDX-License-Identifier: MIT
// Where a point has entered the hull of a body: the exact test, on the hull's edges.
#pragma once

#include "core/base/pack.h"
#include "core/base/vec2.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// A point inside a hull, and how it comes out.
struct HullContact {
	std::uint32_t edge = 0; ///< from hull point `edge` to the next
	Real t = 0; ///< place on the edge, 0..1
	Vec2 normal; ///< unit, outward: the way the point has to go
	Real depth = 0; ///< [length], >= 0
};

/// The edges of one hull, laid out so that PACK_WIDTH of them are tested at once. Any simple polygon of positive
/// winding; concave is fine.
class HullEdges {
public:
	/// Reads the hull. O(hull points).
	void assign(std::span<const Vec2> hull);
	/// Whether the hull winds around p (nonzero winding rule). Points on the border may fall on either side.
	bool contains(Vec2 p) const;

	/// The contact of the point p, or none when the hull does not contain it. It comes out through the nearest edge that
	/// faces it: one on whose inner side it is, and whose outward normal opposes `outward`, the direction out of the body
	/// that p belongs to. A point that was pushed through a thin body so finds its way back rather than on. Where no edge
	/// faces it (or `outward` is 0), the nearest of all. O(hull points).
	std::optional<HullContact> find(Vec2 p, Vec2 outward) const;

private:
	// Both ends as they are, not a start and a way: two edges must agree to the bit about the point they share.
	struct Edges {
		BasicVec2<RealPack> start;
		BasicVec2<RealPack> end;
	};
	static int winding_of(const Edges &edges, const BasicVec2<RealPack> &p);
	std::optional<HullContact> contact_at(std::size_t pack, std::size_t lane, Vec2 p) const;

	// Room for 32 edges at once, so that the buffers of threads that work beside each other are lines of the cache apart
	// from the start (two threads answered the contacts of 6,000 bodies in 1.8 times less time so, 1.3 without).
	std::vector<Edges> edges_ = std::vector<Edges>(8);
	std::uint32_t count_ = 0;
};

/// Direction out of a body at hull point `i`: the sum of the normals of its two edges, weighted by their lengths.
Vec2 outward_at(std::span<const Vec2> hull, std::size_t i);

} // namespace softbody
