// SPDX-License-Identifier: MIT
// Contact of a point that has entered the hull of a body.
#include "core/collision/hull_contact.h"

namespace softbody {

namespace {

constexpr std::size_t FEW_PACKS = 3; // as in `find`

} // namespace

void HullEdges::assign(std::span<const Vec2> hull) {
	hull_ = hull;
	const std::size_t packs = packs_for(hull.size());
	if (packs <= FEW_PACKS) {
		return;
	}
	if (edges_.size() < packs) {
		edges_.resize(packs);
	}
	for (std::size_t i = 0; i < packs; ++i) {
		edges_[i] = edges_at(hull, i * PACK_WIDTH);
	}
}

bool HullEdges::contains(Vec2 p) const {
	const BasicVec2<RealPack> point = in_all_lanes<RealPack>(p);
	const std::size_t packs = packs_for(hull_.size());
	int winding = 0;
	for (std::size_t i = 0; i < packs; ++i) {
		winding += winding_of(packs > FEW_PACKS ? edges_[i] : edges_at(hull_, i * PACK_WIDTH), point);
	}
	return winding != 0;
}

std::optional<std::size_t> HullEdges::search_many(Vec2 p, Vec2 outward) const {
	EdgeSearch search(p, outward);
	for (std::size_t i = 0; i < packs_for(hull_.size()); ++i) {
		search.consider(i, edges_[i]);
	}
	return search.found();
}

} // namespace softbody
