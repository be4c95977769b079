# SPDX-License-Identifier: MIT
extends Node2D
## Moves the nodes that pinned points follow.

var _age := 0.0

@onready var _crane: Node2D = %Crane
@onready var _wheel: Node2D = %Wheel
@onready var _start := _crane.position


func _physics_process(delta: float) -> void:
	_age += delta
	_crane.position = _start + Vector2(150 * sin(0.9 * _age), 60 * sin(1.7 * _age))
	_wheel.rotation = 2.2 * sin(0.8 * _age)
	queue_redraw()


func _draw() -> void:
	draw_line(Vector2(_crane.position.x, 0), _crane.position, Color(1, 1, 1, 0.4), 3)
	for hook: Node2D in _crane.get_children():
		draw_line(_crane.position, _crane.transform * hook.position, Color(1, 1, 1, 0.7), 5)
	draw_circle(_wheel.position, 12, Color(1, 1, 1, 0.7))
