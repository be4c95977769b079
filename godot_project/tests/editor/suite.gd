# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Base of the suites that drive a real editor: scenes, the mouse, the keyboard, undo, claims.

const ADDON := "res://addons/soft_body_2d/plugin.cfg"
const BodyValues := preload("res://addons/soft_body_2d/editor/logic/body_values.gd")
const SCENE := "res://editor_test.tscn"

var failures := PackedStringArray()
var claims := 0
## Why this test did nothing, if so.
var skip_reason := ""
var tree: SceneTree
## The addon's plugin.
var plugin: EditorPlugin
var body: SoftBody2D

var _log: RefCounted
var _mouse := Vector2.ZERO
var _held := 0


func set_up(driver: EditorPlugin, error_log: RefCounted) -> void:
	tree = driver.get_tree()
	_log = error_log
	find_plugin()
	if _log != null:
		_log.call(&"take")


func tear_down() -> void:
	if _held != 0:
		release()
	for window: Window in tree.root.find_children("*", "Popup", true, false): # the editor's own menus
		window.hide()
	if plugin != null:
		EditorInterface.set_main_screen_editor("2D")
		plugin.set_preview(false)
		plugin.springs_mode.tool = 0
		plugin.set_mode(1)
	if _log != null:
		for error: String in _log.call(&"take"):
			failures.append("unexpected " + error)


func find_plugin() -> void:
	plugin = null
	for node in tree.root.find_children("*", "EditorPlugin", true, false):
		var script: Script = node.get_script()
		if script != null and script.resource_path.ends_with("soft_body_2d_plugin.gd") and not node.is_queued_for_deletion():
			plugin = node


# Claims.

func check(condition: bool, claim: String) -> bool:
	claims += 1
	if not condition:
		failures.append(claim)
	return condition


func check_equal(actual: Variant, expected: Variant, what: String) -> bool:
	return check(actual == expected, "%s is %s, not %s" % [what, actual, expected])


## For a test that cannot be done here; it then counts as neither passed nor failed. Return after it.
func skip(reason: String) -> void:
	skip_reason = reason


func check_near(actual: Variant, expected: Variant, tolerance: float, what: String) -> bool:
	var error: float = absf(actual - expected) if actual is float or actual is int else (actual - expected).length()
	return check(error <= tolerance, "%s is %s, not %s within %s" % [what, actual, expected, tolerance])


func take_errors() -> PackedStringArray:
	return _log.call(&"take") if _log != null else PackedStringArray()


# Scenes.

## A scene that has just been written and opened, with a body in it that is selected.
func open_scene(properties := {}, path := SCENE) -> void:
	var root := Node2D.new()
	root.name = "Root"
	var made := SoftBody2D.new()
	made.name = "Jelly"
	made.position = Vector2(300, 200)
	for property: String in properties:
		made.set(property, properties[property])
	root.add_child(made)
	made.owner = root
	await close(path)
	write_scene(root, path)
	await open(path)
	await select_body()


func write_scene(root: Node, path: String) -> void:
	var packed := PackedScene.new()
	packed.pack(root)
	ResourceSaver.save(packed, path)
	root.free()


## Before a scene is written: the editor would compare one that is open with the new file.
func close(path: String) -> void:
	EditorInterface.get_selection().clear() # several selected nodes are shown by one inspector, which outlives them
	await frames(2)
	while path in EditorInterface.get_open_scenes():
		EditorInterface.open_scene_from_path(path)
		await frames(2)
		EditorInterface.close_scene()
		await frames(2)


func open(path: String) -> void:
	await close(path) # one that is open already would be shown as it was
	EditorInterface.open_scene_from_path(path)
	EditorInterface.set_main_screen_editor("2D")
	for i in 60:
		await frames(1)
		var root := EditorInterface.get_edited_scene_root()
		if root != null and root.scene_file_path == path:
			break
	await frames(3)


func select_body(names: Array = ["Jelly"]) -> void:
	var selection := EditorInterface.get_selection()
	selection.clear()
	await frames(1)
	for name: String in names:
		var node := EditorInterface.get_edited_scene_root().get_node_or_null(name)
		if node == null:
			node = EditorInterface.get_edited_scene_root()
		selection.add_node(node)
		body = node if name == names[0] else body
	EditorInterface.set_main_screen_editor("2D") # a scene that is opened brings the screen that it was left in
	await frames(4)
	await center_on(body.global_position)


## Puts a place of the scene into the middle of the viewport, enlarged by so many turns of the wheel.
func center_on(place: Vector2, turns := 6) -> void:
	var editors := EditorInterface.get_editor_main_screen().find_children("*", "CanvasItemEditor", false, false)
	if editors.is_empty():
		return
	editors[0].call(&"center_at", place)
	await frames(2)
	for i in 40: # back to one pixel a pixel
		if plugin.canvas.scene_to_screen(body).get_scale().x <= 1.01:
			break
		turn_wheel(MOUSE_BUTTON_WHEEL_DOWN)
		await frames(1)
	for i in turns:
		turn_wheel(MOUSE_BUTTON_WHEEL_UP)
	editors[0].call(&"center_at", place)
	await frames(2)


func turn_wheel(button: MouseButton) -> void:
	_mouse = view_size() / 2
	_button(button, true, false, false)
	_button(button, false, false, false)


func root() -> Node:
	return EditorInterface.get_edited_scene_root()


