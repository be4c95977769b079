# SPDX-License-Identifier: MIT
extends "res://pictures/hero.gd"
## A plate presses three bodies to less than half of their height, and lets them go.

const RADIUS := 48.0
const PLATE := Vector2(500, 40)
const DOWN := 0.4 # s at which the plate begins to come down
const CLOSING := 1.1 # s
const HOLDING := 0.5 # s
const OPENING := 0.12 # s
const PRESSED_TO := 0.45 # of the height

var _plate := AnimatableBody2D.new()


func _build() -> void:
	add_floor()
	_plate.set_script(SOLID)
	_plate.sync_to_physics = false
	SOLID.add_box(_plate, Rect2(-PLATE / 2, PLATE))
	_move()
	add_child(_plate)
	add_eyes(add_body("water_balloon", SoftBody2D.make_circle_polygon(RADIUS, 28), Vector2(-165, -RADIUS)), Vector2(0, -10), 0.85)
	add_eyes(add_body("jelly", make_block(Vector2.ONE * 2 * RADIUS), Vector2(0, -RADIUS), Color("ff6b8b")), Vector2(0, -10), 0.85)
	add_eyes(add_body("slime", SoftBody2D.make_circle_polygon(RADIUS, 28), Vector2(165, -RADIUS)), Vector2(0, -10), 0.85)


func _move() -> void:
	var pressed := smoothstep(DOWN, DOWN + CLOSING, age)
	var up := clampf((age - DOWN - CLOSING - HOLDING) / OPENING, 0, 1)
	_plate.position.y = -2 * RADIUS * lerpf(lerpf(1.75, PRESSED_TO, pressed), 1.75, up) - PLATE.y / 2
