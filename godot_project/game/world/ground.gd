# SPDX-License-Identifier: MIT
@tool
extends StaticBody2D
## Ground: a static body whose [CollisionPolygon2D] children are all that there is to its looks.
##
## Filled darker towards the inside, with a rim, and grass on what faces up. Soft bodies collide with it as with any
## static body; its [PhysicsMaterial] decides how they grip.

const Palette := preload("res://game/palette.gd")
## How far inside each darker layer begins, in pixels.
const LAYERS: Array[float] = [10.0, 26.0, 54.0, 100.0]
const RIM_WIDTH := 4.0
const GRASS_NORMAL := 0.75 # how much an edge faces up to carry grass
const TUFT_SPACING := 34.0

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


func _process(_delta: float) -> void:
	queue_redraw() # only in the editor, where shapes are being edited


func apply_quality(quality: int) -> void:
	_tufts = quality > 0
	queue_redraw()


func _draw() -> void:
	for child in get_children():
		var shape := child as CollisionPolygon2D
		if shape != null and shape.polygon.size() > 2:
			_draw_area(shape.transform * shape.polygon)


func _draw_area(area: PackedVector2Array) -> void:
	if Geometry2D.is_polygon_clockwise(area): # in the engine's words: so that outward is to one side
		area.reverse()
	if _tufts and not bare:
		_draw_tufts(area)
	draw_colored_polygon(area, fill)
	for i in LAYERS.size():
		var color := fill.lerp(Palette.GROUND_DEEP, (i + 1.0) / LAYERS.size())
		for inner in Geometry2D.offset_polygon(area, -LAYERS[i], Geometry2D.JOIN_ROUND):
			if not Geometry2D.is_polygon_clockwise(inner):
				draw_colored_polygon(inner, color)
	for inner in Geometry2D.offset_polygon(area, -RIM_WIDTH / 2, Geometry2D.JOIN_ROUND):
		inner.append(inner[0])
		draw_polyline(inner, rim, RIM_WIDTH, true)


## Blades whose sizes come from where they stand, so that they are the same in every frame and game.
func _draw_tufts(area: PackedVector2Array) -> void:
	for i in area.size():
		var from := area[i]
		var along := area[(i + 1) % area.size()] - from
		var length := along.length()
		var outward := along.orthogonal() / maxf(length, 0.001)
		if -outward.y < GRASS_NORMAL:
			outward = -outward
			if -outward.y < GRASS_NORMAL or not _is_outside(area, from + along / 2 + outward * 2):
				continue
		elif not _is_outside(area, from + along / 2 + outward * 2):
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


static func _is_outside(area: PackedVector2Array, place: Vector2) -> bool:
	return not Geometry2D.is_point_in_polygon(place, area)


static func _chance(place: Vector2) -> float:
	return fposmod(sin(place.dot(Vector2(12.9898, 78.233))) * 43758.5453, 1)