func save_and_reload(path := SCENE) -> void:
	EditorInterface.save_scene()
	await frames(5)
	await open(path)
	await select_body()


# Time.

func frames(count: int) -> void:
	for i in count:
		await tree.process_frame


func drawn() -> void:
	plugin.update_overlays()
	EditorInterface.get_base_control().queue_redraw() # the editor draws only what has changed
	await RenderingServer.frame_post_draw


# The mouse. Places are those of the overlay unless said otherwise.

func viewport_origin() -> Vector2:
	var container := EditorInterface.get_editor_viewport_2d().get_parent() as Control
	return container.get_global_transform_with_canvas().origin


func view_size() -> Vector2:
	return (EditorInterface.get_editor_viewport_2d().get_parent() as Control).size


## Where a place in the body's coordinates is on the overlay.
func on_screen(place: Vector2, of: SoftBody2D = body) -> Vector2:
	return plugin.canvas.to_screen(of) * place


func polygon_on_screen(index: int, of: SoftBody2D = body) -> Vector2:
	return on_screen(of.polygon[index], of)


func move(place: Vector2, shift := false) -> void:
	var event := InputEventMouseMotion.new()
	event.position = viewport_origin() + place
	event.global_position = event.position
	event.relative = place - _mouse
	event.button_mask = _held as MouseButtonMask
	event.shift_pressed = shift
	_mouse = place
	tree.root.push_input(event)


func press(place: Vector2, button := MOUSE_BUTTON_LEFT, shift := false, double := false) -> void:
	move(place, shift)
	_button(button, true, shift, double)


func release(button := MOUSE_BUTTON_LEFT, shift := false) -> void:
	_button(button, false, shift, false)


func _button(button: MouseButton, pressed: bool, shift: bool, double: bool) -> void:
	var event := InputEventMouseButton.new()
	event.button_index = button
	event.pressed = pressed
	event.double_click = double
	event.shift_pressed = shift
	event.position = viewport_origin() + _mouse
	event.global_position = event.position
	var mask := 1 << (button - 1)
	_held = _held | mask if pressed else _held & ~mask
	event.button_mask = _held as MouseButtonMask
	tree.root.push_input(event)


func click(place: Vector2, button := MOUSE_BUTTON_LEFT, shift := false, double := false) -> void:
	press(place, button, shift, double)
	release(button, shift)
	await frames(1)


func drag(from: Vector2, to: Vector2, shift := false, steps := 4) -> void:
	press(from, MOUSE_BUTTON_LEFT, shift)
	for i in steps:
		move(from.lerp(to, (i + 1.0) / steps), shift)
	release(MOUSE_BUTTON_LEFT, shift)
	await frames(1)


func key(code: Key, ctrl := false, shift := false) -> void:
	for pressed: bool in [true, false]:
		var event := InputEventKey.new()
		event.keycode = code
		event.physical_keycode = code
		event.pressed = pressed
		event.ctrl_pressed = ctrl
		event.shift_pressed = shift
		tree.root.push_input(event)
	await frames(2)


func press_button(button: BaseButton) -> void:
	var place := button.get_global_transform_with_canvas() * (button.size / 2)
	move(place - viewport_origin())
	for pressed: bool in [true, false]:
		var event := InputEventMouseButton.new()
		event.button_index = MOUSE_BUTTON_LEFT
		event.pressed = pressed
		event.position = place
		event.global_position = place
		event.button_mask = MOUSE_BUTTON_MASK_LEFT if pressed else 0 as MouseButtonMask
		tree.root.push_input(event) # both at once: in between, the window would look where the real pointer is
	await frames(1)


# Undo.

func history() -> UndoRedo:
	var manager := plugin.get_undo_redo()
	return manager.get_history_undo_redo(manager.get_object_history_id(body))


func undo() -> void:
	history().undo()
	await frames(2)


func redo() -> void:
	history().redo()
	await frames(2)


## Claims that since `before` there is one more step of undo, that undoing it gives the bytes of before, and redoing it
## those of after.
func check_one_step(before: Dictionary, version: int, what: String) -> void:
	check_equal(history().get_version(), version + 1, "steps of undo made by " + what)
	var after := bytes(body)
	await undo()
	check(bytes(body) == _bytes_of(before), "undo of %s does not give the bytes of before" % what)
	await redo()
	check(bytes(body) == after, "redo of %s does not give the same bytes" % what)


func bytes(of: SoftBody2D) -> PackedByteArray:
	return _bytes_of(BodyValues.take(of))


func _bytes_of(values: Dictionary) -> PackedByteArray:
	var plain := values.duplicate()
	plain.erase(&"texture")
	return var_to_bytes(plain)


func values() -> Dictionary:
	return BodyValues.copy(BodyValues.take(body))


# Pictures.

## Kept only where the environment says where.
func shot(name: String, area := Rect2i()) -> void:
	var folder := OS.get_environment("SOFT_BODY_2D_SHOTS")
	if folder == "":
		return
	await frames(3)
	await drawn()
	var image := tree.root.get_texture().get_image()
	if area.has_area():
		image = image.get_region(area)
	DirAccess.make_dir_recursive_absolute(folder)
	image.save_png(folder.path_join(name + ".png"))


## The part of the window that the 2D viewport takes.
func viewport_area() -> Rect2i:
	return Rect2i(viewport_origin(), view_size())
