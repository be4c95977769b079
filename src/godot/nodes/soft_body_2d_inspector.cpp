// SPDX-License-Identifier: MIT
// The node's properties in the order of the inspector: what every body needs, then the rest in groups.
#include "godot/nodes/soft_body_2d.h"

#include "godot/resources/material_values.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

// Scenes store properties in this order: points come after the values that judge them, and before what counts them.
void SoftBody2D::bind_properties() {
	using softbody::material_binding::bind;
	using Values = softbody::MaterialValues;

	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "soft_body_material", PROPERTY_HINT_RESOURCE_TYPE, "SoftBodyMaterial2D"), "set_soft_body_material", "get_soft_body_material");
	softbody::bind_preset<SoftBody2D>();
	bind<SoftBody2D, &Values::youngs_modulus>();
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "mass", PROPERTY_HINT_RANGE, "0.001,1000,0.001,or_greater,exp,suffix:kg"), "set_mass", "get_mass");
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "physics_material_override", PROPERTY_HINT_RESOURCE_TYPE, "PhysicsMaterial"), "set_physics_material_override", "get_physics_material_override");

	ADD_GROUP("Material", "");
	bind<SoftBody2D, &Values::poisson_ratio>();
	bind<SoftBody2D, &Values::damping_ratio>();
	bind<SoftBody2D, &Values::rolling_resistance>();
	bind<SoftBody2D, &Values::inflation>();
	ADD_PROPERTY(PropertyInfo(Variant::INT, "elastic_model", PROPERTY_HINT_ENUM, "Automatic,Network,Springs,Springs and Shape,Springs Shape and Area,Modes,Triangles"), "set_elastic_model", "get_elastic_model");

	ADD_GROUP("Collision", "");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_layer", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_layer", "get_collision_layer");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "collision_mask", PROPERTY_HINT_LAYERS_2D_PHYSICS), "set_collision_mask", "get_collision_mask");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "self_collision", PROPERTY_HINT_ENUM, "Off,On,Automatic"), "set_self_collision", "get_self_collision");
	ADD_SUBGROUP("Proxy", "collision_proxy_");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "collision_proxy_enabled"), "set_collision_proxy_enabled", "is_collision_proxy_enabled");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "collision_proxy_margin", PROPERTY_HINT_RANGE, "-1,32,0.1,or_greater,suffix:px"), "set_collision_proxy_margin", "get_collision_proxy_margin");
	ADD_SUBGROUP("Contacts", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "contact_monitor"), "set_contact_monitor", "is_contact_monitor_enabled");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "max_contacts_reported", PROPERTY_HINT_RANGE, "0,64,1,or_greater"), "set_max_contacts_reported", "get_max_contacts_reported");

	ADD_GROUP("Drawing", "");
	ADD_PROPERTY(PropertyInfo(Variant::COLOR, "color"), "set_color", "get_color");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "antialiased"), "set_antialiased", "is_antialiased");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "smooth"), "set_smooth", "is_smooth");
	ADD_SUBGROUP("Texture", "");
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "texture", PROPERTY_HINT_RESOURCE_TYPE, "Texture2D"), "set_texture", "get_texture");
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "texture_offset", PROPERTY_HINT_NONE, "suffix:px"), "set_texture_offset", "get_texture_offset");
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "texture_scale", PROPERTY_HINT_LINK), "set_texture_scale", "get_texture_scale");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "texture_rotation", PROPERTY_HINT_RANGE, "-360,360,0.1,or_less,or_greater,radians_as_degrees"), "set_texture_rotation", "get_texture_rotation");
	ADD_SUBGROUP("Outline", "outline_");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "outline_width", PROPERTY_HINT_RANGE, "0,64,0.1,or_greater,suffix:px"), "set_outline_width", "get_outline_width");
	ADD_PROPERTY(PropertyInfo(Variant::COLOR, "outline_color"), "set_outline_color", "get_outline_color");
	ADD_PROPERTY(PropertyInfo(Variant::OBJECT, "outline_texture", PROPERTY_HINT_RESOURCE_TYPE, "Texture2D"), "set_outline_texture", "get_outline_texture");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "outline_texture_mode", PROPERTY_HINT_ENUM, "Tile,Stretch"), "set_outline_texture_mode", "get_outline_texture_mode");

	ADD_GROUP("Motion", "");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "gravity_scale", PROPERTY_HINT_RANGE, "-8,8,0.001,or_less,or_greater"), "set_gravity_scale", "get_gravity_scale");
	// They follow from the points: read by scripts, and neither set nor saved.
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "center_of_mass", PROPERTY_HINT_NONE, "suffix:px", PROPERTY_USAGE_NONE), "", "get_center_of_mass");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "inertia", PROPERTY_HINT_NONE, String::utf8("suffix:kg⋅px²"), PROPERTY_USAGE_NONE), "", "get_inertia");
	ADD_SUBGROUP("Linear", "linear_");
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "linear_velocity", PROPERTY_HINT_NONE, "suffix:px/s"), "set_linear_velocity", "get_linear_velocity");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "linear_damp_mode", PROPERTY_HINT_ENUM, "Combine,Replace"), "set_linear_damp_mode", "get_linear_damp_mode");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "linear_damp", PROPERTY_HINT_RANGE, "0,100,0.001,or_greater,suffix:1/s"), "set_linear_damp", "get_linear_damp");
	ADD_SUBGROUP("Angular", "angular_");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "angular_velocity", PROPERTY_HINT_NONE, String::utf8("radians_as_degrees,suffix:°/s")), "set_angular_velocity", "get_angular_velocity");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "angular_damp_mode", PROPERTY_HINT_ENUM, "Combine,Replace"), "set_angular_damp_mode", "get_angular_damp_mode");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "angular_damp", PROPERTY_HINT_RANGE, "0,100,0.001,or_greater,suffix:1/s"), "set_angular_damp", "get_angular_damp");
	ADD_SUBGROUP("Constant Forces", "constant_");
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "constant_force", PROPERTY_HINT_NONE, String::utf8("suffix:kg⋅px/s²")), "set_constant_force", "get_constant_force");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "constant_torque", PROPERTY_HINT_NONE, String::utf8("suffix:kg⋅px²/s²/rad")), "set_constant_torque", "get_constant_torque");

	ADD_GROUP("Deactivation", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "sleeping"), "set_sleeping", "is_sleeping");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "can_sleep"), "set_can_sleep", "is_able_to_sleep");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "freeze"), "set_freeze_enabled", "is_freeze_enabled");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "disable_mode", PROPERTY_HINT_ENUM, "Remove,Make Static,Keep Active"), "set_disable_mode", "get_disable_mode");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "simulate_off_screen"), "set_simulate_off_screen", "is_simulating_off_screen");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "failure_mode", PROPERTY_HINT_ENUM, "Reset,Freeze"), "set_failure_mode", "get_failure_mode");

	ADD_GROUP("Network", "");
	ADD_PROPERTY(PropertyInfo(Variant::BOOL, "center_point"), "set_center_point", "has_center_point");
	softbody::bind_network_values<SoftBody2D>();

	ADD_GROUP("Limits", "");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "least_area", PROPERTY_HINT_RANGE, "0,1,0.01"), "set_least_area", "get_least_area");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "least_stretch", PROPERTY_HINT_RANGE, "0,1,0.01"), "set_least_stretch", "get_least_stretch");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "most_stretch", PROPERTY_HINT_RANGE, "1,10,0.01,or_greater"), "set_most_stretch", "get_most_stretch");

	ADD_GROUP("Solver", "");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "integrator", PROPERTY_HINT_ENUM, "Automatic,Explicit Euler,Semi-Implicit Euler,Midpoint,Heun,Runge-Kutta 4,Velocity Verlet,XPBD"), "set_integrator", "get_integrator");
	ADD_PROPERTY(PropertyInfo(Variant::INT, "substeps", PROPERTY_HINT_RANGE, "0,64,1"), "set_substeps", "get_substeps");

	ADD_GROUP("Data", "");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_VECTOR2_ARRAY, "polygon", PROPERTY_HINT_NONE, "suffix:px"), "set_polygon", "get_polygon");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_VECTOR2_ARRAY, "inner_points", PROPERTY_HINT_NONE, "suffix:px"), "set_inner_points", "get_inner_points");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_INT32_ARRAY, "springs"), "set_springs", "get_springs");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_FLOAT32_ARRAY, "spring_stiffness_scales"), "set_spring_stiffness_scales", "get_spring_stiffness_scales");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_FLOAT32_ARRAY, "spring_damping_scales"), "set_spring_damping_scales", "get_spring_damping_scales");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_FLOAT32_ARRAY, "spring_length_scales"), "set_spring_length_scales", "get_spring_length_scales");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_INT32_ARRAY, "pinned_points"), "set_pinned_points", "get_pinned_points");
	ADD_PROPERTY(PropertyInfo(Variant::ARRAY, "pin_targets", PROPERTY_HINT_ARRAY_TYPE, String::num_int64(Variant::NODE_PATH) + "/" + String::num_int64(PROPERTY_HINT_NODE_PATH_VALID_TYPES) + ":Node2D"), "set_pin_targets", "get_pin_targets");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_VECTOR2_ARRAY, "uv", PROPERTY_HINT_NONE, "suffix:px"), "set_uv", "get_uv");
	ADD_PROPERTY(PropertyInfo(Variant::PACKED_COLOR_ARRAY, "vertex_colors"), "set_vertex_colors", "get_vertex_colors");
}

} // namespace godot
