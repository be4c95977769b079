# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## CharacterBody2D and soft bodies: stand, press, push, jump, part.


## A character as in Godot's own template: gravity, `walk` [px/s], move_and_slide.
class Walker extends CharacterBody2D:
	var walk := 0.0
	var jump := false
	var speed_limit := INF

	func _init(shape: Shape2D) -> void:
		var collision := CollisionShape2D.new()
		collision.shape = shape
		add_child(collision)

	func _ready() -> void:
		# A server with a thread of its own knows a body after the tick in which it came; until then the engine reports an error.
		if ProjectSettings.get_setting("physics/2d/run_on_separate_thread"):
			set_physics_process(false)
			await get_tree().physics_frame
			set_physics_process.call_deferred(true)

	func _physics_process(delta: float) -> void:
		if not is_on_floor():
			velocity.y += GRAVITY * delta
		elif jump:
			velocity.y = -400
			jump = false
		velocity.x = walk
		move_and_slide()


func time_limit() -> int:
	return 9000


func _add_walker(position: Vector2, shape: Shape2D = rectangle(30, 50)) -> Walker:
	var walker := Walker.new(shape)
	walker.position = position
	stage.add_child(walker)
	return walker


func _add_capsule(position: Vector2) -> Walker:
	var shape := CapsuleShape2D.new()
	shape.radius = 15
	shape.height = 50
	return _add_walker(position, shape)


func _has_touched(walker: CharacterBody2D, body: SoftBody2D) -> bool:
	for i in walker.get_slide_collision_count():
		if walker.get_slide_collision(i).get_collider() == body:
			return true
	return false


## Claims that the character rests: on the floor all the time, and moving by less than half a pixel up and down, and by less
## than `sideways` in two seconds.
func _check_stands(walker: Walker, body: SoftBody2D, what: String, sideways := 0.5) -> void:
	var box := Rect2(walker.position, Vector2.ZERO)
	var in_air := 0
	var touched := false
	for i in 120:
		await ticks(1)
		box = box.expand(walker.position)
		in_air += 0 if walker.is_on_floor() else 1
		touched = touched or _has_touched(walker, body)
	check_equal(in_air, 0, what + ": ticks in the air out of 120")
	check_below(box.size.y, 0.5, what + ": how far it moves up and down in px")
	check_below(box.size.x, sideways, what + ": how far it moves sideways in px")
	check(touched, what + ": no slide collision names the body")


func test_a_character_stands_on_a_jelly_and_presses_it_in() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50))
	await seconds(3)
	var top := bounds_of(polygon_of(body)).position.y
	for round: bool in [false, true]:
		var walker := _add_capsule(Vector2(0, top - 60)) if round else _add_walker(Vector2(0, top - 60))
		await seconds(6) # it bobs like a rigid body of its mass
		check_above(walker.position.y + 25, top + 1.5, "y of the soles, which press the top in")
		check_below(walker.position.y + 25, top + 12, "y of the soles, which are carried")
		await _check_stands(walker, body, "a capsule" if round else "a box")
		check_below(body.get_area() / body.get_rest_area(), 0.999, "area over rest area under the character")
		walker.free()
		await seconds(3)
		check_near(bounds_of(polygon_of(body)).position.y, top, 0.7, "top of the body after the character has gone")


func test_a_character_stands_on_jellies_of_all_kinds() -> void:
	add_floor(100)
	var kinds := {
		"soft": { "stiffness": 40.0 },
		"stiff": { "stiffness": 1000.0 },
		"heavy": { "mass": 10.0, "stiffness": 1000.0 },
		"balloon": { "stiffness": 20.0, "pressure": 300.0, "center_point": false },
		"box": { "polygon": SoftBody2D.make_box_polygon(Vector2(160, 60), 20) },
	}
	var x := -800.0
	for kind: String in kinds:
		var body := add_body(Vector2(x, 50), kinds[kind])
		body.name = kind
		x += 300
	await seconds(3)
	var walkers := {}
	for body: SoftBody2D in stage.find_children("*", "SoftBody2D", true, false):
		walkers[body] = _add_walker(Vector2(body.position.x, bounds_of(polygon_of(body)).position.y - 40))
	await seconds(8)
	for body: SoftBody2D in walkers:
		await _check_stands(walkers[body], body, "on a %s body" % body.name)


func test_a_character_stands_at_other_tick_rates() -> void:
	for rate: int in [30, 120, 240]:
		Engine.physics_ticks_per_second = rate
		var ground := add_floor(100)
		var body := add_body(Vector2(0, 50))
		await seconds(2)
		var walker := _add_walker(Vector2(0, -40))
		await seconds(8)
		await _check_stands(walker, body, "at %d ticks" % rate)
		walker.free()
		body.free()
		ground.free()
		await ticks(2)


func test_a_character_jumps_off_a_jelly() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50))
	var walker := _add_walker(Vector2(0, -40))
	await seconds(8)
	var start := walker.position.y
	walker.jump = true
	var highest := start
	for i in 60:
		await ticks(1)
		highest = minf(highest, walker.position.y)
	check_near(start - highest, 400.0 * 400 / (2 * GRAVITY), 12, "height of the jump")
	await seconds(8)
	await _check_stands(walker, body, "after the jump")
	check_near(walker.position.y, start, 1, "where it stands after the jump")


