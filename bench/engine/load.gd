# SPDX-License-Identifier: MIT
extends RefCounted
## What stands in the scene whose cost is measured: `count` bodies above a floor, in columns ten high.
##
## Made anew for each count. Sleep is off, so that every counted body is simulated.

const RADIUS := 50.0
const POINTS := 16
const SPACING := 104.0
const ROWS := 10

var root: Node2D


func _init(parent: Node, count: int) -> void:
	root = Node2D.new()
	var width := ceilf(count / float(ROWS)) * SPACING
	root.add_child(_make_box(Vector2(width / 2, 50), Vector2(width + 2000, 100)))
	root.add_child(_make_box(Vector2(-50, -1000), Vector2(40, 4000)))
	root.add_child(_make_box(Vector2(width + 50, -1000), Vector2(40, 4000)))
	for i in count:
		@warning_ignore("integer_division")
		var column := i / ROWS
		var row := i % ROWS
		# Every other row stands half a body to the side, as in a heap.
		var place := Vector2((column + 0.25 + 0.5 * (row % 2)) * SPACING, -RADIUS - 2 - row * SPACING * 0.95)
		_add_body(place)
	parent.add_child(root)


func remove() -> void:
	root.free()


## Adds one body; what that is, is the difference between the loads.
func _add_body(_place: Vector2) -> void:
	pass


func _make_box(center: Vector2, size: Vector2) -> StaticBody2D:
	var body := StaticBody2D.new()
	var shape := CollisionShape2D.new()
	var rectangle := RectangleShape2D.new()
	rectangle.size = size
	shape.shape = rectangle
	body.position = center
	body.add_child(shape)
	return body
