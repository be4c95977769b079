# SPDX-License-Identifier: MIT
extends Node2D
## Child of a [SoftBody2D]: a pair of eyes that ride along and look at the mouse.
##
## No code moves them: the node of a soft body follows its motion, and children follow their parent.

const WHITE_RADIUS := 12.0
const PUPIL_RADIUS := 5.5
## How far a pupil moves from the middle of its eye.
const PUPIL_TRAVEL := 5.0

## Half the distance between the eyes, in pixels.
@export var half_gap := 16.0


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	for side: float in [-1.0, 1.0]:
		var center := Vector2(side * half_gap, 0)
		var look := (get_local_mouse_position() - center) / 20
		_draw_disc(center, WHITE_RADIUS, Color.WHITE)
		_draw_disc(center + look.limit_length(PUPIL_TRAVEL), PUPIL_RADIUS, Color("20243f"))


## A disc with a smooth rim.
func _draw_disc(center: Vector2, radius: float, color: Color) -> void:
	draw_circle(center, radius - 0.5, color)
	draw_arc(center, radius - 0.75, 0, TAU, 48, color, 1.5, true)
