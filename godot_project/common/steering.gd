# SPDX-License-Identifier: MIT
extends RefCounted
## What the player asks for: arrow keys, WASD, a gamepad's stick or cross. Uses the actions that every project has.

const DEAD_ZONE := 0.2


## Where to, of length 1 at most.
static func direction() -> Vector2:
	var wish := Input.get_vector(&"ui_left", &"ui_right", &"ui_up", &"ui_down", DEAD_ZONE)
	wish += Vector2(
			float(Input.is_physical_key_pressed(KEY_D)) - float(Input.is_physical_key_pressed(KEY_A)),
			float(Input.is_physical_key_pressed(KEY_S)) - float(Input.is_physical_key_pressed(KEY_W)))
	return wish.limit_length(1)


## Space, Enter, or the lower button of a gamepad.
static func is_acting() -> bool:
	return Input.is_action_pressed(&"ui_accept")


## Shift, or the left button of a gamepad.
static func is_acting_otherwise() -> bool:
	return Input.is_key_pressed(KEY_SHIFT) or Input.is_joy_button_pressed(0, JOY_BUTTON_X)
