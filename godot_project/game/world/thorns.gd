# SPDX-License-Identifier: MIT
@tool
extends Area2D
## Thorns: an area that sends the player back. Their tips point up; turn the node for walls and ceilings.

signal touched

const Palette := preload("res://game/palette.gd")
const SPACING := 22.0
const HEIGHT := 30.0

## How long the row is, in pixels; the node stands in the middle of its foot.
@export_range(22, 2000, 22, "or_greater") var length := 220.0:
	set(value):
		length = value
		queue_redraw()


func _ready() -> void:
	if Engine.is_editor_hint():
		return
	collision_layer = 0
	collision_mask = 2
	var shape := CollisionShape2D.new()
	var box := RectangleShape2D.new()
	box.size = Vector2(length - 12, HEIGHT - 14) # fair: tips may graze the skin
	shape.shape = box
	shape.position = Vector2(0, -box.size.y / 2)
	add_child(shape)
	body_entered.connect(func(_body: Node2D) -> void: touched.emit())


func _draw() -> void:
	var count := maxi(int(length / SPACING), 1)
	for row: float in [0.0, 1.0]:
		for i in count - int(row):
			var foot := Vector2(-length / 2 + (i + 0.5 + row / 2) * length / count, 5)
			var tall := HEIGHT * (0.75 + 0.25 * sin(i * 2.4 + row)) * (1.0 if row == 0 else 0.7)
			var half := SPACING * 0.46
			var tip := foot + Vector2(3 * sin(i * 1.3), -tall - 5)
			var color := Palette.THORN_DARK if row == 0 else Palette.THORN.darkened(0.25)
			draw_colored_polygon(PackedVector2Array([foot + Vector2(-half, 0), tip, foot + Vector2(half, 0)]), color)
			draw_colored_polygon(PackedVector2Array([
				foot + Vector2(-half * 0.7, 0), tip + Vector2(-1, 3), foot + Vector2(half * 0.1, 0),
			]), Palette.THORN)
			draw_polyline(PackedVector2Array([foot + Vector2(-half, 0), tip, foot + Vector2(half, 0)]),
					Palette.THORN.lightened(0.25), 1.5, true)
