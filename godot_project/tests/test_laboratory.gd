# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The laboratory does to all bodies what its sliders and buttons say, and the stress test keeps to its bounds.

const LABORATORY := "res://laboratory/laboratory.tscn"
const Levels := preload("res://laboratory/levels.gd")
const LEVELS := "res://laboratory/levels.tscn"
const STRESS_TEST := "res://laboratory/stress_test.tscn"

var _scene: Node2D
var _bodies: Array[SoftBody2D] = []


func _open(path := LABORATORY) -> void:
	_scene = (load(path) as PackedScene).instantiate()
	stage.add_child(_scene)
	if path == LABORATORY:
		_bodies = _scene.get(&"bodies")


func _set_slider(property: StringName, value: float) -> void:
	_scene.get_node("%Materials").call(&"set_value", property, value)


func test_there_is_a_slider_for_every_material_value() -> void:
	_open()
	var names: Array = _scene.get_node("%Materials").call(&"get_names")
	var expected: Array = []
	for property in SoftBodyMaterial2D.new().get_property_list():
		if property["usage"] & PROPERTY_USAGE_EDITOR and property["type"] == TYPE_FLOAT:
			expected.append(StringName(property["name"]))
	check_equal(names, expected, "names of the sliders")
	check_above(names.size(), 9, "number of sliders")


func test_a_slider_changes_all_bodies() -> void:
	_open()
	_set_slider(&"stiffness", 500)
	_set_slider(&"friction", 0.9)
	for body in _bodies:
		check_near(body.soft_body_material.stiffness, 500.0, 0.01, "stiffness of " + body.name)
		check_near(body.soft_body_material.friction, 0.9, 1e-6, "friction of " + body.name)


func test_models_leave_out_what_they_do_without() -> void:
	_open()
	_set_slider(&"pressure", 300)
	_set_slider(&"shape_matching", 0.7)
	var pressures := []
	var matchings := []
	for i in 4:
		pressures.append(_bodies[i].soft_body_material.pressure > 0)
		matchings.append(_bodies[i].soft_body_material.shape_matching > 0)
	check_equal(pressures, [false, true, false, true], "models with pressure")
	check_equal(matchings, [false, false, true, true], "models with shape matching")
	check_equal(_bodies[1].center_point, false, "center point of the pressure model")


func test_all_integrators_are_there_and_run() -> void:
	_open()
	var methods := []
	for body in _bodies.slice(4):
		methods.append(body.get_substep_plan()["integrator"])
	check_equal(methods.slice(1), [1, 2, 3, 4, 5, 6, 7], "methods in use")


func test_a_press_takes_area_and_gives_it_back() -> void:
	_open()
	_scene.call(&"apply_load", 1)
	await seconds(1.5)
	for body in _bodies:
		# Pressed to 0.55 of their height they cannot spread enough to keep it; the skin under pressure comes nearest.
		check_below(body.get_area() / body.get_rest_area(), 0.96, "area share of %s under the press" % body.name)
	await seconds(2.4)
	for i in _bodies.size():
		if i != 1: # the skin under pressure alone sags under its weight
			check_above(_bodies[i].get_area() / _bodies[i].get_rest_area(), 0.9, "area share of %s after it" % _bodies[i].name)


func test_bodies_stay_in_their_lanes_under_every_load() -> void:
	_open()
	var starts := _bodies.map(func(body: SoftBody2D) -> float: return body.global_position.x)
	for load in 3:
		_scene.call(&"apply_load", load)
		for i in 6:
			await ticks(30)
			for k in _bodies.size():
				var half := 80.0 if k < 4 else 40.0
				var x := _bodies[k].get_center_of_mass_position().x
				check_near(x, starts[k], half, "x of %s under load %d" % [_bodies[k].name, load])


func test_the_curves_show_what_the_bodies_do() -> void:
	_open()
	await ticks(20)
	for i in 4:
		var energy: float = _scene.get_node("%Energy").call(&"get_last", i)
		# In free fall for 20 ticks: m v² / 2 of 1 kg at 9.8 · 20 / 60 m/s, give or take a tick of 10 %.
		check_near(energy, 5.34, 0.6, "energy curve %d in J" % i)
		check_near(_scene.get_node("%Area").call(&"get_last", i), 100.0, 2, "area curve %d in %%" % i)
	check("semi-implicit Euler" in (_scene.get_node("%Plan") as Label).text, "the plan names no method")
	await ticks(30)
	check_above((_scene.get_node("%Stability") as Label).text.length(), 5, "length of what is said of stability")


func test_the_stress_test_stops_at_its_most() -> void:
	_open(STRESS_TEST)
	_scene.set(&"budget", 1e12)
	_scene.set(&"most_bodies", 60)
	await ticks(160)
	check_equal(SoftBodySimulation2D.get_body_count(), 60, "number of bodies")
	check_equal(_scene.get(&"found"), 60, "number that was found")


func test_the_stress_test_takes_bodies_away_when_a_step_takes_too_long() -> void:
	_open(STRESS_TEST)
	_scene.set(&"budget", 1e12)
	_scene.set(&"most_bodies", 60)
	await ticks(20)
	_scene.set(&"budget", 1e-3)
	await ticks(100)
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "number of bodies without time for any")


func test_the_stress_test_can_be_started_anew() -> void:
	_open(STRESS_TEST)
	_scene.set(&"most_bodies", 40)
	_scene.set(&"budget", 1e12)
	await ticks(10)
	_scene.call(&"start", SoftBody2D.INTEGRATOR_MIDPOINT, false)
	await ticks(2)
	for node in _scene.find_children("*", "SoftBody2D", true, false):
		check_equal((node as SoftBody2D).integrator, SoftBody2D.INTEGRATOR_MIDPOINT, "integrator of a body")
		check_equal((node as SoftBody2D).collision_mask, 0, "mask of a body without collisions")
	check_below(SoftBodySimulation2D.get_body_count(), 40, "number of bodies")


func test_the_levels_are_told_by_color_and_the_setting_is_put_back() -> void:
	var before: bool = ProjectSettings.get_setting(Levels.RIGID_FLIGHT)
	_open(LEVELS)
	var bodies: Array = _scene.get(&"bodies")
	var seen := {}
	await ticks(2)
	for i in 150:
		await ticks(1)
		var colored := {}
		for body: SoftBody2D in bodies:
			var level: Variant = Levels.COLORS.find_key(body.color)
			seen[level] = true
			colored[level] = colored.get(level, 0) + 1
		for level: String in Levels.COLORS:
			check_equal(colored.get(level, 0), _scene.get(&"counts")[level], "bodies of the color of " + level)
	check(seen.has("full") and seen.has("rigid"), "bodies were soft and flew: %s" % [seen.keys()])
	_scene.free()
	check_equal(ProjectSettings.get_setting(Levels.RIGID_FLIGHT), before, "the setting afterwards")
