# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What the miniatures promise: cells swallow and flee, wrestlers stand, grab and fall, cars keep their dents, fruit is cut.

const Cell := preload("res://miniatures/petri_cell.gd")
const Wrestler := preload("res://miniatures/wrestler.gd")
const Car := preload("res://miniatures/car.gd")
const Fruit := preload("res://miniatures/fruit.gd")
const Slicing := preload("res://miniatures/slicing.gd")


func _open(name: String) -> Node2D:
	var scene := (load("res://miniatures/%s.tscn" % name) as PackedScene).instantiate() as Node2D
	stage.add_child(scene)
	return scene


## A dish with nothing in it but the player in the middle and one other cell.
func _open_dish(other_radius: float, offset: Vector2) -> Array:
	var dish := _open("petri_dish")
	(dish.get(&"crumbs") as PackedVector2Array).clear()
	dish.set(&"crumbs", PackedVector2Array())
	var player: Cell = dish.get(&"player")
	for cell: Cell in dish.call(&"get_cells"):
		if cell != player:
			cell.free()
	var other: Cell = dish.call(&"_add_cell", offset, other_radius, Color.RED)
	return [dish, player, other]


func test_a_cell_grows_by_what_it_swallows() -> void:
	var parts := _open_dish(18, Vector2(150, 0))
	var player: Cell = parts[1]
	var prey: Cell = parts[2]
	prey.vigour = 0 # it would be faster
	await ticks(2)
	var expected := player.get_area() + prey.get_area()
	Input.action_press(&"ui_right")
	var waited := 0
	while is_instance_valid(prey) and waited < 600:
		await ticks(1)
		waited += 1
	Input.action_release(&"ui_right")
	check(not is_instance_valid(prey), "the prey is still there after 10 s")
	await seconds(2)
	# All that the prey's polygon enclosed is handed over.
	check_near(player.get_rest_area(), expected, 0.002 * expected, "rest area after the meal")
	# A membrane under pressure swims at a few thousandths above or below its rest area.
	check_near(player.get_area(), expected, 0.03 * expected, "area after the meal")
	check_equal((parts[0].call(&"get_cells") as Array).size(), 1, "number of cells left")


func test_cells_of_one_size_do_not_swallow_each_other() -> void:
	var parts := _open_dish(34, Vector2(90, 0))
	(parts[2] as Cell).vigour = 0
	Input.action_press(&"ui_right")
	await seconds(3)
	Input.action_release(&"ui_right")
	check_equal((parts[0].call(&"get_cells") as Array).size(), 2, "number of cells")
	check_above((parts[2] as Cell).get_center_of_mass_position().x, 120, "way of the cell that was pushed")


func test_a_small_cell_flees() -> void:
	var parts := _open_dish(18, Vector2(110, 0))
	await seconds(1.5)
	check_above((parts[2] as Cell).get_center_of_mass_position().x, 200, "way of the small cell")


func test_a_cell_presses_itself_flat_at_the_wall() -> void:
	var parts := _open_dish(18, Vector2(-500, 0))
	var player: Cell = parts[1]
	Input.action_press(&"ui_right")
	await seconds(5)
	Input.action_release(&"ui_right")
	var box := bounds_of(polygon_of(player))
	check_below(box.size.x / box.size.y, 0.95, "width over height of the cell at the wall")
	# The wall's polygon has its edges' middles at 640 cos(π/64) = 639.2 from the center.
	check_near(box.end.x, 640.0, 2, "right end of the cell at the wall")
	check_near(player.get_area() / player.get_rest_area(), 1.0, 0.1, "area over rest area")


func test_a_dish_can_be_started_anew() -> void:
	var dish := _open("petri_dish")
	var count: int = (dish.call(&"get_cells") as Array).size()
	await seconds(1)
	var key := InputEventKey.new()
	key.keycode = KEY_R
	key.pressed = true
	tree.root.push_input(key)
	await ticks(3)
	check_equal((dish.call(&"get_cells") as Array).size(), count, "number of cells")
	check_equal(SoftBodySimulation2D.get_body_count(), count, "bodies in the simulation")


func test_a_wrestler_stands_by_itself() -> void:
	var ring := _open("jelly_wrestlers")
	var player: Wrestler = ring.get(&"player")
	ring.set_physics_process(false)
	(ring.get(&"rival") as Wrestler).walk = 0
	await seconds(5)
	check_near(player.get_place(), Vector2(480, 380), 40, "place of the wrestler after 5 s")
	check_below(absf(player.torso.rotation), 0.2, "lean of the wrestler")
	check(player.is_standing(), "no leg stands on anything")


