# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Area2D and soft bodies: the bodies inside, gravity, damping; each effect beside a RigidBody2D in the same area.

## For Area2D, whose bodies come and go.
class Watcher extends RefCounted:
	var entered: Array[Node] = []
	var exited: Array[Node] = []

	func _init(area: Area2D) -> void:
		area.body_entered.connect(func(body: Node) -> void: entered.append(body))
		area.body_exited.connect(func(body: Node) -> void: exited.append(body))


func _add_area(position: Vector2, size: Vector2, properties := {}) -> Area2D:
	var area := Area2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(size.x, size.y)
	area.add_child(collision)
	area.position = position
	for property: String in properties:
		area.set(property, properties[property])
	stage.add_child(area)
	return area


## A RigidBody2D that touches nothing, to compare with.
func _add_rigid(position: Vector2, properties := {}) -> RigidBody2D:
	var rigid := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = circle(50)
	rigid.add_child(collision)
	rigid.collision_layer = 1
	rigid.collision_mask = 0
	rigid.position = position
	rigid.can_sleep = false
	for property: String in properties:
		rigid.set(property, properties[property])
	stage.add_child(rigid)
	return rigid


func _spin(body: SoftBody2D, speed: float) -> void:
	for i in body.get_point_count():
		var arm := body.get_point_positions()[i] - body.get_center_of_mass_position()
		body.apply_point_impulse(i, Vector2(-arm.y, arm.x) * speed * body.mass / body.get_point_count())


func test_an_area_tells_who_comes_and_goes() -> void:
	var area := _add_area(Vector2(300, 0), Vector2(100, 100))
	var watcher := Watcher.new(area)
	var body := add_weightless_body(Vector2.ZERO)
	await ticks(3)
	check(not area.has_overlapping_bodies(), "the area overlaps a body that is far")
	body.apply_central_impulse(Vector2(300, 0) * body.mass)
	await seconds(1)
	check_equal(watcher.entered, [body] as Array[Node], "who entered")
	check(area.has_overlapping_bodies(), "the area does not overlap the body in it")
	check_equal(area.get_overlapping_bodies(), [body] as Array[Node2D], "who is inside")
	check(area.overlaps_body(body), "overlaps_body() does not know the body")
	await seconds(1.5)
	check_equal(watcher.exited, [body] as Array[Node], "who left")
	check(not area.has_overlapping_bodies(), "the area overlaps a body that has left")
	check_equal(watcher.entered.size(), 1, "number of entrances")


func test_an_area_knows_a_body_once_however_it_is_deformed() -> void:
	# A floor in the area: the body is squashed, dented and comes to rest inside without leaving.
	add_floor(100).collision_layer = 2
	var area := _add_area(Vector2(0, 60), Vector2(300, 200))
	var watcher := Watcher.new(area)
	var body := add_body(Vector2(0, -300), { "collision_mask": 2, "stiffness": 40.0 })
	await seconds(2)
	for i in 60: # pinched until it is shown in wedges
		body.apply_point_force(12, Vector2(0, 1500))
		await ticks(1)
	await seconds(4)
	check_equal(watcher.entered, [body] as Array[Node], "who entered")
	check_equal(watcher.exited.size(), 0, "number of exits")
	body.free()
	await ticks(2)
	check_equal(watcher.exited.size(), 1, "number of exits after the body was freed")


func test_a_body_that_is_dented_and_smooth_again_stays_in_an_area_that_has_a_part_of_it() -> void:
	for side: Vector2 in [Vector2.LEFT, Vector2.RIGHT]:
		var body := add_weightless_body()
		var area := _add_area(side * 50, Vector2(60, 200))
		await ticks(4)
		var watcher := Watcher.new(area)
		for i in 25:
			body.apply_point_force(12, Vector2(0, 3000))
			body.apply_point_force(4, Vector2(0, -3000))
			await ticks(1)
		var shapes := PhysicsServer2D.body_get_shape_count(body.get_rid())
		check_above(shapes, 1, "number of shapes of the dented body")
		await seconds(3)
		check_equal(PhysicsServer2D.body_get_shape_count(body.get_rid()), 1, "number of shapes of the smooth body")
		check(area.overlaps_body(body), "the area lost the body")
		check_equal(watcher.exited.size(), 0, "number of exits")
		check_equal(watcher.entered.size(), 0, "number of entrances of a body that was inside")
		body.free()
		area.free()
		await ticks(2)


