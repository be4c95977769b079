# SPDX-License-Identifier: MIT
extends "load.gd"
## SoftBody2D nodes of the kind a scene has dozens of: a circle of 16 points with the values that the node starts with.

## Properties that differ from the node's defaults.
static var properties := {}


func _add_body(place: Vector2) -> void:
	var body := SoftBody2D.new()
	body.position = place
	for property: String in properties:
		body.set(property, properties[property])
	root.add_child(body)
