# SPDX-License-Identifier: MIT
extends Area2D
## The moon gate at the end of a level: a crescent with light inside, which holds a player that has reached it.

signal entered

const Palette := preload("res://game/palette.gd")
const GLOW := preload("res://game/world/glow.tres")
const RADIUS := 92.0
const GRAVITY := 980.0
const PULL := 60.0 # 1/s², towards the middle
const BRAKE := 9.0 # 1/s

var _age := 0.0
var _guest: SoftBody2D


func _ready() -> void:
	body_entered.connect(_on_body_entered)


func _process(delta: float) -> void:
	_age += delta
	queue_redraw()


func _draw() -> void:
	var glow := RADIUS * (2.0 + 0.1 * sin(_age * 1.8))
	draw_texture_rect(GLOW, Rect2(-Vector2(glow, glow), Vector2(glow, glow) * 2), false, Color(Palette.MOON, 0.55))
	for ring in 3: # light that runs inward
		var t := fposmod(_age * 0.35 + ring / 3.0, 1)
		draw_arc(Vector2.ZERO, RADIUS * 0.8 * (1 - t), 0, TAU, 48, Color(Palette.MOON, 0.5 * sin(t * PI)), 3, true)
	var crescent := PackedVector2Array()
	for i in 33:
		crescent.append(Vector2.from_angle(PI * 0.62 + PI * 1.76 * i / 32) * RADIUS)
	for i in 33:
		var angle := PI * 0.62 + PI * 1.76 * (32 - i) / 32
		var thick := 6 + 24 * sin(PI * (32 - i) / 32.0)
		crescent.append(Vector2.from_angle(angle) * (RADIUS - thick))
	draw_colored_polygon(crescent, Palette.MOON)
	crescent.append(crescent[0])
	draw_polyline(crescent, Palette.STAR_DARK.lightened(0.2), 2, true)


## Holds its guest by a spring to its middle that also carries the weight.
func _physics_process(_delta: float) -> void:
	if is_instance_valid(_guest) and _guest.is_inside_tree():
		var pull := (global_position - _guest.get_center_of_mass_position()) * PULL - _guest.linear_velocity * BRAKE
		_guest.apply_central_force((pull + Vector2(0, -GRAVITY * _guest.gravity_scale)) * _guest.get_total_mass())


func _on_body_entered(body: Node2D) -> void:
	if _guest == null:
		_guest = body as SoftBody2D
		entered.emit()
