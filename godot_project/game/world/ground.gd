# SPDX-License-Identifier: MIT
@tool
extends StaticBody2D
## Ground: a static body whose [CollisionPolygon2D] children are all that there is to its looks and its shape.
##
## Filled darker towards the inside, with a rim, and grass on what faces up. Soft bodies collide with it as with any
## static body. The engine would cut each outline into convex pieces that lie edge to edge, and a soft skin that is pressed
## hard finds the seams; here each edge of the outline becomes a piece that reaches under its neighbors, with a core below.

const Palette := preload("res://game/palette.gd")
## How far inside each darker layer begins, in pixels.
const LAYERS: Array[float] = [10.0, 26.0, 54.0, 100.0]
const RIM_WIDTH := 4.0
const GRASS_NORMAL := 0.75 # how much an edge faces up to carry grass
const TUFT_SPACING := 34.0
const CRUST := 22.0 # how thick the piece of an edge is
## How far it reaches under its neighbors, as multiples of the crust: the first that stays inside the outline.
const REACHES: Array[float] = [2.5, 1.6, 1.0, 0.6, 0.3, 0.1, 0.0, -0.3, -0.6, -1.0]
const CORE_DEPTH := 14.0 # where the core begins

## No grass: a cave, a wall.
@export var bare := false:
	set(value):
		bare = value
		queue_redraw()
@export var fill := Palette.GROUND:
	set(value):
		fill = value
		queue_redraw()
@export var rim := Palette.GROUND_RIM:
	set(value):
		rim = value
		queue_redraw()

var _tufts := true


func _ready() -> void:
	add_to_group(&"quality")
	set_process(Engine.is_editor_hint())
	if not Engine.is_editor_hint():
		for child in get_children():
			if child is CollisionPolygon2D:
				_build(child as CollisionPolygon2D)


func _process(_delta: float) -> void:
	queue_redraw() # only in the editor, where shapes are being edited


func apply_quality(quality: int) -> void:
	_tufts = quality > 0
	queue_redraw()


## Replaces an outline by convex pieces that overlap.
func _build(node: CollisionPolygon2D) -> void:
	var outline := _inside_to_the_right(node.polygon)
	node.disabled = true
	var owner_id := create_shape_owner(node)
	shape_owner_set_transform(owner_id, node.transform)
	for i in outline.size():
		_add_piece(owner_id, _crust(outline, i))
	for core in Geometry2D.offset_polygon(outline, -CORE_DEPTH, Geometry2D.JOIN_MITER):
		if Geometry2D.is_polygon_clockwise(core) == Geometry2D.is_polygon_clockwise(outline):
			for piece in Geometry2D.decompose_polygon_in_convex(core):
				_add_piece(owner_id, piece)


func _add_piece(owner_id: int, points: PackedVector2Array) -> void:
	if points.size() < 3:
		return
	var shape := ConvexPolygonShape2D.new()
	shape.points = points
	shape_owner_add_shape(owner_id, shape)


## The piece of edge `i`: the edge, and below it a longer one.
static func _crust(outline: PackedVector2Array, i: int) -> PackedVector2Array:
	var a := outline[i]
	var b := outline[(i + 1) % outline.size()]
	var along := (b - a).normalized()
	var inward := Vector2(-along.y, along.x) * CRUST
	var low_a := a + inward
	var low_b := b + inward
	for reach in REACHES:
		low_a = a + inward - along * (reach * CRUST)
		if _is_inside(outline, a, low_a):
			break
	for reach in REACHES:
		low_b = b + inward + along * (reach * CRUST)
		if _is_inside(outline, b, low_b):
			break
	if (low_b - low_a).dot(along) <= 1: # the end of something thin
		return PackedVector2Array([a, b, (a + b) / 2 + inward * 0.4])
	return PackedVector2Array([a, b, low_b, low_a])


## Whether the way from a corner to an inner point leaves the outline nowhere.
static func _is_inside(outline: PackedVector2Array, corner: Vector2, inner: Vector2) -> bool:
	if not Geometry2D.is_point_in_polygon(inner, outline):
		return false
	var from := corner.lerp(inner, 0.02)
	for i in outline.size():
		if Geometry2D.segment_intersects_segment(from, inner, outline[i], outline[(i + 1) % outline.size()]) != null:
			return false
	return true


static func _inside_to_the_right(polygon: PackedVector2Array) -> PackedVector2Array:
	var doubled := 0.0
	for i in polygon.size():
		doubled += polygon[i - 1].cross(polygon[i])
	var outline := polygon.duplicate()
	if doubled < 0:
		outline.reverse()
	return outline


## All rims before all insides, and outer layers before inner ones: outlines that overlap look like one.
func _draw() -> void:
	var areas: Array[PackedVector2Array] = []
	for child in get_children():
		var node := child as CollisionPolygon2D
		if node != null and node.polygon.size() > 2:
			areas.append(node.transform * _inside_to_the_right(node.polygon))
	for area in areas:
		if _tufts and not bare:
			_draw_tufts(area)
	for area in areas:
		draw_colored_polygon(area, rim)
		for line in Geometry2D.offset_polygon(area, -0.75, Geometry2D.JOIN_MITER):
			line.append(line[0])
			draw_polyline(line, rim, 1.5, true)
	_draw_layer(areas, RIM_WIDTH, fill, true)
	for i in LAYERS.size():
		_draw_layer(areas, LAYERS[i], fill.lerp(Palette.GROUND_DEEP, (i + 1.0) / LAYERS.size()), false)


func _draw_layer(areas: Array[PackedVector2Array], depth: float, color: Color, smooth: bool) -> void:
	for area in areas:
		for inner in Geometry2D.offset_polygon(area, -depth, Geometry2D.JOIN_ROUND):
			if Geometry2D.is_polygon_clockwise(inner) != Geometry2D.is_polygon_clockwise(area):
				continue # a hole, where the area is too thin for this layer
			draw_colored_polygon(inner, color)
			if smooth:
				inner.append(inner[0])
				draw_polyline(inner, color, 1.2, true)


## Blades whose sizes come from where they stand, so that they are the same in every frame and game.
func _draw_tufts(area: PackedVector2Array) -> void:
	for i in area.size():
		var from := area[i]
		var along := area[(i + 1) % area.size()] - from
		var length := along.length()
		if along.x < GRASS_NORMAL * length: # the inside is to the right, so what runs to the right faces up
			continue
		var at := fposmod(from.x * 0.37, TUFT_SPACING)
		while at < length:
			_draw_tuft(from + along * (at / length))
			at += TUFT_SPACING * (0.5 + _chance(from + along * (at / length)))


func _draw_tuft(root: Vector2) -> void:
	for blade in 3:
		var chance := _chance(root + Vector2(blade * 31, 17))
		var tip := root + Vector2((blade - 1) * 7 + 6 * (chance - 0.5), -7 - 9 * chance)
		var foot := root + Vector2((blade - 1) * 4, 3)
		draw_colored_polygon(PackedVector2Array([foot + Vector2(-2.5, 0), tip, foot + Vector2(2.5, 0)]),
				Palette.GRASS.lerp(rim, 0.5 * chance))


static func _chance(place: Vector2) -> float:
	return fposmod(sin(place.dot(Vector2(12.9898, 78.233))) * 43758.5453, 1)
