# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A body that was saved in a scene and loaded again is the same body.

# Numbers that any version's text format writes exactly.
# A variable, as arrays of packed arrays are no constant.
var properties := {
	"polygon": [Vector2(-50, -30), Vector2(0, -42), Vector2(50, -30), Vector2(58, 10), Vector2(30, 40),
		Vector2(-30, 40), Vector2(-58, 10)],
	"mass_mode": SoftBody2D.MASS_MODE_CUSTOM, "mass": 2.5, "firm_for_weight": false, "youngs_modulus": 480.0, "poisson_ratio": 0.25, "damping_ratio": 0.5,
	"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC, "detail_tolerance": 0.0625, "detail_point_count": 20, "detail_weights": [1.0, 2.0, 4.0, 1.0, 0.5, 1.0, 1.0],
	"holes": [PackedVector2Array([Vector2(-8, -8), Vector2(8, -8), Vector2(0, 16)])],
	"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK, "least_area": 0.25, "least_stretch": 0.125, "most_stretch": 4.0, "smallest_piece": 0.125, "yield_strain": 0.0625, "flow_rate": 12.0, "max_dent": 0.25, "tear_stretch": 0.75, "dent_by": SoftBody2D.DENT_BY_TENSION, "stiffness": 640.0, "damping": 0.5, 
	"rolling_resistance": 0.0625, "shape_matching": 0.75, "shape_damping_ratio": 0.5, "gravity_scale": 1.25,
	"substeps": 9, "collision_layer": 5, "collision_mask": 3, "color": Color(0.25, 0.5, 0.75, 1.0),
	"antialiased": true, "smooth": true, "look": SoftBody2D.LOOK_SOFT, "texture_offset": Vector2(2, -3), "texture_scale": Vector2(0.5, 2),
	"texture_rotation": 0.5, "outline_width": 4.0, "outline_color": Color(0.5, 0, 0.25, 1.0), "outline_texture_mode": 1,
	"cut_width": 3.0, "cut_color": Color(0.25, 0.5, 0, 1.0), "cut_edges": [2, 5],
	"pressure": 12.0, "inflation": 1.125, "center_point": false, "integrator": SoftBody2D.INTEGRATOR_MIDPOINT,
	"inner_points": [Vector2(-16, 0), Vector2(20, 4)],
	"springs": [0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 0, 7, 0, 7, 1, 7, 5, 7, 6, 8, 2, 8, 3, 8, 4, 7, 8],
	"spring_stiffness_scales": [1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 0.5, 0.5, 0.5, 3],
	"spring_damping_scales": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2],
	"spring_length_scales": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0.75],
	"linear_velocity": Vector2(30, 20), "angular_velocity": 0.5, "constant_force": Vector2(4, 0), "constant_torque": 8.0,
	"linear_damp_mode": 1, "linear_damp": 0.25, "angular_damp_mode": 1, "angular_damp": 0.5,
	"collision_proxy_enabled": false, "collision_proxy_margin": 2.0,
	"vertex_colors": [Color.RED, Color.GREEN, Color.BLUE, Color.WHITE, Color.BLACK, Color.RED, Color.GREEN],
	"uv": [Vector2(0, 0), Vector2(8, 0), Vector2(16, 0), Vector2(16, 8), Vector2(16, 16), Vector2(8, 16), Vector2(0, 16)],
	"dents": [Vector2(2, 1), Vector2.ZERO, Vector2(-2, 1), Vector2.ZERO, Vector2.ZERO, Vector2(0, -2), Vector2.ZERO, Vector2.ZERO, Vector2.ZERO],
	"pinned_points": [3], "pin_targets": [^".."],
	"can_sleep": false, "lock_rotation": true, "input_pickable": true, "simulate_off_screen": false, "important": true, "failure_mode": 1, "disable_mode": 1, "self_collision": 1, "contact_monitor": true, "max_contacts_reported": 4,
}
# Resources, and what would keep the body from moving.
const OTHERS: Array[String] = ["texture", "outline_texture", "cut_texture", "soft_body_material", "physics_material_override", "sleeping", "freeze"]


func _make() -> SoftBody2D:
	var body := SoftBody2D.new()
	for name: String in properties:
		body.set(name, type_convert(properties[name], typeof(body.get(name))))
	body.texture = PlaceholderTexture2D.new()
	body.physics_material_override = surface(0.25, 0.125)
	body.position = Vector2(12, -34)
	body.rotation = 0.5
	return body


func _reload(body: SoftBody2D, path: String) -> SoftBody2D:
	var scene := PackedScene.new()
	check_equal(scene.pack(body), OK, "packing")
	check_equal(ResourceSaver.save(scene, path), OK, "saving " + path)
	var loaded := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return loaded.instantiate() as SoftBody2D


## Points after every one of 60 ticks above a floor that the body reaches in that time.
func _motion(body: SoftBody2D) -> Array[PackedVector2Array]:
	var floor_body := add_floor(60)
	stage.add_child(body)
	var course: Array[PackedVector2Array] = []
	for i in 60:
		await ticks(1)
		course.append(body.get_point_positions())
	stage.remove_child(body)
	floor_body.free()
	await ticks(2)
	return course


