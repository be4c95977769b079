# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Soft bodies under characters: landing, standing, being carried and thrown, by the script of Godot's own template.

## Largest difference from what a rigid body of the same mass does, as a share of that.
const LIKE_RIGID := 0.12


func time_limit() -> int:
	return 20000


## The script of Godot's template for CharacterBody2D, with input replaced by members. It knows nothing of soft bodies.
class Player extends CharacterBody2D:
	var speed := 0.0
	var jump := false
	var ticks_on_floor := 0
	var ticks := 0
	var is_new := true

	func _init(size: Vector2) -> void:
		var shape := RectangleShape2D.new()
		shape.size = size
		var collision := CollisionShape2D.new()
		collision.shape = shape
		add_child(collision)

	func _physics_process(delta: float) -> void:
		if is_new: # a physics server on a thread of its own does not know it yet
			is_new = false
			return
		if not is_on_floor():
			velocity += get_gravity() * delta
		if jump and is_on_floor():
			velocity.y = -400.0
			jump = false
		if speed != 0.0:
			velocity.x = speed
		else:
			velocity.x = move_toward(velocity.x, 0, 300.0)
		move_and_slide()
		ticks += 1
		ticks_on_floor += int(is_on_floor())


func _add_player(position: Vector2, size := Vector2(30, 50)) -> Player:
	var player := Player.new(size)
	player.position = position
	stage.add_child(player)
	return player


func _add_crate(position: Vector2, size := Vector2(30, 50), mass := 1.0) -> RigidBody2D:
	var crate := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(size.x, size.y)
	crate.add_child(collision)
	crate.mass = mass
	crate.lock_rotation = true
	crate.position = position
	stage.add_child(crate)
	return crate


## A jelly 200 px wide and 80 high whose upper side is at y = -80, at rest on a floor at y = 0.
func _add_cushion(x := 0.0) -> SoftBody2D:
	return add_body(Vector2(x, -40), { "polygon": SoftBody2D.make_box_polygon(Vector2(200, 80), 20), "mass": 1.0 })


## A plank 240 px wide and 30 high around `position`, pinned at both ends, to a node if there is one.
func _add_trampoline(position: Vector2, holder: Node2D = null) -> SoftBody2D:
	var plank := add_body(position, { "polygon": SoftBody2D.make_box_polygon(Vector2(240, 30), 20), "youngs_modulus": 3000.0, "damping_ratio": 0.05 })
	for i in plank.polygon.size():
		if absf(plank.polygon[i].x) > 119:
			plank.set_point_pinned(i, true, plank.get_path_to(holder) if holder != null else NodePath())
	return plank


## How deep the soles of what falls from `drop` px above `top` get, as a share of `height`; and how high they rise after that [px].
func _fall(what: Node2D, top: float, height: float, duration := 2.5, drop := 400.0) -> Dictionary:
	what.position.y = top - drop - 25
	var lowest := -INF
	var highest := INF
	var landed := false
	for i in roundi(duration * Engine.physics_ticks_per_second):
		await ticks(1)
		var sole := what.position.y + 25
		landed = landed or sole > top - 2
		if landed and sole > lowest:
			lowest = sole
			highest = sole
		highest = minf(highest, sole)
	return { "squash": (lowest - top) / height, "rise": top - highest }


func _clear() -> void:
	for node in stage.get_children():
		node.free()
	await ticks(2)


func test_a_character_squashes_a_jelly_as_a_rigid_body_of_its_mass_does() -> void:
	for rate: int in [60, 30, 120, 240]:
		Engine.physics_ticks_per_second = rate
		for kind: String in ["ball", "cushion"]:
			var found := {}
			for faller: String in ["crate", "player"]:
				add_floor(0)
				var body := _add_cushion() if kind == "cushion" else add_body(Vector2(0, -50))
				await seconds(2)
				var top := bounds_of(polygon_of(body)).position.y
				var what: Node2D = _add_crate(Vector2(0, top - 425)) if faller == "crate" else _add_player(Vector2(0, top - 425))
				found[faller] = await _fall(what, top, -top)
				await _clear()
			_check_like_rigid(found, "on a %s at %d ticks" % [kind, rate])
			check_above(found["player"]["squash"], 0.28, "squash of a %s at %d ticks" % [kind, rate])


