# SPDX-License-Identifier: MIT
extends RigidBody2D
## A wooden crate to push about. Soft bodies push a [RigidBody2D] and are pushed by it, each by the other's mass.

const WOOD := Color("b98a5a")
const WOOD_DARK := Color("6d4630")
const SIZE := Vector2(52, 52)


func _draw() -> void:
	draw_rect(Rect2(-SIZE / 2, SIZE), WOOD_DARK)
	draw_rect(Rect2(-SIZE / 2, SIZE).grow(-4), WOOD)
	for i in 2:
		var y := -SIZE.y / 6 + i * SIZE.y / 3
		draw_line(Vector2(-SIZE.x / 2 + 4, y), Vector2(SIZE.x / 2 - 4, y), WOOD.darkened(0.25), 2)
	for side: float in [-1.0, 1.0]:
		draw_line(Vector2(-SIZE.x / 2 + 6, side * (SIZE.y / 2 - 6)), Vector2(SIZE.x / 2 - 6, -side * (SIZE.y / 2 - 6)),
				WOOD_DARK, 5, true)
	draw_rect(Rect2(-SIZE / 2, SIZE).grow(-5), WOOD_DARK, false, 3)
