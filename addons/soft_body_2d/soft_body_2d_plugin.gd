# SPDX-License-Identifier: MIT
@tool
extends EditorPlugin
## The editor tools of SoftBody2D. Thin: it hands input and drawing to the mode that is on, and ties the parts together.

const BodyCanvas := preload("editor/canvas/body_canvas.gd")
const ConvertCommands := preload("editor/ui/convert_commands.gd")
const ConvertMenu := preload("editor/ui/convert_menu.gd")
const DetailMode := preload("editor/canvas/detail_mode.gd")
const DetailPanel := preload("editor/ui/detail_panel.gd")
const EditedBodies := preload("editor/ui/edited_bodies.gd")
const HolesMode := preload("editor/canvas/holes_mode.gd")
const NewBodies := preload("editor/ui/new_bodies.gd")
const PathMode := preload("editor/canvas/path_mode.gd")
const PolygonMode := preload("editor/canvas/polygon_mode.gd")
const LookChoice := preload("editor/logic/look_choice.gd")
const LivePreview := preload("editor/preview/live_preview.gd")
const Mode := preload("editor/canvas/mode.gd")
const PinsMode := preload("editor/canvas/pins_mode.gd")
const PinsPanel := preload("editor/ui/pins_panel.gd")
const ShapeCommands := preload("editor/ui/shape_commands.gd")
const SpringsMode := preload("editor/canvas/springs_mode.gd")
const SpringsPanel := preload("editor/ui/springs_panel.gd")
const StabilityInspector := preload("editor/inspector/stability_inspector.gd")
const Toolbar := preload("editor/ui/toolbar.gd")
const Words := preload("editor/logic/words.gd")

var canvas: BodyCanvas
var polygon_mode: PolygonMode
var springs_mode: SpringsMode
var pins_mode: PinsMode
var holes_mode: HolesMode
var detail_mode: DetailMode
var path_mode: PathMode
var preview: LivePreview
var toolbar: Toolbar
var springs_panel: SpringsPanel
var pins_panel: PinsPanel
var detail_panel: DetailPanel
var shapes: ShapeCommands
var convert_commands: ConvertCommands
var convert_menu: ConvertMenu
var inspector: StabilityInspector

var _new_bodies := NewBodies.new()
var _context_menu: RefCounted # an EditorContextMenuPlugin, which Godot 4.3 has not
var _mode := Toolbar.Mode.POLYGON
var _rope_mode := Toolbar.Mode.PATH # or none: what ropes are edited with


func _enter_tree() -> void:
	Words.load_translations()
	canvas = BodyCanvas.new(self)
	polygon_mode = PolygonMode.new(canvas)
	springs_mode = SpringsMode.new(canvas)
	pins_mode = PinsMode.new(canvas)
	holes_mode = HolesMode.new(canvas)
	detail_mode = DetailMode.new(canvas)
	path_mode = PathMode.new(canvas)
	preview = LivePreview.new(canvas)
	canvas.changed.connect(_on_changed)

	toolbar = Toolbar.new()
	add_control_to_container(CONTAINER_CANVAS_EDITOR_MENU, toolbar)
	toolbar.mode_chosen.connect(set_mode)
	toolbar.create_toggled.connect(_set_creating)
	toolbar.preset_chosen.connect(_on_preset_chosen)
	toolbar.preview_toggled.connect(set_preview)
	toolbar.help_wanted.connect(_show_help)
	shapes = ShapeCommands.new()
	shapes.canvas = canvas
	EditorInterface.get_base_control().add_child(shapes)
	toolbar.shape_chosen.connect(_on_shape_chosen)

	_add_convert_menu()

	springs_panel = SpringsPanel.new()
	springs_panel.set_up(springs_mode)
	add_control_to_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, springs_panel)
	pins_panel = PinsPanel.new()
	pins_panel.set_up(pins_mode)
	add_control_to_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, pins_panel)
	detail_panel = DetailPanel.new()
	detail_panel.set_up(detail_mode)
	add_control_to_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, detail_panel)

	inspector = StabilityInspector.new()
	inspector.canvas = canvas
	add_inspector_plugin(inspector)
	add_undo_redo_inspector_hook_callback(_add_undo_of_preset)
	add_undo_redo_inspector_hook_callback(_keep_look)
	_new_bodies.start(get_undo_redo(), get_tree())
	get_undo_redo().version_changed.connect(_on_version_changed)
	EditorInterface.get_selection().selection_changed.connect(_on_selection_changed)
	toolbar.show_mode(_mode)
	_make_visible(false)
	_on_selection_changed()