## A character that turned round within a tick stood in one place for that tick, lost the floor and was thrown up twice or thrice:
## from two of nineteen heights between 260 and 520 px.
func test_a_character_is_thrown_as_a_rigid_body_from_any_height() -> void:
	for drop in range(380, 440, 5):
		var found := {}
		for faller: String in ["crate", "player"]:
			add_floor(0)
			var body := _add_cushion()
			await seconds(2)
			var top := bounds_of(polygon_of(body)).position.y
			var what: Node2D = _add_crate(Vector2(0, top - drop - 25)) if faller == "crate" else _add_player(Vector2(0, top - drop - 25))
			found[faller] = await _fall(what, top, -top, 2.5, drop)
			await _clear()
		_check_like_rigid(found, "from %d px" % drop)


func _check_like_rigid(found: Dictionary, what: String) -> void:
	for value: String in ["squash", "rise"]:
		var expected: float = found["crate"][value]
		check_near(found["player"][value], expected, LIKE_RIGID * absf(expected) + 0.01, "%s %s" % [value, what])


## Ten seconds on the floor: nothing trembles, and a jump works.
func test_a_character_stands_still_on_jelly_and_jumps() -> void:
	for rate: int in [60, 30, 120, 240]:
		Engine.physics_ticks_per_second = rate
		add_floor(0)
		var body := _add_cushion()
		await seconds(2)
		var top := bounds_of(polygon_of(body)).position.y
		var player := _add_player(Vector2(0, top - 60))
		await seconds(3)
		player.ticks = 0
		player.ticks_on_floor = 0
		var box := Rect2(player.position, Vector2.ZERO)
		var fastest := 0.0
		for i in 10 * rate:
			await ticks(1)
			box = box.expand(player.position)
			fastest = maxf(fastest, player.get_platform_velocity().length())
		check_equal(player.ticks_on_floor, player.ticks, "ticks on the floor at %d ticks" % rate)
		check_below(fastest, 5, "velocity of the platform at %d ticks" % rate)
		check_below(box.size.y, 0.5, "tremble up and down at %d ticks" % rate)
		check_below(box.size.x, 0.5, "tremble sideways at %d ticks" % rate)
		check_above(player.position.y + 25, top + 1, "soles, which press the top in, at %d ticks" % rate)
		var start := player.position.y
		player.jump = true
		var highest := start
		for i in rate:
			await ticks(1)
			highest = minf(highest, player.position.y)
		check_near(start - highest, 400.0 * 400 / (2 * GRAVITY), 15, "height of a jump at %d ticks" % rate)
		await _clear()


func test_a_jelly_under_a_character_that_stands_falls_asleep_and_wakes() -> void:
	add_floor(0)
	var body := _add_cushion()
	await seconds(2)
	var player := _add_player(Vector2(0, -140))
	await seconds(8)
	check(body.sleeping, "the jelly does not sleep")
	var level := player.position.y
	await seconds(5)
	check(body.sleeping, "the jelly does not sleep five seconds later")
	check_near(player.position.y, level, 0.1, "y of the character")
	check(player.is_on_floor(), "the character is not on the floor")
	player.speed = 100
	await seconds(0.3)
	player.speed = 0
	check(not body.sleeping, "the jelly sleeps though the character has walked")
	await seconds(8)
	check(body.sleeping, "the jelly does not sleep after the walk")
	var ball := _add_crate(Vector2(-70, -200), Vector2(20, 20), 2.0)
	await seconds(1)
	check(not body.sleeping, "the jelly sleeps though something has fallen onto it")
	ball.free()
	player.free()
	await seconds(6)
	check_near(bounds_of(polygon_of(body)).position.y, -80.0, 2, "top of the jelly after all have gone")


func test_a_trampoline_throws_a_character_as_it_throws_a_rigid_body() -> void:
	for rate: int in [240, 120, 60, 30]:
		Engine.physics_ticks_per_second = rate
		var found := {}
		for faller: String in ["crate", "player"]:
			var plank := _add_trampoline(Vector2(0, 0))
			await seconds(2)
			var top := bounds_of(polygon_of(plank)).get_center().y - 15
			var what: Node2D = _add_crate(Vector2(0, top - 425)) if faller == "crate" else _add_player(Vector2(0, top - 425))
			found[faller] = await _fall(what, top, 30)
			check_below(absf(what.position.x), 20, "way of the %s to the side at %d ticks" % [faller, rate])
			if faller == "player":
				await seconds(12)
				check((what as Player).is_on_floor(), "the character does not rest on the trampoline at %d ticks" % rate)
			await _clear()
		_check_like_rigid(found, "of a trampoline at %d ticks" % rate)
		check_above(found["player"]["rise"], 40, "rise above the trampoline at %d ticks" % rate)


