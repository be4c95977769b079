# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Outlines traced from pictures, good ones and bad ones.

const LOGIC := "res://addons/soft_body_2d/editor/logic/"
const PolygonEdit := preload(LOGIC + "polygon_edit.gd")
const SpriteOutline := preload(LOGIC + "sprite_outline.gd")
const TextureTrace := preload(LOGIC + "texture_trace.gd")


func _picture(size: Vector2i, is_opaque: Callable) -> Image:
	var image := Image.create(size.x, size.y, false, Image.FORMAT_RGBA8)
	for y in size.y:
		for x in size.x:
			if is_opaque.call(Vector2(x + 0.5, y + 0.5)):
				image.set_pixel(x, y, Color.WHITE)
	return image


func _disk(size: int, radius: float) -> Image:
	return _picture(Vector2i(size, size), func(p: Vector2) -> bool: return p.distance_to(Vector2(size, size) / 2) < radius)


func _traced(picture: Image, budget: int, margin := 0.0) -> TextureTrace:
	var trace := TextureTrace.new()
	trace.trace(picture, budget, 0.5, margin)
	return trace


func test_a_disk_is_traced_within_its_budget() -> void:
	for budget: int in [8, 16, 48]:
		var trace := _traced(_disk(100, 40), budget)
		check_equal(trace.problem, "", "problem")
		check(trace.outline.size() <= budget and trace.outline.size() >= 3, "%d points of %d" % [trace.outline.size(),
				budget])
		check_equal(SoftBody2D.get_polygon_problem(trace.outline), "", "what keeps it from being a polygon")
		# An inscribed regular polygon of n corners; pixels' corners stand out by up to one.
		var polygon := budget / 2.0 * sin(TAU / budget) * 1600
		check_near(absf(PolygonEdit.signed_area(trace.outline)), polygon, 0.09 * polygon, "area with %d points" % budget)
		check_near(PolygonEdit.bounds(trace.outline).get_center(), Vector2(50, 50), 3, "middle")
		check_equal(trace.islands, 1, "islands")
		for i in trace.outline.size():
			check_above(trace.outline[i].distance_to(trace.outline[i - 1]), 0.2 * TAU * 40 / budget,
					"distance of two points of %d" % budget)


func test_an_outline_can_be_grown() -> void:
	var plain := PolygonEdit.bounds(_traced(_disk(100, 30), 64).outline)
	var grown := PolygonEdit.bounds(_traced(_disk(100, 30), 64, 5.0).outline)
	check_near(grown.size, plain.size + Vector2(10, 10), 1, "size with a margin of 5")


func test_a_picture_without_an_opaque_pixel_is_told_of() -> void:
	var trace := _traced(Image.create(64, 64, false, Image.FORMAT_RGBA8), 32)
	check("no opaque pixel" in trace.problem, "the message: " + trace.problem)
	check_equal(trace.outline, PackedVector2Array(), "outline")
	check("no pixels" in _traced(null, 32).problem, "no picture at all")
	check("3 points" in _traced(_disk(50, 20), 2).problem, "a budget of 2")


func test_of_several_islands_the_largest_is_taken_and_the_others_are_told_of() -> void:
	var picture := _picture(Vector2i(160, 80), func(p: Vector2) -> bool:
		return p.distance_to(Vector2(40, 40)) < 30 or p.distance_to(Vector2(120, 40)) < 15)
	var trace := _traced(picture, 32)
	check_equal(trace.islands, 2, "islands")
	check("2 islands" in trace.note and "80 %" in trace.note, "the note: " + trace.note)
	check_near(PolygonEdit.bounds(trace.outline).get_center(), Vector2(40, 40), 2, "middle of the outline")


func test_holes_are_traced_and_what_reaches_the_edge_is_none() -> void:
	var picture := _picture(Vector2i(120, 120), func(p: Vector2) -> bool:
		var is_hole := p.distance_to(Vector2(45, 60)) < 15 or p.distance_to(Vector2(85, 60)) < 8 or p.distance_to(Vector2(60, 30)) < 1
		return p.distance_to(Vector2(60, 60)) < 50 and not is_hole)
	var trace := _traced(picture, 32)
	check_equal(trace.problem, "", "problem")
	check_equal(trace.holes.size(), 2, "holes but for the speck")
	check_equal(SoftBody2D.get_holes_problem(trace.holes, trace.outline), "", "what keeps them from being holes")
	var areas: Array[float] = []
	for hole in trace.holes:
		areas.append(absf(PolygonEdit.signed_area(hole)))
	areas.sort()
	check_near(areas[0], PI * 64, 30, "area of the small hole")
	check_near(areas[1], PI * 225, 60, "area of the large hole")
	var grown := _traced(picture, 32, 3.0)
	check_below(absf(PolygonEdit.signed_area(grown.holes[0])) + absf(PolygonEdit.signed_area(grown.holes[1])), areas[0] + areas[1] - 200, "a margin closes holes")
	var open := _picture(Vector2i(60, 60), func(p: Vector2) -> bool: return p.y > 10 and p.distance_to(Vector2(30, 10)) > 15)
	check_equal(_traced(open, 24).holes.size(), 0, "holes of a bay")


