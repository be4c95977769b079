// SPDX-License-Identifier: MIT
// Validators of borders and colliders.
#include "core/model/surroundings.h"

#include "core/geometry/triangle.h"

#include <cmath>
#include <string>

namespace softbody {

namespace {

Status check_surface(const Surface &surface) {
	if (Status status = check_at_least("surface.friction", surface.friction, 0, "")) {
		return status;
	}
	if (Status status = check_between("surface.restitution", surface.restitution, 0, 1, "")) {
		return status;
	}
	if (!is_finite(surface.linear_velocity) || !is_finite(surface.velocity_origin) ||
			!std::isfinite(surface.angular_velocity)) {
		return Error{ "surface.velocity", "non-finite", "must be finite",
			"check the computation that produced this value" };
	}
	return {};
}

Status check_outline(const Collider &collider) {
	if (collider.vertices.size() < 3) {
		return Error{ "collider.vertices", std::to_string(collider.vertices.size()) + " points",
			"must have at least 3 points when concave", "leave it convex" };
	}
	if (collider.radius != 0) {
		return Error{ "collider.radius", number_text(collider.radius), "must be 0 when concave", "use a closed chain for a rounded outline" };
	}
	if (signed_area(collider.vertices) < 0) {
		return Error{ "collider.vertices", "a negative area", "must wind from x towards y (positive signed area)",
			"reverse the order of the points" };
	}
	if (is_self_intersecting(collider.vertices)) {
		return Error{ "collider.vertices", "edges that meet", "must be the outline of a simple polygon",
			"split it where it crosses itself" };
	}
	return {};
}

} // namespace

Status check_border(const Border &border) {
	const Vec2 normal = border.plane.normal;
	if (!is_finite(border.plane.position)) {
		return Error{ "border.position", "non-finite", "must be finite", "check the computation that produced this value" };
	}
	// NaN compares false, so a non-finite normal is refused here as well.
	if (!(std::abs(length(normal) - 1) <= Real(1e-3))) {
		return Error{ "border.normal", "length " + number_text(length(normal)), "must have unit length",
			"normalize the vector" };
	}
	return check_surface(border.surface);
}

Status check_collider(const Collider &collider) {
	const auto &vertices = collider.vertices;
	const std::size_t count = vertices.size();
	if (count == 0) {
		return Error{ "collider.vertices", "0 points", "must have at least 1 point", "give the outline" };
	}
	if (Status status = check_at_least("collider.radius", collider.radius, 0, "")) {
		return status;
	}
	if (count == 1 && collider.radius == 0) {
		return check_above("collider.radius", collider.radius, 0, "");
	}
	for (std::size_t i = 0; i < count; ++i) {
		const auto name = [i] { return "collider.vertices[" + std::to_string(i) + "]"; };
		if (!is_finite(vertices[i])) {
			return Error{ name(), "non-finite", "must be finite", "check the computation that produced this value" };
		}
		if (count > 1 && vertices[i] == vertices[(i + 1) % count]) {
			return Error{ name(), "coincides with the next", "must differ from its neighbors", "remove one of the two" };
		}
		// Equal turns everywhere are not enough: a pentagram has them, and winds twice. Seen from one vertex of a
		// convex polygon the others also follow one another in order.
		const bool wrong_turn = signed_double_area(vertices[i], vertices[(i + 1) % count], vertices[(i + 2) % count]) < 0;
		const bool out_of_order = signed_double_area(vertices[0], vertices[i], vertices[(i + 1) % count]) < 0;
		if (count > 2 && !collider.concave && (wrong_turn || out_of_order)) {
			return Error{ name(), "a corner that turns the wrong way",
				"must be convex and wind from x towards y (positive signed area)", "mark it concave, or split it" };
		}
	}
	if (collider.concave) {
		if (Status status = check_outline(collider)) {
			return status;
		}
	}
	if (collider.is_one_way() && !(std::abs(length(collider.one_way) - 1) <= Real(1e-3))) { // NaN compares false
		return Error{ "collider.one_way", "length " + number_text(length(collider.one_way)), "must have unit length, or be zero",
			"normalize the vector" };
	}
	if (Status status = check_finite("collider.one_way_margin", collider.one_way_margin, "length")) {
		return status;
	}
	if (count > 2 && !(signed_area(vertices) > 0)) {
		return Error{ "collider.vertices", "zero area", "must enclose an area", "use two vertices for a segment" };
	}
	return check_surface(collider.surface);
}

} // namespace softbody
