# SPDX-License-Identifier: MIT
extends Node
## Shows one of the scenes that the menu offers, with a way back.

const Entries := preload("res://game/entries.gd")
const Look := preload("res://game/ui/look.gd")

## The scene to show; the menu sets it.
static var path := Entries.SCENES[0]["path"] as String


func _ready() -> void:
	var scene := load(path) as PackedScene
	if scene != null:
		add_child(scene.instantiate())
	var layer := CanvasLayer.new()
	layer.layer = 20
	var back := Look.button("Back  (Esc)", _leave)
	back.focus_mode = Control.FOCUS_NONE
	back.theme = Look.theme()
	back.add_theme_font_size_override(&"font_size", 16)
	layer.add_child(back)
	add_child(layer)
	back.set_anchors_and_offsets_preset(Control.PRESET_TOP_RIGHT, Control.PRESET_MODE_MINSIZE, 14)


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed(&"ui_cancel") or event.is_action_pressed(&"game_pause"):
		get_viewport().set_input_as_handled()
		_leave()


func _leave() -> void:
	get_tree().change_scene_to_file(Entries.MENU)
