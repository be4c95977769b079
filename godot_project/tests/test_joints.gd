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
		var a := add_weightless_body(Vector2(0, 0))
		var b := add_weightless_body(Vector2(90, 0)) # ten pixels in one another
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
