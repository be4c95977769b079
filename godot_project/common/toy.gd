# SPDX-License-Identifier: MIT
extends Node2D
## Base of the scenes that are built by code: a world that R, or a gamepad's start button, builds anew.

## Parent of everything that a new start replaces.
var world: Node2D


func _ready() -> void:
	restart()


func _unhandled_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	var button := event as InputEventJoypadButton
	if (key != null and key.pressed and not key.echo and key.keycode == KEY_R) \
			or (button != null and button.pressed and button.button_index == JOY_BUTTON_START):
		restart()


func restart() -> void:
	if world != null:
		remove_child(world)
		world.queue_free()
	world = Node2D.new()
	world.name = "World"
	add_child(world)
	_build()


## Fills [member world].
func _build() -> void:
	pass
