# SPDX-License-Identifier: MIT
extends Node2D
## Moonjelly: plays one level after the other, with all that is around them: camera, sound, time, stars, pause, the end.

const Entries := preload("res://game/entries.gd")
const Settings := preload("res://game/settings.gd")
const Glyphs := preload("res://game/glyphs.gd")
const Level := preload("res://game/levels/level.gd")
const Cushion := preload("res://game/world/cushion.gd")
const Player := preload("res://game/player/player.gd")
const Backdrop := preload("res://game/world/backdrop.gd")
const FollowCamera := preload("res://game/follow_camera.gd")
const Sounds := preload("res://game/audio/sounds.gd")
const Hud := preload("res://game/ui/hud.gd")
const Iris := preload("res://game/ui/iris.gd")
const PauseMenu := preload("res://game/ui/pause_menu.gd")
const WinScreen := preload("res://game/ui/win_screen.gd")

const AWAY_TIME := 0.6 # s between popping and being back
const LOUDEST_IMPULSE := 260.0 # kg·px/s in one tick
const POINTER_REACH := 130.0 # px from the jelly at which the mouse asks for full speed

## Which level comes first; the menu sets it.
static var first_level := 0

## Seconds played since the first level, and what was brought home from levels that are done.
var time := 0.0
var stars := 0
var stars_possible := 0
var level: Level
var level_index := 0
## Whether the player is popped, fading or has won, and so cannot be hurt.
var is_busy := true

## Where the mouse is in the window, and whether it pulls the jelly along.
var _pointer := Vector2.ZERO
var _pointer_held := false

@onready var player: Player = %Player
@onready var _camera: FollowCamera = %Camera
@onready var _backdrop: Backdrop = $Backdrop
@onready var _sounds: Sounds = %Sounds
@onready var _hud: Hud = %Hud
@onready var _iris: Iris = %Iris
@onready var _pause: PauseMenu = %PauseMenu
@onready var _win: WinScreen = %WinScreen


func _ready() -> void:
	Settings.read()
	player.jumped.connect(func() -> void: _sounds.play(&"jump", 0.6))
	player.landed.connect(_on_player_landed)
	player.crushed.connect(hurt)
	player.size_changed.connect(_on_player_size_changed)
	_pause.resumed.connect(func() -> void: set_paused(false))
	_pause.back_asked.connect(_on_back_asked)
	_pause.restart_asked.connect(_on_restart_asked)
	_pause.menu_asked.connect(_go_to_menu)
	_win.again_asked.connect(_on_again_asked)
	_win.menu_asked.connect(_go_to_menu)
	_camera.body = player
	_sounds.start_music()
	start_level(first_level)


func _exit_tree() -> void:
	get_tree().paused = false


func _input(event: InputEvent) -> void:
	Glyphs.notice(event)


func _unhandled_input(event: InputEvent) -> void:
	if event.is_action_pressed(&"game_pause") and not _win.visible:
		set_paused(true)
	elif event.is_action_pressed(&"game_restart"):
		hurt()
	var mouse := event as InputEventMouse
	if mouse == null:
		return
	_pointer = mouse.position
	var button := event as InputEventMouseButton
	if button == null:
		return
	if button.button_index == MOUSE_BUTTON_LEFT:
		_pointer_held = button.pressed
	elif button.button_index == MOUSE_BUTTON_WHEEL_UP and button.pressed:
		player.turn_wheel(1)
	elif button.button_index == MOUSE_BUTTON_WHEEL_DOWN and button.pressed:
		player.turn_wheel(-1)


func _notification(what: int) -> void:
	if what == NOTIFICATION_APPLICATION_FOCUS_OUT and is_node_ready() and not is_busy \
			and DisplayServer.get_name() != "headless" and not OS.has_feature("movie"):
		set_paused(true)


func _physics_process(delta: float) -> void:
	if level == null or is_busy:
		return
	time += delta
	player.pointer_direction = 0
	if _pointer_held:
		var pointed := get_canvas_transform().affine_inverse() * _pointer
		player.pointer_direction = (pointed.x - player.global_position.x) / POINTER_REACH
	if player.get_center_of_mass_position().y > level.bounds.end.y + 60:
		hurt()


