# SPDX-License-Identifier: MIT
extends CanvasLayer
## What one wants to know while playing: stars, time, and the name of the level as it begins.

const Palette := preload("res://game/palette.gd")
const Star := preload("res://game/world/star.gd")

var _canvas := Control.new()
var _title := Label.new()
var _stars := 0
var _possible := 0
var _time := 0.0
var _bump := 0.0


func _ready() -> void:
	_canvas.set_anchors_preset(Control.PRESET_FULL_RECT)
	_canvas.mouse_filter = Control.MOUSE_FILTER_IGNORE
	_canvas.draw.connect(_draw_state)
	add_child(_canvas)
	_title.set_anchors_and_offsets_preset(Control.PRESET_TOP_WIDE)
	_title.position.y = 130
	_title.horizontal_alignment = HORIZONTAL_ALIGNMENT_CENTER
	_title.mouse_filter = Control.MOUSE_FILTER_IGNORE
	_title.add_theme_font_size_override(&"font_size", 46)
	_title.add_theme_color_override(&"font_color", Palette.TEXT)
	_title.add_theme_color_override(&"font_outline_color", Palette.INK)
	_title.add_theme_constant_override(&"outline_size", 12)
	_title.modulate.a = 0
	add_child(_title)


func show_state(stars: int, possible: int, time: float) -> void:
	if stars > _stars:
		_bump = 1
	_stars = stars
	_possible = possible
	_time = time
	_canvas.queue_redraw()


func announce(text: String) -> void:
	_title.text = text
	var fade := create_tween()
	fade.tween_property(_title, ^"modulate:a", 1.0, 0.5).set_delay(0.4)
	fade.tween_interval(1.6)
	fade.tween_property(_title, ^"modulate:a", 0.0, 0.8)


static func clock(time: float) -> String:
	return "%d:%04.1f" % [int(time / 60), fmod(time, 60)]


func _process(delta: float) -> void:
	_bump = move_toward(_bump, 0, 3 * delta)


func _draw_state() -> void:
	var font := ThemeDB.fallback_font
	var icon := Vector2(46, 44)
	_canvas.draw_colored_polygon(Star.outline(icon, 22 + 8 * _bump, -PI / 2), Palette.STAR_DARK)
	_canvas.draw_colored_polygon(Star.outline(icon, 18 + 8 * _bump, -PI / 2), Palette.STAR)
	_words(font, Vector2(78, 55), "%d / %d" % [_stars, _possible], HORIZONTAL_ALIGNMENT_LEFT)
	_words(font, Vector2(_canvas.size.x - 240, 55), clock(_time), HORIZONTAL_ALIGNMENT_RIGHT)


func _words(font: Font, place: Vector2, text: String, align: HorizontalAlignment) -> void:
	_canvas.draw_string_outline(font, place, text, align, 210, 30, 8, Color(Palette.INK, 0.8))
	_canvas.draw_string(font, place, text, align, 210, 30, Palette.TEXT)
