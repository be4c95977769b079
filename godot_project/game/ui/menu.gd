# SPDX-License-Identifier: MIT
extends Node2D
## The main menu, on a stage where jellies may be pulled at with the mouse while one chooses.

const Entries := preload("res://game/entries.gd")
const Settings := preload("res://game/settings.gd")
const Glyphs := preload("res://game/glyphs.gd")
const Look := preload("res://game/ui/look.gd")
const Palette := preload("res://game/palette.gd")
const Hud := preload("res://game/ui/hud.gd")
const Game := preload("res://game/game.gd")
const Showcase := preload("res://game/ui/showcase.gd")
const SettingsPanel := preload("res://game/ui/settings_panel.gd")
const Sounds := preload("res://game/audio/sounds.gd")
const HOP_SPEED := 520.0

var _pages: Array[Control] = []
var _main := VBoxContainer.new()
var _levels := VBoxContainer.new()
var _scenes := VBoxContainer.new()
var _settings := SettingsPanel.new()
var _next_hop := 1.2

@onready var _sounds: Sounds = %Sounds
@onready var _column: VBoxContainer = %Column
@onready var _best: Label = %Best


func _ready() -> void:
	Settings.read()
	_column.theme = Look.theme()
	for page: VBoxContainer in [_main, _levels, _scenes, _settings]:
		page.add_theme_constant_override(&"separation", 12)
		_column.add_child(page)
		_pages.append(page)
	_fill_main()
	_fill_levels()
	_fill_scenes()
	_settings.closed.connect(_show.bind(_main))
	_show(_main)
	if Settings.best_time > 0:
		_best.text = "Best  %s   ·   %d stars" % [Hud.clock(Settings.best_time), Settings.best_stars]
	Settings.apply(get_tree())
	_sounds.start_music()


func _input(event: InputEvent) -> void:
	Glyphs.notice(event)
	if event.is_action_pressed(&"ui_cancel") and not _main.visible:
		get_viewport().set_input_as_handled()
		if _settings.visible:
			_settings.close()
		else:
			_show(_main)


func _physics_process(delta: float) -> void:
	_next_hop -= delta
	if _next_hop > 0:
		return
	_next_hop = randf_range(0.9, 2.2)
	var bodies := get_tree().get_nodes_in_group(&"hoppers")
	var body := bodies.pick_random() as SoftBody2D
	if body.linear_velocity.length() < 40:
		var to_middle := signf(float(body.get_meta(&"home", 900.0)) - body.global_position.x)
		body.apply_impulse(Vector2(to_middle * randf_range(0, 90), -HOP_SPEED) * body.get_total_mass(), Vector2(8, 0))


func _fill_main() -> void:
	_main.add_child(Look.button("Play", _play.bind(0)))
	_main.add_child(Look.button("Choose a level", _show.bind(_levels)))
	_main.add_child(Look.button("More jelly", _show.bind(_scenes)))
	_main.add_child(Look.button("Settings", _show.bind(_settings)))
	if not OS.has_feature("web"):
		_main.add_child(Look.button("Quit", func() -> void: get_tree().quit()))


func _fill_levels() -> void:
	for i in Entries.LEVELS.size():
		var level := (load(Entries.LEVELS[i]) as PackedScene).get_state()
		var title := "Level %d" % (i + 1)
		for k in level.get_node_property_count(0):
			if level.get_node_property_name(0, k) == &"title":
				title = "%d   %s" % [i + 1, level.get_node_property_value(0, k)]
		var button := Look.button(title, _play.bind(i))
		button.disabled = i >= Settings.unlocked
		button.focus_mode = Control.FOCUS_NONE if button.disabled else Control.FOCUS_ALL
		_levels.add_child(button)
	_levels.add_child(Look.button("Back", _show.bind(_main)))


func _fill_scenes() -> void:
	var list := VBoxContainer.new()
	list.add_theme_constant_override(&"separation", 8)
	list.size_flags_horizontal = Control.SIZE_EXPAND_FILL
	for scene in Entries.SCENES:
		if not ResourceLoader.exists(scene["path"]):
			continue
		var button := Look.button(scene["title"], _look_at.bind(scene["path"]))
		button.tooltip_text = scene["about"]
		button.add_theme_font_size_override(&"font_size", 20)
		list.add_child(button)
	var scroll := ScrollContainer.new()
	scroll.custom_minimum_size = Vector2(0, 320)
	scroll.follow_focus = true
	scroll.horizontal_scroll_mode = ScrollContainer.SCROLL_MODE_DISABLED
	scroll.add_child(list)
	_scenes.add_child(scroll)
	_scenes.add_child(Look.button("Back", _show.bind(_main)))


func _show(page: Control) -> void:
	for other in _pages:
		other.visible = other == page
	_sounds.play(&"button", 0.4)
	if page == _settings:
		_settings.open()
	else:
		var first := page.find_next_valid_focus()
		for node in page.find_children("*", "Button", true, false):
			if (node as Button).focus_mode == Control.FOCUS_ALL:
				first = node
				break
		first.grab_focus()


func _play(index: int) -> void:
	Game.first_level = index
	get_tree().change_scene_to_file(Entries.GAME)


func _look_at(path: String) -> void:
	Showcase.path = path
	get_tree().change_scene_to_file(Entries.SHOWCASE)
