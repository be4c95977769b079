# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The body as a whole obeys the words of RigidBody2D, with their meaning.


## A soft body, and a RigidBody2D of its mass, place and inertia.
func _pair() -> Array:
	var soft := add_weightless_body(Vector2(40, -30), {"mass": 2.0})
	var rigid := RigidBody2D.new()
	rigid.mass = 2
	rigid.inertia = soft.inertia
	rigid.gravity_scale = 0
	rigid.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	rigid.angular_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	rigid.linear_damp = 0
	rigid.angular_damp = 0
	rigid.position = Vector2(40, -330)
	stage.add_child(rigid)
	return [soft, rigid]


func _check_same_motion(soft: SoftBody2D, rigid: RigidBody2D, what: String) -> void:
	check_near(soft.linear_velocity, rigid.linear_velocity, 0.02 + 1e-3 * rigid.linear_velocity.length(), what + ": velocity")
	check_near(soft.angular_velocity, rigid.angular_velocity, 1e-3 + 0.01 * absf(rigid.angular_velocity), what + ": spin")


func test_impulses_and_forces_do_what_they_do_to_a_rigid_body() -> void:
	for push: Array in [["apply_impulse", Vector2(30, 40), Vector2(0, 20)], ["apply_impulse", Vector2(30, -10)],
			["apply_central_impulse", Vector2(-60, 10)], ["apply_torque_impulse", 900.0]]:
		var pair := _pair()
		var soft: SoftBody2D = pair[0]
		var rigid: RigidBody2D = pair[1]
		await ticks(2)
		for body: Node2D in pair:
			body.callv(push[0], push.slice(1))
		await ticks(2)
		_check_same_motion(soft, rigid, "%s" % [push])
		check_above(soft.linear_velocity.length() + absf(soft.angular_velocity), 0.1, "effect of %s" % [push])
		soft.free()
		rigid.free()


func test_forces_last_for_one_tick_and_constant_ones_for_good() -> void:
	for push: Array in [["apply_force", Vector2(600, 0), Vector2(0, 10)], ["apply_central_force", Vector2(0, 900)],
			["apply_torque", 40000.0]]:
		var pair := _pair()
		var soft: SoftBody2D = pair[0]
		await ticks(1)
		soft.callv(push[0], push.slice(1))
		await ticks(1)
		var force: Vector2 = push[1] if push[1] is Vector2 else Vector2.ZERO
		var torque: float = push[1] if push[1] is float else (push[2] as Vector2).cross(force) if push.size() > 2 else 0.0
		for i in 3:
			check_near(soft.linear_velocity, force / 2 / 60, 0.01, "velocity after %s" % [push])
			check_near(soft.angular_velocity, torque / soft.inertia / 60, 0.01 * absf(torque / soft.inertia / 60) + 1e-4, "spin after %s" % [push])
			await ticks(1)
		for body: Node2D in pair:
			body.free()
	var lasting: SoftBody2D = _pair()[0]
	lasting.constant_force = Vector2(120, 0)
	lasting.add_constant_central_force(Vector2(0, 60))
	lasting.add_constant_torque(5000.0)
	await ticks(30)
	check_near(lasting.linear_velocity, Vector2(30, 15), 0.1, "velocity after half a second")
	check_near(lasting.angular_velocity, 5000.0 / lasting.inertia / 2, 0.02, "spin after half a second")
	check_equal(lasting.constant_force, Vector2(120, 60), "constant force")
	var torque_before := lasting.constant_torque
	lasting.add_constant_force(Vector2(10, 0), lasting.get_center_of_mass_position() - lasting.global_position + Vector2(0, 3))
	check_near(lasting.constant_torque, torque_before - 30, 0.01, "constant torque of a force beside the middle")


func test_an_impulse_does_not_deform_the_body() -> void:
	var body := add_weightless_body()
	body.apply_impulse(Vector2(500, 0), Vector2(0, -30))
	await ticks(30)
	for i in body.get_spring_count():
		check_near(body.get_spring_strain(i), 0.0, 0.03, "strain of spring %d, of which the spin makes a little" % i)


