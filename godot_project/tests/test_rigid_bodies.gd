# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Soft bodies and RigidBody2D push each other.

const TICK_RATES: Array[int] = [30, 60, 120, 240]


func time_limit() -> int:
	return 30000


func add_rigid(shape: Shape2D, position: Vector2, mass: float, properties := {}) -> RigidBody2D:
	var body := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = shape
	body.add_child(collision)
	body.position = position
	body.mass = mass
	for property: String in properties:
		body.set(property, properties[property])
	stage.add_child(body)
	return body


## Without gravity and the damping that a project has by default.
func add_free_rigid(shape: Shape2D, position: Vector2, mass: float, properties := {}) -> RigidBody2D:
	return add_rigid(shape, position, mass, {
		"gravity_scale": 0.0, "can_sleep": false,
		"linear_damp_mode": RigidBody2D.DAMP_MODE_REPLACE, "linear_damp": 0.0,
		"angular_damp_mode": RigidBody2D.DAMP_MODE_REPLACE, "angular_damp": 0.0,
	}.merged(properties, true))


func state_of(body: RigidBody2D) -> PhysicsDirectBodyState2D:
	return PhysicsServer2D.body_get_direct_state(body.get_rid())


## Linear momentum, and angular momentum about the origin, as the third component.
func momentum_of(soft: SoftBody2D, rigid: RigidBody2D) -> Vector3:
	var state := state_of(rigid)
	var linear := state.linear_velocity * rigid.mass
	var center := state.transform.origin + state.center_of_mass
	var angular := center.cross(linear) + state.angular_velocity / state.inverse_inertia
	var points := soft.get_point_positions()
	var velocities := soft.get_point_velocities()
	for i in points.size():
		var part := velocities[i] * (soft.mass / points.size())
		linear += part
		angular += points[i].cross(part)
	return Vector3(linear.x, linear.y, angular)


func test_a_collision_in_free_space_keeps_both_momenta() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		for mass: float in [0.1, 1.0, 10.0]:
			var rigid := add_free_rigid(rectangle(80, 80), Vector2(200, 300), mass, { "rotation": 0.4 })
			var soft := add_weightless_body(Vector2(0, 270), { "polygon": SoftBody2D.make_circle_polygon(40, 16), "stiffness": 300.0 })
			await ticks(2) # the engine knows the inertia after its first step
			soft.apply_central_impulse(Vector2(400, 0))
			await ticks(1)
			var before := momentum_of(soft, rigid)
			await seconds(1)
			var after := momentum_of(soft, rigid)
			var what := "at %d ticks with %s kg" % [rate, mass]
			check_above(state_of(rigid).linear_velocity.length(), 50, "speed of what was hit " + what)
			check_above(absf(state_of(rigid).angular_velocity), 0.2, "spin of what was hit beside its center " + what)
			check_near(Vector2(after.x, after.y), Vector2(before.x, before.y), 4, "linear momentum " + what)
			check_near(after.z, before.z, absf(before.z) * 0.01, "angular momentum " + what)
			soft.free()
			rigid.free()
			await ticks(2)


## A closed box with a soft body inside: when all is quiet, both have the common velocity.
func test_an_inelastic_hit_ends_with_the_common_velocity() -> void:
	for mass: float in [0.1, 1.0, 10.0]:
		# 98 px wide inside, so that it holds the body, which is 100 px wide, tight enough for all to come to rest in it.
		var box := add_free_rigid(rectangle(20, 200), Vector2(-59, 0), mass, { "lock_rotation": true })
		for wall: Array in [[Vector2(118, 0), Vector2(20, 200)], [Vector2(59, -100), Vector2(100, 20)], [Vector2(59, 100), Vector2(100, 20)]]:
			var collision := CollisionShape2D.new()
			collision.position = wall[0]
			collision.shape = rectangle(wall[1].x, wall[1].y)
			box.add_child(collision)
		var soft := add_weightless_body(Vector2.ZERO, { "stiffness": 200.0, "damping": 3.0, "shape_damping_ratio": 3.0 })
		await ticks(2)
		soft.apply_central_impulse(Vector2(300, 20))
		await seconds(12)
		var common := Vector2(300, 20) / (1 + mass)
		check_near(state_of(box).linear_velocity, common, 0.03 * common.length() + 1, "velocity of a box of %s kg" % mass)
		check_near(soft.get_linear_velocity(), common, 0.03 * common.length() + 1, "velocity of what is in a box of %s kg" % mass)
		box.free()
		soft.free()
		await ticks(2)


