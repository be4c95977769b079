# SPDX-License-Identifier: MIT
extends Node2D
## Shoots a rope from the ball to where the right mouse button is pressed, and lets go by the next press.

const LINK := 14.0 # px

var _rope: SoftRope2D
var _hold: SoftBodyJoint2D

@onready var _ball: SoftBody2D = %Ball
@onready var _tentacle: SoftRope2D = $Tentacle


# Two points of its centerline are held, so that it stands.
func _ready() -> void:
	_tentacle.set_point_pinned(_tentacle.get_center_point(1), true, NodePath())


func _unhandled_input(event: InputEvent) -> void:
	var click := event as InputEventMouseButton
	if click != null and click.pressed and click.button_index == MOUSE_BUTTON_RIGHT:
		if _rope == null:
			shoot(get_global_mouse_position())
		else:
			let_go()


func shoot(target: Vector2) -> void:
	var start := _ball.get_center_of_mass_position()
	var way := target - start
	_rope = SoftRope2D.new()
	_rope.position = start
	_rope.width = 6
	_rope.path = PackedVector2Array([Vector2.ZERO, way])
	_rope.link_count = maxi(2, roundi(way.length() / LINK))
	_rope.color = Color(0.9, 0.9, 0.85)
	_rope.pin_end = true
	add_child(_rope)
	_rope.add_collision_exception_with(_ball)
	_hold = SoftBodyJoint2D.new()
	_hold.position = start
	add_child(_hold)
	_hold.node_a = _hold.get_path_to(_rope)
	_hold.node_b = _hold.get_path_to(_ball)


func let_go() -> void:
	_hold.queue_free()
	_rope.queue_free()
	_rope = null
