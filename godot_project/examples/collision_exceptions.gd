# SPDX-License-Identifier: MIT
extends Node2D
## Makes exceptions between all bodies of one color.


func _ready() -> void:
	var bodies := find_children("*", "SoftBody2D")
	for i in bodies.size():
		for k in range(i + 1, bodies.size()):
			var one := bodies[i] as SoftBody2D
			if one.color == (bodies[k] as SoftBody2D).color:
				one.add_collision_exception_with(bodies[k])
