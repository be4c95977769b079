# SPDX-License-Identifier: MIT
extends SceneTree
## Plays Moonjelly from the menu to the win, as a player would, and claims what must be so on the way.
##
##     godot --fixed-fps 60 --path godot_project --script res://tests/play/play_game.gd [-- --pictures=FOLDER] [--trace] [--level=N]
##
## The first level is played by keyboard, the second by gamepad, the third by mouse. Pictures of the key moments are kept
## in the folder; nothing is drawn in between, so it takes no longer than the steps do. Last line `N passed, N failed`.

const ERROR_LOG := "res://tests/support/error_log.gd"
const Hands := preload("res://tests/play/hands.gd")
const Route := preload("res://tests/play/route.gd")
const Settings := preload("res://game/settings.gd")
const Game := preload("res://game/game.gd")
const Player := preload("res://game/player/player.gd")
const Entries := preload("res://game/entries.gd")

const SETTINGS_FILE := "user://moonjelly_test.cfg"
const LEVEL_TIME := 75 # s after which a level counts as lost
const JUMP_TICKS := 24 # how long the button is held

var _passed := 0
var _failed := 0
var _hands := Hands.new()
var _route := Route.new()
var _pictures := ""
var _trace := false
var _first := 0
var _error_log: RefCounted
var _jump_left := 0
var _seen := {}


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("--pictures="):
			_pictures = argument.trim_prefix("--pictures=")
		_trace = _trace or argument == "--trace"
		if argument.begins_with("--level="):
			_first = int(argument.trim_prefix("--level=")) - 1
	if ClassDB.class_exists(&"Logger"):
		_error_log = (load(ERROR_LOG) as GDScript).new()
		OS.call("add_logger", _error_log)
	Settings.path = SETTINGS_FILE
	_hands.to_window = root.get_final_transform()
	DirAccess.remove_absolute(ProjectSettings.globalize_path(SETTINGS_FILE))
	_draw(false)
	if _first == 0:
		await _start_from_menu()
	else:
		Game.first_level = _first
		change_scene_to_file(Entries.GAME)
		await _ticks(30)
	if current_scene is Game:
		for index in range(_first, Entries.LEVELS.size()):
			_hands.device = [Hands.Device.KEYS, Hands.Device.PAD, Hands.Device.MOUSE][index]
			if not await _play_level(index):
				break
		await _look_at_the_end()
	DirAccess.remove_absolute(ProjectSettings.globalize_path(SETTINGS_FILE))
	for sounds in current_scene.find_children("Sounds"):
		sounds.call("silence")
	OS.delay_msec(200) # the audio thread lets go of what it has played
	await _ticks(2)
	if _error_log != null:
		var errors: PackedStringArray = _error_log.call("take")
		check(errors.is_empty(), "the engine said: " + "\n".join(errors))
		OS.call("remove_logger", _error_log)
		_error_log = null
	print("%d passed, %d failed" % [_passed, _failed])
	quit(1 if _failed > 0 else 0)


func check(condition: bool, claim: String) -> bool:
	if _trace:
		print("- ", claim)
	if condition:
		_passed += 1
	else:
		_failed += 1
		print("FAILED: " + claim)
	return condition


func _start_from_menu() -> void:
	change_scene_to_file(Entries.MENU)
	await _ticks(90)
	await _picture("1_menu")
	# Down to the settings and back, then play.
	for i in 3:
		await _tap(KEY_DOWN)
	await _tap(KEY_ENTER)
	await _ticks(10)
	check(Input.is_anything_pressed() == false, "a key hangs")
	await _picture("2_settings")
	var before := Settings.sound_volume
	await _tap(KEY_LEFT)
	check(Settings.sound_volume < before, "the arrow keys turn the volume down in the settings")
	await _tap(KEY_ESCAPE)
	check(FileAccess.file_exists(SETTINGS_FILE), "the settings are saved as they are left")
	await _tap(KEY_ENTER)
	await _ticks(30)
	check(current_scene is Game, "Enter in the menu starts the game")


func _play_level(index: int) -> bool:
	var game := current_scene as Game
	var player := game.player
	if not check(game.level_index == index, "level %d follows" % (index + 1)):
		return false
	await _ticks(60)
	await _picture("level_%d_00_start" % (index + 1))
	if index == 0:
		await _try_pause(game)
	var pops := [0]
	player.popped.connect(func() -> void: pops[0] += 1)
	var ticks := 0
	while game.level_index == index and not game._win.visible and ticks < LEVEL_TIME * 60:
		if game.is_busy:
			_hands.rest()
			_hands.forget_size()
			_jump_left = 0
		else:
			_act(game, player)
		if _trace and ticks % 30 == 0:
			print("%d: %.1f s at %s v %s, wants %d %d, %d popped%s" % [index + 1, ticks / 60.0,
					player.get_center_of_mass_position().round(), player.linear_velocity.round(), _route.direction, _route.size,
					pops[0], ", on ground" if player.is_on_ground() else ""])
		await _look_around(index, player.get_center_of_mass_position())
		await physics_frame
		ticks += 1
		if not check_quietly(player.get_center_of_mass_position().is_finite(), "the jelly is finite"):
			return false
	_hands.rest()
	print("level %d: %.1f s, popped %d times, %d stars so far" % [index + 1, ticks / 60.0, pops[0], game.stars])
	return check(ticks < LEVEL_TIME * 60, "level %d is finished within %d s; the jelly is at %s"
			% [index + 1, LEVEL_TIME, player.get_center_of_mass_position().round()])


