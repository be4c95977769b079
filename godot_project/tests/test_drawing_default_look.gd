# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## A node on which nothing is set looks soft; one that has a look of its own looks as before.

const DARK := Color(0.15, 0.15, 0.16)
const LIGHT := Color(0.93, 0.93, 0.94)


func _add_new(properties := {}) -> SoftBody2D:
	return add_to_view({"look": SoftBody2D.LOOK_AUTOMATIC}.merged(properties, true))


# WCAG 2.1, relative luminance and contrast.
func _luminance(color: Color) -> float:
	var linear := color.srgb_to_linear()
	return 0.2126 * linear.r + 0.7152 * linear.g + 0.0722 * linear.b


func _contrast(a: Color, b: Color) -> float:
	var first := _luminance(a)
	var second := _luminance(b)
	return (maxf(first, second) + 0.05) / (minf(first, second) + 0.05)


func test_a_new_node_has_a_fill_a_darker_rim_and_a_soft_round_edge() -> void:
	if not open_viewport():
		return
	var body := _add_new()
	check_equal(body.get_look_in_use(), SoftBody2D.LOOK_SOFT, "look")
	await ticks(2)
	var image := await picture()
	var fill := image.get_pixelv(Vector2i(middle()))
	check_pixel(image, middle(), body.get_color_in_use(), "the fill")
	check_above(_luminance(fill), 2 * _luminance(image.get_pixelv(Vector2i(middle() + Vector2(0, 48.5)))), "brightness of the fill, to the rim's")
	# A regular polygon of 16 corners has edges 0.96 px inside of the circle; the smooth edge is round within a third of a pixel.
	for i in 32:
		var direction := Vector2.from_angle(TAU * i / 32)
		var covered := 0.0
		for k in 80:
			var place := middle() + direction * (46 + 0.1 * k)
			covered += 0.1 * image.get_pixelv(Vector2i(place)).a
		check_near(46 + covered, 50.0, 0.8, "reach of the fill at angle %d" % i)


func test_its_color_stands_out_from_a_dark_and_from_a_light_canvas() -> void:
	var body := SoftBody2D.new()
	for canvas: Color in [DARK, LIGHT, Color(0.3, 0.3, 0.3)]:
		check_above(_contrast(body.get_color_in_use(), canvas), 2.5, "contrast with %s" % canvas)
	body.free()


func test_what_is_set_by_a_scene_or_script_looks_as_before() -> void:
	if not open_viewport():
		return
	var texture := GradientTexture2D.new()
	texture.gradient = Gradient.new()
	var material := CanvasItemMaterial.new()
	for properties: Dictionary in [{"color": Color.RED}, {"texture": texture}, {"outline_width": 4.0}, {"smooth": true}, {"antialiased": true},
			{"modulate": Color.RED}, {"self_modulate": Color.RED}, {"material": material}, {"uv": PackedVector2Array([Vector2.ONE])},
			{"vertex_colors": PackedColorArray([Color.RED])}, {"outline_texture": texture}]:
		var body := _add_new(properties)
		check_equal(body.get_look_in_use(), SoftBody2D.LOOK_PLAIN, "look with %s" % properties)
		await ticks(2)
		var automatic := await picture()
		body.look = SoftBody2D.LOOK_PLAIN
		await ticks(1)
		check_same_picture(automatic, await picture(), "with %s" % properties, 1e-9)
		body.free()


func test_one_that_blinks_keeps_its_look() -> void:
	var body := add_body()
	body.modulate = Color(1, 1, 1, 0.5)
	check_equal(body.get_look_in_use(), SoftBody2D.LOOK_SOFT, "look")
	stage.remove_child(body)
	stage.add_child(body)
	check_equal(body.get_look_in_use(), SoftBody2D.LOOK_SOFT, "look in the tree again")


func test_the_soft_look_takes_any_color_texture_and_outline() -> void:
	if not open_viewport():
		return
	var body := _add_new({"look": SoftBody2D.LOOK_SOFT, "color": Color.TOMATO})
	await ticks(2)
	check_pixel(await picture(), middle(), Color.TOMATO, "the fill")
	body.color = Color.WHITE
	await ticks(1)
	check_pixel(await picture(), middle(), Color.WHITE, "a white one")
	body.outline_width = 6.0
	body.outline_color = Color.BLUE
	await ticks(1)
	var image := await picture()
	check_pixel(image, middle() + Vector2(0, 47), Color.BLUE, "an outline instead of the rim")
	check_pixel(image, middle() + Vector2(0, 42), Color.WHITE, "the fill beside it")
	body.outline_width = 0.0
	var red := Image.create(8, 8, false, Image.FORMAT_RGBA8)
	red.fill(Color.RED)
	body.texture = ImageTexture.create_from_image(red)
	await ticks(1)
	image = await picture()
	check_pixel(image, middle(), Color.RED, "the texture")
	check_below(image.get_pixelv(Vector2i(middle() + Vector2(0, 48.5))).r, 0.75, "red of the texture at the rim")


func test_pieces_of_a_cut_stay_soft() -> void:
	var body := add_weightless_body()
	await ticks(1)
	body.modulate = Color(1, 1, 1, 0.9)
	for piece in body.cut(Vector2(0, -90), Vector2(0, 90)):
		check_equal(piece.get_look_in_use(), SoftBody2D.LOOK_SOFT, "look of a piece")
		check_equal(piece.get_color_in_use(), body.get_color_in_use(), "color of a piece")


func test_a_look_out_of_range_is_refused() -> void:
	var body := add_body()
	check_refused(func() -> void: body.look = 3, ["look", "3", "2"], "a look of 3")
	check_equal(body.look, SoftBody2D.LOOK_AUTOMATIC, "look")


func test_a_new_node_wobbles_visibly_as_it_lands() -> void:
	add_floor(400)
	var body := add_body(Vector2(0, 150)) # 200 px above the floor
	var heights := PackedFloat32Array()
	for i in 180:
		await ticks(1)
		heights.append(bounds_of(body.get_interpolated_polygon(1)).size.y)
	var least := 100.0
	for height in heights:
		least = minf(least, height)
	check_below(least, 85.0, "least height as it lands [px], of 100")
	# After the landing its height goes up and down around that of rest.
	var turns := 0
	for i in range(1, heights.size() - 1):
		var is_turn := (heights[i] - heights[i - 1]) * (heights[i + 1] - heights[i]) < 0
		turns += int(is_turn and absf(heights[i] - heights[-1]) > 1)
	check_above(turns, 2, "turns of the height by more than a pixel")
