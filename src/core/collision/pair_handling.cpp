// SPDX-License-Identifier: MIT
// Contacts of soft bodies with one another.
#include "core/collision/pair_handling.h"

#include "core/base/constants.h"

#include <algorithm>
#include <bit>

namespace softbody {

void PairHandling::begin_substep(Vec2 gravity, Real h) {
	bounce_threshold_ = RESTITUTION_SUBSTEPS * length(gravity) * h;
	h_ = h;
}

std::size_t PairHandling::handle(TouchingBody &a, TouchingBody &b) {
	const Real reach = a.radius + b.radius;
	if (!a.box.overlaps(b.box) || length_squared(a.centre - b.centre) > reach * reach) {
		return 0;
	}
	return handle_points(a, b) + handle_points(b, a);
}

std::size_t PairHandling::handle_points(TouchingBody &body, TouchingBody &other) {
	// Few points are near the other body: the others are left out several at a time.
	std::size_t contacts = 0;
	has_edges_ = false;
	const std::uint32_t count = std::uint32_t(body.hull.size());
	const Real radius_squared = other.radius * other.radius;
	const BasicVec2<RealPack> centre = in_all_lanes<RealPack>(other.centre);
	std::uint32_t first = 0;
	for (; first + PACK_WIDTH <= count; first += PACK_WIDTH) {
		const RealPack distance = length_squared(consecutive(&body.hull[first]) - centre);
		for (std::uint32_t near = bits(distance < RealPack(radius_squared)); near != 0; near &= near - 1) {
			contacts += handle_point(body, other, first + std::uint32_t(std::countr_zero(near)));
		}
	}
	for (; first < count; ++first) {
		if (length_squared(body.hull[first] - other.centre) < radius_squared) {
			contacts += handle_point(body, other, first);
		}
	}
	return contacts;
}

bool PairHandling::handle_point(TouchingBody &body, TouchingBody &other, std::uint32_t point) {
	if (!has_edges_) {
		edges_.assign(other.hull);
		has_edges_ = true;
	}
	const std::optional<HullContact> found = edges_.find(body.hull[point], outward_at(body.hull, point));
	if (!found) {
		return false;
	}
	const std::uint32_t end = found->edge + 1 == other.hull.size() ? 0 : found->edge + 1;
	answer_pair_contact(body, other, { point, found->edge, end, found->t, found->normal, found->depth },
			bounce_threshold_, other.radius, h_);
	edges_.update(other.hull, found->edge);
	edges_.update(other.hull, end);
	return true;
}

} // namespace softbody
