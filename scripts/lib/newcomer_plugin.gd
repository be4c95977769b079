# SPDX-License-Identifier: MIT
@tool
extends EditorPlugin
## In an editor of a newcomer's project: switches the addon on, as the project settings do, and off and on again; ends with
## "N passed, N failed".

const ADDON := "soft_body_2d"
const FOLDER := "res://addons/soft_body_2d/"
const SCENE := "res://body.tscn"
const PATIENCE := 600 # frames

var _passed := 0
var _failed := 0


func _enter_tree() -> void:
	_run.call_deferred()


func _check(holds: bool, claim: String) -> void:
	if holds:
		_passed += 1
	else:
		_failed += 1
		print("FAILED: ", claim)


func _wait(frames: int) -> void:
	for i in frames:
		await get_tree().process_frame


func _wait_until(condition: Callable) -> bool:
	for i in PATIENCE:
		if condition.call():
			return true
		await get_tree().process_frame
	return false


func _is_addons(node: Node) -> bool:
	var script := node.get_script() as Script
	return script != null and script.resource_path.begins_with(FOLDER)


## The addon's controls in the editor's window.
func _controls() -> Array[Node]:
	return EditorInterface.get_base_control().find_children("*", "Control", true, false).filter(_is_addons)


func _has_visible_controls() -> bool:
	return _controls().any(func(control: Control) -> bool: return control.is_visible_in_tree())


func _run() -> void:
	var files := EditorInterface.get_resource_filesystem()
	_check(await _wait_until(func() -> bool: return not files.is_scanning()), "the editor reads the project")
	await _wait(10)
	_check(ClassDB.can_instantiate("SoftBody2D"), "the editor knows SoftBody2D")
	_check(not EditorInterface.is_plugin_enabled(ADDON), "the addon is off in a new project")
	_check(_controls().is_empty(), "an addon that is off shows nothing")
	EditorInterface.set_plugin_enabled(ADDON, true)
	_check(EditorInterface.is_plugin_enabled(ADDON), "the addon is switched on")
	_check(FOLDER + "plugin.cfg" in ProjectSettings.get_setting("editor_plugins/enabled", PackedStringArray()), "the project keeps that")
	EditorInterface.open_scene_from_path(SCENE)
	_check(await _wait_until(func() -> bool: return EditorInterface.get_edited_scene_root() != null), "the editor opens a scene")
	EditorInterface.set_main_screen_editor("2D")
	var root := EditorInterface.get_edited_scene_root()
	_check(root != null and root.get_child_count() == 1 and root.get_child(0).is_class("SoftBody2D"), "the scene has a SoftBody2D")
	if root != null:
		EditorInterface.edit_node(root.get_child(0))
	_check(await _wait_until(_has_visible_controls), "a selected body brings the addon's tools")
	EditorInterface.edit_node(null)
	await _wait(10)
	EditorInterface.set_plugin_enabled(ADDON, false)
	await _wait(10)
	_check(not EditorInterface.is_plugin_enabled(ADDON), "the addon is switched off")
	_check(_controls().is_empty(), "an addon that was switched off leaves nothing behind")
	EditorInterface.set_plugin_enabled(ADDON, true)
	if root != null:
		EditorInterface.edit_node(root.get_child(0))
	_check(await _wait_until(_has_visible_controls), "switched on again, the addon's tools are back")
	print("%d passed, %d failed" % [_passed, _failed])
	get_tree().quit(_failed)
