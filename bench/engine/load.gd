# SPDX-License-Identifier: MIT
extends RefCounted
## What stands in the scene whose cost is measured: `count` bodies between walls on a floor, four high.

const RADIUS := 50.0
const POINTS := 16
const ROWS := 4
## Between columns and rows [px]: bodies just do not touch at first, and lean on one another once they have fallen.
const SPACING := 104.0

var root := Node2D.new()
## The middle of the pile and its size [px].
var extent: Rect2


func _init(parent: Node, count: int) -> void:
	var columns := ceilf(count / float(ROWS))
	var width := (columns + 1) * SPACING
	extent = Rect2(-SPACING, -(ROWS + 1) * SPACING, width + 2 * SPACING, (ROWS + 2) * SPACING)
	_add_box(Vector2(width / 2, 100), Vector2(width + 2000, 200))
	_add_box(Vector2(-100, -2000), Vector2(200, 4000))
	_add_box(Vector2(width + 100, -2000), Vector2(200, 4000))
	for i in count:
		var row := i % ROWS
		var column := floorf(i / float(ROWS))
		# Every other row stands half a body to the side, as in a heap.
		_add_body(Vector2((column + 0.5 + 0.5 * (row % 2)) * SPACING, -RADIUS - 2 - row * SPACING))
	parent.add_child(root)


func remove() -> void:
	root.free()


## Adds one body; what that is, is the difference between the loads.
func _add_body(_place: Vector2) -> void:
	pass


func _add_box(center: Vector2, size: Vector2) -> void:
	var body := StaticBody2D.new()
	var collision := CollisionShape2D.new()
	var rectangle := RectangleShape2D.new()
	rectangle.size = size
	collision.shape = rectangle
	body.position = center
	body.add_child(collision)
	body.collision_layer = 3
	root.add_child(body)
