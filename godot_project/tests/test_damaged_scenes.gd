# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Scenes that a newer version saved, or that something has damaged: they open, say what was wrong, and keep the rest.


func time_limit() -> int:
	return 8000


func _check_sound(body: SoftBody2D, what: String) -> void:
	check(all_finite(body.get_point_positions()), "%s has a point that is not finite" % what)


func _scene_of(lines: String) -> SoftBody2D:
	var path := "user://abused.tscn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_scene format=3]\n\n[node name=\"Jelly\" type=\"SoftBody2D\"]\n" + lines + "\n")
	file.close()
	var scene := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return null if scene == null else scene.instantiate() as SoftBody2D


func test_a_scene_of_a_newer_version_opens_with_what_is_known() -> void:
	var body := _scene_of("stiffness = 77.0\nsome_future_property = Vector3(1, 2, 3)\nfriction = 0.25")
	if not check(body != null, "the scene opens"):
		return
	check_equal(body.stiffness, 77.0, "stiffness")
	check_equal(body.friction, 0.25, "friction")
	stage.add_child(body)
	await ticks(5)
	_check_sound(body, "the body of the newer scene")


func test_damaged_arrays_in_a_scene_are_named_and_the_rest_is_kept() -> void:
	var damages := {
		"hull = PackedVector2Array(0, 0, nan, 5, 10, 10, 0, 10)": "hull",
		"hull = PackedVector2Array(0, 0, 10, 0)": "hull",
		"hull = PackedVector2Array(0, 0, 10, 10, 10, 0, 0, 10)": "hull",
		"inner_points = PackedVector2Array(inf, 0)": "inner_points",
		"springs = PackedInt32Array(0, 1, 2)": "springs",
		"springs = PackedInt32Array(0, -1)": "springs",
		"spring_stiffness_scales = PackedFloat32Array(-1, 1)": "spring_stiffness_scales",
		"pinned_points = PackedInt32Array(-2)": "pinned_points",
		"stiffness = nan": "stiffness",
		"mass = -1.0": "mass",
	}
	for line: String in damages:
		take_errors()
		var body := _scene_of("color = Color(1, 0, 0, 1)\n" + line + "\nfriction = 0.25")
		if not check(body != null, "the scene with %s opens" % line):
			continue
		stage.add_child(body)
		await ticks(3)
		check_equal(body.friction, 0.25, "friction beside " + line)
		check_equal(body.hull.size(), 16, "hull points beside " + line)
		_check_sound(body, "the body with " + line)
		var errors := take_errors()
		check(not errors.is_empty() and damages[line] in errors[0], "the message for %s names it: %s" % [line, errors])
		body.free()


func test_arrays_that_name_what_is_not_there_are_left_out_with_a_word() -> void:
	var damages := ["springs = PackedInt32Array(0, 400)", "spring_stiffness_scales = PackedFloat32Array(1, 2)",
			"pinned_points = PackedInt32Array(99)", "uv = PackedVector2Array(0, 0)"]
	for line: String in damages:
		take_errors()
		var body := _scene_of(line + "\nfriction = 0.25")
		stage.add_child(body)
		await ticks(3)
		check_equal(body.friction, 0.25, "friction beside " + line)
		_check_sound(body, "the body with " + line)
		check(not body.get_warnings().is_empty(), "nothing is said of " + line)
		take_errors()
		body.free()