func test_a_wrestler_that_is_pushed_falls_and_loses_the_round() -> void:
	var ring := _open("jelly_wrestlers")
	var rival: Wrestler = ring.get(&"rival")
	await ticks(2) # the joints take hold where the parts are then
	for part in rival.parts:
		part.teleport(part.global_transform.translated(Vector2(110, 0)))
	var player: Wrestler = ring.get(&"player")
	for part in player.parts:
		part.teleport(part.global_transform.translated(Vector2(320, 0)))
	Input.action_press(&"ui_right")
	var waited := 0
	while is_instance_valid(rival) and rival.get_place().y < 820 and waited < 600:
		await ticks(1)
		waited += 1
		if player.get_place().x > 950: # it need not follow
			Input.action_release(&"ui_right")
	Input.action_release(&"ui_right")
	await ticks(2)
	check_below(waited, 600, "ticks until the rival has fallen")
	check_equal(ring.get(&"_score"), [1, 0], "score")
	await seconds(3)
	check_below((ring.get(&"rival") as Wrestler).get_place().y, 500, "the rival in the next round")


func test_a_grip_drags_whom_it_holds() -> void:
	var ring := _open("jelly_wrestlers")
	ring.set_physics_process(false)
	var player: Wrestler = ring.get(&"player")
	var rival: Wrestler = ring.get(&"rival")
	await ticks(2)
	for part in rival.parts:
		part.teleport(part.global_transform.translated(Vector2(-230, 0)))
	await seconds(1)
	check(not player.is_holding(), "held before it grabbed")
	player.grabs = true
	await seconds(1)
	check(player.is_holding(), "holds nothing")
	var start := rival.get_place().x
	player.walk = -1
	await seconds(1.5)
	# One that is not held goes 5 px, pushed by an arm that turns.
	check_below(rival.get_place().x, start - 40, "way of the one who is held")
	player.grabs = false
	await ticks(3)
	check(not player.is_holding(), "still holds")


## Drives a car into the wall, waits until it has come to rest, and gives its length over that before.
func _crash(is_metal: bool) -> float:
	var road := _open("crash")
	for other: Car in road.get(&"others"):
		other.free()
	road.set_physics_process(false)
	var car: Car = road.get(&"player")
	car.is_metal = is_metal
	await seconds(1)
	var before := car.get_length()
	car.throttle = 1
	var fastest := 0.0
	for i in 400:
		await ticks(1)
		fastest = maxf(fastest, car.body.linear_velocity.length())
		if car.get_place().x > 2560:
			break
	car.throttle = 0
	check_above(fastest, 700, "speed before the crash")
	await seconds(3)
	check_below(car.body.linear_velocity.length(), 100, "speed after the crash")
	var share := car.get_length() / before
	road.free()
	await ticks(2)
	return share


func test_a_car_is_shorter_after_a_crash() -> void:
	check_below(await _crash(true), 0.93, "length after the crash over that before")


func test_a_car_that_is_not_of_metal_springs_back() -> void:
	check_near(await _crash(false), 1.0, 0.02, "length after the crash over that before")


func test_a_car_that_only_drives_gets_no_dents() -> void:
	var road := _open("crash")
	var car: Car = road.get(&"player")
	await seconds(1)
	Input.action_press(&"ui_right")
	await seconds(1)
	Input.action_release(&"ui_right")
	check_above(car.get_place().x, 100, "way of the car")
	check_equal(car.body.get_dent(), 0.0, "dent")


func test_cars_that_meet_head_on_lose_parts() -> void:
	var road := _open("crash")
	await seconds(0.5)
	Input.action_press(&"ui_right")
	await seconds(6)
	Input.action_release(&"ui_right")
	var bodies := 0
	for car: Car in [road.get(&"player")] + road.get(&"others"):
		for body: SoftBody2D in car.find_children("*", "SoftBody2D", true, false):
			bodies += 1
	check_above(bodies, 9, "bodies, of which the cars have nine while they are whole")


## A game that throws nothing by itself.
func _open_slicing() -> Slicing:
	var game := _open("slicing") as Slicing
	game.set(&"_pause", INF)
	return game


