# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The demo, every example, every miniature and the laboratory run for 300 ticks without a word from the engine.

const EXAMPLES := "res://examples"
const MINIATURES := "res://miniatures"
const LABORATORY := "res://laboratory"
const DEMO := "res://demo/main.tscn"
const Entries := preload("res://game/entries.gd")
const Settings := preload("res://game/settings.gd")
const TICKS := 300
## How far from the origin bodies may be, in scenes larger than a screen [px].
const EXTENTS := {"off_screen": 9000, "crash": 3500, "stress_test": 3500}


## All scenes of a folder run in one test.
func time_limit() -> int:
	return 20000


func _run_scene(path: String) -> void:
	var scene := load(path) as PackedScene
	if not check(scene != null, path + " does not load"):
		return
	take_errors()
	var root := scene.instantiate()
	if &"most_bodies" in root: # the stress test would fill a frame, however fast the machine
		root.set(&"most_bodies", 300)
	stage.add_child(root)
	await ticks(TICKS)
	var bodies := root.find_children("*", "SoftBody2D", true, false)
	var extent: float = EXTENTS.get(path.get_file().get_basename(), 1500)
	check(not bodies.is_empty(), path + " has no soft body")
	for node in bodies:
		var body := node as SoftBody2D
		check_equal(body.get_warnings(), PackedStringArray(), "%s: warnings of %s" % [path, body.name])
		check(body.get_substep_plan()["elastic_reason"] != "network_values", "%s: %s says that it is meant as a network" % [path, body.name])
		check(all_finite(body.get_point_positions()), "%s: a point of %s is not finite" % [path, body.name])
		check_above(body.get_area() / body.get_rest_area(), 0.4, "%s: area of %s over its rest area" % [path, body.name])
		var distance := body.get_center_of_mass_position().length()
		check_below(distance, extent, "%s: distance of %s from the origin" % [path, body.name])
	var captions := root.find_children("Text", "Label", true, false)
	var says := captions.size() == 1 and (captions[0] as Label).text.length() > 30
	check(says or path == DEMO, path + " does not say what to see")
	root.queue_free()
	await ticks(2)
	check_equal(take_errors(), PackedStringArray(), "what the engine says to " + path)


func _run_folder(folder: String) -> int:
	var count := 0
	for file in DirAccess.get_files_at(folder):
		if file.ends_with(".tscn"):
			await _run_scene(folder.path_join(file))
			count += 1
	return count


func test_the_demo_runs() -> void:
	await _run_scene(DEMO)


func test_every_example_runs() -> void:
	check_above(await _run_folder(EXAMPLES), 25, "number of examples")


func test_every_miniature_runs() -> void:
	check_equal(await _run_folder(MINIATURES), 4, "number of miniatures")


func test_the_laboratory_and_the_stress_test_run() -> void:
	check_equal(await _run_folder(LABORATORY), 3, "number of scenes in the laboratory")


## The game's scenes hold the player, which does not move here, and levels stand on their own, too.
func test_every_scene_of_the_game_runs() -> void:
	Settings.path = "user://no_such_settings.cfg"
	var scenes := PackedStringArray(Entries.LEVELS)
	scenes.append_array([Entries.MENU, Entries.GAME, Entries.SHOWCASE, "res://game/start.tscn"])
	for path in scenes:
		var scene := load(path) as PackedScene
		if not check(scene != null, path + " does not load"):
			continue
		var root := scene.instantiate()
		stage.add_child(root)
		await ticks(300)
		for node in root.find_children("*", "SoftBody2D", true, false):
			var body := node as SoftBody2D
			check_equal(body.get_warnings(), PackedStringArray(), "%s: warnings of %s" % [path, body.name])
			check(body.get_substep_plan()["elastic_reason"] != "network_values", "%s: %s says that it is meant as a network" % [path, body.name])
			check(all_finite(body.get_point_positions()), "%s: a point of %s is not finite" % [path, body.name])
			check_above(body.get_area() / body.get_rest_area(), 0.5, "%s: area of %s over its rest area" % [path, body.name])
		root.queue_free()
		await ticks(2)