func test_gravity_acts_once_on_a_rigid_body_near_a_soft_one() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		var near := add_rigid(rectangle(40, 40), Vector2(80, 0), 1)
		var far := add_rigid(rectangle(40, 40), Vector2(5000, 0), 1)
		add_body(Vector2.ZERO)
		await seconds(1)
		check_equal(state_of(near).linear_velocity, state_of(far).linear_velocity, "velocity beside a soft body at %d ticks" % rate)
		check_near(near.position.y, far.position.y, 0.01, "y beside a soft body at %d ticks" % rate)
		for node in stage.get_children():
			node.free()
		await ticks(2)


## Claims that the body's center stays within `tolerance` px for a second.
func check_stays(body: Node2D, tolerance: float, what: String) -> void:
	var from := body.global_position
	var way := 0.0
	for i in Engine.physics_ticks_per_second:
		await ticks(1)
		way = maxf(way, body.global_position.distance_to(from))
	check_below(way, tolerance, "way of %s in a second" % what)


func test_a_crate_rests_on_a_soft_body() -> void:
	set_default_damp(0.1, 1.0) # the engine lets nothing rest that nothing damps
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		add_floor(100)
		var soft := add_body(Vector2(0, 60), { "polygon": SoftBody2D.make_box_polygon(Vector2(200, 80), 20), "stiffness": 800.0, "damping": 3.0, "rolling_resistance": 0.1 })
		var crate := add_rigid(rectangle(60, 40), Vector2(0, -10), 0.5)
		await seconds(5)
		var what := "at %d ticks" % rate
		check_near(crate.position, Vector2(0, 0), 15, "place of the crate " + what)
		check_below(crate.position.y + 20, 60, "lower side of the crate, above the floor " + what)
		check_below(crate.linear_velocity.length(), 2, "speed of the crate " + what)
		await check_stays(crate, 1, "the crate " + what)
		check_below(soft.get_penetration(), 1, "penetration " + what)
		for node in stage.get_children():
			node.free()
		await ticks(2)


func test_a_soft_body_rests_on_a_crate() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		for mass: float in [0.2, 1.0, 5.0]:
			add_floor(100)
			var crate := add_rigid(rectangle(160, 60), Vector2(0, 70), mass)
			var soft := add_body(Vector2(0, 5), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0 })
			await seconds(4)
			var what := "at %d ticks on %s kg" % [rate, mass]
			check_near(bounds_of(polygon_of(soft)).end.y, 40, 1, "lower side of the soft body " + what)
			check_near(crate.position, Vector2(0, 70), 2, "place of the crate " + what)
			check_below(soft.get_linear_velocity().length(), 5, "speed of the soft body " + what)
			await check_stays(soft, 0.5, "the soft body " + what)
			check_below(soft.get_penetration(), 1, "penetration " + what)
			for node in stage.get_children():
				node.free()
			await ticks(2)


func test_a_falling_crate_lands_on_a_soft_body_and_does_not_pass() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		add_floor(100)
		var soft := add_body(Vector2(0, 50), { "stiffness": 600.0, "damping": 2.0 })
		var crate := add_rigid(circle(30), Vector2(0, -500), 1, { "lock_rotation": true })
		var lowest := -1000.0
		for i in 2 * rate:
			await ticks(1)
			lowest = maxf(lowest, crate.position.y)
		check_below(lowest, 75, "lowest place of the crate at %d ticks" % rate)
		check_above(soft.get_area() / soft.get_rest_area(), 0.5, "area over rest area at %d ticks" % rate)
		for node in stage.get_children():
			node.free()
		await ticks(2)


func test_a_rigid_body_that_nothing_touches_falls_asleep() -> void:
	add_floor(100)
	var crate := add_rigid(rectangle(40, 40), Vector2(70, 80), 1)
	add_body(Vector2(0, 50))
	await seconds(4)
	check(crate.sleeping, "the crate beside a soft body is awake")


## Seconds until all of them sleep, or INF.
func _seconds_to_sleep(softs: Array[SoftBody2D], rigids: Array[RigidBody2D], limit: float) -> float:
	for i in ceili(limit * Engine.physics_ticks_per_second):
		await ticks(1)
		var all_sleep := true
		for soft in softs:
			all_sleep = all_sleep and soft.sleeping
		for rigid in rigids:
			all_sleep = all_sleep and rigid.sleeping
		if all_sleep:
			return float(i) / Engine.physics_ticks_per_second
	return INF


