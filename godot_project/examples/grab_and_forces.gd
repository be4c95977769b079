# SPDX-License-Identifier: MIT
extends Node2D
## Pushes soft bodies by forces, every physics tick, and by impulses, once.

const GRAVITY := 980.0
const KICK := 520.0 # kg·px/s

@onready var _fan: Polygon2D = %Fan
@onready var _floater: SoftBody2D = %Floater
@onready var _jumper: SoftBody2D = %Jumper


func _ready() -> void:
	(%KickTimer as Timer).timeout.connect(_kick)


func _physics_process(_delta: float) -> void:
	# The wind carries the weight and leads to its middle. A force acts for one tick, so it is given in each.
	var off := _fan.to_local(_floater.get_center_of_mass_position())
	if Geometry2D.is_point_in_polygon(off, _fan.polygon):
		var lift := Vector2(0, -GRAVITY) - 12 * off - 3 * _floater.get_linear_velocity()
		_floater.apply_central_force(_floater.mass * lift)


func _kick() -> void:
	_jumper.apply_central_impulse(Vector2(0, -KICK * 0.8))
	var corner := _jumper.get_nearest_point(_jumper.get_center_of_mass_position() + Vector2(-200, 200))
	_jumper.apply_point_impulse(corner, Vector2(0, -KICK * 0.12))
