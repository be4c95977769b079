// SPDX-License-Identifier: MIT
// What the node shows to scripts and to the inspector: bindings, start shapes, advice.
#include "godot/nodes/soft_body_2d.h"

#include "core/base/constants.h"
#include "core/creator/hulls.h"
#include "core/geometry/polygon.h"
#include "godot/convert.h"

#include <godot_cpp/classes/project_settings.hpp>
#include <godot_cpp/core/class_db.hpp>

#include <cmath>

namespace godot {

namespace {

// How much a body sags under its own weight depends on q = k n R / (8 m g) alone, n being the hull points
// (measured for 8 to 64 of them): below 1 it folds, at 2 it has lost a tenth of its area, at 4 a twentieth.
constexpr double FOLDING_STRENGTH = 1;
constexpr double FIRM_STRENGTH = 4;

PackedVector2Array hull_or_error(const softbody::Result<std::vector<softbody::Vec2>> &p_hull) {
	if (!p_hull) {
		ERR_FAIL_V_MSG(PackedVector2Array(), "SoftBody2D: " + softbody::to_godot(p_hull.error().message()) + ".");
	}
	return softbody::to_godot(p_hull.value());
}

} // namespace

PackedVector2Array SoftBody2D::make_circle_hull(double p_radius, int p_point_count) {
	return hull_or_error(softbody::circle_hull(softbody::Real(p_radius), p_point_count));
}

PackedVector2Array SoftBody2D::make_box_hull(const Vector2 &p_size, double p_spacing) {
	return hull_or_error(softbody::box_hull(softbody::to_core(p_size), softbody::Real(p_spacing)));
}

PackedVector2Array SoftBody2D::make_capsule_hull(double p_radius, double p_height, double p_spacing) {
	return hull_or_error(softbody::capsule_hull(softbody::Real(p_radius), softbody::Real(p_height), softbody::Real(p_spacing)));
}

PackedStringArray SoftBody2D::get_warnings() const {
	PackedStringArray warnings;
	for (const KeyValue<StringName, String> &refused : refused_) {
		warnings.push_back("The last value given to '" + String(refused.key) + "' was refused: " + refused.value + ". The previous value is in use.");
	}
	if (const Design *found = design()) {
		for (const String &problem : found->problems) {
			warnings.push_back("Left out of the body, as it does not fit the rest of its structure: " + problem + ".");
		}
	}
	const std::vector<softbody::Vec2> hull = softbody::to_core(hull_);
	for (int64_t i = 0; i < inner_points_.size(); i++) {
		if (!softbody::point_in_polygon(softbody::to_core(inner_points_[i]), hull)) {
			warnings.push_back("inner_points[" + String::num_int64(i) + "] lies outside the hull: it is part of the body, but touches nothing. Move it inside.");
		}
	}
	const double gravity = double(ProjectSettings::get_singleton()->get_setting("physics/2d/default_gravity", 980.0));
	const double weight = mass_in_use() * gravity * std::abs(gravity_scale_);
	const double radius = std::sqrt(get_rest_area() / Math_PI);
	const double unit_stiffness = 8 * weight / (radius * double(hull_.size())); // where q is 1
	const double stiffness = material_values().stiffness;
	const double damping = material_values().damping;
	if (stiffness < FOLDING_STRENGTH * unit_stiffness) {
		warnings.push_back("Stiffness " + String::num(stiffness) + " N/m is too low for the body's weight: it will fold. Use at least " + String::num(std::ceil(FIRM_STRENGTH * unit_stiffness)) + " N/m, or less mass or gravity_scale.");
	}
	const double floor = softbody::DAMPING_FLOOR * std::sqrt(stiffness * mass_in_use() / get_point_count());
	if (damping < floor) {
		warnings.push_back(vformat(String::utf8("Damping %s N·s/m is too low to calm strong deformations. Use at least %s N·s/m."), damping, String::num(floor, 3)));
	}
	const Dictionary plan = get_substep_plan();
	if (!plan.is_empty() && !bool(plan["safe"])) {
		warnings.push_back("With these values a step is not stable in " + String::num_int64(plan["substeps"]) + " substeps. Lower the stiffness or the damping, raise the mass, use fewer hull points, or set substeps to 0 (automatic).");
	}
	append_pin_warnings(warnings);
	append_drawing_warnings(warnings);
	return warnings;
}

// In the order of the inspector. Each of these stands in the file of what it binds.
void SoftBody2D::_bind_methods() {
	bind_hull();
	bind_mass();
	bind_structure();
	bind_material();
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
	bind_drawing();
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBody2D::get_warnings);
}

} // namespace godot
