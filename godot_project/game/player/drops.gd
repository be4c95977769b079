# SPDX-License-Identifier: MIT
extends Node2D
## Drops of jelly: a few where it lands hard, many where it pops, a puff when it jumps. Looks only, no physics.

const Palette := preload("res://game/palette.gd")
const Player := preload("res://game/player/player.gd")
const GRAVITY := Vector2(0, 900)
const MOST := 90

@export var player: Player

var _places := PackedVector2Array()
var _speeds := PackedVector2Array()
var _ages := PackedFloat32Array()
var _share := 1.0


func _ready() -> void:
	top_level = true
	z_index = player.z_index
	global_transform = Transform2D.IDENTITY
	physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF
	add_to_group(&"quality")
	player.landed.connect(func(strength: float) -> void: spray(int(strength / 22), 150, PI))
	player.jumped.connect(func() -> void: spray(5, 110, PI))
	player.popped.connect(func() -> void: spray(40, 420, TAU))


func apply_quality(quality: int) -> void:
	_share = [0.0, 0.6, 1.0][quality]


## Throws `count` drops from the skin, within an angle around up.
func spray(count: int, speed: float, spread: float) -> void:
	var polygon := player.get_interpolated_polygon()
	if polygon.is_empty():
		return
	var low := player.get_center_of_mass_position().y
	for i in mini(int(count * _share), MOST - _places.size()):
		var place := polygon[randi() % polygon.size()]
		if spread < TAU: # from below
			place.y = maxf(place.y, low + (place.y - low) * -0.8)
		_places.append(place)
		_speeds.append(Vector2.from_angle(-PI / 2 + randf_range(-0.5, 0.5) * spread) * speed * randf_range(0.3, 1))
		_ages.append(randf_range(0, 0.25))


func _process(delta: float) -> void:
	if _places.is_empty():
		return
	for i in range(_places.size() - 1, -1, -1):
		_ages[i] += delta
		_speeds[i] += GRAVITY * delta
		_places[i] += _speeds[i] * delta
		if _ages[i] > 0.8:
			_places.remove_at(i)
			_speeds.remove_at(i)
			_ages.remove_at(i)
	queue_redraw()


func _draw() -> void:
	for i in _places.size():
		draw_circle(_places[i], 5.5 * (1 - _ages[i] / 0.8) + 0.5, Palette.JELLY, true, -1, true)
