# SPDX-License-Identifier: MIT
extends Camera2D
## Follows a soft body smoothly and looks ahead to where it goes.
##
## It asks where the body is drawn in this frame ([method SoftBody2D.get_interpolated_transform]), so that neither
## trembles beside the other.

const LOOK_AHEAD := 150.0
const LOOK_RATE := 1.6 # how fast the look ahead swings over [1/s]
const FOLLOW_RATE := Vector2(6.5, 4.5)
const SHAKE_FADE := 6.0

var body: SoftBody2D

var _ahead := Vector2.ZERO
var _place := Vector2.ZERO
var _shake := 0.0


func _ready() -> void:
	physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF
	process_callback = Camera2D.CAMERA2D_PROCESS_IDLE


func set_bounds(bounds: Rect2) -> void:
	limit_left = int(bounds.position.x)
	limit_top = int(bounds.position.y)
	limit_right = int(bounds.end.x)
	limit_bottom = int(bounds.end.y)


func snap() -> void:
	_ahead = Vector2.ZERO
	_place = body.get_interpolated_transform().origin
	position = _place
	reset_smoothing()


func shake(strength: float) -> void:
	_shake = maxf(_shake, strength)


func _process(delta: float) -> void:
	if body == null:
		return
	var speed := body.linear_velocity / 360
	var wanted := Vector2(clampf(speed.x, -1, 1) * LOOK_AHEAD, clampf(speed.y, -0.6, 1.5) * 60 - 40)
	_ahead = _ahead.lerp(wanted, 1 - exp(-LOOK_RATE * delta))
	var target := body.get_interpolated_transform().origin + _ahead
	_place.x = lerpf(_place.x, target.x, 1 - exp(-FOLLOW_RATE.x * delta))
	_place.y = lerpf(_place.y, target.y, 1 - exp(-FOLLOW_RATE.y * delta))
	position = _place
	_shake = move_toward(_shake, 0, SHAKE_FADE * delta * maxf(_shake, 0.5))
	offset = Vector2(randf_range(-1, 1), randf_range(-1, 1)) * _shake
