// SPDX-License-Identifier: MIT
// Finds edges of convex polygons that lie against one another.
#include "core/model/internal_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace softbody {

namespace {

// Common key of two edges that lie against each other, one reversed: ends in a grid, body and layers.
struct Edge {
	std::array<std::int64_t, 6> key{};
	std::uint32_t collider = 0;
	std::uint32_t index = 0;
};

std::int64_t cell_of(Real value, Real tolerance) {
	return std::int64_t(std::llround(double(value) / double(tolerance)));
}

} // namespace

void mark_internal_edges(std::span<Collider> colliders, Real tolerance) {
	std::vector<Edge> edges;
	for (std::uint32_t i = 0; i < colliders.size(); ++i) {
		Collider &collider = colliders[i];
		collider.internal_edges = 0;
		const std::size_t count = collider.vertices.size();
		if (count < 3 || collider.concave || collider.radius != 0) {
			continue;
		}
		for (std::uint32_t k = 0; k < std::min<std::size_t>(count, 32); ++k) {
			const Vec2 a = collider.vertices[k];
			const Vec2 b = collider.vertices[(k + 1) % count];
			edges.push_back({ { cell_of(a.x, tolerance), cell_of(a.y, tolerance), cell_of(b.x, tolerance), cell_of(b.y, tolerance),
									  collider.rigid_body, collider.surface.layer },
					i, k });
		}
	}
	std::ranges::sort(edges, {}, &Edge::key);
	for (const Edge &edge : edges) {
		const auto &[ax, ay, bx, by, body, layer] = edge.key;
		if (std::ranges::binary_search(edges, std::array{ bx, by, ax, ay, body, layer }, {}, &Edge::key)) {
			colliders[edge.collider].internal_edges |= 1u << edge.index;
		}
	}
}

} // namespace softbody
