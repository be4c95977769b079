# SPDX-License-Identifier: MIT
extends Node2D
## Lets the mouse pull soft bodies: the left button grabs the nearest one by a patch of its polygon, at the rim
## by a few points, in the middle by all around.
##
## A spring pulls the patch towards the mouse. Its strength is stated as a frequency and multiplied by the
## mass, so that a light body and a heavy one follow alike. The force is held during a whole physics tick;
## on one light point that would overshoot, on a patch it does not. For the same reason the brake acts on
## the whole body.

## How eagerly the body follows [rad/s]. Under gravity it hangs 980 / frequency² pixels below the mouse.
@export_range(1, 30, 0.1, "or_greater") var frequency := 13.0
## Brake on the body's motion while it is held; 1 follows without swinging.
@export_range(0, 2, 0.01, "or_greater") var damping_ratio := 0.6
## Polygon points that are farther from the mouse than the nearest one by no more than this are pulled, in pixels.
@export var patch_depth := 26.0
## A click this far outside a body still grabs it, in pixels.
@export var reach := 24.0
## The pull grows no further past this distance, in pixels.
@export var longest_pull := 80.0

## Where the grabbed body is pulled, in global coordinates; follows the mouse.
var target := Vector2.ZERO

var _body: SoftBody2D
var _points := PackedInt32Array()


func _ready() -> void:
	z_index = 10
	process_physics_priority = -1


func _unhandled_input(event: InputEvent) -> void:
	var mouse := make_input_local(event) as InputEventMouse
	if mouse == null:
		return
	var place := to_global(mouse.position)
	var button := mouse as InputEventMouseButton
	if button == null:
		target = place
	elif button.button_index == MOUSE_BUTTON_LEFT:
		if button.pressed:
			grab(place)
		else:
			release()


## Takes hold of the body at `place`, or of the nearest one within reach. False when there is none.
func grab(place: Vector2) -> bool:
	release()
	var nearest := reach
	for node in get_tree().get_nodes_in_group(&"soft_bodies"):
		var body := node as SoftBody2D
		var at := body.get_point_positions()[body.get_nearest_point(place)]
		var distance := 0.0 if body.has_point(place) else at.distance_to(place)
		if distance < nearest:
			nearest = distance
			_body = body
	if _body == null:
		return false
	# The polygon only: points inside touch nothing, and could be pulled through a wall.
	var polygon := _body.get_point_positions().slice(0, _body.get_simulated_polygon().size())
	var first := INF
	for point in polygon:
		first = minf(first, point.distance_to(place))
	for i in polygon.size():
		if polygon[i].distance_to(place) <= first + patch_depth:
			_points.append(i)
	target = place
	return true


func release() -> void:
	_body = null
	_points.clear()
	queue_redraw()


func _physics_process(_delta: float) -> void:
	if not is_instance_valid(_body) or not _body.is_inside_tree():
		release()
		return
	var center := _patch_center()
	var pull := (_reachable(center) - center).limit_length(longest_pull) * (_body.mass * frequency * frequency)
	for i in _points:
		_body.apply_point_force(i, pull / _points.size())
	_body.apply_central_force(_body.get_linear_velocity() * (-2 * damping_ratio * frequency * _body.mass))


func _process(_delta: float) -> void:
	if _body != null:
		queue_redraw()


func _draw() -> void:
	if not is_instance_valid(_body):
		return
	var from := _patch_center()
	draw_line(from, target, Color(1, 1, 1, 0.85), 2.5, true)
	draw_circle(from, 5, Color.WHITE)
	draw_circle(target, 7, Color("ffd166"))


## The target, or the place before the solid that lies in between: pulled on, the body would be crushed.
func _reachable(from: Vector2) -> Vector2:
	var ray := PhysicsRayQueryParameters2D.create(from, target, _body.collision_mask)
	var hit := get_world_2d().direct_space_state.intersect_ray(ray)
	return target if hit.is_empty() else hit["position"] as Vector2


func _patch_center() -> Vector2:
	var positions := _body.get_point_positions()
	var sum := Vector2.ZERO
	for i in _points:
		sum += positions[i]
	return sum / _points.size()
