// SPDX-License-Identifier: MIT
// A chain of segments.
#pragma once

#include "core/model/world_data.h"

#include <cstddef>
#include <span>
#include <utility>

namespace softbody::testing {

/// Adds a segment from each point to the next, and back to the first if `closed`, with the radius, surface and rigid body of
/// `like`. It holds from both sides; what is inside a closed one stays inside. Returns the first refusal.
inline Status add_chain(WorldData &world, std::span<const Vec2> points, bool closed, const Collider &like = {}) {
	const std::size_t size = points.size();
	for (std::size_t i = 0; i + (closed ? 0 : 1) < size; ++i) {
		Collider segment = like;
		segment.vertices = { points[i], points[(i + 1) % size] };
		if (closed || i > 0) {
			segment.ghost_at_first = points[(i + size - 1) % size];
		}
		if (closed || i + 2 < size) {
			segment.ghost_at_second = points[(i + 2) % size];
		}
		if (Status status = world.add_collider(std::move(segment))) {
			return status;
		}
	}
	return {};
}

} // namespace softbody::testing
