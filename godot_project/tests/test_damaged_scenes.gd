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
	var body := _scene_of("stiffness = 77.0\nsome_future_property = Vector3(1, 2, 3)\npoisson_ratio = 0.25")
	if not check(body != null, "the scene opens"):
		return
	check_equal(body.stiffness, 77.0, "stiffness")
	check_equal(body.poisson_ratio, 0.25, "poisson_ratio")
	stage.add_child(body)
	await ticks(5)
	_check_sound(body, "the body of the newer scene")


## All arrays that are stored of a body; of those whose length must fit the rest, one that does not.
const ARRAYS := {
	"polygon": 2, "inner_points": -1, "springs": 3, "spring_stiffness_scales": 3, "spring_damping_scales": 3,
	"spring_length_scales": 3, "pinned_points": -1, "pin_targets": 3, "vertex_colors": 3, "uv": 3, "dents": 3, "cut_edges": -1, "detail_weights": 3, "holes": 2,
}


# The array as text: `count` entries, of which one in the middle is `odd`.
func _text_of(type: int, count: int, odd := "1") -> String:
	var width: int = {TYPE_PACKED_VECTOR2_ARRAY: 2, TYPE_PACKED_COLOR_ARRAY: 4}.get(type, 1)
	var numbers := PackedStringArray()
	for i in count * width:
		numbers.append(odd if i == count * width / 2 else str(i % 7))
	if type == TYPE_ARRAY:
		return "Array[NodePath]([NodePath(\"%s\")])" % "\"), NodePath(\"".join(numbers)
	return type_string(type) + "(" + ", ".join(numbers) + ")"


# What is wrong is said at once, or, if it may still be put right by another property, as a warning of the node.
func _check_damage(line: String, name: String) -> void:
	take_errors()
	var body := _scene_of("stiffness = 77.0\n" + line + "\npoisson_ratio = 0.25")
	if not check(body != null, "the scene with %s opens" % line.left(80)):
		return
	stage.add_child(body)
	await ticks(3)
	check_equal(body.stiffness, 77.0, "stiffness beside " + line.left(80))
	check_equal(body.poisson_ratio, 0.25, "poisson_ratio beside " + line.left(80))
	_check_sound(body, "the body with " + line.left(80))
	var said := " ".join(take_errors()) + " ".join(body.get_warnings())
	# A pixel or a color that is huge harms nothing.
	var harmless: bool = name in ["uv", "vertex_colors"] and "e3" in line and not body.get(name).is_empty()
	check(harmless or name in said, "nothing is said of %s: %s" % [line.left(80), said.left(300)])
	body.free()


func test_every_array_may_be_of_a_wrong_length_or_hold_what_is_no_number_or_huge() -> void:
	var plain := SoftBody2D.new()
	for property in plain.get_property_list():
		if property["usage"] & PROPERTY_USAGE_STORAGE and typeof(plain.get(property["name"])) >= TYPE_ARRAY:
			check(ARRAYS.has(property["name"]), "the array %s is not tried" % property["name"])
	for name: String in ARRAYS:
		var type := typeof(plain.get(name))
		var is_nested := name == "holes" # one hole of so many points
		if is_nested:
			type = TYPE_PACKED_VECTOR2_ARRAY
		var damages := [_text_of(type, 40000)]
		if ARRAYS[name] > 0:
			damages.append(_text_of(type, ARRAYS[name]))
		if type in [TYPE_PACKED_VECTOR2_ARRAY, TYPE_PACKED_FLOAT32_ARRAY, TYPE_PACKED_COLOR_ARRAY]:
			for odd: String in ["nan", "inf", "inf_neg", "-1e30", "1e38"]:
				damages.append(_text_of(type, 16, odd))
		elif type == TYPE_PACKED_INT32_ARRAY:
			for odd: String in ["-1", "2147483647", "-2147483648"]:
				damages.append(_text_of(type, 8, odd))
		for damage: String in damages:
			await _check_damage("%s = %s" % [name, "Array[PackedVector2Array]([%s])" % damage if is_nested else damage], name)
	plain.free()


func test_a_value_of_a_wrong_type_is_named() -> void:
	for name: String in ARRAYS:
		for damage: String in ["\"text\"", "Vector2(1, 2)", "12", "{}"]:
			await _check_damage("%s = %s" % [name, damage], name)


func test_damaged_arrays_in_a_scene_are_named_and_the_rest_is_kept() -> void:
	var damages := {
		"polygon = PackedVector2Array(0, 0, nan, 5, 10, 10, 0, 10)": "polygon",
		"polygon = PackedVector2Array(0, 0, 10, 0)": "polygon",
		"polygon = PackedVector2Array(0, 0, 10, 10, 10, 0, 0, 10)": "polygon",
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
		var body := _scene_of("color = Color(1, 0, 0, 1)\n" + line + "\npoisson_ratio = 0.25")
		if not check(body != null, "the scene with %s opens" % line):
			continue
		stage.add_child(body)
		await ticks(3)
		check_equal(body.poisson_ratio, 0.25, "poisson_ratio beside " + line)
		check_equal(body.polygon.size(), 16, "polygon points beside " + line)
		_check_sound(body, "the body with " + line)
		var errors := take_errors()
		check(not errors.is_empty() and damages[line] in errors[0], "the message for %s names it: %s" % [line, errors])
		body.free()


func test_arrays_that_name_what_is_not_there_are_left_out_with_a_word() -> void:
	var damages := ["springs = PackedInt32Array(0, 400)", "spring_stiffness_scales = PackedFloat32Array(1, 2)",
			"pinned_points = PackedInt32Array(99)", "uv = PackedVector2Array(0, 0)"]
	for line: String in damages:
		take_errors()
		var body := _scene_of(line + "\npoisson_ratio = 0.25")
		stage.add_child(body)
		await ticks(3)
		check_equal(body.poisson_ratio, 0.25, "poisson_ratio beside " + line)
		_check_sound(body, "the body with " + line)
		check(not body.get_warnings().is_empty(), "nothing is said of " + line)
		take_errors()
		body.free()
