# SPDX-License-Identifier: MIT
extends "res://pictures/before_and_after.gd"
## A default body falls on a floor. White lines keep the outline of its most squashed moment.

## How far the body falls, in pixels. The picture begins on the way.
const HEIGHT := 400.0
## How far it is above the floor when the picture begins, in pixels.
const BEGIN := 120.0
const GRAVITY := 980.0 # px/s²
const RADIUS := 50.0
## The height over that at rest below which a body counts as squashed.
const SQUASHED := 0.9

## Of both sides: the outline when the body was lowest.
var squashed: Array[PackedVector2Array] = [PackedVector2Array(), PackedVector2Array()]
## Of both sides: width and height then, over those at rest.
var squashed_size: Array[Vector2] = [Vector2.ONE, Vector2.ONE]
## Of both sides: area then, over that at rest.
var squashed_area: Array[float] = [1.0, 1.0]


func _build(side: int) -> void:
	add_box(side, Rect2(-SCREEN.x, 0, 2 * SCREEN.x, 400))
	var body := add_body(side, Vector2(0, -BEGIN - RADIUS), COLORS[side])
	body.linear_velocity.y = sqrt(2 * GRAVITY * (HEIGHT - BEGIN))


func _move(_age_of_scene: float) -> void:
	for side in 2:
		var body: SoftBody2D = bodies[side][0]
		var size := size_of(body)
		if size.y < minf(SQUASHED, squashed_size[side].y):
			squashed[side] = polygon_of(body)
			squashed_size[side] = size
			squashed_area[side] = area_of(body)


func _describe(side: int) -> String:
	if squashed[side].is_empty():
		return ""
	return "squashed: height %d %%\nwidth %d %%, area %d %%" % [
			percent(squashed_size[side].y), percent(squashed_size[side].x), percent(squashed_area[side])]


func _draw_overlay() -> void:
	for outline in squashed:
		if outline.size() > 2:
			overlay.draw_polyline(outline + outline.slice(0, 2), GHOST, 2, true)
