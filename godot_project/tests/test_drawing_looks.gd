# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## Outline, colors, textures and what a CanvasItem can: seen in pixels, and beside a Polygon2D that shows the same.

const U_SHAPE: Array[Vector2] = [Vector2(-90, -60), Vector2(-50, -60), Vector2(-40, 30), Vector2(40, 30),
	Vector2(50, -60), Vector2(90, -60), Vector2(90, 80), Vector2(-90, 80)]
## Outlines of both windings, convex and dented.
const POLYGONS := 4


func _polygon(index: int) -> PackedVector2Array:
	var polygon := SoftBody2D.make_box_polygon(Vector2(160, 100), 20) if index < 2 else PackedVector2Array(U_SHAPE)
	if index % 2 == 1:
		polygon.reverse()
	return polygon


## Smooth, and different everywhere: red grows to the right, green downwards, blue alternates in cells of 8 pixels.
func _map_texture(size := Vector2i(64, 64)) -> ImageTexture:
	var image := Image.create(size.x, size.y, false, Image.FORMAT_RGBA8)
	for y in size.y:
		for x in size.x:
			var cell := (x >> 3) + (y >> 3) & 1
			image.set_pixel(x, y, Color((x + 0.5) / size.x, (y + 0.5) / size.y, 0.5 * cell))
	return ImageTexture.create_from_image(image)


func _plain_texture(color: Color, size := Vector2i(8, 8)) -> ImageTexture:
	var image := Image.create(size.x, size.y, false, Image.FORMAT_RGBA8)
	image.fill(color)
	return ImageTexture.create_from_image(image)


## The same outline as a Polygon2D in a viewport of its own, with the same values of what both have.
func _check_like_polygon(body: SoftBody2D, names: PackedStringArray, what: String, share := 0.002) -> void:
	var other := make_viewport(viewport.size)
	other.world_2d = World2D.new()
	var polygon := Polygon2D.new()
	polygon.polygon = body.polygon
	polygon.transform = body.transform
	for name in names:
		polygon.set(name, body.get(name))
	other.add_child(polygon)
	await ticks(2)
	await RenderingServer.frame_post_draw
	check_same_picture(viewport.get_texture().get_image(), other.get_texture().get_image(), what, share)
	other.free()


func test_the_outline_lies_inside_the_polygon_and_is_as_wide_as_asked() -> void:
	if not open_viewport():
		return
	for index in POLYGONS:
		var body := add_to_view({ "polygon": _polygon(index), "color": Color.RED, "outline_width": 10.0,
				"outline_color": Color.BLUE })
		await ticks(2)
		var image := await picture()
		var left := -80.0 if index < 2 else -90.0
		var bottom := 50.0 if index < 2 else 80.0
		check_pixel(image, body.to_global(Vector2(left + 2, 40)), Color.BLUE, "near the outer edge")
		check_pixel(image, body.to_global(Vector2(left + 8, 40)), Color.BLUE, "near the inner edge")
		check_pixel(image, body.to_global(Vector2(left + 13, 20)), Color.RED, "inside of the outline")
		check_pixel(image, body.to_global(Vector2(left - 2, 40)), CLEAR, "outside")
		check_pixel(image, body.to_global(Vector2(0, bottom - 8)), Color.BLUE, "at the bottom")
		check_pixel(image, body.to_global(Vector2(0, bottom - 13)), Color.RED, "above the bottom's outline")
		body.free()


func test_at_the_tip_of_a_dent_the_outline_is_round() -> void:
	if not open_viewport():
		return
	var polygon := PackedVector2Array([Vector2(-90, -60), Vector2(-8, -60), Vector2(0, 0), Vector2(8, -60), Vector2(90, -60),
			Vector2(90, 80), Vector2(-90, 80)])
	for clockwise: bool in [false, true]:
		if clockwise:
			polygon.reverse()
		add_to_view({ "polygon": polygon, "color": Color.RED, "outline_width": 12.0, "outline_color": Color.BLUE })
		await ticks(2)
		var image := await picture()
		for angle: float in [0.3, 0.8, 1.57, 2.3, 2.8]:
			check_pixel(image, middle() + Vector2.from_angle(angle) * 10, Color.BLUE, "within the width around the tip")
			check_pixel(image, middle() + Vector2.from_angle(angle) * 14.5, Color.RED, "beyond the width around the tip")
		viewport.get_child(0).free()


