# SPDX-License-Identifier: MIT
extends VBoxContainer
## Volume, quality and screen; what is changed counts at once and is kept when the panel is left.

signal closed

const Settings := preload("res://game/settings.gd")
const Look := preload("res://game/ui/look.gd")

var _first: Control


func _ready() -> void:
	add_theme_constant_override(&"separation", 14)
	add_child(Look.title("Settings", 38))
	_first = _slider("Sound", Settings.sound_volume, func(value: float) -> void: Settings.sound_volume = value)
	_slider("Music", Settings.music_volume, func(value: float) -> void: Settings.music_volume = value)
	var quality := OptionButton.new()
	for name in Settings.QUALITY_NAMES:
		quality.add_item(name)
	quality.selected = Settings.quality
	quality.item_selected.connect(func(index: int) -> void:
		Settings.quality = index as Settings.Quality
		Settings.apply(get_tree()))
	_row("Quality", quality)
	if not OS.has_feature("mobile"):
		var full := CheckButton.new()
		full.button_pressed = Settings.fullscreen
		full.toggled.connect(func(on: bool) -> void:
			Settings.fullscreen = on
			Settings.apply(get_tree()))
		_row("Full screen", full)
	add_child(Look.button("Back", close))


func open() -> void:
	visible = true
	_first.grab_focus()


func close() -> void:
	visible = false
	Settings.write()
	closed.emit()


func _slider(caption: String, value: float, changed: Callable) -> HSlider:
	var slider := HSlider.new()
	slider.max_value = 1
	slider.step = 0.05
	slider.value = value
	slider.custom_minimum_size = Vector2(220, 34)
	slider.value_changed.connect(func(now: float) -> void:
		changed.call(now)
		Settings.apply(get_tree()))
	_row(caption, slider)
	return slider


func _row(caption: String, control: Control) -> void:
	var row := HBoxContainer.new()
	var label := Label.new()
	label.text = caption
	label.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	control.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	row.add_child(label)
	row.add_child(control)
	add_child(row)
