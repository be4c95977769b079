// SPDX-License-Identifier: MIT
// The node's methods, signals and constants, by what they are about.
#include "godot/nodes/soft_body_2d_setters.h"

#include <godot_cpp/core/class_db.hpp>

namespace godot {

void SoftBody2D::_bind_methods() {
	bind_structure_methods();
	bind_body_methods();
	bind_properties();
	bind_enumerations();

	const PropertyInfo body(Variant::OBJECT, "body", PROPERTY_HINT_RESOURCE_TYPE, "Node");
	ADD_SIGNAL(MethodInfo("body_entered", body));
	ADD_SIGNAL(MethodInfo("body_exited", body));
	ADD_SIGNAL(MethodInfo("contact_started", body, PropertyInfo(Variant::VECTOR2, "point"), PropertyInfo(Variant::VECTOR2, "normal"), PropertyInfo(Variant::FLOAT, "impulse")));
	ADD_SIGNAL(MethodInfo("input_event", PropertyInfo(Variant::OBJECT, "viewport", PROPERTY_HINT_RESOURCE_TYPE, "Node"), PropertyInfo(Variant::OBJECT, "event", PROPERTY_HINT_RESOURCE_TYPE, "InputEvent"), PropertyInfo(Variant::INT, "shape_idx")));
	ADD_SIGNAL(MethodInfo("mouse_entered"));
	ADD_SIGNAL(MethodInfo("mouse_exited"));
	ADD_SIGNAL(MethodInfo("sleeping_state_changed"));
	ADD_SIGNAL(MethodInfo("failed"));
	ADD_SIGNAL(MethodInfo("dented", PropertyInfo(Variant::FLOAT, "amount")));
	ADD_SIGNAL(MethodInfo("torn", PropertyInfo(Variant::ARRAY, "pieces", PROPERTY_HINT_ARRAY_TYPE, "SoftBody2D")));
	ADD_SIGNAL(MethodInfo("was_cut", PropertyInfo(Variant::ARRAY, "pieces", PROPERTY_HINT_ARRAY_TYPE, "SoftBody2D")));
}

void SoftBody2D::bind_structure_methods() {
	using Structure = softbody::BodyStructure::Values;

	// Polygon and springs.
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("get_polygon_problem", "polygon"), &SoftBody2D::get_polygon_problem);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_circle_polygon", "radius", "point_count"), &SoftBody2D::make_circle_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_box_polygon", "size", "spacing"), &SoftBody2D::make_box_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("make_capsule_polygon", "radius", "height", "spacing"), &SoftBody2D::make_capsule_polygon);
	ClassDB::bind_static_method("SoftBody2D", D_METHOD("get_holes_problem", "holes", "polygon"), &SoftBody2D::get_holes_problem);
	ClassDB::bind_method(D_METHOD("set_holes", "holes"), &SoftBody2D::set_holes);
	ClassDB::bind_method(D_METHOD("get_holes"), &SoftBody2D::get_holes);
	ClassDB::bind_method(D_METHOD("get_simulated_polygon"), &SoftBody2D::get_simulated_polygon);
	ClassDB::bind_method(D_METHOD("get_detail_report"), &SoftBody2D::get_detail_report);
	ClassDB::bind_method(D_METHOD("get_spring_count"), &SoftBody2D::get_spring_count);
	ClassDB::bind_method(D_METHOD("get_spring_points", "index"), &SoftBody2D::get_spring_points);
	ClassDB::bind_method(D_METHOD("get_all_springs"), &SoftBody2D::get_all_springs);
	ClassDB::bind_method(D_METHOD("get_spring_stiffness", "index"), &SoftBody2D::get_spring_stiffness);
	ClassDB::bind_method(D_METHOD("get_spring_damping", "index"), &SoftBody2D::get_spring_damping);
	ClassDB::bind_method(D_METHOD("get_spring_rest_length", "index"), &SoftBody2D::get_spring_rest_length);
	ClassDB::bind_method(D_METHOD("get_spring_length", "index"), &SoftBody2D::get_spring_length);
	ClassDB::bind_method(D_METHOD("get_spring_strain", "index"), &SoftBody2D::get_spring_strain);
	ClassDB::bind_method(D_METHOD("set_spring_stiffness_scale", "index", "scale"), &SoftBody2D::set_scale_of_spring<&Structure::stiffness_scales>);
	ClassDB::bind_method(D_METHOD("set_spring_damping_scale", "index", "scale"), &SoftBody2D::set_scale_of_spring<&Structure::damping_scales>);
	ClassDB::bind_method(D_METHOD("set_spring_length_scale", "index", "scale"), &SoftBody2D::set_scale_of_spring<&Structure::length_scales>);

	// Material and surface.
	ClassDB::bind_method(D_METHOD("get_total_mass"), &SoftBody2D::get_mass);
	ClassDB::bind_method(D_METHOD("get_youngs_modulus_in_use"), &SoftBody2D::get_youngs_modulus_in_use);
	ClassDB::bind_method(D_METHOD("_take_over_material"), &SoftBody2D::take_over_material);
	ClassDB::bind_method(D_METHOD("get_elastic_model_in_use"), &SoftBody2D::get_elastic_model_in_use);
	ClassDB::bind_method(D_METHOD("get_soft_body_material_in_use"), &SoftBody2D::get_soft_body_material_in_use);
	ClassDB::bind_method(D_METHOD("_take_over_physics_material"), &SoftBody2D::take_over_physics_material);

	// Pins.
	ClassDB::bind_method(D_METHOD("set_pin_targets", "targets"), &SoftBody2D::set_pin_targets);
	ClassDB::bind_method(D_METHOD("get_pin_targets"), &SoftBody2D::get_pin_targets);
	ClassDB::bind_method(D_METHOD("set_point_pinned", "point_index", "pinned", "target"), &SoftBody2D::set_point_pinned, DEFVAL(NodePath()));
	ClassDB::bind_method(D_METHOD("is_point_pinned", "point_index"), &SoftBody2D::is_point_pinned);
	ClassDB::bind_method(D_METHOD("get_pin_target", "point_index"), &SoftBody2D::get_pin_target);

	// Advice.
	ClassDB::bind_method(D_METHOD("get_substep_plan"), &SoftBody2D::get_substep_plan);
	ClassDB::bind_method(D_METHOD("get_stability_report", "time_limit_msec"), &SoftBody2D::get_stability_report, DEFVAL(30.0));
	ClassDB::bind_method(D_METHOD("get_warnings"), &SoftBody2D::get_warnings);

	// Drawing.
	ClassDB::bind_method(D_METHOD("get_look_in_use"), &SoftBody2D::get_look_in_use);
	ClassDB::bind_method(D_METHOD("get_color_in_use"), &SoftBody2D::get_color_in_use);
	ClassDB::bind_method(D_METHOD("get_interpolated_polygon", "fraction"), &SoftBody2D::get_interpolated_polygon, DEFVAL(-1.0));
	ClassDB::bind_method(D_METHOD("get_interpolated_holes", "fraction"), &SoftBody2D::get_interpolated_holes, DEFVAL(-1.0));
	ClassDB::bind_method(D_METHOD("get_interpolated_transform", "fraction"), &SoftBody2D::get_interpolated_transform, DEFVAL(-1.0));
	ClassDB::bind_method(D_METHOD("_follow_texture"), &SoftBody2D::follow_texture);
	ClassDB::bind_method(D_METHOD("_enter_screen"), &SoftBody2D::enter_screen);
	ClassDB::bind_method(D_METHOD("_leave_screen"), &SoftBody2D::leave_screen);
}

