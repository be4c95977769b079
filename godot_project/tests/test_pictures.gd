# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What docs/accuracy.md says of its pictures of the default body, before and now, is what happens in them.

const BEFORE := 0
const NOW := 1

var _scene: Node2D


func _open(name: String) -> void:
	# Pictures are made with the damping of a new project.
	set_default_damp(0.1, 1)
	_scene = (load("res://pictures/%s.tscn" % name) as PackedScene).instantiate()
	stage.add_child(_scene)


func _bodies(side: int) -> Array:
	return _scene.get(&"bodies")[side]


func _size(side: int) -> Vector2:
	return _scene.call(&"size_of", _bodies(side)[0])


func _area(side: int) -> float:
	return _scene.call(&"area_of", _bodies(side)[0])


func _folded(side: int) -> int:
	return _bodies(side).filter(func(body: SoftBody2D) -> bool: return _scene.call(&"is_folded", body)).size()


func test_both_sides_are_what_their_titles_say() -> void:
	_open("drop")
	await ticks(1)
	var before: SoftBody2D = _bodies(BEFORE)[0]
	var now: SoftBody2D = _bodies(NOW)[0]
	check_equal(before.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_NETWORK, "model of before")
	check_equal(now.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model of now")
	var fresh := SoftBody2D.new()
	for property: String in ["youngs_modulus", "poisson_ratio", "damping_ratio", "least_area", "least_stretch", "most_stretch",
			"mass", "physics_material_override", "gravity_scale", "elastic_model", "polygon"]:
		check_equal(now.get(property), fresh.get(property), property + " of now")
	fresh.free()


func test_the_material_bulges_where_the_springs_lose_area() -> void:
	_open("drop")
	await seconds(5)
	var sizes: Array = _scene.get(&"squashed_size")
	var areas: Array = _scene.get(&"squashed_area")
	check_near(sizes[BEFORE] as Vector2, Vector2(0.98, 0.66), 0.03, "squashed size of before")
	check_near(areas[BEFORE], 0.70, 0.02, "squashed area of before")
	check_near(sizes[NOW] as Vector2, Vector2(1.28, 0.71), 0.03, "squashed size of now")
	check_near(areas[NOW], 0.96, 0.02, "squashed area of now")
	for side in 2:
		check_near(_size(side).y, 0.95, 0.01, "height at rest of side %d" % side)
	check_near(_area(BEFORE), 0.98, 0.01, "area at rest of before")
	check_near(_area(NOW), 0.99, 0.01, "area at rest of now")


func test_pressed_to_half_the_material_gets_wider() -> void:
	_open("press")
	await seconds(3.5)
	for side in 2:
		check_near(_size(side).y, 0.5, 0.01, "height of side %d" % side)
	check_near(_size(BEFORE).x, 1.01, 0.01, "width of before")
	check_near(_area(BEFORE), 0.63, 0.01, "area of before")
	check_near(_size(NOW).x, 1.46, 0.01, "width of now")
	check_near(_area(NOW), 0.89, 0.01, "area of now")
	await seconds(2.4)
	check_near(_size(NOW), Vector2.ONE, 0.01, "size of now, let go")


func test_the_heap_of_springs_folds_and_the_heap_of_material_stands() -> void:
	_open("heap")
	await seconds(6)
	check_above(_folded(BEFORE), 95, "folded bodies of before")
	check_equal(_folded(NOW), 0, "folded bodies of now")
	for body: SoftBody2D in _bodies(NOW):
		check_above(body.get_area() / body.get_rest_area(), 0.75, "area of a body of now")
