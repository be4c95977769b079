# SPDX-License-Identifier: MIT
@tool
extends AnimatableBody2D
## A platform that glides to and fro. Soft bodies are carried by an [AnimatableBody2D] through friction, as by a floor.

const Palette := preload("res://game/palette.gd")

@export var extent := Vector2(180, 30):
	set(value):
		extent = value
		queue_redraw()
## Where it goes from where it stands, in pixels.
@export var travel := Vector2(0, -200):
	set(value):
		travel = value
		queue_redraw()
## Seconds there and back.
@export_range(1, 20, 0.1, "or_greater", "suffix:s") var period := 5.0
## Which part of that is over as the level begins.
@export_range(0, 1) var phase := 0.0

var _start := Vector2.ZERO
var _time := 0.0


func _ready() -> void:
	_start = position
	if Engine.is_editor_hint():
		set_physics_process(false)
		return
	var grip := PhysicsMaterial.new()
	grip.friction = 1
	physics_material_override = grip
	var shape := CollisionShape2D.new()
	var box := RectangleShape2D.new()
	box.size = extent
	shape.shape = box
	add_child(shape)
	_physics_process(0)


func _physics_process(delta: float) -> void:
	_time += delta
	position = _start + travel * (0.5 - 0.5 * cos(TAU * (_time / period + phase)))


func _draw() -> void:
	if Engine.is_editor_hint():
		draw_line(Vector2.ZERO, travel, Palette.PLATFORM_RIM, 2)
	var plate := StyleBoxFlat.new()
	plate.bg_color = Palette.PLATFORM
	plate.border_color = Palette.PLATFORM_RIM
	plate.set_border_width_all(4)
	plate.set_corner_radius_all(6)
	draw_style_box(plate, Rect2(-extent / 2, extent))
	var dots := int(extent.x / 36)
	for i in dots:
		var x := (i + 0.5) * extent.x / dots - extent.x / 2
		draw_circle(Vector2(x, 0), 4, Palette.PLATFORM_RIM.lerp(Palette.PLATFORM, 0.35))