func test_without_a_fill_only_the_outline_is_seen() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": CLEAR, "outline_width": 6.0, "outline_color": Color.GREEN })
	await ticks(2)
	var image := await picture()
	check_pixel(image, body.global_position, CLEAR, "the middle")
	check_pixel(image, body.global_position + Vector2(46, 0), Color.GREEN, "the outline")
	body.outline_width = 0
	await ticks(2)
	check_pixel(await picture(), body.global_position + Vector2(46, 0), CLEAR, "the outline that was taken away")
	body.color = Color.GREEN
	await ticks(2)
	check_pixel(await picture(), body.global_position, Color.GREEN, "the fill that was given back")


func test_the_outlines_texture_runs_along_the_polygon_from_outside_in() -> void:
	if not open_viewport():
		return
	# Above yellow, below blue; a red column at its start.
	var image_file := Image.create(32, 16, false, Image.FORMAT_RGBA8)
	for y in 16:
		for x in 32:
			image_file.set_pixel(x, y, Color.RED if x < 4 else Color.YELLOW if y < 8 else Color.BLUE)
	var body := add_to_view({ "polygon": SoftBody2D.make_box_polygon(Vector2(200, 160), 20), "outline_width": 16.0,
			"outline_color": Color.WHITE, "outline_texture": ImageTexture.create_from_image(image_file), "color": Color.WHITE })
	body.texture_repeat = CanvasItem.TEXTURE_REPEAT_ENABLED
	body.texture_filter = CanvasItem.TEXTURE_FILTER_NEAREST
	await ticks(2)
	var image := await picture()
	# A tile is as long as 2 widths; 720 pixels around hold 22.5 of them, so 22 or 23 are shown, none cut.
	var reds := 0
	var was_red := false
	var outer := 0
	var inner := 0
	for x in range(-70, 70):
		var color := image.get_pixelv(Vector2i(body.to_global(Vector2(x, -76))))
		var is_red := color_difference(color, Color.RED) < 0.1
		reds += int(is_red and not was_red)
		was_red = is_red
		outer += int(color_difference(color, Color.YELLOW) < 0.1)
		inner += int(color_difference(image.get_pixelv(Vector2i(body.to_global(Vector2(x, -67)))), Color.BLUE) < 0.1)
	check(reds >= 4 and reds <= 5, "%d tiles begin on 140 pixels" % reds)
	check_above(outer, 100, "yellow pixels on the outer half")
	check_above(inner, 100, "blue pixels on the inner half")

	body.outline_texture_mode = SoftBody2D.OUTLINE_TEXTURE_STRETCH
	await ticks(2)
	image = await picture()
	var red_pixels := 0
	for y in image.get_height():
		for x in image.get_width():
			red_pixels += int(color_difference(image.get_pixel(x, y), Color.RED) < 0.1)
	# One eighth of the way around.
	check_near(red_pixels, 720 / 8.0 * 16, 400, "red pixels of a texture that goes around once")


func test_along_a_cut_there_is_a_band_instead_of_the_outline() -> void:
	if not open_viewport():
		return
	for antialiased: bool in [false, true]:
		for smooth: bool in [false, true]:
			for clockwise: bool in [false, true]:
				var polygon := SoftBody2D.make_box_polygon(Vector2(160, 100), 20)
				if clockwise:
					polygon.reverse()
				var body := add_to_view({ "polygon": polygon, "color": Color.RED, "outline_width": 10.0, "outline_color": Color.BLUE,
						"cut_width": 6.0, "cut_color": Color.GREEN, "antialiased": antialiased, "smooth": smooth, "freeze": true, "gravity_scale": 0.0 })
				await ticks(1)
				var pieces := body.cut(body.global_position + Vector2(20, -90), body.global_position + Vector2(20, 90))
				check_equal(pieces.size(), 2, "pieces")
				await ticks(1)
				var image := await picture()
				check_pixel(image, middle() + Vector2(17, 0), Color.GREEN, "left of the cut")
				check_pixel(image, middle() + Vector2(23, 0), Color.GREEN, "right of the cut")
				check_pixel(image, middle() + Vector2(11, 0), Color.RED, "left of the band")
				check_pixel(image, middle() + Vector2(29, 0), Color.RED, "right of the band")
				check_pixel(image, middle() + Vector2(-75, 0), Color.BLUE, "the outline")
				check_pixel(image, middle() + Vector2(-20, 45), Color.BLUE, "the outline at the bottom")
				for piece in pieces:
					piece.cut_width = 0
				await ticks(1)
				check_pixel(await picture(), middle() + Vector2(17, 0), Color.BLUE, "the outline along the cut")
				for piece in pieces:
					piece.free()


