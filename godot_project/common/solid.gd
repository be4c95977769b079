# SPDX-License-Identifier: MIT
@tool
extends StaticBody2D
## A static body that draws exactly what it collides with: its shapes are the only source of its looks.

const EDGE_WIDTH := 3.0
## Width of the line that smooths the rim of a filled area.
const RIM_WIDTH := 1.5
## Corners of a half circle.
const ARC_POINTS := 24
## How far a world boundary, which has no end, is drawn.
const BOUNDARY_REACH := 3000.0

## Color of the inside.
@export var fill := Color("3b4072"):
	set(value):
		fill = value
		queue_redraw()
## Color of the edge. It is drawn inside the shape, so that the outside of the line is the surface.
@export var edge := Color("8b93d6"):
	set(value):
		edge = value
		queue_redraw()


## Gives a body that a script builds another box to collide with, in the body's coordinates.
static func add_box(solid: StaticBody2D, box: Rect2) -> void:
	var shape := CollisionShape2D.new()
	var rectangle := RectangleShape2D.new()
	rectangle.size = box.size
	shape.shape = rectangle
	shape.position = box.get_center()
	solid.add_child(shape)


func _ready() -> void:
	set_process(Engine.is_editor_hint())


func _process(_delta: float) -> void:
	queue_redraw() # only in the editor, where shapes are being edited


func _draw() -> void:
	var areas: Array[PackedVector2Array] = []
	for child in get_children():
		var shape_node := child as CollisionShape2D
		var polygon_node := child as CollisionPolygon2D
		if shape_node != null and shape_node.shape != null and not shape_node.disabled:
			var segment := shape_node.shape as SegmentShape2D
			if segment != null:
				var place := shape_node.transform
				draw_line(place * segment.a, place * segment.b, edge, EDGE_WIDTH, true)
			else:
				areas.append(shape_node.transform * _outline_of(shape_node.shape))
		elif polygon_node != null and not polygon_node.disabled:
			areas.append(polygon_node.transform * polygon_node.polygon)
	# All edges before all insides: shapes that overlap look like one.
	for area in areas:
		_draw_smooth(area, edge, 0)
	for area in areas:
		_draw_smooth(area, fill, EDGE_WIDTH)


## Fills an outline, made smaller by `inset`, with a smooth rim.
func _draw_smooth(outline: PackedVector2Array, color: Color, inset: float) -> void:
	for area in Geometry2D.offset_polygon(outline, -inset, Geometry2D.JOIN_MITER) if inset > 0 else [outline]:
		draw_colored_polygon(area, color)
		for rim: PackedVector2Array in Geometry2D.offset_polygon(area, -RIM_WIDTH / 2, Geometry2D.JOIN_MITER):
			rim.append(rim[0])
			draw_polyline(rim, color, RIM_WIDTH, true)


static func _outline_of(shape: Shape2D) -> PackedVector2Array:
	if shape is RectangleShape2D:
		var half := (shape as RectangleShape2D).size / 2
		return PackedVector2Array([-half, Vector2(half.x, -half.y), half, Vector2(-half.x, half.y)])
	if shape is CircleShape2D:
		return _rounded((shape as CircleShape2D).radius, 0)
	if shape is CapsuleShape2D:
		var capsule := shape as CapsuleShape2D
		return _rounded(capsule.radius, capsule.height / 2 - capsule.radius)
	if shape is ConvexPolygonShape2D:
		return (shape as ConvexPolygonShape2D).points
	if shape is WorldBoundaryShape2D:
		var boundary := shape as WorldBoundaryShape2D
		var place := Transform2D(boundary.normal.angle(), boundary.normal * boundary.distance)
		return place * PackedVector2Array([
			Vector2(0, -BOUNDARY_REACH), Vector2(0, BOUNDARY_REACH),
			Vector2(-BOUNDARY_REACH, BOUNDARY_REACH), Vector2(-BOUNDARY_REACH, -BOUNDARY_REACH),
		])
	return PackedVector2Array()


## A circle, pulled apart along y by `half_length` to both sides.
static func _rounded(radius: float, half_length: float) -> PackedVector2Array:
	var outline := PackedVector2Array()
	for end: float in [1.0, -1.0]:
		for i in ARC_POINTS + 1:
			var angle := PI * (i / float(ARC_POINTS) + (0.0 if end > 0 else 1.0))
			outline.append(Vector2(0, end * half_length) + Vector2.from_angle(angle) * radius)
	if half_length <= 0: # the ends of the two halves coincide
		outline.remove_at(outline.size() - 1)
		outline.remove_at(ARC_POINTS)
	return outline
