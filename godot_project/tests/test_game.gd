# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The player of the game and the things it meets: each does what a level counts on. The levels themselves are played by
## tests/play/play_game.gd.

const Player := preload("res://game/player/player.gd")
const Level := preload("res://game/levels/level.gd")
const Ground := preload("res://game/world/ground.gd")
const Star := preload("res://game/world/star.gd")
const Thorns := preload("res://game/world/thorns.gd")
const Wind := preload("res://game/world/wind.gd")
const Platform := preload("res://game/world/platform.gd")
const Bridge := preload("res://game/world/bridge.gd")
const Cushion := preload("res://game/world/cushion.gd")
const Sounds := preload("res://game/audio/sounds.gd")
const Synth := preload("res://game/audio/synth.gd")
const Settings := preload("res://game/settings.gd")
const Glyphs := preload("res://game/glyphs.gd")

const ACTIONS: Array[StringName] = [&"game_left", &"game_right", &"game_jump", &"game_deflate", &"game_inflate"]


func tear_down() -> void:
	_release()
	await super()


func _release() -> void:
	for action in ACTIONS:
		Input.action_release(action)


func _add_player(place: Vector2) -> Player:
	var player: Player = (load("res://game/player/player.tscn") as PackedScene).instantiate()
	player.position = place
	stage.add_child(player)
	return player


func _bounds(player: Player) -> Rect2:
	return bounds_of(polygon_of(player))


## Ground whose outline is given, as levels have it.
func _add_ground(outline: PackedVector2Array) -> Ground:
	var ground := Ground.new()
	var area := CollisionPolygon2D.new()
	area.polygon = outline
	ground.add_child(area)
	stage.add_child(ground)
	return ground


func _grip(body: StaticBody2D) -> void:
	body.physics_material_override = PhysicsMaterial.new()


func test_it_rolls_both_ways_and_stops() -> void:
	_grip(add_floor(100))
	var player := _add_player(Vector2(0, 50))
	await seconds(0.5)
	for side: float in [1.0, -1.0]:
		var start := player.global_position.x
		var angle := player.rotation
		Input.action_press(&"game_right" if side > 0 else &"game_left")
		await seconds(0.6)
		check_above(side * player.linear_velocity.x, 250, "speed after 0.6 s")
		check_above(side * player.angular_velocity, 5, "spin while rolling")
		check_above(side * (player.global_position.x - start), 80, "way in 0.6 s")
		check(angle != player.rotation, "it slides and does not roll")
		_release()
		await seconds(1)
		check_below(absf(player.linear_velocity.x), 15, "speed a second after the key was let go")


func test_it_jumps_higher_the_longer_the_key_is_held() -> void:
	_grip(add_floor(100))
	var player := _add_player(Vector2(0, 50))
	var heights := PackedFloat32Array()
	for held in [4, 40]:
		await seconds(1)
		var from := player.get_center_of_mass_position().y
		var top := from
		Input.action_press(&"game_jump")
		for i in 60:
			await ticks(1)
			if i == held:
				_release()
			top = minf(top, player.get_center_of_mass_position().y)
		heights.append(from - top)
	# v²/2g with 640 px/s and 1.3 g is 161 px; the skin that pushes off and the drag change it by a tenth.
	check_near(heights[1], 161, 20, "height of a full jump")
	check_below(heights[0], 0.7 * heights[1], "height of a short jump")


func test_a_jump_counts_a_moment_after_the_edge_and_a_moment_before_the_ground() -> void:
	_grip(add_solid(rectangle(400, 40), Transform2D(0, Vector2(0, 120))))
	var player := _add_player(Vector2(0, 50))
	await seconds(0.5)
	# Off the edge, then the key.
	player.place_at(Vector2(150, 50))
	await seconds(0.4)
	Input.action_press(&"game_right")
	while player.is_on_ground() or player.global_position.x < 200:
		await ticks(1)
	await ticks(3)
	Input.action_press(&"game_jump")
	await ticks(3)
	check_below(player.linear_velocity.y, -300, "speed of a jump three ticks after the edge")
	_release()
	# The key, then the ground.
	player.place_at(Vector2(0, -150))
	while player.linear_velocity.y < 100 or _bounds(player).end.y < 60:
		await ticks(1)
	check(not player.is_on_ground(), "it is in the air as the key is pressed")
	Input.action_press(&"game_jump")
	var fastest := 0.0
	for i in 14:
		await ticks(1)
		fastest = minf(fastest, player.linear_velocity.y)
	check_below(fastest, -300, "speed of a jump asked for before the ground")


