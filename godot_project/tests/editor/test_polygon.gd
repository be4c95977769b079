# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## Polygons are shaped with the mouse, each gesture one step of undo.


func test_a_point_is_dragged_where_the_mouse_goes() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(30, -14))
	check_near(polygon_on_screen(0), from + Vector2(30, -14), 0.01, "place of the dragged point")
	check_equal(body.polygon.slice(1), (before[&"polygon"] as PackedVector2Array).slice(1), "the other points")
	await check_one_step(before, version, "a drag")
	await shot("polygon_drag")


func test_zoom_and_the_transform_of_the_node_are_honored() -> void:
	await open_scene({"rotation": 0.7, "scale": Vector2(1.5, 0.6)})
	await center_on(body.global_position, 9)
	check(plugin.canvas.scene_to_screen(body).get_scale().x > 1.2, "the view is enlarged")
	var from := polygon_on_screen(5)
	await drag(from, from + Vector2(-25, 18))
	check_near(polygon_on_screen(5), from + Vector2(-25, 18), 0.01, "place of the dragged point")


func test_a_click_on_an_edge_inserts_a_point_and_a_right_click_erases_one() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	var middle := (polygon_on_screen(3) + polygon_on_screen(4)) / 2
	await click(middle)
	check_equal(body.polygon.size(), 17, "points after a click on an edge")
	check_near(polygon_on_screen(4), middle, 0.01, "place of the new point")
	await check_one_step(before, version, "an insertion")
	var inserted := values()
	version = history().get_version()
	await click(polygon_on_screen(4), MOUSE_BUTTON_RIGHT)
	check_equal(body.polygon, before[&"polygon"], "polygon after the new point was erased")
	await check_one_step(inserted, version, "an erasure")


func test_inserting_and_dragging_on_is_one_step() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	var middle := (polygon_on_screen(7) + polygon_on_screen(8)) / 2
	await drag(middle, middle + Vector2(-20, 4))
	check_equal(body.polygon.size(), 17, "points")
	check_near(polygon_on_screen(8), middle + Vector2(-20, 4), 0.01, "place of the new point")
	await check_one_step(before, version, "inserting and dragging")


func test_a_box_with_shift_selects_and_what_is_selected_moves_turns_and_scales() -> void:
	await open_scene()
	# The three rightmost points: 15, 0, 1.
	var box_from := on_screen(Vector2(40, -25))
	await drag(box_from, on_screen(Vector2(60, 25)), true)
	check_equal(plugin.polygon_mode.selection.of(body), PackedInt32Array([0, 1, 15]), "points in the box")
	await shot("polygon_box")
	var before := values()
	var version := history().get_version()
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(8, 0) * plugin.canvas.scene_to_screen(body).get_scale().x)
	for index: int in [0, 1, 15]:
		check_near(body.polygon[index], before[&"polygon"][index] + Vector2(8, 0), 0.001, "point %d of the selection" % index)
	check_equal(body.polygon[2], before[&"polygon"][2], "a point that is not selected")
	await check_one_step(before, version, "moving a selection")

	before = values()
	version = history().get_version()
	var frame: Rect2 = plugin.polygon_mode._selection_box()
	var corner := frame.end
	await drag(corner, corner + Vector2(0, 10))
	var grown: float = (body.polygon[1] - body.polygon[15]).y / ((before[&"polygon"][1] - before[&"polygon"][15]) as Vector2).y
	check_near(grown, (frame.size.y + 10) / frame.size.y, 0.001, "factor of the height of the selection")
	await check_one_step(before, version, "scaling a selection")

	before = values()
	version = history().get_version()
	frame = plugin.polygon_mode._selection_box()
	var handle := Vector2(frame.get_center().x, frame.position.y - 28 * EditorInterface.get_editor_scale())
	var arm := handle - frame.get_center()
	await drag(handle, frame.get_center() + arm.rotated(0.2))
	var side: Vector2 = before[&"polygon"][1] - before[&"polygon"][15]
	check_near((body.polygon[1] - body.polygon[15]).angle(), side.angle() + 0.2, 0.01, "angle of the selection")
	await check_one_step(before, version, "turning a selection")


func test_an_outline_that_crosses_itself_is_refused_on_release_and_nothing_is_lost() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	var from := polygon_on_screen(0)
	press(from)
	move(on_screen(Vector2(-20, 3)))
	move(on_screen(Vector2(-70, 3)))
	check(plugin.polygon_mode.problem != "", "crossing edges are a problem while they are dragged")
	await shot("polygon_refused_while_dragged")
	release()
	check_equal(history().get_version(), version, "steps of undo after a refusal")
	check(bytes(body) == _bytes_of(before), "the polygon is as it was")
	check("meets" in plugin.canvas.last_message, "the message says what is wrong: " + plugin.canvas.last_message)


