# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What the engine knows about the classes.

## Name, type, and what the hint must contain.
const PROPERTIES := {
	"polygon": [TYPE_PACKED_VECTOR2_ARRAY, "suffix:px"],
	"mass": [TYPE_FLOAT, "suffix:kg"],
	"youngs_modulus": [TYPE_FLOAT, "exp,suffix:N/m"],
	"poisson_ratio": [TYPE_FLOAT, "0,0.49"],
	"damping_ratio": [TYPE_FLOAT, ""],
	"elastic_model": [TYPE_INT, "Automatic,Network,Springs,Springs and Shape,Springs Shape and Area,Modes,Triangles"],
	"least_area": [TYPE_FLOAT, "0,1"],
	"least_stretch": [TYPE_FLOAT, "0,1"],
	"most_stretch": [TYPE_FLOAT, "1,"],
	"stiffness": [TYPE_FLOAT, "suffix:N/m"],
	"damping": [TYPE_FLOAT, "suffix:N·s/m"],
	"center_point": [TYPE_BOOL, ""],
	"pressure": [TYPE_FLOAT, "suffix:N/m"],
	"inflation": [TYPE_FLOAT, ""],
	"physics_material_override": [TYPE_OBJECT, "PhysicsMaterial"],
	"rolling_resistance": [TYPE_FLOAT, ""],
	"shape_matching": [TYPE_FLOAT, ""],
	"shape_damping_ratio": [TYPE_FLOAT, ""],
	"gravity_scale": [TYPE_FLOAT, ""],
	"integrator": [TYPE_INT, "Automatic,Explicit Euler,Semi-Implicit Euler"],
	"substeps": [TYPE_INT, ""],
	"collision_layer": [TYPE_INT, ""],
	"collision_mask": [TYPE_INT, ""],
	"collision_proxy_enabled": [TYPE_BOOL, ""],
	"collision_proxy_margin": [TYPE_FLOAT, "suffix:px"],
	"linear_damp_mode": [TYPE_INT, "Combine,Replace"],
	"linear_damp": [TYPE_FLOAT, ""],
	"angular_damp_mode": [TYPE_INT, "Combine,Replace"],
	"angular_damp": [TYPE_FLOAT, ""],
	"color": [TYPE_COLOR, ""],
	"vertex_colors": [TYPE_PACKED_COLOR_ARRAY, ""],
	"antialiased": [TYPE_BOOL, ""],
	"smooth": [TYPE_BOOL, ""],
	"texture": [TYPE_OBJECT, "Texture2D"],
	"texture_offset": [TYPE_VECTOR2, "suffix:px"],
	"texture_scale": [TYPE_VECTOR2, ""],
	"texture_rotation": [TYPE_FLOAT, "radians_as_degrees"],
	"uv": [TYPE_PACKED_VECTOR2_ARRAY, "suffix:px"],
	"outline_width": [TYPE_FLOAT, "suffix:px"],
	"outline_color": [TYPE_COLOR, ""],
	"outline_texture": [TYPE_OBJECT, "Texture2D"],
	"outline_texture_mode": [TYPE_INT, "Tile,Stretch"],
	"pinned_points": [TYPE_PACKED_INT32_ARRAY, ""],
	"pin_targets": [TYPE_ARRAY, "Node2D"],
	"inner_points": [TYPE_PACKED_VECTOR2_ARRAY, "suffix:px"],
	"springs": [TYPE_PACKED_INT32_ARRAY, ""],
	"spring_stiffness_scales": [TYPE_PACKED_FLOAT32_ARRAY, ""],
	"spring_damping_scales": [TYPE_PACKED_FLOAT32_ARRAY, ""],
	"spring_length_scales": [TYPE_PACKED_FLOAT32_ARRAY, ""],
	"soft_body_material": [TYPE_OBJECT, "SoftBodyMaterial2D"],
	"linear_velocity": [TYPE_VECTOR2, "suffix:px/s"],
	"angular_velocity": [TYPE_FLOAT, "radians_as_degrees"],
	"constant_force": [TYPE_VECTOR2, "suffix:kg"],
	"constant_torque": [TYPE_FLOAT, "suffix:kg"],
	"sleeping": [TYPE_BOOL, ""],
	"can_sleep": [TYPE_BOOL, ""],
	"freeze": [TYPE_BOOL, ""],
	"simulate_off_screen": [TYPE_BOOL, ""],
	"failure_mode": [TYPE_INT, "Reset,Freeze"],
	"disable_mode": [TYPE_INT, "Remove,Make Static,Keep Active"],
	"self_collision": [TYPE_INT, "Off,On,Automatic"],
	"contact_monitor": [TYPE_BOOL, ""],
	"max_contacts_reported": [TYPE_INT, ""],
}
## Stored, but not in the inspector.
const HIDDEN: Array[String] = ["network_values_set"]
const DEFAULTS := {
	"mass": 1.0, "stiffness": 100.0, "damping": 0.12, "physics_material_override": null,
	"rolling_resistance": 0.03, "shape_matching": 0.4, "shape_damping_ratio": 0.25, "gravity_scale": 1.0,
	"center_point": true, "pressure": 0.0, "inflation": 1.0, "integrator": 0,
	"substeps": 0, "collision_layer": 1, "collision_mask": 1, "color": Color.WHITE, "texture": null,
	"antialiased": false, "smooth": false, "texture_offset": Vector2.ZERO, "texture_scale": Vector2.ONE,
	"texture_rotation": 0.0, "outline_width": 0.0, "outline_color": Color.BLACK, "outline_texture": null,
	"outline_texture_mode": 0,
	"soft_body_material": null, "linear_velocity": Vector2.ZERO, "angular_velocity": 0.0,
	"constant_force": Vector2.ZERO, "constant_torque": 0.0, "sleeping": false, "can_sleep": true, "freeze": false, "simulate_off_screen": true,
	"failure_mode": 0, "disable_mode": 0,
	"self_collision": 2, "contact_monitor": false, "max_contacts_reported": 16,
	"collision_proxy_enabled": true, "collision_proxy_margin": -1.0,
	"linear_damp_mode": 0, "linear_damp": 0.0, "angular_damp_mode": 0, "angular_damp": 0.0,
}
const METHODS: Array[String] = [
	"make_circle_polygon", "make_box_polygon", "make_capsule_polygon", "get_point_count", "get_point_positions",
	"get_point_velocities", "get_interpolated_polygon", "get_interpolated_transform", "get_nearest_point", "has_point", "apply_point_force",
	"apply_point_impulse", "apply_central_force", "apply_central_impulse", "get_center_of_mass_position",
	"get_linear_velocity", "get_angular_velocity", "get_area", "get_rest_area", "get_kinetic_energy",
	"get_penetration", "get_substep_plan", "get_warnings", "reset", "get_rid",
	"add_collision_exception_with", "remove_collision_exception_with", "get_collision_exceptions",
]
const SERVER_METHODS: Array[String] = [
	"get_body_count", "get_tick_count", "get_last_step_usec", "get_mean_step_usec", "reset_statistics",
	"measure_max_penetration", "get_last_drawing_usec", "get_last_drawn_count",
]


