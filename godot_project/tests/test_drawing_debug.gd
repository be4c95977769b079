# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## What Debug → Visible Collision Shapes shows.


func test_without_the_hint_nothing_is_drawn_besides_the_body() -> void:
	if not open_viewport():
		return
	tree.debug_collisions_hint = false
	var body := add_to_view({ "color": CLEAR })
	await ticks(3)
	check_equal((await picture()).get_used_rect().size, Vector2i.ZERO, "what is drawn of a clear body")
	check_above(body.get_area(), 0, "its area")


func test_with_the_hint_polygon_springs_and_stiffness_are_drawn() -> void:
	if not open_viewport():
		return
	tree.debug_collisions_hint = true
	var body := add_to_view({ "color": CLEAR, "polygon": SoftBody2D.make_box_polygon(Vector2(160, 160), 80),
			"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK })
	tree.debug_collisions_hint = false
	await ticks(3)
	var image := await picture()
	var fill: Color = ProjectSettings.get_setting_with_override("debug/shapes/collision/shape_color")
	# The viewport's picture is multiplied by its alpha.
	fill = Color(fill.r * fill.a, fill.g * fill.a, fill.b * fill.a, fill.a)
	check_pixel(image, body.to_global(Vector2(-60, 25)), fill, "between the springs", 0.1)
	var spring := image.get_pixelv(Vector2i(body.to_global(Vector2(-40, -40))))
	check_above(color_difference(spring, fill), 0.2, "color of a spring against the fill")
	check_pixel(image, body.to_global(Vector2(0, 0)), Color.YELLOW, "the center of mass", 0.2)
	var bright := 0
	for y in range(180, 200):
		for x in range(204, 300):
			bright += int(color_difference(image.get_pixel(x, y), Color.WHITE) < 0.15)
	check_above(bright, 20, "white pixels of the text beside the center")


func test_stretched_springs_are_red_and_pressed_ones_blue() -> void:
	if not open_viewport():
		return
	tree.debug_collisions_hint = true
	var body := add_to_view({ "color": CLEAR, "polygon": SoftBody2D.make_box_polygon(Vector2(120, 120), 60), "mass": 1.0, "collision_mask": 0,
			"stiffness": 0.0, "shape_matching": 0.0, "damping": 0.0 })
	tree.debug_collisions_hint = false
	for i in body.polygon.size():
		body.apply_point_impulse(i, Vector2(body.polygon[i].x, -body.polygon[i].y) * 0.1)
	await ticks(16)
	var image := await picture()
	var polygon := body.get_interpolated_polygon()
	var box := bounds_of(polygon)
	check_above(box.size.x / box.size.y, 1.5, "stretch")
	var center := box.get_center()
	var stretched := image.get_pixelv(Vector2i(center.lerp(Vector2(box.end.x, center.y), 0.6)))
	var pressed := image.get_pixelv(Vector2i(center.lerp(Vector2(center.x, box.end.y), 0.6)))
	check_above(stretched.r - stretched.b, 0.3, "red of a stretched spring")
	check_above(pressed.b - pressed.r, 0.3, "blue of a pressed spring")


func test_contacts_of_a_body_that_monitors_are_drawn_where_they_are() -> void:
	if not open_viewport():
		return
	add_solid(rectangle(400, 40), Transform2D(0, Vector2(200, 300)), viewport) # its top is at 280
	tree.debug_collisions_hint = true
	var body := add_to_view({ "color": CLEAR, "gravity_scale": 1.0, "position": Vector2(200, 225), "contact_monitor": true })
	tree.debug_collisions_hint = false
	var color: Color = ProjectSettings.get_setting_with_override("debug/shapes/collision/contact_color")
	await seconds(3) # at rest
	var image := await picture()
	var lowest := Vector2.ZERO
	for point in body.get_interpolated_polygon():
		lowest = point if point.y > lowest.y else lowest
	check_near(lowest.y, 280, 2, "height of the lowest point")
	# Below it is nothing but the contact's disc.
	check_pixel(image, lowest + Vector2(0, 3), Color(color.r * color.a, color.g * color.a, color.b * color.a, color.a),
			"a contact", 0.1)
	check_pixel(image, Vector2(250, 283), CLEAR, "where nothing touches")
