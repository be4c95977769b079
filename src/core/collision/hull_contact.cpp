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

} // namespace

void HullEdges::read(std::span<const Vec2> hull, std::uint32_t pack) {
	Edges &edges = edges_[pack];
	const std::uint32_t first = pack * std::uint32_t(PACK_WIDTH);
	if (first + PACK_WIDTH < hull.size()) {
		edges.start = consecutive(&hull[first]);
		edges.end = consecutive(&hull[first + 1]);
		return;
	}
	// Lanes beyond the last edge: edges without length at the hull's first point, never crossed nor alone the nearest.
	const auto point = [&](std::uint32_t i) { return first + i < hull.size() ? &hull[first + i] : hull.data(); };
	edges.start = gather<const Vec2>({ point(0), point(1), point(2), point(3) }, 0);
	edges.end = gather<const Vec2>({ point(1), point(2), point(3), point(4) }, 0);
}

void HullEdges::assign(std::span<const Vec2> hull) {
	count_ = std::uint32_t(hull.size());
	const std::uint32_t packs = std::uint32_t(packs_for(count_));
	if (edges_.size() < packs) {
		edges_.resize(packs);
	}
	for (std::uint32_t i = 0; i < packs; ++i) {
		read(hull, i);
	}
}

void HullEdges::update(std::span<const Vec2> hull, std::uint32_t index) {
	const std::uint32_t pack = index / PACK_WIDTH;
	const std::uint32_t pack_before = (index == 0 ? count_ - 1 : index - 1) / PACK_WIDTH;
	read(hull, pack);
	if (pack_before != pack) {
		read(hull, pack_before);
	}
}

bool HullEdges::contains(Vec2 p) const {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const std::uint32_t packs = std::uint32_t(packs_for(count_));
	int winding = 0;
	for (std::uint32_t i = 0; i < packs; ++i) {
		const Edges &edges = edges_[i];
		// The ray from p towards +x: an edge that passes it upwards with p on its inner side counts +1, one that
		// passes it downwards with p on the other side -1.
		const RealPack side = cross(edges.end - edges.start, point - edges.start);
		const PackMask starts_above = point.y < edges.start.y;
		const PackMask ends_above = point.y < edges.end.y;
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
	const std::uint32_t packs = std::uint32_t(packs_for(count_));
	struct Nearest {
		RealPack distance{ FAR }; // squared
		RealPack pack{ 0 };
		void consider(RealPack other_distance, PackMask counts, std::uint32_t other_pack) {
			const PackMask nearer = both(other_distance < distance, counts);
			distance = select(nearer, other_distance, distance);
			pack = select(nearer, RealPack(Real(other_pack)), pack);
		}
	};
	Nearest of_all;
	Nearest of_facing;
	for (std::uint32_t i = 0; i < packs; ++i) {
		const Edges &edges = edges_[i];
		const BasicVec2<RealPack> way = edges.end - edges.start;
		const BasicVec2<RealPack> offset = point - edges.start;
		// Without length: 0/0, of which `lesser` makes 1; both ends are one place.
		const RealPack t = greater(RealPack(0), lesser(dot(offset, way) / length_squared(way), RealPack(1)));
		const RealPack distance = length_squared(offset - way * t);
		of_all.consider(distance, distance < RealPack(FAR), i);
		// The outward normal of an edge is its way turned by -90 degrees; its product with `out` is cross(out, way).
		// Where p lies beyond an edge, the way to it leads through others first.
		const PackMask faces = both(cross(out, way) < RealPack(0), !(cross(way, offset) < RealPack(0)));
		of_facing.consider(distance, faces, i);
	}
	Real least = least_lane(of_facing.distance);
	const Nearest &nearest = least < FAR ? of_facing : of_all;
	least = least < FAR ? least : least_lane(of_all.distance);
	if (!(least < FAR)) {
		return {};
	}
	const std::size_t lane = std::size_t(std::countr_zero(bits(!(nearest.distance > RealPack(least)))));
	const std::size_t pack = std::size_t(nearest.pack[lane]);
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
