// SPDX-License-Identifier: MIT
// Validators of borders and colliders.
#include "core/model/surroundings.h"

#include "core/geometry/polygon.h"

#include <string>

namespace softbody {

namespace {

Status check_surface(const Surface &surface) {
	return first_error({ check_at_least("surface.friction", surface.friction, 0, ""),
			check_between("surface.restitution", surface.restitution, 0, 1, ""),
			check_finite("surface.linear_velocity", surface.linear_velocity),
			check_finite("surface.velocity_origin", surface.velocity_origin),
			check_finite("surface.angular_velocity", surface.angular_velocity, "") });
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
	return first_error({ check_finite("border.position", border.plane.position), check_unit_length("border.normal", border.plane.normal),
			check_surface(border.surface) });
}

Status check_collider(const Collider &collider) {
	const auto &vertices = collider.vertices;
	const std::size_t count = vertices.size();
	if (count == 0) {
		return Error{ "collider.vertices", "0 points", "must have at least 1 point", "give the outline" };
	}
	if (Status status = first_error({ check_at_least("collider.radius", collider.radius, 0, ""), check_all_finite("collider.vertices", vertices) })) {
		return status;
	}
	if (count == 1 && collider.radius == 0) {
		return check_above("collider.radius", collider.radius, 0, "");
	}
	for (std::size_t i = 0; i < count; ++i) {
		const auto name = [i] { return "collider.vertices[" + std::to_string(i) + "]"; };
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
	if (count > 2 && !(signed_area(vertices) > 0)) {
		return Error{ "collider.vertices", "zero area", "must enclose an area", "use two vertices for a segment" };
	}
	return first_error({ collider.is_one_way() ? check_unit_length("collider.one_way", collider.one_way) : Status(),
			check_finite("collider.one_way_margin", collider.one_way_margin, "length"), check_surface(collider.surface) });
}

} // namespace softbody
