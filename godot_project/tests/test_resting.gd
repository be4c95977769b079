# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies dropped on each kind of surroundings come to rest on them.


func _convex(points: PackedVector2Array) -> ConvexPolygonShape2D:
	var shape := ConvexPolygonShape2D.new()
	shape.points = points
	return shape


func _boundary(normal: Vector2, distance: float) -> WorldBoundaryShape2D:
	var shape := WorldBoundaryShape2D.new()
	shape.normal = normal
	shape.distance = distance
	return shape


## Where the floor's top was meant to be: 100.
func _check_lies_at_100(body: SoftBody2D, tolerance := 1.0) -> void:
	check_near(bounds_of(polygon_of(body)).end.y, 100.0, tolerance, "height of the lowest point")


func test_rests_on_a_rectangle() -> void:
	add_floor(100)
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_convex_polygon() -> void:
	add_solid(_convex([Vector2(-200, 100), Vector2(200, 100), Vector2(150, 180), Vector2(-150, 180)]))
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_convex_polygon_given_clockwise_or_not() -> void:
	add_solid(_convex([Vector2(-150, 180), Vector2(150, 180), Vector2(200, 100), Vector2(-200, 100)]))
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_segment() -> void:
	var shape := SegmentShape2D.new()
	shape.a = Vector2(-300, 100)
	shape.b = Vector2(300, 100)
	add_solid(shape)
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_world_boundary() -> void:
	add_solid(_boundary(Vector2.UP, -100))
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_capsule() -> void:
	var shape := CapsuleShape2D.new()
	shape.radius = 30
	shape.height = 400
	add_solid(shape, Transform2D(PI / 2, Vector2(0, 130)))
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_between_two_circles() -> void:
	for x: float in [-70, 70]:
		add_solid(circle(40), Transform2D(0, Vector2(x, 150)))
	var body := add_body()
	await check_rests(body)
	check_near(body.get_center_of_mass_position().x, 0.0, 3, "x of the body between two equal circles")


func test_rests_in_a_polygon_node() -> void:
	var solid := StaticBody2D.new()
	var polygon := CollisionPolygon2D.new()
	polygon.polygon = PackedVector2Array([Vector2(-120, 0), Vector2(-90, 0), Vector2(-60, 110), Vector2(60, 110),
		Vector2(90, 0), Vector2(120, 0), Vector2(120, 150), Vector2(-120, 150)])
	solid.add_child(polygon)
	stage.add_child(solid)
	var body := add_body()
	await check_rests(body)
	check_near(body.get_center_of_mass_position().x, 0.0, 3, "x of the body in the bowl")


func test_rests_in_a_polygon_node_of_segments() -> void:
	var solid := StaticBody2D.new()
	var polygon := CollisionPolygon2D.new()
	polygon.build_mode = CollisionPolygon2D.BUILD_SEGMENTS
	polygon.polygon = PackedVector2Array([Vector2(-200, 100), Vector2(200, 100), Vector2(200, 140), Vector2(-200, 140)])
	solid.add_child(polygon)
	stage.add_child(solid)
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_scaled_and_turned_rectangle() -> void:
	var transform := Transform2D(PI / 2, Vector2(0.5, 4), 0, Vector2(0, 300))
	add_solid(rectangle(800, 100), transform) # 400 px high and wide then, its top at 100
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_on_a_scaled_circle_pair_and_a_mirrored_polygon() -> void:
	for x: float in [-70, 70]:
		add_solid(circle(20), Transform2D(0.3, Vector2(2, 2), 0, Vector2(x, 150)))
	var body := add_body()
	add_solid(_convex([Vector2(-100, 0), Vector2(200, 0), Vector2(150, 80), Vector2(-50, 80)]),
			Transform2D(0, Vector2(-1, 1), 0, Vector2(400, 100)))
	var second := add_body(Vector2(400, 0))
	await check_rests(body)
	check_below(second.get_penetration(), 1, "penetration on the mirrored polygon")
	_check_lies_at_100(second)


func test_rests_on_a_shape_with_a_transform_of_its_own_in_a_turned_parent() -> void:
	var parent := Node2D.new()
	parent.transform = Transform2D(PI / 6, Vector2(1.5, 1.5), 0, Vector2(30, -20))
	stage.add_child(parent)
	var solid := StaticBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(400, 40)
	parent.add_child(solid)
	solid.add_child(collision)
	solid.global_transform = Transform2D(-PI / 5, Vector2(60, 150))
	collision.global_transform = Transform2D(0, Vector2(0, 120)) # top at 100
	var body := add_body()
	await check_rests(body)
	_check_lies_at_100(body)


