# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## What the modes share: the bodies that are edited, planes and snapping, undo, messages, and how things are drawn.

const BodyValues := preload("../logic/body_values.gd")
const EditorGrid := preload("editor_grid.gd")
const Words := preload("../logic/words.gd")

const GOOD := Color("68d86f")
const FAIR := Color("f7c948")
const BAD := Color("ff5f5f")
## Not the editor's accent color, which it draws its own boxes with.
const LINE := Color("ff8f5c")
const SELECTED := Color("ffffff")
const MESSAGE_TIME := 7.0

signal messaged(text: String)
## The bodies, the mode or a selection is another.
signal changed

var plugin: EditorPlugin
var bodies: Array[SoftBody2D] = []
var snapping := preload("../logic/snapping.gd").new()
## Times of the last handlers [us], for benchmarks.
var handler_usec := 0
var draw_usec := 0
var last_message := ""

var _message_until := 0.0
var _grid := EditorGrid.new()
var _dot: Texture2D


func _init(p_plugin: EditorPlugin) -> void:
	plugin = p_plugin


func scale() -> float:
	return EditorInterface.get_editor_scale()


## How near the mouse must be to a point [px on the screen].
func grab_radius() -> float:
	var settings := EditorInterface.get_editor_settings()
	var radius := 8.0
	if settings.has_setting("editors/polygon_editor/point_grab_radius"):
		radius = settings.get_setting("editors/polygon_editor/point_grab_radius")
	return radius * scale()


## From a body's coordinates to the overlay's: zoom, pan and the body's own transform.
func to_screen(body: SoftBody2D) -> Transform2D:
	return body.get_viewport_transform() * body.get_global_transform()


## From the plane of the scene to the overlay's.
func scene_to_screen(body: SoftBody2D) -> Transform2D:
	return body.get_viewport_transform()


## A place of the overlay in the body's coordinates, on the grid if that is switched on.
func to_body(body: SoftBody2D, place: Vector2) -> Vector2:
	return to_screen(body).affine_inverse() * snapped_on_screen(body, place)


func snapped_on_screen(body: SoftBody2D, place: Vector2) -> Vector2:
	_grid.read(snapping)
	if not snapping.enabled:
		return place
	var view := scene_to_screen(body)
	return view * snapping.snapped_to_grid(view.affine_inverse() * place)


## Whether its transform can be seen through: a body scaled to nothing cannot be edited.
func is_editable(body: SoftBody2D) -> bool:
	return is_instance_valid(body) and body.is_inside_tree() and not is_zero_approx(to_screen(body).determinant())


## Why this node must not be changed; empty when it may.
func lock_problem(node: Node2D) -> String:
	if node.has_meta(&"_edit_lock_"):
		return Words.say("'%s' is locked: unlock it in the toolbar to edit it.") % node.name
	return ""


## False, with a message, when one of the bodies must not be changed.
func may_edit() -> bool:
	for body in bodies:
		var problem := lock_problem(body)
		if problem != "":
			warn(problem)
			return false
	return not bodies.is_empty()


## Makes one step of the editor's undo of what has become of the bodies: `before` and `after` hold values by body. What
## is there already is not set again by it.
func commit(action: String, before: Dictionary, after: Dictionary, more: Array[Dictionary] = []) -> void:
	var changes: Array[Dictionary] = []
	for body: SoftBody2D in after:
		var names := BodyValues.changed(before[body], after[body])
		for name in names:
			changes.append({"object": body, "property": name, "before": before[body][name], "after": after[body][name]})
	changes.append_array(more)
	if changes.is_empty():
		return
	var undo := plugin.get_undo_redo()
	undo.create_action(action, UndoRedo.MERGE_DISABLE, changes[0]["object"])
	for change in changes:
		undo.add_do_property(change["object"], change["property"], change["after"])
		undo.add_undo_property(change["object"], change["property"], change["before"])
	undo.commit_action()
	for change in changes:
		_tell_inheritance(change["object"])
	redraw()
	changed.emit()


## Values of all bodies, by body.
func take_values() -> Dictionary:
	var values := {}
	for body in bodies:
		values[body] = BodyValues.take(body)
	return values


func _tell_inheritance(object: Object) -> void:
	var body := object as SoftBody2D
	var origin := origin_of(body) if body != null else ""
	if origin != "":
		tell(Words.say("'%s' comes from %s: what you change is kept in this scene, over what it says there.") % [body.name,
				origin.get_file()])


