# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A node at rest is left out of a tick, and comes back whenever something concerns it.


## Nodes that a tick goes through, over some ticks.
func _nodes_a_tick(count := 8) -> float:
	SoftBodySimulation2D.reset_statistics()
	await ticks(count)
	return SoftBodySimulation2D.get_step_profile().nodes


## Sleeping bodies side by side in the air, which nothing has woken yet.
func _add_sleepers(count: int, properties := {}) -> Array[SoftBody2D]:
	var bodies: Array[SoftBody2D] = []
	for i in count:
		bodies.append(add_body(Vector2(150.0 * (i % 40), -150.0 * floorf(i / 40.0)), properties.merged({ "sleeping": true })))
	return bodies


func test_nodes_at_rest_are_left_out() -> void:
	var bodies := _add_sleepers(12)
	for i in 4:
		bodies[i].sleeping = false
		bodies[i].freeze = true
		bodies[4 + i].process_mode = Node.PROCESS_MODE_DISABLED
	check_above(await _nodes_a_tick(1), 11, "nodes in the first tick")
	await ticks(10)
	check_equal(await _nodes_a_tick(), 0.0, "nodes a tick: 4 frozen, 4 disabled, 4 asleep")
	bodies[8].apply_central_impulse(Vector2(10, 0))
	check_equal(await _nodes_a_tick(), 1.0, "nodes a tick after one was pushed")


func test_a_body_that_has_come_to_rest_is_left_out() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -60))
	check_equal(await _nodes_a_tick(), 1.0, "nodes a tick while it falls")
	for i in 600:
		await ticks(1)
		if body.sleeping:
			break
	check(body.sleeping, "it sleeps within ten seconds")
	await ticks(8)
	check_equal(await _nodes_a_tick(), 0.0, "nodes a tick when it sleeps")


func test_what_must_be_asked_every_tick_is_not_left_out() -> void:
	var target := Node2D.new()
	stage.add_child(target)
	var pinned := _add_sleepers(1)[0]
	pinned.set_point_pinned(0, true, pinned.get_path_to(target))
	await ticks(10)
	check_equal(await _nodes_a_tick(), 1.0, "nodes a tick with a pin on another node")
	var before := pinned.get_point_positions()[0]
	target.position += Vector2(30, 0)
	await ticks(2)
	check_near(pinned.get_point_positions()[0], before + Vector2(30, 0), 0.01, "the pinned point when its node has moved")


func test_a_parent_moves_bodies_at_rest() -> void:
	var parent := Node2D.new()
	stage.add_child(parent)
	var bodies := _add_sleepers(3)
	for body in bodies:
		body.freeze = true
		body.reparent(parent)
	await ticks(20)
	check_equal(await _nodes_a_tick(), 0.0, "nodes a tick")
	for i in 5:
		parent.position.x += 7
		await ticks(1)
	for i in 3:
		check_near(bodies[i].get_center_of_mass_position(), Vector2(150.0 * i + 35, 0), 0.1, "center of a body that its parent moved")


## An area around all of them, which changes nothing yet.
func _add_large_area() -> Area2D:
	var area := Area2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(20000, 20000)
	area.add_child(collision)
	area.gravity_direction = Vector2.RIGHT
	stage.add_child(area)
	return area


## Both ways: what holds while they rest, and what changes.
func test_areas_wake_all_bodies_at_rest() -> void:
	var area := _add_large_area()
	var bodies := _add_sleepers(200)
	await ticks(60)
	check_equal(await _nodes_a_tick(), 0.0, "nodes a tick in an area that changes nothing")
	area.gravity_space_override = Area2D.SPACE_OVERRIDE_REPLACE
	await ticks(40)
	var awake := 0
	for body in bodies:
		awake += 0 if body.sleeping else 1
	check_equal(awake, 200, "bodies awake 40 ticks after the area's gravity was switched on")


## By turns of 64 a tick it would take them 24 ticks.
func test_a_change_that_one_body_finds_hurries_the_others_once() -> void:
	var area := _add_large_area()
	var bodies := _add_sleepers(1500)
	await ticks(60)
	area.gravity_space_override = Area2D.SPACE_OVERRIDE_REPLACE
	await ticks(12)
	var asleep := bodies.filter(func(body: SoftBody2D) -> bool: return body.sleeping)
	check_equal(asleep.size(), 0, "bodies asleep 12 ticks after the area's gravity was switched on")
	for body in bodies:
		body.sleeping = true
	await ticks(8)
	var asked := 0
	for i in 16:
		await ticks(1)
		asked += 0 if PhysicsServer2D.body_get_state(bodies[0].get_rid(), PhysicsServer2D.BODY_STATE_SLEEPING) else 1
	check_below(asked, 2, "ticks of 16 in which a body was asked about areas when nothing changes anymore")


