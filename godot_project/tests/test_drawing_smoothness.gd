# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## A body that moves uniformly is drawn so, whatever the ticks and frames: measured in the pixels of each frame.
## Run without `--fixed-fps`, the suite does the same on frames as uneven as the machine makes them.

const SIZE := Vector2i(240, 90)
const RADIUS := 24.0
const SPEED := 60.0
## Ticks a second, against about 60 frames a second: fewer, more, and no round ratio.
const RATES: Array[int] = [24, 47, 60, 144]
const FRAMES := 60
## Largest distance from uniform motion [px].
const TOLERANCE := 0.05


## Where something is drawn in each of many frames.
class Course:
	var times := PackedFloat64Array()
	var places := PackedVector2Array()

	## Largest distance of a place from the straight line through all of them, uniform in time.
	func unevenness() -> float:
		var mean_time := 0.0
		var mean := Vector2.ZERO
		for i in times.size():
			mean_time += times[i] / times.size()
			mean += places[i] / times.size()
		var spread := 0.0
		var slope := Vector2.ZERO
		for i in times.size():
			spread += (times[i] - mean_time) ** 2
			slope += (places[i] - mean) * (times[i] - mean_time)
		slope /= spread
		var worst := 0.0
		for i in times.size():
			worst = maxf(worst, places[i].distance_to(mean + slope * (times[i] - mean_time)))
		return worst

	func speed() -> Vector2:
		return (places[-1] - places[0]) / (times[-1] - times[0])


func _ball(properties := {}, parent: Node = viewport) -> SoftBody2D:
	var body := add_to_view({ "polygon": SoftBody2D.make_circle_polygon(RADIUS, 32), "mass": 1.0, "antialiased": true, "stiffness": 400.0,
			"position": Vector2(70, 45) }.merged(properties, true), parent)
	body.reset_physics_interpolation()
	return body


## Watches `of` for some frames; `place` may tell where, otherwise the pixels do.
func _watch(of: SubViewport, place := Callable()) -> Course:
	for i in 12: # past the first ticks
		await tree.process_frame
	var course := Course.new()
	var time := 0.0
	for i in FRAMES:
		await tree.process_frame
		time += tree.root.get_process_delta_time()
		await RenderingServer.frame_post_draw
		course.times.append(time)
		course.places.append(place.call() if place.is_valid() else centroid(of.get_texture().get_image()))
	return course


func _set_mode(interpolated: bool, rate: int) -> void:
	tree.physics_interpolation = interpolated
	Engine.physics_ticks_per_second = rate


func _name(interpolated: bool, rate: int) -> String:
	return "at %d ticks %s the engine's interpolation" % [rate, "with" if interpolated else "without"]


func test_free_flight_is_even() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		for rate in RATES:
			_set_mode(interpolated, rate)
			var body := _ball()
			body.apply_central_impulse(Vector2(SPEED, 0))
			var course: Course = await _watch(viewport)
			check_near(course.speed().x, SPEED, 0.05 * SPEED, "speed " + _name(interpolated, rate))
			check_below(course.unevenness(), TOLERANCE, "unevenness in px " + _name(interpolated, rate))
			body.free()


func test_a_body_is_drawn_where_it_says() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 24)
		var body := _ball()
		body.apply_central_impulse(Vector2(SPEED, 5))
		await ticks(4)
		for i in 10:
			await RenderingServer.frame_post_draw
			var drawn := centroid(viewport.get_texture().get_image())
			check_near(body.get_interpolated_transform().origin, drawn, TOLERANCE, "interpolated position and pixels")
			var mean := Vector2.ZERO
			for point in body.get_interpolated_polygon():
				mean += point / body.polygon.size()
			check_near(mean, drawn, TOLERANCE, "interpolated polygon and pixels")
		body.free()


