# SPDX-License-Identifier: MIT
@tool
extends Node2D
## Words in the air that tell what to press: `[game_jump]` in the text becomes a key cap of the device in use.

const Palette := preload("res://game/palette.gd")
const Glyphs := preload("res://game/glyphs.gd")
const FONT_SIZE := 22
const LINE_HEIGHT := 44.0
const CAP_PADDING := 12.0

@export_multiline var text := "":
	set(value):
		text = value
		queue_redraw()

var _cap := StyleBoxFlat.new()
var _device := -1


func _ready() -> void:
	_cap.bg_color = Palette.TEXT
	_cap.border_color = Palette.TEXT_SOFT
	_cap.border_width_bottom = 4
	_cap.set_corner_radius_all(7)


func _process(_delta: float) -> void:
	if _device != Glyphs.device:
		_device = Glyphs.device
		queue_redraw()


func _draw() -> void:
	var font := ThemeDB.fallback_font
	var lines := text.split("\n")
	for row in lines.size():
		var parts := _parts_of(lines[row])
		var width := 0.0
		for part in parts:
			width += _width_of(part, font)
		var at := Vector2(-width / 2, row * LINE_HEIGHT)
		for part in parts:
			var wide := _width_of(part, font)
			if part.begins_with("["):
				var box := Rect2(at.x + 3, at.y - FONT_SIZE - 3, wide - 6, FONT_SIZE + 15)
				draw_style_box(_cap, box)
				draw_string(font, at + Vector2(3 + CAP_PADDING, -1), _caption(part), HORIZONTAL_ALIGNMENT_LEFT, -1,
						FONT_SIZE, Palette.INK)
			else:
				draw_string_outline(font, at, part, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE, 7, Color(Palette.INK, 0.7))
				draw_string(font, at, part, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE, Palette.TEXT)
			at.x += wide


static func _parts_of(line: String) -> PackedStringArray:
	var parts := PackedStringArray()
	var rest := line
	while "[" in rest and "]" in rest:
		var open := rest.find("[")
		if open > 0:
			parts.append(rest.left(open))
		parts.append(rest.substr(open, rest.find("]") - open + 1))
		rest = rest.substr(rest.find("]") + 1)
	if rest != "":
		parts.append(rest)
	return parts


static func _caption(part: String) -> String:
	return Glyphs.text_of(StringName(part.trim_prefix("[").trim_suffix("]")))


func _width_of(part: String, font: Font) -> float:
	var shown := _caption(part) if part.begins_with("[") else part
	var width := font.get_string_size(shown, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE).x
	return width + (2 * CAP_PADDING + 6 if part.begins_with("[") else 0.0)