func test_what_was_cut_all_around_has_no_outline() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "polygon": SoftBody2D.make_box_polygon(Vector2(160, 100), 20), "color": Color.RED, "outline_width": 10.0,
			"outline_color": Color.BLUE, "cut_width": 6.0, "cut_color": Color.GREEN })
	body.cut_edges = PackedInt32Array(range(body.polygon.size()))
	await ticks(2)
	var image := await picture()
	check_pixel(image, middle() + Vector2(-77, 0), Color.GREEN, "the left side")
	check_pixel(image, middle() + Vector2(-71, 0), Color.RED, "inside of the band")
	body.cut_edges = PackedInt32Array()
	await ticks(2)
	image = await picture()
	check_pixel(image, middle() + Vector2(-77, 0), Color.BLUE, "the left side of one that was not cut")


func test_vertex_colors_blend_between_the_polygon_points() -> void:
	if not open_viewport():
		return
	for clockwise: bool in [false, true]:
		var polygon := SoftBody2D.make_box_polygon(Vector2(160, 100), 20)
		if clockwise:
			polygon.reverse()
		var colors := PackedColorArray()
		for point in polygon:
			colors.append(Color((point.x + 80) / 160, (point.y + 50) / 100, 0))
		var body := add_to_view({ "polygon": polygon, "vertex_colors": colors })
		await ticks(2)
		var image := await picture()
		for place: Vector2 in [Vector2(0, 0), Vector2(-70, 40), Vector2(60, -30), Vector2(30, 10)]:
			check_pixel(image, body.to_global(place), Color((place.x + 80) / 160, (place.y + 50) / 100, 0), "blended color")
		body.color = Color(0.5, 1, 1)
		await ticks(2)
		check_pixel(await picture(), body.to_global(Vector2(60, 0)), Color(0.5 * 140 / 160, 0.5, 0), "tinted color")
		body.free()


func test_vertex_colors_of_a_dented_body_look_like_those_of_a_polygon() -> void:
	if not open_viewport():
		return
	for clockwise: bool in [false, true]:
		var polygon := PackedVector2Array(U_SHAPE)
		var colors := PackedColorArray()
		for i in polygon.size():
			colors.append(Color(polygon[i].x / 200 + 0.5, polygon[i].y / 200 + 0.5, 0.2))
		if clockwise:
			polygon.reverse()
			colors.reverse()
		# Linear in the plane, so that it does not matter how the triangles are laid.
		var body := add_to_view({ "polygon": polygon, "vertex_colors": colors, "rotation": 0.4, "scale": Vector2(1.2, 0.9) })
		await _check_like_polygon(body, ["vertex_colors"], "a body with vertex colors", 0.02)
		body.free()


func test_colors_and_coordinates_of_another_number_are_left_out_and_warned_of() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED, "vertex_colors": PackedColorArray([Color.BLUE, Color.GREEN]),
			"uv": PackedVector2Array([Vector2.ZERO]) })
	await ticks(2)
	check_pixel(await picture(), body.global_position, Color.RED, "a body whose colors do not fit")
	var warnings := "\n".join(body.get_warnings())
	check("vertex_colors" in warnings and "'uv'" in warnings, "the warnings say nothing of it: " + warnings)
	body.vertex_colors = PackedColorArray()
	body.uv = PackedVector2Array()
	check_equal(body.get_warnings(), PackedStringArray(), "warnings")