func test_velocities_can_be_set_before_and_after_the_body_is_made() -> void:
	var body := SoftBody2D.new()
	body.gravity_scale = 0
	body.linear_velocity = Vector2(60, -20)
	body.angular_velocity = 1.5
	check_equal(body.linear_velocity, Vector2(60, -20), "velocity outside the tree")
	check_equal(body.angular_velocity, 1.5, "spin outside the tree")
	stage.add_child(body)
	check_near(body.linear_velocity, Vector2(60, -20), 1e-3, "velocity in the tree")
	check_near(body.angular_velocity, 1.5, 1e-4, "spin in the tree")
	await ticks(60)
	check_near(body.get_center_of_mass_position(), Vector2(60, -20), 1, "place after a second")
	check_near(body.rotation, 1.5, 0.03, "rotation after a second")
	body.linear_velocity = Vector2(0, 10)
	check_near(body.linear_velocity, Vector2(0, 10), 1e-3, "velocity once set")
	check_near(body.angular_velocity, 1.5, 0.02, "spin, which was not set")
	body.angular_velocity = -0.5
	check_near(body.linear_velocity, Vector2(0, 10), 1e-3, "velocity, which was not set")
	check_near(body.angular_velocity, -0.5, 1e-3, "spin once set")
	check_refused(func() -> void: body.linear_velocity = Vector2(NAN, 0), ["linear_velocity"], "a velocity of NAN")
	check_refused(func() -> void: body.angular_velocity = INF, ["angular_velocity"], "a spin of INF")
	check_near(body.linear_velocity, Vector2(0, 10), 1e-3, "velocity after a refused one")


func test_mass_inertia_and_center_of_mass_are_those_of_the_points() -> void:
	var polygon := SoftBody2D.make_box_polygon(Vector2(120, 40), 20)
	for i in polygon.size():
		polygon[i] += Vector2(30, 10)
	var body := SoftBody2D.new()
	body.gravity_scale = 0
	body.polygon = polygon
	body.mass = 3
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK # whose points are equally heavy
	var expected := 0.0
	for point in polygon:
		expected += (point - Vector2(30, 10)).length_squared() * 3 / (polygon.size() + 1)
	for in_tree: bool in [false, true]:
		if in_tree:
			body.position = Vector2(200, 100)
			body.rotation = 1
			stage.add_child(body)
		check_near(body.inertia, expected, expected * 1e-4, "inertia, in the tree: %s" % in_tree)
		check_near(body.center_of_mass, Vector2(30, 10), 0.01, "center of mass, in the tree: %s" % in_tree)
	check_near(body.get_center_of_mass_position(), Vector2(200, 100) + Vector2(30, 10).rotated(1), 0.01, "center of mass in the world")
	body.set_point_position(0, body.get_point_positions()[0] + Vector2(-300, 0).rotated(1))
	check_above(body.inertia, expected * 1.5, "inertia of a stretched body")


func test_a_resting_body_sleeps_and_says_so() -> void:
	add_floor(50)
	var body := add_body()
	var told: Array[bool] = []
	body.sleeping_state_changed.connect(func() -> void: told.append(body.sleeping))
	await seconds(6)
	check(body.sleeping, "the body does not sleep")
	check_equal(told, [true] as Array[bool], "what was told")
	body.apply_central_impulse(Vector2(0, -100))
	check(not body.sleeping, "the pushed body sleeps")
	await ticks(2)
	check_equal(told, [true, false] as Array[bool], "what was told after the push")
	await seconds(6)
	check_equal(told, [true, false, true] as Array[bool], "what was told at the end")
	for wake: Callable in [func() -> void: body.apply_force(Vector2(0, -1)), func() -> void: body.apply_torque(1),
			func() -> void: body.linear_velocity = Vector2(0, -1), func() -> void: body.stiffness = 101,
			func() -> void: body.apply_point_force(0, Vector2(0, -1)), func() -> void: body.position.y -= 10]:
		body.sleeping = true
		await ticks(1)
		check(body.sleeping, "the body cannot be put to sleep")
		wake.call()
		await ticks(1)
		check(not body.sleeping, "the body sleeps on")


