// SPDX-License-Identifier: MIT
// Contact of a point that has entered the hull of a body: the exact test, on the hull's edges.
#pragma once

#include "core/base/vec2.h"
#include "core/geometry/edge_pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace softbody {

/// Contact of a point inside a hull, with its way out.
struct HullContact {
	std::uint32_t edge = 0; ///< from hull point `edge` to the next
	Real t = 0; ///< place on the edge, 0..1
	Vec2 normal; ///< unit, outward: the direction in which the point must move
	Real depth = 0; ///< [length], >= 0
};

/// The edges of one hull, laid out to test PACK_WIDTH of them at once. For any simple polygon of positive winding,
/// convex or concave.
class HullEdges {
public:
	/// Reads the hull, which must not change before the last query. O(hull points).
	void assign(std::span<const Vec2> hull);
	/// Whether the hull winds around p (nonzero winding rule). For a point on the border the result may be either.
	/// O(hull points).
	bool contains(Vec2 p) const;

	/// The contact of the point p, or none if the hull does not contain it. The point leaves through the nearest edge
	/// that faces it: p is on the inner side of such an edge, and the edge's outward normal opposes `outward`, the
	/// direction out of the body that p belongs to. So a point that was pushed through a thin body finds its way back.
	/// If no edge faces the point, or if `outward` is 0, it leaves through the nearest edge. O(hull points).
	std::optional<HullContact> find(Vec2 p, Vec2 outward) const;

private:
	template <std::size_t PACKS>
	std::optional<std::size_t> search(Vec2 p, Vec2 outward) const;
	std::optional<std::size_t> search_many(Vec2 p, Vec2 outward) const;
	std::optional<HullContact> contact_at(std::size_t edge, Vec2 p) const;

	// Room for 32 edges from the start keeps the buffers of different threads on separate cache lines.
	std::vector<EdgePack> edges_ = std::vector<EdgePack>(8);
	std::span<const Vec2> hull_;
};

/// What is known of a point beside an edge that it was near before.
enum class Followed : std::uint8_t {
	APART, ///< outside the hull
	INSIDE, ///< a contact
	LOST, ///< only a search among all edges can tell
};

/// The contact of the point p with a hull, where `contact.edge` was the edge nearest to p when p was a little way from
/// here. Walks along the hull to the edge beside p, and leaves it in `contact.edge`. O(1).
Followed follow_contact(std::span<const Vec2> hull, Vec2 p, HullContact &contact);

/// Direction out of a body at hull point `i`: the sum of the normals of its two edges. Where the corner sticks out they
/// are unit normals: then it faces every line that both of its edges lie on one side of, however short one of them is.
/// Elsewhere, and at an edge without length, the normals are weighted by lengths: a dent is outlined by its long edges,
/// and the short ones of a crushed body turn every way.
inline Vec2 outward_at(std::span<const Vec2> hull, std::size_t i) {
	const Vec2 before = hull[i] - hull[i == 0 ? hull.size() - 1 : i - 1];
	const Vec2 after = hull[i + 1 == hull.size() ? 0 : i + 1] - hull[i];
	const Real before_length = length(before);
	const Real after_length = length(after);
	const bool sticks_out = cross(before, after) > 0 && before_length > 0 && after_length > 0;
	return -perpendicular(sticks_out ? before * (1 / before_length) + after * (1 / after_length) : before + after);
}

// Up to three packs are read again for each query. They stay in registers, and most contacts change the hull.
inline std::optional<HullContact> HullEdges::find(Vec2 p, Vec2 outward) const {
	std::optional<std::size_t> found;
	switch (packs_for(hull_.size())) {
		case 1: found = search<1>(p, outward); break;
		case 2: found = search<2>(p, outward); break;
		case 3: found = search<3>(p, outward); break;
		default: found = search_many(p, outward);
	}
	return found ? contact_at(*found, p) : std::nullopt;
}

template <std::size_t PACKS>
std::optional<std::size_t> HullEdges::search(Vec2 p, Vec2 outward) const {
	EdgeSearch search(p, outward);
	for (std::size_t i = 0; i < PACKS; ++i) {
		search.consider(i, edges_at(hull_, i * PACK_WIDTH));
	}
	return search.found();
}

inline Followed follow_contact(std::span<const Vec2> hull, Vec2 p, HullContact &contact) {
	constexpr int MOST_STEPS = 4;
	Vec2 last_way;
	int direction = 0;
	for (int step = 0; step < MOST_STEPS; ++step) {
		const std::uint32_t next = contact.edge + 1 == hull.size() ? 0 : contact.edge + 1;
		const Vec2 start = hull[contact.edge];
		const Vec2 way = hull[next] - start;
		const Vec2 offset = p - start;
		const Real along = dot(offset, way);
		const Real size_squared = length_squared(way);
		if (along >= 0 && along <= size_squared) {
			const Real side = cross(way, offset);
			if (!(side > 0)) {
				return size_squared > 0 ? Followed::APART : Followed::LOST;
			}
			const Real size = std::sqrt(size_squared);
			contact.depth = side / size;
			contact.t = along / size_squared;
			contact.normal = Vec2{ way.y, -way.x } * (1 / size);
			// Deeper than the way to a corner, the edge beyond it may be nearer.
			return side > std::min(along, size_squared - along) ? Followed::LOST : Followed::INSIDE;
		}
		const int beyond = along < 0 ? -1 : 1;
		if (direction == -beyond) { // beyond both edges of a corner: outside one that sticks out
			return cross(last_way, way) * Real(direction) > 0 ? Followed::APART : Followed::LOST;
		}
		direction = beyond;
		last_way = way;
		contact.edge = beyond > 0 ? next : std::uint32_t(contact.edge == 0 ? hull.size() : contact.edge) - 1;
	}
	return Followed::LOST;
}

inline std::optional<HullContact> HullEdges::contact_at(std::size_t edge, Vec2 p) const {
	HullContact contact;
	contact.edge = edge < hull_.size() ? std::uint32_t(edge) : 0; // the lane may be a copy of the first point
	const Vec2 start = hull_[contact.edge];
	const Vec2 way = hull_[contact.edge + 1 == hull_.size() ? 0 : contact.edge + 1] - start;
	const Real size_squared = length_squared(way);
	const Real along = size_squared > 0 ? dot(p - start, way) / size_squared : Real(0);
	contact.t = std::clamp(along, Real(0), Real(1));
	const Vec2 out_of_hull = start + way * contact.t - p;
	const Real size = std::sqrt(size_squared);
	// At a corner of the hull the point leaves along the line to the nearest place. On the edge that direction is
	// rounding, and the edge's normal is exact.
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
	contact.depth = std::max(cross(way, p - start) * (1 / size), Real(0)); // uses the edge, so it need not wait for t
	return contact;
}

} // namespace softbody
