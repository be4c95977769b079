# SPDX-License-Identifier: MIT
extends CanvasLayer
## The end: how long it took, how many stars came home.

signal again_asked
signal menu_asked

const Look := preload("res://game/ui/look.gd")
const Hud := preload("res://game/ui/hud.gd")
const Palette := preload("res://game/palette.gd")
const Star := preload("res://game/world/star.gd")
const Settings := preload("res://game/settings.gd")

var _rows: VBoxContainer
var _rain := Control.new()
var _age := 0.0


func _ready() -> void:
	layer = 7
	visible = false
	Look.veil(self, 0.35)
	_rain.set_anchors_preset(Control.PRESET_FULL_RECT)
	_rain.mouse_filter = Control.MOUSE_FILTER_IGNORE
	_rain.draw.connect(_draw_rain)
	add_child(_rain)
	_rows = Look.centered_panel(self, 480)


func open(time: float, stars: int, possible: int, is_best: bool) -> void:
	_rows.add_child(Look.title("Home!", 60))
	_line("Time", Hud.clock(time) + ("   best!" if is_best else ""))
	_line("Stars", "%d of %d%s" % [stars, possible, "   all of them!" if stars == possible else ""])
	if Settings.best_time > 0 and not is_best:
		_line("Best", Hud.clock(Settings.best_time))
	var again := Look.button("Play again", again_asked.emit)
	_rows.add_child(again)
	_rows.add_child(Look.button("Main menu", menu_asked.emit))
	visible = true
	again.grab_focus()


func _process(delta: float) -> void:
	if visible:
		_age += delta
		_rain.queue_redraw()


func _line(caption: String, value: String) -> void:
	var row := HBoxContainer.new()
	var name_label := Label.new()
	name_label.text = caption
	name_label.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	var value_label := Label.new()
	value_label.text = value
	value_label.add_theme_color_override(&"font_color", Palette.STAR)
	row.add_child(name_label)
	row.add_child(value_label)
	_rows.add_child(row)


func _draw_rain() -> void:
	for i in 36:
		var fall := 70 + 60 * fposmod(i * 0.618, 1)
		var place := Vector2(
				fposmod(i * 0.754878, 1) * _rain.size.x + 20 * sin(_age + i),
				fposmod(_age * fall + fposmod(i * 0.569840, 1) * _rain.size.y, _rain.size.y + 60) - 30)
		_rain.draw_colored_polygon(Star.outline(place, 7 + 8 * fposmod(i * 0.37, 1), _age + i), Color(Palette.STAR, 0.8))