func _exit_tree() -> void:
	preview.stop()
	_new_bodies.stop()
	for each in _modes():
		each.cancel()
	EditorInterface.get_selection().selection_changed.disconnect(_on_selection_changed)
	get_undo_redo().version_changed.disconnect(_on_version_changed)
	remove_undo_redo_inspector_hook_callback(_add_undo_of_preset)
	remove_undo_redo_inspector_hook_callback(_keep_look)
	remove_inspector_plugin(inspector)
	remove_control_from_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, detail_panel)
	remove_control_from_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, pins_panel)
	remove_control_from_container(CONTAINER_CANVAS_EDITOR_SIDE_RIGHT, springs_panel)
	remove_control_from_container(CONTAINER_CANVAS_EDITOR_MENU, toolbar)
	remove_control_from_container(CONTAINER_CANVAS_EDITOR_MENU, convert_menu)
	if _context_menu != null:
		call(&"remove_context_menu_plugin", _context_menu)
		_context_menu = null
	for node: Node in [detail_panel, pins_panel, springs_panel, toolbar, shapes, convert_menu, convert_commands]:
		node.queue_free()
	# The inspector shows a panel of ours until it is made anew.
	var edited := EditorInterface.get_inspector().get_edited_object()
	if edited is SoftBody2D:
		edited.notify_property_list_changed()
	canvas.bodies.clear()
	canvas.changed.disconnect(_on_changed)
	Words.unload_translations()
	update_overlays()


func _handles(object: Object) -> bool:
	return EditedBodies.has_any(object) or not EditedBodies.ropes_of(object).is_empty()


func _edit(object: Object) -> void:
	var bodies := EditedBodies.of(object)
	_set_bodies(bodies if not bodies.is_empty() else EditedBodies.ropes_of(object))


func _make_visible(visible: bool) -> void:
	toolbar.visible = visible
	if not visible:
		_set_bodies([])
	_show_panels()


func _forward_canvas_gui_input(event: InputEvent) -> bool:
	var begin := Time.get_ticks_usec()
	var used := _current().input(event) if not canvas.bodies.is_empty() and _current() != null else false
	canvas.handler_usec = Time.get_ticks_usec() - begin
	return used


func _forward_canvas_draw_over_viewport(overlay: Control) -> void:
	var begin := Time.get_ticks_usec()
	if not canvas.bodies.is_empty() and _current() != null:
		_current().draw(overlay)
	canvas.draw_message(overlay)
	canvas.draw_usec = Time.get_ticks_usec() - begin


func _process(delta: float) -> void:
	preview.process(delta)


func _apply_changes() -> void:
	_current_cancel() # a scene is saved as it was before a drag that is under way


func _get_plugin_name() -> String:
	return "SoftBody2D"


func mode() -> Toolbar.Mode:
	return _rope_mode if _has_ropes() else _mode


func set_mode(mode: Toolbar.Mode) -> void:
	_current_cancel()
	if mode == Toolbar.Mode.PATH or (mode == Toolbar.Mode.NONE and _has_ropes()):
		_rope_mode = mode
	else:
		_mode = mode
	_show_mode()
	update_overlays()


func _show_mode() -> void:
	toolbar.show_mode(mode(), _has_ropes())
	_show_panels()


func _has_ropes() -> bool:
	return not canvas.bodies.is_empty() and is_instance_valid(canvas.bodies[0]) and canvas.bodies[0] is SoftRope2D


func _set_creating(enabled: bool) -> void:
	if _current() != null:
		_current().set_creating(enabled)


func _modes() -> Array[Mode]:
	return [polygon_mode, springs_mode, pins_mode, holes_mode, detail_mode, path_mode]


func set_preview(playing: bool) -> void:
	_current_cancel()
	if playing:
		preview.start()
	else:
		preview.stop()
	toolbar.show_preview(preview.is_playing())
	update_overlays()