func _act(game: Game, player: Player) -> void:
	_route.think(player, game.level, game.level_index)
	_hands.roll(_route.direction, player.get_global_transform_with_canvas().origin)
	_hands.take_size(_route.size)
	_jump_left -= 1
	if _route.wants_jump and _jump_left < -4 and player.can_jump():
		_jump_left = JUMP_TICKS
	_hands.jump(_jump_left > 0)


## Pausing stops time; the key for coming back sends the jelly to where it started.
func _try_pause(game: Game) -> void:
	await _tap(KEY_ESCAPE)
	check(paused and game._pause.visible, "Escape pauses")
	await _picture("3_pause")
	var time := game.time
	await _ticks(30)
	check(game.time == time, "no time passes in a pause")
	await _tap(KEY_ESCAPE)
	check(not paused, "Escape goes on")
	await _tap_pad(JOY_BUTTON_START)
	check(paused and game._pause.visible, "the gamepad's start button pauses")
	await _tap_pad(JOY_BUTTON_B)
	check(not paused, "the gamepad's B goes on")
	await _tap_pad(JOY_BUTTON_START)
	await _tap_pad(JOY_BUTTON_A)
	check(not paused, "the gamepad's A presses the button in focus, which goes on")
	var start := game.player.get_center_of_mass_position()
	_hands.roll(1, Vector2.ZERO)
	await _ticks(40)
	_hands.rest()
	check(game.player.get_center_of_mass_position().x > start.x + 60, "the key D rolls to the right")
	await _tap(KEY_R)
	await _ticks(5)
	check(game.is_busy, "the key R pops the jelly")
	await _picture("4_pop")
	await _ticks(60)
	check(absf(game.player.get_center_of_mass_position().x - start.x) < 5, "it comes back where it started")


## Pictures on the way, one for each place.
func _look_around(index: int, place: Vector2) -> void:
	var sights: Array = [
		[[540, 0, 600, 999, "hill"], [1800, 0, 2300, 420, "bounce"], [2450, 0, 2700, 999, "platform"],
			[3000, 0, 3200, 999, "boulders"], [3500, 0, 3600, 999, "tunnel"], [3850, 0, 3900, 999, "gate"]],
		[[800, 0, 900, 999, "slide"], [1700, 0, 1760, 999, "bridge"], [2280, 820, 2480, 900, "plugs"],
			[2940, 900, 3200, 1300, "balls"], [3300, 0, 3400, 800, "lift"]],
		[[900, 0, 1100, 999, "float"], [1500, -50, 1700, 150, "wind"], [2140, -400, 2240, -300, "chimney"],
			[2700, -900, 2900, -600, "platform"], [3000, -1100, 3160, -800, "second_wind"], [3250, -1400, 3330, -1000, "gate"]],
	][index]
	for sight: Array in sights:
		var name := "level_%d_%s" % [index + 1, sight[4]]
		if not _seen.has(name) and Rect2(sight[0], sight[1], sight[2] - sight[0], sight[3] - sight[1]).has_point(place):
			_seen[name] = true
			await _picture("level_%d_%02d_%s" % [index + 1, _seen.size(), sight[4]]) # in this order by name, too


func _look_at_the_end() -> void:
	var game := current_scene as Game
	await _ticks(40)
	check(game._win.visible, "the win screen is there")
	await _picture("9_win")
	check(game.stars >= 12 and game.stars <= game.stars_possible,
			"the route brings home at least 12 stars; it is %d of %d" % [game.stars, game.stars_possible])
	check(Settings.best_time > 0 and is_equal_approx(Settings.best_time, game.time), "the time is kept as the best")
	Settings.best_time = 0
	Settings.read()
	check(is_equal_approx(Settings.best_time, game.time), "the best time can be read from the file")
	print("won in %.1f s with %d of %d stars" % [game.time, game.stars, game.stars_possible])
	await _tap(KEY_DOWN)
	await _tap(KEY_ENTER)
	await _ticks(10)
	check(current_scene.scene_file_path == Entries.MENU, "the win screen leads to the menu")


func check_quietly(condition: bool, claim: String) -> bool:
	return condition or check(false, claim)


## Keys come between frames, as the engine gives them out: pausing in one half of a frame and going on in the other would
## confuse the physics server.
func _tap(key: Key) -> void:
	await process_frame
	_hands.tap_key(key)
	await _ticks(2)


func _tap_pad(button: JoyButton) -> void:
	await process_frame
	_hands.tap_pad(button)
	await _ticks(2)


func _ticks(count: int) -> void:
	for i in count:
		await physics_frame


## Rendering is most of the work where there is no graphics card, so it is on only while pictures are taken.
func _draw(on: bool) -> void:
	RenderingServer.render_loop_enabled = on


func _picture(name: String) -> void:
	if _pictures == "" or DisplayServer.get_name() == "headless":
		return
	_draw(true)
	for i in 2: # bodies that come into view are brought up to date for the second frame
		await RenderingServer.frame_post_draw
	var error := root.get_texture().get_image().save_png(_pictures.path_join(name + ".png"))
	check(error == OK, "the picture %s is saved" % name)
	_draw(false)
