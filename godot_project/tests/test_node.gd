# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The node among nodes: it follows its body, can be moved, scaled, copied, re-parented, paused and freed.


func test_position_follows_the_fall_and_children_ride_along() -> void:
	var body := add_body(Vector2(50, 0))
	var child := Sprite2D.new()
	child.position = Vector2(20, -10)
	body.add_child(child)
	for i in 30:
		await ticks(1)
		check_near(body.global_position, body.get_center_of_mass_position(), 0.05, "position of the node")
		check_near(child.global_position, body.get_center_of_mass_position() + Vector2(20, -10), 0.05, "position of the child")
	check_above(child.global_position.y, 100, "fall of the child")


func test_rotation_follows_the_spin_and_children_ride_along() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "stiffness": 3000.0, "rotation": 0.5 })
	var child := Node2D.new()
	child.position = Vector2(50, 0) # where point 0 is
	body.add_child(child)
	for i in 16:
		body.apply_point_impulse(i, Vector2.from_angle(TAU * i / 16.0).orthogonal() * -8)
	var spin := body.get_angular_velocity()
	check_above(absf(spin), 1, "spin")
	await ticks(60)
	check_near(angle_difference(0.5, body.rotation), wrapf(spin, -PI, PI), 0.1, "rotation after a second of spin %s" % spin)
	check_near(child.global_position, body.get_point_positions()[0], 2, "child and the point it sits on")


func test_a_polygon_beside_the_nodes_origin_stays_beside_it() -> void:
	var polygon := SoftBody2D.make_circle_polygon(40, 16)
	for i in polygon.size():
		polygon[i] += Vector2(100, 30)
	var body := add_body(Vector2(10, 20), { "polygon": polygon })
	await ticks(30)
	var fall := body.get_linear_velocity().y * 0.5 / 2
	check_near(body.global_position, Vector2(10, 20 + fall), 5, "position of the node")
	check_near(body.get_center_of_mass_position() - body.global_position, Vector2(100, 30), 0.1, "polygon beside the node")


func test_moving_the_node_moves_the_whole_body() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 40), { "stiffness": 150.0 })
	await seconds(3)
	var before := body.get_point_positions()
	var area := body.get_area()
	body.gravity_scale = 0
	body.global_position += Vector2(300, -400)
	await ticks(1)
	var moved := PackedVector2Array()
	for point in before:
		moved.append(point + Vector2(300, -400))
	check_points_near(body.get_point_positions(), moved, 3, "points and the points moved") # a tick of recovery
	check_near(body.get_area() / area, 1.0, 0.05, "area")
	check_near(body.global_position, body.get_center_of_mass_position(), 4, "node and body")


func test_a_move_is_seen_by_the_next_line_of_code() -> void:
	var body := add_weightless_body()
	await ticks(3)
	body.global_position = Vector2(400, 0)
	check_near(body.get_center_of_mass_position(), Vector2(400, 0), 0.1, "center of mass right after the move")
	check(body.has_point(Vector2(400, 0)), "the new place is not inside")
	body.apply_central_impulse(Vector2(6, 0))
	await ticks(10)
	check_near(body.get_center_of_mass_position(), Vector2(401, 0), 0.1, "center of mass ten ticks later")


func test_moving_keeps_the_velocity() -> void:
	var body := add_body()
	await ticks(30)
	var velocity := body.get_linear_velocity()
	body.global_position = Vector2(100, 100)
	await ticks(1)
	check_near(body.get_linear_velocity(), velocity + Vector2(0, GRAVITY / 60), 0.5, "velocity after the move")


func test_turning_the_node_turns_the_whole_body() -> void:
	var body := add_weightless_body(Vector2(200, 100), { "polygon": SoftBody2D.make_box_polygon(Vector2(120, 40), 20) })
	await ticks(3)
	body.rotation = PI / 2
	await ticks(1)
	check_near(bounds_of(polygon_of(body)).size, Vector2(40, 120), 0.5, "size of the box after a quarter turn")
	check_near(body.rotation, PI / 2, 0.01, "rotation of the node")
	await seconds(1)
	check_near(body.get_linear_velocity(), Vector2.ZERO, 0.1, "velocity")
	check_near(body.get_angular_velocity(), 0.0, 0.01, "spin")


