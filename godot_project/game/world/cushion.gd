# SPDX-License-Identifier: MIT
extends SoftBody2D
## A mushroom cap to bounce on: a soft dome whose foot is pinned. It gives back what falls on it, and a little more.

signal bounced

const Palette := preload("res://game/palette.gd")

## Least upward speed with which it throws the player, in px/s; 0 for a cushion that only softens.
@export_range(0, 2000, 10) var throw_speed := 900.0

var _rest := 0.0


func _ready() -> void:
	# Contact signals name the bodies that have come, see contact_monitor.
	contact_started.connect(_on_contact_started)


func _physics_process(delta: float) -> void:
	_rest = maxf(_rest - delta, 0)


func _on_contact_started(body: Node, _point: Vector2, normal: Vector2, _impulse: float) -> void:
	var guest := body as SoftBody2D
	if guest == null or throw_speed <= 0 or _rest > 0 or normal.y < 0.3:
		return
	_rest = 0.3
	bounced.emit()
	# It is pressed in for a moment before it throws.
	await get_tree().create_timer(0.07, true, true).timeout
	if is_instance_valid(guest) and guest.is_inside_tree():
		var missing := -throw_speed - guest.linear_velocity.y
		guest.apply_central_impulse(Vector2(0, minf(missing, 0) * guest.get_total_mass()))
