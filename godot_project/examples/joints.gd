# SPDX-License-Identifier: MIT
extends Node2D
## Loads one joint until it breaks, and mends it; draws the joints.

const LOAD_GROWTH := 420.0 # kg px/s², each second
const MEND_AFTER := 2.0 # s

var _load := 0.0
var _broken_for := 0.0

@onready var _breaking: SoftBodyJoint2D = %Breaking
@onready var _hanging: SoftBody2D = %Hanging
@onready var _home := _hanging.global_transform
@onready var _status: Label = %Status


func _ready() -> void:
	_breaking.broken.connect(func() -> void: _load = 0)


func _physics_process(delta: float) -> void:
	if _breaking.is_broken():
		_broken_for += delta
		_status.text = "Broken"
		if _broken_for > MEND_AFTER:
			_broken_for = 0
			_hanging.teleport(_home)
			_hanging.reset()
			_breaking.mend()
	else:
		_load += LOAD_GROWTH * delta
		_hanging.apply_central_force(Vector2(0, _load))
		_status.text = "Pulled with %d of %d kg·px/s²" % [
			roundi(_load + 980 * _hanging.mass), roundi(_breaking.break_force)]
	queue_redraw()


func _draw() -> void:
	for node in find_children("*", "SoftBodyJoint2D"):
		var joint := node as SoftBodyJoint2D
		if not joint.is_broken():
			draw_line(joint.get_anchor_a(), joint.get_anchor_b(), Color(1, 1, 1, 0.6), 4)
			draw_circle(joint.get_anchor_a(), 6, Color.WHITE)
			draw_circle(joint.get_anchor_b(), 6, Color.WHITE)