func test_children_stay_on_the_body() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 24)
		var body := _ball({ "self_modulate": CLEAR })
		var eye := Polygon2D.new()
		eye.polygon = SoftBody2D.make_circle_polygon(8, 16)
		eye.position = Vector2(0, -10)
		body.add_child(eye)
		body.apply_central_impulse(Vector2(SPEED, 0))
		for i in 12:
			await tree.process_frame
		for i in 20:
			await RenderingServer.frame_post_draw
			var drawn := centroid(viewport.get_texture().get_image())
			check_near(body.get_interpolated_transform() * Vector2(0, -10), drawn, 0.25,
					"a child and its body %s" % _name(interpolated, 24))
		body.free()


func test_below_a_turned_and_scaled_parent_flight_is_even() -> void:
	if not open_viewport(SIZE):
		return
	var parent := Node2D.new()
	parent.transform = Transform2D(0.6, Vector2(1.5, 1.5), 0, Vector2(30, 20))
	viewport.add_child(parent)
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 47)
		var body := _ball({ "position": parent.transform.affine_inverse() * Vector2(70, 45) }, parent)
		body.apply_central_impulse(Vector2(SPEED, 0))
		var course: Course = await _watch(viewport)
		check_near(course.speed(), Vector2(SPEED, 0), 0.05 * SPEED, "speed " + _name(interpolated, 47))
		check_below(course.unevenness(), TOLERANCE, "unevenness in px " + _name(interpolated, 47))
		body.free()


## The engine blends the parent, which is moved in ticks, and so must the body go that rides on it.
func test_below_a_parent_that_moves_flight_is_even_where_the_engine_blends() -> void:
	if not open_viewport(SIZE):
		return
	_set_mode(true, 47)
	var parent := Node2D.new()
	viewport.add_child(parent)
	var body := _ball({}, parent)
	body.apply_central_impulse(Vector2(SPEED / 2, 0))
	var move := func() -> void: parent.position.x += SPEED / 2 / 47
	tree.physics_frame.connect(move)
	var course: Course = await _watch(viewport)
	tree.physics_frame.disconnect(move)
	check_near(course.speed().x, SPEED, 0.05 * SPEED, "speed of body and parent")
	check_below(course.unevenness(), TOLERANCE, "unevenness in px on a moving parent")


func test_in_a_canvas_layer_flight_is_even() -> void:
	if not open_viewport(SIZE):
		return
	var layer := CanvasLayer.new()
	layer.offset = Vector2(10, 5)
	layer.scale = Vector2(0.9, 0.9)
	viewport.add_child(layer)
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 47)
		var body := _ball({}, layer)
		body.apply_central_impulse(Vector2(SPEED, 0))
		var course: Course = await _watch(viewport)
		check_below(course.unevenness(), TOLERANCE, "unevenness in px " + _name(interpolated, 47))
		body.free()


## A camera that is a child of the body: on the screen the body must stand still.
func test_a_camera_on_the_body_sees_it_stand_still() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		for rate: int in [24, 47, 144]:
			_set_mode(interpolated, rate)
			var body := _ball({ "position": Vector2(1000, 500) })
			var camera := Camera2D.new()
			if interpolated: # or the engine says that it does so itself
				camera.process_callback = Camera2D.CAMERA2D_PROCESS_PHYSICS
			body.add_child(camera)
			camera.make_current()
			body.apply_central_impulse(Vector2(SPEED * 4, SPEED))
			for i in 12:
				await tree.process_frame
			var first := Vector2.ZERO
			for i in 30:
				await RenderingServer.frame_post_draw
				var drawn := centroid(viewport.get_texture().get_image())
				first = drawn if i == 0 else first
				check_near(drawn, first, TOLERANCE, "place on the screen of a followed body " + _name(interpolated, rate))
			check_near(first, middle(), 8, "place on the screen of a followed body")
			body.free()