func _process(_delta: float) -> void:
	if level != null:
		_hud.show_state(level.stars_taken, level.star_count, time)


func start_level(index: int) -> void:
	if level != null:
		level.queue_free()
		remove_child(level)
	level_index = index
	level = (load(Entries.LEVELS[index]) as PackedScene).instantiate()
	add_child(level)
	move_child(level, 0)
	stars_possible += level.star_count
	level.star_taken.connect(_on_star_taken)
	level.checkpoint_reached.connect(func() -> void: _sounds.play(&"checkpoint", 0.7))
	level.hurt.connect(hurt)
	level.finished.connect(_on_level_finished)
	for node in level.find_children("*", "SoftBody2D"):
		if node is Cushion:
			(node as Cushion).bounced.connect(func() -> void: _sounds.play(&"bounce", 0.7))
	Settings.apply(get_tree())
	_camera.set_bounds(level.bounds)
	_backdrop.underground = level.underground
	_bring_player()
	_camera.snap()
	_hud.announce(level.title)
	_iris.open(player)


## Sends the player back to the last checkpoint.
func hurt() -> void:
	if is_busy:
		return
	is_busy = true
	_sounds.play(&"pop", 0.8)
	_camera.shake(9)
	player.pop()
	player.controlled = false
	player.visible = false
	player.freeze = true # held where it popped, while the drops fly
	var wait := create_tween()
	wait.tween_interval(AWAY_TIME)
	wait.tween_callback(_bring_player)


func set_paused(paused: bool) -> void:
	get_tree().paused = paused
	_pause.visible = paused
	_pointer_held = false
	if paused:
		_pause.open()


func _bring_player() -> void:
	player.freeze = false
	player.place_at(level.get_start())
	player.visible = true
	player.controlled = true
	is_busy = false


func _on_star_taken() -> void:
	_sounds.play(&"star", 0.8, 1 + 0.06 * level.stars_taken)
	player.propagate_call(&"smile")


## How hard it hits is how loud and how deep it squishes, see [method SoftBody2D.get_contact_impulse].
func _on_player_landed(impulse: float) -> void:
	var strength := clampf(impulse / LOUDEST_IMPULSE, 0.1, 1)
	_sounds.play(&"squish", strength, 1.35 - 0.5 * strength)
	if strength > 0.7:
		_camera.shake(4 * strength)


func _on_player_size_changed(size: Player.Size) -> void:
	if size == Player.Size.BIG:
		_sounds.play(&"inflate", 0.5)
	elif size == Player.Size.FLAT:
		_sounds.play(&"deflate", 0.5)


func _on_level_finished() -> void:
	if is_busy:
		return
	is_busy = true
	player.controlled = false
	stars += level.stars_taken
	Settings.unlocked = maxi(Settings.unlocked, mini(level_index + 2, Entries.LEVELS.size()))
	var is_last := level_index == Entries.LEVELS.size() - 1
	_sounds.play(&"win" if is_last else &"gate")
	if is_last:
		_finish_game()
	else:
		Settings.write()
		_iris.close(player, start_level.bind(level_index + 1))


func _finish_game() -> void:
	var whole := first_level == 0
	var is_best := whole and (Settings.best_time == 0 or time < Settings.best_time)
	if is_best:
		Settings.best_time = time
	if whole:
		Settings.best_stars = maxi(Settings.best_stars, stars)
	Settings.write()
	_win.open(time, stars, stars_possible, is_best)


func _on_back_asked() -> void:
	set_paused(false)
	hurt()


func _on_restart_asked() -> void:
	set_paused(false)
	is_busy = true
	stars_possible -= level.star_count
	_iris.close(player, start_level.bind(level_index))


func _on_again_asked() -> void:
	first_level = 0
	get_tree().reload_current_scene()


func _go_to_menu() -> void:
	get_tree().paused = false
	get_tree().change_scene_to_file(Entries.MENU)
