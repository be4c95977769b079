// SPDX-License-Identifier: MIT
// Where a point has entered the hull of a body.
#include "core/collision/hull_contact.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

// Bits set in a number of PACK_WIDTH bits. Processors count them in one instruction that not all of them have.
constexpr std::array<std::int8_t, 16> BIT_COUNT = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
static_assert(PACK_WIDTH == 4);

constexpr std::size_t FEW_PACKS = 3;

} // namespace

void HullEdges::assign(std::span<const Vec2> hull) {
	count_ = std::uint32_t(hull.size());
	const std::size_t packs = packs_for(hull.size());
	if (edges_.size() < packs) {
		edges_.resize(packs);
	}
	const std::size_t last = packs - 1;
	for (std::size_t i = 0; i < last; ++i) {
		edges_[i].start = consecutive(&hull[i * PACK_WIDTH]);
		edges_[i].end = consecutive(&hull[i * PACK_WIDTH + 1]);
	}
	const Vec2 *tail = &hull[last * PACK_WIDTH];
	const Vec2 *home = hull.data();
	if (last * PACK_WIDTH + PACK_WIDTH == hull.size()) {
		edges_[last].start = consecutive(tail);
		edges_[last].end = gather<const Vec2>({ tail + 1, tail + 2, tail + 3, home }, 0);
		return;
	}
	// Lanes beyond the last edge: edges without length at the hull's first point, never crossed nor alone the nearest.
	const auto point = [&](std::size_t i) { return tail + i < home + hull.size() ? tail + i : home; };
	edges_[last].start = gather<const Vec2>({ tail, point(1), point(2), home }, 0);
	edges_[last].end = gather<const Vec2>({ point(1), point(2), home, home }, 0);
}

// The ray from p towards +x: an edge that passes it upwards with p on its inner side counts +1, one that passes it
// downwards with p on the other side -1.
int HullEdges::winding_of(const Edges &edges, const BasicVec2<RealPack> &p) {
	const RealPack side = cross(edges.end - edges.start, p - edges.start);
	const PackMask starts_above = p.y < edges.start.y;
	const PackMask ends_above = p.y < edges.end.y;
	const PackMask rises = both(both(!starts_above, ends_above), side > RealPack(0));
	const PackMask falls = both(both(starts_above, !ends_above), side < RealPack(0));
	return BIT_COUNT[bits(rises)] - BIT_COUNT[bits(falls)];
}

bool HullEdges::contains(Vec2 p) const {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const std::size_t packs = packs_for(count_);
	int winding = 0;
	for (std::size_t i = 0; i < packs; ++i) {
		winding += winding_of(edges_[i], point);
	}
	return winding != 0;
}

std::optional<HullContact> HullEdges::find(Vec2 p, Vec2 outward) const {
	const std::size_t packs = packs_for(count_);
	// Of a few edges both questions are asked at once: most points that come here are inside.
	const bool asks_both = packs <= FEW_PACKS;
	if (!asks_both && !contains(p)) {
		return {};
	}
	constexpr Real FAR = std::numeric_limits<Real>::max();
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const BasicVec2<RealPack> out = in_all_lanes<RealPack>(outward);
	// Of the edges that count, the nearest in each lane.
	RealPack nearest(FAR); // squared distance
	RealPack nearest_number(0);
	const auto consider = [&](std::size_t i, RealPack distance, PackMask counts) {
		const PackMask is_nearer = both(distance < nearest, counts);
		nearest = select(is_nearer, distance, nearest);
		nearest_number = select(is_nearer, RealPack(Real(i)), nearest_number);
	};
	const auto distance_of = [](const BasicVec2<RealPack> &way, const BasicVec2<RealPack> &offset) {
		// Without length: 0/0, of which `lesser` makes 1; both ends are one place.
		const RealPack t = greater(RealPack(0), lesser(dot(offset, way) / length_squared(way), RealPack(1)));
		return length_squared(offset - way * t);
	};
	int winding = 0;
	for (std::size_t i = 0; i < packs; ++i) {
		const Edges &edges = edges_[i];
		if (asks_both) {
			winding += winding_of(edges, point);
		}
		const BasicVec2<RealPack> way = edges.end - edges.start;
		const BasicVec2<RealPack> offset = point - edges.start;
		// The outward normal of an edge is its way turned by -90 degrees; its product with `out` is cross(out, way).
		// Where p lies beyond an edge, the way to it leads through others first.
		consider(i, distance_of(way, offset), both(cross(out, way) < RealPack(0), !(cross(way, offset) < RealPack(0))));
	}
	if (asks_both && winding == 0) {
		return {};
	}
	Real least = least_lane(nearest);
	if (!(least < FAR)) {
		for (std::size_t i = 0; i < packs; ++i) {
			const RealPack distance = distance_of(edges_[i].end - edges_[i].start, point - edges_[i].start);
			consider(i, distance, distance < RealPack(FAR));
		}
		least = least_lane(nearest);
		if (!(least < FAR)) {
			return {};
		}
	}
	const std::size_t lane = std::size_t(std::countr_zero(bits(!(nearest > RealPack(least)))));
	return contact_at(std::size_t(nearest_number[lane]), lane, p);
}

std::optional<HullContact> HullEdges::contact_at(std::size_t pack, std::size_t lane, Vec2 p) const {
	HullContact contact;
	contact.edge = std::uint32_t(pack * PACK_WIDTH + lane);
	if (contact.edge >= count_) {
		contact.edge = 0; // a lane that stands for the first point
	}
	const Vec2 start = lane_of(edges_[pack].start, lane);
	const Vec2 way = lane_of(edges_[pack].end, lane) - start;
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
	contact.depth = std::max(dot(out_of_hull, contact.normal), Real(0));
	return contact;
}

Vec2 outward_at(std::span<const Vec2> hull, std::size_t i) {
	const Vec2 before = hull[i == 0 ? hull.size() - 1 : i - 1];
	const Vec2 after = hull[i + 1 == hull.size() ? 0 : i + 1];
	return -perpendicular(after - before);
}

} // namespace softbody