func test_an_area_sees_by_layers_and_the_part_that_is_inside() -> void:
	var area := _add_area(Vector2(0, 0), Vector2(100, 100), { "collision_mask": 4 })
	var body := add_weightless_body(Vector2(95, 0), { "collision_layer": 1 })
	await ticks(3)
	check(not area.has_overlapping_bodies(), "the area sees a layer outside its mask")
	body.collision_layer = 4
	await ticks(3)
	check(area.overlaps_body(body), "the area does not see its layer")
	body.position = Vector2(105, 0)
	await ticks(3)
	check(not area.overlaps_body(body), "the area sees a body five px beside it")
	body.position = Vector2(95, 0)
	await ticks(3)
	check(area.overlaps_body(body), "the area does not see a body that came back")
	body.collision_proxy_enabled = false
	await ticks(3)
	check(not area.overlaps_body(body), "the area sees a body whose proxy is off")


func test_an_area_that_comes_over_a_sleeping_body_is_told() -> void:
	add_floor(100).collision_layer = 2
	var body := add_body(Vector2(0, 40), { "collision_mask": 2 })
	await seconds(6)
	var area := _add_area(Vector2(0, 80), Vector2(100, 100))
	var watcher := Watcher.new(area)
	await ticks(5)
	check_equal(watcher.entered, [body] as Array[Node], "who entered")


## Velocities after a second in areas, of a soft body and of a rigid one.
func _check_alike(soft_at: Vector2, rigid_at: Vector2, what: String, soft_properties := {}) -> void:
	var body := add_body(soft_at, { "collision_mask": 0 }.merged(soft_properties))
	var rigid := _add_rigid(rigid_at)
	await seconds(0.5)
	var expected := rigid.linear_velocity
	check_near(body.get_linear_velocity(), expected, maxf(0.02 * expected.length(), 34), "%s: velocity" % what)
	var start := body.get_linear_velocity()
	var rigid_start := rigid.linear_velocity
	await seconds(0.5)
	check_near(body.get_linear_velocity() - start, rigid.linear_velocity - rigid_start,
			maxf(0.01 * rigid_start.length(), 1), "%s: gain of velocity in half a second" % what)
	body.queue_free()
	rigid.queue_free()
	await ticks(2)


func test_gravity_is_overridden_in_all_four_ways() -> void:
	for mode: int in [Area2D.SPACE_OVERRIDE_DISABLED, Area2D.SPACE_OVERRIDE_COMBINE, Area2D.SPACE_OVERRIDE_COMBINE_REPLACE,
			Area2D.SPACE_OVERRIDE_REPLACE, Area2D.SPACE_OVERRIDE_REPLACE_COMBINE]:
		var outer := _add_area(Vector2.ZERO, Vector2(6000, 6000), { "priority": 1, "gravity": 300.0,
				"gravity_direction": Vector2.RIGHT, "gravity_space_override": Area2D.SPACE_OVERRIDE_COMBINE })
		var inner := _add_area(Vector2.ZERO, Vector2(6000, 6000), { "priority": 2, "gravity": 500.0,
				"gravity_direction": Vector2.UP, "gravity_space_override": mode })
		await _check_alike(Vector2(-300, 0), Vector2(300, 0), "mode %d" % mode)
		inner.free()
		outer.free()
		await ticks(2)


