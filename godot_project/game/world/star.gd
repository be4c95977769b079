# SPDX-License-Identifier: MIT
extends Area2D
## A fallen star to collect. The engine shows soft bodies to areas, so [signal Area2D.body_entered] is all it needs.

signal taken

const Palette := preload("res://game/palette.gd")
const GLOW := preload("res://game/world/glow.tres")
const RADIUS := 17.0

var _age := 0.0
var _is_taken := false


func _ready() -> void:
	_age = global_position.x * 0.01 # neighbors do not bob in step
	body_entered.connect(_on_body_entered)


func _process(delta: float) -> void:
	_age += delta
	queue_redraw()


func _draw() -> void:
	var lift := Vector2(0, 4 * sin(_age * 2.4))
	var glow := RADIUS * (3.2 + 0.35 * sin(_age * 3.1))
	draw_texture_rect(GLOW, Rect2(lift - Vector2(glow, glow), Vector2(glow, glow) * 2), false, Color(Palette.STAR, 0.4))
	var turn := 0.18 * sin(_age * 1.7) - PI / 2
	draw_colored_polygon(outline(lift, RADIUS + 3, turn), Palette.STAR_DARK)
	draw_colored_polygon(outline(lift, RADIUS, turn), Palette.STAR)
	draw_colored_polygon(outline(lift + Vector2(-2, -3), RADIUS * 0.5, turn), Color(1, 1, 1, 0.75))


func _on_body_entered(_body: Node2D) -> void:
	if _is_taken:
		return
	_is_taken = true
	taken.emit()
	set_deferred(&"monitoring", false)
	var flight := create_tween().set_parallel()
	flight.tween_property(self, ^"position:y", position.y - 60, 0.45).set_trans(Tween.TRANS_BACK).set_ease(Tween.EASE_OUT)
	flight.tween_property(self, ^"scale", Vector2(1.7, 1.7), 0.45)
	flight.tween_property(self, ^"modulate:a", 0.0, 0.45)
	flight.chain().tween_callback(queue_free)


## Five points, rounded by a corner beside each tip.
static func outline(center: Vector2, radius: float, turn: float) -> PackedVector2Array:
	var points := PackedVector2Array()
	for i in 5:
		var angle := turn + TAU * i / 5
		for side: float in [-0.16, 0.0, 0.16]:
			points.append(center + Vector2.from_angle(angle + side) * radius * (1 - 0.6 * absf(side)))
		points.append(center + Vector2.from_angle(angle + PI / 5) * radius * 0.58)
	return points