## A plank on a lift that goes to the right and up.
func test_a_soft_platform_carries_a_character() -> void:
	for rate: int in [60, 30, 120, 240]:
		Engine.physics_ticks_per_second = rate
		var lift := AnimatableBody2D.new()
		lift.sync_to_physics = false
		stage.add_child(lift)
		var plank := _add_trampoline(Vector2(0, 0), lift)
		await seconds(1)
		var player := _add_player(Vector2(0, -80))
		await seconds(4)
		var start := player.position - lift.position
		player.ticks = 0
		player.ticks_on_floor = 0
		var worst := Vector2.ZERO
		for i in 3 * rate:
			lift.position += Vector2(120, -60) / rate
			await ticks(1)
			worst = worst.max((player.position - lift.position - start).abs())
		check_below(worst.x, 12, "way of the character along its platform at %d ticks" % rate)
		check_below(worst.y, 30, "way of the character up and down with its platform, which swings, at %d ticks" % rate)
		check_above(player.ticks_on_floor, 0.95 * player.ticks, "ticks on the floor at %d ticks" % rate)
		await _clear()


func test_a_character_walks_over_jellies() -> void:
	add_floor(0)
	for i in 3:
		_add_cushion(210.0 * i)
	await seconds(2)
	var player := _add_player(Vector2(-60, -140))
	await seconds(2)
	player.speed = 150
	var deepest := -INF
	for i in 180:
		await ticks(1)
		deepest = maxf(deepest, player.position.y + 25)
	player.speed = 0
	check_above(player.position.x, 300, "x of the character that walks over three jellies")
	check_below(deepest, -20, "deepest place of its soles")


## A character of another mass, and one without.
func test_the_mass_of_a_character_is_chosen() -> void:
	var squashes := {}
	for mass: float in [0.0, 0.25, 1.0, 3.0]:
		add_floor(0)
		var body := _add_cushion()
		await seconds(2)
		var top := bounds_of(polygon_of(body)).position.y
		var player := _add_player(Vector2(0, top - 425))
		if mass != 1.0:
			player.set_meta("soft_body_mass", mass)
		squashes[mass] = (await _fall(player, top, -top))["squash"]
		await _clear()
	check_below(squashes[0.0], 0.1, "squash by a character without mass")
	check_above(squashes[1.0], 1.5 * squashes[0.25], "squash by 1 kg over that by 0.25 kg")
	check_above(squashes[3.0], 1.2 * squashes[1.0], "squash by 3 kg over that by 1 kg")


func test_two_characters_stand_on_one_jelly() -> void:
	add_floor(0)
	var body := _add_cushion()
	await seconds(2)
	var players: Array[Player] = [_add_player(Vector2(-60, -160)), _add_player(Vector2(60, -300))]
	await seconds(5)
	for player in players:
		player.ticks = 0
		player.ticks_on_floor = 0
	var boxes := [Rect2(players[0].position, Vector2.ZERO), Rect2(players[1].position, Vector2.ZERO)]
	for i in 120:
		await ticks(1)
		for k in 2:
			boxes[k] = (boxes[k] as Rect2).expand(players[k].position)
	for k in 2:
		check_equal(players[k].ticks_on_floor, players[k].ticks, "ticks on the floor")
		check_below((boxes[k] as Rect2).size.y, 0.5, "tremble up and down")
	check_near(players[0].position.y, players[1].position.y, 3, "where they stand")


func test_five_characters_stand_on_one_jelly() -> void:
	add_floor(0)
	add_body(Vector2(0, -40), { "polygon": SoftBody2D.make_box_polygon(Vector2(500, 80), 20), "mass": 5.0 })
	await seconds(2)
	var players: Array[Player] = []
	for i in 5:
		players.append(_add_player(Vector2(-180 + 90 * i, -160 - 60 * i)))
	await seconds(6)
	var levels := players.map(func(player: Player) -> float: return player.position.y)
	for player in players:
		player.ticks = 0
		player.ticks_on_floor = 0
	await seconds(2)
	for i in 5:
		check_equal(players[i].ticks_on_floor, players[i].ticks, "ticks on the floor of character %d" % i)
		check_near(players[i].position.y, levels[i], 0.3, "y of character %d" % i)


