# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Base of the suites that look at pixels. They need a window; headless their tests are skipped.

const PICTURES := "res://tests/pictures"
const CLEAR := Color(0, 0, 0, 0)

var viewport: SubViewport


## A viewport with a world of its own. False in a headless run, where nothing is drawn.
func open_viewport(size := Vector2i(400, 400)) -> bool:
	if DisplayServer.get_name() == "headless":
		skip("a headless run draws nothing")
		return false
	viewport = make_viewport(size)
	viewport.world_2d = World2D.new()
	return true


func make_viewport(size: Vector2i) -> SubViewport:
	var made := SubViewport.new()
	made.size = size
	made.transparent_bg = true
	made.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	stage.add_child(made)
	return made


func middle() -> Vector2:
	return Vector2(viewport.size) / 2


## A weightless body in the middle of the viewport.
func add_to_view(properties := {}, parent: Node = viewport) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.gravity_scale = 0
	body.look = SoftBody2D.LOOK_PLAIN
	body.position = middle()
	for name: String in properties:
		body.set(name, properties[name])
	parent.add_child(body)
	return body


## What the viewport shows once the next frame has been drawn.
func picture(of := viewport) -> Image:
	await RenderingServer.frame_post_draw
	return of.get_texture().get_image()


func color_difference(a: Color, b: Color) -> float:
	return maxf(maxf(absf(a.r - b.r), absf(a.g - b.g)), maxf(absf(a.b - b.b), absf(a.a - b.a)))


func check_pixel(image: Image, place: Vector2, expected: Color, what: String, tolerance := 0.05) -> bool:
	var color := image.get_pixelv(Vector2i(place))
	return check_below(color_difference(color, expected), tolerance,
			"%s at %s is %s, not %s: difference" % [what, place, color, expected])


## Claims that two pictures look the same: hardly a pixel differs visibly. Pixels on edges may.
func check_same_picture(actual: Image, expected: Image, what: String, share := 0.002) -> bool:
	if not check_equal(actual.get_size(), expected.get_size(), "size of " + what):
		return false
	var different := 0
	var drawn := 0
	for y in actual.get_height():
		for x in actual.get_width():
			var a := actual.get_pixel(x, y)
			var b := expected.get_pixel(x, y)
			# Where nothing is to be seen, the color behind it does not matter.
			if (a.a > 0.02 or b.a > 0.02) and color_difference(a, b) > 0.08:
				different += 1
			drawn += int(b.a > 0.02)
	check_above(drawn, 100, "pixels drawn in the expected picture of " + what)
	return check_below(float(different) / drawn, share, "share of pixels in which %s differs" % what)


## Compares with a picture of our own in tests/pictures, which has been checked by eye. One that differs is left in
## user://pictures, to be checked by eye too.
func check_like_stored(actual: Image, name: String) -> void:
	var stored := Image.new()
	var bytes := FileAccess.get_file_as_bytes(PICTURES.path_join(name + ".png"))
	var same := check(not bytes.is_empty() and stored.load_png_from_buffer(bytes) == OK, "no stored picture " + name)
	if not same or not check_same_picture(actual, stored, "the picture " + name, 0.01):
		DirAccess.make_dir_recursive_absolute("user://pictures")
		var path := "user://pictures/%s.png" % name
		actual.save_png(path)
		print("see ", ProjectSettings.globalize_path(path))


## Mean place of what is drawn, weighted by alpha [px].
func centroid(image: Image) -> Vector2:
	image.convert(Image.FORMAT_RGBA8)
	var bytes := image.get_data()
	var width := image.get_width()
	var sum_x := 0.0
	var sum_y := 0.0
	var weight := 0.0
	for y in image.get_height():
		var row := 0.0
		for x in width:
			var alpha := bytes[4 * (y * width + x) + 3]
			if alpha > 0:
				row += alpha
				sum_x += alpha * (x + 0.5)
		sum_y += row * (y + 0.5)
		weight += row
	return Vector2(sum_x, sum_y) / maxf(weight, 1)