func test_sleep_can_be_forbidden_and_forced() -> void:
	add_floor(50)
	var wakeful := add_body(Vector2.ZERO, {"can_sleep": false})
	var hung := add_body(Vector2(300, -200), {"sleeping": true})
	var told: Array[bool] = []
	hung.sleeping_state_changed.connect(func() -> void: told.append(hung.sleeping))
	await seconds(5)
	check(not wakeful.sleeping, "a body that may not sleep sleeps")
	check(hung.sleeping, "a body that was put to sleep is awake")
	check_near(hung.get_center_of_mass_position(), Vector2(300, -200), 0.01, "where it hangs")
	check_equal(told.size(), 0, "signals about sleep that was set")
	hung.sleeping = false
	check(not hung.sleeping, "a body that was woken sleeps")
	await ticks(30)
	check_above(hung.get_center_of_mass_position().y, -150, "y of the woken body")
	check_equal(told.size(), 0, "signals about waking that was set")


func test_a_frozen_body_holds_what_lies_on_it_and_goes_on_when_it_is_let_go() -> void:
	var body := add_body(Vector2.ZERO, {"freeze": true, "polygon": SoftBody2D.make_box_polygon(Vector2(200, 100), 25)})
	var upper := add_body(Vector2(0, -110), {"stiffness": 150.0})
	var points := body.get_point_positions()
	await seconds(3)
	body.apply_central_impulse(Vector2(100, 0))
	body.constant_force = Vector2(100, 0)
	await ticks(5)
	check_equal(body.get_point_positions(), points, "points of the frozen body")
	check_near(body.linear_velocity, Vector2.ZERO, 1e-4, "its velocity")
	check_below(upper.get_center_of_mass_position().y, -60, "y of the body on top")
	body.constant_force = Vector2.ZERO
	body.position += Vector2(0, 20)
	await ticks(1)
	check_near(body.get_center_of_mass_position(), Vector2(0, 20), 0.01, "place of the frozen body that was moved")
	body.freeze = false
	await ticks(30)
	check_above(body.get_center_of_mass_position().y, 80, "y of the body that was let go")


func test_points_are_read_and_set_as_arrays() -> void:
	var body := add_weightless_body(Vector2(10, 20))
	var places := body.get_point_positions()
	var stretched := Transform2D(0, Vector2(1.2, 0.9), 0, Vector2(5, 0)) * places
	body.set_point_positions(stretched)
	check_points_near(body.get_point_positions(), stretched, 0.01, "points and where they were put")
	check_near(body.global_position, body.get_center_of_mass_position(), 0.01, "node and body")
	var velocities := PackedVector2Array()
	for i in body.get_point_count():
		velocities.append(Vector2(i, -i))
	body.set_point_velocities(velocities)
	check_points_near(body.get_point_velocities(), velocities, 1e-4, "velocities and what was set")
	body.set_point_velocity(3, Vector2(7, 8))
	check_near(body.get_point_velocities()[3], Vector2(7, 8), 1e-4, "velocity of one point")
	body.set_point_velocities(PackedVector2Array(velocities.duplicate()))
	var forces := PackedVector2Array()
	for i in body.get_point_count():
		forces.append(Vector2(0, i))
	body.apply_point_forces(forces)
	body.apply_point_force(2, Vector2(1, 0))
	forces[2] += Vector2(1, 0)
	check_points_near(body.get_point_forces(), forces, 1e-4, "forces and what was applied")
	var before := body.linear_velocity
	await ticks(1)
	check_near(body.linear_velocity - before, Vector2(1, 136) / 60, 0.01, "what the forces did")
	check_equal(body.get_point_forces()[2], Vector2.ZERO, "force after the tick")
	check_refused(func() -> void: body.set_point_positions(PackedVector2Array([Vector2.ZERO])), ["positions", "1 entries", "17"], "too few positions")
	velocities[4].x = NAN
	check_refused(func() -> void: body.set_point_velocities(velocities), ["velocities[4]"], "a velocity of NAN")
	check_refused(func() -> void: body.set_point_position(17, Vector2.ZERO), ["17"], "a point that is not there")


