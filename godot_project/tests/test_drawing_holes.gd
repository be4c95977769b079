# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## Bodies with holes, seen in pixels.


func _circle(radius: float, count := 32, middle := Vector2.ZERO) -> PackedVector2Array:
	var points := PackedVector2Array()
	for i in count:
		points.append(middle + Vector2.from_angle(TAU * i / count) * radius)
	return points


func _reversed(points: PackedVector2Array) -> PackedVector2Array:
	points.reverse()
	return points


func test_a_hole_is_empty_and_the_rest_is_filled_whichever_way_they_are_wound() -> void:
	if not open_viewport():
		return
	for polygon: PackedVector2Array in [_circle(60), _reversed(_circle(60))]:
		for hole: PackedVector2Array in [_circle(20, 16, Vector2(20, 0)), _reversed(_circle(20, 16, Vector2(20, 0)))]:
			for properties: Dictionary in [{}, {"smooth": true}, {"antialiased": true}, {"detail_mode": SoftBody2D.DETAIL_MODE_POINT_COUNT, "detail_point_count": 16}, {"scale": Vector2(-1, 1)}]:
				var all := {"color": Color.RED, "polygon": polygon, "holes": [hole] as Array[PackedVector2Array], "look": SoftBody2D.LOOK_PLAIN}
				var body := add_to_view(all.merged(properties))
				await ticks(2)
				var image := await picture()
				for place: Vector2 in [Vector2(20, 0), Vector2(8, 8), Vector2(36, 0), Vector2(20, -17)]:
					check_pixel(image, body.to_global(place), CLEAR, "in the hole at %s with %s" % [place, properties])
				for place: Vector2 in [Vector2(-5, 0), Vector2(45, 0), Vector2(20, 25), Vector2(20, -25), Vector2(-40, 20)]:
					check_pixel(image, body.to_global(place), Color.RED, "beside it at %s with %s" % [place, properties])
				body.free()


func test_outline_and_rim_run_along_a_hole_inside_of_the_body() -> void:
	if not open_viewport():
		return
	for properties: Dictionary in [{}, {"antialiased": true}, {"detail_mode": SoftBody2D.DETAIL_MODE_POINT_COUNT, "detail_point_count": 16}]:
		var body := add_to_view({"color": Color.RED, "look": SoftBody2D.LOOK_PLAIN, "polygon": _circle(60), "holes": [_circle(25)] as Array[PackedVector2Array], "outline_width": 6.0, "outline_color": Color.BLUE}.merged(properties))
		await ticks(2)
		var image := await picture()
		for angle in 8:
			var out := Vector2.from_angle(TAU * angle / 8)
			check_pixel(image, body.to_global(out * 22), CLEAR, "hole")
			check_pixel(image, body.to_global(out * 28), Color.BLUE, "outline of the hole")
			check_pixel(image, body.to_global(out * 42), Color.RED, "fill")
			check_pixel(image, body.to_global(out * 57), Color.BLUE, "outline")
			check_pixel(image, body.to_global(out * 63), CLEAR, "outside")
		body.free()
	var soft := add_to_view({"color": Color.RED, "look": SoftBody2D.LOOK_SOFT, "polygon": _circle(60), "holes": [_circle(25)] as Array[PackedVector2Array]})
	await ticks(2)
	var image := await picture()
	var fill := image.get_pixelv(Vector2i(soft.to_global(Vector2(42, 0))))
	for radius: float in [26.0, 58.5]:
		var rim := image.get_pixelv(Vector2i(soft.to_global(Vector2(radius, 0))))
		check_above(fill.r - rim.r, 0.05, "the rim at %d is darker than the fill" % radius)
	check_pixel(image, soft.to_global(Vector2.ZERO), CLEAR, "hole")


func test_a_texture_is_the_same_with_a_hole_but_for_the_hole() -> void:
	if not open_viewport():
		return
	var picture_of := Image.create(64, 64, false, Image.FORMAT_RGBA8)
	for y in 64:
		for x in 64:
			picture_of.set_pixel(x, y, Color(x / 63.0, y / 63.0, 0.5))
	var texture := ImageTexture.create_from_image(picture_of)
	var uv := PackedVector2Array()
	for point in _circle(60):
		uv.append(point.rotated(0.5) * 0.4 + Vector2(32, 32))
	for properties: Dictionary in [{}, {"uv": uv}, {"detail_mode": SoftBody2D.DETAIL_MODE_POINT_COUNT, "detail_point_count": 16}]:
		var images: Array[Image] = []
		for holes: Array[PackedVector2Array] in [[] as Array[PackedVector2Array], [_circle(20, 16, Vector2(20, 0))] as Array[PackedVector2Array]]:
			var body := add_to_view({"polygon": _circle(60), "holes": holes, "texture": texture, "color": Color.WHITE}.merged(properties))
			await ticks(2)
			images.append(await picture())
			for place: Vector2 in [Vector2(-30, 10), Vector2(-5, 0), Vector2(45, 5), Vector2(20, 30)]:
				if not holes.is_empty():
					var pixel := Vector2i(body.to_global(place))
					var difference := images[1].get_pixelv(pixel) - images[0].get_pixelv(pixel)
					check_below(absf(difference.r) + absf(difference.g), 0.06, "the texture at %s with %s" % [place, properties.keys()])
			body.free()


func test_a_ring_that_is_squashed_is_drawn_along_its_interpolated_hole() -> void:
	if not open_viewport():
		return
	var body := add_to_view({"polygon": _circle(60), "holes": [_circle(38)] as Array[PackedVector2Array], "color": Color.RED, "look": SoftBody2D.LOOK_PLAIN})
	await ticks(2)
	var least := 100.0
	for tick in 16:
		for i in body.get_point_count():
			var arm := body.get_point_positions()[i] - body.global_position
			body.apply_point_impulse(i, Vector2(-arm.x, arm.y) * 0.005)
		await ticks(1)
		var image := await picture()
		var hole := body.get_interpolated_holes()[0]
		least = minf(least, hole[0].x - hole[16].x)
		for i in range(0, 32, 4):
			var outwards := (hole[(i + 1) % 32] - hole[i]).orthogonal().normalized() * 3
			var middle := (hole[i] + hole[(i + 1) % 32]) / 2
			check_pixel(image, middle - outwards, CLEAR, "in the hole at point %d" % i)
			check_pixel(image, middle + outwards, Color.RED, "in the wall at point %d" % i)
	check_below(least, 72, "the hole was squashed")
