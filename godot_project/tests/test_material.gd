# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A node has a material of its own, or one that it shares with others: a change of that reaches all of them. Its properties are
## those of the material in use.

const FIELDS := {
	"youngs_modulus": [250.0, 320.0], "poisson_ratio": [0.25, 0.375], "damping_ratio": [0.5, 0.25],
	"stiffness": [250.0, 320.0], "damping": [0.5, 0.75], "shape_matching": [0.75, 0.5], "shape_damping_ratio": [0.5, 0.125],
	"pressure": [20.0, 40.0], "inflation": [1.25, 1.5], "friction": [0.75, 0.125], "bounce": [0.5, 0.25],
	"rolling_resistance": [0.25, 0.125], "density": [2.0, 4.0],
}


func _make(values := {}) -> SoftBodyMaterial2D:
	var material := SoftBodyMaterial2D.new()
	for name: String in values:
		material.set(name, values[name])
	return material


func test_a_change_reaches_every_body_of_the_material_at_once() -> void:
	var material := _make({"stiffness": 250.0, "damping": 0.5})
	var bodies: Array[SoftBody2D] = []
	for i in 3:
		bodies.append(add_weightless_body(Vector2(200 * i, 0), {"soft_body_material": material}))
	var other := add_weightless_body(Vector2(800, 0), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	for body in bodies:
		check_equal(body.get_spring_stiffness(3), 250.0, "stiffness of a spring")
	material.stiffness = 320.0
	material.damping = 0.75
	for body in bodies:
		check_equal(body.get_spring_stiffness(3), 320.0, "stiffness of a spring after the change")
		check_near(body.get_spring_damping(3), 0.75, 1e-6, "damping of a spring after the change")
	check_equal(other.get_spring_stiffness(3), 100.0, "stiffness of a body without the material")


# A body in a scene file, saved and loaded.
func _reload(body: SoftBody2D, lines: PackedStringArray) -> SoftBody2D:
	var path := "user://material_of_a_body.tscn"
	var scene := PackedScene.new()
	check_equal(scene.pack(body), OK, "packing")
	check_equal(ResourceSaver.save(scene, path), OK, "saving")
	lines.append_array(FileAccess.get_file_as_string(path).split("\n"))
	var loaded := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return loaded.instantiate() as SoftBody2D


func test_a_nodes_properties_are_those_of_the_material_in_use() -> void:
	var material := _make({"stiffness": 250.0})
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 60.0})
	body.soft_body_material = material
	check_equal([body.stiffness, body.get_spring_stiffness(0)], [250.0, 250.0], "stiffness with the material")
	material.stiffness = 320.0
	material.preset = SoftBodyMaterial2D.PRESET_FOAM
	check_equal([body.stiffness, body.poisson_ratio, body.has_network_values()], [320.0, 0.0, true], "values after a change of the material")
	body.soft_body_material = null
	check_equal([body.stiffness, body.get_spring_stiffness(0)], [60.0, 60.0], "stiffness without the material, as undo wants it")
	check_equal([body.poisson_ratio, body.preset], [0.45, SoftBodyMaterial2D.PRESET_JELLY], "other values without the material")
	material.stiffness = 400.0
	check_equal(body.get_spring_stiffness(0), 60.0, "stiffness after a change of the material that was taken away")
	check_equal(material.changed.get_connections().size(), 0, "listeners that the material has left")


func test_a_value_set_beside_a_shared_material_changes_nothing_and_a_warning_says_so_once() -> void:
	if not is_debug_build():
		return
	var material := _make({"stiffness": 250.0})
	var body := add_weightless_body(Vector2.ZERO, {"soft_body_material": material})
	var grip := surface(0.75)
	body.physics_material_override = grip
	take_errors()
	for i in 3:
		body.stiffness = 70.0
		body.preset = SoftBodyMaterial2D.PRESET_RUBBER
		body.clear_network_values()
	check_equal([body.stiffness, material.stiffness, body.physics_material_override], [250.0, 250.0, grip], "values")
	var errors := take_errors()
	if _error_log != null and check_equal(errors.size(), 1, "number of warnings: %s" % [errors]):
		for word: String in [String(body.name), "'stiffness'", "'soft_body_material'"]:
			check(word in errors[0], "the warning does not name %s: %s" % [word, errors[0]])
	body.soft_body_material = null
	check_equal([body.stiffness, body.has_network_values()], [100.0, false], "values of the node itself")


