# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## A fine outline is drawn over a hull of few points: seen in pixels.

const FineOutlines := preload("res://tests/support/fine_outlines.gd")


func _map_texture() -> ImageTexture:
	var image := Image.create(64, 64, false, Image.FORMAT_RGBA8)
	for y in 64:
		for x in 64:
			image.set_pixel(x, y, Color(x / 63.0, y / 63.0, 0.5 * ((x >> 3) + (y >> 3) & 1)))
	return ImageTexture.create_from_image(image)


func _drawn(properties: Dictionary, mode: int) -> Image:
	var body := add_to_view({"polygon": FineOutlines.character(), "scale": Vector2(2, 2)}.merged(properties))
	body.detail_mode = mode
	await ticks(2)
	var image := await picture()
	body.free()
	return image


func test_at_rest_a_body_of_less_detail_looks_as_drawn() -> void:
	if not open_viewport():
		return
	for properties: Dictionary in [{"color": Color.RED}, {"color": Color.ORANGE, "outline_width": 4.0, "outline_color": Color.BLACK},
			{"texture": _map_texture()}, {"color": Color.GREEN, "smooth": true}]:
		var expected := await _drawn(properties, SoftBody2D.DETAIL_MODE_AS_DRAWN)
		var actual := await _drawn(properties, SoftBody2D.DETAIL_MODE_AUTOMATIC)
		check_same_picture(actual, expected, "a character with %s" % [properties.keys()])


func test_its_own_texture_places_and_colors_are_those_of_the_drawn_points() -> void:
	if not open_viewport():
		return
	var uv := PackedVector2Array()
	var colors := PackedColorArray()
	for point in FineOutlines.character():
		uv.append(point.rotated(0.5) * 0.4 + Vector2(32, 32))
		colors.append(Color(0.5 + point.x / 200, 0.5 + point.y / 200, 0.2))
	for properties: Dictionary in [{"texture": _map_texture(), "uv": uv}, {"color": Color.WHITE, "vertex_colors": colors}]:
		var expected := await _drawn(properties, SoftBody2D.DETAIL_MODE_AS_DRAWN)
		var actual := await _drawn(properties, SoftBody2D.DETAIL_MODE_AUTOMATIC)
		check_same_picture(actual, expected, "a character with %s" % [properties.keys()])


func test_a_squashed_body_is_drawn_along_its_interpolated_polygon() -> void:
	if not open_viewport():
		return
	var body := add_to_view({"polygon": FineOutlines.character(), "color": Color.RED, "detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC})
	await ticks(2)
	for tick in 12:
		for i in body.get_point_count():
			var arm := body.get_point_positions()[i] - body.global_position
			body.apply_point_impulse(i, Vector2(-arm.x, arm.y) * 0.02)
		await ticks(1)
		var image := await picture()
		var polygon := body.get_interpolated_polygon()
		for i in range(0, 200, 10):
			var outwards := (polygon[(i + 1) % 200] - polygon[i]).orthogonal().normalized() * 3
			check_pixel(image, polygon[i] + outwards, CLEAR, "outside of point %d" % i)
			check_pixel(image, polygon[i] - outwards, Color.RED, "inside of point %d" % i)
