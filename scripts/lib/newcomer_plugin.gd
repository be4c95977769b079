# SPDX-License-Identifier: MIT
@tool
extends EditorPlugin
## A newcomer's first five minutes in a real editor, by made-up input: unzips the addon into the project that is open, switches it on,
## adds a body and a floor, plays, picks a material, drags a point, plays again. Ends with "N passed, N failed".
##
##     godot --editor --single-window --path PROJECT -- --package=ZIP --step-file=FILE
##
## Each step writes its name into that file, for whoever films the screen.

const ADDON := "soft_body_2d"
const FOLDER := "res://addons/soft_body_2d/"
const PATIENCE := 1200 # frames
const BODY_PLACE := Vector2(300, 120)
const TIME_LIMIT := 200 # s
const PLAY_TIME := 4.0 # s

var _passed := 0
var _failed := 0
var _mouse := Vector2.ZERO
var _debugger := EditorDebuggerPlugin.new() # knows whether a game has reported to the editor
var _is_over := false
var _unzipped_for := -1 # frames


func _enter_tree() -> void:
	add_debugger_plugin(_debugger)
	_run.call_deferred()


## The editor reads all scripts anew as it takes up the addon's library, which ends what waits in them: so the waiting for that is done
## here, frame by frame.
func _process(_delta: float) -> void:
	if Time.get_ticks_msec() > 1000 * TIME_LIMIT and not _is_over:
		_check(false, "all of it within %d s" % TIME_LIMIT)
		_end()
	if _unzipped_for < 0:
		return
	_unzipped_for += 1
	var is_known := ClassDB.class_exists(&"SoftBody2D") and not EditorInterface.get_resource_filesystem().is_scanning()
	if (is_known and _unzipped_for > 30) or _unzipped_for > PATIENCE:
		_unzipped_for = -1
		_check(is_known, "the editor that is open takes up the addon")
		_go_on()


func _exit_tree() -> void:
	remove_debugger_plugin(_debugger)


func _run() -> void:
	await _unzip()


func _go_on() -> void:
	await _step("unzipped")
	await _switch_on()
	await _make_scene()
	await _play("a first time")
	await _pick_material()
	await _drag_point()
	await _play("a second time")
	await _switch_off_and_on()
	_end()


func _end() -> void:
	_is_over = true
	print("%d passed, %d failed" % [_passed, _failed])
	get_tree().quit(mini(_failed, 1))


# The steps.

func _unzip() -> void:
	var files := EditorInterface.get_resource_filesystem()
	_check(await _until(func() -> bool: return not files.is_scanning()), "the editor reads the empty project")
	await _step("empty_project")
	_check(not ClassDB.class_exists(&"SoftBody2D"), "an empty project knows no SoftBody2D")
	var zip := ZIPReader.new()
	_check(zip.open(_argument("--package=")) == OK, "the package can be unzipped")
	for path in zip.get_files():
		if not path.ends_with("/"):
			DirAccess.make_dir_recursive_absolute("res://" + path.get_base_dir())
			FileAccess.open("res://" + path, FileAccess.WRITE).store_buffer(zip.read_file(path))
	zip.close()
	_unzipped_for = 0
	files.scan.call_deferred() # as the editor does when its window is come back to


func _switch_on() -> void:
	_check(not EditorInterface.is_plugin_enabled(ADDON), "the addon is off at first")
	_check(_addon_controls().is_empty(), "an addon that is off shows nothing")
	EditorInterface.set_plugin_enabled(ADDON, true) # what the box in the project settings does
	_check(EditorInterface.is_plugin_enabled(ADDON), "the addon is switched on")
	_check(FOLDER + "plugin.cfg" in ProjectSettings.get_setting("editor_plugins/enabled", PackedStringArray()), "the project keeps that")
	await _step("enabled")