func test_a_character_walks_into_a_jelly_and_pushes_it_along() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50))
	var walker := _add_walker(Vector2(-150, 74))
	await seconds(2)
	walker.walk = 100
	await seconds(4)
	check_above(body.get_center_of_mass_position().x, 100, "x of the pushed body")
	check_above(walker.position.x, 150, "x of the character that pushes")
	check_below(walker.position.x, body.get_center_of_mass_position().x - 40, "x of the character, which stays behind the body")
	check_above(body.get_area() / body.get_rest_area(), 0.85, "area over rest area of the pushed body")
	walker.walk = -100
	await seconds(1)
	check_below(walker.position.x, body.get_center_of_mass_position().x - 100, "x of the character that walks away")


func test_a_jelly_that_falls_on_a_character_parts_from_it() -> void:
	add_floor(100)
	var walker := _add_walker(Vector2(0, 74))
	await seconds(1)
	var body := add_body(Vector2(3, -200))
	var fastest := 0.0
	for i in 240:
		await ticks(1)
		fastest = maxf(fastest, body.get_linear_velocity().length())
	check_below(fastest, 1000, "largest speed of the body")
	check(all_finite(body.get_point_positions()), "a point is not finite")
	check_near(walker.position.y, 74.9, 2, "y of the character on its floor")
	check_above(body.get_area() / body.get_rest_area(), 0.8, "area over rest area after the hit")
	var away := -1.0 if body.get_center_of_mass_position().x > walker.position.x else 1.0
	walker.walk = 150 * away
	await seconds(2)
	check_above(walker.position.x * away, 200, "way of the character that walks away from the body")


func test_a_character_under_a_heavy_jelly_walks_out() -> void:
	add_floor(100)
	var walker := _add_walker(Vector2(0, 74))
	await seconds(1)
	add_body(Vector2(0, -40), { "mass": 5.0, "stiffness": 200.0, "polygon": SoftBody2D.make_circle_polygon(80, 24) })
	await seconds(2)
	walker.walk = 150
	await seconds(3)
	check_above(absf(walker.position.x), 150, "way of the character from under the body")
	check_near(walker.position.y, 74.9, 2, "y of the character on its floor")


func test_a_character_is_carried_by_a_moving_jelly() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 70), { "polygon": SoftBody2D.make_box_polygon(Vector2(200, 60), 20), "physics_material_override": surface(0.0) })
	var walker := _add_walker(Vector2(0, 10))
	await seconds(2)
	body.apply_central_impulse(Vector2(80, 0) * body.mass - body.mass * body.get_linear_velocity())
	await ticks(3)
	var platform := walker.get_platform_velocity()
	check_near(platform.x, 80.0, 8, "platform velocity along x")
	var gap := walker.position.x - body.get_center_of_mass_position().x
	await seconds(1)
	check_near(walker.position.x - body.get_center_of_mass_position().x, gap, 8, "where it stands on the body after a second")


func test_a_margin_of_zero_is_a_hard_surface() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50), { "collision_proxy_margin": 0.0 })
	await seconds(3)
	var top := bounds_of(polygon_of(body)).position.y
	var walker := _add_walker(Vector2(0, top - 40))
	await seconds(2)
	check_near(walker.position.y + 25, top, 1.5, "y of the soles")
	await _check_stands(walker, body, "on a hard surface")


func test_a_character_stands_in_a_deep_margin() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50), { "collision_proxy_margin": 10.0,
			"polygon": SoftBody2D.make_box_polygon(Vector2(120, 80), 20), "stiffness": 400.0 })
	await seconds(3)
	var top := bounds_of(polygon_of(body)).position.y
	var walker := _add_walker(Vector2(0, top - 40))
	await seconds(6) # the body gives way sideways for some seconds
	check_near(walker.position.y + 25, top + 4, 4, "y of the soles, which its weight presses in")
	# Pressed in deep, a body takes some seconds to find its balance, and carries along a character that stands on it.
	await _check_stands(walker, body, "in a deep margin", 1.5)


func test_a_character_walks_through_a_body_that_is_excepted() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 50), { "collision_mask": 2 })
	add_solid(rectangle(2000, 100), Transform2D(0, Vector2(0, 150))).collision_layer = 2
	var walker := _add_walker(Vector2(-150, 74))
	body.add_collision_exception_with(walker)
	await seconds(1)
	walker.walk = 200
	await seconds(1.5)
	check_near(walker.position.x, 150.0, 5, "x of the character that nothing stops")
	body.remove_collision_exception_with(walker)
	walker.walk = -200
	await seconds(1.5)
	check_above(walker.position.x, 50, "x of the character that the body stops")


func test_bodies_whose_proxy_is_off_stop_no_character() -> void:
	add_floor(100)
	add_body(Vector2(0, 50), { "collision_proxy_enabled": false, "collision_mask": 0, "gravity_scale": 0.0 })
	var walker := _add_walker(Vector2(-150, 74))
	walker.walk = 200
	await ticks(5)
	var start := walker.position.x
	await seconds(1.5)
	check_near(walker.position.x - start, 300.0, 1, "way of the character")
