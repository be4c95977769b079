# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Nodes that are carried along by the surface of a body.


func attach(body: SoftBody2D, place: Vector2) -> SoftBodyAttachment2D:
	var attachment := SoftBodyAttachment2D.new()
	attachment.position = place
	body.add_child(attachment)
	return attachment


func test_an_attachment_goes_with_a_body_that_flies_and_spins() -> void:
	var body := add_weightless_body(Vector2(100, 50))
	var eye := attach(body, Vector2(20, -10))
	var hat := attach(body, Vector2(0, -70))
	body.linear_velocity = Vector2(120, 40)
	body.angular_velocity = 2
	await seconds(1)
	check_near(eye.global_position, body.to_global(Vector2(20, -10)), 0.5, "the eye")
	check_near(hat.global_position, body.to_global(Vector2(0, -70)), 1.0, "the hat")
	check_near(eye.global_rotation, body.global_rotation, 0.02, "rotation of the eye")


func test_an_attachment_at_a_polygon_point_stays_on_it_however_the_body_deforms() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -120))
	var dot := attach(body, body.polygon[4]) # the lowest point, which hits the floor
	for i in 90:
		await ticks(1)
		await tree.process_frame # before the frame is drawn, the dot is where the tick left its point
		check_near(dot.global_position, body.get_point_positions()[4], 0.05, "the dot beside its point")


func test_an_attachment_sinks_with_the_flesh_under_a_load() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -51), {"stiffness": 60.0})
	var top := attach(body, Vector2(0, -50))
	await seconds(3)
	var polygon := polygon_of(body)
	check_near(top.global_position, polygon[12], 0.5, "the attachment on the highest point")
	check_above(top.global_position.y - body.global_position.y, -49.9, "how far the top has sunk")


func test_what_does_not_follow_rotation_stays_upright() -> void:
	var body := add_weightless_body()
	var name_tag := attach(body, Vector2(0, -60))
	name_tag.follow_rotation = false
	body.angular_velocity = 3
	await seconds(1)
	check_near(name_tag.rotation, 0.0, 1e-4, "rotation of the tag in the body's frame")


func test_attach_at_moves_it_to_another_place() -> void:
	var body := add_weightless_body()
	var eye := attach(body, Vector2(20, 0))
	await ticks(2)
	eye.attach_at(Vector2(-30, 5), 0.5)
	await ticks(2)
	check_near(eye.position, Vector2(-30, 5), 0.05, "position")
	check_near(eye.rotation, 0.5, 0.01, "rotation")
	check_equal(eye.get_rest_position(), Vector2(-30, 5), "rest position")
	check_refused(func() -> void: eye.attach_at(Vector2(NAN, 0)), ["position", "finite"], "a place that is no number")


func test_an_attachment_outside_of_a_body_says_so() -> void:
	var lost := SoftBodyAttachment2D.new()
	stage.add_child(lost)
	check(" ".join(lost.get_warnings()).contains("child of a SoftBody2D"), "a warning says so")
	await ticks(2)
	check_equal(lost.position, Vector2.ZERO, "position")


func test_a_new_polygon_takes_the_attachment_along() -> void:
	var body := add_weightless_body()
	var eye := attach(body, Vector2(10, 0))
	await ticks(2)
	body.polygon = SoftBody2D.make_circle_polygon(30, 24)
	await ticks(2)
	check_near(eye.position, Vector2(10, 0), 0.05, "place on the new polygon")


## A squashed body with an eye on its top, which has moved and turned with the flesh.
func _squashed_body() -> SoftBody2D:
	add_floor(0)
	var body := add_body(Vector2(0, -51), {"youngs_modulus": 40.0})
	body.name = "Body"
	var eye := attach(body, Vector2(40, -25))
	eye.name = "Eye"
	eye.rotation = 0.25
	eye.owner = body
	await seconds(2)
	check_above(eye.position.distance_to(Vector2(40, -25)), 2, "way of the eye on the squashed body [px]")
	check_above(absf(eye.rotation - 0.25), 0.02, "turn of the eye on the squashed body")
	return body


func _check_at_rest_place(copy: SoftBody2D, what: String) -> void:
	var eye: SoftBodyAttachment2D = copy.get_node("Eye")
	check_near(eye.position, Vector2(40, -25), 1e-3, "place of the eye of " + what)
	check_near(eye.rotation, 0.25, 1e-5, "rotation of the eye of " + what)
	copy.gravity_scale = 0
	copy.position = Vector2(500, -500)
	stage.add_child(copy)
	await ticks(3)
	check_near(eye.position, Vector2(40, -25), 0.5, "place on the body in its rest shape, of " + what)
	check_near(eye.rotation, 0.25, 0.02, "rotation on the body in its rest shape, of " + what)
	check_equal(eye.get_rest_position(), Vector2(40, -25), "rest position of " + what)
	check_near(eye.get_rest_rotation(), 0.25, 1e-5, "rest rotation of " + what)


func test_a_duplicate_of_a_squashed_body_has_its_attachments_at_their_rest_places() -> void:
	var body: SoftBody2D = await _squashed_body()
	await _check_at_rest_place(body.duplicate(), "a duplicate")


func test_a_packed_squashed_body_has_its_attachments_at_their_rest_places() -> void:
	var body: SoftBody2D = await _squashed_body()
	var scene := PackedScene.new()
	check_equal(scene.pack(body), OK, "result of packing")
	await _check_at_rest_place(scene.instantiate(), "a packed body")
	var told := {}
	var state := scene.get_state()
	for i in state.get_node_property_count(1):
		told[String(state.get_node_property_name(1, i))] = state.get_node_property_value(1, i)
	check(not told.has("position") and not told.has("rotation"), "the place on the deformed body is stored: %s" % told)


func test_a_place_that_a_script_gives_to_a_duplicate_counts() -> void:
	var body: SoftBody2D = await _squashed_body()
	var copy: SoftBodyAttachment2D = body.get_node("Eye").duplicate()
	copy.position = Vector2(-10, 20)
	copy.rotation = 1
	var other := add_weightless_body(Vector2(500, -500))
	other.add_child(copy)
	await ticks(3)
	check_near(copy.position, Vector2(-10, 20), 0.05, "place of the duplicate")
	check_near(copy.rotation, 1.0, 0.01, "rotation of the duplicate")


func test_what_does_not_follow_rotation_keeps_the_rotation_that_it_has_in_a_duplicate() -> void:
	var body: SoftBody2D = await _squashed_body()
	var tag: SoftBodyAttachment2D = body.get_node("Eye")
	tag.follow_rotation = false
	tag.rotation = 0.75
	await ticks(2)
	var copy: SoftBodyAttachment2D = tag.duplicate()
	check_near(copy.rotation, 0.75, 1e-5, "rotation of the duplicate")
	copy.free()
