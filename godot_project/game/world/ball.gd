# SPDX-License-Identifier: MIT
extends SoftBody2D
## One of the many in a pit of balls. Nothing looks for it, so the engine is not shown it
## ([member SoftBody2D.collision_proxy_enabled] is off): cheap enough for dozens.

const TINTS: Array[Color] = [Color("ff9fb2"), Color("ffd36b"), Color("9fd8ff"), Color("c7a6ff"), Color("a8f0b8")]


func _ready() -> void:
	color = TINTS[get_index() % TINTS.size()]
