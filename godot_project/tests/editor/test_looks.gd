# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## What is chosen in the inspector of a body that looks soft.


func _edit(name: StringName, value: Variant) -> void:
	for property: EditorProperty in EditorInterface.get_inspector().find_children("*", "EditorProperty", true, false):
		if property.get_edited_property() == name:
			property.emit_changed(name, value)
			await frames(3)
			return
	check(false, "the inspector shows %s" % name)


func test_a_color_that_is_picked_keeps_the_soft_look_with_one_step_of_undo() -> void:
	await open_scene()
	await frames(30)
	await shot("look_new")
	var version := history().get_version()
	await _edit(&"color", Color.TOMATO)
	check_equal([body.look, body.color, body.get_color_in_use()], [SoftBody2D.LOOK_SOFT, Color.TOMATO, Color.TOMATO], "look and color")
	check_equal(history().get_version(), version + 1, "steps of undo")
	await shot("look_color")
	await save_and_reload()
	check_equal([body.get_look_in_use(), body.get_color_in_use()], [SoftBody2D.LOOK_SOFT, Color.TOMATO], "look and color after saving")


func test_undo_of_a_color_gives_the_automatic_look_back() -> void:
	await open_scene()
	await frames(30)
	await _edit(&"color", Color.TOMATO)
	await undo()
	check_equal([body.look, body.color], [SoftBody2D.LOOK_AUTOMATIC, Color.WHITE], "look and color after undo")
	await redo()
	check_equal([body.look, body.color], [SoftBody2D.LOOK_SOFT, Color.TOMATO], "look and color after redo")


func test_an_outline_that_is_set_keeps_the_color_that_was_seen() -> void:
	await open_scene()
	await frames(30)
	var seen := body.get_color_in_use()
	await _edit(&"outline_width", 4.0)
	check_equal([body.look, body.color], [SoftBody2D.LOOK_SOFT, seen], "look and color")
	await undo()
	check_equal([body.look, body.color, body.outline_width], [SoftBody2D.LOOK_AUTOMATIC, Color.WHITE, 0.0], "values after undo")


func test_a_plain_body_stays_plain() -> void:
	await open_scene({"look": SoftBody2D.LOOK_PLAIN})
	await frames(30)
	await _edit(&"color", Color.TOMATO)
	check_equal(body.look, SoftBody2D.LOOK_PLAIN, "look")
