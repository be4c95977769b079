// SPDX-License-Identifier: MIT
// Where a point has entered the hull of a body.
#include "core/collision/hull_contact.h"

#include <algorithm>
#include <array>
#include <limits>

namespace softbody {

namespace {

// Bits set in a number of PACK_WIDTH bits. Processors count them in one instruction that not all of them have.
constexpr std::array<std::int8_t, 16> BIT_COUNT = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
static_assert(PACK_WIDTH == 4);

} // namespace

void HullEdges::set(std::span<const Vec2> hull, std::uint32_t edge) {
	const Vec2 start = hull[edge];
	const Vec2 end = hull[edge + 1 == hull.size() ? 0 : edge + 1];
	const Vec2 way = end - start;
	Edges &pack = edges_[edge / PACK_WIDTH];
	const std::size_t lane = edge % PACK_WIDTH;
	set_lane(pack.start, lane, start);
	set_lane(pack.way, lane, way);
	pack.end_y.set(lane, end.y);
	const Real size = length_squared(way);
	pack.inverse_length_squared.set(lane, size > 0 ? 1 / size : Real(0));
}

void HullEdges::assign(std::span<const Vec2> hull) {
	count_ = std::uint32_t(hull.size());
	const std::size_t packs = (hull.size() + PACK_WIDTH - 1) / PACK_WIDTH;
	if (edges_.size() < packs) {
		edges_.resize(packs);
	}
	// As long as the ends of all edges of a pack follow one another.
	std::uint32_t i = 0;
	for (; i + PACK_WIDTH < count_; i += PACK_WIDTH) {
		Edges &pack = edges_[i / PACK_WIDTH];
		pack.start = consecutive(&hull[i]);
		const BasicVec2<RealPack> end = consecutive(&hull[i + 1]);
		pack.way = end - pack.start;
		pack.end_y = end.y;
		const RealPack size = length_squared(pack.way);
		pack.inverse_length_squared = select(size > RealPack(0), RealPack(1) / size, RealPack(0));
	}
	// Lanes beyond the last edge: edges without length at the hull's first point, never crossed nor nearest.
	Edges &last = edges_[packs - 1];
	last.start = in_all_lanes<RealPack>(hull[0]);
	last.way = {};
	last.end_y = last.start.y;
	last.inverse_length_squared = RealPack(0);
	for (; i < count_; ++i) {
		set(hull, i);
	}
}

void HullEdges::update(std::span<const Vec2> hull, std::uint32_t index) {
	set(hull, index);
	set(hull, index == 0 ? count_ - 1 : index - 1);
}

bool HullEdges::contains(Vec2 p) const {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const std::size_t packs = (count_ + PACK_WIDTH - 1) / PACK_WIDTH;
	int winding = 0;
	for (std::size_t i = 0; i < packs; ++i) {
		const Edges &edges = edges_[i];
		const BasicVec2<RealPack> offset = point - edges.start;
		// The ray from p towards +x: an edge that passes it upwards with p on its inner side counts +1, one that
		// passes it downwards with p on the other side -1.
		const RealPack side = cross(edges.way, offset);
		const PackMask starts_above = point.y < edges.start.y;
		const PackMask ends_above = point.y < edges.end_y;
		const PackMask rises = both(both(!starts_above, ends_above), side > RealPack(0));
		const PackMask falls = both(both(starts_above, !ends_above), side < RealPack(0));
		winding += BIT_COUNT[bits(rises)] - BIT_COUNT[bits(falls)];
	}
	return winding != 0;
}

std::optional<HullContact> HullEdges::find(Vec2 p, Vec2 outward) const {
	if (!contains(p)) {
		return {};
	}
	constexpr Real FAR = std::numeric_limits<Real>::max();
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const BasicVec2<RealPack> out = in_all_lanes<RealPack>(outward);
	const std::size_t packs = (count_ + PACK_WIDTH - 1) / PACK_WIDTH;
	RealPack nearest(FAR);
	RealPack nearest_t(0);
	RealPack nearest_pack(0);
	RealPack nearest_facing(FAR);
	RealPack facing_t(0);
	RealPack facing_pack(0);
	for (std::size_t i = 0; i < packs; ++i) {
		const Edges &edges = edges_[i];
		const BasicVec2<RealPack> offset = point - edges.start;
		const RealPack along = dot(offset, edges.way) * edges.inverse_length_squared;
		const RealPack t = greater(RealPack(0), lesser(along, RealPack(1)));
		const RealPack distance = length_squared(offset - edges.way * t);
		const RealPack number{ Real(i) };
		const PackMask nearer = distance < nearest;
		nearest = select(nearer, distance, nearest);
		nearest_t = select(nearer, t, nearest_t);
		nearest_pack = select(nearer, number, nearest_pack);
		// The outward normal of an edge is its way turned by -90 degrees; its product with `out` is cross(out, way).
		// Where p lies beyond an edge, the way to it leads through others first.
		const PackMask faces = both(cross(out, edges.way) < RealPack(0), !(cross(edges.way, offset) < RealPack(0)));
		const PackMask nearer_facing = both(distance < nearest_facing, faces);
		nearest_facing = select(nearer_facing, distance, nearest_facing);
		facing_t = select(nearer_facing, t, facing_t);
		facing_pack = select(nearer_facing, number, facing_pack);
	}

	Real least = FAR;
	Real least_facing = FAR;
	std::size_t lane = 0;
	std::size_t facing_lane = 0;
	for (std::size_t i = 0; i < PACK_WIDTH; ++i) {
		if (nearest[i] < least) {
			least = nearest[i];
			lane = i;
		}
		if (nearest_facing[i] < least_facing) {
			least_facing = nearest_facing[i];
			facing_lane = i;
		}
	}
	if (!(least < FAR)) {
		return {};
	}
	const bool is_facing = least_facing < FAR;
	lane = is_facing ? facing_lane : lane;
	const std::size_t pack = std::size_t(is_facing ? facing_pack[lane] : nearest_pack[lane]);
	HullContact contact;
	contact.edge = std::uint32_t(pack * PACK_WIDTH + lane);
	if (contact.edge >= count_) {
		contact.edge = 0; // a lane that stands for the first point
	}
	contact.t = is_facing ? facing_t[lane] : nearest_t[lane];
	const Vec2 start = lane_of(edges_[pack].start, lane);
	const Vec2 way = lane_of(edges_[pack].way, lane);
	const Vec2 out_of_hull = start + way * contact.t - p;
	const Real size = length(way);
	contact.depth = length(out_of_hull);
	// Next to the edge itself the direction of the nearest place is rounding; the edge's normal is exact there.
	const bool beside_a_corner = contact.t == 0 || contact.t == 1;
	if (beside_a_corner && contact.depth > Real(1e-3) * size) {
		contact.normal = out_of_hull * (1 / contact.depth);
	} else if (size > 0) {
		contact.normal = Vec2{ way.y, -way.x } * (1 / size);
		contact.depth = std::max(dot(out_of_hull, contact.normal), Real(0));
	} else {
		return {};
	}
	return contact;
}

Vec2 outward_at(std::span<const Vec2> hull, std::size_t i) {
	const Vec2 before = hull[i == 0 ? hull.size() - 1 : i - 1];
	const Vec2 after = hull[i + 1 == hull.size() ? 0 : i + 1];
	return -perpendicular(after - before);
}

} // namespace softbody