func test_an_area_of_no_gravity_lets_a_body_float() -> void:
	_add_area(Vector2.ZERO, Vector2(2000, 2000), { "gravity": 0.0, "gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body()
	await ticks(4)
	var velocity := body.get_linear_velocity()
	check_below(velocity.length(), GRAVITY / 60 * 2.5, "speed after what it takes to notice the area")
	await seconds(1)
	check_near(body.get_linear_velocity(), velocity, 0.01, "velocity a second later")


func test_the_bodys_gravity_scale_counts_in_areas_too() -> void:
	_add_area(Vector2.ZERO, Vector2(6000, 6000), { "gravity": 400.0, "gravity_direction": Vector2.RIGHT,
			"gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body(Vector2.ZERO, { "gravity_scale": 0.5 })
	await ticks(5)
	var before := body.get_linear_velocity()
	await seconds(1)
	check_near(body.get_linear_velocity() - before, Vector2(200, 0), 0.5, "velocity gained in a second")


func test_a_gravity_point_pulls_to_itself() -> void:
	_add_area(Vector2.ZERO, Vector2(4000, 4000), { "gravity_point": true, "gravity_point_center": Vector2.ZERO,
			"gravity": 400.0, "gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body(Vector2(400, 0), { "collision_mask": 0 })
	await ticks(3)
	# On a circle of radius r with the constant pull g a body stays at the speed sqrt(g r).
	body.apply_central_impulse(body.mass * (Vector2(0, -400) - body.get_linear_velocity()))
	for i in 8:
		await seconds(0.5)
		check_near(body.get_center_of_mass_position().length(), 400.0, 16, "distance from the point after %s s" % (0.5 * (i + 1)))
	check_near(body.get_linear_velocity().length(), 400.0, 16, "speed on the circle")


func test_leaving_an_area_gives_the_worlds_gravity_back() -> void:
	_add_area(Vector2.ZERO, Vector2(200, 200), { "gravity": 0.0, "gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body()
	await ticks(10)
	body.position = Vector2(1000, 0)
	await ticks(3)
	var before := body.get_linear_velocity()
	await seconds(1)
	check_near(body.get_linear_velocity() - before, Vector2(0, GRAVITY), 0.5, "velocity gained in a second")


func test_a_proxy_that_is_off_feels_no_area() -> void:
	_add_area(Vector2.ZERO, Vector2(9000, 9000), { "gravity": 0.0, "gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body(Vector2.ZERO, { "collision_proxy_enabled": false })
	await seconds(1)
	check_near(body.get_linear_velocity(), Vector2(0, GRAVITY), 0.5, "velocity after a second")


func test_linear_damp_slows_as_it_does_rigid_bodies() -> void:
	for mode: int in [Area2D.SPACE_OVERRIDE_DISABLED, Area2D.SPACE_OVERRIDE_COMBINE, Area2D.SPACE_OVERRIDE_REPLACE]:
		var area := _add_area(Vector2.ZERO, Vector2(9000, 9000), { "linear_damp": 2.0, "linear_damp_space_override": mode })
		var body := add_weightless_body(Vector2(0, -500), { "linear_damp": 0.5 })
		var rigid := _add_rigid(Vector2(0, 500), { "gravity_scale": 0.0, "linear_damp": 0.5 })
		await ticks(4)
		body.apply_central_impulse(Vector2(300, 0) * body.mass - body.get_linear_velocity() * body.mass)
		rigid.linear_velocity = Vector2(300, 0)
		await seconds(1)
		var damp := 0.5 if mode == Area2D.SPACE_OVERRIDE_DISABLED else 2.5
		# A rigid body loses damp / 60 of its velocity in each tick, a soft one follows the exponential at any tick rate.
		check_near(rigid.linear_velocity.x, 300 * (1 - damp / 60) ** 60, 12, "mode %d: velocity of the rigid body" % mode)
		check_near(body.get_linear_velocity().x, 300 * exp(-damp), 0.2, "mode %d: velocity of the soft body" % mode)
		body.linear_damp_mode = SoftBody2D.DAMP_MODE_REPLACE
		body.linear_damp = 0
		await ticks(1)
		var before := body.get_linear_velocity()
		await seconds(0.5)
		check_near(body.get_linear_velocity(), before, 0.01, "mode %d: velocity with damping replaced by 0" % mode)
		body.free()
		rigid.free()
		area.free()
		await ticks(2)


func test_angular_damp_slows_the_spin_alone() -> void:
	_add_area(Vector2.ZERO, Vector2(9000, 9000), { "angular_damp": 1.0, "angular_damp_space_override": Area2D.SPACE_OVERRIDE_COMBINE })
	var body := add_weightless_body(Vector2.ZERO, { "angular_damp": 1.0 })
	await ticks(4)
	_spin(body, 4)
	body.apply_central_impulse(Vector2(100, 0) * body.mass)
	await ticks(1)
	var spin := body.get_angular_velocity()
	await seconds(1)
	# What the spin pulls the body apart by and gives back changes the inertia, and so the spin, a little.
	check_near(body.get_angular_velocity() / spin, exp(-2), 0.01, "part of the spin that is left")
	check_near(body.get_linear_velocity(), Vector2(100, 0), 0.1, "velocity")


func test_the_projects_default_damping_counts_as_for_rigid_bodies() -> void:
	set_default_damp(0.1, 1.0)
	for proxy: bool in [true, false]:
		var body := add_weightless_body(Vector2.ZERO, { "collision_proxy_enabled": proxy })
		await ticks(4)
		_spin(body, 4)
		body.apply_central_impulse(Vector2(100, 0) * body.mass)
		await ticks(1)
		var spin := body.get_angular_velocity()
		var velocity := body.get_linear_velocity()
		await seconds(1)
		check_near(body.get_linear_velocity(), velocity * exp(-0.1), 0.2, "velocity, proxy %s" % proxy)
		check_near(body.get_angular_velocity() / spin, exp(-1), 0.01, "part of the spin, proxy %s" % proxy)
		body.free()


func test_a_body_at_rest_in_an_area_of_other_gravity_falls_asleep_and_wakes_when_it_changes() -> void:
	add_floor(100).collision_layer = 2
	var area := _add_area(Vector2.ZERO, Vector2(1000, 1000), { "gravity": 300.0, "gravity_direction": Vector2.DOWN,
			"gravity_space_override": Area2D.SPACE_OVERRIDE_REPLACE })
	var body := add_body(Vector2(0, 45), { "collision_mask": 2 })
	await seconds(8)
	var polygon := polygon_of(body)
	await seconds(1)
	check_equal(polygon_of(body), polygon, "the polygon a second later, so that it sleeps")
	area.gravity_direction = Vector2.UP
	await seconds(1.5)
	check_below(body.get_center_of_mass_position().y, 0, "y of the body after gravity has turned")
