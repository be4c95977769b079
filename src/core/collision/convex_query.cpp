// SPDX-License-Identifier: MIT
// Contact of a point with a rounded collider.
#include "core/collision/convex_query.h"

#include "core/geometry/segment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {

namespace {

// Outward unit normal of the edge that leaves vertex i, for positive winding.
Vec2 face_normal(const std::vector<Vec2> &vertices, std::size_t i) {
	const Vec2 edge = vertices[(i + 1) % vertices.size()] - vertices[i];
	const Real size = length(edge);
	return { edge.y / size, -edge.x / size };
}

// Distance of p in front of that edge. From exact differences in double: beside an edge of 10^6 px a float product would
// be off by more than a contact is deep.
Real face_distance(const std::vector<Vec2> &vertices, std::size_t i, Vec2 p) {
	const Vec2d edge = difference(vertices[(i + 1) % vertices.size()], vertices[i]);
	return Real(cross(difference(p, vertices[i]), edge) / length(edge));
}

SurfaceDistance distance_from_core(Vec2 offset, Vec2 fallback, Real radius) {
	const Real size = length(offset);
	return { size - radius, size > 0 ? offset * (1 / size) : fallback };
}

bool is_inner(const Collider &collider, std::size_t edge) {
	return edge < 32 && (collider.internal_edges >> edge & 1) != 0;
}

// Beside the segment the normal is its own. The direction from the nearest place would be rounding where the point is
// near and the ends are far.
SurfaceDistance segment_distance(const std::vector<Vec2> &vertices, Vec2 p, Real radius) {
	const Vec2 normal = face_normal(vertices, 0);
	const Real t = closest_parameter_on_segment(p, vertices[0], vertices[1]);
	if (!(t > 0 && t < 1)) {
		return distance_from_core(p - vertices[t > 0 ? 1 : 0], normal, radius);
	}
	const Real side = face_distance(vertices, 0, p);
	return { std::abs(side) - radius, side < 0 ? -normal : normal };
}

// The largest distance of p to the face lines, or to those of outer faces: negative inside.
SurfaceDistance nearest_face(const Collider &collider, Vec2 p, bool outer_only) {
	SurfaceDistance nearest{ -std::numeric_limits<Real>::max(), {} };
	for (std::size_t i = 0; i < collider.vertices.size(); ++i) {
		const Real distance = face_distance(collider.vertices, i, p);
		if (distance > nearest.distance && !(outer_only && is_inner(collider, i))) {
			nearest = { distance, face_normal(collider.vertices, i) };
		}
	}
	return nearest;
}

SurfaceDistance polygon_distance(const Collider &collider, Vec2 p) {
	SurfaceDistance nearest = nearest_face(collider, p, false);
	if (nearest.distance > 0 && collider.radius > 0) {
		// Outside the core polygon the rounded surface lies at `radius` from its closest point.
		return distance_from_core(p - nearest_place(collider.vertices, p).position, nearest.normal, collider.radius);
	}
	nearest.distance -= collider.radius;
	return nearest;
}

// Circle: only a point that crossed the far half needs the swept contact. Elsewhere the nearest surface is also the
// surface that the point came through.
std::optional<PointContact> swept_circle(const Collider &collider, Vec2 from, Vec2 to, Real slop) {
	const Vec2 center = collider.vertices[0];
	const Real radius = collider.radius;
	// A point resting on the circle may lie inside by rounding; it still came from outside.
	const Real inner = std::max(radius - slop, Real(0));
	if (dot(to - center, from - center) >= 0 || length_squared(from - center) < inner * inner) {
		return {};
	}
	const Vec2 closest = from + (to - from) * closest_parameter_on_segment(center, from, to);
	const Vec2 offset = closest - center;
	if (length_squared(offset) >= radius * radius) {
		return {};
	}
	const Vec2 path = (to - from) * (1 / length(to - from));
	const Vec2 entry = closest - path * std::sqrt(radius * radius - length_squared(offset));
	const Vec2 normal = (entry - center) * (1 / radius);
	return PointContact{ normal, dot(normal, entry - to) };
}

std::optional<PointContact> swept_segment(const Collider &collider, Vec2 from, Vec2 to, Real radius) {
	const Vec2 a = collider.vertices[0];
	const Vec2 b = collider.vertices[1];
	const double side = signed_double_area(a, b, from);
	if (side == 0 || !segment_intersection(from, to, a, b)) {
		return {};
	}
	const Real sign = side > 0 ? Real(-1) : Real(1);
	return PointContact{ face_normal(collider.vertices, 0) * sign, radius - sign * face_distance(collider.vertices, 0, to) };
}

// The nearest face that is not internal. If all faces are internal, the nearest face.
SurfaceDistance way_out(const Collider &collider, Vec2 p) {
	const SurfaceDistance nearest = nearest_face(collider, p, true);
	return length_squared(nearest.normal) > 0 ? nearest : polygon_distance(collider, p);
}

std::optional<PointContact> polygon_contact(const Collider &collider, Vec2 from, Vec2 to, Real slop) {
	const std::vector<Vec2> &vertices = collider.vertices;
	Real enter = 0;
	Real leave = 1;
	Real entry_distance = 0;
	Vec2 entry_normal;
	Real best = -std::numeric_limits<Real>::max(); // largest distance = least depth, over faces that the point came from the front of
	Vec2 best_normal;
	bool ends_inside = true;
	for (std::size_t i = 0; i < vertices.size(); ++i) {
		const Vec2 normal = face_normal(vertices, i);
		const Real before = face_distance(vertices, i, from);
		const Real after = face_distance(vertices, i, to);
		// The passage is searched in the polygon shrunk by the slop. A point resting on a face may lie behind it by
		// rounding, and must still count as coming through it.
		const Real in_front = before + slop;
		const Real way = before - after;
		if (after > 0) {
			ends_inside = false;
			if (before > 0) {
				return {}; // the whole path is in front of this face
			}
			leave = std::min(leave, in_front / way);
		} else {
			if (is_inner(collider, i)) {
				continue; // a point coming this way comes out of the adjacent collider
			}
			if (in_front > 0 && way > 0 && in_front / way >= enter) {
				enter = in_front / way;
				entry_distance = after;
				entry_normal = normal;
			}
			if (before >= -slop && after > best) {
				best = after;
				best_normal = normal;
			}
		}
	}
	if (ends_inside) {
		if (best > -std::numeric_limits<Real>::max()) {
			return PointContact{ best_normal, collider.radius - best };
		}
		const SurfaceDistance surface = collider.internal_edges != 0 ? way_out(collider, to) : surface_distance(collider, to);
		return PointContact{ surface.normal, -surface.distance };
	}
	if (enter > 0 && enter < leave) {
		return PointContact{ entry_normal, collider.radius - entry_distance };
	}
	return {};
}

// Nearest place on the outline of a concave polygon.
SurfaceDistance outline_distance(const Collider &collider, Vec2 p) {
	const std::vector<Vec2> &vertices = collider.vertices;
	const OutlinePlace nearest = nearest_place(vertices, p);
	const bool inside = point_in_polygon(p, vertices);
	const Real distance = std::sqrt(nearest.distance_squared);
	const Vec2 edge = vertices[(nearest.edge + 1) % vertices.size()] - vertices[nearest.edge];
	const Vec2 outwards = (nearest.position - p) * (inside ? Real(1) : Real(-1));
	// So close to the outline the difference gives no direction; the face's normal replaces it.
	const bool is_close = !(distance > Real(1e-4) * length(edge));
	return { inside ? -distance : distance, is_close ? face_normal(vertices, nearest.edge) : outwards * (1 / distance) };
}

// A concave polygon: the point leaves by the edge that it entered by, else by the nearest edge.
std::optional<PointContact> outline_contact(const Collider &collider, Vec2 from, Vec2 to, Real slop) {
	const std::vector<Vec2> &vertices = collider.vertices;
	Real first = 2;
	PointContact entered;
	for (std::size_t i = 0; i < vertices.size(); ++i) {
		const Vec2 normal = face_normal(vertices, i);
		const Real before = face_distance(vertices, i, from);
		const Real after = face_distance(vertices, i, to);
		if (!(after < 0 && before >= -slop && before > after)) {
			continue; // the point did not cross this face from its front
		}
		// A point resting on a face may lie behind it by rounding, and must still count as coming through it.
		const auto crossing = segment_intersection(from + normal * slop, to, vertices[i], vertices[(i + 1) % vertices.size()]);
		if (crossing && *crossing < first) {
			first = *crossing;
			entered = { normal, -after };
		}
	}
	if (first <= 1) {
		return entered;
	}
	if (!point_in_polygon(to, vertices)) {
		return {};
	}
	const SurfaceDistance surface = outline_distance(collider, to);
	return PointContact{ surface.normal, -surface.distance };
}

// Whether p lies beyond an end of a chain's segment and beside the adjacent segment.
bool is_beside_neighbor(const Collider &collider, Vec2 p) {
	const Vec2 a = collider.vertices[0];
	const Vec2 b = collider.vertices[1];
	const Real along = dot(p - a, b - a);
	if (along < 0) {
		return collider.ghost_at_first && dot(p - a, *collider.ghost_at_first - a) > 0;
	}
	return along > length_squared(b - a) && collider.ghost_at_second && dot(p - b, *collider.ghost_at_second - b) > 0;
}

} // namespace