func test_a_reversed_polygon_is_set_in_its_own_order() -> void:
	var polygon := SoftBody2D.make_box_polygon(Vector2(100, 60), 50)
	polygon.reverse()
	var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon})
	var places := body.get_point_positions()
	places[1] += Vector2(3, 4)
	body.set_point_positions(places)
	check_points_near(body.get_point_positions(), places, 0.01, "points and where they were put")
	body.apply_point_force(1, Vector2(5, 0))
	check_equal(body.get_point_forces()[1], Vector2(5, 0), "force on the second point")


func test_teleport_moves_the_body_as_it_is_and_draws_nothing_between() -> void:
	var body := add_body()
	await ticks(20)
	body.apply_point_impulse(0, Vector2(20, 0))
	await ticks(2)
	var area := body.get_area()
	var velocity := body.linear_velocity
	body.teleport(Transform2D(0, Vector2(900, -400)))
	check_near(body.get_center_of_mass_position(), Vector2(900, -400), 1, "place")
	check_near(body.linear_velocity, velocity, 0.01, "velocity")
	check_near(body.get_area(), area, 1, "area")
	for fraction: float in [0.0, 0.5, 1.0]:
		check_near(bounds_of(body.get_interpolated_polygon(fraction)).get_center(), Vector2(900, -400), 15, "drawn at %s" % fraction)
	check_refused(func() -> void: body.teleport(Transform2D(0, Vector2(NAN, 0))), ["teleport"], "a place that is none")


func test_a_paused_body_gathers_no_constant_force() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"constant_force": Vector2(60, 0), "process_mode": Node.PROCESS_MODE_DISABLED})
	await ticks(30)
	body.process_mode = Node.PROCESS_MODE_INHERIT
	await ticks(1)
	check_near(body.linear_velocity, Vector2(1, 0), 0.01, "velocity a tick after the pause")


func test_an_axis_velocity_is_that_of_a_rigid_body() -> void:
	for velocity: Vector2 in [Vector2(0, -300), Vector2(30, 40), Vector2.ZERO]:
		var pair := _pair()
		for body: Node2D in pair:
			body.set("linear_velocity", Vector2(120, 50))
			body.call("set_axis_velocity", velocity)
		await ticks(2)
		_check_same_motion(pair[0], pair[1], "axis velocity %s" % velocity)
		for body: Node2D in pair:
			body.free()


func test_gravity_is_that_of_a_rigid_body() -> void:
	for place: Vector2 in [Vector2.ZERO, Vector2(5000, 0)]:
		var area := Area2D.new()
		area.gravity_space_override = Area2D.SPACE_OVERRIDE_REPLACE
		area.gravity = 333
		area.gravity_direction = Vector2(0.6, -0.8)
		area.add_child(CollisionShape2D.new())
		(area.get_child(0) as CollisionShape2D).shape = rectangle(4000, 4000)
		area.position = Vector2(5000, 0)
		stage.add_child(area)
		var soft := add_body(place, {"gravity_scale": 0.5})
		var rigid := RigidBody2D.new()
		rigid.add_child(CollisionShape2D.new())
		(rigid.get_child(0) as CollisionShape2D).shape = circle(10)
		rigid.gravity_scale = 0.5
		rigid.position = place + Vector2(200, 0)
		stage.add_child(rigid)
		await ticks(6)
		check_near(soft.get_gravity(), rigid.get_gravity(), 0.01, "gravity at %s" % place)
		check_above(soft.get_gravity().length(), 100, "gravity at %s" % place)
		for node: Node in [area, soft, rigid]:
			node.free()


