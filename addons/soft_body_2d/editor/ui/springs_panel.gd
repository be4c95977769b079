# SPDX-License-Identifier: MIT
@tool
extends VBoxContainer
## Beside the canvas in spring mode: tools, selections, the values of what is selected, the brush.

const SpringEdit := preload("../logic/spring_edit.gd")
const SpringsMode := preload("../canvas/springs_mode.gd")
const Words := preload("../logic/words.gd")

const SCALES: Array = [
	[&"spring_stiffness_scales", "Stiffness ×", 0.0], [&"spring_damping_scales", "Damping ×", 0.0],
	[&"spring_length_scales", "Rest length ×", 0.01],
]

var tool_buttons: Array[Button] = []
var all_polygon_button: Button
var all_inner_button: Button
var fields: Array[SpinBox] = []
var brush_fields := {}
var remove_button: Button

var _mode: SpringsMode
var _count := Label.new()
var _is_showing := false


func set_up(mode: SpringsMode) -> void:
	_mode = mode
	name = "SoftBody2DSprings"
	custom_minimum_size.x = 200 * EditorInterface.get_editor_scale()
	_add_title(Words.say("Springs"))
	var tools := HBoxContainer.new()
	add_child(tools)
	var group := ButtonGroup.new()
	for entry: Array in [["Select", "Click springs, or draw a box around them. Shift adds; Delete or right-click removes."],
			["Brush", "Paint stiffness onto springs."],
			["Add", "Drag from point to point for a spring; click inside for an inner point; right-click takes them out."]]:
		var button := Button.new()
		button.text = Words.say(entry[0])
		button.tooltip_text = Words.say(entry[1])
		button.toggle_mode = true
		button.button_group = group
		button.size_flags_horizontal = SIZE_EXPAND_FILL
		tools.add_child(button)
		tool_buttons.append(button)
	tool_buttons[0].button_pressed = true
	group.pressed.connect(func(button: BaseButton) -> void: _mode.tool = tool_buttons.find(button) as SpringsMode.Tool)

	var selecting := HBoxContainer.new()
	add_child(selecting)
	all_polygon_button = _add_button(selecting, Words.say("All Polygon"), _mode.select_kind.bind(SpringEdit.Kind.POLYGON))
	all_inner_button = _add_button(selecting, Words.say("All Inner"), _mode.select_kind.bind(SpringEdit.Kind.INNER))
	_add_button(selecting, Words.say("None"), _mode.select_none)
	add_child(_count)
	var grid := GridContainer.new()
	grid.columns = 2
	add_child(grid)
	for entry: Array in SCALES:
		var field := _add_field(grid, Words.say(entry[1]), entry[2], 100, 0.01, 1)
		field.allow_greater = true
		field.tooltip_text = Words.say("A factor on the value of the whole body, for the selected springs.")
		field.value_changed.connect(_on_scale_changed.bind(entry[0]))
		fields.append(field)
	remove_button = _add_button(self, Words.say("Remove Selected"), _mode.remove_selected)

	_add_title(Words.say("Brush"))
	var brush_grid := GridContainer.new()
	brush_grid.columns = 2
	add_child(brush_grid)
	for entry: Array in [["target", "Paints ×", 0.0, 100.0, 0.01], ["radius", "Radius (px)", 1.0, 1000.0, 1.0],
			["falloff", "Falloff", 0.0, 1.0, 0.01], ["strength", "Strength", 0.1, 20.0, 0.1]]:
		var field := _add_field(brush_grid, Words.say(entry[1]), entry[2], entry[3], entry[4], _mode.brush.get(entry[0]))
		field.value_changed.connect(func(value: float) -> void: _mode.brush.set(entry[0], value))
		brush_fields[entry[0]] = field
	show_selection()


## Fills the fields with the values of the first selected spring.
func show_selection() -> void:
	_count.text = Words.say("Springs selected: %d") % _mode.selection.size()
	remove_button.disabled = _mode.selection.is_empty()
	_is_showing = true
	for i in fields.size():
		fields[i].editable = not _mode.selection.is_empty()
		for body in _mode.canvas.bodies:
			var chosen := _mode.selection.of(body)
			var factors: PackedFloat32Array = body.get(SCALES[i][0])
			if not chosen.is_empty():
				fields[i].value = factors[chosen[0]] if factors.size() == body.get_spring_count() and chosen[0] < factors.size() else 1.0
				break
	_is_showing = false


func _on_scale_changed(value: float, property: StringName) -> void:
	if not _is_showing:
		_mode.set_scale(property, value)


func _add_title(text: String) -> void:
	var title := Label.new()
	title.text = text
	title.theme_type_variation = &"HeaderSmall"
	add_child(title)


func _add_button(parent: Node, text: String, action: Callable) -> Button:
	var button := Button.new()
	button.text = text
	button.size_flags_horizontal = SIZE_EXPAND_FILL
	button.pressed.connect(action)
	parent.add_child(button)
	return button


func _add_field(parent: Node, text: String, least: float, most: float, step: float, value: float) -> SpinBox:
	var label := Label.new()
	label.text = text
	label.size_flags_horizontal = SIZE_EXPAND_FILL
	parent.add_child(label)
	var field := SpinBox.new()
	field.min_value = least
	field.max_value = most
	field.step = step
	field.value = value
	parent.add_child(field)
	return field
