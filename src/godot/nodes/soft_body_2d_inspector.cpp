// SPDX-License-Identifier: MIT
// The node's properties in the order of the inspector: what every body needs, then the rest in groups.
#include "godot/nodes/soft_body_2d_setters.h"

#include "core/base/constants.h"
#include "godot/resources/material_binding.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

namespace {

// Largest damping [1/s], far beyond that which stops a body within one step. Together with that of areas it stays a number.
constexpr double MOST_DAMP = 1e9;

} // namespace

template <auto VALUE>
void SoftBody2D::bind_value(const ValueRule &p_rule, PropertyHint p_hint, const char *p_hint_string, const char *p_getter_name, const char *p_setter_name) {
	using Owner = softbody::OwnerOf<VALUE>;
	rule_of<VALUE> = p_rule;
	const auto bind_methods = [&](auto p_setter, auto p_getter) {
		softbody::bind_property(p_rule.name, p_setter, p_getter, p_hint, p_hint_string, p_getter_name, p_setter_name);
	};
	if constexpr (std::is_same_v<Owner, Values>) {
		bind_methods(&SoftBody2D::set_value<VALUE>, &SoftBody2D::get_value<VALUE>);
	} else if constexpr (std::is_same_v<Owner, softbody::BodyStructure::DetailValues>) {
		bind_methods(&SoftBody2D::set_detail<VALUE>, &SoftBody2D::get_detail<VALUE>);
	} else if constexpr (std::is_same_v<Owner, softbody::SkinStyle>) {
		bind_methods(&SoftBody2D::set_style<VALUE>, &SoftBody2D::get_style<VALUE>);
	} else {
		bind_methods(&SoftBody2D::set_structure<VALUE>, &SoftBody2D::get_structure<VALUE>);
	}
}