func test_uv_with_offset_rotation_and_scale_show_what_a_polygon_shows() -> void:
	if not open_viewport():
		return
	var texture := _map_texture()
	for index in POLYGONS:
		var polygon := _polygon(index)
		var uv := PackedVector2Array()
		for point in polygon:
			uv.append((point + Vector2(100, 90)) * 0.3)
		var body := add_to_view({ "polygon": polygon, "texture": texture, "uv": uv, "texture_offset": Vector2(4, -3),
				"texture_rotation": 0.2, "texture_scale": Vector2(0.8, 1.1), "rotation": 0.3, "color": Color(1, 0.9, 0.8) })
		await _check_like_polygon(body, ["texture", "uv", "texture_offset", "texture_rotation", "texture_scale", "color"],
				"a body with uv", 0.02)
		body.free()


func test_without_uv_the_texture_turns_and_scales_around_the_middle() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "polygon": SoftBody2D.make_box_polygon(Vector2(160, 160), 20), "texture": _map_texture(),
			"texture_scale": Vector2(0.5, 0.5) })
	body.texture_filter = CanvasItem.TEXTURE_FILTER_LINEAR
	await ticks(2)
	var image := await picture()
	for place: Vector2 in [Vector2(-40, 36), Vector2(60, 20), Vector2(4, -60)]:
		var color := image.get_pixelv(Vector2i(body.to_global(place)))
		check_near(color.r, 0.5 + place.x / 320, 0.03, "red of the texture enlarged twice at %s" % place)
		check_near(color.g, 0.5 + place.y / 320, 0.03, "green of the texture enlarged twice at %s" % place)
	body.texture_scale = Vector2.ONE
	body.texture_rotation = PI / 2
	await ticks(2)
	image = await picture()
	var turned := image.get_pixelv(Vector2i(body.to_global(Vector2(40, 8))))
	check_near(turned.r, 0.5 - 8 / 160.0, 0.03, "red of the turned texture")
	check_near(turned.g, 0.5 + 40 / 160.0, 0.03, "green of the turned texture")
	body.texture_rotation = 0
	body.texture_offset = Vector2(8, 0)
	await ticks(2)
	check_near((await picture()).get_pixelv(Vector2i(middle())).r, 0.5 + 8 / 64.0, 0.03, "red of the moved texture")


func test_a_part_of_an_atlas_is_a_texture() -> void:
	if not open_viewport():
		return
	var image_file := Image.create(64, 64, false, Image.FORMAT_RGBA8)
	image_file.fill(Color.RED)
	image_file.fill_rect(Rect2i(32, 16, 16, 16), Color.GREEN)
	image_file.fill_rect(Rect2i(40, 16, 8, 16), Color.BLUE)
	var atlas := AtlasTexture.new()
	atlas.atlas = ImageTexture.create_from_image(image_file)
	atlas.region = Rect2(32, 16, 16, 16)
	var body := add_to_view({ "texture": atlas })
	body.texture_filter = CanvasItem.TEXTURE_FILTER_NEAREST
	await ticks(2)
	var image := await picture()
	check_pixel(image, body.to_global(Vector2(-30, 20)), Color.GREEN, "left half of the part")
	check_pixel(image, body.to_global(Vector2(30, -20)), Color.BLUE, "right half of the part")
	atlas.region = Rect2(0, 0, 16, 16)
	await ticks(2)
	check_pixel(await picture(), body.to_global(Vector2(30, -20)), Color.RED, "another part")