func test_thin_arms_and_a_single_pixel_give_a_polygon_or_a_message() -> void:
	var star := _picture(Vector2i(120, 120), func(p: Vector2) -> bool:
		var from_middle := p - Vector2(60, 60)
		return from_middle.length() < 12 + 44 * pow(absf(cos(2.5 * from_middle.angle())), 12))
	for budget: int in [3, 6, 12, 40]:
		var trace := _traced(star, budget)
		check((trace.problem == "") == (SoftBody2D.get_polygon_problem(trace.outline) == ""), "%d points: %s" % [budget,
				trace.problem])
	var dot := Image.create(8, 8, false, Image.FORMAT_RGBA8)
	dot.set_pixel(3, 3, Color.WHITE)
	var tiny := _traced(dot, 16)
	check(tiny.problem != "" or SoftBody2D.get_polygon_problem(tiny.outline) == "", "one pixel: %s" % tiny.problem)
	var chequered := _traced(_picture(Vector2i(32, 32), func(p: Vector2) -> bool: return (int(p.x) + int(p.y)) % 2 == 0),
			32)
	check(chequered.problem != "" or SoftBody2D.get_polygon_problem(chequered.outline) == "",
			"a chequered picture: %s" % chequered.problem)


func test_large_pictures_are_traced_as_exactly_as_it_takes_and_say_how_far_they_are() -> void:
	for size: int in [1024, 4096]:
		var picture := Image.create(size, size, false, Image.FORMAT_RGBA8)
		picture.fill_rect(Rect2i(size / 4, size / 8, size / 2, size / 4), Color.WHITE)
		picture.fill_rect(Rect2i(size / 4, size / 8, size / 8, size / 2), Color.WHITE)
		var begin := Time.get_ticks_usec()
		var trace := _traced(picture, 32)
		print("MEASURED tracing %d x %d: %.0f ms" % [size, size, (Time.get_ticks_usec() - begin) / 1000.0])
		check_equal(trace.problem, "", "problem")
		check_equal(trace.progress, 1.0, "progress at the end")
		# A side of 4096 pixels is looked at in 1024.
		var box := PolygonEdit.bounds(trace.outline)
		check_near(box.position, Vector2(size / 4.0, size / 8.0), size / 512.0, "corner of the outline")
		check_near(box.size, Vector2(size / 2.0, size / 2.0), size / 256.0, "size of the outline")
		check_equal(picture.get_size(), Vector2i(size, size), "size of the picture afterwards")


func test_tracing_can_be_canceled_from_outside() -> void:
	var trace := TextureTrace.new()
	trace.canceled = true
	trace.trace(_disk(50, 20), 32)
	check_equal(trace.outline, PackedVector2Array(), "outline")
	check("canceled" in trace.problem, "the message: " + trace.problem)


func test_frames_regions_and_flips_of_a_sprite_lie_where_they_are_seen() -> void:
	var image := Image.create(40, 20, false, Image.FORMAT_RGBA8)
	image.fill_rect(Rect2i(20, 0, 8, 10), Color.WHITE) # in the second frame, upper left
	var sprite := Sprite2D.new()
	sprite.texture = ImageTexture.create_from_image(image)
	sprite.hframes = 2
	sprite.frame = 1
	sprite.offset = Vector2(3, 0)
	check_equal(SpriteOutline.part_of(sprite), Rect2(20, 0, 20, 20), "part of the texture")
	check_equal(SpriteOutline.picture_of(sprite).get_used_rect(), Rect2i(0, 0, 8, 10), "opaque part of the frame")
	check_equal(SpriteOutline.to_local(sprite, [Vector2(0, 0), Vector2(8, 10)]), PackedVector2Array([Vector2(-7, -10),
			Vector2(1, 0)]), "places in the sprite")
	sprite.flip_h = true
	check_equal(SpriteOutline.to_local(sprite, [Vector2(0, 0)]), PackedVector2Array([Vector2(13, -10)]),
			"place when it is flipped")
	check_equal(SpriteOutline.to_texture(sprite, [Vector2(8, 10)]), PackedVector2Array([Vector2(28, 10)]),
			"place in the texture")
	sprite.free()
