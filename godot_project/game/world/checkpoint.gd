# SPDX-License-Identifier: MIT
extends Area2D
## A lantern flower. It opens when the player passes, and the player comes back to it from then on.

signal reached

const Palette := preload("res://game/palette.gd")
const GLOW := preload("res://game/world/glow.tres")
const HEIGHT := 74.0

var is_lit := false

var _age := 0.0
var _open := 0.0


func _ready() -> void:
	body_entered.connect(_on_body_entered)


func _process(delta: float) -> void:
	_age += delta
	_open = move_toward(_open, 1.0 if is_lit else 0.0, delta * 2.2)
	queue_redraw()


func _draw() -> void:
	var head := Vector2(5 * sin(_age * 1.3), -HEIGHT)
	var stem := PackedVector2Array()
	for i in 9:
		var t := i / 8.0
		stem.append(Vector2(head.x * t * t + 7 * sin(t * PI), -HEIGHT * t))
	draw_polyline(stem, Palette.GRASS.darkened(0.2), 6, true)
	draw_polyline(stem, Palette.GRASS, 3, true)
	for side: float in [-1.0, 1.0]:
		draw_colored_polygon(PackedVector2Array([
			Vector2(3 * side, -14), Vector2(20 * side, -34), Vector2(26 * side, -28), Vector2(16 * side, -12),
		]), Palette.GRASS)
	var glow := 46 * _open * (1 + 0.06 * sin(_age * 4))
	draw_texture_rect(GLOW, Rect2(head - Vector2(glow, glow), Vector2(glow, glow) * 2), false, Color(Palette.STAR, 0.7))
	var petal := Palette.TEXT_SOFT.lerp(Palette.STAR, _open)
	for i in 5:
		var angle := -PI / 2 + (i - 2) * lerpf(0.16, 0.62, _open)
		var tip := head + Vector2.from_angle(angle) * lerpf(21, 27, _open)
		var across := Vector2.from_angle(angle + PI / 2) * 7
		var mid := head + Vector2.from_angle(angle) * 13
		draw_colored_polygon(PackedVector2Array([head, mid - across, tip, mid + across]),
				petal.darkened(0.12 * (i % 2)))
	draw_circle(head, 7, Palette.STAR_DARK.lerp(Color.WHITE, _open))


func _on_body_entered(_body: Node2D) -> void:
	if not is_lit:
		is_lit = true
		reached.emit()