func _current() -> Mode:
	if preview.is_playing():
		return preview
	return _modes()[mode() - 1] if mode() != Toolbar.Mode.NONE else null


func _current_cancel() -> void:
	if _current() != null and not canvas.bodies.is_empty():
		_current().cancel()


func _set_bodies(bodies: Array[SoftBody2D]) -> void:
	if canvas.bodies == bodies:
		return
	_current_cancel()
	for each in _modes():
		each.set_creating(false)
	canvas.bodies = bodies
	_show_mode()
	_on_changed()
	update_overlays()


func _add_convert_menu() -> void:
	convert_commands = ConvertCommands.new()
	convert_commands.canvas = canvas
	convert_commands.preview_outline = preview.outline_of
	convert_commands.starting.connect(set_preview.bind(false)) # which also takes a drag back
	EditorInterface.get_base_control().add_child(convert_commands)
	convert_menu = ConvertMenu.new()
	convert_menu.commands = convert_commands
	add_control_to_container(CONTAINER_CANVAS_EDITOR_MENU, convert_menu)
	if ClassDB.class_exists(&"EditorContextMenuPlugin"):
		_context_menu = load("res://addons/soft_body_2d/editor/ui/convert_context_menu.gd").new()
		_context_menu.menu = convert_menu
		call(&"add_context_menu_plugin", 0, _context_menu) # CONTEXT_SLOT_SCENE_TREE


# The editor asks `_edit` of several nodes with an object of its own, which says nothing of which ones they are.
func _on_selection_changed() -> void:
	convert_menu.show_selection()
	var bodies := EditedBodies.selected()
	if bodies.is_empty():
		bodies = EditedBodies.selected_ropes()
	if not bodies.is_empty() and toolbar.visible:
		_set_bodies(bodies)


func _on_version_changed() -> void:
	_on_changed()
	update_overlays()


func _on_changed() -> void:
	canvas.bodies = canvas.bodies.filter(func(body: SoftBody2D) -> bool: return is_instance_valid(body))
	for each in _modes():
		each.follow_bodies()
	toolbar.show_creating(_current() != null and _current().is_creating())
	toolbar.show_preview(preview.is_playing())
	springs_panel.show_selection()
	pins_panel.show_selection()
	detail_panel.show_bodies()


func _show_panels() -> void:
	springs_panel.visible = toolbar.visible and mode() == Toolbar.Mode.SPRINGS
	pins_panel.visible = toolbar.visible and mode() == Toolbar.Mode.PINS
	detail_panel.visible = toolbar.visible and mode() == Toolbar.Mode.DETAIL


func _on_shape_chosen(shape: StringName) -> void:
	_current_cancel()
	for entry: Array in Toolbar.SHAPES:
		if entry[0] == shape:
			shapes.choose(shape, Words.say(entry[1]))


func _on_preset_chosen(preset: int) -> void:
	_current_cancel()
	shapes.set_preset(preset)


# A preset sets several values, which the inspector would not put back.
func _add_undo_of_preset(undo_redo: Object, object: Object, property: String, _value: Variant) -> void:
	if property == "preset" and (object is SoftBody2D or object is SoftBodyMaterial2D):
		var values: Array[StringName] = [&"youngs_modulus", &"poisson_ratio", &"damping_ratio", &"rolling_resistance"]
		values.append_array([&"physics_material_override"] if object is SoftBody2D else [&"friction", &"bounce"])
		for value in values:
			(undo_redo as EditorUndoRedoManager).add_undo_property(object, value, object.get(value))


# A node looks soft until something of its look is set; in the inspector it stays so. Steps that the editor merges keep what
# the last one does, so each of them sets it.
func _keep_look(undo_redo: Object, object: Object, property: String, _value: Variant) -> void:
	if object is SoftBody2D:
		var kept := LookChoice.kept_with(property, object)
		for name: StringName in kept:
			(undo_redo as EditorUndoRedoManager).add_do_property(object, name, kept[name])
			(undo_redo as EditorUndoRedoManager).add_undo_property(object, name, object.get(name))


func _show_help() -> void:
	EditorInterface.set_main_screen_editor("Script")
	EditorInterface.get_script_editor().goto_help("class_name:SoftBody2D")
