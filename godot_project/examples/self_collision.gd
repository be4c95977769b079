# SPDX-License-Identifier: MIT
extends Node2D
## Moves the press down and up.

const HIGH := 380.0
const LOW := 545.0
const PERIOD := 5.0 # s

var _age := 0.0

@onready var _press: AnimatableBody2D = %Press


func _physics_process(delta: float) -> void:
	_age += delta
	_press.position.y = lerpf(HIGH, LOW, 0.5 - 0.5 * cos(TAU * _age / PERIOD))