// Scenes store properties in this order: points come before what counts them, and while a scene sets its values, no other value
// judges them but the mass.
void SoftBody2D::bind_properties() {
	using softbody::bind_property;
	using Material = softbody::MaterialValues;
	using Range = softbody::ValueRange;
	using Structure = softbody::BodyStructure::Values;
	using Style = softbody::SkinStyle;

	bind_property("soft_body_material", &SoftBody2D::set_soft_body_material, &SoftBody2D::get_soft_body_material, PROPERTY_HINT_RESOURCE_TYPE, "SoftBodyMaterial2D");
	softbody::bind_preset<SoftBody2D>();
	bind_value<&Structure::polygon>({ "polygon" }, PROPERTY_HINT_NONE, "suffix:px");
	bind_value<&Style::color>({ "color" });
	bind_value<&Style::texture>({ "texture" }, PROPERTY_HINT_RESOURCE_TYPE, "Texture2D");
	bind_property("mass_mode", &SoftBody2D::set_mass_mode, &SoftBody2D::get_mass_mode, PROPERTY_HINT_ENUM, "Auto,Custom");
	bind_property("mass", &SoftBody2D::set_mass, &SoftBody2D::get_mass, PROPERTY_HINT_RANGE, "0.001,1000,0.001,or_greater,exp,suffix:kg");
	bind_value<&Values::collision_layer>({ "collision_layer", {}, &SoftBody2D::apply_collision_layer }, PROPERTY_HINT_LAYERS_2D_PHYSICS);
	bind_value<&Values::collision_mask>({ "collision_mask", {}, &SoftBody2D::apply_settings }, PROPERTY_HINT_LAYERS_2D_PHYSICS);

	ADD_GROUP("Material", "");
	softbody::bind_material_value<SoftBody2D, &Material::youngs_modulus>();
	softbody::bind_material_value<SoftBody2D, &Material::poisson_ratio>();
	softbody::bind_material_value<SoftBody2D, &Material::damping_ratio>();
	bind_property("physics_material_override", &SoftBody2D::set_physics_material_override, &SoftBody2D::get_physics_material_override, PROPERTY_HINT_RESOURCE_TYPE, "PhysicsMaterial");
	softbody::bind_material_value<SoftBody2D, &Material::rolling_resistance>();
	softbody::bind_material_value<SoftBody2D, &Material::inflation>();
	bind_value<&Values::firm_for_weight>({ "firm_for_weight", {}, &SoftBody2D::apply_settings, true }, PROPERTY_HINT_NONE, "", "is_firm_for_weight");
	bind_value<&Values::elastic_model>({ "elastic_model", Range::between(0, ELASTIC_MODEL_COUNT - 1), &SoftBody2D::apply_shape, true }, PROPERTY_HINT_ENUM, "Automatic,Network,Springs,Springs and Shape,Springs Shape and Area,Modes,Triangles");

	ADD_GROUP("Detail", "detail_");
	using Detail = softbody::BodyStructure::DetailValues;
	bind_value<&Detail::mode>({ "detail_mode", Range::between(DETAIL_MODE_AS_DRAWN, DETAIL_MODE_POINT_COUNT) }, PROPERTY_HINT_ENUM, "As Drawn,Automatic,Point Count");
	bind_value<&Detail::tolerance>({ "detail_tolerance", Range::between(softbody::LEAST_DETAIL_TOLERANCE, softbody::MOST_DETAIL_TOLERANCE) }, PROPERTY_HINT_RANGE, "0.001,0.5,0.001");
	bind_value<&Detail::point_count>({ "detail_point_count", Range::between(softbody::MIN_HULL_POINTS, softbody::MAX_HULL_POINTS) }, PROPERTY_HINT_RANGE, "3,64,1,or_greater");

	ADD_GROUP("Collision", "");
	bind_value<&Values::self_collision>({ "self_collision", Range::between(SELF_COLLISION_OFF, SELF_COLLISION_AUTOMATIC), &SoftBody2D::apply_settings }, PROPERTY_HINT_ENUM, "Off,On,Automatic");
	bind_value<&Values::input_pickable>({ "input_pickable", {}, &SoftBody2D::update_picker }, PROPERTY_HINT_NONE, "", "is_pickable", "set_pickable");
	ADD_SUBGROUP("Proxy", "collision_proxy_");
	bind_value<&Values::collision_proxy_enabled>({ "collision_proxy_enabled", {}, &SoftBody2D::update_proxy_presence }, PROPERTY_HINT_NONE, "", "is_collision_proxy_enabled");
	bind_value<&Values::collision_proxy_margin>({ "collision_proxy_margin", Range::at_least(-1, "px") }, PROPERTY_HINT_RANGE, "-1,32,0.1,or_greater,suffix:px");
	ADD_SUBGROUP("Contacts", "");
	bind_property("contact_monitor", &SoftBody2D::set_contact_monitor, &SoftBody2D::is_contact_monitor_enabled, PROPERTY_HINT_NONE, "", "is_contact_monitor_enabled");
	bind_value<&Values::max_contacts_reported>({ "max_contacts_reported", Range::between(0, softbody::ContactReports::MOST_LIMIT) }, PROPERTY_HINT_RANGE, "0,64,1,or_greater");

	ADD_GROUP("Drawing", "");
	bind_value<&Style::look>({ "look", Range::between(LOOK_AUTOMATIC, LOOK_SOFT) }, PROPERTY_HINT_ENUM, "Automatic,Plain,Soft");
	bind_value<&Style::antialiased>({ "antialiased" }, PROPERTY_HINT_NONE, "", "is_antialiased");
	bind_value<&Style::smooth>({ "smooth" }, PROPERTY_HINT_NONE, "", "is_smooth");
	ADD_SUBGROUP("Texture", "");
	bind_value<&Style::texture_offset>({ "texture_offset" }, PROPERTY_HINT_NONE, "suffix:px");
	bind_value<&Style::texture_scale>({ "texture_scale" }, PROPERTY_HINT_LINK);
	bind_value<&Style::texture_rotation>({ "texture_rotation" }, PROPERTY_HINT_RANGE, "-360,360,0.1,or_less,or_greater,radians_as_degrees");
	ADD_SUBGROUP("Outline", "outline_");
	bind_value<&Style::outline_width>({ "outline_width", Range::at_least(0, "px") }, PROPERTY_HINT_RANGE, "0,64,0.1,or_greater,suffix:px");
	bind_value<&Style::outline_color>({ "outline_color" });
	bind_value<&Style::outline_texture>({ "outline_texture" }, PROPERTY_HINT_RESOURCE_TYPE, "Texture2D");
	bind_value<&Style::outline_texture_mode>({ "outline_texture_mode", Range::between(OUTLINE_TEXTURE_TILE, OUTLINE_TEXTURE_STRETCH) }, PROPERTY_HINT_ENUM, "Tile,Stretch");
	ADD_SUBGROUP("Cut Edges", "cut_");
	bind_value<&Style::cut_width>({ "cut_width", Range::at_least(0, "px") }, PROPERTY_HINT_RANGE, "0,64,0.1,or_greater,suffix:px");
	bind_value<&Style::cut_color>({ "cut_color" });
	bind_value<&Style::cut_texture>({ "cut_texture" }, PROPERTY_HINT_RESOURCE_TYPE, "Texture2D");

	ADD_GROUP("Motion", "");
	bind_value<&Values::gravity_scale>({ "gravity_scale", {}, &SoftBody2D::apply_settings, true }, PROPERTY_HINT_RANGE, "-8,8,0.001,or_less,or_greater");
	// They follow from the points: read by scripts, and neither set nor saved.
	ADD_PROPERTY(PropertyInfo(Variant::VECTOR2, "center_of_mass", PROPERTY_HINT_NONE, "suffix:px", PROPERTY_USAGE_NONE), "", "get_center_of_mass");
	ADD_PROPERTY(PropertyInfo(Variant::FLOAT, "inertia", PROPERTY_HINT_NONE, String::utf8("suffix:kg⋅px²"), PROPERTY_USAGE_NONE), "", "get_inertia");
	ADD_SUBGROUP("Linear", "linear_");
	bind_property("linear_velocity", &SoftBody2D::set_linear_velocity, &SoftBody2D::get_linear_velocity, PROPERTY_HINT_NONE, "suffix:px/s");
	bind_value<&Values::linear_damp_mode>({ "linear_damp_mode", Range::between(DAMP_MODE_COMBINE, DAMP_MODE_REPLACE) }, PROPERTY_HINT_ENUM, "Combine,Replace");
	bind_value<&Values::linear_damp>({ "linear_damp", { .minimum = 0, .maximum = MOST_DAMP, .unit = "1/s" } }, PROPERTY_HINT_RANGE, "0,100,0.001,or_greater,suffix:1/s");
	ADD_SUBGROUP("Angular", "angular_");
	bind_property("angular_velocity", &SoftBody2D::set_angular_velocity, &SoftBody2D::get_angular_velocity, PROPERTY_HINT_NONE, "radians_as_degrees,suffix:°/s");
	bind_value<&Values::angular_damp_mode>({ "angular_damp_mode", Range::between(DAMP_MODE_COMBINE, DAMP_MODE_REPLACE) }, PROPERTY_HINT_ENUM, "Combine,Replace");
	bind_value<&Values::angular_damp>({ "angular_damp", { .minimum = 0, .maximum = MOST_DAMP, .unit = "1/s" } }, PROPERTY_HINT_RANGE, "0,100,0.001,or_greater,suffix:1/s");
	ADD_SUBGROUP("Constant Forces", "constant_");
	bind_property("constant_force", &SoftBody2D::set_constant_force, &SoftBody2D::get_constant_force, PROPERTY_HINT_NONE, "suffix:kg⋅px/s²");
	bind_property("constant_torque", &SoftBody2D::set_constant_torque, &SoftBody2D::get_constant_torque, PROPERTY_HINT_NONE, "suffix:kg⋅px²/s²/rad");

	ADD_GROUP("Deactivation", "");
	bind_property("sleeping", &SoftBody2D::set_sleeping, &SoftBody2D::is_sleeping, PROPERTY_HINT_NONE, "", "is_sleeping");
	bind_value<&Values::can_sleep>({ "can_sleep", {}, &SoftBody2D::apply_settings }, PROPERTY_HINT_NONE, "", "is_able_to_sleep");
	bind_value<&Values::lock_rotation>({ "lock_rotation", {}, &SoftBody2D::lock_rotation }, PROPERTY_HINT_NONE, "", "is_lock_rotation_enabled", "set_lock_rotation_enabled");
	bind_property("freeze", &SoftBody2D::set_freeze_enabled, &SoftBody2D::is_freeze_enabled, PROPERTY_HINT_NONE, "", "is_freeze_enabled", "set_freeze_enabled");
	bind_value<&Values::disable_mode>({ "disable_mode", Range::between(DISABLE_MODE_REMOVE, DISABLE_MODE_KEEP_ACTIVE), &SoftBody2D::note_enabled }, PROPERTY_HINT_ENUM, "Remove,Make Static,Keep Active");
	bind_value<&Values::simulate_off_screen>({ "simulate_off_screen" }, PROPERTY_HINT_NONE, "", "is_simulating_off_screen");
	bind_value<&Values::important>({ "important", {}, &SoftBody2D::apply_settings }, PROPERTY_HINT_NONE, "", "is_important");
	bind_value<&Values::failure_mode>({ "failure_mode", Range::between(FAILURE_MODE_RESET, FAILURE_MODE_FREEZE), &SoftBody2D::apply_settings }, PROPERTY_HINT_ENUM, "Reset,Freeze");

	ADD_GROUP("Network", "");
	bind_value<&Structure::center_point>({ "center_point" }, PROPERTY_HINT_NONE, "", "has_center_point");
	softbody::bind_network_values<SoftBody2D>();

	ADD_GROUP("Limits", "");
	bind_value<&Values::least_area>({ "least_area", Range::between(0, 1), &SoftBody2D::apply_settings, true }, PROPERTY_HINT_RANGE, "0,1,0.01");
	bind_value<&Values::least_stretch>({ "least_stretch", Range::between(0, 1), &SoftBody2D::apply_settings, true }, PROPERTY_HINT_RANGE, "0,1,0.01");
	bind_value<&Values::most_stretch>({ "most_stretch", Range::at_least(1), &SoftBody2D::apply_settings, true }, PROPERTY_HINT_RANGE, "1,10,0.01,or_greater");

	ADD_GROUP("Dents, Tears and Cuts", "");
	softbody::bind_damage_values<SoftBody2D>();
	bind_value<&Values::dent_by>({ "dent_by", Range::between(0, softbody::DENT_BY_COUNT - 1), &SoftBody2D::apply_settings }, PROPERTY_HINT_ENUM, "Both,Compression,Tension");
	bind_value<&Values::smallest_piece>({ "smallest_piece", Range::between(0, 0.5) }, PROPERTY_HINT_RANGE, "0,0.5,0.001");

	ADD_GROUP("Solver", "");
	bind_value<&Values::integrator>({ "integrator", Range::between(0, softbody::INTEGRATOR_COUNT - 1), &SoftBody2D::apply_settings }, PROPERTY_HINT_ENUM, "Automatic,Explicit Euler,Semi-Implicit Euler,Midpoint,Heun,Runge-Kutta 4,Velocity Verlet,XPBD");
	bind_value<&Values::substeps>({ "substeps", Range::between(0, softbody::MAX_SUBSTEPS), &SoftBody2D::apply_settings }, PROPERTY_HINT_RANGE, "0,64,1");

	ADD_GROUP("Data", "");
	ADD_PROPERTY(PropertyInfo(Variant::ARRAY, "holes", PROPERTY_HINT_ARRAY_TYPE, String::num_int64(Variant::PACKED_VECTOR2_ARRAY) + ":"), "set_holes", "get_holes");
	bind_value<&Detail::weights>({ "detail_weights" });
	bind_value<&Structure::inner_points>({ "inner_points" }, PROPERTY_HINT_NONE, "suffix:px");
	bind_value<&Structure::springs>({ "springs" });
	bind_value<&Structure::stiffness_scales>({ "spring_stiffness_scales" });
	bind_value<&Structure::damping_scales>({ "spring_damping_scales" });
	bind_value<&Structure::length_scales>({ "spring_length_scales" });
	bind_property("pinned_points", &SoftBody2D::set_pinned_points, &SoftBody2D::get_pinned_points);
	ADD_PROPERTY(PropertyInfo(Variant::ARRAY, "pin_targets", PROPERTY_HINT_ARRAY_TYPE, String::num_int64(Variant::NODE_PATH) + "/" + String::num_int64(PROPERTY_HINT_NODE_PATH_VALID_TYPES) + ":Node2D"), "set_pin_targets", "get_pin_targets");
	bind_property("dents", &SoftBody2D::set_dents, &SoftBody2D::get_dents, PROPERTY_HINT_NONE, "", nullptr, nullptr, PROPERTY_USAGE_NO_EDITOR);
	bind_value<&Style::uv>({ "uv" }, PROPERTY_HINT_NONE, "suffix:px");
	bind_value<&Style::vertex_colors>({ "vertex_colors" });
	bind_value<&Style::cut_edges>({ "cut_edges" });
}

} // namespace godot