func test_only_a_flat_one_fits_under_a_low_ceiling() -> void:
	_grip(add_floor(100))
	add_solid(rectangle(200, 200), Transform2D(0, Vector2(300, 100 - 34 - 100)))
	var player := _add_player(Vector2(0, 50))
	Input.action_press(&"game_right")
	await seconds(2.5)
	check_below(_bounds(player).position.x, 200, "left end of a round one")
	check_below(player.get_center_of_mass_position().x, 210, "place of a round one")
	Input.action_press(&"game_deflate")
	await seconds(2.5)
	check_above(player.get_center_of_mass_position().x, 410, "place of a flat one")
	check_below(player.get_penetration(), 1, "penetration in px")


# Between them a round one lies until it lets its air out, however it gets there and whatever it tries. As the highest quality has it.
func test_the_plugs_of_the_burrow_hold_a_round_one_and_let_a_flat_one_through() -> void:
	var level: Level = (load("res://game/levels/level_2.tscn") as PackedScene).instantiate()
	for ball in level.find_children("Ball*", "", false, false):
		ball.free()
	stage.add_child(level)
	for plug: String in ["Plug", "Plug2"]:
		Settings.apply_to_body(level.get_node(plug))
	var player := _add_player(Vector2(2382, 700))
	for place: float in [2345, 2370, 2395, 2420]:
		player.place_at(Vector2(place, 640))
		for action: StringName in [&"game_right", &"game_left", &"game_jump"]:
			await seconds(1)
			Input.action_press(action)
			await seconds(1)
			_release()
		check_below(player.get_center_of_mass_position().y, 980, "height of a round one dropped at %d" % place)
		Input.action_press(&"game_deflate")
		await seconds(2)
		_release()
		check_above(player.get_center_of_mass_position().y, 980, "height of a flat one dropped at %d" % place)


func test_air_changes_its_size_and_its_fall() -> void:
	var player := _add_player(Vector2.ZERO)
	var areas := PackedFloat32Array()
	var falls := PackedFloat32Array()
	for action: StringName in [&"game_deflate", &"", &"game_inflate"]:
		_release()
		if action != &"":
			Input.action_press(action)
		player.place_at(Vector2.ZERO)
		await seconds(1)
		areas.append(player.get_area())
		falls.append(player.linear_velocity.y)
	# The areas are those that the pressure aims at, less what skin and shape matching pull back.
	check_near(areas[0] / areas[1], Player.INFLATION[0] / Player.INFLATION[1], 0.12, "area flat over round")
	check_near(areas[2] / areas[1], Player.INFLATION[2] / Player.INFLATION[1], 0.2, "area big over round")
	check_above(falls[0], falls[1], "speed of fall flat, and round")
	check_below(falls[2], 200, "speed of fall, big")


func test_it_holds_and_climbs_between_walls_when_it_is_big() -> void:
	for side: float in [-1.0, 1.0]:
		_grip(add_solid(rectangle(100, 1600), Transform2D(0, Vector2(side * (45 + 50), 0))))
	var player := _add_player(Vector2(0, 0))
	Input.action_press(&"game_inflate")
	await seconds(1)
	var place := player.get_center_of_mass_position().y
	await seconds(2)
	check_near(player.get_center_of_mass_position().y, place, 2, "height of a wedged one after two seconds")
	for i in 3: # hop by hop, holding in between
		Input.action_press(&"game_jump")
		await ticks(12)
		Input.action_release(&"game_jump")
		await ticks(20)
	check_below(player.get_center_of_mass_position().y, place - 180, "height after three hops")
	place = player.get_center_of_mass_position().y
	_release()
	await seconds(1)
	check_above(player.get_center_of_mass_position().y, place + 80, "height once the air is out")


