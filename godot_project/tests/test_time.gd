# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Tick rates, time scale, pause and worlds of their own change what they should, and nothing else.

const RADIUS := 50.0


## Places of the points relative to the center after a second of wobble, started by a dent.
func _wobble(ticks_per_second: int, time_scale := 1.0) -> PackedVector2Array:
	Engine.physics_ticks_per_second = ticks_per_second
	Engine.time_scale = time_scale
	await ticks(2)
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 100.0})
	var velocities := body.get_point_velocities()
	for i in 16:
		velocities[i] = Vector2(1, 0) * cos(TAU * 2 * i / 16.0) * 400
	body.set_point_velocities(velocities)
	await ticks(roundi(ticks_per_second / time_scale))
	var center := body.get_center_of_mass_position()
	var places := PackedVector2Array()
	for point in body.get_point_positions():
		places.append(point - center)
	body.free()
	Engine.physics_ticks_per_second = 60
	Engine.time_scale = 1
	await ticks(2)
	return places


## How far the points are from the rest shape when the dent is deepest.
func _wobble_size() -> float:
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 100.0})
	var velocities := body.get_point_velocities()
	for i in 16:
		velocities[i] = Vector2(1, 0) * cos(TAU * 2 * i / 16.0) * 400
	body.set_point_velocities(velocities)
	var largest := 0.0
	for i in 60:
		await ticks(1)
		largest = maxf(largest, largest_distance(polygon_of(body), SoftBody2D.make_circle_polygon(50, 16)))
	body.free()
	return largest


func test_a_second_of_wobble_is_the_same_at_any_tick_rate() -> void:
	var reference: PackedVector2Array = await _wobble(240)
	for rate: int in [30, 60, 120]:
		var places: PackedVector2Array = await _wobble(rate)
		check_below(largest_distance(places, reference) / RADIUS, 0.02, "difference between %d and 240 ticks, in radii" % rate)
	var size: float = await _wobble_size()
	check_above(size / RADIUS, 0.1, "the wobble itself, in radii")


func test_a_fall_is_the_same_at_any_tick_rate() -> void:
	for rate: int in [30, 60, 120, 240]:
		Engine.physics_ticks_per_second = rate
		await ticks(2)
		var body := add_body()
		await ticks(rate)
		check_near(body.linear_velocity.y, GRAVITY, 1, "velocity after a second at %d ticks" % rate)
		check_near(body.global_position.y, GRAVITY / 2, GRAVITY / rate, "way after a second at %d ticks" % rate)
		body.free()


func test_landing_rests_at_any_tick_rate() -> void:
	for rate: int in [30, 120, 240]:
		Engine.physics_ticks_per_second = rate
		await ticks(2)
		var ground := add_floor(100)
		var body := add_body()
		await seconds(6)
		check_below(body.get_penetration(), 1, "penetration at %d ticks" % rate)
		check_below(body.linear_velocity.length(), 2, "speed at %d ticks" % rate)
		check_near(bounds_of(polygon_of(body)).end.y, 100.0, 1, "lowest point at %d ticks" % rate)
		body.free()
		ground.free()


func test_half_the_time_scale_is_half_the_speed() -> void:
	var body := add_body()
	Engine.time_scale = 0.5
	await ticks(60)
	check_near(body.linear_velocity.y, GRAVITY / 2, 20, "velocity after 60 ticks of half a second")
	check_near(body.global_position.y, GRAVITY / 8, 12, "way after 60 ticks of half a second")


func test_wobble_at_another_time_scale_is_the_same_wobble() -> void:
	var reference: PackedVector2Array = await _wobble(60)
	for time_scale: float in [0.5, 2.0]:
		var places: PackedVector2Array = await _wobble(60, time_scale)
		check_below(largest_distance(places, reference) / RADIUS, 0.02, "difference at time scale %s, in radii" % time_scale)