func _own_properties() -> Dictionary:
	var found := {}
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			found[property["name"]] = property
	return found


func test_soft_body_is_a_node_2d_that_can_be_made() -> void:
	check(ClassDB.can_instantiate(&"SoftBody2D"), "SoftBody2D cannot be instantiated")
	check(ClassDB.is_parent_class(&"SoftBody2D", &"Node2D"), "SoftBody2D is no Node2D")
	check_equal(ClassDB.get_parent_class(&"SoftBody2D"), &"Node2D", "the parent class")
	var body := SoftBody2D.new()
	check_equal(body.get_class(), "SoftBody2D", "get_class()")
	body.free()


func test_every_property_has_its_type_and_unit() -> void:
	var found := _own_properties()
	for name: String in PROPERTIES:
		if not check(found.has(name), "property %s is missing" % name):
			continue
		check_equal(found[name]["type"], PROPERTIES[name][0], "type of " + name)
		var hint: String = found[name]["hint_string"]
		var part: String = PROPERTIES[name][1]
		check(part == "" or part in hint, "hint of %s is '%s', without '%s'" % [name, hint, part])
		check(found[name]["usage"] & PROPERTY_USAGE_EDITOR, "%s is not shown in the inspector" % name)
	for name in HIDDEN:
		check_equal(found[name]["usage"] & PROPERTY_USAGE_EDITOR, 0, "whether the inspector shows " + name)


func test_every_stored_property_is_covered_by_these_tests() -> void:
	for name: String in _own_properties():
		check(PROPERTIES.has(name) or name in HIDDEN, "property %s is not in a list of this suite" % name)


func test_numbers_have_ranges_and_layers_have_their_editor() -> void:
	var found := _own_properties()
	for name: String in ["mass", "stiffness", "damping", "rolling_resistance",
			"shape_matching", "shape_damping_ratio", "gravity_scale", "substeps"]:
		check_equal(found[name]["hint"], PROPERTY_HINT_RANGE, "hint of " + name)
	for name: String in ["mass", "stiffness", "damping"]:
		check("or_greater" in found[name]["hint_string"], "the inspector ends the range of %s" % name)
	check_equal(found["collision_layer"]["hint"], PROPERTY_HINT_LAYERS_2D_PHYSICS, "hint of collision_layer")
	check_equal(found["collision_mask"]["hint"], PROPERTY_HINT_LAYERS_2D_PHYSICS, "hint of collision_mask")
	check_equal(found["texture"]["hint"], PROPERTY_HINT_RESOURCE_TYPE, "hint of texture")


func test_defaults_are_the_documented_ones() -> void:
	var body := SoftBody2D.new()
	for name: String in DEFAULTS:
		check_equal(body.get(name), DEFAULTS[name], "default of " + name)
		check_equal(ClassDB.class_get_property_default_value(&"SoftBody2D", name), DEFAULTS[name],
				"what the inspector resets %s to" % name)
	check_points_near(body.polygon, SoftBody2D.make_circle_polygon(50, 16), 0.001, "the default polygon and a circle")
	body.free()


func test_every_method_exists() -> void:
	for name in METHODS:
		check(ClassDB.class_has_method(&"SoftBody2D", name, true), "SoftBody2D.%s() is missing" % name)
	for name in SERVER_METHODS:
		check(ClassDB.class_has_method(&"SoftBodySimulation2D", name, true), "SoftBodySimulation2D.%s() is missing" % name)


func test_the_server_is_a_singleton() -> void:
	check(Engine.has_singleton(&"SoftBodySimulation2D"), "there is no singleton SoftBodySimulation2D")
	check_equal(Engine.get_singleton(&"SoftBodySimulation2D").get_class(), "SoftBodySimulation2D", "class of the singleton")