func test_a_character_stands_with_any_safe_margin() -> void:
	for margin: float in [0.001, 0.08, 1.0]:
		add_floor(0)
		_add_cushion()
		await seconds(2)
		var player := _add_player(Vector2(0, -150))
		player.safe_margin = margin
		await seconds(5)
		var level := player.position.y
		player.ticks = 0
		player.ticks_on_floor = 0
		await seconds(2)
		check_equal(player.ticks_on_floor, player.ticks, "ticks on the floor with a safe margin of %s" % margin)
		check_near(player.position.y, level, 0.1, "y with a safe margin of %s" % margin)
		check_near(player.position.y + 25, -77.5, 1.5, "soles with a safe margin of %s" % margin)
		await _clear()


## The engine pulls a character down to floors that are no farther than this length.
func test_a_long_floor_snap_does_not_hold_what_is_thrown() -> void:
	for snap: float in [0.0, 32.0]:
		var found := {}
		for faller: String in ["crate", "player"]:
			var plank := _add_trampoline(Vector2.ZERO)
			await seconds(2)
			var top := bounds_of(polygon_of(plank)).get_center().y - 15
			var what: Node2D = _add_crate(Vector2(0, top - 425)) if faller == "crate" else _add_player(Vector2(0, top - 425))
			if faller == "player":
				what.floor_snap_length = snap
			found[faller] = await _fall(what, top, 30)
			await _clear()
		_check_like_rigid(found, "of a trampoline with a snap length of %s" % snap)


## From 3,000 px it goes down to the floor as a rigid body does. It is not stuck there.
func test_a_character_that_falls_from_high_up_walks_out_of_the_jelly() -> void:
	for rate: int in [60, 30, 240]:
		Engine.physics_ticks_per_second = rate
		add_floor(0)
		_add_cushion()
		await seconds(2)
		var player := _add_player(Vector2(10, -3080))
		await seconds(6)
		check_below(player.position.y + 25, 1, "y of the soles at %d ticks" % rate)
		check(player.is_on_floor(), "not on the floor at %d ticks" % rate)
		player.speed = 200
		await seconds(2)
		check_above(player.position.x, 200, "x of the character that walks off at %d ticks" % rate)
		await _clear()


## The shapes of the jelly change under the character. Areas see neither body come or go by that.
func test_areas_see_a_jelly_under_a_character_all_the_time() -> void:
	add_floor(0)
	var body := _add_cushion()
	await seconds(2)
	var changes := [0]
	for place: Vector2 in [Vector2(-80, -60), Vector2(0, -70), Vector2(80, -20), Vector2(0, -20)]:
		var area := Area2D.new()
		var collision := CollisionShape2D.new()
		collision.shape = rectangle(10, 10)
		area.add_child(collision)
		area.position = place
		area.body_entered.connect(func(other: Node) -> void: changes[0] += int(other == body))
		area.body_exited.connect(func(other: Node) -> void: changes[0] += int(other == body))
		stage.add_child(area)
	await seconds(1)
	check_equal(changes[0], 4, "areas that the jelly has entered")
	var player := _add_player(Vector2(-60, -250))
	await seconds(3)
	for speed: float in [60.0, -60.0]:
		player.speed = speed
		await seconds(1.5)
	player.speed = 0
	player.jump = true
	await seconds(2)
	player.free()
	await seconds(2)
	check_equal(changes[0], 4, "times that the jelly has entered or left areas")


## Onto a slime that moves: the character stays on it.
func test_a_character_rides_on_a_slime_that_is_pushed() -> void:
	add_floor(0)
	var slime := _add_cushion()
	slime.physics_material_override = surface(0.0)
	await seconds(2)
	var player := _add_player(Vector2(0, -160))
	await seconds(4)
	var gap := player.position.x - slime.position.x
	slime.apply_central_impulse(Vector2(100, 0) * slime.mass)
	await seconds(2)
	check_above(slime.position.x, 120, "x of the slime")
	check_near(player.position.x - slime.position.x, gap, 10, "where the character stands on it")
	check(player.is_on_floor(), "the character is not on the floor")


func test_time_scale_changes_nothing_but_the_step() -> void:
	for scale: float in [0.1, 0.5, 3.0]:
		var found := {}
		for faller: String in ["crate", "player"]:
			Engine.time_scale = 1
			add_floor(0)
			var body := _add_cushion()
			await seconds(2)
			var top := bounds_of(polygon_of(body)).position.y
			var what: Node2D = _add_crate(Vector2(0, top - 425)) if faller == "crate" else _add_player(Vector2(0, top - 425))
			Engine.time_scale = scale
			found[faller] = await _fall(what, top, -top, 2.5 / scale)
			await _clear()
		_check_like_rigid(found, "at a time scale of %s" % scale)