func test_the_menu_offers_only_scenes_that_exist() -> void:
	for entry in Entries.SCENES:
		check(ResourceLoader.exists(entry["path"], "PackedScene"), "%s is not there" % entry["path"])


func test_a_reset_demo_starts_again() -> void:
	var demo := (load(DEMO) as PackedScene).instantiate()
	stage.add_child(demo)
	await seconds(1)
	var bodies := demo.find_children("*", "SoftBody2D", true, false)
	var places := PackedVector2Array()
	for node in bodies:
		places.append((node as SoftBody2D).get_center_of_mass_position())
	demo.call("reset")
	await seconds(1)
	for i in bodies.size():
		check_near((bodies[i] as SoftBody2D).get_center_of_mass_position(), places[i], 0.5, "second fall of " + bodies[i].name)


func _push_mouse(position: Vector2, pressed: bool) -> void:
	var button := InputEventMouseButton.new()
	button.button_index = MOUSE_BUTTON_LEFT
	button.pressed = pressed
	button.position = position
	tree.root.push_input(button, true)


func test_the_demo_obeys_mouse_and_key() -> void:
	var demo := (load(DEMO) as PackedScene).instantiate()
	stage.add_child(demo)
	var body := demo.get_node("Soft") as SoftBody2D
	var start := body.get_center_of_mass_position()
	await seconds(3)
	_push_mouse(body.get_center_of_mass_position(), true)
	var motion := InputEventMouseMotion.new()
	motion.position = start + Vector2(20, -50)
	tree.root.push_input(motion, true)
	await seconds(2)
	# It hangs on the mouse and wobbles, so its place over a second counts.
	var sum := Vector2.ZERO
	for i in 60:
		await ticks(1)
		sum += body.get_center_of_mass_position()
	check_near(sum / 60, motion.position, 40, "the dragged body and the mouse")
	_push_mouse(motion.position, false)
	await seconds(1)
	check_above(body.get_center_of_mass_position().y, start.y, "y of the body that was let go")
	var key := InputEventKey.new()
	key.keycode = KEY_R
	key.pressed = true
	tree.root.push_input(key)
	check_near(body.get_center_of_mass_position(), start, 1, "the body after the key R")


func test_the_mouse_pulls_no_body_through_a_wall() -> void:
	add_solid(rectangle(20, 2000))
	var body := add_body(Vector2(-100, 0), { "gravity_scale": 0.0, "stiffness": 20.0 })
	body.add_to_group(&"soft_bodies")
	var grabber: Node2D = (load("res://common/grabber.gd") as GDScript).new()
	stage.add_child(grabber)
	await ticks(2)
	grabber.call("grab", Vector2(-100, 0))
	grabber.set("target", Vector2(400, 0))
	await seconds(5)
	check_below(bounds_of(polygon_of(body)).end.x, -9, "right end of the body before the wall")
	check_above(body.get_area() / body.get_rest_area(), 0.5, "area over rest area at the wall")


func test_the_mouse_lifts_a_body_of_any_mass() -> void:
	add_floor(100)
	for mass: float in [0.2, 1.0, 6.0]:
		var body := add_body(Vector2(0, 40), { "mass": mass, "stiffness": 300.0 * mass })
		body.add_to_group(&"soft_bodies")
		var grabber: Node2D = (load("res://common/grabber.gd") as GDScript).new()
		stage.add_child(grabber)
		await seconds(1)
		check(grabber.call("grab", Vector2(0, 30)), "nothing to grab at %s kg" % mass)
		grabber.set("target", Vector2(0, -200))
		await seconds(3)
		check_near(body.get_center_of_mass_position().y, -200.0, 40, "height of the lifted body of %s kg" % mass)
		check_below(body.get_linear_velocity().length(), 10, "speed of the lifted body of %s kg" % mass)
		grabber.call("release")
		await seconds(2)
		check_above(body.get_center_of_mass_position().y, 0, "height of the released body")
		grabber.free()
		body.free()