## A fruit or stone that hangs in the air.
func _hang(game: Slicing, is_stone := false, place := Vector2(640, 360)) -> SoftBody2D:
	var fruit := game.throw_fruit(is_stone)
	fruit.position = place
	fruit.linear_velocity = Vector2.ZERO
	fruit.angular_velocity = 0
	fruit.gravity_scale = 0
	return fruit


func _mouse(at: Vector2, pressed: bool, changed: bool) -> void:
	var event: InputEventMouse
	if changed:
		var button := InputEventMouseButton.new()
		button.button_index = MOUSE_BUTTON_LEFT
		button.pressed = pressed
		event = button
	else:
		event = InputEventMouseMotion.new()
	event.position = at
	stage.get_viewport().push_input(event, true)


func _swipe(from: Vector2, to: Vector2) -> void:
	_mouse(from, true, true)
	for i in 6:
		_mouse(from.lerp(to, (i + 1) / 6.0), true, false)
		await ticks(1)
	_mouse(to, false, true)


func test_a_swipe_with_the_mouse_cuts_a_fruit_and_scores() -> void:
	var game := _open_slicing()
	_hang(game)
	await ticks(2)
	await _swipe(Vector2(500, 350), Vector2(780, 370))
	check_equal(game.score, 1, "points")
	check_equal(game.get_thrown().size(), 2, "pieces")
	check_equal(game.hearts, Slicing.HEARTS, "hearts")
	await _swipe(Vector2(640, 200), Vector2(640, 560)) # both halves
	check_above(game.score, 2, "points after another swipe")


func test_the_blade_of_stick_and_keys_cuts() -> void:
	var game := _open_slicing()
	_hang(game)
	game.hand = Vector2(480, 362)
	Input.action_press(&"ui_accept")
	Input.action_press(&"ui_right")
	await ticks(14)
	Input.action_release(&"ui_right")
	Input.action_release(&"ui_accept")
	check_equal(game.score, 1, "points")


func test_a_stone_and_what_falls_whole_cost_hearts_and_pieces_do_not() -> void:
	var game := _open_slicing()
	_hang(game, true)
	await ticks(2)
	await _swipe(Vector2(500, 350), Vector2(780, 370))
	check_equal(game.hearts, Slicing.HEARTS - 1, "hearts after a stone was hit")
	check_equal(game.score, 0, "points")
	for body in game.get_thrown():
		body.gravity_scale = 1
	await seconds(2)
	check_equal(game.get_thrown().size(), 0, "bodies in the air")
	check_equal(game.hearts, Slicing.HEARTS - 1, "hearts after the stone's pieces fell")
	var fruit := _hang(game)
	fruit.gravity_scale = 1
	await seconds(2)
	check_equal(game.hearts, Slicing.HEARTS - 2, "hearts after a fruit fell")
	_hang(game).gravity_scale = 1
	await seconds(2)
	check_equal(game.state, Slicing.State.LOST, "state")
	game.restart()
	check_equal(game.state, Slicing.State.PLAYING, "state of a new game")
	check_equal(game.hearts, Slicing.HEARTS, "hearts of a new game")


## Chases what flies, as the game throws it, and leads no blade past a stone.
func test_a_player_who_hits_every_fruit_wins() -> void:
	var game := _open("slicing") as Slicing
	(game.get(&"_random") as RandomNumberGenerator).seed = 0
	var waited := 0
	while game.state == Slicing.State.PLAYING and waited < 2700:
		await ticks(1)
		waited += 1
		var way := _way_through_a_fruit(game)
		if not way.is_empty():
			await _swipe(way[0], way[1])
			waited += 6
	check_equal(game.state, Slicing.State.WON, "state after %d ticks, with %d points and %d hearts" % [waited, game.score, game.hearts])


func _way_through_a_fruit(game: Slicing) -> PackedVector2Array:
	var stones := game.get_thrown().filter(func(body: SoftBody2D) -> bool: return body.is_in_group(Fruit.STONES))
	for body in game.get_thrown():
		var place := body.get_center_of_mass_position() + body.linear_velocity * 0.05
		if body in stones or not body.is_in_group(Fruit.WHOLE) or place.y > 620:
			continue
		for direction: Vector2 in [Vector2(160, 0), Vector2(0, 160), Vector2(113, 113), Vector2(113, -113)]:
			var is_free := func(stone: SoftBody2D) -> bool:
				var there := stone.get_center_of_mass_position()
				return there.distance_to(Geometry2D.get_closest_point_to_segment(there, place - direction, place + direction)) > 110
			if stones.all(is_free):
				return [place - direction, place + direction]
	return []