## A crate on a jelly, a jelly on a crate, and a plank on two jellies come to rest for good, and wake when touched.
func test_soft_and_rigid_bodies_sleep_together_and_wake_together() -> void:
	set_default_damp(0.1, 1.0) # the engine lets nothing rest that nothing damps
	for rate: int in [30, 60, 120]:
		Engine.physics_ticks_per_second = rate
		for kind: String in ["crate on jelly", "jelly on crate", "plank on two jellies"]:
			add_floor(200)
			if rate == 60: # others in the world make a difference when one goes
				add_body(Vector2(-600, 150))
			var block := { "polygon": SoftBody2D.make_box_polygon(Vector2(120, 80), 20), "stiffness": 100.0, "rolling_resistance": 0.1 }
			var softs: Array[SoftBody2D] = []
			var crate: RigidBody2D
			match kind:
				"crate on jelly":
					softs.append(add_body(Vector2(0, 158), block))
					crate = add_rigid(rectangle(60, 60), Vector2(0, 86), 0.5)
				"jelly on crate":
					crate = add_rigid(rectangle(160, 80), Vector2(0, 159), 2.0)
					softs.append(add_body(Vector2(0, 78), block))
				"plank on two jellies":
					softs.append(add_body(Vector2(-90, 158), block))
					softs.append(add_body(Vector2(90, 158), block))
					crate = add_rigid(rectangle(280, 20), Vector2(0, 106), 0.5)
			var what := "%s at %d ticks" % [kind, rate]
			var rigids: Array[RigidBody2D] = [crate]
			check_below(await _seconds_to_sleep(softs, rigids, 20), 20, "time until all sleep, " + what)
			var place := crate.position
			await seconds(2)
			check(crate.sleeping and softs[0].sleeping, "both go on sleeping, " + what)
			check_near(crate.position, place, 0.01, "place of the crate asleep, " + what)
			softs[0].apply_central_impulse(Vector2(0, -150))
			await seconds(0.3)
			if kind != "jelly on crate": # that one lies on the floor as before
				check(not crate.sleeping, "the crate wakes with the jelly, " + what)
			check_below(await _seconds_to_sleep(softs, rigids, 25), 25, "time until all sleep again, " + what)
			crate.apply_central_impulse(Vector2(0, -100 * crate.mass))
			await ticks(3)
			for soft in softs:
				check(not soft.sleeping, "the jelly wakes with the crate, " + what)
			check_below(await _seconds_to_sleep(softs, rigids, 25), 25, "time until all sleep for the third time, " + what)
			if kind == "jelly on crate":
				crate.free()
				await seconds(1)
				check_near(bounds_of(polygon_of(softs[0])).end.y, 200.0, 2, "lower side of the jelly without its crate, " + what)
			else:
				var half := 30 if kind == "crate on jelly" else 10
				for soft in softs:
					soft.free()
				await seconds(1)
				check_near(crate.position.y, 200.0 - half, 2, "y of the crate without its jelly, " + what)
			for node in stage.get_children():
				node.free()
			await ticks(2)


func test_a_soft_body_pushes_a_crate_along_the_floor() -> void:
	var ice := add_floor(100)
	ice.physics_material_override = PhysicsMaterial.new()
	ice.physics_material_override.friction = 0
	var crate := add_rigid(rectangle(60, 60), Vector2(150, 69), 1, { "linear_damp_mode": RigidBody2D.DAMP_MODE_REPLACE, "linear_damp": 0.0, "lock_rotation": true })
	var soft := add_body(Vector2(0, 68), { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0, "physics_material_override": surface(0.0) })
	await seconds(1)
	soft.apply_central_impulse(Vector2(300, 0))
	await seconds(1)
	var together := soft.get_linear_velocity().x + state_of(crate).linear_velocity.x
	check_near(together, 300.0, 9, "momentum along the floor")
	check_above(state_of(crate).linear_velocity.x, 140, "speed of the crate")


