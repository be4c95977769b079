# SPDX-License-Identifier: MIT
extends VBoxContainer
## One slider for each value of a [SoftBodyMaterial2D], with the inspector's range and unit.

signal value_changed(property: StringName, value: float)

const NAME_WIDTH := 118
const VALUE_WIDTH := 92

var _sliders := {} # StringName -> HSlider


## Makes the sliders, which begin at the material's values.
func show_material(material: SoftBodyMaterial2D) -> void:
	for child in get_children():
		child.queue_free()
	_sliders.clear()
	for property in material.get_property_list():
		var is_value: bool = property["type"] == TYPE_FLOAT and property["hint"] == PROPERTY_HINT_RANGE
		if is_value and property["usage"] & PROPERTY_USAGE_EDITOR:
			_add_slider(property["name"], property["hint_string"], material.get(property["name"]))


func get_names() -> Array:
	return _sliders.keys()


## Has the effect of a moved slider.
func set_value(property: StringName, value: float) -> void:
	(_sliders[property] as HSlider).value = value


func _add_slider(property: StringName, hint: String, value: float) -> void:
	var parts := hint.split(",")
	var unit := ""
	for part in parts.slice(3):
		if part.begins_with("suffix:"):
			unit = part.trim_prefix("suffix:")
	var row := HBoxContainer.new()
	var title := Label.new()
	title.text = property
	title.custom_minimum_size.x = NAME_WIDTH
	title.add_theme_font_size_override(&"font_size", 13)
	var slider := HSlider.new()
	slider.min_value = parts[0].to_float()
	slider.max_value = parts[1].to_float()
	slider.step = parts[2].to_float()
	slider.exp_edit = "exp" in parts
	slider.allow_greater = "or_greater" in parts
	slider.value = value
	slider.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	slider.size_flags_vertical = Control.SIZE_SHRINK_CENTER
	var shown := Label.new()
	shown.custom_minimum_size.x = VALUE_WIDTH
	shown.add_theme_font_size_override(&"font_size", 13)
	var tell := func(now: float) -> void: shown.text = "%s %s" % [String.num(now, 3), unit]
	tell.call(value)
	slider.value_changed.connect(func(now: float) -> void:
		tell.call(now)
		value_changed.emit(property, now))
	for part: Control in [title, slider, shown]:
		row.add_child(part)
	add_child(row)
	_sliders[property] = slider
