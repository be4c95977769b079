# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## The path of a rope is shaped with the mouse, each gesture one step of undo.

const PATH: Array[Vector2] = [Vector2(-80, -20), Vector2(-20, 20), Vector2(40, 0), Vector2(90, 30)]

var rope: SoftRope2D


func open_rope(properties := {}) -> void:
	var made := Node2D.new()
	made.name = "Root"
	rope = SoftRope2D.new()
	rope.name = "Jelly"
	rope.position = Vector2(300, 200)
	rope.path = PATH
	for property: String in properties:
		rope.set(property, properties[property])
	made.add_child(rope)
	rope.owner = made
	await close(SCENE)
	write_scene(made, SCENE)
	await open(SCENE)
	await select_body()
	rope = body as SoftRope2D


func _place(index: int) -> Vector2:
	return on_screen(rope.path[index], rope)


# One more step of undo since `version`, which takes the path back to `before` and redo to what it is now, to the bit.
func _check_path_step(before: PackedVector2Array, version: int, what: String) -> void:
	check_equal(history().get_version(), version + 1, "steps of undo made by " + what)
	var after := var_to_bytes(rope.path)
	await undo()
	check(var_to_bytes(rope.path) == var_to_bytes(before), "undo of %s does not give the path of before" % what)
	await redo()
	check(var_to_bytes(rope.path) == after, "redo of %s does not give the same path" % what)


func test_a_rope_has_the_path_in_the_toolbar_and_nothing_that_it_cannot_use() -> void:
	await open_rope()
	check_equal(plugin.canvas.bodies, [rope] as Array[SoftBody2D], "what is edited")
	var shown: Array = plugin.toolbar.mode_buttons.map(func(button: Button) -> bool: return button.visible)
	check_equal(shown, [false, false, false, false, false, true], "buttons that are seen")
	check(plugin.toolbar.mode_buttons[5].button_pressed, "the path is shaped at once")
	check(not plugin.toolbar.shape_menu.visible and not plugin.toolbar.structure_menu.visible and not plugin.toolbar.preview_button.visible,
			"no menus of bodies")
	await shot("rope_path")
	await open_scene()
	shown = plugin.toolbar.mode_buttons.map(func(button: Button) -> bool: return button.visible)
	check_equal(shown, [true, true, true, true, true, false], "buttons that are seen for a body")
	check(plugin.toolbar.shape_menu.visible and plugin.toolbar.preview_button.visible, "menus of a body")


func test_a_point_is_dragged_where_the_mouse_goes_and_the_rope_follows() -> void:
	await open_rope({"rotation": 0.4, "scale": Vector2(1.2, 0.8), "pin_end": true})
	var before := rope.path
	var version := history().get_version()
	var from := _place(1)
	await drag(from, from + Vector2(24, 30))
	check_near(_place(1), from + Vector2(24, 30), 0.01, "place of the dragged point")
	for i: int in [0, 2, 3]:
		check_equal(rope.path[i], before[i], "point %d" % i)
	check_equal(rope.inner_points[rope.inner_points.size() - 1], rope.path[3], "the end of the rope itself")
	check(rope.is_point_pinned(rope.get_center_point(rope.get_center_count() - 1)), "the end is still pinned")
	await _check_path_step(before, version, "a drag")
	await shot("rope_path_dragged")


func test_a_click_on_the_path_inserts_a_point_and_a_right_click_erases_it() -> void:
	await open_rope()
	var before := rope.path
	var version := history().get_version()
	var middle := (_place(1) + _place(2)) / 2
	await click(middle)
	check_equal(rope.path.size(), 5, "points after a click on the path")
	check_near(_place(2), middle, 0.01, "place of the new point")
	await _check_path_step(before, version, "an insertion")
	var inserted := rope.path
	version = history().get_version()
	await click(_place(2), MOUSE_BUTTON_RIGHT)
	check_equal(rope.path, before, "path after the new point was erased")
	await _check_path_step(inserted, version, "an erasure")
	# Inserting and dragging on is one step, and an open line has no edge from its end to its start.
	before = rope.path
	version = history().get_version()
	middle = (_place(2) + _place(3)) / 2
	await drag(middle, middle + Vector2(-8, -28))
	check_near(_place(3), middle + Vector2(-8, -28), 0.01, "place of the point that was inserted and dragged on")
	await _check_path_step(before, version, "inserting and dragging")
	version = history().get_version()
	await click((_place(0) + _place(4)) / 2 + Vector2(0, 0))
	check_equal(history().get_version(), version, "steps of undo after a click between the ends")