func test_the_texture_sticks_to_a_body_that_is_squashed() -> void:
	if not open_viewport():
		return
	add_solid(rectangle(400, 40), Transform2D(0, Vector2(200, 380)), viewport)
	var image_file := Image.create(2, 2, false, Image.FORMAT_RGBA8)
	var corners: Array[Color] = [Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW]
	for i in 4:
		image_file.set_pixel(i & 1, i >> 1, corners[i])
	for with_middle: bool in [true, false]:
		var body := add_to_view({ "polygon": SoftBody2D.make_circle_polygon(80, 24), "gravity_scale": 1.0, "stiffness": 14.0,
				"texture": ImageTexture.create_from_image(image_file), "rotation": 0.5, "center_point": with_middle,
				"pressure": 0.0 if with_middle else 60.0, "position": Vector2(200, 250) })
		body.texture_filter = CanvasItem.TEXTURE_FILTER_NEAREST
		await ticks(45)
		var squashed := false
		for moment in 4:
			await ticks(7)
			var image := await picture()
			var drawn := body.get_interpolated_polygon()
			var center := Vector2.ZERO
			for point in drawn:
				center += point / drawn.size()
			var box := bounds_of(drawn)
			squashed = squashed or box.size.x / box.size.y > 1.1
			for i in drawn.size():
				var rest := body.polygon[i]
				if minf(absf(rest.x), absf(rest.y)) > 15:
					var quarter := int(rest.x > 0) + 2 * int(rest.y > 0)
					check_pixel(image, drawn[i].lerp(center, 0.15), corners[quarter], "the texture near polygon point %d" % i)
		check(squashed, "the body was not squashed")
		body.free()


func test_antialiased_edges_fade_over_a_pixel_and_keep_their_place() -> void:
	if not open_viewport():
		return
	var polygon := PackedVector2Array([Vector2(-80, -60), Vector2(80, -40), Vector2(80, 60), Vector2(-80, 60)])
	for outline: float in [0.0, 8.0]:
		var body := add_to_view({ "polygon": polygon, "color": Color.WHITE, "outline_width": outline,
				"outline_color": Color.WHITE })
		var areas := PackedFloat64Array()
		var partial := PackedInt32Array()
		for smooth: bool in [false, true]:
			body.antialiased = smooth
			await ticks(2)
			var image := await picture()
			var sum := 0.0
			var count := 0
			for y in image.get_height():
				for x in image.get_width():
					var alpha := image.get_pixel(x, y).a
					sum += alpha
					count += int(alpha > 0.1 and alpha < 0.9)
			areas.append(sum)
			partial.append(count)
		check_equal(partial[0], 0, "half covered pixels without smoothing")
		# The upper edge alone, which is the only one that lies slantwise.
		check_above(partial[1], 100, "half covered pixels with smoothing")
		check_near(areas[1], areas[0], 0.015 * areas[0], "area with smoothing")
		body.free()


func test_a_smooth_body_is_rounder_than_its_polygon() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "polygon": SoftBody2D.make_circle_polygon(100, 8), "color": Color.WHITE })
	await ticks(2)
	var between := Vector2.from_angle(PI / 8) * 97
	check_pixel(await picture(), body.global_position + between, CLEAR, "beyond a straight edge")
	body.smooth = true
	await ticks(2)
	check_pixel(await picture(), body.global_position + between, Color.WHITE, "within the curve")
	body.outline_width = 5
	body.outline_color = Color.RED
	await ticks(2)
	check_pixel(await picture(), body.global_position + Vector2.from_angle(PI / 8) * 95, Color.RED, "the curve's outline")


func test_shaders_see_coordinates_colors_and_places() -> void:
	if not open_viewport():
		return
	var shader := Shader.new()
	shader.code = """shader_type canvas_item;
varying vec2 place;
void vertex() { place = VERTEX; }
void fragment() { COLOR = vec4(UV, place.x / 200.0 + 0.5, COLOR.a); }"""
	var material := ShaderMaterial.new()
	material.shader = shader
	var body := add_to_view({ "polygon": SoftBody2D.make_box_polygon(Vector2(160, 100), 20), "rotation": 0.3,
			"material": material, "color": Color(1, 0, 0, 0.5) })
	await ticks(3)
	var image := await picture()
	for place: Vector2 in [Vector2(-60, 30), Vector2(20, -40), Vector2(5, 5)]:
		var color := image.get_pixelv(Vector2i(body.to_global(place)))
		check_near(color.a, 0.5, 0.05, "alpha that the shader took from the color")
		# The viewport's picture is multiplied by its alpha.
		check_near(color.r / color.a, (place.x + 80) / 160, 0.05, "UV.x at %s" % place)
		check_near(color.g / color.a, (place.y + 50) / 100, 0.05, "UV.y at %s" % place)
		check_near(color.b / color.a, place.x / 200 + 0.5, 0.05, "VERTEX.x at %s" % place)


