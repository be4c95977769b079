# SPDX-License-Identifier: MIT
extends SoftBody2D
## One of the many in a pit of balls. Nothing looks for it, so the engine is not shown it
## ([member SoftBody2D.collision_proxy_enabled] is off): cheap enough for dozens.

const TINTS: Array[Color] = [Color("ff9fb2"), Color("ffd36b"), Color("9fd8ff"), Color("c7a6ff"), Color("a8f0b8")]
const RADIUS := 24.0
const FIRMNESS := 1100.0 # stiffness times polygon points: what decides how firm it is
## Polygon points for each quality.
const POINTS: Array[int] = [8, 10, 14]


func _ready() -> void:
	color = TINTS[int(get_index() * 1.2) % TINTS.size()] # rows that do not repeat the color of the one below
	add_to_group(&"quality")


func apply_quality(quality: int) -> void:
	if polygon.size() != POINTS[quality]:
		polygon = SoftBody2D.make_circle_polygon(RADIUS, POINTS[quality])
		stiffness = FIRMNESS / POINTS[quality]
