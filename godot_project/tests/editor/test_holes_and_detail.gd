# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## Holes are shaped with the mouse, and detail is painted; each gesture is one step of undo.

const HOLE: Array[Vector2] = [Vector2(-20, -12), Vector2(14, -14), Vector2(18, 16), Vector2(-16, 14)]
const HOLES := 4
const DETAIL := 5


func _open(holes: Array[PackedVector2Array], properties := {}) -> void:
	var all := {"polygon": SoftBody2D.make_circle_polygon(60, 24), "holes": holes}
	all.merge(properties, true)
	await open_scene(all)
	plugin.set_mode(HOLES)


func _place(hole: int, index: int) -> Vector2:
	return on_screen(body.holes[hole][index])


func test_a_point_of_a_hole_is_dragged_inserted_and_erased() -> void:
	await _open([PackedVector2Array(HOLE)] as Array[PackedVector2Array], {"rotation": 0.3})
	await shot("holes")
	var before := values()
	var version := history().get_version()
	var from := _place(0, 2)
	await drag(from, from + Vector2(14, 10))
	check_near(_place(0, 2), from + Vector2(14, 10), 0.01, "place of the dragged point")
	check_equal(body.holes[0].slice(0, 2), PackedVector2Array(HOLE.slice(0, 2)), "other points of the hole")
	check_equal(body.polygon, before[&"polygon"], "the polygon")
	await check_one_step(before, version, "a drag")
	before = values()
	version = history().get_version()
	var middle := (_place(0, 3) + _place(0, 0)) / 2 # the edge that closes it
	await drag(middle, middle + Vector2(-12, 0))
	check_equal(body.holes[0].size(), 5, "points after an insertion")
	check_near(_place(0, 4), middle + Vector2(-12, 0), 0.01, "place of the new point")
	await check_one_step(before, version, "inserting and dragging")
	before = values()
	version = history().get_version()
	await click(_place(0, 4), MOUSE_BUTTON_RIGHT)
	check_equal(body.holes[0].size(), 4, "points after an erasure")
	await check_one_step(before, version, "an erasure")


func test_a_hole_is_added_taken_as_a_whole_and_removed() -> void:
	await _open([] as Array[PackedVector2Array])
	var before := values()
	var version := history().get_version()
	await press_button(plugin.toolbar.create_button)
	for place in HOLE:
		await click(on_screen(place))
	await click(on_screen(HOLE[0]))
	check_equal(body.holes.size(), 1, "holes after one was drawn")
	for i in HOLE.size():
		check_near(body.holes[0][i], HOLE[i], 0.01, "point %d" % i)
	check(not plugin.holes_mode.is_creating(), "the pen is off again")
	await check_one_step(before, version, "drawing a hole")
	before = values()
	version = history().get_version()
	await press_button(plugin.toolbar.create_button)
	for place: Vector2 in [Vector2(-5, 30), Vector2(6, 30), Vector2(0, 40)]:
		await click(on_screen(place))
	await key(KEY_ENTER)
	check_equal(body.holes.size(), 2, "holes after another one")
	await check_one_step(before, version, "drawing another hole")
	# A double-click takes a hole as a whole.
	before = values()
	version = history().get_version()
	press(_place(1, 0), MOUSE_BUTTON_LEFT, false, true)
	release()
	await frames(1)
	check_equal(plugin.holes_mode.selection.of(body), PackedInt32Array([4, 5, 6]), "points that are selected")
	var from := _place(1, 0)
	await drag(from, from + Vector2(9, 4))
	var way := body.holes[1][0] - (before[&"holes"][1] as PackedVector2Array)[0]
	check(way.length() > 1, "the hole has moved")
	for i in 3:
		check_near(body.holes[1][i] - (before[&"holes"][1] as PackedVector2Array)[i], way, 0.001, "way of point %d" % i)
	check_equal(body.holes[0], before[&"holes"][0], "the other hole")
	await check_one_step(before, version, "moving a hole")
	await shot("holes_two")
	before = values()
	version = history().get_version()
	await key(KEY_DELETE)
	check_equal(body.holes.size(), 1, "holes after one was erased")
	await check_one_step(before, version, "erasing a hole")
	# Of three points, one less is none.
	for i in 2:
		await click(_place(0, 0), MOUSE_BUTTON_RIGHT)
	check_equal(body.holes.size(), 0, "holes after points of the last one were erased")


