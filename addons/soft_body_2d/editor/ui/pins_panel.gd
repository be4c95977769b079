# SPDX-License-Identifier: MIT
@tool
extends VBoxContainer
## Beside the canvas in pins mode: pins what is selected, and says what it follows.

const PinsMode := preload("../canvas/pins_mode.gd")
const Words := preload("../logic/words.gd")

var pin_button: Button
var unpin_button: Button
var assign_button: Button

var _mode: PinsMode
var _count := Label.new()
var _list := ItemList.new()


func set_up(mode: PinsMode) -> void:
	_mode = mode
	name = "SoftBody2DPins"
	custom_minimum_size.x = 200 * EditorInterface.get_editor_scale()
	var title := Label.new()
	title.text = Words.say("Pins")
	title.theme_type_variation = &"HeaderSmall"
	add_child(title)
	add_child(_count)
	pin_button = _add_button(Words.say("Pin"),
			Words.say("Hold the selected points where they are. Right-click or double-click pins a single one."), _mode.pin_selected.bind(true))
	unpin_button = _add_button(Words.say("Unpin"), Words.say("Let the selected points go."),
			_mode.pin_selected.bind(false))
	assign_button = _add_button(Words.say("Follow Node…"),
			Words.say("Pin the selected points to a node: they keep their places beside it."), _choose_node)
	_add_button(Words.say("Follow the World"), Words.say("The selected points stay where they are."),
			_mode.assign_selected.bind(null))
	_list.size_flags_vertical = SIZE_EXPAND_FILL
	_list.custom_minimum_size.y = 120 * EditorInterface.get_editor_scale()
	_list.select_mode = ItemList.SELECT_MULTI
	_list.multi_selected.connect(_on_list_selected)
	add_child(_list)
	show_selection()


func show_selection() -> void:
	_count.text = Words.say("Points selected: %d") % _mode.selection.size()
	for button: Button in [pin_button, unpin_button, assign_button]:
		button.disabled = _mode.selection.is_empty()
	_list.clear()
	for body in _mode.canvas.bodies:
		for i in body.pinned_points.size():
			var path: NodePath = body.pin_targets[i] if i < body.pin_targets.size() else NodePath()
			var text := Words.say("Point %d: the world") % body.pinned_points[i]
			if path != NodePath():
				text = Words.say("Point %d: %s") % [body.pinned_points[i], path]
			var item := _list.add_item(text)
			_list.set_item_metadata(item, [body, body.pinned_points[i]])
			if _mode.selection.has(body, body.pinned_points[i]):
				_list.select(item, false)


func _on_list_selected(item: int, selected: bool) -> void:
	var entry: Array = _list.get_item_metadata(item)
	if selected:
		_mode.selection.add(entry[0], [entry[1]])
	else:
		_mode.selection.remove(entry[0], entry[1])
	_mode.canvas.redraw()


func _choose_node() -> void:
	EditorInterface.popup_node_selector(_on_node_chosen, [&"Node2D"])


func _on_node_chosen(path: NodePath) -> void:
	var root := EditorInterface.get_edited_scene_root()
	var node := root.get_node_or_null(path) as Node2D if root != null and path != NodePath() else null
	if node != null:
		_mode.assign_selected(node)


func _add_button(text: String, tooltip: String, action: Callable) -> Button:
	var button := Button.new()
	button.text = text
	button.tooltip_text = tooltip
	button.pressed.connect(action)
	add_child(button)
	return button
