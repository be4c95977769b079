# SPDX-License-Identifier: MIT
extends "res://load.gd"
## SoftBody2D as it comes out of the node list: a circle of 16 points.

## Values of properties that differ from the node's own.
static var properties := {}


func _add_body(place: Vector2) -> void:
	var body := SoftBody2D.new()
	body.position = place
	for property: String in properties:
		assert(property in body)
		body.set(property, properties[property])
	root.add_child(body)
