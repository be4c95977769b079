# SPDX-License-Identifier: MIT
extends Node2D
## Lifts all bodies to where they began, again and again.

const PAUSE := 4.0

var _starts := {}
var _left := PAUSE


func _ready() -> void:
	for node in get_tree().get_nodes_in_group(&"soft_bodies"):
		if is_ancestor_of(node):
			_starts[node] = (node as SoftBody2D).global_transform
		var rope := node as SoftRope2D
		if rope != null: # two points of its centerline are held, so that it begins level
			rope.set_point_pinned(rope.get_center_point(1), true, NodePath())


func _physics_process(delta: float) -> void:
	_left -= delta
	if _left <= 0:
		_left = PAUSE
		for body: SoftBody2D in _starts:
			body.teleport(_starts[body])
			body.reset_dents()
			body.reset()
