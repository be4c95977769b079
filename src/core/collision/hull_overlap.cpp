// SPDX-License-Identifier: MIT
// How deep two hulls lie in each other.
#include "core/collision/hull_overlap.h"

#include "core/collision/hull_contact.h"
#include "core/geometry/aabb.h"

#include <algorithm>

namespace softbody {

namespace {

Real deepest_of(std::span<const Vec2> points, std::span<const Vec2> hull, const Aabb &box) {
	HullEdges edges;
	edges.assign(hull);
	Real deepest = 0;
	for (const Vec2 p : points) {
		if (!box.overlaps({ p, p })) {
			continue;
		}
		if (const auto contact = edges.find(p, Vec2{})) { // without a direction: through the nearest edge
			deepest = std::max(deepest, contact->depth);
		}
	}
	return deepest;
}

} // namespace

Real measure_overlap(std::span<const Vec2> a, std::span<const Vec2> b) {
	const Aabb box_a = bounding_box(a);
	const Aabb box_b = bounding_box(b);
	if (!box_a.overlaps(box_b)) {
		return 0;
	}
	return std::max(deepest_of(a, b, box_b), deepest_of(b, a, box_a));
}

} // namespace softbody
