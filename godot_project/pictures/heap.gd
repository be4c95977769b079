# SPDX-License-Identifier: MIT
extends "res://pictures/before_and_after.gd"
## A hundred default bodies fall between walls, ten wide and ten high.

const COLUMNS := 10
const ROWS := 10
const RADIUS := 50.0
const STEP := Vector2(102.5, 105)
const WALL := 40.0
## Pixels by which a body starts beside its place in the grid.
const JITTER := 2.0
## Ticks between two counts of folded bodies.
const COUNT_EVERY := 6
const PALETTE: Array[Color] = [
	Color("ff6b6b"), Color("ffb347"), Color("a8d86e"), Color("4ecdc4"), Color("b388eb"), Color("ffd93d"),
]

var _folded: Array[int] = [0, 0]
var _ticks := 0


func _build(side: int) -> void:
	var half := COLUMNS * STEP.x / 2
	add_box(side, Rect2(-half - WALL, 0, 2 * half + 2 * WALL, 200))
	for x: float in [-half - WALL, half]:
		add_box(side, Rect2(x, -2000, WALL, 2100))
	var random := RandomNumberGenerator.new()
	random.seed = 1 # the same for both sides
	for i in COLUMNS * ROWS:
		var place := Vector2((i % COLUMNS + 0.5) * STEP.x - half, -(floori(i / float(COLUMNS)) + 0.5) * STEP.y)
		place += Vector2(random.randf_range(-JITTER, JITTER), random.randf_range(-JITTER, JITTER))
		add_body(side, place, PALETTE[i * 5 % 7 % PALETTE.size()])


func _move(_age_of_scene: float) -> void:
	if _ticks % COUNT_EVERY == 0:
		for side in 2:
			_folded[side] = bodies[side].filter(is_folded).size()
	_ticks += 1


func _describe(side: int) -> String:
	return "%d of %d folded" % [_folded[side], COLUMNS * ROWS]
