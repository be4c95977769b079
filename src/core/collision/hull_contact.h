// SPDX-License-Identifier: MIT
// Where a point has entered the hull of a body: the exact test, on the hull's edges.
#pragma once

#include "core/base/vec2.h"
#include "core/collision/edge_pack.h"

#include <algorithm>
#include <array>
#include <cmath>
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
	/// Reads the hull, which stays as it is until the last question. O(hull points).
	void assign(std::span<const Vec2> hull);
	/// Whether the hull winds around p (nonzero winding rule). Points on the border may fall on either side.
	bool contains(Vec2 p) const;

	/// The contact of the point p, or none when the hull does not contain it. It comes out through the nearest edge that
	/// faces it: one on whose inner side it is, and whose outward normal opposes `outward`, the direction out of the body
	/// that p belongs to. A point that was pushed through a thin body so finds its way back rather than on. Where no edge
	/// faces it (or `outward` is 0), the nearest of all. O(hull points).
	std::optional<HullContact> find(Vec2 p, Vec2 outward) const;

private:
	template <std::size_t PACKS>
	std::optional<std::size_t> find_among(const BasicVec2<RealPack> &p, Vec2 outward) const;
	std::optional<std::size_t> find_among_many(Vec2 p, Vec2 outward) const;
	std::optional<HullContact> contact_at(std::size_t edge, Vec2 p) const;

	// Room for 32 edges at once, so that the buffers of threads that work beside each other are lines of the cache apart
	// from the start (two threads solved the contacts of 6,000 bodies in 1.8 times less time so, 1.3 without).
	std::vector<EdgePack> edges_ = std::vector<EdgePack>(8);
	std::span<const Vec2> hull_;
};

/// Direction out of a body at hull point `i`: the sum of the normals of its two edges, weighted by their lengths.
inline Vec2 outward_at(std::span<const Vec2> hull, std::size_t i) {
	const Vec2 before = hull[i == 0 ? hull.size() - 1 : i - 1];
	const Vec2 after = hull[i + 1 == hull.size() ? 0 : i + 1];
	return -perpendicular(after - before);
}

// Up to three packs are read anew by every question: they stay in registers, and a hull changes with most contacts.
inline std::optional<HullContact> HullEdges::find(Vec2 p, Vec2 outward) const {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	std::optional<std::size_t> edge;
	switch (packs_for(hull_.size())) {
		case 1: edge = find_among<1>(point, outward); break;
		case 2: edge = find_among<2>(point, outward); break;
		case 3: edge = find_among<3>(point, outward); break;
		default: edge = find_among_many(p, outward);
	}
	return edge ? contact_at(*edge, p) : std::nullopt;
}

template <std::size_t PACKS>
std::optional<std::size_t> HullEdges::find_among(const BasicVec2<RealPack> &p, Vec2 outward) const {
	std::array<EdgePack, PACKS> edges;
	int winding = 0;
	for (std::size_t i = 0; i < PACKS; ++i) {
		edges[i] = edges_at(hull_, i * PACK_WIDTH);
		winding += winding_of(edges[i], p);
	}
	return winding != 0 ? nearest_edge(edges, p, outward) : std::nullopt;
}

inline std::optional<HullContact> HullEdges::contact_at(std::size_t edge, Vec2 p) const {
	HullContact contact;
	contact.edge = edge < hull_.size() ? std::uint32_t(edge) : 0; // or a lane that stands for the first point
	const Vec2 start = hull_[contact.edge];
	const Vec2 way = hull_[contact.edge + 1 == hull_.size() ? 0 : contact.edge + 1] - start;
	const Real size_squared = length_squared(way);
	const Real along = size_squared > 0 ? dot(p - start, way) / size_squared : Real(0);
	contact.t = std::clamp(along, Real(0), Real(1));
	const Vec2 out_of_hull = start + way * contact.t - p;
	const Real size = std::sqrt(size_squared);
	// Next to the edge itself the direction of the nearest place is rounding; the edge's normal is exact there.
	if (contact.t == 0 || contact.t == 1) {
		contact.depth = length(out_of_hull);
		if (contact.depth > Real(1e-3) * size) {
			contact.normal = out_of_hull * (1 / contact.depth);
			return contact;
		}
	}
	if (!(size > 0)) {
		return {};
	}
	contact.normal = Vec2{ way.y, -way.x } * (1 / size);
	contact.depth = std::max(cross(way, p - start) * (1 / size), Real(0)); // from the edge itself, without waiting for t
	return contact;
}

} // namespace softbody
