# SPDX-License-Identifier: MIT
extends Node2D
## Records the state of every body in every tick, and plays it backwards.

const LONGEST := 300 # ticks that are kept
const BACKWARDS := 2 # ticks for each tick

var _bodies: Array[SoftBody2D] = []
var _record: Array[Array] = [] # of the states of all bodies
var _rewinds := false

@onready var _status: Label = %Status


func _ready() -> void:
	for node in find_children("*", "SoftBody2D"):
		_bodies.append(node as SoftBody2D)


func _physics_process(_delta: float) -> void:
	if _record.size() >= LONGEST:
		_rewinds = true
	var by_hand := Input.is_action_pressed(&"ui_left")
	if _rewinds or by_hand:
		_step_back()
		if _record.is_empty():
			_rewinds = false
	else:
		_record.append(_bodies.map(func(body: SoftBody2D) -> PackedByteArray: return body.get_state()))
	var bytes := 0
	if not _record.is_empty():
		for state: PackedByteArray in _record[0]:
			bytes += state.size()
	_status.text = "%s   ·   %.1f s recorded, %d bytes a tick" % [
		"◀◀ backwards" if _rewinds or by_hand else "▶ forwards",
		_record.size() / float(Engine.physics_ticks_per_second), bytes]


func _step_back() -> void:
	var states := []
	for i in BACKWARDS:
		if not _record.is_empty():
			states = _record.pop_back()
	for i in states.size():
		_bodies[i].set_state(states[i])
