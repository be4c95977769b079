# SPDX-License-Identifier: MIT
extends Node2D
## Thaws frozen bodies one after the other, and shows which are frozen and which sleep.

const INTERVAL := 2.5 # s
const FROZEN := Color(0.6, 0.62, 0.7)

var _colors := {} # body -> Color
var _age := 0.0

@onready var _status: Label = %Status


func _ready() -> void:
	for node in find_children("*", "SoftBody2D"):
		_colors[node] = (node as SoftBody2D).color


func _physics_process(delta: float) -> void:
	_age += delta
	var frozen := 0
	var asleep := 0
	for body: SoftBody2D in _colors:
		if body.freeze and body.name.begins_with("Frozen") and _age > INTERVAL * body.name.trim_prefix("Frozen").to_int():
			body.freeze = false
		frozen += int(body.freeze)
		asleep += int(body.sleeping and not body.freeze)
		var color: Color = _colors[body]
		body.color = FROZEN if body.freeze else color.darkened(0.45) if body.sleeping else color
	_status.text = "%d frozen, %d asleep" % [frozen, asleep]
