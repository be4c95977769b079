# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## Skins, seen in pixels.

const COLORS: Array[Color] = [Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW]


# Four quarters.
func _texture() -> Texture2D:
	var image := Image.create(64, 64, false, Image.FORMAT_RGBA8)
	for i in 4:
		image.fill_rect(Rect2i(32 * (i % 2), 32 * (i / 2), 32, 32), COLORS[i])
	return ImageTexture.create_from_image(image)


func _skin_on(body: SoftBody2D) -> SoftBodySkin2D:
	var skin := SoftBodySkin2D.new()
	skin.polygon = SoftBody2D.make_box_polygon(Vector2(64, 64), 16)
	var uv := PackedVector2Array()
	for point in skin.polygon:
		uv.append(point + Vector2(32, 32))
	skin.uv = uv
	skin.texture = _texture()
	body.add_child(skin)
	return skin


func test_the_texture_of_a_skin_goes_with_a_body_that_grows_and_the_body_is_hidden_by_self_modulate() -> void:
	if not open_viewport():
		return
	var body := add_to_view({"polygon": SoftBody2D.make_circle_polygon(45, 24), "gravity_scale": 0.0, "inflation": 2.0, "self_modulate": Color(1, 1, 1, 0)})
	_skin_on(body)
	await seconds(2)
	var image := await picture()
	var factor := bounds_of(polygon_of(body)).size.x / 90
	check_above(factor, 1.15, "how much the body has grown")
	for i in 4:
		var out := Vector2(i % 2 - 0.5, i / 2 - 0.5) * 2
		for share: float in [6.0, 29.0]:
			check_pixel(image, body.to_global(out * share * factor), COLORS[i], "quarter %d at %s" % [i, share])
		check_pixel(image, body.to_global(out * 35 * factor), CLEAR, "beyond quarter %d" % i)
	check_pixel(image, body.to_global(Vector2(40, 0) * factor), CLEAR, "where the hidden body is")


func test_a_skin_is_drawn_where_the_body_turns() -> void:
	if not open_viewport():
		return
	var body := add_to_view({"polygon": SoftBody2D.make_circle_polygon(45, 24), "gravity_scale": 0.0, "self_modulate": Color(1, 1, 1, 0)})
	_skin_on(body)
	body.angular_velocity = 2.0
	await seconds(1)
	var image := await picture()
	check_above(absf(body.rotation), 1.0, "turn")
	for i in 4:
		check_pixel(image, body.get_interpolated_transform() * (Vector2(i % 2 - 0.5, i / 2 - 0.5) * 32), COLORS[i], "quarter %d" % i)