func _check_same(path: String) -> void:
	var original := _make()
	var loaded := _reload(original, path)
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		var name: String = property["name"]
		if property["usage"] & PROPERTY_USAGE_STORAGE and not name in ["texture", "physics_material_override"]:
			check_equal(loaded.get(name), original.get(name), name)
	for name: String in properties:
		check_equal(loaded.get(name), type_convert(properties[name], typeof(loaded.get(name))), name)
	check(loaded.texture is PlaceholderTexture2D, "the texture is lost")
	check_equal([loaded.physics_material_override.friction, loaded.physics_material_override.bounce], [0.25, 0.125], "surface")
	check_equal(loaded.transform, original.transform, "transform")
	var expected: Array[PackedVector2Array] = await _motion(original)
	var course: Array[PackedVector2Array] = await _motion(loaded)
	check_above(expected[59][0].distance_to(expected[0][0]), 5, "way of the original")
	for i in 60:
		if not check(course[i] == expected[i], "the motion differs from tick %d on" % (i + 1)):
			break
	original.free()
	loaded.free()


func test_a_binary_scene_gives_the_same_body_and_the_same_motion() -> void:
	await _check_same("user://soft_body_test.scn")


func test_a_text_scene_gives_the_same_body_and_the_same_motion() -> void:
	await _check_same("user://soft_body_test.tscn")


## A scene sets one value after the other: none may be refused because the others are still to come.
func test_bodies_of_extreme_sizes_masses_and_materials_are_loaded_as_they_were_saved() -> void:
	for radius: float in [0.05, 5.0, 5000.0, 1e6]:
		for mass: float in [0.0, 1e-6, 1e6]:
			for properties: Dictionary in [{}, {"youngs_modulus": 1e-3}, {"youngs_modulus": 1e7, "poisson_ratio": 0.49, "damping_ratio": 5.0},
					{"stiffness": 1e6, "damping": 10.0, "center_point": false, "pressure": 1e5}, {"gravity_scale": 1e4, "inflation": 3.0}]:
				var body := SoftBody2D.new()
				body.polygon = SoftBody2D.make_circle_polygon(radius, 9)
				if mass > 0:
					body.mass = mass
				for name: String in properties:
					body.set(name, properties[name])
				take_errors() # a value that this body cannot have is refused here, and not saved
				var scene := PackedScene.new()
				scene.pack(body)
				var loaded: SoftBody2D = scene.instantiate()
				var what := "radius %s, mass %s, %s" % [radius, mass, properties]
				check_equal(take_errors(), PackedStringArray(), "errors as it is loaded, " + what)
				for property in body.get_property_list():
					if property["usage"] & PROPERTY_USAGE_STORAGE:
						check_equal(loaded.get(property["name"]), body.get(property["name"]), "%s, %s" % [property["name"], what])
				body.free()
				loaded.free()


func test_every_property_that_is_saved_is_tried_with_a_value_of_its_own() -> void:
	var plain := SoftBody2D.new()
	var made := _make()
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		var name: String = property["name"]
		if property["usage"] & PROPERTY_USAGE_STORAGE and not name in OTHERS:
			check(made.get(name) != plain.get(name), "%s is saved, and this suite leaves it at its default" % name)
	plain.free()
	made.free()


func test_a_duplicate_and_a_body_made_by_setters_in_any_order_have_the_same_properties() -> void:
	var original := _make()
	var duplicate := original.duplicate() as SoftBody2D
	var backwards := SoftBody2D.new()
	backwards.transform = original.transform
	backwards.physics_material_override = original.physics_material_override
	var names := properties.keys()
	names.reverse()
	for name: String in names:
		backwards.set(name, original.get(name))
	for copy: SoftBody2D in [duplicate, backwards]:
		for name: String in properties:
			check_equal(copy.get(name), original.get(name), name)
	var expected: Array[PackedVector2Array] = await _motion(original)
	for copy: SoftBody2D in [duplicate, backwards]:
		var course: Array[PackedVector2Array] = await _motion(copy)
		check(course == expected, "the motion differs")
		copy.free()
	original.free()


func test_sleep_and_freezing_are_saved() -> void:
	for property: String in ["sleeping", "freeze"]:
		var body := SoftBody2D.new()
		body.set(property, true)
		var loaded := _reload(body, "user://soft_body_test.tscn")
		stage.add_child(loaded)
		check(loaded.get(property), property + " is lost")
		await ticks(10)
		check_near(loaded.global_position, Vector2.ZERO, 0.01, "place of the body with " + property)
		body.free()


func test_defaults_are_not_written() -> void:
	var body := SoftBody2D.new()
	var scene := PackedScene.new()
	scene.pack(body)
	var names := PackedStringArray()
	for i in scene.get_state().get_node_property_count(0):
		names.append(scene.get_state().get_node_property_name(0, i))
	check_equal(names, PackedStringArray(), "properties written for a body left at its defaults")
	body.free()


func test_the_same_start_gives_the_same_motion_bit_for_bit() -> void:
	var courses: Array = []
	for i in 2:
		var body := _make()
		courses.append(await _motion(body))
		body.free()
	check(courses[0] == courses[1], "two runs differ")
