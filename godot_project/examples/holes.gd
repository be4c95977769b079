# SPDX-License-Identifier: MIT
extends Node2D
## Says above each body how much of its outline is left, and what it weighs.

@onready var _bodies: Array[SoftBody2D] = [%Ring, %Tyre, %Frame, %Cheese]


func _ready() -> void:
	for body in _bodies:
		var whole := 0.0
		for i in body.polygon.size():
			whole += body.polygon[i].cross(body.polygon[(i + 1) % body.polygon.size()]) / 2
		(body.get_node(^"Tag") as Node2D).set(&"text", "%d %% left, %.2f kg" % [roundi(100 * body.get_rest_area() / absf(whole)), body.mass])
