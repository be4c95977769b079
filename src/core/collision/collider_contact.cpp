// SPDX-License-Identifier: MIT
// Contacts between a hull and one collider.
#include "core/collision/collider_contact.h"

#include "core/base/constants.h"
#include "core/collision/convex_query.h"
#include "core/geometry/circle.h"
#include "core/geometry/round_outline.h"
#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>

namespace softbody {

namespace {

// Contact of a collider's corner or round end with the nearest edge of the hull.
std::optional<SurfaceContact> find_edge_contact(std::span<const Vec2> hull, Vec2 corner, Real radius, bool inside) {
	const OutlinePlace nearest = nearest_place(hull, corner);
	const Real distance = std::sqrt(nearest.distance_squared);
	const Real depth = inside ? radius + distance : radius - distance;
	if (!(depth > 0)) {
		return {};
	}
	const std::size_t next = (nearest.edge + 1) % hull.size();
	const Vec2 edge = hull[next] - hull[nearest.edge];
	const Vec2 away = (nearest.position - corner) * (inside ? Real(-1) : Real(1));
	// The hull must move so that the corner leaves through its nearest place on the hull: against the direction from
	// the corner to that place if the corner is inside, along it if outside. On the edge itself the inward normal is
	// used.
	Vec2 normal = perpendicular(edge);
	if (distance > Real(1e-4) * length(edge)) {
		normal = away;
	}
	const Real size = length(normal);
	if (!(size > 0)) {
		return {};
	}
	return SurfaceContact{ { nearest.edge, next, nearest.t }, normal * (1 / size), depth };
}

// Contact with the first edge that a corner crossed on its way into the hull.
std::optional<SurfaceContact> find_entered_edge(const HullMotion &hull, Vec2 from, Vec2 to, Real radius) {
	std::size_t entered = 0;
	Real first = 2;
	const std::size_t count = hull.to.size();
	for (std::size_t i = 0; i < count; ++i) {
		const std::size_t next = (i + 1) % count;
		const auto impact =
				point_segment_impact({ from, to }, { hull.from[i], hull.to[i] }, { hull.from[next], hull.to[next] });
		if (impact && impact->time < first) {
			first = impact->time;
			entered = i;
		}
	}
	if (first > 1) {
		return {};
	}
	const std::size_t next = (entered + 1) % count;
	const Vec2 edge = hull.to[next] - hull.to[entered];
	const Real size = length(edge);
	const Vec2 normal = perpendicular(edge) * (1 / size); // inward, as hulls have positive winding
	const Real depth = radius + dot(normal, to - hull.to[entered]);
	if (!(depth > 0)) { // false for an edge without length, too
		return {};
	}
	return SurfaceContact{ { entered, next, closest_parameter_on_segment(to, hull.to[entered], hull.to[next]) }, normal,
		depth };
}

// A point that starts on a segment, or beside it by a rounding, came from the side on which its body is. `p` lies at
// `distance` from the segment's line; the result at `apart`.
Vec2 put_beside(const Collider &segment, Vec2 p, Real distance, Vec2 center, Real apart) {
	const Real side = distance_to_line(segment, center) < 0 ? -apart : apart;
	const Vec2 edge = segment.vertices[1] - segment.vertices[0];
	return p + Vec2{ edge.y, -edge.x } * ((side - distance) / length(edge));
}

// Contact of a place of the hull that moved so in the collider's frame.
std::optional<PointContact> find_contact_of_place(const HullMotion &hull, Vec2 from, Vec2 to, const Collider &collider,
		const ColliderMotion &motion, Real slop) {
	if (collider.vertices.size() == 2) {
		const Real distance = distance_to_line(collider, from);
		if (std::abs(distance) < slop / 2) {
			from = put_beside(collider, from, distance, motion.own_from(mean_of(hull.from.first(hull.to.size()))), slop / 2);
		}
	}
	return find_point_contact(collider, from, to, slop);
}

} // namespace

std::optional<SurfaceContact> find_contact_of_point(const HullMotion &hull, std::size_t point,
		const Collider &collider, const ColliderMotion &motion, const Aabb &bounds, Real slop) {
	const Vec2 from = motion.own_from(hull.from[point]);
	const Vec2 to = motion.own_to(hull.to[point]);
	if (!Aabb::between(from, to).overlaps(bounds)) {
		return {};
	}
	const auto contact = find_contact_of_place(hull, from, to, collider, motion, slop);
	if (!contact) {
		return {};
	}
	return SurfaceContact{ { point, point, 0 }, motion.turned(contact->normal), contact->depth };
}

std::optional<SurfaceContact> find_contact_of_edge(const HullMotion &hull, std::size_t edge, Real bulge_at_rest,
		const Collider &collider, const ColliderMotion &motion, const Aabb &bounds, Real slop) {
	const std::size_t count = hull.to.size();
	const std::size_t next = edge + 1 < count ? edge + 1 : 0;
	const Vec2 a = motion.own_to(hull.to[edge]);
	const Vec2 b = motion.own_to(hull.to[next]);
	if (!Aabb::between(a, b).grown(bulge_at_rest).overlaps(bounds)) {
		return {};
	}
	const Real bulge = present_bulge<Real>(
			{ hull.to[edge > 0 ? edge - 1 : count - 1], hull.to[edge], hull.to[next], hull.to[next + 1 < count ? next + 1 : 0] }, bulge_at_rest);
	if (!(bulge > LEAST_BULGE * bulge_at_rest)) {
		return {};
	}
	// The face below the middle decides. Over a seam of two colliders it may be the face below one of the ends.
	for (const Real probe : { Real(0.5), Real(0), Real(1) }) {
		const SurfaceDistance face = surface_distance(collider, a + (b - a) * probe, collider.vertices.size() == 2 ? slop : Real(0));
		if (face.distance > 4 * bulge || !(dot(face.normal, perpendicular(b - a)) > 0)) { // not in front of the edge
			continue;
		}
		const Real t = deepest_share(dot(face.normal, a), dot(face.normal, b), bulge);
		if (!(t > 0 && t < 1)) {
			continue;
		}
		// The place comes from its chord: the bulge itself may begin behind a thin collider.
		const Vec2 from = motion.own_from(hull.from[edge]) * (1 - t) + motion.own_from(hull.from[next]) * t;
		const Vec2 to = a + (b - a) * t - face.normal * height_of_bulge(t, bulge);
		const auto contact = find_contact_of_place(hull, from, to, collider, motion, slop);
		if (contact && dot(contact->normal, face.normal) > Real(0.99)) { // that face, and not the side of a tile
			return SurfaceContact{ { edge, next, t }, motion.turned(contact->normal), contact->depth };
		}
	}
	return {};
}

std::optional<SurfaceContact> find_contact_of_corner(const HullMotion &hull, const Aabb &box,
		const Collider &collider, std::size_t corner, const ColliderMotion &motion, Real slop) {
	const Vec2 vertex = collider.vertices[corner];
	if (collider.concave) {
		const std::size_t count = collider.vertices.size();
		const Vec2 last = collider.vertices[(corner + count - 1) % count];
		if (signed_double_area(last, vertex, collider.vertices[(corner + 1) % count]) <= 0) {
			return {}; // reentrant corner: nothing can enter it
		}
	}
	// Over an end without thickness an edge slides by a rounding, and the next point slides down the other side. So a
	// free end gets a radius.
	const bool is_joined = (corner == 0 ? collider.ghost_at_first : collider.ghost_at_second).has_value();
	const bool is_free_end = collider.vertices.size() == 2 && !is_joined;
	const Real radius = is_free_end ? std::max(collider.radius, slop) : collider.radius;
	const Vec2 now = motion.is_still ? vertex : motion.to.apply(vertex);
	const Vec2 before = motion.world_from(vertex);
	const Aabb path = Aabb::between(before, now);
	if (!box.grown(radius).overlaps(path)) {
		return {};
	}
	const bool may_enter = box.overlaps(path); // a disk's center stays away from what its rim touches
	const bool inside = may_enter && point_in_polygon(now, hull.to);
	if (may_enter && (inside || !motion.is_still) && !point_in_polygon(before, hull.from.first(hull.to.size()))) {
		// The corner may by now be past the middle of a thin body, or past the whole body.
		if (const auto contact = find_entered_edge(hull, before, now, radius)) {
			return contact;
		}
	}
	return find_edge_contact(hull.to, now, radius, inside);
}

} // namespace softbody