func test_moving_the_parent_moves_the_body() -> void:
	var parent := Node2D.new()
	stage.add_child(parent)
	var body := SoftBody2D.new()
	body.gravity_scale = 0
	body.position = Vector2(50, 0)
	parent.add_child(body)
	await ticks(3)
	parent.position = Vector2(0, 300)
	parent.rotation = PI / 2
	await ticks(2)
	check_near(body.get_center_of_mass_position(), Vector2(0, 350), 0.1, "center of mass")
	check_near(body.position, Vector2(50, 0), 0.1, "position under the parent")


func test_a_turned_and_scaled_parent_is_no_obstacle() -> void:
	var parent := Node2D.new()
	parent.transform = Transform2D(0.7, Vector2(1.5, 1.5), 0, Vector2(40, -60))
	stage.add_child(parent)
	add_floor(100)
	var body := SoftBody2D.new()
	parent.add_child(body)
	check_near(bounds_of(polygon_of(body)).size, Vector2(150, 150), 1, "size")
	await check_rests(body)
	check_near(body.global_position, body.get_center_of_mass_position(), 8, "node and body")
	check_near(bounds_of(polygon_of(body)).end.y, 100.0, 1, "lowest point")


func test_scale_counts_at_the_start() -> void:
	var plain := add_weightless_body()
	var body := add_weightless_body(Vector2(300, 0), { "scale": Vector2(2, 0.5) })
	check_near(bounds_of(polygon_of(body)).size, Vector2(200, 50), 0.1, "size")
	check_near(body.get_rest_area(), plain.get_rest_area(), 1, "area of a body twice as wide and half as high")
	await ticks(30)
	check_near(bounds_of(polygon_of(body)).size, Vector2(200, 50), 0.1, "size after half a second")
	check_near(body.scale, Vector2(2, 0.5), 0.001, "scale of the node")


func test_a_mirrored_body_rests_like_any_other() -> void:
	add_floor(100)
	var body := add_body(Vector2.ZERO, { "scale": Vector2(-1, 1) })
	check_above(body.get_area(), 0, "area")
	check_points_near(polygon_of(body), body.global_transform * body.polygon, 0.01, "points and polygon")
	await check_rests(body)


func test_scale_set_while_running_resizes_the_body() -> void:
	var body := add_weightless_body()
	await ticks(3)
	var area := body.get_rest_area()
	body.scale = Vector2(2, 2)
	await ticks(2)
	check_near(body.get_rest_area() / area, 4.0, 0.01, "rest area over the old one")
	await seconds(2)
	check_near(bounds_of(polygon_of(body)).size, Vector2(200, 200), 2, "size")


func test_reparenting_keeps_the_motion() -> void:
	var other := Node2D.new()
	other.position = Vector2(500, 500)
	stage.add_child(other)
	var body := add_body()
	await ticks(20)
	var points := body.get_point_positions()
	var velocity := body.get_linear_velocity()
	body.reparent(other)
	check_points_near(body.get_point_positions(), points, 0.01, "points before and after")
	check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies of the simulation")
	await ticks(1)
	check_near(body.get_linear_velocity(), velocity + Vector2(0, GRAVITY / 60), 0.5, "velocity a tick later")
	check_near(body.global_position, body.get_center_of_mass_position(), 0.1, "node and body")


func test_leaving_and_entering_the_tree_keeps_the_body() -> void:
	var body := add_body()
	await ticks(20)
	stage.remove_child(body)
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies of the simulation")
	await ticks(5)
	body.position = Vector2(100, 50)
	stage.add_child(body)
	await ticks(1)
	check_near(body.get_center_of_mass_position(), Vector2(100, 50), 8, "center of mass after entering elsewhere")
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.01, "area")
	await ticks(30)
	check_above(body.get_center_of_mass_position().y, 150, "y later")


func test_a_body_freed_while_falling_leaves_nothing() -> void:
	var others: Array[SoftBody2D] = [add_body(Vector2(-200, 0)), add_body(Vector2(200, 0))]
	var body := add_body()
	await ticks(10)
	body.queue_free()
	await ticks(10)
	check_equal(SoftBodySimulation2D.get_body_count(), 2, "bodies of the simulation")
	for other in others:
		check_near(other.get_linear_velocity().y, GRAVITY * 20 / 60, 0.2, "velocity of the others")
		other.free()
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies of the simulation at the end")


