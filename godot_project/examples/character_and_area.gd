# SPDX-License-Identifier: MIT
extends Node2D
## The engine sees soft bodies: a character walks on them and pushes them, a ray finds them, an area lifts them.

const GRAVITY := 980.0
const SPEED := 140.0
const JUMP := 460.0

var _direction := 1.0

@onready var _walker: CharacterBody2D = %Walker
@onready var _ray: RayCast2D = %Ray
@onready var _beam: Line2D = %Beam
@onready var _report: Label = %Report
@onready var _lift: Area2D = %Lift


func _physics_process(delta: float) -> void:
	_walker.velocity.x = _direction * SPEED
	if not _walker.is_on_floor():
		_walker.velocity.y += GRAVITY * delta
	elif _walker.is_on_wall():
		# In front of a jelly it jumps, in front of a wall it turns round.
		var is_soft := false
		for i in _walker.get_slide_collision_count():
			is_soft = is_soft or _walker.get_slide_collision(i).get_collider() is SoftBody2D
		if is_soft:
			_walker.velocity.y = -JUMP
		else:
			_direction = -_direction
	_walker.move_and_slide()
	_show_ray()
	_report.text = "In the lift: %d" % _lift.get_overlapping_bodies().size()


func _show_ray() -> void:
	var end := _ray.target_position
	if _ray.is_colliding():
		end = _ray.to_local(_ray.get_collision_point())
	_beam.points = PackedVector2Array([Vector2.ZERO, end])
	_beam.default_color = Color("ff6b6b") if _ray.get_collider() is SoftBody2D else Color("8b93d6")