func test_it_climbs_between_walls() -> void:
	for side: float in [-1.0, 1.0]:
		_grip(add_solid(rectangle(100, 1600), Transform2D(0, Vector2(side * (46 + 50), 0))))
	_grip(add_floor(780))
	var player := _add_player(Vector2(0, 720))
	await seconds(0.5)
	Input.action_press(&"game_right")
	var away := 0.0
	for i in 12:
		Input.action_press(&"game_jump")
		for k in 18:
			await ticks(1)
			away = minf(away, player.linear_velocity.x)
		Input.action_release(&"game_jump")
		await ticks(4)
	check_below(player.get_center_of_mass_position().y, 300, "height after twelve jumps")
	check_below(away, -150, "speed away from the wall that it jumps off")


func test_it_pops_between_a_press_and_the_floor() -> void:
	_grip(add_floor(100))
	for side: float in [-1.0, 1.0]:
		add_solid(rectangle(100, 600), Transform2D(0, Vector2(side * (60 + 50), 0)))
	var press := AnimatableBody2D.new()
	var shape := CollisionShape2D.new()
	shape.shape = rectangle(118, 100)
	press.add_child(shape)
	press.position = Vector2(0, -100)
	stage.add_child(press)
	var player := _add_player(Vector2(0, 50))
	var crushed := [0]
	player.crushed.connect(func() -> void: crushed[0] += 1)
	await seconds(1)
	check_equal(crushed[0], 0, "times it was crushed before the press came")
	for i in 105:
		press.position.y += 1.4
		await ticks(1)
	check_above(crushed[0], 0, "times it was crushed by the press")


func test_ground_is_whole_under_a_skin() -> void:
	# A hill, a step and a notch: no polygon point may stay inside, whatever rolls over it at whichever size.
	var outline := PackedVector2Array([Vector2(-900, 0)])
	for i in 21:
		outline.append(Vector2(-500 + 20 * i, -90 * sin(PI * i / 20) ** 2))
	outline.append_array([Vector2(100, 0), Vector2(106, -60), Vector2(300, -60), Vector2(306, 0), Vector2(420, 0),
			Vector2(430, 60), Vector2(560, 60), Vector2(570, 0), Vector2(900, 0), Vector2(900, 400), Vector2(-900, 400)])
	_grip(_add_ground(outline))
	var player := _add_player(Vector2(-700, -50))
	var deepest := 0.0
	for round_trip in 3:
		for key: StringName in [&"game_right", &"game_left"]:
			_release()
			Input.action_press(key)
			for i in 260:
				if i % 45 == 0:
					Input.action_press(&"game_jump")
					Input.action_release(&"game_deflate")
				elif i % 45 == 12:
					Input.action_release(&"game_jump")
					Input.action_press(&"game_deflate")
				await ticks(1)
				if i % 4 == 0:
					deepest = maxf(deepest, _depth_inside(polygon_of(player), outline))
	check_below(deepest, 4, "deepest polygon point inside the ground in px")


func _depth_inside(polygon: PackedVector2Array, outline: PackedVector2Array) -> float:
	var deepest := 0.0
	for point in polygon:
		if absf(point.x) < 880 and point.y < 350 and Geometry2D.is_point_in_polygon(point, outline):
			var nearest := INF
			for i in outline.size():
				nearest = minf(nearest, point.distance_to(
						Geometry2D.get_closest_point_to_segment(point, outline[i - 1], outline[i])))
			deepest = maxf(deepest, nearest)
	return deepest