func test_a_scene_holds_the_values_of_a_body_once() -> void:
	var body := SoftBody2D.new()
	body.youngs_modulus = 480.0
	body.stiffness = 60.0
	var lines := PackedStringArray()
	var loaded := _reload(body, lines)
	check("youngs_modulus = 480.0" in lines and "stiffness = 60.0" in lines, "own values are not saved: %s" % [lines])
	check(not "SoftBodyMaterial2D" in "".join(lines), "the node's own material is saved, which instances of the scene would share: %s" % [lines])
	check_equal([loaded.youngs_modulus, loaded.stiffness, loaded.has_network_values()], [480.0, 60.0, true], "own values after loading")
	loaded.youngs_modulus = 500.0
	check_equal(body.youngs_modulus, 480.0, "value of the body that was saved")
	loaded.free()
	body.soft_body_material = _make({"youngs_modulus": 777.0})
	lines = []
	loaded = _reload(body, lines)
	check_equal(Array(lines).filter(func(line: String) -> bool: return line.begins_with("youngs_modulus") or line.begins_with("stiffness")),
			["youngs_modulus = 777.0"], "values in the scene")
	check_equal(loaded.youngs_modulus, 777.0, "value in use after loading")
	loaded.free()
	body.free()


func test_an_old_scene_with_values_beside_a_shared_material_goes_on_by_the_material_and_says_so() -> void:
	if not is_debug_build():
		return
	var path := "user://old_material.tscn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_scene format=3]\n\n[sub_resource type=\"SoftBodyMaterial2D\" id=\"1\"]\nyoungs_modulus = 777.0\n\n"
			+ "[node name=\"Jelly\" type=\"SoftBody2D\"]\nsoft_body_material = SubResource(\"1\")\nyoungs_modulus = 480.0\npoisson_ratio = 0.25\n")
	file.close()
	var body := (ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene).instantiate() as SoftBody2D
	DirAccess.remove_absolute(path)
	stage.add_child(body)
	check_equal([body.youngs_modulus, body.poisson_ratio], [777.0, 0.45], "values in use")
	var errors := take_errors()
	if _error_log != null and check_equal(errors.size(), 1, "number of warnings: %s" % [errors]):
		check("Jelly" in errors[0] and "'soft_body_material'" in errors[0], "the warning: " + errors[0])
	body.soft_body_material = null
	check_equal(body.youngs_modulus, 300.0, "value of the node itself")


func test_duplicates_have_values_of_their_own() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"youngs_modulus": 480.0, "damping": 0.5})
	var copy := body.duplicate() as SoftBody2D
	stage.add_child(copy)
	copy.youngs_modulus = 500.0
	check_equal([body.youngs_modulus, copy.youngs_modulus, copy.damping], [480.0, 500.0, 0.5], "values of body and copy")
	check(body.get_soft_body_material_in_use() != copy.get_soft_body_material_in_use(), "both have one material")


func test_the_own_material_of_a_node_can_be_asked_for_changed_and_shared() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 60.0})
	var own := body.get_soft_body_material_in_use()
	check_equal([own.stiffness, body.soft_body_material == null], [60.0, true], "stiffness of the node's own material, and whether none is shared")
	own.stiffness = 90.0
	check_equal([body.stiffness, body.get_spring_stiffness(0)], [90.0, 90.0], "stiffness of the body")
	body.stiffness = 110.0
	check_equal(own.stiffness, 110.0, "stiffness of the material")
	check_refused(func() -> void: body.stiffness = -1.0, [String(body.name), "stiffness"], "stiffness = -1")
	check_equal(own.stiffness, 110.0, "stiffness of the material after a refused value")
	var other := add_weightless_body(Vector2(300, 0), {"soft_body_material": own})
	body.stiffness = 130.0
	check_equal(other.get_spring_stiffness(0), 130.0, "stiffness of another body that shares it")
	body.soft_body_material = own
	own.stiffness = 150.0
	check_equal([body.get_spring_stiffness(0), other.get_spring_stiffness(0)], [150.0, 150.0], "stiffness of both")
	check_equal(body.get_soft_body_material_in_use(), own, "material in use")
	body.soft_body_material = null
	check_equal(body.stiffness, 100.0, "stiffness of a node that has given its material away")
	var plain := SoftBody2D.new()
	check_equal(plain.get_soft_body_material_in_use().youngs_modulus, 300.0, "Young's modulus of a node left at its defaults")
	plain.free()