void SoftBody2D::bind_body_methods() {
	using Contact = softbody::ContactReports::Record;

	// Motion.
	ClassDB::bind_method(D_METHOD("apply_impulse", "impulse", "position"), &SoftBody2D::apply_impulse, DEFVAL(Vector2()));
	ClassDB::bind_method(D_METHOD("apply_central_impulse", "impulse"), &SoftBody2D::apply_central_impulse, DEFVAL(Vector2()));
	ClassDB::bind_method(D_METHOD("apply_torque_impulse", "torque"), &SoftBody2D::apply_torque_impulse);
	ClassDB::bind_method(D_METHOD("apply_force", "force", "position"), &SoftBody2D::apply_force, DEFVAL(Vector2()));
	ClassDB::bind_method(D_METHOD("apply_central_force", "force"), &SoftBody2D::apply_central_force);
	ClassDB::bind_method(D_METHOD("apply_torque", "torque"), &SoftBody2D::apply_torque);
	ClassDB::bind_method(D_METHOD("add_constant_central_force", "force"), &SoftBody2D::add_constant_central_force);
	ClassDB::bind_method(D_METHOD("add_constant_force", "force", "position"), &SoftBody2D::add_constant_force, DEFVAL(Vector2()));
	ClassDB::bind_method(D_METHOD("add_constant_torque", "torque"), &SoftBody2D::add_constant_torque);
	ClassDB::bind_method(D_METHOD("get_center_of_mass_position"), &SoftBody2D::get_center_of_mass_position);
	ClassDB::bind_method(D_METHOD("get_center_of_mass"), &SoftBody2D::get_center_of_mass);
	ClassDB::bind_method(D_METHOD("set_axis_velocity", "axis_velocity"), &SoftBody2D::set_axis_velocity);
	ClassDB::bind_method(D_METHOD("get_gravity"), &SoftBody2D::get_gravity);
	ClassDB::bind_method(D_METHOD("get_inertia"), &SoftBody2D::get_inertia);
	ClassDB::bind_method(D_METHOD("get_kinetic_energy"), &SoftBody2D::get_kinetic_energy);
	ClassDB::bind_method(D_METHOD("teleport", "transform"), &SoftBody2D::teleport);
	ClassDB::bind_method(D_METHOD("reset"), &SoftBody2D::reset);

	// Points.
	ClassDB::bind_method(D_METHOD("get_point_count"), &SoftBody2D::get_point_count);
	ClassDB::bind_method(D_METHOD("get_point_positions"), &SoftBody2D::get_point_positions);
	ClassDB::bind_method(D_METHOD("get_point_velocities"), &SoftBody2D::get_point_velocities);
	ClassDB::bind_method(D_METHOD("get_point_forces"), &SoftBody2D::get_point_forces);
	ClassDB::bind_method(D_METHOD("set_point_positions", "positions"), &SoftBody2D::set_point_positions);
	ClassDB::bind_method(D_METHOD("set_point_velocities", "velocities"), &SoftBody2D::set_point_velocities);
	ClassDB::bind_method(D_METHOD("set_point_position", "index", "position"), &SoftBody2D::set_point_position);
	ClassDB::bind_method(D_METHOD("set_point_velocity", "index", "velocity"), &SoftBody2D::set_point_velocity);
	ClassDB::bind_method(D_METHOD("apply_point_forces", "forces"), &SoftBody2D::apply_point_forces);
	ClassDB::bind_method(D_METHOD("get_nearest_point", "global_position"), &SoftBody2D::get_nearest_point);
	ClassDB::bind_method(D_METHOD("has_point", "global_position"), &SoftBody2D::has_point);
	ClassDB::bind_method(D_METHOD("apply_point_force", "index", "force"), &SoftBody2D::apply_point_force);
	ClassDB::bind_method(D_METHOD("apply_point_impulse", "index", "impulse"), &SoftBody2D::apply_point_impulse);
	ClassDB::bind_method(D_METHOD("get_area"), &SoftBody2D::get_area);
	ClassDB::bind_method(D_METHOD("get_rest_area"), &SoftBody2D::get_rest_area);
	ClassDB::bind_method(D_METHOD("get_penetration"), &SoftBody2D::get_penetration);

	// Dents.
	ClassDB::bind_method(D_METHOD("get_dent"), &SoftBody2D::get_dent);
	ClassDB::bind_method(D_METHOD("reset_dents"), &SoftBody2D::reset_dents);

	// Cuts.
	ClassDB::bind_method(D_METHOD("cut", "from", "to"), &SoftBody2D::cut);
	ClassDB::bind_method(D_METHOD("cut_polyline", "points"), &SoftBody2D::cut_polyline);
	ClassDB::bind_method(D_METHOD("preview_cut", "points"), &SoftBody2D::preview_cut);
	ClassDB::bind_method(D_METHOD("get_cut_problem", "points"), &SoftBody2D::get_cut_problem);

	// State.
	ClassDB::bind_method(D_METHOD("get_state"), &SoftBody2D::get_state);
	ClassDB::bind_method(D_METHOD("set_state", "state"), &SoftBody2D::set_state);

	// Collision.
	ClassDB::bind_method(D_METHOD("set_collision_layer_value", "layer_number", "value"), &SoftBody2D::set_collision_layer_value);
	ClassDB::bind_method(D_METHOD("get_collision_layer_value", "layer_number"), &SoftBody2D::get_collision_layer_value);
	ClassDB::bind_method(D_METHOD("set_collision_mask_value", "layer_number", "value"), &SoftBody2D::set_collision_mask_value);
	ClassDB::bind_method(D_METHOD("get_collision_mask_value", "layer_number"), &SoftBody2D::get_collision_mask_value);
	ClassDB::bind_method(D_METHOD("has_self_collision"), &SoftBody2D::has_self_collision);
	ClassDB::bind_method(D_METHOD("get_rid"), &SoftBody2D::get_rid);
	ClassDB::bind_method(D_METHOD("add_collision_exception_with", "body"), &SoftBody2D::add_collision_exception_with);
	ClassDB::bind_method(D_METHOD("remove_collision_exception_with", "body"), &SoftBody2D::remove_collision_exception_with);
	ClassDB::bind_method(D_METHOD("get_collision_exceptions"), &SoftBody2D::get_collision_exceptions);

	// Contacts.
	ClassDB::bind_method(D_METHOD("get_contact_count"), &SoftBody2D::get_contact_count);
	ClassDB::bind_method(D_METHOD("get_contact_position", "index"), &SoftBody2D::get_contact_value<&Contact::point>);
	ClassDB::bind_method(D_METHOD("get_contact_normal", "index"), &SoftBody2D::get_contact_value<&Contact::normal>);
	ClassDB::bind_method(D_METHOD("get_contact_impulse", "index"), &SoftBody2D::get_contact_value<&Contact::impulse>);
	ClassDB::bind_method(D_METHOD("get_contact_depth", "index"), &SoftBody2D::get_contact_value<&Contact::depth>);
	ClassDB::bind_method(D_METHOD("get_contact_point", "index"), &SoftBody2D::get_contact_point);
	ClassDB::bind_method(D_METHOD("get_contact_collider", "index"), &SoftBody2D::get_contact_collider);
	ClassDB::bind_method(D_METHOD("get_colliding_bodies"), &SoftBody2D::get_colliding_bodies);
	ClassDB::bind_method(D_METHOD("_on_collider_exiting", "collider"), &SoftBody2D::on_collider_exiting);
}