func _make_scene() -> void:
	EditorInterface.set_main_screen_editor("2D")
	await _frames(20)
	await _click_button(_button("2D Scene"))
	_check(await _until(func() -> bool: return _root() is Node2D), "a new scene has a Node2D")
	await _add_node("SoftBody2D")
	var body: Variant = _body()
	if not _check(body != null, "the dialog for new nodes adds a SoftBody2D"):
		return
	await _step("body_added")
	_check(await _until(_has_visible_controls), "a new body brings the addon's tools")
	_check(body.get_warnings().is_empty(), "a new body is warned of: " + str(body.get_warnings()))
	body.position = BODY_PLACE
	await _choose(_root())
	await _add_node("StaticBody2D")
	await _add_node("CollisionShape2D")
	var found := _root().find_children("*", "CollisionShape2D")
	if _check(found.size() == 1, "and a floor"):
		var shape := found[0] as CollisionShape2D
		shape.shape = RectangleShape2D.new()
		(shape.shape as RectangleShape2D).size = Vector2(1000, 40)
		(shape.get_parent() as Node2D).position = Vector2(500, 560)
	await _choose(body)
	await _frames(20)
	await _step("floor_added")
	_key(KEY_S, true)
	await _frames(30)
	await _step("save_dialog")
	_type("main.tscn", true)
	_key(KEY_ENTER)
	_check(await _until(func() -> bool: return FileAccess.file_exists("res://main.tscn")), "Ctrl+S keeps the scene")


func _play(which: String) -> void:
	_key(KEY_F5)
	await _frames(30)
	var choose := _button("Select Current")
	if choose != null: # of a project that has no main scene yet
		await _step("main_scene")
		await _click_button(choose)
	_check(await _until(func() -> bool: return EditorInterface.is_playing_scene()), "F5 plays %s" % which)
	await _step("play")
	await get_tree().create_timer(PLAY_TIME).timeout
	_check(_debugger.get_sessions().any(func(session: EditorDebuggerSession) -> bool: return session.is_active()),
			"the game is under way, %s" % which)
	await _step("played")
	EditorInterface.stop_playing_scene()
	await _frames(30)


func _pick_material() -> void:
	var body: Variant = _body()
	await _choose(body)
	var found := EditorInterface.get_inspector().find_children("SoftBodyMaterials", "", true, false)
	if not _check(not found.is_empty(), "the inspector shows materials"):
		return
	var thumbnail := found[0].get_child(1) as Control
	_move(thumbnail.get_global_rect().get_center())
	await _frames(20)
	await _step("material_under_the_mouse")
	_mouse_button(true)
	_mouse_button(false)
	_check(await _until(func() -> bool: return body.soft_body_material != null), "a click on a thumbnail gives its material")
	await _step("material")


func _drag_point() -> void:
	var body: Variant = _body()
	await _choose(body)
	var before: PackedVector2Array = body.polygon
	var from := _on_screen(body, body.polygon[0])
	_move(from)
	_mouse_button(true)
	for i in 8:
		_move(from + Vector2(50, 0) * (i + 1) / 8.0)
		await _frames(2)
	await _step("point_dragged")
	_mouse_button(false)
	await _frames(10)
	_check(body.polygon.size() == before.size() and body.polygon[0].x > before[0].x + 20, "the mouse drags a point of the outline")
	_check(body.get_warnings().is_empty(), "the dragged body is warned of: " + str(body.get_warnings()))
	_key(KEY_S, true)
	await _frames(60)
	await _step("saved")


func _switch_off_and_on() -> void:
	EditorInterface.edit_node(null)
	await _frames(10)
	EditorInterface.set_plugin_enabled(ADDON, false)
	await _frames(10)
	_check(not EditorInterface.is_plugin_enabled(ADDON), "the addon is switched off")
	_check(_addon_controls().is_empty(), "an addon that was switched off leaves nothing behind")
	EditorInterface.set_plugin_enabled(ADDON, true)
	await _choose(_body())
	_check(await _until(_has_visible_controls), "switched on again, the addon's tools are back")


