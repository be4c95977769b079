# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies that the game moves carry soft bodies and push them.

const TICK_RATES: Array[int] = [30, 60, 120, 240]
## How a body may be driven.
const KINDS: Array[String] = ["animatable", "synced", "character", "static", "frozen", "server"]


func time_limit() -> int:
	return 30000


func _add_driven(kind: String, shape: Shape2D, position: Vector2) -> Node2D:
	var body: CollisionObject2D
	match kind:
		"animatable", "synced":
			body = AnimatableBody2D.new()
			(body as AnimatableBody2D).sync_to_physics = kind == "synced"
		"character":
			body = CharacterBody2D.new()
		"static":
			body = StaticBody2D.new()
		"frozen":
			body = RigidBody2D.new()
			(body as RigidBody2D).freeze = true
			(body as RigidBody2D).freeze_mode = RigidBody2D.FREEZE_MODE_KINEMATIC
		"server":
			return _add_server_body(shape, position)
	var collision := CollisionShape2D.new()
	collision.shape = shape
	body.add_child(collision)
	body.position = position
	stage.add_child(body)
	return body


## A body without a node, and a node that leads it.
func _add_server_body(shape: Shape2D, position: Vector2) -> Node2D:
	var leader := Node2D.new()
	leader.position = position
	stage.add_child(leader)
	var body := PhysicsServer2D.body_create()
	PhysicsServer2D.body_set_mode(body, PhysicsServer2D.BODY_MODE_KINEMATIC)
	PhysicsServer2D.body_add_shape(body, shape.get_rid())
	PhysicsServer2D.body_set_space(body, stage.get_world_2d().space)
	PhysicsServer2D.body_set_state(body, PhysicsServer2D.BODY_STATE_TRANSFORM, leader.transform)
	leader.set_meta("body", body)
	leader.set_meta("shape", shape) # which keeps it alive
	leader.tree_exiting.connect(func() -> void: PhysicsServer2D.free_rid(body))
	return leader


func _move(body: Node2D, by: Vector2, turn := 0.0) -> void:
	body.transform = Transform2D(body.rotation + turn, body.position + by)
	if body.has_meta("body"):
		PhysicsServer2D.body_set_state(body.get_meta("body"), PhysicsServer2D.BODY_STATE_TRANSFORM, body.transform)


func _clear_stage() -> void:
	for node in stage.get_children():
		node.free()
	await ticks(2)


func test_a_lift_carries_a_body_up() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		for kind in KINDS:
			if rate != 60 and kind != "synced" and kind != "character":
				continue
			var lift := _add_driven(kind, rectangle(400, 40), Vector2(0, 120))
			var soft := add_body(Vector2(0, 68), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "stiffness": 300.0, "damping": 2.0 })
			await seconds(1)
			for i in 2 * rate:
				_move(lift, Vector2(0, -200.0 / rate))
				await ticks(1)
			var what := "on a lift (%s) at %d ticks" % [kind, rate]
			check_near(soft.get_linear_velocity().y, -200.0, 6, "velocity " + what)
			# What moves is met where the engine's last step left it, one tick after the game had moved it.
			check_near(bounds_of(polygon_of(soft)).end.y, 100 - 400 + 200.0 / rate, 200.0 / rate + 1.5, "lower side " + what)
			await _clear_stage()


func test_a_platform_carries_a_body_sideways() -> void:
	for kind in KINDS:
		var platform := _add_driven(kind, rectangle(600, 40), Vector2(0, 120))
		var soft := add_body(Vector2(0, 68), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "physics_material_override": surface(0.8) })
		await seconds(1)
		var offset := soft.get_center_of_mass_position().x - platform.position.x
		for i in 120:
			_move(platform, Vector2(minf(i, 30) / 30 * 2, 0)) # gently: friction can give 0.8 g
			await ticks(1)
		check_near(soft.get_linear_velocity().x, 120.0, 4, "velocity on a platform (%s)" % kind)
		check_near(soft.get_center_of_mass_position().x - platform.position.x, offset, 8, "place on a platform (%s)" % kind)
		await _clear_stage()


func test_a_fast_piston_takes_a_body_along() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		for kind in KINDS:
			if rate != 60 and kind != "synced" and kind != "animatable":
				continue
			var piston := _add_driven(kind, rectangle(40, 300), Vector2(-200, 0))
			var soft := add_weightless_body(Vector2(0, 0), { "polygon": SoftBody2D.make_circle_polygon(30, 16) })
			await ticks(2)
			for i in ceili(0.25 * rate):
				_move(piston, Vector2(2400.0 / rate, 0))
				await ticks(1)
			var what := "(%s) at %d ticks" % [kind, rate]
			check_above(soft.get_center_of_mass_position().x, piston.position.x - 2400.0 / rate, "x of the body before the piston " + what)
			check_above(soft.get_linear_velocity().x, 2300, "velocity before the piston " + what)
			await _clear_stage()