func test_a_star_is_taken_once_and_thorns_hurt() -> void:
	var level := Level.new()
	var spawn := Marker2D.new()
	spawn.name = "Spawn"
	spawn.position = Vector2(7, 8)
	level.add_child(spawn)
	var star: Star = (load("res://game/world/star.tscn") as PackedScene).instantiate()
	star.position = Vector2(0, 100)
	var thorns := Thorns.new()
	thorns.position = Vector2(0, 500)
	var lantern: Area2D = (load("res://game/world/checkpoint.tscn") as PackedScene).instantiate()
	lantern.position = Vector2(0, 400)
	for node: Node2D in [star, thorns, lantern]:
		level.add_child(node)
		node.owner = level
	var told := {"hurt": 0, "taken": 0, "reached": 0}
	level.hurt.connect(func() -> void: told["hurt"] += 1)
	level.star_taken.connect(func() -> void: told["taken"] += 1)
	level.checkpoint_reached.connect(func() -> void: told["reached"] += 1)
	stage.add_child(level)
	check_equal(level.star_count, 1, "stars of the level")
	check_equal(level.get_start(), Vector2(7, 8), "where one begins")
	_add_player(Vector2(0, 0))
	await seconds(1.2)
	check_equal(told, {"hurt": 1, "taken": 1, "reached": 1}, "what the level told")
	check_near(level.get_start(), Vector2(0, 354), 1, "where one begins after the lantern")


func test_wind_carries_who_is_big() -> void:
	var wind := Wind.new()
	wind.extent = Vector2(200, 900)
	wind.strength = 1750
	stage.add_child(wind)
	var player := _add_player(Vector2.ZERO)
	await seconds(0.4)
	check_above(player.linear_velocity.y, 50, "speed of a round one in the wind")
	player.place_at(Vector2(0, 200))
	Input.action_press(&"game_inflate")
	await seconds(1.2)
	check_below(player.linear_velocity.y, -200, "speed of a big one in the wind")


func test_a_cushion_throws_and_a_bridge_holds() -> void:
	var cushion: Cushion = (load("res://game/world/cushion.tscn") as PackedScene).instantiate()
	stage.add_child(cushion)
	var player := _add_player(Vector2(0, -250))
	var fastest := 0.0
	for i in 90:
		await ticks(1)
		fastest = minf(fastest, player.linear_velocity.y)
	check_below(fastest, -0.85 * cushion.throw_speed, "upward speed off the cushion")
	var bridge := Bridge.new()
	bridge.position = Vector2(1000, 0)
	stage.add_child(bridge)
	player.place_at(Vector2(1000, -60))
	await seconds(3)
	check_near(player.get_center_of_mass_position(), Vector2(1000, -20), 50, "place of the jelly on the bridge")
	check_below(absf(player.linear_velocity.y), 20, "its speed")


func test_a_platform_carries() -> void:
	var platform := Platform.new()
	platform.travel = Vector2(300, 0)
	platform.period = 5
	stage.add_child(platform)
	var player := _add_player(Vector2(0, -50))
	await seconds(2.5)
	check_near(player.get_center_of_mass_position().x, 300, 60, "place of the jelly where the platform turns")


func test_nothing_slips_between_the_lift_of_the_burrow_and_its_wall() -> void:
	var level: Level = (load("res://game/levels/level_2.tscn") as PackedScene).instantiate()
	stage.add_child(level)
	var lift := level.get_node(^"Platform") as Platform
	var player := _add_player(lift.position + Vector2(0, -60))
	await seconds(0.3)
	Input.action_press(&"game_right")
	for i in 180: # until just below the top
		await ticks(1)
		check_below(player.get_center_of_mass_position().y, lift.position.y, "height of a jelly that leans on the wall while the lift rises")


func test_it_pushes_a_crate_and_stands_on_it() -> void:
	_grip(add_floor(100))
	var crate: RigidBody2D = (load("res://game/world/crate.tscn") as PackedScene).instantiate()
	crate.position = Vector2(120, 74)
	stage.add_child(crate)
	var player := _add_player(Vector2(0, 50))
	Input.action_press(&"game_right")
	await seconds(1)
	check_above(crate.position.x, 160, "place of the crate after a second of pushing")
	_release()
	await seconds(1)
	player.place_at(crate.position + Vector2(0, -80))
	await seconds(1.5)
	check_below(player.get_center_of_mass_position().y, 50, "height of the jelly on the crate")


