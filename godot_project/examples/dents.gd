# SPDX-License-Identifier: MIT
extends Node2D
## Drops the same disc in four materials. What strains them beyond their yield_strain stays; then the dents grow out, as `dents` is animated.

const ROUND := 7.0 # s
const GROW_OUT := 5.0 # s, when dents begin to go

var _bodies: Array[SoftBody2D] = []
var _starts: Array[Vector2] = []
var _age := 0.0
var _mends := false


func _ready() -> void:
	for node in find_children("*", "SoftBody2D", true, false):
		var body := node as SoftBody2D
		_bodies.append(body)
		_starts.append(body.position)


func _physics_process(delta: float) -> void:
	_age += delta
	for body in _bodies:
		(body.get_node(^"Dent") as Label).text = "dent %.2f" % body.get_dent()
	if _age > GROW_OUT and not _mends:
		_mends = true
		for body in _bodies:
			if body.get_dent() > 0: # zeros for every point: the first shape
				var first := PackedVector2Array()
				first.resize(body.get_point_count())
				create_tween().tween_property(body, ^"dents", first, 1.5)
	if _age > ROUND:
		_age = 0
		_mends = false
		for i in _bodies.size():
			_bodies[i].reset_dents()
			_bodies[i].teleport(Transform2D(0, _starts[i]))
