# SPDX-License-Identifier: MIT
@tool
extends ConfirmationDialog
## Asks for the numbers of a start shape.

const Words := preload("../logic/words.gd")

## Of each shape its fields: name, label, least, most, step, default.
const FIELDS := {
	&"circle": [["radius", "Radius (px)", 1, 10000, 0.5, 50], ["count", "Points", 3, 4096, 1, 16]],
	&"rectangle": [["width", "Width (px)", 1, 10000, 0.5, 100], ["height", "Height (px)", 1, 10000, 0.5, 60], ["spacing",
			"Distance of points (px)", 1, 1000, 0.5, 20]],
	&"capsule": [["radius", "Radius (px)", 1, 10000, 0.5, 30], ["height", "Height (px)", 2, 20000, 0.5, 120], ["spacing",
			"Distance of points (px)", 1, 1000, 0.5, 16]],
	&"regular_polygon": [["radius", "Radius (px)", 1, 10000, 0.5, 50], ["sides", "Sides", 3, 256, 1, 6], ["per_side",
			"Pieces per side", 1, 64, 1, 3]],
	&"polygon_2d": [],
	&"path_2d": [["count", "Points", 3, 4096, 1, 24]],
	&"sprite_2d": [["count", "Points at most", 3, 1024, 1, 32], ["threshold", "Opaque above alpha", 0.01, 0.99, 0.01,
			0.5], ["margin", "Grow (px)", -100, 100, 0.5, 0]],
	&"texture": [["count", "Points at most", 3, 1024, 1, 32], ["threshold", "Opaque above alpha", 0.01, 0.99, 0.01, 0.5],
			["margin", "Grow (px)", -100, 100, 0.5, 0]],
	&"resample": [["count", "Points", 3, 4096, 1, 24]],
}

signal accepted(shape: StringName, values: Dictionary)

var shape := &""
var fields := {}

var _grid := GridContainer.new()


func _init() -> void:
	name = "SoftBody2DShapeDialog"
	_grid.columns = 2
	add_child(_grid)
	confirmed.connect(_on_confirmed)


func ask(p_shape: StringName, p_title: String, defaults := {}) -> void:
	shape = p_shape
	title = p_title.trim_suffix("…")
	for child in _grid.get_children():
		_grid.remove_child(child)
		child.queue_free()
	fields.clear()
	for entry: Array in FIELDS[shape]:
		var label := Label.new()
		label.text = Words.say(entry[1])
		_grid.add_child(label)
		var field := SpinBox.new()
		field.min_value = entry[2]
		field.max_value = entry[3]
		field.step = entry[4]
		field.value = defaults.get(entry[0], entry[5])
		_grid.add_child(field)
		fields[entry[0]] = field
	reset_size()
	popup_centered()


func _on_confirmed() -> void:
	var values := {}
	for field: String in fields:
		fields[field].apply()
		values[field] = fields[field].value
	accepted.emit(shape, values)