func test_every_value_of_a_material_makes_the_motion_that_the_nodes_own_makes() -> void:
	add_floor(60)
	var plain := {}
	for name: String in FIELDS:
		if name != "density":
			plain[name] = FIELDS[name][0]
	var of_node := plain.duplicate()
	of_node.erase("friction")
	of_node.erase("bounce")
	of_node["physics_material_override"] = surface(plain["friction"], plain["bounce"])
	var own := add_body(Vector2.ZERO, of_node)
	var shared := add_body(Vector2(400, 0), {"soft_body_material": _make(plain)})
	for i in 90:
		await ticks(1)
		var expected := Transform2D(0, Vector2(400, 0)) * own.get_point_positions()
		check_points_near(shared.get_point_positions(), expected, 0.01, "points at tick %d" % i)


func test_values_out_of_range_are_refused_and_nobody_is_told() -> void:
	var material := _make()
	material.resource_name = "Jelly"
	var told: Array[int] = [0]
	material.changed.connect(func() -> void: told[0] += 1)
	for name: String in FIELDS:
		var bad: Array = [-0.5, NAN, INF, 1e300]
		if name == "bounce":
			bad.append(1.5)
		if name == "poisson_ratio":
			bad.append(0.5)
		if name == "youngs_modulus":
			bad.append(0.0)
		for value: float in bad:
			var old: float = material.get(name)
			check_refused(func() -> void: material.set(name, value), ["Jelly", name], "%s = %s" % [name, value])
			check_equal(material.get(name), old, name + " after a refused value")
	check_equal(told[0], 0, "how often the material said that it has changed")
	for name: String in FIELDS:
		material.set(name, FIELDS[name][0])
		material.set(name, FIELDS[name][0])
	check_equal(told[0], FIELDS.size(), "how often it said so for as many changes")


func test_density_makes_the_mass_of_the_area_and_a_scaled_body_heavier() -> void:
	# Two by one meters.
	var polygon := SoftBody2D.make_box_polygon(Vector2(200, 100), 25)
	var material := _make({"density": 3.0, "stiffness": 300.0})
	var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon})
	var usual := body.mass
	body.soft_body_material = material
	check_near(body.get_total_mass(), 6.0, 1e-4, "mass at 3 kg/m²")
	body.apply_central_impulse(Vector2(600, 0))
	check_near(body.linear_velocity, Vector2(100, 0), 0.01, "velocity after an impulse of 600 kg·px/s")
	material.density = 0.0
	check_equal(body.get_total_mass(), usual, "mass at density 0")
	material.density = 1.5
	check_near(body.get_total_mass(), 3.0, 1e-4, "mass at 1.5 kg/m²")
	var large := add_weightless_body(Vector2(900, 0), {"polygon": polygon, "scale": Vector2(2, 2), "soft_body_material": material})
	check_near(large.get_total_mass(), 12.0, 1e-3, "mass of a body of twice the size")
	body.mass = 5
	material.density = 4.0
	check_equal([body.mass, body.get_total_mass()], [5.0, 5.0], "a mass that was set, whatever the density")


func test_the_values_of_a_shared_material_are_shown_at_the_node_but_neither_edited_nor_saved_there() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 60.0})
	var usage := func(name: String) -> int:
		for property in body.get_property_list():
			if property["name"] == name:
				return property["usage"]
		return 0
	var own := FIELDS.keys().filter(func(name: String) -> bool: return not name in ["density", "friction", "bounce"])
	for name: String in own:
		check(not usage.call(name) & PROPERTY_USAGE_READ_ONLY, name + " cannot be edited without a material")
	body.soft_body_material = _make()
	for name: String in own:
		check(usage.call(name) & PROPERTY_USAGE_READ_ONLY, name + " can be edited with a material")
		check(usage.call(name) & PROPERTY_USAGE_EDITOR, name + " is not shown with a material")
		check(not usage.call(name) & PROPERTY_USAGE_STORAGE, name + " is saved with a material")


func test_a_material_is_saved_and_loaded_alone_and_in_a_scene() -> void:
	var values := {}
	for name: String in FIELDS:
		values[name] = FIELDS[name][1]
	var material := _make(values)
	for path: String in ["user://material_test.tres", "user://material_test.res"]:
		check_equal(ResourceSaver.save(material, path), OK, "saving " + path)
		var loaded := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as SoftBodyMaterial2D
		DirAccess.remove_absolute(path)
		for name: String in values:
			check_equal(loaded.get(name), values[name], name + " after loading")
	var root := Node2D.new()
	for i in 2:
		var body := SoftBody2D.new()
		body.soft_body_material = material
		root.add_child(body)
		body.owner = root
	var scene := PackedScene.new()
	scene.pack(root)
	var copy := scene.instantiate()
	var first := copy.get_child(0) as SoftBody2D
	check_equal(first.soft_body_material, (copy.get_child(1) as SoftBody2D).soft_body_material, "the material of both")
	check_equal(first.soft_body_material.stiffness, FIELDS["stiffness"][1], "its stiffness")
	copy.free()
	root.free()


