# SPDX-License-Identifier: MIT
extends Node2D
## Soft bodies hop up through one-way platforms, those of tiles and of collision shapes alike.

const SOLID := Vector2i(0, 0)
const ONE_WAY := Vector2i(1, 0)
## How high they hop [px], and how often [s].
const HOP := 210.0
const HOP_INTERVAL := 1.6

@onready var _tiles: TileMapLayer = $Tiles
@onready var _hoppers: Array[Node] = $Hoppers.get_children()

var _time := 0.0
var _next := 0


func _ready() -> void:
	# Painted in the editor as a rule.
	for x in 40:
		for y in [19, 20, 21, 22]:
			_tiles.set_cell(Vector2i(x, y), 0, SOLID)
	for y in range(3, 19):
		_tiles.set_cell(Vector2i(0, y), 0, SOLID)
		_tiles.set_cell(Vector2i(39, y), 0, SOLID)
	for x in 9:
		for y in x / 3:
			_tiles.set_cell(Vector2i(30 + x, 18 - y), 0, SOLID)
	for x in 8:
		_tiles.set_cell(Vector2i(3 + x, 14), 0, ONE_WAY)
		_tiles.set_cell(Vector2i(12 + x, 10), 0, ONE_WAY)


func _physics_process(delta: float) -> void:
	_time += delta
	if _time < HOP_INTERVAL:
		return
	_time = 0
	var body: SoftBody2D = _hoppers[_next % _hoppers.size()]
	_next += 1
	body.apply_central_impulse(Vector2(0, -body.mass * sqrt(2 * 980 * HOP)))
