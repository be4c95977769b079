# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Soft bodies meet one another: they stack, part, mind their layers, and sleep until something happens.


func test_one_body_rests_on_another() -> void:
	add_floor(100)
	var box := SoftBody2D.make_box_polygon(Vector2(100, 60), 25)
	var lower := add_body(Vector2(0, 60), { "polygon": box, "stiffness": 300.0 })
	var upper := add_body(Vector2(0, -20), { "polygon": box, "stiffness": 300.0 })
	await seconds(4)
	check_above(upper.get_center_of_mass_position().y, -60, "the upper body has not flown off")
	check_below(upper.get_center_of_mass_position().y, lower.get_center_of_mass_position().y - 45, "it lies on the lower one")
	for point in polygon_of(upper):
		check(not Geometry2D.is_point_in_polygon(point + Vector2(0, -2), polygon_of(lower)), "%s is inside the lower body" % point)
	check_above(lower.get_area() / lower.get_rest_area(), 0.8, "area of the lower body over its rest area")


func test_bodies_of_layers_that_do_not_meet_pass_through_each_other() -> void:
	for meets: bool in [false, true]:
		var left := add_weightless_body(Vector2(-100, 0), { "collision_layer": 2, "collision_mask": 4 if meets else 8 })
		var right := add_weightless_body(Vector2(100, 0), { "collision_layer": 4, "collision_mask": 8 })
		left.apply_central_impulse(Vector2(400, 0))
		await seconds(1)
		check_equal(left.get_center_of_mass_position().x < right.get_center_of_mass_position().x, meets,
				"the left one stays to the left with masks that meet: %s" % meets)
		left.free()
		right.free()


func test_a_body_that_sleeps_wakes_when_its_floor_goes() -> void:
	var ground := add_floor(100)
	var body := add_body(Vector2(0, 40), { "stiffness": 300.0 })
	await seconds(6)
	var rest := body.get_center_of_mass_position()
	await ticks(30)
	check_equal(body.get_center_of_mass_position(), rest, "place of the sleeping body")
	ground.free()
	await seconds(0.5)
	check_above(body.get_center_of_mass_position().y, rest.y + 50, "place half a second after the floor went")
