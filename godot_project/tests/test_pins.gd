# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Points that are held in place, or at another node.


func test_a_pinned_point_stays_and_the_body_hangs_from_it() -> void:
	var body := add_body(Vector2(0, 0), {"pinned_points": PackedInt32Array([12])}) # the top of a circle of 16
	var start := body.get_point_positions()[12]
	await seconds(3)
	check_equal(body.get_point_positions()[12], start, "the pinned point")
	check_above(body.get_center_of_mass_position().y, start.y + 30, "y of the center below its pin")
	check(body.is_point_pinned(12) and not body.is_point_pinned(3), "is_point_pinned tells which")


func test_a_point_follows_the_node_it_is_pinned_to_within_the_tick() -> void:
	var hand := Node2D.new()
	hand.name = "Hand"
	hand.position = Vector2(0, -80)
	stage.add_child(hand)
	var body := add_body(Vector2.ZERO)
	body.set_point_pinned(12, true, body.get_path_to(hand))
	await ticks(1)
	var arm := body.get_point_positions()[12] - hand.position
	for i in 120:
		hand.position = Vector2(100 * sin(i / 20.0), -80 + 40 * cos(i / 15.0))
		await ticks(1)
		check_near(body.get_point_positions()[12], hand.position + arm, 1e-3, "the pinned point beside the hand")
	check_below(body.get_center_of_mass_position().distance_to(hand.position), 250, "distance of the body from the hand")


func test_a_pin_turns_with_its_node() -> void:
	var wheel := Node2D.new()
	stage.add_child(wheel)
	var body := add_weightless_body(Vector2(200, 0))
	body.set_point_pinned(8, true, body.get_path_to(wheel)) # the leftmost point, 150 px from the wheel
	await ticks(1)
	for i in 60:
		wheel.rotation += TAU / 240
		await ticks(1)
	check_near(body.get_point_positions()[8], Vector2(0, 150), 0.01, "the point after a quarter turn")


func test_pins_can_be_taken_off_and_the_body_falls() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([12])})
	await seconds(1)
	body.set_point_pinned(12, false)
	check_equal(body.pinned_points, PackedInt32Array(), "pinned points")
	var before := body.get_center_of_mass_position().y
	await seconds(1)
	check_above(body.get_center_of_mass_position().y, before + 300, "y after a second of fall")


func test_a_pin_whose_node_is_freed_holds_its_place() -> void:
	var hand := Node2D.new()
	hand.position = Vector2(0, -50)
	stage.add_child(hand)
	var body := add_body(Vector2.ZERO)
	body.set_point_pinned(12, true, body.get_path_to(hand))
	await ticks(5)
	hand.free()
	await ticks(1)
	var held := body.get_point_positions()[12]
	await seconds(1)
	check_equal(body.get_point_positions()[12], held, "the point whose node is gone")
	check(" ".join(body.get_warnings()).contains("no Node2D"), "a warning says so: %s" % body.get_warnings())


func test_pins_go_with_the_node_when_it_is_moved() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([12])})
	await ticks(10)
	var before := body.get_point_positions()[12]
	body.position += Vector2(300, 40)
	await ticks(2)
	check_near(body.get_point_positions()[12], before + Vector2(300, 40), 0.01, "the pinned point after the move")


func test_pins_survive_a_new_polygon_a_new_scale_and_leaving_the_tree() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([12])})
	body.scale = Vector2(1.5, 1.5)
	await ticks(2)
	check(body.is_point_pinned(12), "pinned after a change of scale")
	var held := body.get_point_positions()[12]
	await ticks(30)
	check_equal(body.get_point_positions()[12], held, "the point after a change of scale")
	stage.remove_child(body)
	stage.add_child(body)
	await ticks(30)
	check_near(body.get_point_positions()[12], held, 0.01, "the point after leaving and coming back")
	body.polygon = SoftBody2D.make_circle_polygon(30, 16)
	await ticks(1)
	held = body.get_point_positions()[12]
	await ticks(30)
	check_equal(body.get_point_positions()[12], held, "the point of the new polygon")


func test_pins_beyond_the_polygon_are_a_warning_not_an_error() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([2, 40])})
	await ticks(2)
	check(" ".join(body.get_warnings()).contains("Point 40"), "a warning names the point: %s" % body.get_warnings())
	var held := body.get_point_positions()[2]
	await ticks(30)
	check_equal(body.get_point_positions()[2], held, "the point that there is")


func test_bad_pins_are_refused() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([3])})
	check_refused(func() -> void: body.pinned_points = PackedInt32Array([1, -1]), ["pinned_points", "-1", "at least 0"], "a negative index")
	check_refused(func() -> void: body.pinned_points = PackedInt32Array([1, 1]), ["pinned_points", "twice"], "an index twice")
	check_refused(func() -> void: body.set_point_pinned(99, true), ["99", "16"], "an index too large")
	check_equal(body.pinned_points, PackedInt32Array([3]), "pinned points after the refusals")


func test_a_pin_teleported_across_the_scene_leaves_the_body_whole() -> void:
	var hand := Node2D.new()
	stage.add_child(hand)
	var body := add_weightless_body(Vector2(50, 0))
	body.set_point_pinned(8, true, body.get_path_to(hand))
	await ticks(5)
	hand.position = Vector2(5000, -3000)
	await seconds(8) # the springs may fling it about for a while
	take_errors() # it may say that the body was torn
	check(all_finite(body.get_point_positions()), "all points are finite")
	check_near(body.get_point_positions()[8], hand.position, 0.5, "the pinned point")
	# It turns about its pin, stretched by the swing; what is stretched to eight radii is given its rest shape.
	check_below(body.get_center_of_mass_position().distance_to(hand.position), 400, "distance of the body from its pin")