# What is there.

func _check(holds: bool, claim: String) -> bool:
	if holds:
		_passed += 1
	else:
		_failed += 1
		print("FAILED: ", claim)
	return holds


func _argument(prefix: String) -> String:
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with(prefix):
			return argument.trim_prefix(prefix)
	return ""


func _root() -> Node:
	return EditorInterface.get_edited_scene_root()


## Untyped, as the class is not there when this script is read.
func _body() -> Variant:
	var found := _root().find_children("*", "SoftBody2D") if _root() != null else []
	return found[0] if not found.is_empty() else null


func _is_addons(node: Node) -> bool:
	var script := node.get_script() as Script
	return script != null and script.resource_path.begins_with(FOLDER)


## The addon's controls in the editor's window.
func _addon_controls() -> Array[Node]:
	return EditorInterface.get_base_control().find_children("*", "Control", true, false).filter(_is_addons)


func _has_visible_controls() -> bool:
	return _addon_controls().any(func(control: Control) -> bool: return control.is_visible_in_tree())


func _button(text: String) -> Button:
	for button: Button in get_tree().root.find_children("*", "Button", true, false):
		if button.is_visible_in_tree() and (button.text == text or button.tooltip_text.begins_with(text)):
			return button
	return null


## Where a place of a node of the edited scene is in the window.
func _on_screen(node: Node2D, place: Vector2) -> Vector2:
	var viewport := EditorInterface.get_editor_viewport_2d()
	var container := viewport.get_parent() as Control
	return container.get_global_rect().position + viewport.global_canvas_transform * node.get_global_transform() * place


# Time and input.

func _frames(count: int) -> void:
	for i in count:
		await get_tree().process_frame


func _until(condition: Callable) -> bool:
	for i in PATIENCE:
		if condition.call():
			return true
		await get_tree().process_frame
	return false


func _step(name: String) -> void:
	await _frames(20)
	FileAccess.open(_argument("--step-file="), FileAccess.WRITE).store_string(name)
	print("step ", name)
	await get_tree().create_timer(0.6).timeout # so that it is on the film


func _choose(node: Node) -> void:
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(node)
	EditorInterface.edit_node(node)
	await _frames(20)


func _add_node(type: String) -> void:
	await _click_button(_button("Add/Create"))
	await _frames(20)
	_type(type)
	await _frames(20)
	_key(KEY_ENTER)
	await _frames(20)


func _click_button(button: Button) -> void:
	if not _check(button != null, "there is a button to click"):
		return
	var place := button.get_global_rect().get_center()
	if button.get_window() != get_tree().root:
		place += Vector2(button.get_window().position)
	_move(place)
	await _frames(3)
	_mouse_button(true)
	_mouse_button(false)
	await _frames(10)


func _move(place: Vector2) -> void:
	var event := InputEventMouseMotion.new()
	event.position = place
	event.global_position = place
	event.relative = place - _mouse
	event.button_mask = Input.get_mouse_button_mask()
	_mouse = place
	get_tree().root.push_input(event)


func _mouse_button(pressed: bool) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = MOUSE_BUTTON_LEFT
	event.pressed = pressed
	event.position = _mouse
	event.global_position = _mouse
	event.button_mask = MOUSE_BUTTON_MASK_LEFT if pressed else 0 as MouseButtonMask
	get_tree().root.push_input(event)


func _key(code: Key, control := false, unicode := 0) -> void:
	for pressed: bool in [true, false]:
		var event := InputEventKey.new()
		event.keycode = code
		event.physical_keycode = code
		event.unicode = unicode
		event.ctrl_pressed = control
		event.pressed = pressed
		get_tree().root.push_input(event)


## Into the field that has the focus, instead of what is in there if so wanted.
func _type(text: String, instead := false) -> void:
	if instead:
		_key(KEY_A, true)
	for letter in text:
		_key(OS.find_keycode_from_string(letter.to_upper()), false, letter.unicode_at(0))
