# SPDX-License-Identifier: MIT
@tool
extends Area2D
## A column of wind. It pushes a soft body by the area that it offers, see [method SoftBody2D.get_area]: a
## player that inflates is carried, any other falls through.

const Palette := preload("res://game/palette.gd")
## Area that catches the whole strength [px²].
const FULL_AREA := 10000.0
const STREAKS := 26

@export var extent := Vector2(180, 600):
	set(value):
		extent = value
		queue_redraw()
## Push on a body of 10,000 px² for each kilogram that it has, in px/s²; along the node's upward direction.
@export_range(0, 5000, 10, "or_greater") var strength := 1300.0

var _age := 0.0
var _inside: Array[SoftBody2D] = []


func _ready() -> void:
	if Engine.is_editor_hint():
		set_physics_process(false)
		return
	collision_layer = 0
	collision_mask = 4 # the layer of what wind can carry
	var shape := CollisionShape2D.new()
	var box := RectangleShape2D.new()
	box.size = extent
	shape.shape = box
	add_child(shape)
	body_entered.connect(_on_body_entered)
	body_exited.connect(_on_body_exited)


func _physics_process(_delta: float) -> void:
	for body in _inside:
		if is_instance_valid(body) and not body.freeze:
			body.apply_central_force(-global_transform.y.normalized()
					* (strength * body.mass * body.get_area() / FULL_AREA))


func _process(delta: float) -> void:
	_age += delta
	queue_redraw()


func _draw() -> void:
	var half := extent / 2
	draw_polygon(
			PackedVector2Array([Vector2(-half.x, half.y), -half, Vector2(half.x, -half.y), half]),
			PackedColorArray([Color(Palette.WIND, 0.2), Color(Palette.WIND, 0.0),
				Color(Palette.WIND, 0.0), Color(Palette.WIND, 0.2)]))
	var speed := sqrt(strength) * 9
	for i in STREAKS:
		var chance := fposmod(i * 0.618034, 1)
		var long := 50 + 60 * fposmod(i * 0.37, 1)
		var along := fposmod(_age * speed * (0.7 + 0.6 * chance) + i * 137.0, extent.y)
		var x := (fposmod(i * 0.754878, 1) - 0.5) * (extent.x - 16)
		var y := half.y - along
		var seen := sin(PI * along / extent.y)
		draw_line(Vector2(x, y), Vector2(x, maxf(y - long, -half.y)), Color(Palette.WIND, 0.4 * seen), 2.5, true)


func _on_body_entered(node: Node2D) -> void:
	var body := node as SoftBody2D
	if body != null:
		_inside.append(body)


func _on_body_exited(node: Node2D) -> void:
	_inside.erase(node as SoftBody2D)
