# SPDX-License-Identifier: MIT
extends Node
## Where the program begins: the menu, or the demo if arguments after `--` ask for a report.

const Entries := preload("res://game/entries.gd")
const DEMO := "res://demo/main.tscn"


func _ready() -> void:
	if get_tree().current_scene != self: # inside a test the arguments are not meant for the game
		return
	var wants_report := not OS.get_cmdline_user_args().is_empty()
	get_tree().change_scene_to_file.call_deferred(DEMO if wants_report else Entries.MENU)