## The scene that a node comes from, if that is not the one that is edited: by inheritance, or as an instance.
func origin_of(node: Node) -> String:
	var root := EditorInterface.get_edited_scene_root()
	if root == null:
		return ""
	if node == root or (root.is_ancestor_of(node) and node.owner == root and node.scene_file_path == ""):
		var state := _inherited_state(root)
		return state.get_path() if state != null and _state_has(state, root.get_path_to(node)) else ""
	if node.scene_file_path == "" and node.owner != null:
		return node.owner.scene_file_path
	return node.scene_file_path


func _inherited_state(root: Node) -> SceneState:
	if root.scene_file_path == "" or not ResourceLoader.exists(root.scene_file_path):
		return null
	var packed := ResourceLoader.load(root.scene_file_path, "PackedScene") as PackedScene
	return packed.get_state().get_base_scene_state() if packed != null else null


func _state_has(state: SceneState, path: NodePath) -> bool:
	var wanted := String(path).trim_prefix("./")
	for i in state.get_node_count():
		if String(state.get_node_path(i)).trim_prefix("./") == wanted:
			return true
	return false


# Messages.

func tell(text: String) -> void:
	_show(text, 0)


## Says which properties of single points and springs an edit has taken away.
func tell_losses(lost: PackedStringArray) -> void:
	if not lost.is_empty():
		tell(Words.say("What was set for single points and springs does not fit the new polygon and is gone (undo brings it back): %s.") % ", ".join(lost))


func warn(text: String) -> void:
	_show(text, 1)


func _show(text: String, severity: int) -> void:
	last_message = text
	_message_until = Time.get_ticks_msec() / 1000.0 + MESSAGE_TIME
	if EditorInterface.has_method(&"get_editor_toaster"): # 4.5
		EditorInterface.call(&"get_editor_toaster").call(&"push_toast", text, severity, "")
	messaged.emit(text)
	redraw()


func has_message() -> bool:
	return Time.get_ticks_msec() / 1000.0 < _message_until


func redraw() -> void:
	plugin.update_overlays()


# Drawing.

func draw_outline(overlay: Control, points: PackedVector2Array, color: Color, width := 1.5) -> void:
	if points.size() < 2:
		return
	var closed := points.duplicate()
	closed.append(points[0])
	overlay.draw_polyline(closed, color, width * scale(), true)


# One texture for all points: circles are drawn as polygons, which takes several times as long.
func draw_point(overlay: Control, place: Vector2, color: Color, large := false) -> void:
	if _dot == null:
		_dot = _make_dot()
	var size := (12.0 if large else 10.0) * scale()
	overlay.draw_texture_rect(_dot, Rect2(place - Vector2(size, size) / 2, Vector2(size, size)), false, color)


# White with a dark rim.
func _make_dot() -> Texture2D:
	const SVG := "<svg xmlns='http://www.w3.org/2000/svg' width='12' height='12'><circle cx='6' cy='6' r='6' fill='#000' fill-opacity='.6'/><circle cx='6' cy='6' r='4.8' fill='#fff'/></svg>"
	var image := Image.new()
	image.load_svg_from_string(SVG, 2 * scale())
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)


func draw_square(overlay: Control, place: Vector2, color: Color) -> void:
	var size := Vector2.ONE * 8 * scale()
	overlay.draw_rect(Rect2(place - size / 2, size).grow(scale()), Color(0, 0, 0, 0.6))
	overlay.draw_rect(Rect2(place - size / 2, size), color)


func draw_box(overlay: Control, box: Rect2) -> void:
	var color: Color = overlay.get_theme_color(&"box_selection_fill_color", &"Editor")
	var border: Color = overlay.get_theme_color(&"box_selection_stroke_color", &"Editor")
	overlay.draw_rect(box, color)
	overlay.draw_rect(box, border, false, scale())


func draw_text(overlay: Control, place: Vector2, text: String, color: Color) -> void:
	var font: Font = overlay.get_theme_font(&"main", &"EditorFonts")
	var size: int = overlay.get_theme_font_size(&"main_size", &"EditorFonts")
	var width := font.get_string_size(text, HORIZONTAL_ALIGNMENT_LEFT, -1, size).x
	place.x = clampf(place.x, 4 * scale(), maxf(4 * scale(), overlay.size.x - width - 8 * scale()))
	overlay.draw_string_outline(font, place, text, HORIZONTAL_ALIGNMENT_LEFT, -1, size, roundi(4 * scale()), Color(0, 0,
			0, 0.7))
	overlay.draw_string(font, place, text, HORIZONTAL_ALIGNMENT_LEFT, -1, size, color)


func draw_message(overlay: Control) -> void:
	if has_message():
		# Newer engines show it in their own way.
		if EditorInterface.has_method(&"get_editor_toaster"):
			return
		draw_text(overlay, Vector2(48 * scale(), overlay.size.y - 40 * scale()), last_message, FAIR)