func test_rests_in_a_valley_of_two_turned_rectangles() -> void:
	for side: float in [-1, 1]:
		add_solid(rectangle(400, 40), Transform2D(-side * 0.4, Vector2(side * 180, 100)))
	var body := add_body()
	await check_rests(body)
	check_near(body.get_center_of_mass_position().x, 0.0, 3, "x of the body in the valley")


func test_a_box_stays_on_a_slope_that_friction_holds() -> void:
	add_solid(rectangle(1000, 60), Transform2D(0.2, Vector2(0, 150))) # tan 0.2 = 0.20, below the friction of 0.4
	var body := add_body(Vector2.ZERO, { "polygon": SoftBody2D.make_box_polygon(Vector2(90, 60), 15), "rotation": 0.2 })
	await check_rests(body)
	check_below(absf(body.get_center_of_mass_position().x), 60, "way along the slope")


func test_a_slippery_body_slides_down_the_same_slope() -> void:
	add_solid(rectangle(1000, 60), Transform2D(0.2, Vector2(0, 150)))
	var body := add_body(Vector2.ZERO,
			{ "polygon": SoftBody2D.make_box_polygon(Vector2(90, 60), 15), "rotation": 0.2, "physics_material_override": surface(0.0) })
	await seconds(2)
	check_above(body.get_center_of_mass_position().x, 100, "way along the slope")


func test_every_stiffness_rests() -> void:
	add_floor(100)
	var bodies: Array[SoftBody2D] = []
	for stiffness: float in [100, 300, 1000, 5000, 20000]:
		bodies.append(add_body(Vector2(-800 + 300 * bodies.size(), 0), { "stiffness": stiffness }))
	await seconds(9)
	for body in bodies:
		check_below(body.get_penetration(), 1, "penetration at k = %s" % body.stiffness)
		_check_lies_at_100(body)
	await check_rests(bodies[0], 2, "the softest body")
	await check_rests(bodies[4], 2, "the stiffest body")


func test_a_softer_body_is_flatter() -> void:
	add_floor(100)
	var heights := PackedFloat64Array()
	for stiffness: float in [120, 300, 1200]:
		var body := add_body(Vector2(-400 + 300 * heights.size(), 40), { "stiffness": stiffness })
		await seconds(5)
		heights.append(bounds_of(polygon_of(body)).size.y)
	check_above(heights[1] - heights[0], 1, "height at 300 N/m above that at 120 N/m")
	check_above(heights[2] - heights[1], 1, "height at 1200 N/m above that at 300 N/m")


func test_rests_at_30_60_and_120_ticks_a_second() -> void:
	for rate: int in [30, 60, 120]:
		Engine.physics_ticks_per_second = rate
		await ticks(2)
		var floor_body := add_floor(100)
		var body := add_body()
		await check_rests(body, 10, "the body at %d ticks a second" % rate)
		_check_lies_at_100(body)
		body.free()
		floor_body.free()


func test_a_fast_body_does_not_pass_a_thin_floor() -> void:
	var shape := SegmentShape2D.new()
	shape.a = Vector2(-300, 100)
	shape.b = Vector2(300, 100)
	add_solid(shape)
	var body := add_body(Vector2.ZERO, { "stiffness": 1000.0 })
	body.apply_central_impulse(Vector2(0, 5000)) # 83 px a tick
	await seconds(3)
	check_below(body.get_center_of_mass_position().y, 100, "y of the body above the floor")


## A line has two sides: a body that is put across it belongs on that of its middle.
func test_a_body_put_across_a_segment_comes_out_above_it() -> void:
	var shape := SegmentShape2D.new()
	shape.a = Vector2(-3000, 100)
	shape.b = Vector2(3000, 100)
	add_solid(shape)
	for sunk: float in [0.5, 3.0, 20.0, 40.0]:
		var added := add_body(Vector2(-200, 50 + sunk))
		var sent := add_body(Vector2(200, -400))
		await ticks(5)
		sent.teleport(Transform2D(0, Vector2(200, 50 + sunk)))
		await seconds(3)
		for body: SoftBody2D in [added, sent]:
			_check_lies_at_100(body)
			body.free()


