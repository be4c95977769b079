# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A body's state can be kept as bytes and put back, and goes on in the same bits.


func _course(bodies: Array[SoftBody2D], count: int) -> Array:
	var course: Array = []
	for i in count:
		await ticks(1)
		for body in bodies:
			course.append([body.get_point_positions(), body.get_point_velocities(), body.global_transform, body.sleeping])
	return course


func test_a_scene_put_back_goes_on_in_the_same_bits() -> void:
	add_floor(100)
	var bodies: Array[SoftBody2D] = []
	for i in 3:
		bodies.append(add_body(Vector2(15 * i, -110 * i), {"stiffness": 150.0, "physics_material_override": surface(0.4, 0.25)}))
	bodies[2].angular_velocity = 3.0
	await ticks(25)
	bodies[1].apply_central_force(Vector2(900, 0)) # queued: part of the state
	bodies[2].rotation += 0.3 # turned, not measured anew
	var states: Array[PackedByteArray] = []
	for body in bodies:
		states.append(body.get_state())
	var expected: Array = await _course(bodies, 60)
	check_above(expected[0][0][0].distance_to(expected[177][0][0]), 5, "way of a point meanwhile")
	for round_number in 2:
		for i in 3:
			check_equal(bodies[i].set_state(states[i]), OK, "putting the state back")
			check_equal(bodies[i].get_state(), states[i], "the state once more")
		var course: Array = await _course(bodies, 60)
		check(course == expected, "the course differs after the states were put back")


func test_a_sleeping_body_is_put_back_asleep() -> void:
	add_floor(50)
	var body := add_body()
	await seconds(6)
	check(body.sleeping, "it does not sleep")
	var state := body.get_state()
	var points := body.get_point_positions()
	body.global_position += Vector2(200, -300)
	await seconds(1)
	var told: Array[int] = [0]
	body.set_state(state)
	check_equal(body.get_point_positions(), points, "points")
	check(body.sleeping, "it is awake")
	body.sleeping_state_changed.connect(func() -> void: told[0] += 1)
	await ticks(10)
	check(body.sleeping, "it wakes")
	check_equal(told[0], 0, "signals about it")
	check_equal(body.get_point_positions(), points, "points later")


func test_pins_and_freezing_are_part_of_the_state() -> void:
	var body := add_body()
	body.set_point_pinned(12, true)
	await ticks(3)
	var pinned := body.get_state()
	body.set_point_pinned(12, false)
	body.freeze = true
	var frozen := body.get_state()
	body.set_state(pinned)
	check_equal(body.pinned_points, PackedInt32Array([12]), "pinned points")
	check(not body.freeze, "it is still frozen")
	body.set_state(frozen)
	check_equal(body.pinned_points, PackedInt32Array(), "pinned points of the frozen state")
	check(body.freeze, "it is not frozen")
	await ticks(3)


func test_bytes_that_are_no_state_of_it_change_nothing() -> void:
	var body := add_weightless_body()
	body.name = "Jelly"
	body.linear_velocity = Vector2(30, 0)
	await ticks(3)
	var state := body.get_state()
	var damaged := state.duplicate()
	damaged[40] = damaged[40] ^ 1
	var other := add_weightless_body(Vector2(500, 0), {"polygon": SoftBody2D.make_circle_polygon(40, 12)})
	for bad: PackedByteArray in [PackedByteArray(), damaged, state.slice(0, 60), other.get_state()]:
		var result: Array[int] = [OK]
		check_refused(func() -> void: result[0] = body.set_state(bad), ["Jelly", "state refused"], "%d bytes" % bad.size())
		check_equal(result[0], ERR_INVALID_DATA, "what it returns for %d bytes" % bad.size())
	check_equal(body.get_state(), state, "the state after that")
	var lost := SoftBody2D.new()
	check_refused(func() -> void: lost.get_state(), ["has no body yet"], "the state of a node outside the tree")
	lost.free()
