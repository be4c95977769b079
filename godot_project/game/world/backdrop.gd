# SPDX-License-Identifier: MIT
extends CanvasLayer
## The night behind the game: sky, moon, stars that twinkle, and rows of hills that pass more slowly the farther they are.

const Palette := preload("res://game/palette.gd")
const GLOW := preload("res://game/world/glow.tres")
const STARS := 70
const FEW_STARS := 24
## How fast each row of hills passes, as a share of the camera.
const DEPTH: Array[float] = [0.08, 0.18, 0.34]
const HILL_STEP := 24.0
## Where one color of the sky has become the next, from top to bottom.
const SKY_EDGES: Array[float] = [0.0, 0.45, 0.75, 1.0]

## A cave: no moon, glow-worms for stars, stone for trees.
var underground := false:
	set(value):
		underground = value
		for row in _hills:
			row.queue_redraw()

var _canvas := Node2D.new()
var _hills: Array[Node2D] = []
var _age := 0.0
var _fine := true


func _ready() -> void:
	layer = -10
	add_to_group(&"quality")
	_canvas.draw.connect(_draw_sky)
	add_child(_canvas)
	for i in DEPTH.size():
		var row := Node2D.new()
		row.draw.connect(_draw_hills.bind(row, i))
		_hills.append(row)
		add_child(row)


func apply_quality(quality: int) -> void:
	_fine = quality > 0
	_hills[1].visible = quality > 0


func _process(delta: float) -> void:
	_age += delta
	_canvas.queue_redraw()
	var camera := get_viewport().get_camera_2d()
	var eye := camera.get_screen_center_position() if camera != null else Vector2(40 * _age, 360)
	var size := get_viewport().get_visible_rect().size
	for i in _hills.size():
		# One row repeats itself after three screens of 1280; drawn once, moved along, and back when its end comes near.
		_hills[i].position = Vector2(-fposmod(eye.x * DEPTH[i], 3840), size.y - clampf((eye.y - 360) * DEPTH[i], -130, 130))


func _draw_sky() -> void:
	var size := get_viewport().get_visible_rect().size
	var colors := Palette.CAVE if underground else Palette.SKY
	var bands := colors.size() - 1
	for i in bands:
		var top := size.y * SKY_EDGES[i]
		var bottom := size.y * SKY_EDGES[i + 1]
		_canvas.draw_polygon(
				PackedVector2Array([Vector2(0, top), Vector2(size.x, top), Vector2(size.x, bottom), Vector2(0, bottom)]),
				PackedColorArray([colors[i], colors[i], colors[i + 1], colors[i + 1]]))
	for i in STARS if _fine else FEW_STARS:
		var place := Vector2(fposmod(i * 0.754878, 1) * size.x, fposmod(i * 0.569840, 1) * size.y * 0.7)
		var twinkle := 0.45 + 0.35 * sin(_age * (0.6 + 0.05 * (i % 17)) + i * 2.1)
		if underground:
			place += 9 * Vector2(sin(_age * 0.5 + i), cos(_age * 0.4 + 2 * i))
			var glow := Vector2(7, 7) * (1 + twinkle)
			_canvas.draw_texture_rect(GLOW, Rect2(place - glow, 2 * glow), false, Color(Palette.GLOW_WORM, 0.7 * twinkle))
		else:
			_canvas.draw_circle(place, 1.0 + 0.9 * fposmod(i * 0.37, 1), Color(1, 1, 1, twinkle))
	if underground:
		return
	var moon := Vector2(size.x * 0.79, size.y * 0.2)
	_canvas.draw_texture_rect(GLOW, Rect2(moon - Vector2(230, 230), Vector2(460, 460)), false, Color(Palette.MOON, 0.32))
	_canvas.draw_circle(moon, 58, Palette.MOON, true, -1, true)
	for spot: Vector3 in [Vector3(-18, -14, 13), Vector3(20, 10, 17), Vector3(-10, 26, 8), Vector3(14, -28, 7)]:
		_canvas.draw_circle(moon + Vector2(spot.x, spot.y), spot.z, Palette.MOON.darkened(0.09), true, -1, true)


func _draw_hills(row: Node2D, i: int) -> void:
	var color := Palette.CAVE_HILLS[i] if underground else Palette.HILLS[i]
	var outline := PackedVector2Array()
	var base: float = [-235.0, -165.0, -95.0][i]
	var tall: float = [62.0, 54.0, 46.0][i]
	var x := 0.0
	while x <= 3840 + 1920:
		var turn := TAU * x / 3840
		outline.append(Vector2(x, base - tall * (sin(turn * (3 + i) + i) + 0.55 * sin(turn * (7 + 2 * i) + 2 * i))))
		x += HILL_STEP
	outline.append(Vector2(x - HILL_STEP, 320))
	outline.append(Vector2(0, 320))
	row.draw_colored_polygon(outline, color)
	outline.resize(outline.size() - 2)
	row.draw_polyline(outline, color.lightened(0.1), 3, true)
	var k := 0
	while k < outline.size(): # round trees, the nearer the larger
		var chance := fposmod(sin((k % 160) * 12.9898 + i * 7.1) * 43758.5453, 1)
		if chance > 0.72:
			var size := (14 + 10 * i) * (0.7 + 0.6 * fposmod(chance * 17, 1))
			var foot := outline[k]
			if underground:
				row.draw_colored_polygon(PackedVector2Array([foot + Vector2(-size * 0.6, 6), foot + Vector2(size * 0.15, -size * 2.6),
						foot + Vector2(size * 0.6, 6)]), color.lightened(0.03))
				k += 2
				continue
			row.draw_line(foot + Vector2(0, 4), foot + Vector2(0, -size * 1.3), color.lightened(0.04), 4)
			row.draw_circle(foot + Vector2(0, -size * 1.7), size, color.lightened(0.045), true, -1, true)
		k += 2
