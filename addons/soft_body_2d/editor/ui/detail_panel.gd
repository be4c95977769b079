# SPDX-License-Identifier: MIT
@tool
extends VBoxContainer
## Beside the canvas in detail mode: how many points are simulated, the brush, and what clears it.

const DetailMode := preload("../canvas/detail_mode.gd")
const DetailPaint := preload("../logic/detail_paint.gd")
const Words := preload("../logic/words.gd")

var figures := Label.new()
var automatic_button: Button
var clear_button: Button
var brush_fields := {}

var _mode: DetailMode


func set_up(mode: DetailMode) -> void:
	_mode = mode
	name = "SoftBody2DDetail"
	custom_minimum_size.x = 200 * EditorInterface.get_editor_scale()
	_add_title(Words.say("Detail"))
	figures.autowrap_mode = TextServer.AUTOWRAP_WORD_SMART
	add_child(figures)
	automatic_button = _add_button(Words.say("Set to Automatic"),
			Words.say("Simulate the fewest points that keep the outline within its tolerance."), _mode.set_automatic)
	_add_title(Words.say("Brush"))
	var grid := GridContainer.new()
	grid.columns = 2
	add_child(grid)
	for entry: Array in [["target", "Paints ×", DetailPaint.LEAST, DetailPaint.MOST, 0.1], ["radius", "Radius (px)", 1.0, 1000.0, 1.0],
			["falloff", "Falloff", 0.0, 1.0, 0.01], ["strength", "Strength", 0.1, 20.0, 0.1]]:
		var label := Label.new()
		label.text = Words.say(entry[1])
		label.size_flags_horizontal = SIZE_EXPAND_FILL
		grid.add_child(label)
		var field := SpinBox.new()
		field.min_value = entry[2]
		field.max_value = entry[3]
		field.step = entry[4]
		field.value = _mode.brush.get(entry[0])
		field.value_changed.connect(func(value: float) -> void: _mode.brush.set(entry[0], value))
		grid.add_child(field)
		brush_fields[entry[0]] = field
	brush_fields["target"].tooltip_text = Words.say("How many times as fine as elsewhere the outline becomes under the brush. The right button paints back to 1.")
	clear_button = _add_button(Words.say("Clear All"), Words.say("As fine everywhere as the tolerance says."), _mode.clear_weights)
	show_bodies()


## Says what is simulated of the bodies that are edited.
func show_bodies() -> void:
	var lines := PackedStringArray()
	var is_as_drawn := false
	var has_weights := false
	for body in _mode.canvas.bodies:
		if not body is SoftRope2D:
			lines.append(Words.say("%d of %d points are simulated.") % [body.get_simulated_polygon().size(), body.polygon.size()])
			is_as_drawn = is_as_drawn or body.detail_mode == SoftBody2D.DETAIL_MODE_AS_DRAWN
			has_weights = has_weights or not body.detail_weights.is_empty()
	if is_as_drawn:
		lines.append(Words.say("Detail is As Drawn: what is painted takes effect when it is Automatic."))
	figures.text = "\n".join(lines)
	automatic_button.visible = is_as_drawn
	clear_button.disabled = not has_weights


func _add_title(text: String) -> void:
	var title := Label.new()
	title.text = text
	title.theme_type_variation = &"HeaderSmall"
	add_child(title)


func _add_button(text: String, tooltip: String, action: Callable) -> Button:
	var button := Button.new()
	button.text = text
	button.tooltip_text = tooltip
	button.pressed.connect(action)
	add_child(button)
	return button