func test_lock_rotation_and_freeze_are_honored() -> void:
	var locked := add_free_rigid(rectangle(80, 80), Vector2(150, 30), 1, { "lock_rotation": true })
	var first := add_weightless_body(Vector2(0, 0))
	var frozen := add_free_rigid(rectangle(80, 80), Vector2(150, 1030), 1, { "freeze": true })
	var second := add_weightless_body(Vector2(0, 1000))
	await ticks(2)
	first.apply_central_impulse(Vector2(300, 0))
	second.apply_central_impulse(Vector2(300, 0))
	await seconds(1)
	check_above(state_of(locked).linear_velocity.x, 50, "speed of the locked body")
	check_equal(locked.rotation, 0.0, "rotation of the locked body")
	check_equal(frozen.position, Vector2(150, 1030), "place of the frozen body")
	check_below(second.get_linear_velocity().x, 20, "speed of what hit the frozen body")


func test_a_body_frozen_in_flight_is_a_wall_and_a_released_one_is_pushed() -> void:
	var rigid := add_free_rigid(rectangle(80, 80), Vector2(150, 0), 1, { "freeze": true, "freeze_mode": RigidBody2D.FREEZE_MODE_KINEMATIC })
	var soft := add_weightless_body(Vector2(0, 0), { "damping": 5.0 })
	await ticks(2)
	soft.apply_central_impulse(Vector2(200, 0))
	await seconds(1)
	check_equal(rigid.position, Vector2(150, 0), "place of the frozen body")
	rigid.freeze = false
	soft.apply_central_impulse(Vector2(200, 0) - soft.get_linear_velocity())
	await seconds(2)
	check_above(state_of(rigid).linear_velocity.x, 50, "speed of the released body")


func test_the_center_of_mass_decides_how_a_body_turns() -> void:
	var spins := PackedFloat64Array()
	for offset: float in [-30.0, 0.0, 30.0]:
		var rigid := add_free_rigid(rectangle(40, 120), Vector2(150, 0), 1,
				{ "center_of_mass_mode": RigidBody2D.CENTER_OF_MASS_MODE_CUSTOM, "center_of_mass": Vector2(0, offset), "inertia": 2000.0 })
		var soft := add_weightless_body(Vector2(0, 0), { "polygon": SoftBody2D.make_circle_polygon(30, 16) })
		await ticks(2)
		soft.apply_central_impulse(Vector2(200, 0))
		await ticks(1)
		var before := momentum_of(soft, rigid)
		await seconds(1)
		var after := momentum_of(soft, rigid)
		check_near(after.z, before.z, 200 * 30 * 0.02, "angular momentum with the center at %s" % offset)
		spins.append(state_of(rigid).angular_velocity)
		soft.free()
		rigid.free()
		await ticks(2)
	check_below(spins[0] * spins[2], -0.1, "product of the spins with the center on either side")
	check_near(spins[1], 0.0, 0.1, "spin with the center in the middle")


func test_a_crate_in_a_frozen_body_is_moved_out() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		for depth: float in [0.0, 2.0, 10.0, 25.0]:
			var body := add_body(Vector2.ZERO, { "freeze": true, "polygon": SoftBody2D.make_box_polygon(Vector2(200, 80), 20) })
			await ticks(2)
			var crate := add_rigid(rectangle(30, 50), Vector2(0, -65 + depth), 1.0)
			await seconds(3)
			var what := "of what was put %d px into a frozen body, at %d ticks" % [depth, rate]
			check_near(crate.position.y, -65.0, 0.8, "y " + what)
			check_below(crate.linear_velocity.length(), 1, "speed " + what)
			crate.free()
			body.free()
			await ticks(2)


## Both sleep when something wakes the crate within the engine's step, to which nothing was handed over.
func test_a_crate_that_is_woken_on_a_soft_body_stays_where_it_is() -> void:
	for rate in TICK_RATES:
		Engine.physics_ticks_per_second = rate
		add_floor(0)
		var body := add_body(Vector2(0, -40), { "polygon": SoftBody2D.make_box_polygon(Vector2(200, 80), 20) })
		var crate := add_rigid(rectangle(30, 50), Vector2(0, -108), 1.0)
		await seconds(12)
		check(crate.sleeping and body.sleeping, "crate and soft body do not both sleep at %d ticks" % rate)
		var level := crate.position.y
		crate.sleeping = false
		await ticks(2) # the engine has let it fall in the first
		var farthest := 0.0
		for i in rate:
			await ticks(1)
			farthest = maxf(farthest, absf(crate.position.y - level))
		check_below(farthest, 0.15, "way of the woken crate in px at %d ticks" % rate)
		for node in stage.get_children():
			node.free()
		await ticks(2)
