# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## Only what is seen is brought up to date before a frame, and what is seen is up to date: with several cameras, after a
## camera's jump, in a viewport that is drawn once.


func _updates_in_a_frame() -> int:
	await RenderingServer.frame_post_draw
	return SoftBodySimulation2D.get_last_drawn_count()


func _wobble(body: SoftBody2D, speed := 200.0) -> void:
	for i in body.polygon.size():
		body.apply_point_impulse(i, Vector2(signf(body.polygon[i].x), 0) * speed / body.polygon.size())


## The pixels just inside and outside of the interpolated polygon.
func _check_shows(image: Image, body: SoftBody2D, canvas: Transform2D, what: String) -> void:
	var polygon := canvas * body.get_interpolated_polygon()
	var center := Vector2.ZERO
	for point in polygon:
		center += point / polygon.size()
	for point in polygon:
		check_pixel(image, point.lerp(center, 0.1), body.color, "inside of " + what)
		check_pixel(image, point.lerp(center, -0.1), CLEAR, "outside of " + what)


func test_bodies_at_rest_are_not_updated() -> void:
	if not open_viewport():
		return
	add_solid(rectangle(400, 40), Transform2D(0, Vector2(200, 380)), viewport)
	add_to_view({ "gravity_scale": 1.0, "position": Vector2(200, 300) })
	await ticks(5)
	check_equal(await _updates_in_a_frame(), 1, "bodies updated while it falls")
	await seconds(6)
	check_equal(await _updates_in_a_frame(), 0, "bodies updated while it sleeps")


func test_paused_bodies_are_not_updated() -> void:
	if not open_viewport():
		return
	var body := add_to_view()
	_wobble(body)
	await ticks(5)
	body.process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(3)
	check_equal(await _updates_in_a_frame(), 0, "paused bodies updated")
	_check_shows(await picture(), body, Transform2D(), "the paused body")


func test_frozen_bodies_are_not_updated_until_they_are_moved() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED })
	_wobble(body)
	await ticks(5)
	body.freeze = true
	await ticks(3)
	check_equal(await _updates_in_a_frame(), 0, "frozen bodies updated")
	body.global_position += Vector2(50, 30)
	await ticks(2)
	_check_shows(await picture(), body, Transform2D(), "the frozen body that was moved")


func test_bodies_off_screen_and_hidden_ones_are_not_updated() -> void:
	if not open_viewport():
		return
	var seen := add_to_view()
	var beyond := add_to_view({ "position": Vector2(900, 200) })
	var hidden := add_to_view({ "position": Vector2(200, 60), "visible": false })
	for body: SoftBody2D in [seen, beyond, hidden]:
		_wobble(body)
	await ticks(5)
	await RenderingServer.frame_post_draw
	check_equal(await _updates_in_a_frame(), 1, "bodies updated of one seen, one beyond the edge and one hidden")
	hidden.show()
	await ticks(2)
	await RenderingServer.frame_post_draw
	check_equal(await _updates_in_a_frame(), 2, "bodies updated with the hidden one shown")
	_check_shows(await picture(), hidden, Transform2D(), "the body shown again")


func test_a_body_that_flies_in_is_seen_from_its_first_pixel_on() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "position": Vector2(700, 200), "color": Color.RED })
	await ticks(5)
	_wobble(body)
	body.apply_central_impulse(Vector2(-900, 0))
	for i in 40:
		var image := await picture()
		var polygon := body.get_interpolated_polygon()
		for point in polygon:
			var inside := point.lerp(body.get_interpolated_transform().origin, 0.15)
			if Rect2(2, 2, 396, 396).has_point(inside):
				check_pixel(image, inside, Color.RED, "the body that flies in")
	check_below(body.global_position.x, 250, "where it has flown to")