func test_a_material_local_to_scene_belongs_to_one_instance() -> void:
	var material := _make({"stiffness": 200.0})
	material.resource_local_to_scene = true
	var body := SoftBody2D.new()
	body.soft_body_material = material
	var scene := PackedScene.new()
	scene.pack(body)
	body.free()
	var a := scene.instantiate() as SoftBody2D
	var b := scene.instantiate() as SoftBody2D
	stage.add_child(a)
	stage.add_child(b)
	a.soft_body_material.stiffness = 300.0
	check_equal(a.get_spring_stiffness(0), 300.0, "stiffness of the first instance")
	check_equal(b.get_spring_stiffness(0), 200.0, "stiffness of the second instance")


func test_a_duplicate_shares_the_material_unless_it_is_duplicated_too() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"soft_body_material": _make({"stiffness": 200.0})})
	var copy := body.duplicate() as SoftBody2D
	check_equal(copy.soft_body_material, body.soft_body_material, "material of the copy")
	copy.soft_body_material = body.soft_body_material.duplicate() as SoftBodyMaterial2D
	check_equal(copy.soft_body_material.stiffness, 200.0, "stiffness of the duplicated material")
	copy.free()


func test_a_material_that_no_body_can_have_leaves_the_body_as_it_is() -> void:
	var material := _make({"density": 1.0})
	var body := add_weightless_body(Vector2.ZERO, {"soft_body_material": material, "scale": Vector2(2, 2)})
	body.name = "Jelly"
	var mass := body.get_total_mass()
	check_refused(func() -> void: material.density = 3e38, ["Jelly", "soft_body_material"], "a density that overflows")
	check("soft_body_material" in "\n".join(body.get_warnings()), "no warning about the material")
	body.apply_central_impulse(Vector2(mass, 0))
	check_near(body.linear_velocity, Vector2(1, 0), 1e-4, "velocity of the body, which keeps its mass")
	take_errors()
	material.density = 1.0
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after a good value")


func _network(strength: float, properties := {}) -> SoftBody2D:
	var body := add_body(Vector2(0, -447), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK, "rotation": 0.21}.merged(properties))
	body.stiffness *= strength / float(body.get_stability_report(0.1)["strength"])
	return body


## Between the strength at which a network folds under its weight and twice that, a fall decides.
func test_a_network_that_would_stay_folded_after_a_fall_is_warned_of() -> void:
	add_floor(50)
	for strength: float in [1.1, 1.4, 1.7, 2.1]:
		for least_area: float in [0.0, 0.5]:
			var body := _network(strength, {"least_area": least_area})
			var is_warned := " ".join(body.get_warnings()).contains("folded")
			await seconds(6)
			var is_folded := body.get_area() < 0.6 * body.get_rest_area()
			var what := "a network of strength %s with least_area %s" % [strength, least_area]
			check(not is_folded or is_warned, what + " folds without a warning: area %s" % (body.get_area() / body.get_rest_area()))
			check_equal(is_warned, strength < 2 and least_area == 0, "warning of " + what)
			body.free()


## Many points without shape matching, which carry their weight easily: the springs say nothing of small loops.
func test_a_network_that_a_fall_ruins_is_warned_of_with_a_remedy() -> void:
	add_floor(50)
	var body := add_body(Vector2(0, -100), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK, "polygon": SoftBody2D.make_circle_polygon(50, 64), "shape_matching": 0.0})
	var warnings := " ".join(body.get_warnings())
	check("keep its shape" in warnings and "shape_matching of 0.4" in warnings, "warning without shape matching: " + warnings)
	check(body.get_stability_report()["folds_on_fall"], "the report says so")
	await seconds(6)
	check(_crosses_itself(polygon_of(body)), "the outline crosses itself after the fall")
	body.shape_matching = 0.4
	check(not "keep its shape" in " ".join(body.get_warnings()), "warning with it")
	check(not body.get_stability_report()["folds_on_fall"], "the report says so")
	body.shape_matching = 0.0
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_MODES
	check(not "keep its shape" in " ".join(body.get_warnings()), "warning of a material")


func _crosses_itself(polygon: PackedVector2Array) -> bool:
	var count := polygon.size()
	for i in count:
		for j in range(i + 2, count if i > 0 else count - 1):
			if Geometry2D.segment_intersects_segment(polygon[i], polygon[(i + 1) % count], polygon[j], polygon[(j + 1) % count]) != null:
				return true
	return false
