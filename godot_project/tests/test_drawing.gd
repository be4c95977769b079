# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## What arrives on the screen. These tests read pixels, so they need a window; headless they are skipped.

const SIZE := 400


## Mean place of what is drawn.
func _centroid(image: Image) -> Vector2:
	var sum := Vector2.ZERO
	var weight := 0.0
	for y in range(0, SIZE, 2):
		for x in range(0, SIZE, 2):
			var alpha := image.get_pixel(x, y).a
			sum += Vector2(x, y) * alpha
			weight += alpha
	return sum / maxf(weight, 1)


## Direction of the long axis of what is drawn, without a sign.
func _axis(image: Image) -> float:
	var center := _centroid(image)
	var spread := Vector3.ZERO # second moments xx, yy, xy
	for y in range(0, SIZE, 2):
		for x in range(0, SIZE, 2):
			var arm := Vector2(x, y) - center
			spread += Vector3(arm.x * arm.x, arm.y * arm.y, arm.x * arm.y) * image.get_pixel(x, y).a
	return atan2(2 * spread.z, spread.x - spread.y) / 2


func test_the_color_fills_the_polygon_and_nothing_else() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED })
	await ticks(3)
	var image := await picture()
	for point in polygon_of(body):
		check_pixel(image, point.lerp(body.global_position, 0.1), Color.RED, "inside")
		check_pixel(image, point.lerp(body.global_position, -0.15), Color(0, 0, 0, 0), "outside")
	check_pixel(image, body.global_position, Color.RED, "center")


func test_a_dent_is_not_filled() -> void:
	if not open_viewport():
		return
	for clockwise: bool in [false, true]:
		var polygon := PackedVector2Array([Vector2(-90, -60), Vector2(-50, -60), Vector2(-40, 30), Vector2(40, 30),
				Vector2(50, -60), Vector2(90, -60), Vector2(90, 80), Vector2(-90, 80)])
		if clockwise:
			polygon.reverse()
		var body := add_to_view({ "polygon": polygon, "color": Color.GREEN })
		await ticks(3)
		var image := await picture()
		check_pixel(image, body.to_global(Vector2(0, 0)), Color(0, 0, 0, 0), "the dent")
		check_pixel(image, body.to_global(Vector2(-70, -40)), Color.GREEN, "the left arm")
		check_pixel(image, body.to_global(Vector2(70, -40)), Color.GREEN, "the right arm")
		check_pixel(image, body.to_global(Vector2(0, 60)), Color.GREEN, "the bottom")
		body.free()


func test_the_texture_covers_the_polygons_box_and_turns_with_the_body() -> void:
	if not open_viewport():
		return
	var image := Image.create(2, 2, false, Image.FORMAT_RGBA8)
	var corners: Array[Color] = [Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW]
	for i in 4:
		image.set_pixel(i & 1, i >> 1, corners[i])
	for clockwise: bool in [false, true]:
		var polygon := SoftBody2D.make_box_polygon(Vector2(160, 100), 20)
		if clockwise:
			polygon.reverse()
		var body := add_to_view({ "polygon": polygon, "texture": ImageTexture.create_from_image(image) })
		body.texture_filter = CanvasItem.TEXTURE_FILTER_NEAREST
		for turn: float in [0.0, 0.6]:
			body.rotation = turn
			await ticks(3)
			var seen := await picture()
			for i in 4:
				var local := Vector2(-60 if i % 2 == 0 else 60, -35 if i < 2 else 35)
				check_pixel(seen, body.to_global(local), corners[i], "texture at a rotation of %s" % turn)
				check_pixel(seen, body.to_global(local * 0.15), corners[i], "texture near the center")
		body.free()