func test_a_body_told_so_stands_still_off_screen_and_goes_on_as_it_moved() -> void:
	if not open_viewport():
		return
	var camera := Camera2D.new()
	camera.anchor_mode = Camera2D.ANCHOR_MODE_FIXED_TOP_LEFT
	viewport.add_child(camera)
	camera.make_current()
	var bodies: Array[SoftBody2D] = []
	for still: bool in [false, true]:
		bodies.append(add_to_view({ "position": Vector2(900, 300.0 * bodies.size()), "linear_velocity": Vector2(0, -60),
				"simulate_off_screen": not still, "linear_damp": 0.0, "linear_damp_mode": SoftBody2D.DAMP_MODE_REPLACE }))
	await ticks(20)
	check_near(bodies[0].linear_velocity.y, -60, 0.01, "speed of the body that is always simulated")
	var before := bodies[1].global_position
	var way := -bodies[0].global_position.y
	await ticks(30)
	check_near(-bodies[0].global_position.y - way, 30, 0.5, "way of the body that is always simulated")
	check_equal(bodies[1].global_position, before, "place of the body that stands still off-screen")
	camera.position.x = 700
	await ticks(4)
	before = bodies[1].global_position
	await ticks(30)
	check_near(before.y - bodies[1].global_position.y, 30, 0.5, "way of the same body in view")
	bodies[1].hide()
	await ticks(5)
	before = bodies[1].global_position
	await ticks(10)
	check_equal(bodies[1].global_position, before, "place of the same body, hidden")


func test_a_body_in_view_loses_no_tick_by_standing_still_off_screen() -> void:
	if not open_viewport():
		return
	var bodies: Array[SoftBody2D] = []
	for still: bool in [false, true]:
		bodies.append(add_to_view({ "position": Vector2(100.0 + 200.0 * bodies.size(), 100), "gravity_scale": 1.0,
				"simulate_off_screen": not still }))
	for i in 12:
		await ticks(1)
		check_near(bodies[1].global_position.y, bodies[0].global_position.y, 0.01, "height in tick %d" % i) # one tick of fall: 0.27


func test_a_body_that_grows_into_view_is_seen() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "position": Vector2(560, 200), "polygon": SoftBody2D.make_circle_polygon(30, 16),
			"color": Color.RED, "center_point": false, "pressure": 300.0, "inflation": 1.0, "shape_matching": 0.0, "stiffness": 1.0 })
	await ticks(5)
	body.inflation = 80.0
	await seconds(1.5)
	var polygon := body.get_interpolated_polygon()
	check_below(bounds_of(polygon).position.x, 350, "left end of the body that has grown")
	var image := await picture()
	var place := Vector2(395, body.get_interpolated_transform().origin.y)
	check_pixel(image, place, Color.RED, "the body that has grown into view")


func test_two_cameras_see_one_world() -> void:
	if not open_viewport(Vector2i(200, 200)):
		return
	var other := make_viewport(Vector2i(200, 200))
	other.world_2d = viewport.world_2d
	var camera := Camera2D.new()
	camera.position = Vector2(1000, 100)
	other.add_child(camera)
	camera.make_current()
	var here := add_to_view({ "color": Color.RED, "position": Vector2(100, 100) })
	var there := add_to_view({ "color": Color.GREEN, "position": Vector2(1000, 100) })
	var nowhere := add_to_view({ "position": Vector2(3000, 100) })
	for body: SoftBody2D in [here, there, nowhere]:
		_wobble(body)
	await ticks(6)
	await RenderingServer.frame_post_draw
	check_equal(await _updates_in_a_frame(), 2, "bodies updated for two cameras that see one each")
	await RenderingServer.frame_post_draw
	_check_shows(viewport.get_texture().get_image(), here, Transform2D(), "the body before the first camera")
	_check_shows(other.get_texture().get_image(), there, Transform2D(0, Vector2(-900, 0)),
			"the body before the second camera")


## Where a camera jumps to, nothing has been updated: in the first frame there everything must be.
func test_after_a_cameras_jump_the_first_frame_is_right() -> void:
	if not open_viewport():
		return
	var camera := Camera2D.new()
	camera.position = middle()
	viewport.add_child(camera)
	camera.make_current()
	var body := add_to_view({ "position": Vector2(3000, 200), "color": Color.RED, "stiffness": 25.0 })
	await ticks(5)
	_wobble(body, 700)
	await ticks(6)
	var box := bounds_of(polygon_of(body))
	check_above(box.size.x / box.size.y, 1.15, "how much wider than high it is")
	await tree.process_frame
	camera.position = Vector2(3000, 200)
	camera.force_update_scroll()
	await RenderingServer.frame_post_draw
	_check_shows(viewport.get_texture().get_image(), body, viewport.canvas_transform,
			"the body in the first frame after the jump")