## In the core alone: nobody has told the node.
func test_a_node_at_rest_goes_along_when_another_body_pushes_it() -> void:
	var sleeper := add_weightless_body(Vector2.ZERO, { "sleeping": true })
	await ticks(10)
	var pusher := add_weightless_body(Vector2(-150, 0))
	pusher.apply_central_impulse(Vector2(600, 0) * pusher.mass)
	await ticks(60)
	check_above(sleeper.global_position.x, 20, "x of the node that was hit")
	check_near(sleeper.global_position, sleeper.get_center_of_mass_position(), 5, "place of the node, whose body is there")


func test_a_listener_may_free_a_body_whose_signal_is_still_to_come() -> void:
	var bodies := _add_sleepers(2)
	await ticks(10)
	var told: Array[int] = [0]
	for i in 2:
		var other := bodies[1 - i]
		bodies[i].sleeping_state_changed.connect(func() -> void:
			told[0] += 1
			other.free())
	for body in bodies: # both wake in one tick
		body.apply_central_impulse(Vector2(10, 0))
	await ticks(3)
	check_equal(told[0], 1, "signals, as the first listener has freed the other body")
	check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies of the simulation")


func test_a_pause_brings_no_body_at_rest_back_for_long() -> void:
	var bodies := _add_sleepers(5)
	await ticks(10)
	tree.paused = true
	await ticks(5)
	tree.paused = false
	await ticks(5)
	check_equal(await _nodes_a_tick(), 0.0, "nodes a tick after a pause")
	for body in bodies:
		check(body.sleeping, "it sleeps on")


## Each node that leaves takes only itself off the list, whatever the order.
func test_nodes_come_and_go_among_nodes_at_rest() -> void:
	var bodies := _add_sleepers(30)
	await ticks(10)
	var random := RandomNumberGenerator.new()
	random.seed = 5
	var awake := 0
	for round in 40:
		var i := random.randi_range(0, bodies.size() - 1)
		match random.randi_range(0, 3):
			0:
				bodies[i].free()
				bodies[i] = add_body(Vector2(150.0 * i, 3000), { "sleeping": true })
			1:
				bodies[i].sleeping = false
			2:
				bodies[i].freeze = not bodies[i].freeze
			3:
				stage.remove_child(bodies[i])
				stage.add_child(bodies[i])
		await ticks(1)
	awake = 0
	await ticks(10)
	for body in bodies:
		awake += 1 if not body.sleeping and not body.freeze else 0
	check_above(awake, 3, "bodies awake")
	check_equal(await _nodes_a_tick(1), float(awake), "nodes a tick, which are those awake")


## A body that fell asleep on the floor, and a RigidBody2D beside it that did.
func _asleep_on_floor() -> Array[Node2D]:
	add_floor(0)
	var soft := add_body(Vector2(0, -60))
	var rigid := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = circle(50)
	rigid.add_child(collision)
	rigid.position = Vector2(300, -51)
	stage.add_child(rigid)
	for i in 900:
		await ticks(1)
		if soft.sleeping and rigid.sleeping:
			break
	check(soft.sleeping and rigid.sleeping, "both sleep")
	return [soft, rigid]


func test_a_sleeper_that_is_put_back_elsewhere_falls_as_a_rigid_body_does() -> void:
	for body in await _asleep_on_floor():
		stage.remove_child(body)
		body.position.y = -400
		stage.add_child(body)
		await ticks(30)
		check_above(body.position.y, -300, body.get_class() + " put back above the floor after half a second")


func test_a_sleeper_that_gets_another_parent_falls_as_a_rigid_body_does() -> void:
	var parent := Node2D.new()
	parent.position.y = -350
	stage.add_child(parent)
	for body in await _asleep_on_floor():
		body.reparent(parent, false)
		await ticks(30)
		check_above(body.global_position.y, -320, body.get_class() + " below another parent after half a second")


func test_a_sleeper_whose_floor_is_freed_while_it_is_away_falls() -> void:
	var bodies := await _asleep_on_floor()
	for body in bodies:
		stage.remove_child(body)
	for node in stage.get_children():
		if node is StaticBody2D:
			node.free()
	for body in bodies:
		stage.add_child(body)
		await ticks(30)
		check_above(body.position.y, 30, body.get_class() + " half a second after it came back without a floor")


func test_a_sleeper_given_a_velocity_while_it_is_away_moves() -> void:
	for body in await _asleep_on_floor():
		stage.remove_child(body)
		body.linear_velocity = Vector2(0, -500)
		stage.add_child(body)
		await ticks(10)
		check_below(body.position.y, -80, body.get_class() + " that was given a velocity upward")


## What a scene may want: bodies that come in asleep.
func test_a_body_put_to_sleep_while_it_is_away_sleeps_when_it_comes_back() -> void:
	var body := add_body(Vector2(0, -300))
	await ticks(3)
	stage.remove_child(body)
	body.sleeping = true
	stage.add_child(body)
	await ticks(30)
	check(body.sleeping, "it sleeps")
	check_near(body.position.y, -300, 5, "its place")