## A camera that a script moves to where the body is drawn.
func test_a_camera_that_follows_the_interpolated_transform_sees_the_body_stand_still() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 24)
		var body := _ball({ "position": Vector2(1000, 500) })
		var camera := Camera2D.new()
		camera.physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF
		camera.process_callback = Camera2D.CAMERA2D_PROCESS_IDLE
		viewport.add_child(camera)
		camera.make_current()
		body.apply_central_impulse(Vector2(SPEED * 4, SPEED))
		var follow := func() -> void: camera.global_position = body.get_interpolated_transform().origin
		tree.process_frame.connect(follow)
		for i in 12:
			await tree.process_frame
		var first := Vector2.ZERO
		for i in 30:
			await RenderingServer.frame_post_draw
			var drawn := centroid(viewport.get_texture().get_image())
			first = drawn if i == 0 else first
			check_near(drawn, first, TOLERANCE, "place on the screen of a body followed by script " + _name(interpolated, 24))
		tree.process_frame.disconnect(follow)
		camera.free()
		body.free()


func test_a_node_that_does_not_take_part_in_the_engines_interpolation_is_even_too() -> void:
	if not open_viewport(SIZE):
		return
	_set_mode(true, 24)
	var body := _ball({ "physics_interpolation_mode": Node.PHYSICS_INTERPOLATION_MODE_OFF })
	body.apply_central_impulse(Vector2(SPEED, 0))
	var course: Course = await _watch(viewport)
	check_below(course.unevenness(), TOLERANCE, "unevenness in px")


## Without the engine's blending a node that is moved is drawn there at once; with it, after a reset.
func test_a_teleport_is_drawn_at_once_and_flight_goes_on_evenly() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 24)
		var body := _ball({ "position": Vector2(40, 45) })
		body.apply_central_impulse(Vector2(SPEED, 0))
		for i in 12:
			await tree.process_frame
		var before := body.global_position
		body.global_position += Vector2(90, 0)
		body.reset_physics_interpolation()
		await RenderingServer.frame_post_draw
		var drawn := centroid(viewport.get_texture().get_image())
		check_near(drawn.x, before.x + 90, SPEED / 24 + 1,
				"place in the frame after the teleport " + _name(interpolated, 24))
		body.free()


## Without a reset the engine draws a moved node on its way, its children with it. The skin stays on the node.
func test_without_a_reset_the_engine_smears_node_and_skin_alike() -> void:
	if not open_viewport(SIZE):
		return
	_set_mode(true, 10)
	var body := _ball({ "position": Vector2(40, 45), "color": Color(1, 0, 0), "collision_layer": 0 })
	var mark := Polygon2D.new()
	mark.polygon = SoftBody2D.make_circle_polygon(6, 12)
	mark.color = Color.BLUE
	body.add_child(mark)
	await ticks(2)
	body.global_position += Vector2(100, 0)
	var spread := 0.0
	for i in 8:
		await RenderingServer.frame_post_draw
		var image := viewport.get_texture().get_image()
		var drawn := centroid(image)
		check_pixel(image, drawn, Color.BLUE, "the mark in the middle of the body on its way")
		check_near(body.get_interpolated_transform().origin, drawn, 0.5, "the interpolated position on its way")
		spread = maxf(spread, 140 - drawn.x)
	check_above(spread, 10, "how far the drawn body was from its new place")


## Ten ticks a second and a body that wobbles: what is drawn in between is between.
func test_deformation_is_blended_too() -> void:
	if not open_viewport(SIZE):
		return
	for interpolated: bool in [false, true]:
		_set_mode(interpolated, 10)
		var body := _ball({ "stiffness": 4.0, "damping": 0.0, "shape_damping_ratio": 0.0 })
		for i in body.polygon.size():
			body.apply_point_impulse(i, Vector2(body.polygon[i].x, 0).sign() * 1.0)
		await ticks(2)
		var last := 0.0
		var steps := PackedFloat64Array()
		for i in 10:
			await RenderingServer.frame_post_draw
			var image := viewport.get_texture().get_image()
			var weight := 0.0
			for x in image.get_width():
				weight += image.get_pixel(x, 45).a
			steps.append(absf(weight - last) if i > 0 else 0.0)
			last = weight
		var moved := 0
		for step in steps:
			moved += int(step > 0.02)
			check_below(step, 3, "change of width in a frame")
		check_above(moved, 6, "frames in which the width changed")
		body.free()