func test_a_drag_is_taken_back_by_escape() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	press(polygon_on_screen(0))
	move(polygon_on_screen(0) + Vector2(20, 20))
	await key(KEY_ESCAPE)
	release()
	check(bytes(body) == _bytes_of(before), "the polygon is as it was")
	check_equal(history().get_version(), version, "steps of undo")


func test_points_go_to_the_grid_when_the_editor_snaps() -> void:
	await open_scene()
	var snap := _snap_button()
	if not check(snap != null, "the editor's button for grid snapping is found"):
		return
	var was_on := snap.button_pressed
	await press_button(snap)
	check(snap.button_pressed, "grid snapping is on (before: %s)" % was_on)
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(33, 21))
	var place := body.to_global(body.polygon[0])
	check_near(place, place.snapped(Vector2(8, 8)), 0.001, "place of the point")
	await press_button(snap)


func _snap_button() -> Button:
	plugin.canvas._grid._find()
	return plugin.canvas._grid._button


func test_a_new_polygon_is_drawn_point_by_point() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	plugin.polygon_mode.set_creating(true)
	var corners: Array[Vector2] = [Vector2(-40, -40), Vector2(40, -40), Vector2(40, 40), Vector2(0, 10), Vector2(-40, 40)]
	for corner in corners:
		await click(on_screen(corner))
	await shot("polygon_create")
	await click(on_screen(corners[0]))
	check_equal(body.polygon.size(), 5, "points of the new polygon")
	for i in mini(5, body.polygon.size()):
		check_near(body.polygon[i], corners[i], 0.01, "point %d" % i)
	await check_one_step(before, version, "drawing")


func test_the_radius_handle_scales_and_the_pressure_arrow_sets_pressure() -> void:
	await open_scene({"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	var before := values()
	var version := history().get_version()
	var handle: Vector2 = plugin.polygon_mode.handles._radius_place(body)
	await drag(handle, handle + Vector2(10, 0) * plugin.canvas.scene_to_screen(body).get_scale().x)
	check_near(body.polygon[0].length(), 60.0, 0.05, "radius after the handle went 10 px of the scene")
	await check_one_step(before, version, "a change of the radius")
	version = history().get_version()
	var tip: Vector2 = plugin.polygon_mode.handles._pressure_place(body)
	await drag(tip, tip + Vector2(0, -60 * EditorInterface.get_editor_scale()))
	check_near(body.pressure, 200.0, 5, "pressure for an arrow of twice the stiffness")
	check_equal(history().get_version(), version + 1, "steps of undo")
	await undo()
	check_equal(body.pressure, 0.0, "pressure after undo")
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_AUTOMATIC
	tip = plugin.polygon_mode.handles._pressure_place(body)
	await drag(tip, tip + Vector2(0, -60 * EditorInterface.get_editor_scale()))
	check_equal(body.pressure, 0.0, "pressure of a body of a material, which has no arrow")


func test_several_bodies_are_edited_together() -> void:
	var made := Node2D.new()
	made.name = "Root"
	for i in 2:
		var each := SoftBody2D.new()
		each.name = ["Jelly", "Other"][i]
		each.position = Vector2(240 + 120 * i, 200)
		each.rotation = 0.5 * i
		made.add_child(each)
		each.owner = made
	write_scene(made, SCENE)
	await open(SCENE)
	await select_body(["Jelly", "Other"])
	check_equal(plugin.canvas.bodies.size(), 2, "bodies that are edited")
	var other: SoftBody2D = root().get_node("Other")
	plugin.polygon_mode.selection.add(body, [0])
	plugin.polygon_mode.selection.add(other, [8])
	var from := polygon_on_screen(0)
	var other_from := polygon_on_screen(8, other)
	var version := history().get_version()
	await drag(from, from + Vector2(12, 8))
	check_near(polygon_on_screen(0), from + Vector2(12, 8), 0.01, "place of the point of the first")
	check_near(polygon_on_screen(8, other), other_from + Vector2(12, 8), 0.01, "place of the point of the second")
	check_equal(history().get_version(), version + 1, "steps of undo")
	version = history().get_version()
	plugin.shapes.run(&"circle", {"radius": 30.0, "count": 12})
	check_equal([body.polygon.size(), other.polygon.size()], [12, 12], "points after a start shape")
	check_equal(history().get_version(), version + 1, "steps of undo")
	body.stiffness = 5
	other.stiffness = 90
	await frames(3)
	var panel: Control = plugin.inspector.panel
	if not check(is_instance_valid(panel) and panel.is_inside_tree() and panel._bodies.size() == 2,
			"the inspector shows a panel of both"):
		return
	panel.refresh()
	version = history().get_version()
	for advice: RefCounted in panel.shown_advice.duplicate():
		if advice.changes.has(&"stiffness"):
			panel.apply(advice)
	check(body.stiffness > 20, "stiffness of the soft one after the advice: %s" % body.stiffness)
	check_equal(other.stiffness, 90.0, "stiffness of the one that was stiffer")
	check_equal(history().get_version(), version + 1, "steps of undo")
