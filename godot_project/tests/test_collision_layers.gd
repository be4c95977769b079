# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Which surroundings a body notices.


func _fell_through(floor_layer: int, mask: int, layer := 1) -> bool:
	var floor_body := add_floor(100)
	floor_body.collision_layer = floor_layer
	var body := add_body(Vector2.ZERO, { "collision_mask": mask, "collision_layer": layer })
	await seconds(2)
	var fell := body.get_center_of_mass_position().y > 200
	body.free()
	floor_body.free()
	await ticks(2)
	return fell


func test_rests_on_a_layer_of_its_mask() -> void:
	check(not await _fell_through(1, 1), "fell through layer 1 with mask 1")
	check(not await _fell_through(2, 2), "fell through layer 2 with mask 2")
	check(not await _fell_through(4, 6), "fell through layer 3 with a mask of layers 2 and 3")
	check(not await _fell_through(1 << 31, 1 << 31), "fell through layer 32 with mask 32")


func test_falls_through_layers_outside_its_mask() -> void:
	check(await _fell_through(2, 1), "rested on layer 2 with mask 1")
	check(await _fell_through(1, 2), "rested on layer 1 with mask 2")
	check(await _fell_through(1, 0), "rested on layer 1 with an empty mask")
	check(await _fell_through(0, 1), "rested on a floor without a layer")


func test_the_own_layer_does_not_decide() -> void:
	check(not await _fell_through(1, 1, 0), "fell through with no layer of its own")


func test_a_body_ignores_one_floor_and_rests_on_the_next() -> void:
	add_floor(100).collision_layer = 2
	add_floor(400)
	var body := add_body()
	await seconds(4)
	check_near(bounds_of(polygon_of(body)).end.y, 400.0, 1, "height of the lowest point")


func test_two_bodies_of_different_masks_see_different_floors() -> void:
	add_floor(100).collision_layer = 2
	add_floor(400).collision_layer = 4
	var upper := add_body(Vector2(-100, 0), { "collision_mask": 2 })
	var lower := add_body(Vector2(100, 0), { "collision_mask": 4 })
	await seconds(4)
	check_near(bounds_of(polygon_of(upper)).end.y, 100.0, 1, "lowest point of the body that sees the upper floor")
	check_near(bounds_of(polygon_of(lower)).end.y, 400.0, 1, "lowest point of the body that sees the lower floor")


func test_a_mask_changed_while_resting_lets_go() -> void:
	add_floor(100)
	var body := add_body()
	await seconds(2)
	body.collision_mask = 2
	await seconds(1)
	check_above(body.get_center_of_mass_position().y, 200, "y after the mask changed")


func test_areas_and_disabled_shapes_are_no_surroundings() -> void:
	var area := Area2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(400, 50)
	area.add_child(collision)
	area.position = Vector2(0, 100)
	stage.add_child(area)
	var solid := add_solid(rectangle(400, 50), Transform2D(0, Vector2(0, 160)))
	(solid.get_child(0) as CollisionShape2D).disabled = true
	var body := add_body()
	await seconds(2)
	check_above(body.get_center_of_mass_position().y, 300, "y of the body")


func test_layers_and_masks_are_set_by_number_as_those_of_other_bodies() -> void:
	var body := add_weightless_body()
	var like := StaticBody2D.new()
	stage.add_child(like)
	for change: Array in [[1, false], [3, true], [32, true], [3, false], [17, true]]:
		for node: Node2D in [body, like]:
			node.call(&"set_collision_layer_value", change[0], change[1])
			node.call(&"set_collision_mask_value", change[0], not change[1])
		check_equal([body.collision_layer, body.collision_mask], [like.collision_layer, like.collision_mask], "bits after %s" % [change])
		for number in range(1, 33):
			check(body.get_collision_layer_value(number) == like.get_collision_layer_value(number)
					and body.get_collision_mask_value(number) == like.get_collision_mask_value(number), "bit %d after %s" % [number, change])
	var before := [body.collision_layer, body.collision_mask]
	for number: int in [0, 33, -1]:
		check_refused(func() -> void: body.set_collision_layer_value(number, true), ["layer", "between 1 and 32"], "layer %d" % number)
		check_refused(func() -> void: body.set_collision_mask_value(number, true), ["mask", "between 1 and 32"], "mask %d" % number)
		check_refused(func() -> void: check_equal(body.get_collision_layer_value(number), false, "value of none"),
				["layer", "between 1 and 32"], "value of layer %d" % number)
	check_equal([body.collision_layer, body.collision_mask], before, "bits after numbers that there are not")
