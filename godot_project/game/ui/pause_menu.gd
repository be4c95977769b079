# SPDX-License-Identifier: MIT
extends CanvasLayer
## What can be done while the game waits.

signal resumed
signal back_asked
signal restart_asked
signal menu_asked

const Look := preload("res://game/ui/look.gd")
const SettingsPanel := preload("res://game/ui/settings_panel.gd")

var _choices := VBoxContainer.new()
var _settings := SettingsPanel.new()
var _first: Button


func _ready() -> void:
	layer = 8
	visible = false
	process_mode = Node.PROCESS_MODE_WHEN_PAUSED
	Look.veil(self)
	var rows := Look.centered_panel(self)
	rows.add_child(_choices)
	rows.add_child(_settings)
	_choices.add_theme_constant_override(&"separation", 12)
	_choices.add_child(Look.title("Pause", 38))
	_first = Look.button("Go on", resumed.emit)
	_choices.add_child(_first)
	_choices.add_child(Look.button("Back to the lantern", back_asked.emit))
	_choices.add_child(Look.button("Begin this level again", restart_asked.emit))
	_choices.add_child(Look.button("Settings", _open_settings))
	_choices.add_child(Look.button("Main menu", menu_asked.emit))
	_settings.visible = false
	_settings.closed.connect(open)


func open() -> void:
	_settings.visible = false
	_choices.visible = true
	_first.grab_focus()


func _input(event: InputEvent) -> void:
	if not visible or not event.is_action_pressed(&"game_pause") and not event.is_action_pressed(&"ui_cancel"):
		return
	get_viewport().set_input_as_handled()
	if _settings.visible:
		_settings.close()
	else:
		resumed.emit()


func _open_settings() -> void:
	_choices.visible = false
	_settings.open()
