// SPDX-License-Identifier: MIT
// What the node shows to scripts and to the inspector: bindings, start shapes, advice.
#include "godot/soft_body_2d.h"

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
	const double gravity = double(ProjectSettings::get_singleton()->get_setting("physics/2d/default_gravity", 980.0));
	const double weight = mass_ * gravity * std::abs(gravity_scale_);
	const double radius = std::sqrt(get_rest_area() / Math_PI);
	const double unit_stiffness = 8 * weight / (radius * double(hull_.size())); // where q is 1
	if (stiffness_ < FOLDING_STRENGTH * unit_stiffness) {
		warnings.push_back("Stiffness " + String::num(stiffness_) + " N/m is too low for the body's weight: it will fold. Use at least " + String::num(std::ceil(FIRM_STRENGTH * unit_stiffness)) + " N/m, or less mass or gravity_scale.");
	}
	const double floor = softbody::DAMPING_FLOOR * std::sqrt(stiffness_ * mass_ / get_point_count());
	if (damping_ < floor) {
		warnings.push_back(vformat(String::utf8("Damping %s N·s/m is too low to calm strong deformations. Use at least %s N·s/m."), damping_, String::num(floor, 3)));
	}
	const Dictionary plan = get_substep_plan();
	if (!plan.is_empty() && !bool(plan["safe"])) {
		warnings.push_back("With these values a step is not stable in " + String::num_int64(plan["substeps"]) + " substeps. Lower the stiffness or the damping, raise the mass, use fewer hull points, or set substeps to 0 (automatic).");
	}
	return warnings;
}