func test_a_hundred_bodies_come_and_go() -> void:
	add_floor(100)
	for round_number in 4:
		var bodies: Array[SoftBody2D] = []
		for i in 25:
			bodies.append(add_body(Vector2(-1500 + 125 * i, 20)))
		await ticks(10)
		for i in range(24, -1, -2):
			bodies[i].free()
		await ticks(5)
		for i in range(1, 25, 2):
			check_near(bodies[i].get_center_of_mass_position().x, -1500.0 + 125 * i, 1, "x of a survivor")
			bodies[i].free()
		check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies of the simulation")


func test_a_duplicate_is_a_body_of_its_own() -> void:
	add_floor(100)
	var body := add_body(Vector2.ZERO, { "stiffness": 700.0, "polygon": SoftBody2D.make_box_polygon(Vector2(60, 60), 20) })
	await ticks(10)
	var copy := body.duplicate() as SoftBody2D
	copy.position = Vector2(300, 0)
	stage.add_child(copy)
	check_equal(copy.stiffness, 700.0, "stiffness of the copy")
	check_equal(copy.polygon, body.polygon, "polygon of the copy")
	check_equal(SoftBodySimulation2D.get_body_count(), 2, "bodies of the simulation")
	body.free()
	await check_rests(copy, 6)
	check_near(copy.get_center_of_mass_position().x, 300.0, 3, "x of the copy")


func test_a_paused_tree_stops_it_and_it_goes_on_where_it_was() -> void:
	var body := add_body()
	await ticks(20)
	var points := body.get_point_positions()
	var velocity := body.get_linear_velocity()
	tree.paused = true
	await ticks(30)
	check_equal(body.get_point_positions(), points, "points while paused")
	tree.paused = false
	await ticks(1)
	check_near(body.get_linear_velocity(), velocity + Vector2(0, GRAVITY / 60), 0.5, "velocity a tick after the pause")


func test_a_disabled_body_stands_still_beside_a_running_one() -> void:
	var disabled := add_body()
	var running := add_body(Vector2(200, 0))
	disabled.process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(30)
	check_near(disabled.get_center_of_mass_position(), Vector2.ZERO, 0.01, "place of the disabled body")
	check_above(running.get_center_of_mass_position().y, 50, "y of the running body")


func test_a_disabled_body_is_removed_made_static_or_goes_on_as_its_disable_mode_says() -> void:
	var parent := Node2D.new()
	stage.add_child(parent)
	for mode: int in [SoftBody2D.DISABLE_MODE_REMOVE, SoftBody2D.DISABLE_MODE_MAKE_STATIC, SoftBody2D.DISABLE_MODE_KEEP_ACTIVE]:
		for is_disabled_first: bool in [false, true]:
			var what := "mode %d, disabled %s" % [mode, "before it enters the tree" if is_disabled_first else "in the tree"]
			parent.process_mode = Node.PROCESS_MODE_DISABLED if is_disabled_first else Node.PROCESS_MODE_INHERIT
			var body := SoftBody2D.new()
			body.disable_mode = mode
			parent.add_child(body)
			parent.process_mode = Node.PROCESS_MODE_DISABLED
			var crumb := add_body(Vector2(0, -120), {"polygon": SoftBody2D.make_circle_polygon(20, 10)})
			await ticks(60)
			var is_static: bool = mode == SoftBody2D.DISABLE_MODE_MAKE_STATIC
			if mode == SoftBody2D.DISABLE_MODE_KEEP_ACTIVE:
				check_above(body.global_position.y, 200, "y of the body, " + what)
			else:
				check_near(body.global_position, Vector2.ZERO, 0.01, "place of the body, " + what)
			check_equal(crumb.global_position.y < 0, is_static, "whether it holds another body, " + what)
			var query := PhysicsPointQueryParameters2D.new()
			query.position = Vector2(10, 10)
			check_equal(not stage.get_world_2d().direct_space_state.intersect_point(query).is_empty(), is_static,
					"whether the engine finds it where it was, " + what)
			check_equal(body.freeze, false, "freeze, " + what)
			tree.paused = true
			var before := body.global_position
			await ticks(5)
			check_equal(body.global_position, before, "place while the tree is paused, " + what)
			tree.paused = false
			parent.process_mode = Node.PROCESS_MODE_INHERIT
			await ticks(60)
			check_above(body.global_position.y, before.y + 50, "y after it was enabled again, " + what)
			body.free()
			crumb.free()


