# SPDX-License-Identifier: MIT
extends Node2D
## A pile of soft bodies of several shapes, firm enough to carry those above them.

const COLUMNS := 8
const ROWS := 5
const MOST_BODIES := 60
const COLORS: Array[Color] = [
	Color("ff6b6b"), Color("ffb347"), Color("a8d86e"), Color("4ecdc4"), Color("b388eb"), Color("ffd93d"),
]

var _count := 0


func _ready() -> void:
	(%DropTimer as Timer).timeout.connect(_drop)
	for row in ROWS:
		for column in COLUMNS:
			_add(Vector2(310 + 92 * column + 10 * (row % 2), 560 - 95 * row))


func _drop() -> void:
	if _count < MOST_BODIES:
		_add(Vector2(400 + 60 * (_count % 9), 60))


func _add(place: Vector2) -> void:
	var body := SoftBody2D.new()
	match _count % 3:
		0:
			body.polygon = SoftBody2D.make_circle_polygon(38, 12)
		1:
			body.polygon = SoftBody2D.make_box_polygon(Vector2(66, 66), 24)
		2:
			body.polygon = SoftBody2D.make_circle_polygon(42, 6)
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_NETWORK
	body.stiffness = 400
	body.mass = 1
	body.damping = 0.3
	body.color = COLORS[_count % COLORS.size()]
	body.position = place
	body.rotation = _count * 0.7
	_count += 1
	add_child(body)
