# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## A cut changes nothing that is seen but the cut itself, in the frame of the cut and in those after it.


func _checked_texture() -> Texture2D:
	var image := Image.create(100, 100, false, Image.FORMAT_RGBA8)
	for y in 100:
		for x in 100:
			image.set_pixel(x, y, Color.RED if (floori(x / 10.0) + floori(y / 10.0)) % 2 == 0 else Color.YELLOW)
	return ImageTexture.create_from_image(image)


# In three of four frames the body is drawn between two ticks. Without an outline the cut itself is a line of one pixel. From the
# next tick on pieces of a spinning body turn faster, as their masses lie elsewhere.
func _check_cut(interpolated: bool, smooth: bool, spin: float) -> void:
	if not open_viewport(Vector2i(400, 300)):
		return
	tree.physics_interpolation = interpolated
	Engine.physics_ticks_per_second = 15
	var other := make_viewport(viewport.size)
	other.world_2d = World2D.new()
	var look := {"position": Vector2(110, 150), "texture": _checked_texture(), "smooth": smooth, "linear_velocity": Vector2(150, 20), "angular_velocity": spin}
	var body := add_to_view(look)
	var whole := add_to_view(look, other)
	await ticks(4)
	var cut_in := -1
	var compared := 0
	for i in 10:
		await tree.process_frame
		if spin != 0 and cut_in >= 0 and Engine.get_physics_frames() != cut_in:
			break
		if i == 1: # between two ticks
			var middle := body.get_center_of_mass_position()
			cut_in = Engine.get_physics_frames()
			check_equal(body.cut(middle + Vector2(-200, -30), middle + Vector2(200, 40)).size(), 2, "number of pieces")
		await RenderingServer.frame_post_draw
		check_same_picture(viewport.get_texture().get_image(), other.get_texture().get_image(), "frame %d with a cut body and a whole one" % i, 0.03)
		compared += 1
	check_above(compared, 2, "number of frames")
	check(whole.get_point_count() == 17, "the other body is whole")


func test_nothing_jumps_when_a_body_is_cut() -> void:
	await _check_cut(false, false, 3.0)


func test_nothing_jumps_when_a_smooth_body_is_cut() -> void:
	await _check_cut(false, true, 3.0)


func test_nothing_jumps_where_the_engine_interpolates() -> void:
	await _check_cut(true, false, 3.0)


func test_nothing_jumps_at_the_ticks_after_a_cut() -> void:
	await _check_cut(false, false, 0.0)


func test_nothing_jumps_at_the_ticks_where_the_engine_interpolates() -> void:
	await _check_cut(true, false, 0.0)
