# SPDX-License-Identifier: MIT
extends Node2D
## Base of the pictures in docs/accuracy.md of the default body: before it had a material (left) and with it (right).
##
## The left bodies are networks of springs of 100 N/m with the limits off. New nodes were that before the material came
## (commit 2fffa5f). A pile of them moves in the same bits in both versions. The right bodies are new nodes of today. Whatever
## else a scene changes in a body, it changes on both sides.

const SKIN := preload("res://common/skin.gd")
const SOLID := preload("res://common/solid.gd")
const TITLES: Array[String] = ["Before: springs", "Now: material"]
const COLORS: Array[Color] = [Color("ff6b6b"), Color("4ecdc4")]
const GHOST := Color(1, 1, 1, 0.85)
const SCREEN := Vector2(1280, 720)
const BEFORE := 0
const AFTER := 1
## Switches the limit of length off: the largest number of single precision. A smaller one never limits the length either, but
## keeps the limits at work, which turn folded bodies back out.
const NO_LIMIT := 3.4028234663852886e38
## A body with less of its rest area counts as folded, as one whose outline crosses itself does.
const LEAST_AREA := 0.25

## Pixels of the screen for one of the scene.
@export var zoom := 1.0
## The height of the scene that is in the middle of the screen.
@export var middle := 0.0

## The bodies of both sides.
var bodies: Array[Array] = [[], []]
## One node a side; its origin is in the middle of that half of the screen.
var sides: Array[Node2D] = []
var overlay := Node2D.new()

var _labels: Array[Label] = []
var _age := 0.0 # s, of the scene


func _ready() -> void:
	var camera := Camera2D.new()
	camera.zoom = Vector2.ONE * zoom
	camera.position.y = middle
	add_child(camera)
	var canvas := CanvasLayer.new()
	add_child(canvas)
	var line := ColorRect.new()
	line.color = Color(1, 1, 1, 0.35)
	line.position.x = SCREEN.x / 2 - 1.5
	line.size = Vector2(3, SCREEN.y)
	canvas.add_child(line)
	for i in 2:
		var side := Node2D.new()
		side.position.x = (i - 0.5) * SCREEN.x / 2 / zoom
		add_child(side)
		sides.append(side)
		var title := _make_label(canvas, i, 12, 50)
		title.text = TITLES[i]
		title.add_theme_color_override("font_color", COLORS[i].lightened(0.35))
		_labels.append(_make_label(canvas, i, 72, 42))
		_build(i)
	overlay.z_index = 10
	overlay.draw.connect(_draw_overlay)
	add_child(overlay)


func _physics_process(delta: float) -> void:
	_age += delta
	_move(_age)
	for i in 2:
		_labels[i].text = _describe(i)
	overlay.queue_redraw()


# What a scene is made of.

## Adds what one side holds.
func _build(_side: int) -> void:
	pass


## Moves what a scene moves, after `age` seconds.
func _move(_age_of_scene: float) -> void:
	pass


## What is written over a side.
func _describe(_side: int) -> String:
	return ""


## Draws in the scene's coordinates, over the bodies.
func _draw_overlay() -> void:
	pass


# What scenes build with.

func add_body(side: int, place: Vector2, color: Color) -> SoftBody2D:
	var body := SoftBody2D.new()
	if side == BEFORE:
		body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
		body.stiffness = 100
		body.least_area = 0
		body.least_stretch = 0
		body.most_stretch = NO_LIMIT
	body.position = place
	body.color = color
	var skin := SKIN.new()
	if zoom < 1:
		skin.shine_width = 0
	body.add_child(skin)
	sides[side].add_child(body)
	bodies[side].append(body)
	return body


func add_box(side: int, box: Rect2) -> void:
	var solid := StaticBody2D.new()
	solid.set_script(SOLID)
	SOLID.add_box(solid, box)
	sides[side].add_child(solid)


static func polygon_of(body: SoftBody2D) -> PackedVector2Array:
	return body.get_point_positions().slice(0, body.polygon.size())


## Width and height of a body over those of its rest shape. No body turns in the scenes that ask.
static func size_of(body: SoftBody2D) -> Vector2:
	return _bounds_of(polygon_of(body)).size / _bounds_of(body.polygon).size


static func area_of(body: SoftBody2D) -> float:
	return body.get_area() / body.get_rest_area()


static func is_folded(body: SoftBody2D) -> bool:
	if area_of(body) < LEAST_AREA:
		return true
	var polygon := polygon_of(body)
	for i in polygon.size():
		for k in range(i + 2, polygon.size()):
			var next := (k + 1) % polygon.size()
			if next != i and Geometry2D.segment_intersects_segment(polygon[i], polygon[i + 1], polygon[k], polygon[next]) != null:
				return true
	return false


static func percent(share: float) -> int:
	return roundi(100 * share)


static func _bounds_of(points: PackedVector2Array) -> Rect2:
	var box := Rect2(points[0], Vector2.ZERO)
	for point in points:
		box = box.expand(point)
	return box


func _make_label(canvas: CanvasLayer, side: int, top: float, font_size: int) -> Label:
	var label := Label.new()
	label.position = Vector2(side * SCREEN.x / 2, top)
	label.size.x = SCREEN.x / 2
	label.horizontal_alignment = HORIZONTAL_ALIGNMENT_CENTER
	label.add_theme_font_size_override("font_size", font_size)
	label.add_theme_color_override("font_outline_color", Color("1b1f42"))
	label.add_theme_constant_override("outline_size", 10)
	canvas.add_child(label)
	return label