func test_a_locked_body_does_not_turn_whatever_pushes_it() -> void:
	var slope := add_solid(rectangle(4000, 100), Transform2D(deg_to_rad(15), Vector2(0, 60)))
	var free := add_body(Vector2(400, 47), {"physics_material_override": surface(1)})
	var locked := add_body(Vector2(0, -60), {"lock_rotation": true, "physics_material_override": surface(1)})
	var largest := 0.0
	await seconds(2)
	check_above(absf(free.rotation), 0.5, "rotation of a body that may turn")
	free.free()
	var place := locked.global_position
	for i in 180:
		await ticks(1)
		largest = maxf(largest, absf(locked.rotation))
	check_below(largest, deg_to_rad(1.5), "rotation of the locked body on the slope")
	check_near(locked.global_position, place, 3, "place of the locked body, which does not roll down")
	slope.free()
	var flying := add_weightless_body(Vector2(2000, 0), {"lock_rotation": true, "rotation": 0.5})
	flying.apply_impulse(Vector2(300, 0), Vector2(0, -40))
	flying.linear_velocity.y = 50
	for i in 30:
		await ticks(1)
		check_near(flying.rotation, 0.5, deg_to_rad(1.8), "rotation of a body that was hit beside its middle")
	check_near(flying.linear_velocity, Vector2(300, 50), 1, "its velocity")
	flying.rotation = -1
	await ticks(10)
	check_near(flying.rotation, -1.0, 0.01, "rotation that the node was given")
	flying.lock_rotation = false
	flying.angular_velocity = 2
	await ticks(30)
	check_near(flying.rotation, 0.0, 0.05, "rotation of a body that was unlocked")


func test_a_locked_body_falls_asleep() -> void:
	add_floor(50)
	var body := add_body(Vector2.ZERO, {"lock_rotation": true})
	await seconds(6)
	check(body.sleeping, "the body does not sleep")
	check_near(body.rotation, 0.0, deg_to_rad(0.5), "its rotation")


func test_a_negative_scale_of_x_stays_wherever_it_was_set() -> void:
	var parent := Node2D.new()
	parent.scale = Vector2(2, 2)
	stage.add_child(parent)
	var outside := SoftBody2D.new()
	outside.gravity_scale = 0.0
	outside.angular_velocity = 1
	outside.scale = Vector2(-1, 1)
	stage.add_child(outside)
	await ticks(3)
	check_near(outside.scale, Vector2(-1, 1), 1e-3, "scale that was set outside of the tree")
	stage.remove_child(outside)
	outside.scale.x = 1
	stage.add_child(outside)
	await ticks(3)
	check_near(outside.scale, Vector2(1, 1), 1e-3, "scale that was set back outside of the tree")
	outside.scale.x = -1
	await ticks(3)
	check_near(outside.scale, Vector2(-1, 1), 1e-3, "scale that was set inside")
	outside.reparent(parent, false)
	await ticks(3)
	check_near(outside.scale, Vector2(-1, 1), 1e-3, "scale under another parent")
	parent.free()


## As a platformer turns its player about. The body is told in each tick what the node's scale is.
func test_a_scale_that_is_set_to_minus_one_in_every_tick_stays_so() -> void:
	for parent_transform: Transform2D in [Transform2D.IDENTITY, Transform2D(0.4, Vector2(30, 20)), Transform2D(0, Vector2(2, 2), 0, Vector2.ZERO), Transform2D(0, Vector2(-1, 1), 0, Vector2.ZERO)]:
		var parent := Node2D.new()
		parent.transform = parent_transform
		stage.add_child(parent)
		var body := add_weightless_body(Vector2(0, -100))
		body.polygon = PackedVector2Array([Vector2(-50, -50), Vector2(70, -40), Vector2(50, 50), Vector2(-50, 50)])
		body.reparent(parent, false)
		body.angular_velocity = 1
		await ticks(1)
		var built := 0
		var turn_before := 0.0
		for i in 60:
			body.scale.x = -1
			await ticks(1)
			check_near(body.scale, Vector2(-1, 1), 1e-3, "scale in tick %d under %s" % [i, parent_transform])
			if i == 2:
				built = SoftBodySimulation2D.get_built_shape_count()
				turn_before = body.rotation
		check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes built while the scale stays")
		check_near(absf(angle_difference(turn_before, body.rotation)), 57 / 60.0, 0.05, "turn meanwhile under %s" % parent_transform)
		var lean := body.global_transform.determinant() * parent_transform.determinant()
		check_below(lean, 0, "determinant of the mirrored body")
		check_points_near(polygon_of(body), body.global_transform * body.polygon, 2.0, "points and node")
		body.scale.x = 1
		await ticks(2)
		check_near(body.scale, Vector2(1, 1), 1e-3, "scale that is set back")
		parent.free()