func test_modulate_self_modulate_and_visibility_do_what_they_do_elsewhere() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.WHITE, "self_modulate": Color(1, 0.5, 0.5), "modulate": Color(0.5, 1, 1),
			"outline_width": 8.0, "outline_color": Color.WHITE })
	await ticks(2)
	var image := await picture()
	check_pixel(image, body.global_position, Color(0.5, 0.5, 0.5), "modulated fill")
	check_pixel(image, body.global_position + Vector2(45, 0), Color(0.5, 0.5, 0.5), "modulated outline")
	body.hide()
	await ticks(2)
	check_pixel(await picture(), body.global_position, CLEAR, "a hidden body")
	body.global_position += Vector2(60, 0)
	body.show()
	await ticks(2)
	image = await picture()
	check_pixel(image, body.global_position, Color(0.5, 0.5, 0.5), "a body shown again")
	check_pixel(image, body.global_position - Vector2(70, 0), CLEAR, "where it was hidden")


func test_light_falls_only_on_bodies_with_its_mask() -> void:
	if not open_viewport():
		return
	var dark := CanvasModulate.new()
	dark.color = Color(0.1, 0.1, 0.1)
	viewport.add_child(dark)
	var light := PointLight2D.new()
	light.texture = _plain_texture(Color.WHITE, Vector2i(400, 400))
	light.position = middle()
	light.range_item_cull_mask = 2
	viewport.add_child(light)
	var lit := add_to_view({ "position": Vector2(100, 200), "light_mask": 2 })
	var unlit := add_to_view({ "position": Vector2(300, 200) })
	await ticks(3)
	var image := await picture()
	check_above(image.get_pixelv(Vector2i(lit.global_position)).r, 0.8, "brightness of the body that the light means")
	check_below(image.get_pixelv(Vector2i(unlit.global_position)).r, 0.2, "brightness of the other")


func test_order_follows_the_tree_and_z_index() -> void:
	if not open_viewport():
		return
	var first := add_to_view({ "color": Color.RED, "collision_mask": 0, "collision_layer": 0 })
	var second := add_to_view({ "color": Color.GREEN, "collision_mask": 0, "collision_layer": 0 })
	await ticks(2)
	check_pixel(await picture(), middle(), Color.GREEN, "the later one")
	first.z_index = 1
	await ticks(2)
	check_pixel(await picture(), middle(), Color.RED, "the one with the higher z")
	second.reparent(first)
	second.show_behind_parent = true
	first.color = Color(1, 0, 0, 0.5)
	second.color = Color.GREEN
	await ticks(2)
	check_pixel(await picture(), middle(), Color(0.5, 0.5, 0, 1), "a child behind its parent", 0.08)


func test_children_can_be_clipped_to_the_body() -> void:
	if not open_viewport():
		return
	var body := add_to_view({ "color": Color.RED, "clip_children": CanvasItem.CLIP_CHILDREN_AND_DRAW })
	var child := Polygon2D.new()
	child.polygon = PackedVector2Array([Vector2(-150, -15), Vector2(150, -15), Vector2(150, 15), Vector2(-150, 15)])
	child.color = Color.GREEN
	body.add_child(child)
	await ticks(3)
	var image := await picture()
	check_pixel(image, body.global_position, Color.GREEN, "the child on the body")
	check_pixel(image, body.global_position + Vector2(0, 30), Color.RED, "the body beside the child")
	check_pixel(image, body.global_position + Vector2(70, 0), CLEAR, "the child outside of the body")