func test_a_hole_that_no_body_can_have_is_refused_in_the_setters_words() -> void:
	await _open([PackedVector2Array(HOLE)] as Array[PackedVector2Array])
	var before := values()
	var version := history().get_version()
	press(_place(0, 2))
	move(on_screen(Vector2(30, 20)))
	move(on_screen(Vector2(90, 20)))
	var dragged: Array[PackedVector2Array] = plugin.holes_mode._dragged[body]
	var words := SoftBody2D.get_holes_problem(dragged, body.polygon)
	check(words != "", "such a hole is refused")
	check_equal(plugin.holes_mode.problem, words, "what is shown")
	await shot("holes_refused")
	release()
	check(bytes(body) == _bytes_of(before), "the holes are as they were")
	check_equal(history().get_version(), version, "steps of undo")
	check(words in plugin.canvas.last_message, "the message says why: " + plugin.canvas.last_message)
	# One that is drawn across another.
	plugin.holes_mode.set_creating(true)
	for place: Vector2 in [Vector2(0, 0), Vector2(40, 0), Vector2(40, 30)]:
		await click(on_screen(place))
	await key(KEY_ENTER)
	check(bytes(body) == _bytes_of(before), "the holes are as they were after a drawing")
	check("another hole" in plugin.canvas.last_message or "holes[0]" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
	await key(KEY_ESCAPE)


func test_holes_go_with_the_polygon_when_it_is_scaled_and_mirrored() -> void:
	await _open([PackedVector2Array(HOLE)] as Array[PackedVector2Array])
	plugin.set_mode(1)
	var before := values()
	var version := history().get_version()
	var handle: Vector2 = plugin.polygon_mode.handles._radius_place(body)
	await drag(handle, handle + Vector2(-30, 0) * plugin.canvas.scene_to_screen(body).get_scale().x)
	check_near(body.polygon[0].length(), 30.0, 0.1, "radius")
	for i in HOLE.size():
		check_near(body.holes[0][i], HOLE[i] / 2, 0.1, "point %d of the hole" % i)
	await check_one_step(before, version, "a change of the radius")
	before = values()
	version = history().get_version()
	plugin.shapes.run(&"mirror_horizontally", {})
	for i in HOLE.size():
		check_near(body.holes[0][i], before[&"holes"][0][i] * Vector2(-1, 1), 0.1, "point %d of the mirrored hole" % i)
	await check_one_step(before, version, "mirroring")


func _open_fine() -> void:
	await open_scene({"polygon": SoftBody2D.make_circle_polygon(60, 120), "detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC})
	plugin.set_mode(DETAIL)
	plugin.detail_mode.brush.radius = 40.0


func test_painted_detail_is_finer_where_the_brush_was_and_nowhere_else() -> void:
	await _open_fine()
	var before := values()
	var version := history().get_version()
	var count := body.get_simulated_polygon().size()
	await drag(on_screen(Vector2(58, -10)), on_screen(Vector2(58, 10)), false, 12)
	check_equal(body.detail_weights.size(), 120, "weights")
	for i in 120:
		var far := minf(body.polygon[i].distance_to(Vector2(58, -10)), body.polygon[i].distance_to(Vector2(58, 10)))
		if far > 40 and absf(body.polygon[i].y) > 50.5:
			check_equal(body.detail_weights[i], 1.0, "weight of point %d, where the brush was not" % i)
	check_near(body.detail_weights[0], 4.0, 0.05, "weight in the middle of the stroke")
	var right := Array(body.get_simulated_polygon()).filter(func(point: Vector2) -> bool: return point.x > 40).size()
	var left := Array(body.get_simulated_polygon()).filter(func(point: Vector2) -> bool: return point.x < -40).size()
	check(body.get_simulated_polygon().size() > count and right >= 2 * left, "simulated points: %d of %d right, %d left" % [right, count, left])
	check("%d of 120" % body.get_simulated_polygon().size() in plugin.detail_panel.figures.text, "the panel: " + plugin.detail_panel.figures.text)
	await shot("detail")
	await check_one_step(before, version, "a stroke")
	# The right button paints back, and what is 1 everywhere is nothing.
	plugin.detail_mode.brush.radius = 400.0
	version = history().get_version()
	press(on_screen(Vector2.ZERO), MOUSE_BUTTON_RIGHT)
	for i in 40:
		move(on_screen(Vector2(i % 2, 0)))
	release(MOUSE_BUTTON_RIGHT)
	await frames(1)
	check_equal([body.detail_weights.size(), history().get_version()], [0, version + 1], "weights and steps of undo after painting back")
	plugin.detail_mode.brush.radius = 40.0


func test_a_stroke_is_taken_back_by_escape_and_clear_is_one_step() -> void:
	await _open_fine()
	var before := values()
	var version := history().get_version()
	press(on_screen(Vector2(58, 0)))
	move(on_screen(Vector2(56, 4)))
	check(not body.detail_weights.is_empty(), "it is painted while the button is held")
	await key(KEY_ESCAPE)
	release()
	check(bytes(body) == _bytes_of(before), "the body is as it was")
	check_equal(history().get_version(), version, "steps of undo")
	await drag(on_screen(Vector2(58, -4)), on_screen(Vector2(58, 4)))
	before = values()
	version = history().get_version()
	await press_button(plugin.detail_panel.clear_button)
	check_equal(body.detail_weights.size(), 0, "weights after Clear All")
	await check_one_step(before, version, "clearing")


func test_pins_stay_where_they_are_when_detail_changes_the_points() -> void:
	await open_scene({"polygon": SoftBody2D.make_circle_polygon(60, 120)})
	plugin.set_mode(DETAIL)
	body.set_point_pinned(90, true) # the topmost
	var place := body.polygon[90]
	var before := values()
	var version := history().get_version()
	check(plugin.detail_panel.automatic_button.visible, "the panel offers Automatic")
	await press_button(plugin.detail_panel.automatic_button)
	check_equal(body.detail_mode, SoftBody2D.DETAIL_MODE_AUTOMATIC, "detail mode")
	check(body.pinned_points.size() == 1 and body.get_simulated_polygon()[body.pinned_points[0]].distance_to(place) < 12,
			"the pin is at the nearest point that is simulated: %s" % body.pinned_points)
	await check_one_step(before, version, "setting Automatic")
	check(not plugin.detail_panel.automatic_button.visible, "the panel no longer offers Automatic")
	await drag(on_screen(Vector2(10, -58)), on_screen(Vector2(-10, -58)), false, 8)
	check(body.pinned_points.size() == 1 and body.get_simulated_polygon()[body.pinned_points[0]].distance_to(place) < 12,
			"the pin is still there after a stroke: %s" % body.pinned_points)


func test_weights_stay_with_their_points() -> void:
	await _open_fine()
	var weights := PackedFloat32Array()
	for i in 120:
		weights.append(1.0 + i % 3)
	body.detail_weights = weights
	plugin.set_mode(1)
	var version := history().get_version()
	var before := values()
	await click(polygon_on_screen(10), MOUSE_BUTTON_RIGHT)
	var expected := weights.duplicate()
	expected.remove_at(10)
	check_equal(body.detail_weights, expected, "weights after a point was erased")
	await check_one_step(before, version, "an erasure")