func test_no_time_moves_nothing_and_goes_on() -> void:
	var body := add_body()
	await ticks(10)
	var points := body.get_point_positions()
	Engine.time_scale = 0
	await ticks(20)
	check_points_near(body.get_point_positions(), points, 17, "points at time scale 0 and before") # one tick may still come
	var stopped := body.get_point_positions()
	await ticks(20)
	check_equal(body.get_point_positions(), stopped, "points later")
	body.apply_central_impulse(Vector2(60, 0))
	Engine.time_scale = 1
	await ticks(10)
	check_near(body.linear_velocity.x, 60.0, 0.1, "velocity of the push while time stood still")


func test_worlds_of_their_own_do_not_touch() -> void:
	add_floor(100)
	var here := add_body(Vector2.ZERO, {"stiffness": 150.0})
	var viewports: Array[SubViewport] = []
	var there: Array[SoftBody2D] = []
	for i in 2:
		var viewport := SubViewport.new()
		viewport.world_2d = World2D.new()
		stage.add_child(viewport)
		viewports.append(viewport)
		var body := SoftBody2D.new()
		body.stiffness = 150
		viewport.add_child(body)
		there.append(body)
		if i == 0:
			add_floor(300, viewport)
	await seconds(4)
	check_near(bounds_of(polygon_of(here)).end.y, 100.0, 1, "lowest point in the main world")
	check_near(bounds_of(polygon_of(there[0])).end.y, 300.0, 1, "lowest point in a world with a floor of its own")
	check_above(there[1].global_position.y, 1000, "y in a world without a floor")
	here.reparent(viewports[0])
	here.global_position = Vector2(300, 200)
	await seconds(3)
	check_near(bounds_of(polygon_of(here)).end.y, 300.0, 1, "lowest point after it changed worlds")
	viewports[0].free()
	check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies after a world has gone")
	await ticks(5)


func test_a_world_may_be_given_to_a_viewport_with_bodies_in_it() -> void:
	var viewport := SubViewport.new()
	viewport.world_2d = World2D.new()
	stage.add_child(viewport)
	var body := SoftBody2D.new()
	viewport.add_child(body)
	await ticks(10)
	var velocity := body.linear_velocity
	viewport.world_2d = World2D.new()
	await ticks(10)
	check_near(body.linear_velocity, velocity + Vector2(0, GRAVITY / 6), GRAVITY / 30, "velocity after the change")
	check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies of the simulation")


func test_bodies_freed_in_any_callback_leave_the_others_alone() -> void:
	add_floor(100)
	var keeper := add_body(Vector2(-300, 0), {"stiffness": 150.0})
	for moment: String in ["_physics_process", "_process", "_draw", "_exit_tree"]:
		var script := GDScript.new()
		var parameters := "_delta: float" if "process" in moment else ""
		script.source_code = "extends SoftBody2D\nvar ticks := 0\nfunc %s(%s) -> void:\n\tticks += 1\n\tif ticks == 3 or %s:\n\t\tfor other in get_tree().get_nodes_in_group(&\"doomed\"):\n\t\t\tif other != self: other.queue_free()\n\t\tqueue_free()\n" % [
				moment, parameters, "true" if moment == "_exit_tree" else "false"]
		check_equal(script.reload(), OK, "loading the script")
		var bodies: Array[SoftBody2D] = []
		for i in 3:
			var body: SoftBody2D = script.new() if i == 1 else SoftBody2D.new()
			body.position = Vector2(200 * i, -100)
			body.add_to_group(&"doomed")
			stage.add_child(body)
			bodies.append(body)
		if moment == "_exit_tree":
			await ticks(2)
			bodies[1].queue_free()
		elif moment == "_draw":
			for i in 6:
				if is_instance_valid(bodies[1]):
					bodies[1].queue_redraw()
				await tree.process_frame
			for body in bodies: # nothing is drawn without a window
				if is_instance_valid(body):
					body.queue_free()
		await ticks(12)
		check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies after %s freed three" % moment)
	check(all_finite(keeper.get_point_positions()), "a point of the body that stayed is not finite")
