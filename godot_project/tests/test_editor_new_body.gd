# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The values of new bodies, without an editor.

const NewBody := preload("res://addons/soft_body_2d/editor/logic/new_body.gd")


func test_the_color_of_a_new_body_stands_out_from_any_canvas() -> void:
	var random := RandomNumberGenerator.new()
	random.seed = randi()
	for i in 400:
		var canvas := Color(random.randf(), random.randf(), random.randf())
		var found := NewBody.contrast(canvas, NewBody.color_on(canvas))
		check_above(found, 2.05, "contrast with %s (seed %d)" % [canvas, random.seed])
		if NewBody.luminance(canvas) > 0.5:
			check_above(found, 3.2, "contrast with a light canvas, %s (seed %d)" % [canvas, random.seed])


func test_the_usual_canvas_needs_no_color() -> void:
	var body := SoftBody2D.new()
	check_equal(NewBody.ON_DARK, body.get_color_in_use(), "color of the automatic look")
	check_equal(NewBody.values_of(body, Color(0.3, 0.3, 0.3)).keys(), [&"detail_mode"], "what is set on the usual canvas")
	check_equal(NewBody.values_of(body, Color.WHITE).keys(), [&"detail_mode", &"look", &"color"], "what is set on a white canvas")
	body.free()


func test_only_a_body_of_which_nothing_is_set_is_untouched() -> void:
	var body := SoftBody2D.new()
	check(NewBody.is_untouched(body), "a new body is untouched")
	body.position = Vector2(20, 20)
	check(NewBody.is_untouched(body), "so is one that was moved")
	var properties := ["polygon", SoftBody2D.make_circle_polygon(40, 16), "color", Color.RED, "mass", 3.0, "pinned_points", PackedInt32Array([1]),
			"detail_mode", SoftBody2D.DETAIL_MODE_POINT_COUNT, "collision_mask", 2]
	for i in properties.size() / 2:
		var touched := SoftBody2D.new()
		touched.set(properties[2 * i], properties[2 * i + 1])
		check(not NewBody.is_untouched(touched), "a body whose %s is set is not" % properties[2 * i])
		touched.free()
	body.free()
