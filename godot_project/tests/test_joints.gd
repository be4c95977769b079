# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies that are tied to one another, to rigid bodies and to the world.


func join(place: Vector2, a: Node2D, b: Node2D, properties := {}) -> SoftBodyJoint2D:
	var joint := SoftBodyJoint2D.new()
	joint.position = place
	stage.add_child(joint)
	joint.node_a = joint.get_path_to(a) if a != null else NodePath()
	joint.node_b = joint.get_path_to(b) if b != null else NodePath()
	for property: String in properties:
		joint.set(property, properties[property])
	return joint


func test_a_body_hangs_from_the_world() -> void:
	var body := add_body(Vector2.ZERO)
	var joint := join(Vector2(0, -50), body, null)
	await seconds(4)
	check_near(joint.get_anchor_a(), Vector2(0, -50), 0.5, "the anchor on the body")
	check_near(body.get_center_of_mass_position().x, 0.0, 5.0, "x of the hanging body")
	check_above(body.get_center_of_mass_position().y, -5, "y of the hanging body")


func test_two_bodies_hang_together() -> void:
	var upper := add_body(Vector2.ZERO)
	var lower := add_body(Vector2(0, 100))
	join(Vector2(0, -50), upper, null)
	var joint := join(Vector2(0, 50), upper, lower)
	await seconds(4)
	check_below(joint.get_anchor_a().distance_to(joint.get_anchor_b()), 1, "gap between the bodies")
	check_above(lower.get_center_of_mass_position().y, upper.get_center_of_mass_position().y + 60, "y of the lower body")


func test_a_joint_to_a_rigid_body_follows_it() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var crate := RigidBody2D.new()
	var shape := CollisionShape2D.new()
	shape.shape = rectangle(40, 40)
	crate.add_child(shape)
	crate.position = Vector2(120, 0)
	crate.gravity_scale = 0
	stage.add_child(crate)
	var joint := join(Vector2(60, 0), body, crate)
	await ticks(5)
	crate.linear_velocity = Vector2(100, 0)
	await seconds(2)
	check_near(joint.get_anchor_b(), crate.to_global(Vector2(-60, 0)), 1.0, "the anchor on the crate")
	check_above(body.get_center_of_mass_position().x, 60, "x of the body that is pulled along")
	check_below(joint.get_anchor_a().distance_to(joint.get_anchor_b()), 15, "gap of the joint")


func _add_crate(position: Vector2, mass := 1.0) -> RigidBody2D:
	var crate := RigidBody2D.new()
	var shape := CollisionShape2D.new()
	shape.shape = rectangle(40, 40)
	crate.add_child(shape)
	crate.position = position
	crate.mass = mass
	crate.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	crate.angular_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	stage.add_child(crate)
	return crate


func test_a_joint_to_a_rigid_body_pulls_both_ways() -> void:
	for mass: float in [0.2, 1.0, 5.0]:
		var body := add_weightless_body(Vector2.ZERO)
		var crate := _add_crate(Vector2(90, 0), mass)
		crate.gravity_scale = 0
		var joint := join(Vector2(60, 0), body, crate)
		await ticks(5)
		crate.linear_velocity = Vector2(100, 0)
		await seconds(2)
		# Together they go on with what one had.
		var momentum := crate.linear_velocity * mass + body.linear_velocity * body.mass
		check_near(momentum.x, 100.0 * mass, 1.0 * mass, "momentum of a pair with a crate of %s kg" % mass)
		check_near(body.get_center_of_mass_position().x + mass * (crate.position.x - 90), 200.0 * mass, 6.0 * mass,
				"way of the center of mass of both, times the mass, with a crate of %s kg" % mass)
		check_below(joint.get_anchor_a().distance_to(joint.get_anchor_b()), 10 + 2, "gap of the joint to a crate of %s kg" % mass)
		body.free()
		crate.free()
		joint.free()


func test_a_body_tied_to_a_crate_sleeps_with_it_until_the_crate_is_gone() -> void:
	add_floor(0)
	var crate := _add_crate(Vector2(0, -20), 5.0)
	var body := add_body(Vector2(120, -50))
	join(Vector2(60, -20), body, crate)
	await seconds(12)
	check(body.sleeping and crate.sleeping, "both sleep")
	await ticks(30)
	check(body.sleeping, "and sleep on")
	add_weightless_body(Vector2(900, -600))
	await ticks(3)
	check(body.sleeping, "also when another body comes")
	crate.global_position.x -= 40 # read first, or the engine takes no notice
	await ticks(3)
	check(not body.sleeping, "the body wakes when the crate is put elsewhere")
	await seconds(12)
	check(body.sleeping, "it sleeps again")
	crate.free()
	await ticks(3)
	check(not body.sleeping, "the body wakes when the crate is gone")


