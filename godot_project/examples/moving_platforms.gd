# SPDX-License-Identifier: MIT
extends Node2D
## Moves bodies of the engine, on which soft ones ride.

var _age := 0.0

@onready var _lift: AnimatableBody2D = %Lift
@onready var _cross: AnimatableBody2D = %Cross
@onready var _ram: AnimatableBody2D = %Ram


func _physics_process(delta: float) -> void:
	_age += delta
	_lift.position.y = 440 + 130 * cos(0.9 * _age)
	_cross.rotation += 0.7 * delta
	_ram.position.x = 1230 - 80 * (1 - cos(1.4 * _age))