func test_a_viewport_drawn_once_shows_the_present() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED, "stiffness": 25.0 })
	await ticks(3)
	viewport.render_target_update_mode = SubViewport.UPDATE_DISABLED
	_wobble(body, 250)
	await ticks(3)
	check_equal(await _updates_in_a_frame(), 0, "bodies updated for a viewport that is not drawn")
	await ticks(5)
	viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	await RenderingServer.frame_post_draw
	_check_shows(viewport.get_texture().get_image(), body, Transform2D(), "the body in a viewport drawn once")


func test_a_body_that_leaves_the_tree_and_comes_back_is_seen() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED })
	_wobble(body)
	await ticks(5)
	viewport.remove_child(body)
	await ticks(3)
	viewport.add_child(body)
	await ticks(3)
	await RenderingServer.frame_post_draw
	_check_shows(await picture(), body, Transform2D(), "the body that came back")
	check_equal(await _updates_in_a_frame(), 1, "bodies updated after it came back")


## Stretched far beyond its rest shape, it must not vanish while a part of it is on the screen.
func test_a_stretched_body_is_not_culled() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "position": Vector2(200, 200), "color": Color.RED, "stiffness": 0.0, "shape_matching": 0.0,
			"damping": 0.0, "collision_mask": 0, "most_stretch": 1000.0 })
	for i in body.polygon.size():
		body.apply_point_impulse(i, Vector2(signf(body.polygon[i].x), 0) * 60)
	await ticks(30)
	var camera := Camera2D.new()
	var end := bounds_of(polygon_of(body)).end.x
	check_above(end, 600, "right end of the stretched body")
	camera.position = Vector2(end - 60, 200)
	viewport.add_child(camera)
	camera.make_current()
	body.process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(3)
	check_pixel(await picture(), Vector2(120, 200), Color.RED, "the far end of the stretched body")


## It is brought up to date once where it rests, so that no later frame has to look at it.
func test_a_body_that_came_to_rest_out_of_view_is_right_after_a_cameras_jump() -> void:
	if not open_viewport():
		return
	var camera := Camera2D.new()
	camera.position = middle()
	viewport.add_child(camera)
	camera.make_current()
	var body := add_to_view({ "position": Vector2(3000, 200), "color": Color.RED, "stiffness": 25.0 })
	await ticks(5)
	_wobble(body, 700)
	await ticks(6)
	body.freeze = true
	await ticks(4)
	var box := bounds_of(polygon_of(body))
	check_above(box.size.x / box.size.y, 1.15, "how much wider than high it rests")
	check_equal(await _updates_in_a_frame(), 0, "bodies updated while it rests out of view")
	await tree.process_frame
	camera.position = Vector2(3000, 200)
	camera.force_update_scroll()
	check_equal(await _updates_in_a_frame(), 0, "bodies updated in the frame of the jump")
	_check_shows(viewport.get_texture().get_image(), body, viewport.canvas_transform,
			"the resting body in the first frame after the jump")


func test_a_body_at_rest_that_leaves_the_view_stands_still_at_once() -> void:
	if not open_viewport():
		return
	var camera := Camera2D.new()
	camera.position = middle()
	viewport.add_child(camera)
	camera.make_current()
	var body := add_to_view({ "simulate_off_screen": false, "freeze": true })
	await ticks(5)
	camera.position = Vector2(3000, 200)
	await ticks(8)
	var before := body.global_position
	body.freeze = false
	body.apply_central_impulse(Vector2(100, 0))
	await ticks(8)
	check_equal(body.global_position, before, "place of the body that nobody sees")
	camera.position = before
	await ticks(8)
	check_above(body.global_position.x, before.x + 1, "where the same body goes in view")
