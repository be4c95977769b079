# SPDX-License-Identifier: MIT
extends Node2D
## Shows what the signals of the soft bodies say: a ring where two have met, and how many touches there are.

const SHOWN_FOR := 0.8 # s

var _touches := 0
var _rings: Array[Dictionary] = []


func _ready() -> void:
	for node in get_tree().get_nodes_in_group(&"soft_bodies"):
		var body := node as SoftBody2D
		if get_parent().is_ancestor_of(body):
			body.body_entered.connect(_on_body_entered)
			body.body_exited.connect(_on_body_exited)
			body.contact_started.connect(_on_contact_started)


func _process(delta: float) -> void:
	for ring in _rings:
		ring["age"] += delta
	_rings = _rings.filter(func(ring: Dictionary) -> bool: return ring["age"] < SHOWN_FOR)
	(%Status as Label).text = "%d touches" % _touches
	queue_redraw()


func _draw() -> void:
	for ring in _rings:
		var age: float = ring["age"] / SHOWN_FOR
		draw_arc(ring["point"], ring["radius"] * (0.4 + age), 0, TAU, 32, Color(1, 1, 1, 1 - age), 3, true)


func _on_body_entered(_other: Node) -> void:
	_touches += 1


func _on_body_exited(_other: Node) -> void:
	_touches -= 1


func _on_contact_started(_other: Node, point: Vector2, _normal: Vector2, impulse: float) -> void:
	_rings.append({"point": to_local(point), "radius": 20 + minf(sqrt(impulse) * 4, 60), "age": 0.0})
