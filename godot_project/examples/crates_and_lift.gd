# SPDX-License-Identifier: MIT
extends Node2D
## A lift goes up and down.

const LIFT_TOP := 330.0
const LIFT_BOTTOM := 590.0
## For the way up and down [s].
const LIFT_PERIOD := 6.0

@onready var _lift: AnimatableBody2D = $Lift

var _time := 0.0


func _physics_process(delta: float) -> void:
	_time += delta
	var phase := 0.5 + 0.5 * cos(TAU * _time / LIFT_PERIOD)
	_lift.position.y = lerpf(LIFT_TOP, LIFT_BOTTOM, phase)