func test_what_a_script_draws_stays_on_top_while_the_body_moves() -> void:
	if not open_viewport():
		return
	var script := GDScript.new()
	script.source_code = "\n".join(["extends SoftBody2D", "var count := 0", "func _draw() -> void:", "\tcount += 1",
			"\tdraw_circle(Vector2.ZERO, 20, Color.BLUE)"])
	script.reload()
	var body := add_to_view({ "color": Color.RED, "position": Vector2(100, 200) })
	body.set_script(script)
	var signalled := add_to_view({ "color": Color.RED, "position": Vector2(100, 80) })
	signalled.draw.connect(func() -> void: signalled.draw_circle(Vector2.ZERO, 20, Color.GREEN))
	body.queue_redraw()
	for each: SoftBody2D in [body, signalled]:
		each.apply_central_impulse(Vector2(100, 0))
	await ticks(30)
	await RenderingServer.frame_post_draw
	await RenderingServer.frame_post_draw
	var image := viewport.get_texture().get_image()
	check_above(body.get_interpolated_transform().origin.x, 140, "place of the body")
	check_pixel(image, body.get_interpolated_transform().origin, Color.BLUE, "what the script drew")
	check_pixel(image, body.get_interpolated_transform().origin + Vector2(30, 0), Color.RED, "the body beside it")
	check_pixel(image, signalled.get_interpolated_transform().origin, Color.GREEN, "what a handler of the signal drew")
	check_below(int(body.get("count")), 6, "how often the script was asked to draw in 30 ticks")


func test_a_folded_body_has_no_hole() -> void:
	if not open_viewport():
		return
	for middle_point: bool in [true, false]:
		var body := add_to_view({ "polygon": SoftBody2D.make_circle_polygon(90, 16), "mass": 1.0, "color": Color.WHITE,
				"center_point": middle_point, "stiffness": 0.0, "shape_matching": 0.0, "damping": 0.0, "collision_mask": 0 })
		# Each point for itself: every second one flies inwards, past the middle.
		for i in range(0, 16, 2):
			body.apply_point_impulse(i, -body.polygon[i].normalized() * 40)
		await ticks(13)
		var image := await picture()
		var polygon := body.get_interpolated_polygon()
		var claims := 0
		for y in range(100, 300, 7):
			for x in range(100, 300, 7):
				var place := Vector2(x, y) + Vector2(0.5, 0.5)
				if _winding(place, polygon) != 0 and _distance(place, polygon) > 1.5:
					check_pixel(image, Vector2(x, y), Color.WHITE, "inside the folded polygon")
					claims += 1
		check_above(claims, 50, "places inside")
		body.free()


func _winding(place: Vector2, polygon: PackedVector2Array) -> int:
	var sum := 0.0
	for i in polygon.size():
		sum += (polygon[i - 1] - place).angle_to(polygon[i] - place)
	return roundi(sum / TAU)


func _distance(place: Vector2, polygon: PackedVector2Array) -> float:
	var least := INF
	for i in polygon.size():
		least = minf(least, place.distance_to(Geometry2D.get_closest_point_to_segment(place, polygon[i - 1], polygon[i])))
	return least


func test_bad_widths_are_refused() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "outline_width": 3.0 })
	body.name = "Jelly"
	for width: float in [-1.0, NAN, INF]:
		check_refused(func() -> void: body.outline_width = width, ["Jelly", "outline_width"], "a width of %s" % width)
		check_equal(body.outline_width, 3.0, "the width after that")


## A picture of everything at once, in a body at rest and in one that is squashed.
func test_it_looks_as_it_did() -> void:
	if not open_viewport(Vector2i(320, 200)):
		return
	add_solid(rectangle(400, 40), Transform2D(0, Vector2(160, 210)), viewport)
	var polygon := SoftBody2D.make_circle_polygon(55, 20)
	var colors := PackedColorArray()
	for i in polygon.size():
		colors.append(Color.from_hsv(i / 20.0, 0.5, 1))
	var common := { "polygon": polygon, "antialiased": true, "smooth": true, "outline_width": 7.0, "gravity_scale": 1.0 }
	var left := add_to_view(common.merged({ "position": Vector2(80, 110), "texture": _map_texture(), "stiffness": 40.0,
			"outline_color": Color(0.1, 0.1, 0.3) }))
	var right := add_to_view(common.merged({ "position": Vector2(235, 110), "vertex_colors": colors, "stiffness": 150.0,
			"outline_color": Color.WHITE, "outline_texture": _map_texture(Vector2i(32, 8)) }))
	right.texture_repeat = CanvasItem.TEXTURE_REPEAT_ENABLED
	await ticks(14)
	for body: SoftBody2D in [left, right]:
		body.process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(3)
	check_like_stored(await picture(), "looks")