func test_a_joined_rigid_body_does_not_collide_unless_told_to() -> void:
	for collides: bool in [false, true]:
		var body := add_weightless_body(Vector2.ZERO)
		var crate := _add_crate(Vector2(60, 0))
		crate.gravity_scale = 0
		# On a line, so that the two may part.
		var joint := join(Vector2(60, 0), body, crate, { "disable_collision": not collides, "rigid": false, "stiffness": 0.0 })
		await seconds(2)
		var distance := crate.position.x - body.get_center_of_mass_position().x
		if collides:
			check_above(distance, 65, "distance of a crate that overlapped the body, colliding")
		else:
			check_near(distance, 60.0, 0.1, "distance of a crate that overlaps the body")
			joint.free()
			await seconds(2)
			check_above(crate.position.x - body.get_center_of_mass_position().x, 65, "distance without the joint")
		_clear()
		await ticks(2)


## A crate far below, where no soft body comes near it, on a line.
func test_a_crate_hangs_on_a_soft_body() -> void:
	for rigid: bool in [true, false]:
		var body := add_body(Vector2.ZERO)
		join(Vector2(0, -50), body, null)
		var crate := _add_crate(Vector2(0, 1500), 0.5)
		var joint := join(Vector2(0, 50), body, crate, { "rigid": rigid, "length": 1430.0, "stiffness": 200.0, "damping": 2.0 })
		joint.position = Vector2(0, 1480)
		await seconds(10)
		check_below(crate.linear_velocity.length(), 5, "speed of the hanging crate")
		# A spring of 200 N/m is stretched by 0.5 * 980 / 200 px.
		var gap := joint.get_anchor_a().distance_to(joint.get_anchor_b())
		check_near(gap, 1430.0 if rigid else 1430 + 0.5 * GRAVITY / 200, 2, "length of the line, rigid: %s" % rigid)
		check_near(crate.global_position.x, 0.0, 2, "x of the hanging crate")
		_clear()
		await ticks(2)


func _clear() -> void:
	for node in stage.get_children():
		node.free()


func test_a_joint_that_breaks_says_so_once_and_can_be_mended() -> void:
	var body := add_body(Vector2.ZERO)
	var weight := 1.0 * GRAVITY
	var joint := join(Vector2(0, -50), body, null, {"break_force": 0.5 * weight})
	var counter := {"broken": 0}
	joint.broken.connect(func() -> void: counter.broken += 1)
	await seconds(1)
	check_equal(counter.broken, 1, "times that it broke")
	check(joint.is_broken(), "it is broken")
	check_above(body.get_center_of_mass_position().y, 100, "y of the falling body")
	joint.break_force = 0
	joint.global_position = body.global_position + Vector2(0, -50)
	joint.mend()
	await seconds(0.2)
	check(not joint.is_broken(), "it holds again")
	var strong := join(Vector2(600, -50), add_body(Vector2(600, 0)), null, {"break_force": 20 * weight})
	await seconds(3)
	check(not strong.is_broken(), "a joint that bears twenty times the weight holds")


func test_joined_bodies_collide_only_if_they_shall() -> void:
	var overlaps := {}
	for disable: bool in [true, false]:
		var network := {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK} # still swings then
		var a := add_weightless_body(Vector2(0, 0), network)
		var b := add_weightless_body(Vector2(90, 0), network) # ten pixels in one another
		var joint := join(Vector2(45, 0), a, b, {"disable_collision": disable, "length": 0.0})
		await seconds(1)
		overlaps[disable] = 100 - a.get_center_of_mass_position().distance_to(b.get_center_of_mass_position())
		joint.free()
		a.free()
		b.free()
	check_above(overlaps[true], overlaps[false] + 1, "overlap of bodies that do not collide, in px, against those that do")


func test_a_joint_outlives_the_leaving_of_its_bodies() -> void:
	var body := add_body(Vector2.ZERO)
	var joint := join(Vector2(0, -50), body, null)
	await ticks(10)
	stage.remove_child(body)
	await ticks(5)
	stage.add_child(body)
	await seconds(2)
	check_near(joint.get_anchor_a(), Vector2(0, -50), 1.0, "the anchor on the body")
	body.free()
	await ticks(5)
	check(not joint.is_broken(), "a joint without its body is not broken")


func test_joints_without_a_soft_body_warn() -> void:
	var joint := join(Vector2.ZERO, add_solid(circle(10)), null)
	check(" ".join(joint.get_warnings()).contains("Neither end"), "a warning says so")
	check_refused(func() -> void: joint.stiffness = -1, ["stiffness", "-1", ">= 0"], "a negative stiffness")
	await ticks(3)
	var errors := take_errors()
	check(errors.size() == 1 and "joins nothing" in errors[0], "it says once that it joins nothing: %s" % errors)


func test_the_world_s_end_may_be_a_node_that_moves() -> void:
	var rail := Node2D.new()
	stage.add_child(rail)
	var body := add_weightless_body(Vector2(0, 60))
	var joint := join(Vector2(0, 10), body, rail)
	await ticks(5)
	for i in 60:
		rail.position.x += 3
		await ticks(1)
	check_near(joint.get_anchor_b(), Vector2(180, 10), 0.01, "the anchor on the rail")
	check_below(joint.get_anchor_a().distance_to(joint.get_anchor_b()), 4, "gap between body and rail")


