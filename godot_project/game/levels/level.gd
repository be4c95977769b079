# SPDX-License-Identifier: MIT
extends Node2D
## One level: finds what its scene holds (stars, checkpoints, thorns, the gate) and tells the game what happens to them.

signal star_taken
signal checkpoint_reached
signal hurt
signal finished

const Star := preload("res://game/world/star.gd")
const Checkpoint := preload("res://game/world/checkpoint.gd")
const Gate := preload("res://game/world/gate.gd")
const Thorns := preload("res://game/world/thorns.gd")

@export var title := ""
## Area that the camera may show. A player that falls out at the bottom is lost.
@export var bounds := Rect2(0, 0, 1280, 720)
## No sky behind it.
@export var underground := false

var star_count := 0
var stars_taken := 0

var _come_back := Vector2.ZERO


func _ready() -> void:
	_come_back = (get_node(^"Spawn") as Node2D).global_position
	for node in find_children("*", "Area2D"):
		if node is Star:
			star_count += 1
			(node as Star).taken.connect(_on_star_taken)
		elif node is Checkpoint:
			(node as Checkpoint).reached.connect(_on_checkpoint_reached.bind(node))
		elif node is Gate:
			(node as Gate).entered.connect(finished.emit)
		elif node is Thorns:
			(node as Thorns).touched.connect(hurt.emit)


## Where the player begins, or begins again.
func get_start() -> Vector2:
	return _come_back


func _on_star_taken() -> void:
	stars_taken += 1
	star_taken.emit()


func _on_checkpoint_reached(checkpoint: Checkpoint) -> void:
	_come_back = checkpoint.global_position + Vector2(0, -46)
	checkpoint_reached.emit()
