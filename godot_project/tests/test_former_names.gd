# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Scenes and scripts of earlier versions name properties as they were called then: their values still count, a warning says
## what the name is now, and saving writes that.

const SQUARE := "PackedVector2Array(-40, -40, 40, -40, 40, 40, -40, 40)"


func _scene_of(lines: String) -> SoftBody2D:
	var path := "user://former.tscn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_scene format=3]\n\n[node name=\"Jelly\" type=\"SoftBody2D\"]\n" + lines + "\n")
	file.close()
	var scene := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return scene.instantiate() as SoftBody2D


func _saved(body: SoftBody2D) -> String:
	var path := "user://former_saved.tscn"
	var scene := PackedScene.new()
	check_equal(scene.pack(body), OK, "packing")
	check_equal(ResourceSaver.save(scene, path), OK, "saving")
	var text := FileAccess.get_file_as_string(path)
	DirAccess.remove_absolute(path)
	return text


# Where the engine has no Logger nothing of this can be seen.
func _check_warned_once(fragments: PackedStringArray, what: String) -> void:
	var errors := take_errors()
	if _error_log == null:
		return
	if check_equal(errors.size(), 1, "number of warnings of %s (%s)" % [what, errors]):
		for fragment in fragments:
			check(fragment in errors[0], "the warning of %s names %s: %s" % [what, fragment, errors[0]])


func test_the_hull_of_an_old_scene_is_the_polygon_and_is_saved_as_such() -> void:
	var body := _scene_of("mass = 2.0\nhull = %s\nyoungs_modulus = 500.0" % SQUARE)
	check_equal(body.polygon, str_to_var(SQUARE), "polygon")
	check_equal([body.mass, body.youngs_modulus], [2.0, 500.0], "what stands beside it")
	stage.add_child(body)
	await ticks(3)
	check_equal(body.get_point_count(), 5, "points of the body")
	_check_warned_once(["Jelly", "'hull'", "'polygon'"], "an old scene")
	var text := _saved(body)
	check("\npolygon = " in text and not "hull" in text, "the scene is saved with the new name: " + text)


func test_an_old_script_or_animation_that_sets_the_hull_sets_the_polygon() -> void:
	var body := add_body()
	for i in 3:
		body.set("hull", str_to_var(SQUARE))
	check_equal(body.polygon, str_to_var(SQUARE), "polygon")
	check_equal(body.get("hull"), body.polygon, "what an old script reads")
	_check_warned_once([String(body.name), "'hull'", "'polygon'"], "an old script")


func test_friction_and_bounce_of_an_old_scene_become_a_physics_material_of_its_own() -> void:
	for values: Array in [[0.75, 0.25], [0.75, 0.0], [0.4, 0.25]]:
		var lines := "youngs_modulus = 500.0"
		if values[0] != 0.4:
			lines += "\nfriction = %s" % values[0]
		if values[1] != 0.0:
			lines += "\nbounce = %s" % values[1]
		var body := _scene_of(lines)
		var material := body.physics_material_override
		if not check(material != null, "there is a physics material for " + lines):
			continue
		check_near(material.friction, values[0], 1e-6, "friction of " + lines)
		check_near(material.bounce, values[1], 1e-6, "bounce of " + lines)
		stage.add_child(body)
		_check_warned_once(["Jelly", "'friction'", "'bounce'", "'physics_material_override'"], lines)
		var text := _saved(body)
		check("[sub_resource type=\"PhysicsMaterial\"" in text and "\nphysics_material_override = " in text,
				"the scene is saved with the material: " + text)
		body.free()


func test_old_values_change_no_material_that_others_share() -> void:
	var shared := surface(0.5)
	var body := add_body(Vector2.ZERO, {"physics_material_override": shared})
	body.set("friction", 0.75)
	body.set("friction", 0.25)
	check_near(shared.friction, 0.5, 1e-6, "friction of the shared material")
	check_near(body.get("friction"), 0.25, 1e-6, "what an old script reads")
	_check_warned_once([String(body.name), "'physics_material_override'"], "an old script")
	for bad: Variant in [-1.0, NAN, "text"]:
		body.set("friction", bad)
		check_near(body.physics_material_override.friction, 0.25, 1e-6, "friction after %s" % bad)
		check("friction" in "".join(take_errors()) or _error_log == null or bad is String, "%s is refused by name" % bad)


func test_old_values_beside_a_shared_material_go_on_without_effect() -> void:
	var path := "user://former_material.tres"
	var material := SoftBodyMaterial2D.new()
	material.friction = 0.125
	ResourceSaver.save(material, path)
	var body := add_body(Vector2.ZERO, {"soft_body_material": material})
	DirAccess.remove_absolute(path)
	body.set("friction", 0.75)
	check_equal(body.physics_material_override, null, "physics material")
	check_equal(body.get("friction"), 0.125, "friction in use")
	_check_warned_once(["'soft_body_material'"], "a value that did not count")


func test_the_shape_damping_of_an_old_scene_or_material_is_its_damping_ratio() -> void:
	var body := _scene_of("stiffness = 200.0\nshape_damping = 0.75")
	check_equal(body.shape_damping_ratio, 0.75, "shape damping ratio")
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_NETWORK, "model")
	stage.add_child(body)
	_check_warned_once(["Jelly", "'shape_damping'", "'shape_damping_ratio'"], "an old scene")
	var path := "user://former_material.tres"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_resource type=\"SoftBodyMaterial2D\" format=3]\n\n[resource]\nstiffness = 200.0\nshape_damping = 0.75\n")
	file.close()
	var material := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as SoftBodyMaterial2D
	check_equal(material.shape_damping_ratio, 0.75, "shape damping ratio of the material")
	_check_warned_once(["'shape_damping'", "'shape_damping_ratio'"], "an old material")
	ResourceSaver.save(material, path)
	check("\nshape_damping_ratio = 0.75" in FileAccess.get_file_as_string(path), "the material is saved with the new name")
	DirAccess.remove_absolute(path)


func test_an_old_hull_of_a_wrong_type_or_shape_is_refused_as_the_polygon_is() -> void:
	for damage: String in ["12", "PackedVector2Array(0, 0, 10, 0)"]:
		var body := _scene_of("hull = " + damage)
		check_equal(body.polygon.size(), 16, "points of the polygon beside hull = " + damage)
		stage.add_child(body)
		var errors := take_errors()
		if _error_log != null:
			check("polygon" in " ".join(errors), "nothing is said of hull = %s: %s" % [damage, errors])
		body.free()