func test_it_squishes_the_harder_the_deeper_it_falls() -> void:
	_grip(add_floor(100))
	var player := _add_player(Vector2(0, 60))
	var told: Array[float] = []
	player.landed.connect(func(impulse: float) -> void: told.append(impulse))
	await seconds(2)
	var loudest: Array[float] = []
	for height: float in [100.0, 250.0, 600.0]:
		player.place_at(Vector2(0, 60 - height))
		told.clear()
		await seconds(2)
		loudest.append(told.max() if not told.is_empty() else 0.0)
	check_above(loudest[0], Player.SQUISH_IMPULSE, "impulse after 100 px")
	check_above(loudest[1], 1.2 * loudest[0], "impulse after 250 px")
	check_above(loudest[2], 1.2 * loudest[1], "impulse after 600 px")
	told.clear()
	await seconds(1)
	check_equal(told.size(), 0, "squishes of one at rest")


func test_every_sound_can_be_heard_and_none_is_cut_off() -> void:
	var streams := Sounds.get_streams().duplicate()
	streams[&"music"] = Synth.music()
	for name: StringName in streams:
		var stream := streams[name] as AudioStreamWAV
		var loudest := 0
		var clipped := 0
		for i in range(0, stream.data.size(), 2):
			var sample := absi(stream.data.decode_s16(i))
			loudest = maxi(loudest, sample)
			clipped += int(sample >= 32767)
		check_above(loudest, 3000, "loudest sample of %s" % name)
		check_equal(clipped, 0, "clipped samples of %s" % name)
		if name != &"music":
			check_below(absi(stream.data.decode_s16(stream.data.size() - 2)), 700, "last sample of %s" % name)
	check_equal((streams[&"music"] as AudioStreamWAV).loop_mode, AudioStreamWAV.LOOP_FORWARD, "loop mode of the music")
	await ticks(1)


func test_settings_outlive_the_program_and_survive_nonsense() -> void:
	Settings.path = "user://moonjelly_claims.cfg"
	var kept := [Settings.sound_volume, Settings.quality, Settings.best_time]
	Settings.sound_volume = 0.25
	Settings.quality = Settings.Quality.LOW
	Settings.best_time = 61.5
	Settings.write()
	Settings.sound_volume = 1
	Settings.quality = Settings.Quality.HIGH
	Settings.best_time = 0
	Settings.read()
	check_equal([Settings.sound_volume, Settings.quality, Settings.best_time], [0.25, Settings.Quality.LOW, 61.5], "what was read")
	var file := ConfigFile.new()
	file.set_value("sound", "volume", "loud")
	file.set_value("picture", "quality", 99)
	file.save(Settings.path)
	Settings.read()
	check_equal([Settings.sound_volume, Settings.quality], [0.25, Settings.Quality.HIGH], "what was read from nonsense")
	DirAccess.remove_absolute(ProjectSettings.globalize_path(Settings.path))
	Settings.sound_volume = kept[0]
	Settings.quality = kept[1]
	Settings.best_time = kept[2]
	await ticks(1)


func test_every_action_has_keys_buttons_and_words() -> void:
	for action: StringName in Glyphs.TEXTS:
		if action == &"game_move":
			continue
		var kinds := {}
		for event in InputMap.action_get_events(action):
			kinds["key"] = kinds.has("key") or event is InputEventKey
			kinds["pad"] = kinds.has("pad") or event is InputEventJoypadButton or event is InputEventJoypadMotion
		check(kinds.get("key", false), "%s has no key" % action)
		check(kinds.get("pad", false), "%s has no button of a gamepad" % action)
		for device in 3:
			check((Glyphs.TEXTS[action] as Array)[device] != "", "%s has no words for device %d" % [action, device])
	await ticks(1)