func test_a_frozen_body_that_is_disabled_and_enabled_stays_frozen() -> void:
	var body := add_body(Vector2.ZERO, {"disable_mode": SoftBody2D.DISABLE_MODE_MAKE_STATIC, "freeze": true})
	body.process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(2)
	body.process_mode = Node.PROCESS_MODE_INHERIT
	await ticks(30)
	check_near(body.global_position, Vector2.ZERO, 0.01, "place of the frozen body")
	body.process_mode = Node.PROCESS_MODE_DISABLED
	body.freeze = false
	await ticks(30)
	check_near(body.global_position, Vector2.ZERO, 0.01, "place while it is held static")
	body.disable_mode = SoftBody2D.DISABLE_MODE_KEEP_ACTIVE
	await ticks(30)
	check_above(body.global_position.y, 50, "y after its disable mode has changed")


func test_a_hidden_body_still_moves() -> void:
	var body := add_body()
	body.hide()
	await ticks(30)
	check_above(body.get_center_of_mass_position().y, 50, "y")


func test_reset_brings_the_rest_shape_back() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 40), { "stiffness": 100.0 })
	await seconds(2)
	body.gravity_scale = 0
	body.global_transform = Transform2D(0, Vector2(0, -200))
	body.reset()
	check_points_near(polygon_of(body), body.global_transform * body.polygon, 0.01, "points and polygon")
	check_near(body.get_linear_velocity(), Vector2.ZERO, 0.001, "velocity")
	await ticks(30)
	check_near(body.get_center_of_mass_position(), Vector2(0, -200), 0.01, "place")


func test_questions_to_a_body_outside_the_tree_are_answered() -> void:
	var body := SoftBody2D.new()
	check_equal(body.get_point_count(), 17, "get_point_count()")
	check_above(body.get_rest_area(), 7000, "rest area")
	check_equal(body.get_penetration(), 0.0, "penetration")
	check_equal(body.get_linear_velocity(), Vector2.ZERO, "velocity")
	check(not body.has_point(Vector2(1000, 0)), "a place far away is inside")
	check(body.get_substep_plan().has("substeps"), "no substep plan")
	body.get_point_positions()
	body.get_interpolated_polygon(0.5)
	body.get_nearest_point(Vector2.ZERO)
	body.reset()
	body.free()


func test_textures_of_every_kind_are_taken() -> void:
	add_floor(100)
	var atlas := AtlasTexture.new()
	atlas.atlas = GradientTexture2D.new()
	atlas.region = Rect2(0, 0, 8, 8)
	var image := ImageTexture.create_from_image(Image.create(4, 4, false, Image.FORMAT_RGBA8))
	for texture: Texture2D in [GradientTexture2D.new(), atlas, image, PlaceholderTexture2D.new(), null]:
		var body := add_body(Vector2.ZERO, { "texture": texture, "color": Color(1, 0.5, 0.5) })
		await ticks(3)
		check_equal(body.texture, texture, "texture")
		body.texture = null
		await ticks(2)
		body.texture = texture
		await ticks(2)
		body.free()


func test_a_script_may_extend_the_node() -> void:
	var script := GDScript.new()
	script.source_code = "extends SoftBody2D\nvar entered := 0\nfunc _ready() -> void:\n\tentered += 1\n" \
			+ "func _physics_process(_delta: float) -> void:\n\tapply_central_force(Vector2(60, 0))\n"
	check_equal(script.reload(), OK, "loading the script")
	var body: SoftBody2D = script.new()
	body.gravity_scale = 0
	stage.add_child(body)
	await ticks(61)
	check_equal(body.get("entered"), 1, "calls of _ready()")
	check_near(body.get_linear_velocity(), Vector2(60, 0), 1.1, "velocity after a second of 60 N on 1 kg")
