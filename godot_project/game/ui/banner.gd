# SPDX-License-Identifier: MIT
extends Control
## The name of the game; its letters wobble.

const Palette := preload("res://game/palette.gd")
const NAME := "Moonjelly"
const FONT_SIZE := 104

var _age := 0.0


func _process(delta: float) -> void:
	_age += delta
	queue_redraw()


func _draw() -> void:
	var font := ThemeDB.fallback_font
	for layer in 2:
		var x := 6.0
		for i in NAME.length():
			var letter := NAME[i]
			var wave := sin(_age * 2.2 - i * 0.6)
			var place := Vector2(x, 112 + 5 * wave)
			draw_set_transform(place, 0.035 * sin(_age * 1.7 - i * 0.8), Vector2(1 - 0.03 * wave, 1 + 0.05 * wave))
			if layer == 0:
				draw_string_outline(font, Vector2.ZERO, letter, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE, 26, Palette.JELLY_DARK)
			else:
				var color := Palette.MOON if i < 4 else Palette.JELLY
				draw_string(font, Vector2.ZERO, letter, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE, color)
			x += font.get_string_size(letter, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE).x
	draw_set_transform(Vector2.ZERO)
	draw_string_outline(font, Vector2(10, 158), "A small jelly rolls home", HORIZONTAL_ALIGNMENT_LEFT, -1, 24, 8,
			Color(Palette.INK, 0.7))
	draw_string(font, Vector2(10, 158), "A small jelly rolls home", HORIZONTAL_ALIGNMENT_LEFT, -1, 24, Palette.TEXT)
