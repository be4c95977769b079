# SPDX-License-Identifier: MIT
extends RefCounted
## What to press, in the words of the device that was used last.

enum Device { KEYS, MOUSE, PAD }

const TEXTS := {
	&"game_left": ["A", "Hold left", "Stick ←"],
	&"game_right": ["D", "Hold left", "Stick →"],
	&"game_move": ["A  D", "Hold left", "Stick"],
	&"game_jump": ["Space", "Right click", "A"],
	&"game_deflate": ["S", "Wheel down", "LT"],
	&"game_inflate": ["Shift", "Wheel up", "RT"],
	&"game_pause": ["Esc", "Esc", "Start"],
	&"game_restart": ["R", "R", "Back"],
}

static var device := Device.KEYS


## Notes from which device an event comes. True if that is another one than before.
static func notice(event: InputEvent) -> bool:
	var before := device
	if event is InputEventKey:
		device = Device.KEYS
	elif event is InputEventMouseButton:
		device = Device.MOUSE
	elif event is InputEventJoypadButton or event is InputEventJoypadMotion and absf(event.axis_value) > 0.5:
		device = Device.PAD
	return device != before


static func text_of(action: StringName) -> String:
	return TEXTS[action][device]