func test_color_and_modulate_tint_the_texture() -> void:
	if not open_viewport():
		return
	var image := Image.create(2, 2, false, Image.FORMAT_RGBA8)
	image.fill(Color.WHITE)
	var body := add_to_view({ "texture": ImageTexture.create_from_image(image), "color": Color(1, 0.5, 0) })
	await ticks(2)
	check_pixel(await picture(), body.global_position, Color(1, 0.5, 0), "tinted texture")
	body.modulate = Color(0.5, 1, 1)
	await ticks(2)
	check_pixel(await picture(), body.global_position, Color(0.5, 0.5, 0), "modulated texture")
	body.texture = null
	body.modulate = Color.WHITE
	await ticks(2)
	check_pixel(await picture(), body.global_position, Color(1, 0.5, 0), "color after the texture went")


func test_scaled_bodies_are_drawn_at_their_size() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "scale": Vector2(2, 1), "color": Color.RED })
	await ticks(2)
	var image := await picture()
	check_pixel(image, body.global_position + Vector2(90, 0), Color.RED, "inside")
	check_pixel(image, body.global_position + Vector2(0, 60), Color(0, 0, 0, 0), "outside")


## A body at constant velocity must advance by equal distances in every frame, with either interpolation. With
## ten ticks a second, uninterpolated drawing would stand for six frames and then jump, and drawing that
## is interpolated twice would move unevenly.
func test_motion_on_the_screen_is_even_with_and_without_the_engines_interpolation() -> void:
	if not open_viewport():
		return
	for interpolated: bool in [false, true]:
		tree.physics_interpolation = interpolated
		Engine.physics_ticks_per_second = 10
		var body := add_to_view({ "position": Vector2(60, 200), "color": Color.WHITE })
		body.reset_physics_interpolation()
		body.apply_central_impulse(Vector2(150, 0))
		for i in 24: # past the first ticks
			await tree.process_frame
		var places := PackedFloat64Array()
		for i in 40:
			places.append(_centroid(await picture()).x)
		var step := 150 / 60.0
		for i in range(1, places.size()):
			check_near(places[i] - places[i - 1], step, 0.8,
					"way in a frame, %s the engine's interpolation" % ("with" if interpolated else "without"))
		body.free()
		Engine.physics_ticks_per_second = 60
		await ticks(2)


## As above for a long body that spins on the spot: its long axis must turn by the same angle in every frame.
func test_spin_on_the_screen_is_even_with_and_without_the_engines_interpolation() -> void:
	if not open_viewport():
		return
	for interpolated: bool in [false, true]:
		tree.physics_interpolation = interpolated
		Engine.physics_ticks_per_second = 10
		var polygon := SoftBody2D.make_box_polygon(Vector2(160, 60), 20)
		var body := add_to_view({ "polygon": polygon, "mass": 1.0, "color": Color.WHITE, "stiffness": 900.0 })
		body.reset_physics_interpolation()
		for i in polygon.size():
			body.apply_point_impulse(i, Vector2(-polygon[i].y, polygon[i].x) * 2.5 / (polygon.size() + 1)) # 2.5 rad/s
		check_near(body.get_angular_velocity(), 2.5, 0.01, "spin")
		for i in 24:
			await tree.process_frame
		var last := _axis(await picture())
		for i in 40:
			var axis := _axis(await picture())
			check_near(angle_difference(2 * last, 2 * axis) / 2, 2.5 / 60, 0.015,
					"turn in a frame, %s the engine's interpolation" % ("with" if interpolated else "without"))
			last = axis
		body.free()
		Engine.physics_ticks_per_second = 60
		await ticks(2)


func test_a_resting_picture_is_the_body() -> void:
	if not open_viewport():
		return
	for interpolated: bool in [false, true]:
		tree.physics_interpolation = interpolated
		var floor_body := add_solid(rectangle(400, 40), Transform2D(0, Vector2(200, 320)), viewport)
		var body := add_to_view({ "gravity_scale": 1.0, "color": Color.RED, "stiffness": 150.0 })
		await seconds(8)
		var image := await picture()
		for point in polygon_of(body):
			check_pixel(image, point.lerp(body.get_center_of_mass_position(), 0.1), Color.RED, "inside")
			check_pixel(image, point.lerp(body.get_center_of_mass_position(), -0.1), Color(0, 0, 0, 0), "outside")
		body.free()
		floor_body.free()
