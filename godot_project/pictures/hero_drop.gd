# SPDX-License-Identifier: MIT
extends "res://pictures/hero.gd"
## A water balloon, a block of jelly and a ball of slime fall on a floor.


func _build() -> void:
	add_floor()
	add_eyes(add_body("water_balloon", SoftBody2D.make_circle_polygon(62, 28), Vector2(-185, -270)))
	add_eyes(add_body("jelly", make_block(Vector2(115, 115)), Vector2(0, -340), Color("ff6b8b")))
	add_eyes(add_body("slime", SoftBody2D.make_circle_polygon(58, 28), Vector2(185, -410)))