SurfaceDistance surface_distance(const Collider &collider, Vec2 p, Real least_radius) {
	const std::vector<Vec2> &vertices = collider.vertices;
	const Real radius = std::max(collider.radius, least_radius);
	switch (vertices.size()) {
		case 1:
			return distance_from_core(p - vertices[0], { 0, -1 }, radius);
		case 2:
			return segment_distance(vertices, p, radius);
		default:
			return collider.concave ? outline_distance(collider, p) : polygon_distance(collider, p);
	}
}

Real distance_to_line(const Collider &segment, Vec2 p) {
	return face_distance(segment.vertices, 0, p);
}

std::optional<PointContact> find_point_contact(const Collider &collider, Vec2 from, Vec2 to, Real slop) {
	const std::size_t count = collider.vertices.size();
	const Real radius = count == 2 ? std::max(collider.radius, slop) : collider.radius;
	std::optional<PointContact> contact;
	if (collider.concave) {
		contact = outline_contact(collider, from, to, slop);
	} else if (count == 1) {
		contact = swept_circle(collider, from, to, slop);
	} else if (count == 2) {
		contact = swept_segment(collider, from, to, radius);
	} else {
		contact = polygon_contact(collider, from, to, slop);
	}
	if (!contact && (count < 3 || collider.radius > 0)) {
		const SurfaceDistance surface = surface_distance(collider, to, radius);
		if (surface.distance < 0 && !(count == 2 && is_beside_neighbor(collider, to))) {
			contact = PointContact{ surface.normal, -surface.distance };
		}
	}
	if (contact && !(contact->depth > 0)) {
		contact.reset();
	}
	return contact;
}

} // namespace softbody