func test_a_selection_moves_as_one_and_delete_erases_it() -> void:
	await open_rope()
	await drag(on_screen(Vector2(-30, -30), rope), on_screen(Vector2(50, 30), rope), true)
	check_equal(plugin.path_mode.selection.of(rope), PackedInt32Array([1, 2]), "points in the box")
	var before := rope.path
	var version := history().get_version()
	var from := _place(1)
	await drag(from, from + Vector2(10, 16))
	check_near(rope.path[1] - before[1], rope.path[2] - before[2], 0.001, "ways of the two points")
	check((rope.path[1] - before[1]).length() > 1, "they have moved")
	await _check_path_step(before, version, "moving a selection")
	before = rope.path
	version = history().get_version()
	await key(KEY_DELETE)
	check_equal(rope.path, PackedVector2Array([PATH[0], PATH[3]]), "path without the selection")
	await _check_path_step(before, version, "erasing a selection")
	# The two that are left stay: a rope has an end and a start.
	before = rope.path
	version = history().get_version()
	await click(_place(0), MOUSE_BUTTON_RIGHT)
	check_equal([rope.path, history().get_version()], [before, version], "path and steps of undo after the last but one point")
	check("erased" in plugin.canvas.last_message and "2" in plugin.canvas.last_message, "the message says why: " + plugin.canvas.last_message)


func test_a_path_that_no_rope_can_have_is_refused_on_release_and_nothing_is_lost() -> void:
	await open_rope()
	var before := rope.path
	var version := history().get_version()
	press(_place(3))
	move(on_screen(Vector2(0, -40), rope))
	move(on_screen(Vector2(-60, 40), rope))
	check(plugin.path_mode.problem != "", "a path that crosses itself is a problem while it is dragged")
	await shot("rope_path_refused")
	release()
	check_equal(history().get_version(), version, "steps of undo after a refusal")
	check(var_to_bytes(rope.path) == var_to_bytes(before), "the path is as it was")
	check("Refused" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
	# Taken back by Escape, with a point inserted.
	press((_place(1) + _place(2)) / 2)
	move(_place(1) + Vector2(20, 60))
	check_equal(rope.path.size(), 5, "points while one is inserted")
	await key(KEY_ESCAPE)
	release()
	check(var_to_bytes(rope.path) == var_to_bytes(before), "the path is as it was after Escape")
	check_equal(history().get_version(), version, "steps of undo after Escape")


func test_points_go_to_the_grid_when_the_editor_snaps() -> void:
	await open_rope({"position": Vector2(301, 203)})
	plugin.canvas._grid._find()
	var snap: Button = plugin.canvas._grid._button
	if not check(snap != null, "the editor's button for grid snapping is found"):
		return
	await press_button(snap)
	var from := _place(1)
	await drag(from, from + Vector2(33, 21))
	var place := rope.to_global(rope.path[1])
	check_near(place, place.snapped(Vector2(8, 8)), 0.001, "place of the point")
	await press_button(snap)


func test_a_path_is_drawn_anew_and_goes_on_from_either_end() -> void:
	await open_rope()
	var before := rope.path
	var version := history().get_version()
	await press_button(plugin.toolbar.create_button)
	check(plugin.path_mode.is_creating(), "the pen is on")
	var line: Array[Vector2] = [Vector2(-60, -60), Vector2(0, -50), Vector2(60, -70)]
	for place in line:
		await click(on_screen(place, rope))
	await shot("rope_path_drawn")
	await click(on_screen(line[2], rope))
	check_equal(rope.path.size(), 3, "points of the new path")
	for i in mini(3, rope.path.size()):
		check_near(rope.path[i], line[i], 0.01, "point %d" % i)
	check(not plugin.path_mode.is_creating() and not plugin.toolbar.create_button.button_pressed, "the pen is off again")
	await _check_path_step(before, version, "drawing")
	before = rope.path
	version = history().get_version()
	plugin.path_mode.set_creating(true)
	await click(_place(2))
	await click(on_screen(Vector2(80, -20), rope))
	await key(KEY_ENTER)
	check_equal(rope.path.slice(0, 3), before, "what was there, with the end drawn on")
	check_near(rope.path[3], Vector2(80, -20), 0.01, "the new end")
	await _check_path_step(before, version, "drawing on from the end")
	before = rope.path
	plugin.path_mode.set_creating(true)
	await click(_place(0))
	await click(on_screen(Vector2(-80, -20), rope))
	await click(on_screen(Vector2(-80, 20), rope))
	await key(KEY_ENTER)
	check_equal(rope.path.slice(2), before, "what was there, with the start drawn on")
	check_near(rope.path[0], Vector2(-80, 20), 0.01, "the new start")


func test_a_locked_rope_is_not_edited() -> void:
	await open_rope()
	rope.set_meta(&"_edit_lock_", true)
	var before := rope.path
	await drag(_place(1), _place(1) + Vector2(20, 20))
	check_equal(rope.path, before, "the path")
	check("locked" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