func test_squashes_on_impact_and_recovers_its_area() -> void:
	add_floor(100)
	var body := add_weightless_body()
	var rest := polygon_of(body)
	body.apply_central_impulse(Vector2(0, 700))
	var least := 1.0
	for i in 60:
		await ticks(1)
		least = minf(least, body.get_area() / body.get_rest_area())
	check_below(least, 0.98, "least area over rest area during the impact")
	check_below(body.get_linear_velocity().y, 0, "velocity after the impact")
	await seconds(9)
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.02, "area over rest area after the impact")
	check_points_near(body.global_transform.affine_inverse() * polygon_of(body), rest, 1.5, "the polygon before and after")


## Speed with which a body of the given bounce leaves a floor that it met with 400 px/s.
func _rebound(bounce: float, properties: Dictionary, floor_body: StaticBody2D = null) -> float:
	if floor_body == null:
		floor_body = add_floor(100)
	var body := add_weightless_body(Vector2.ZERO, properties.merged({ "physics_material_override": surface(0.4, bounce) }))
	body.apply_central_impulse(Vector2(0, 400))
	await seconds(2)
	var speed := -body.get_linear_velocity().y
	body.free()
	floor_body.free()
	await ticks(2)
	return speed


func test_a_body_leaves_with_its_bounce_at_least() -> void:
	var damped := { "stiffness": 300.0, "damping": 20.0 }
	var plain := await _rebound(0, damped)
	check_below(plain, 160, "speed after the impact of a damped body without bounce")
	for bounce: float in [0.5, 0.8, 1.0]:
		var speed := await _rebound(bounce, damped)
		check_near(speed, 400 * bounce, 40, "speed after the impact with bounce %s" % bounce)
		check_below(speed, 404, "speed after the impact with bounce %s" % bounce)


func test_bounce_takes_nothing_from_springy_bodies() -> void:
	var springy := { "stiffness": 3000.0 }
	var plain := await _rebound(0, springy)
	check_above(plain, 200, "speed after the impact of a springy body without bounce")
	check_near(await _rebound(0.3, springy), plain, 0.05 * plain, "speed after the impact with bounce 0.3")


func test_the_floors_bounce_is_added() -> void:
	var floor_body := add_floor(100)
	floor_body.physics_material_override = PhysicsMaterial.new()
	floor_body.physics_material_override.bounce = 0.6
	var speed := await _rebound(0.2, { "stiffness": 300.0, "damping": 20.0 }, floor_body)
	check_near(speed, 320.0, 40, "speed after the impact with bounce 0.2 on a floor of bounce 0.6")


func test_a_bouncing_body_comes_to_rest() -> void:
	add_floor(100)
	var body := add_body(Vector2.ZERO, { "physics_material_override": surface(0.4, 0.7) })
	await check_rests(body, 20)


func test_a_body_falls_when_its_floor_is_freed() -> void:
	var floor_body := add_floor(100)
	var body := add_body()
	await seconds(2)
	floor_body.free()
	await seconds(1)
	check_above(body.get_center_of_mass_position().y, 300, "y after the floor went")


func test_a_conveyor_carries_a_body() -> void:
	add_floor(100).constant_linear_velocity = Vector2(120, 0)
	var body := add_body(Vector2.ZERO, { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0 })
	await seconds(4)
	check_near(body.get_linear_velocity().x, 120.0, 10, "speed on the conveyor")


func test_an_icy_floor_holds_nothing() -> void:
	var ice := add_floor(100)
	ice.physics_material_override = PhysicsMaterial.new()
	ice.physics_material_override.friction = 0
	var body := add_body(Vector2(0, 40), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0 })
	await seconds(1)
	body.apply_central_impulse(Vector2(100, 0))
	await seconds(2)
	check_near(body.get_linear_velocity().x, 100.0, 5, "speed on ice two seconds after the push")


func test_without_a_screen_every_body_is_simulated() -> void:
	if DisplayServer.get_name() != "headless":
		skip("there is a screen")
		return
	var body := add_body(Vector2(1e5, 0), { "simulate_off_screen": false })
	await seconds(0.5)
	check_above(body.global_position.y, 100, "fall of a body that may stand still off-screen")