void SoftBody2D::_bind_methods() {
	ClassDB::bind_method(D_METHOD("set_hull", "hull"), &SoftBody2D::set_hull);
	ClassDB::bind_method(D_METHOD("get_hull"), &SoftBody2D::get_hull);
	ClassDB::bind_method(D_METHOD("set_mass", "mass"), &SoftBody2D::set_mass);
	ClassDB::bind_method(D_METHOD("get_mass"), &SoftBody2D::get_mass);
	ClassDB::bind_method(D_METHOD("set_stiffness", "stiffness"), &SoftBody2D::set_stiffness);
	ClassDB::bind_method(D_METHOD("get_stiffness"), &SoftBody2D::get_stiffness);
	ClassDB::bind_method(D_METHOD("set_damping", "damping"), &SoftBody2D::set_damping);
	ClassDB::bind_method(D_METHOD("get_damping"), &SoftBody2D::get_damping);
	ClassDB::bind_method(D_METHOD("set_center_point", "center_point"), &SoftBody2D::set_center_point);
	ClassDB::bind_method(D_METHOD("has_center_point"), &SoftBody2D::has_center_point);
	ClassDB::bind_method(D_METHOD("set_pressure", "pressure"), &SoftBody2D::set_pressure);
	ClassDB::bind_method(D_METHOD("get_pressure"), &SoftBody2D::get_pressure);
	ClassDB::bind_method(D_METHOD("set_inflation", "inflation"), &SoftBody2D::set_inflation);
	ClassDB::bind_method(D_METHOD("get_inflation"), &SoftBody2D::get_inflation);
	ClassDB::bind_method(D_METHOD("set_friction", "friction"), &SoftBody2D::set_friction);
	ClassDB::bind_method(D_METHOD("get_friction"), &SoftBody2D::get_friction);
	ClassDB::bind_method(D_METHOD("set_bounce", "bounce"), &SoftBody2D::set_bounce);
	ClassDB::bind_method(D_METHOD("get_bounce"), &SoftBody2D::get_bounce);
	ClassDB::bind_method(D_METHOD("set_rolling_resistance", "rolling_resistance"), &SoftBody2D::set_rolling_resistance);
	ClassDB::bind_method(D_METHOD("get_rolling_resistance"), &SoftBody2D::get_rolling_resistance);
	ClassDB::bind_method(D_METHOD("set_shape_matching", "shape_matching"), &SoftBody2D::set_shape_matching);
	ClassDB::bind_method(D_METHOD("get_shape_matching"), &SoftBody2D::get_shape_matching);
	ClassDB::bind_method(D_METHOD("set_shape_damping", "shape_damping"), &SoftBody2D::set_shape_damping);
	ClassDB::bind_method(D_METHOD("get_shape_damping"), &SoftBody2D::get_shape_damping);
	ClassDB::bind_method(D_METHOD("set_gravity_scale", "gravity_scale"), &SoftBody2D::set_gravity_scale);
	ClassDB::bind_method(D_METHOD("get_gravity_scale"), &SoftBody2D::get_gravity_scale);
	ClassDB::bind_method(D_METHOD("set_integrator", "integrator"), &SoftBody2D::set_integrator);
	ClassDB::bind_method(D_METHOD("get_integrator"), &SoftBody2D::get_integrator);
	ClassDB::bind_method(D_METHOD("set_substeps", "substeps"), &SoftBody2D::set_substeps);
	ClassDB::bind_method(D_METHOD("get_substeps"), &SoftBody2D::get_substeps);
	ClassDB::bind_method(D_METHOD("set_collision_layer", "layer"), &SoftBody2D::set_collision_layer);
	ClassDB::bind_method(D_METHOD("get_collision_layer"), &SoftBody2D::get_collision_layer);
	ClassDB::bind_method(D_METHOD("set_collision_mask", "mask"), &SoftBody2D::set_collision_mask);
	ClassDB::bind_method(D_METHOD("get_collision_mask"), &SoftBody2D::get_collision_mask);
	ClassDB::bind_method(D_METHOD("set_color", "color"), &SoftBody2D::set_color);
	ClassDB::bind_method(D_METHOD("get_color"), &SoftBody2D::get_color);
	ClassDB::bind_method(D_METHOD("set_texture", "texture"), &SoftBody2D::set_texture);
	ClassDB::bind_method(D_METHOD("get_texture"), &SoftBody2D::get_texture);

	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_circle_hull", "radius", "point_count"), &SoftBody2D::make_circle_hull);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_box_hull", "size", "spacing"), &SoftBody2D::make_box_hull);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_capsule_hull", "radius", "height", "spacing"), &SoftBody2D::make_capsule_hull);

	ClassDB::bind_method(D_METHOD("get_point_count"), &SoftBody2D::get_point_count);
	ClassDB::bind_method(D_METHOD("get_point_positions"), &SoftBody2D::get_point_positions);
	ClassDB::bind_method(D_METHOD("get_point_velocities"), &SoftBody2D::get_point_velocities);
	ClassDB::bind_method(D_METHOD("get_interpolated_hull", "fraction"), &SoftBody2D::get_interpolated_hull);
	ClassDB::bind_method(D_METHOD("get_nearest_point", "global_position"), &SoftBody2D::get_nearest_point);
	ClassDB::bind_method(D_METHOD("has_point", "global_position"), &SoftBody2D::has_point);
	ClassDB::bind_method(D_METHOD("apply_point_force", "index", "force"), &SoftBody2D::apply_point_force);
	ClassDB::bind_method(D_METHOD("apply_point_impulse", "index", "impulse"), &SoftBody2D::apply_point_impulse);
	ClassDB::bind_method(D_METHOD("apply_central_force", "force"), &SoftBody2D::apply_central_force);
	ClassDB::bind_method(D_METHOD("apply_central_impulse", "impulse"), &SoftBody2D::apply_central_impulse);
	ClassDB::bind_method(D_METHOD("get_center_of_mass_position"), &SoftBody2D::get_center_of_mass_position);
	ClassDB::bind_method(D_METHOD("get_linear_velocity"), &SoftBody2D::get_linear_velocity);
	ClassDB::bind_method(D_METHOD("get_angular_velocity"), &SoftBody2D::get_angular_velocity);
	ClassDB::bind_method(D_METHOD("get_area"), &SoftBody2D::get_area);
	ClassDB::bind_method(D_METHOD("get_rest_area"), &SoftBody2D::get_rest_area);
	ClassDB::bind_method(D_METHOD("get_kinetic_energy"), &SoftBody2D::get_kinetic_energy);
	ClassDB::bind_method(D_METHOD("get_penetration"), &SoftBody2D::get_penetration);
	ClassDB::bind_method(D_METHOD("get_substep_plan"), &SoftBody2D::get_substep_plan);
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBody2D::get_warnings);
	ClassDB::bind_method(D_METHOD("reset"), &SoftBody2D::reset);

	ADD_PROPERTY(PropertyInfo(Variant::PACKED_VECTOR2_ARRAY, "hull", PROPERTY_HINT_NONE, "suffix:px"), "set_hull", "get_hull");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "mass", PROPERTY_HINT_RANGE, "0.001,1000,0.001,or_greater,exp,suffix:kg"), "set_mass", "get_mass");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "gravity_scale", PROPERTY_HINT_RANGE, "-8,8,0.001,or_less,or_greater"), "set_gravity_scale", "get_gravity_scale");

	ADD_GROUP("Structure", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "center_point"), "set_center_point", "has_center_point");

	ADD_GROUP("Material", "");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "stiffness", PROPERTY_HINT_RANGE, "0,10000,0.1,or_greater,exp,suffix:N/m"), "set_stiffness", "get_stiffness");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "damping", PROPERTY_HINT_RANGE, String::utf8("0,20,0.001,or_greater,suffix:N·s/m")), "set_damping", "get_damping");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "shape_matching", PROPERTY_HINT_RANGE, "0,2,0.01,or_greater"), "set_shape_matching", "get_shape_matching");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "shape_damping", PROPERTY_HINT_RANGE, "0,1,0.01,or_greater"), "set_shape_damping", "get_shape_damping");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "pressure", PROPERTY_HINT_RANGE, "0,10000,0.1,or_greater,exp,suffix:N/m"), "set_pressure", "get_pressure");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "inflation", PROPERTY_HINT_RANGE, "0,3,0.01,or_greater"), "set_inflation", "get_inflation");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "friction", PROPERTY_HINT_RANGE, "0,1,0.01,or_greater"), "set_friction", "get_friction");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "bounce", PROPERTY_HINT_RANGE, "0,1,0.01"), "set_bounce", "get_bounce");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "rolling_resistance", PROPERTY_HINT_RANGE, "0,1,0.001,or_greater"), "set_rolling_resistance", "get_rolling_resistance");

	ADD_GROUP("Collision", "collision_");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_layer", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_layer", "get_collision_layer");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_mask", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_mask", "get_collision_mask");

	ADD_GROUP("Solver", "");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "integrator", PROPERTY_HINT_ENUM, "Automatic,Explicit Euler,Semi-Implicit Euler,Midpoint,Heun,Runge-Kutta 4,Velocity Verlet,XPBD"), "set_integrator", "get_integrator");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "substeps", PROPERTY_HINT_RANGE, "0,64,1"), "set_substeps", "get_substeps");

	ADD_GROUP("Drawing", "");
	ADD_PROPERTY(PropertyInfo(Variant::COLOR, "color"), "set_color", "get_color");
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "texture", PROPERTY_HINT_RESOURCE_TYPE, "Texture2D"), "set_texture", "get_texture");

	BIND_ENUM_CONSTANT(INTEGRATOR_AUTOMATIC);
	BIND_ENUM_CONSTANT(INTEGRATOR_EXPLICIT_EULER);
	BIND_ENUM_CONSTANT(INTEGRATOR_SEMI_IMPLICIT_EULER);
	BIND_ENUM_CONSTANT(INTEGRATOR_MIDPOINT);
	BIND_ENUM_CONSTANT(INTEGRATOR_HEUN);
	BIND_ENUM_CONSTANT(INTEGRATOR_RUNGE_KUTTA_4);
	BIND_ENUM_CONSTANT(INTEGRATOR_VELOCITY_VERLET);
	BIND_ENUM_CONSTANT(INTEGRATOR_XPBD);
}

} // namespace godot