func test_a_turning_paddle_hits() -> void:
	for kind: String in ["synced", "server"]:
		var paddle := _add_driven(kind, rectangle(300, 20), Vector2(0, 0))
		var soft := add_weightless_body(Vector2(110, 50), { "polygon": SoftBody2D.make_circle_polygon(25, 12) })
		await ticks(2)
		for i in 20:
			_move(paddle, Vector2.ZERO, 0.1) # 6 rad/s: 660 px/s where the body is
			await ticks(1)
		check_above(soft.get_linear_velocity().length(), 500, "speed after the paddle (%s)" % kind)
		await _clear_stage()


func test_what_is_teleported_does_not_hit() -> void:
	for kind in KINDS:
		var block := _add_driven(kind, rectangle(60, 60), Vector2(-300, 0))
		var soft := add_weightless_body(Vector2(0, 0))
		await ticks(3)
		_move(block, Vector2(600, 0))
		await ticks(5)
		check_below(soft.get_linear_velocity().length(), 1, "speed of what a teleported body (%s) passed" % kind)
		_move(block, Vector2(-200, 0)) # now 100 px from the middle of the soft body, beyond its 50 px
		await ticks(5)
		check_below(soft.get_linear_velocity().length(), 1, "speed beside a teleported body (%s)" % kind)
		soft.apply_central_impulse(Vector2(200, 0))
		await seconds(1)
		check_below(soft.get_center_of_mass_position().x, 75, "x of what met the teleported body (%s)" % kind)
		await _clear_stage()


func test_a_belt_on_an_animatable_body_carries_and_moves() -> void:
	var belt := _add_driven("synced", rectangle(1200, 40), Vector2(0, 120)) as AnimatableBody2D
	belt.constant_linear_velocity = Vector2(80, 0)
	var soft := add_body(Vector2(0, 68), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "physics_material_override": surface(0.8) })
	await seconds(2)
	check_near(soft.get_linear_velocity().x, 80.0, 4, "velocity on the belt")
	for i in 120:
		_move(belt, Vector2(0, -1))
		await ticks(1)
	check_near(soft.get_linear_velocity(), Vector2(80, -60), 5, "velocity on the belt that is lifted")


func test_what_has_stopped_is_at_rest() -> void:
	for kind in KINDS:
		var lift := _add_driven(kind, rectangle(400, 40), Vector2(0, 120))
		var soft := add_body(Vector2(0, 68), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "stiffness": 300.0, "damping": 2.0 })
		await seconds(1)
		for i in 60:
			_move(lift, Vector2(0, -1))
			await ticks(1)
		await check_rests(soft, 4, "the body on a lift that stopped (%s)" % kind)
		check_near(bounds_of(polygon_of(soft)).end.y, 40.0, 1, "lower side on a lift that stopped (%s)" % kind)
		await _clear_stage()


func test_a_press_squeezes() -> void:
	add_floor(100)
	var press := _add_driven("synced", rectangle(300, 40), Vector2(0, -80))
	var soft := add_body(Vector2(0, 50), { "stiffness": 100.0, "pressure": 300.0 })
	await seconds(1)
	for i in 60:
		_move(press, Vector2(0, 1.5))
		await ticks(1)
	await seconds(1)
	# Its lower side is at 30 now, 70 px above the floor.
	check_near(bounds_of(polygon_of(soft)).position.y, 30.0, 1.5, "upper side of the squeezed body")
	check_above(bounds_of(polygon_of(soft)).size.x, 105, "width of the squeezed body")


func test_a_character_runs_into_a_body_and_moves_it() -> void:
	var character := _add_driven("character", circle(30), Vector2(-150, 0)) as CharacterBody2D
	var soft := add_weightless_body(Vector2(0, 0))
	await ticks(2)
	character.motion_mode = CharacterBody2D.MOTION_MODE_FLOATING
	character.collision_mask = 0
	character.velocity = Vector2(300, 0)
	for i in 60:
		character.move_and_slide()
		await ticks(1)
	check_above(soft.get_linear_velocity().x, 280, "velocity of the pushed body")
	check_above(soft.get_center_of_mass_position().x, character.position.x + 30, "x of the pushed body")
