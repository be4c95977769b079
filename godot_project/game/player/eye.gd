# SPDX-License-Identifier: MIT
extends Node2D
## One eye. A [SoftBodyAttachment2D] carries it on the flesh; this only draws it and lets it look around and blink.

const Palette := preload("res://game/palette.gd")

## Where it looks, each component from -1 to 1.
var look := Vector2.ZERO
## 1 is open, 0 closed.
var lid := 1.0
var radius := 11.0


func _draw() -> void:
	if lid < 0.15:
		draw_line(Vector2(-radius * 0.8, 0), Vector2(radius * 0.8, 0), Palette.JELLY_DARK, 3, true)
		return
	draw_set_transform(Vector2.ZERO, 0, Vector2(1, lid))
	_disc(Vector2.ZERO, radius, Palette.JELLY_DARK)
	_disc(Vector2.ZERO, radius - 1.8, Color.WHITE)
	var pupil := look.limit_length(1) * radius * 0.38
	_disc(pupil, radius * 0.52, Palette.INK)
	_disc(pupil + Vector2(-0.2, -0.2) * radius, radius * 0.18, Color.WHITE)


func _disc(center: Vector2, size: float, color: Color) -> void:
	draw_circle(center, size, color, true, -1, true)