void SoftBody2D::bind_enumerations() {
	softbody::bind_enumeration<SoftBody2D>("DetailMode", { "DETAIL_MODE_AS_DRAWN", "DETAIL_MODE_AUTOMATIC", "DETAIL_MODE_POINT_COUNT" });
	softbody::bind_enumeration<SoftBody2D>("DentBy", { "DENT_BY_BOTH", "DENT_BY_COMPRESSION", "DENT_BY_TENSION" });
	softbody::bind_enumeration<SoftBody2D>("SelfCollision", { "SELF_COLLISION_OFF", "SELF_COLLISION_ON", "SELF_COLLISION_AUTOMATIC" });
	softbody::bind_enumeration<SoftBody2D>("Integrator", { "INTEGRATOR_AUTOMATIC", "INTEGRATOR_EXPLICIT_EULER", "INTEGRATOR_SEMI_IMPLICIT_EULER", "INTEGRATOR_MIDPOINT", "INTEGRATOR_HEUN", "INTEGRATOR_RUNGE_KUTTA_4", "INTEGRATOR_VELOCITY_VERLET", "INTEGRATOR_XPBD" });
	softbody::bind_enumeration<SoftBody2D>("MassMode", { "MASS_MODE_AUTO", "MASS_MODE_CUSTOM" });
	softbody::bind_enumeration<SoftBody2D>("DampMode", { "DAMP_MODE_COMBINE", "DAMP_MODE_REPLACE" });
	softbody::bind_enumeration<SoftBody2D>("DisableMode", { "DISABLE_MODE_REMOVE", "DISABLE_MODE_MAKE_STATIC", "DISABLE_MODE_KEEP_ACTIVE" });
	softbody::bind_enumeration<SoftBody2D>("FailureMode", { "FAILURE_MODE_RESET", "FAILURE_MODE_FREEZE" });
	softbody::bind_enumeration<SoftBody2D>("Look", { "LOOK_AUTOMATIC", "LOOK_PLAIN", "LOOK_SOFT" });
	softbody::bind_enumeration<SoftBody2D>("OutlineTextureMode", { "OUTLINE_TEXTURE_TILE", "OUTLINE_TEXTURE_STRETCH" });
	softbody::bind_enumeration<SoftBody2D>("ElasticModel", { "ELASTIC_MODEL_AUTOMATIC", "ELASTIC_MODEL_NETWORK", "ELASTIC_MODEL_SPRINGS", "ELASTIC_MODEL_SPRINGS_AND_SHAPE", "ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA", "ELASTIC_MODEL_MODES", "ELASTIC_MODEL_TRIANGLES" });
}

} // namespace godot
