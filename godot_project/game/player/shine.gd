# SPDX-License-Identifier: MIT
extends Node2D
## The light of the moon on a jelly: drawn along the polygon as it is drawn in this very frame, see
## [method SoftBody2D.get_interpolated_polygon].

const LIGHT := Vector2(-0.55, -0.83)

## How directly the skin must face the light: cosine of the angle between them.
@export var cosine := 0.7
@export var width := 5.0
## How far inside the polygon it lies, in pixels.
@export var depth := 9.0
@export var color := Color(1, 1, 1, 0.7)

@onready var _body: SoftBody2D = get_parent()


func _ready() -> void:
	top_level = true
	z_index = _body.z_index # beyond the tree of its parent it would lie behind
	global_transform = Transform2D.IDENTITY
	physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF
	add_to_group(&"quality")


func apply_quality(quality: int) -> void:
	visible = quality > 0
	set_process(visible)


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	var polygon := _body.get_interpolated_polygon()
	var count := polygon.size()
	if count < 3 or not _body.is_visible_in_tree():
		return
	var run := PackedVector2Array()
	var runs: Array[PackedVector2Array] = []
	var first := 0
	while first < count and _outward(polygon, first).dot(LIGHT) > cosine:
		first += 1
	for step in count + 1:
		var i := (first + step) % count
		var outward := _outward(polygon, i)
		if outward.dot(LIGHT) > cosine:
			run.append(polygon[i] - outward * depth)
		elif not run.is_empty():
			runs.append(run)
			run = PackedVector2Array()
	for line in runs:
		if line.size() > 1:
			draw_polyline(line, color, width, true)
			draw_circle(line[0], width / 2, color, true, -1, true)
			draw_circle(line[-1], width / 2, color, true, -1, true)
		var past := line[0] + (line[0] - line[-1]).limit_length(9)
		draw_circle(past.lerp(_body.get_interpolated_transform().origin, 0.06), width * 0.42, color, true, -1, true)


## Polygons of the game run clockwise on the screen, so outward is to the left of the way along.
static func _outward(polygon: PackedVector2Array, i: int) -> Vector2:
	return (polygon[(i + 1) % polygon.size()] - polygon[i - 1]).normalized().orthogonal()
