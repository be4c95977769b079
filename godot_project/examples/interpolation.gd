# SPDX-License-Identifier: MIT
extends Node2D
## Slows physics down to ten ticks a second, and draws where the last tick has put the body.

const TICKS_PER_SECOND := 10

var _ticks_before := 60

@onready var _body: SoftBody2D = $Body
@onready var _status: Label = %Status


func _enter_tree() -> void:
	_ticks_before = Engine.physics_ticks_per_second
	Engine.physics_ticks_per_second = TICKS_PER_SECOND


func _exit_tree() -> void:
	Engine.physics_ticks_per_second = _ticks_before


func _physics_process(_delta: float) -> void:
	if absf(_body.linear_velocity.x) < 60:
		_body.apply_central_impulse(Vector2(-300 * signf(_body.global_position.x - 640), -420))


func _process(_delta: float) -> void:
	_status.text = "%d ticks and %d pictures a second" % [TICKS_PER_SECOND, roundi(Engine.get_frames_per_second())]
	queue_redraw()


func _draw() -> void:
	var outline := _body.get_interpolated_polygon(1)
	outline.append(outline[0])
	draw_polyline(outline, Color(1, 1, 1, 0.75), 2, true)
