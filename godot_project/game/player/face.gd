# SPDX-License-Identifier: MIT
extends Node2D
## The face: two eyes and a mouth stuck to the body by [SoftBodyAttachment2D] nodes.
##
## The flesh carries and tilts them. As the body rolls, [method SoftBodyAttachment2D.attach_at] lets them wander over it
## so that the face stays on top, and a little ahead of where it is going.

const Player := preload("res://game/player/player.gd")
const Eye := preload("res://game/player/eye.gd")
const EYE_PLACE := Vector2(9.0, -6.0) # on the undeformed body
const MOUTH_PLACE := Vector2(0, 5.5)
const LEAD := 6.5 # how far the face moves towards where it is going
const MOUTH_COLOR := Color("15604f")

@export var player: Player
@export var left: SoftBodyAttachment2D
@export var right: SoftBodyAttachment2D
@export var mouth: SoftBodyAttachment2D

var _eyes: Array[Eye] = []
var _turn := Vector2.ZERO
var _blink := 2.0
var _surprise := 0.0
var _smile := 0.0


func _ready() -> void:
	_eyes = [left.get_child(0), right.get_child(0)]
	(mouth.get_child(0) as Node2D).draw.connect(_draw_mouth)
	player.landed.connect(func(_strength: float) -> void: _surprise = 0.16)
	player.popped.connect(func() -> void: _surprise = 0.6)


## The next star, say: a smile for a while.
func smile() -> void:
	_smile = 1.2


func _physics_process(delta: float) -> void:
	var speed := player.linear_velocity / 360.0
	_turn = _turn.lerp(Vector2(clampf(speed.x, -1, 1), clampf(speed.y * 0.6, -1, 1)), 1 - exp(-9 * delta))
	var upright := -player.rotation
	var lead := Vector2(_turn.x * LEAD, _turn.y * LEAD * 0.5)
	left.attach_at((EYE_PLACE * Vector2(-1, 1) + lead).rotated(upright), upright)
	right.attach_at((EYE_PLACE + lead).rotated(upright), upright)
	mouth.attach_at((MOUTH_PLACE + lead * 1.1).rotated(upright), upright)


func _process(delta: float) -> void:
	_blink -= delta
	_surprise = maxf(_surprise - delta, 0)
	_smile = maxf(_smile - delta, 0)
	if _blink < -0.12:
		_blink = randf_range(1.2, 4.5)
	var grown := sqrt(clampf(player.get_area() / 5000.0, 0.4, 2.2))
	for eye in _eyes:
		eye.radius = lerpf(7.5, 11.0, clampf(grown - 0.2, 0, 1.3)) * (1.15 if _surprise > 0 else 1.0)
		eye.look = _turn + Vector2(0, 0.1)
		eye.lid = 0.0 if _blink < 0 else (0.55 if player.size == Player.Size.FLAT else 1.0)
		eye.queue_redraw()
	(mouth.get_child(0) as Node2D).queue_redraw()


func _draw_mouth() -> void:
	var canvas := mouth.get_child(0) as Node2D
	if player.size == Player.Size.BIG: # cheeks full of air
		canvas.draw_circle(Vector2.ZERO, 4.5, MOUTH_COLOR, true, -1, true)
	elif _surprise > 0 or not player.is_on_ground() and player.linear_velocity.y > 250:
		canvas.draw_set_transform(Vector2(0, 2), 0, Vector2(1, 1.25))
		canvas.draw_circle(Vector2.ZERO, 5.5, MOUTH_COLOR, true, -1, true)
	elif player.size == Player.Size.FLAT:
		canvas.draw_line(Vector2(-6, 0), Vector2(6, 0), MOUTH_COLOR, 3, true)
	else:
		var wide := 7.5 + 2.5 * minf(_smile, 1)
		canvas.draw_arc(Vector2(0, -wide * 0.6), wide, PI * 0.17, PI * 0.83, 16, MOUTH_COLOR, 3.2, true)
