// SPDX-License-Identifier: MIT
// What the node shows to scripts and to the inspector: bindings, start shapes.
#include "godot/nodes/soft_body_2d.h"

#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

namespace {

PackedVector2Array polygon_or_error(const softbody::Result<std::vector<softbody::Vec2>> &p_polygon) {
	if (!p_polygon) {
		ERR_FAIL_V_MSG(PackedVector2Array(), "SoftBody2D: " + softbody::to_godot(p_polygon.error()) + ".");
	}
	return softbody::to_godot(p_polygon.value());
}

} // namespace

String SoftBody2D::get_polygon_problem(const PackedVector2Array &p_polygon) {
	const softbody::Status status = softbody::check_hull(softbody::to_core(p_polygon));
	return status ? softbody::to_godot(*status) : String();
}

PackedVector2Array SoftBody2D::make_circle_polygon(double p_radius, int p_point_count) {
	return polygon_or_error(softbody::circle_hull(softbody::Real(p_radius), p_point_count));
}

PackedVector2Array SoftBody2D::make_box_polygon(const Vector2 &p_size, double p_spacing) {
	return polygon_or_error(softbody::box_hull(softbody::to_core(p_size), softbody::Real(p_spacing)));
}

PackedVector2Array SoftBody2D::make_capsule_polygon(double p_radius, double p_height, double p_spacing) {
	return polygon_or_error(softbody::capsule_hull(softbody::Real(p_radius), softbody::Real(p_height), softbody::Real(p_spacing)));
}

// Methods, signals and constants are bound in the file of what they do; properties in one list, the inspector's.
void SoftBody2D::_bind_methods() {
	bind_polygon();
	bind_mass();
	bind_surface();
	bind_material();
	bind_network();
	bind_limits();
	bind_structure();
	bind_motion();
	bind_damping();
	bind_sleep();
	bind_state();
	bind_points();
	bind_collision();
	bind_proxy();
	bind_contacts();
	bind_pins();
	bind_solver();
	bind_report();
	bind_drawing();
	bind_properties();
}

} // namespace godot
