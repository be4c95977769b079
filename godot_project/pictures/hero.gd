# SPDX-License-Identifier: MIT
extends Node2D
## Base of the README's first pictures: default nodes with the addon's materials, seen from near, and nothing else.
##
## Each picture is four seconds long and ends where the next round begins.

const SOLID := preload("res://common/solid.gd")
const Presets := preload("res://addons/soft_body_2d/materials/presets.gd")
const SCREEN := Vector2(1280, 720)
## Where the top of the floor is.
const FLOOR := 0.0

## Pixels of the screen for one of the scene.
@export var zoom := 2.0
## How far the floor is above the lower edge of the screen, in pixels of the scene.
@export var ground := 40.0

## Seconds since the scene began.
var age := 0.0


func _ready() -> void:
	var camera := Camera2D.new()
	camera.zoom = Vector2.ONE * zoom
	camera.position.y = ground - SCREEN.y / zoom / 2
	add_child(camera)
	_build()


func _physics_process(delta: float) -> void:
	age += delta
	_move()


## Adds what the scene holds.
func _build() -> void:
	pass


## Moves what the scene moves.
func _move() -> void:
	pass


func add_floor() -> void:
	add_solid(Rect2(-SCREEN.x, FLOOR, 2 * SCREEN.x, 400))


func add_solid(box: Rect2) -> void:
	var solid := StaticBody2D.new()
	solid.set_script(SOLID)
	SOLID.add_box(solid, box)
	add_child(solid)


## Adds a body of one of the addon's materials in the color that goes with it.
func add_body(material_name: String, outline: PackedVector2Array, place: Vector2, color := Color.TRANSPARENT) -> SoftBody2D:
	var body := SoftBody2D.new()
	for preset in Presets.all():
		if preset.file == material_name:
			body.soft_body_material = preset.load_material()
			body.color = preset.color if color.a == 0 else color
	body.look = SoftBody2D.LOOK_SOFT # as the editor has it of a new node
	body.polygon = outline
	body.position = place
	add_child(body)
	return body


## A box of that width and height with round corners.
func make_block(size: Vector2) -> PackedVector2Array:
	var outline := PackedVector2Array()
	for i in 32:
		var way := Vector2.from_angle(TAU * i / 32)
		outline.append(size / 2 * way / pow(pow(absf(way.x), 5.0) + pow(absf(way.y), 5.0), 0.2))
	return outline


## Gives a body eyes that ride along, looking to the middle of the screen.
func add_eyes(body: SoftBody2D, place := Vector2(0, -14), size := 1.0) -> void:
	var face := SoftBodyAttachment2D.new()
	face.position = place
	body.add_child(face)
	var eyes := Node2D.new()
	eyes.draw.connect(_draw_eyes.bind(eyes))
	eyes.scale = Vector2.ONE * size
	face.add_child(eyes)


func _draw_eyes(eyes: Node2D) -> void:
	for side: float in [-1.0, 1.0]:
		eyes.draw_circle(Vector2(15 * side, 0), 11, Color.WHITE, true, -1, true)
		eyes.draw_circle(Vector2(15 * side + 2, 2), 5, Color("20243f"), true, -1, true)
