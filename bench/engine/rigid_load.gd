# SPDX-License-Identifier: MIT
extends "res://load.gd"
## What one does without the node: a ring of 16 RigidBody2D and one in the middle, held by DampedSpringJoint2D.
##
## Mass, size, springs and their stiffness are those of the SoftBody2D beside it. The points are circles as large as their
## share of the ring, so that others do not pass between them.

const MASS := 1.0
const STIFFNESS := 100.0
const DAMPING := 0.12


func _add_body(place: Vector2) -> void:
	var ring := PI * RADIUS / POINTS
	var points: Array[RigidBody2D] = []
	for i in POINTS:
		points.append(_add_point(place + Vector2.from_angle(TAU * i / POINTS) * (RADIUS - ring), ring))
	var middle := _add_point(place, ring)
	for i in POINTS:
		_add_spring(points[i], points[(i + 1) % POINTS])
		_add_spring(points[i], middle)


func _add_point(place: Vector2, radius: float) -> RigidBody2D:
	var point := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	var circle := CircleShape2D.new()
	circle.radius = radius
	collision.shape = circle
	point.add_child(collision)
	point.position = place
	point.mass = MASS / (POINTS + 1)
	point.can_sleep = false
	root.add_child(point)
	return point


func _add_spring(a: RigidBody2D, b: RigidBody2D) -> void:
	var spring := DampedSpringJoint2D.new()
	spring.position = a.position
	spring.rotation = (b.position - a.position).angle() - PI / 2
	spring.length = a.position.distance_to(b.position)
	spring.rest_length = spring.length
	spring.stiffness = STIFFNESS
	spring.damping = DAMPING
	root.add_child(spring)
	spring.node_a = spring.get_path_to(a)
	spring.node_b = spring.get_path_to(b)
