# SPDX-License-Identifier: MIT
extends Node2D
## Child of a [SoftBody2D]: a smooth dark rim along its polygon and a shine where the light falls on it.
##
## The engine interpolates the transform of a node, not the points inside it. This node therefore draws in
## global coordinates, with the polygon that the body itself interpolates between physics ticks.

## From where the light comes.
const LIGHT := Vector2(-0.5, -0.87)
## How directly the polygon must face the light to shine: cosine of the angle between them.
const SHINE_COSINE := 0.72

## Color of the rim; transparent for a darker shade of the body's color.
@export var rim_color := Color.TRANSPARENT
## Width of the rim in pixels.
@export var rim_width := 4.0
## Width of the shine in pixels, 0 for none.
@export var shine_width := 5.0
## How far inside the polygon the shine lies, in pixels.
@export var shine_depth := 11.0

@onready var _body: SoftBody2D = get_parent()


func _ready() -> void:
	top_level = true
	global_transform = Transform2D.IDENTITY
	physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	var polygon := _body.get_interpolated_polygon()
	if polygon.size() < 3:
		return
	var inward := _inward_normals(polygon)
	_draw_rim(polygon, inward)
	if shine_width > 0:
		_draw_shine(polygon, inward)


## The rim lies inside the polygon, so that its outer edge is where the body touches things.
func _draw_rim(polygon: PackedVector2Array, inward: PackedVector2Array) -> void:
	var rim := PackedVector2Array()
	for i in polygon.size() + 2: # one piece twice: it covers the notch where the line starts and ends
		var k := i % polygon.size()
		rim.append(polygon[k] + inward[k] * rim_width / 2)
	draw_polyline(rim, rim_color if rim_color.a > 0 else _body.color.darkened(0.4), rim_width, true)


func _draw_shine(polygon: PackedVector2Array, inward: PackedVector2Array) -> void:
	var first := 0
	while first < polygon.size() - 1 and -inward[first].dot(LIGHT) > SHINE_COSINE:
		first += 1
	var run := PackedVector2Array()
	for step in polygon.size() + 1:
		var i := (first + step) % polygon.size()
		if -inward[i].dot(LIGHT) > SHINE_COSINE:
			run.append(polygon[i] + inward[i] * shine_depth)
			continue
		if run.size() > 2:
			draw_polyline(run, Color(1, 1, 1, 0.5), shine_width, true)
		run.clear()


## For every polygon point the direction into the body.
static func _inward_normals(polygon: PackedVector2Array) -> PackedVector2Array:
	var side := 1.0 if _signed_area(polygon) > 0 else -1.0
	var normals := PackedVector2Array()
	for i in polygon.size():
		var along := (polygon[(i + 1) % polygon.size()] - polygon[i - 1]).normalized()
		normals.append(Vector2(-along.y, along.x) * side)
	return normals


static func _signed_area(polygon: PackedVector2Array) -> float:
	var doubled := 0.0
	for i in polygon.size():
		doubled += polygon[i - 1].cross(polygon[i])
	return doubled / 2
