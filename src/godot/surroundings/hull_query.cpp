// SPDX-License-Identifier: MIT
// Whether hulls overlap shapes of the engine, worked out from the points.
#include "godot/surroundings/hull_query.h"

#include "core/geometry/polygon.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <utility>

namespace softbody {

namespace {

Real distance_squared(Vec2 p, Vec2 a, Vec2 b) {
	return length_squared(a + (b - a) * closest_parameter_on_segment(p, a, b) - p);
}

// Segments that do not cross are nearest at an end of one of them.
bool are_within(Vec2 a, Vec2 b, Vec2 c, Vec2 d, Real distance) {
	const Real least = std::min(std::min(distance_squared(a, c, d), distance_squared(b, c, d)),
			std::min(distance_squared(c, a, b), distance_squared(d, a, b)));
	return least <= distance * distance || segment_intersection(a, b, c, d).has_value();
}

bool overlaps_collider(std::span<const Vec2> hull, const Aabb &box, const Collider &collider, Real margin) {
	const std::span<const Vec2> outline = collider.vertices;
	if (!box.overlaps(collider.bounds().grown(margin))) {
		return false;
	}
	if (point_in_polygon(outline.front(), hull) || (outline.size() > 2 && point_in_polygon(hull.front(), outline))) {
		return true;
	}
	// One vertex is an edge without length, two are one edge.
	const std::size_t edges = outline.size() > 2 ? outline.size() : 1;
	for (std::size_t i = 0; i < hull.size(); ++i) {
		for (std::size_t j = 0; j < edges; ++j) {
			if (are_within(hull[i], hull[(i + 1) % hull.size()], outline[j], outline[(j + 1) % outline.size()],
						collider.radius + margin)) {
				return true;
			}
		}
	}
	return false;
}

bool is_deeper(std::span<const Vec2> outline, Vec2 place, Real depth) {
	return point_in_polygon(place, outline) && nearest_place(outline, place).distance_squared > depth * depth;
}

// A round corner reaches farther than its vertex by the radius.
bool reaches_in(std::span<const Vec2> hull, const Collider &collider, Real depth) {
	const Real reach = collider.radius - depth;
	const auto is_in = [&](Vec2 vertex) {
		return reach < 0 ? is_deeper(hull, vertex, -reach) : point_in_polygon(vertex, hull) || nearest_place(hull, vertex).distance_squared < reach * reach;
	};
	return std::ranges::any_of(collider.vertices, is_in) || (collider.vertices.size() > 2 &&
			std::ranges::any_of(hull, [&](Vec2 point) { return is_deeper(collider.vertices, point, depth); }));
}

} // namespace

bool HullQuery::reaches_in(std::span<const Vec2> hull, Real depth) const {
	const Aabb box = bounding_box(hull);
	return std::ranges::any_of(shape_.colliders, [&](const Collider &collider) {
		return box.overlaps(collider.bounds()) && softbody::reaches_in(hull, collider, depth);
	});
}

HullQuery::HullQuery(TranslatedShape shape, Real margin) : shape_(std::move(shape)), margin_(margin) {}

bool HullQuery::overlaps(std::span<const Vec2> hull) const {
	const Aabb box = bounding_box(hull);
	const auto is_behind = [&](Vec2 point) { return signed_distance(*shape_.border, point) <= margin_; };
	return (shape_.border && std::ranges::any_of(hull, is_behind)) ||
			std::ranges::any_of(shape_.colliders, [&](const Collider &collider) { return overlaps_collider(hull, box, collider, margin_); });
}

} // namespace softbody