func test_a_joint_whose_path_leads_nowhere_says_so_once() -> void:
	var body := add_weightless_body()
	body.name = "Jelly"
	var joint := join(Vector2(50, 0), body, body)
	joint.node_b = ^"../Nowhere"
	check(" ".join(joint.get_warnings()).contains("Nowhere"), "a warning names the path: %s" % joint.get_warnings())
	take_errors()
	await seconds(0.5)
	check_equal(take_errors().size(), 0, "errors while the end may still come")
	await seconds(2)
	var errors := take_errors()
	if check_equal(errors.size(), 1, "errors of a joint without an end"):
		check("node_b" in errors[0] and "../Nowhere" in errors[0], "the error names end and path: %s" % errors[0])
	var late := Node2D.new()
	late.name = "Nowhere"
	late.position = Vector2(50, 0)
	stage.add_child(late)
	joint.node_b = joint.get_path_to(late)
	await ticks(2)
	late.position.x = 150
	await seconds(1)
	check_above(body.get_center_of_mass_position().x, 50, "x of the body that is pulled by the end that came")


## A PinJoint2D that names a soft body holds nothing, and its own warning is in the editor only.
func test_godots_own_joints_to_a_soft_body_name_the_node_to_use() -> void:
	if not is_debug_build():
		return
	var crate := _add_crate(Vector2(0, -200))
	crate.gravity_scale = 0
	var body := add_weightless_body()
	for own: Joint2D in [PinJoint2D.new(), DampedSpringJoint2D.new()]:
		take_errors()
		stage.add_child(own)
		own.node_a = own.get_path_to(crate)
		own.node_b = own.get_path_to(body)
		await ticks(3)
		var errors := take_errors()
		if check_equal(errors.size(), 1, "warnings of a " + own.get_class()):
			check(own.get_class() in errors[0] and "SoftBodyJoint2D" in errors[0] and "node_b" in errors[0], "the warning names them: %s" % errors[0])
	var between_rigid := PinJoint2D.new()
	between_rigid.node_a = ^"../Nobody"
	stage.add_child(between_rigid)
	await ticks(3)
	check_equal(take_errors().size(), 0, "warnings of a joint that has nothing to do with soft bodies")


## Ten capsules in a row, tied to one another, the first pinned to a node: the returned dictionary's "mouse".
func _add_chain(place: Vector2) -> Dictionary:
	var bodies: Array[SoftBody2D] = []
	var joints: Array[SoftBodyJoint2D] = []
	for i in 10:
		bodies.append(add_body(place + Vector2(90 * i, 0), {
			"polygon": SoftBody2D.make_capsule_polygon(20, 90, 12), "rotation": PI / 2 }))
		if i > 0:
			joints.append(join(place + Vector2(90 * i - 45, 0), bodies[i - 1], bodies[i]))
	var points := bodies[0].get_point_positions()
	var outer := 0
	for i in points.size():
		outer = i if points[i].x < points[outer].x else outer
	var mouse := Node2D.new()
	mouse.position = points[outer]
	stage.add_child(mouse)
	bodies[0].set_point_pinned(outer, true, bodies[0].get_path_to(mouse))
	return { "bodies": bodies, "joints": joints, "mouse": mouse }


func _kinetic_energy(chains: Array[Dictionary]) -> float:
	var energy := 0.0
	for chain in chains:
		for body: SoftBody2D in chain.bodies:
			energy += body.get_kinetic_energy()
	return energy


func test_chains_that_a_mouse_has_shaken_by_100_px_a_tick_have_their_shapes_back_within_3_s() -> void:
	set_default_damp(0.1, 1) # as in a new project
	var random := RandomNumberGenerator.new()
	random.seed = 23
	var chains: Array[Dictionary] = []
	for i in 48:
		@warning_ignore("integer_division")
		chains.append(_add_chain(Vector2(6000 * (i % 10), 6000 * (i / 10))))
	await ticks(20)
	for tick in 120:
		for i in chains.size():
			# Most mice jump by 100 px, some by up to 100 px, some stay within 100 px of their place.
			var jump := Vector2.from_angle(random.randf() * TAU) * 100 * (1.0 if i % 6 < 4 else random.randf())
			var mouse: Node2D = chains[i].mouse
			var home := Vector2(6000 * (i % 10) - 45, 6000 * (i / 10)) if i % 6 == 5 else mouse.position
			mouse.position = home + jump
		await ticks(1)
	await seconds(3)
	var widest := 0.0
	var least := INF
	for chain in chains:
		for joint: SoftBodyJoint2D in chain.joints:
			widest = maxf(widest, joint.get_anchor_a().distance_to(joint.get_anchor_b()))
		for body: SoftBody2D in chain.bodies:
			var turn := 1.0 if Geometry2D.is_polygon_clockwise(body.polygon) == Geometry2D.is_polygon_clockwise(polygon_of(body)) else -1.0
			least = minf(least, turn * absf(body.get_area()) / body.get_rest_area())
	check_below(widest, 1, "widest gap of a joint in px")
	check_above(least, 0.6, "least area of a body as a share of its rest area, negative if it is inside out")
	var energy := _kinetic_energy(chains)
	await seconds(15)
	check_below(_kinetic_energy(chains), 0.2 * energy, "kinetic energy after 15 more seconds")
