# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The 2D editor's grid snapping. No engine version hands it to plugins: the button is found by its icon, the grid by the
## fields of the dialog that sets it, or by what the editor remembers of the scene; the editor's default otherwise.

const DEFAULT_STEP := Vector2(8, 8)

var _button: Button
var _dialog: ConfirmationDialog
var _scene := ""
var _step := DEFAULT_STEP
var _offset := Vector2.ZERO
var _dialog_spoke := false


func read(snapping: RefCounted) -> void:
	if not is_instance_valid(_button):
		_find()
	var root := EditorInterface.get_edited_scene_root()
	var scene := root.scene_file_path if root != null else ""
	if scene != _scene and not _dialog_spoke:
		_scene = scene
		_read_remembered(scene)
	snapping.enabled = is_instance_valid(_button) and _button.button_pressed
	snapping.step = _step
	snapping.offset = _offset


func _find() -> void:
	var main := EditorInterface.get_editor_main_screen()
	if main == null:
		return
	var icon: Texture2D = EditorInterface.get_editor_theme().get_icon(&"SnapGrid", &"EditorIcons")
	for canvas_editor in main.find_children("*", "CanvasItemEditor", false, false):
		for button: Button in canvas_editor.find_children("*", "Button", true, false):
			if button.toggle_mode and button.icon == icon:
				_button = button
		for dialog: ConfirmationDialog in canvas_editor.find_children("*", "SnapDialog", true, false):
			_dialog = dialog
	if is_instance_valid(_dialog) and not _dialog.confirmed.is_connected(_read_dialog):
		_dialog.confirmed.connect(_read_dialog)


# Its fields in order: offset x, y, step x, y.
func _read_dialog() -> void:
	var fields := _dialog.find_children("*", "SpinBox", true, false)
	if fields.size() >= 4:
		_offset = Vector2(fields[0].value, fields[1].value)
		_step = Vector2(fields[2].value, fields[3].value)
		_dialog_spoke = true


func _read_remembered(scene: String) -> void:
	_step = DEFAULT_STEP
	_offset = Vector2.ZERO
	if scene == "":
		return
	var file := ConfigFile.new()
	var path := EditorInterface.get_editor_paths().get_project_settings_dir().path_join(
			"%s-editstate-%s.cfg" % [scene.get_file(), scene.md5_text()])
	if file.load(path) != OK:
		return
	var state: Variant = file.get_value("editor_states", "2D", {})
	if state is Dictionary:
		_step = state.get("grid_step", DEFAULT_STEP)
		_offset = state.get("grid_offset", Vector2.ZERO)
