# SPDX-License-Identifier: MIT
extends "res://tests/support/picture_suite.gd"
## Levels at run time: rigid flight, and what a budget of time takes from bodies and gives back. Times decide no test: budgets are such
## that every tick exceeds them, or none.

const NO_TICK_KEEPS := 0.0001 # ms
const EVERY_TICK_KEEPS := 1000.0 # ms


func _set_project(setting: String, value: Variant) -> void:
	ProjectSettings.set_setting("physics/soft_body_2d/solver/" + setting, value)
	ProjectSettings.settings_changed.emit()


func tear_down() -> void:
	_set_project("rigid_flight", false)
	_set_project("budget_ms", 0.0)
	await super()


func test_a_calm_body_in_the_air_flies_as_a_rigid_one_only_if_the_project_says_so() -> void:
	_set_project("rigid_flight", false)
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(60, 0), "angular_velocity": 1.0, "angular_damp_mode": SoftBody2D.DAMP_MODE_REPLACE, "linear_damp_mode": SoftBody2D.DAMP_MODE_REPLACE})
	var important := add_weightless_body(Vector2(0, 400), {"linear_velocity": Vector2(60, 0), "important": true})
	await ticks(30)
	check_equal(SoftBodySimulation2D.get_rigid_flight_count(), 0, "bodies in rigid flight without the setting")
	check_equal(body.get_detail_report().level, "full", "level without the setting")
	_set_project("rigid_flight", true)
	await ticks(3)
	check_equal(SoftBodySimulation2D.get_rigid_flight_count(), 1, "bodies in rigid flight")
	check_equal(body.get_detail_report().level, "rigid", "level")
	check_equal(important.get_detail_report().level, "full", "level of the important body")
	var from := body.global_position
	await ticks(60)
	check_points_near(PackedVector2Array([body.global_position]), PackedVector2Array([from + Vector2(60, 0)]), 0.05, "place after a second")
	check_near(body.angular_velocity, 1.0, 1e-3, "spin")
	body.apply_point_impulse(0, Vector2(4, 0))
	await ticks(1)
	check_equal(body.get_detail_report().level, "full", "level after a push")


func test_a_body_in_rigid_flight_lands_softly() -> void:
	_set_project("rigid_flight", true)
	add_floor(600)
	var body := add_body(Vector2.ZERO)
	var levels := {}
	var least := 1.0
	for i in 150:
		await ticks(1)
		levels[body.get_detail_report().level] = true
		least = minf(least, body.get_area() / body.get_rest_area())
	check(levels.has("rigid") and levels.has("full"), "it flew and it was soft: %s" % [levels.keys()])
	check_below(body.get_penetration(), 1.0, "penetration")


func test_a_budget_takes_levels_down_and_gives_them_back() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(60, 0)})
	check_equal(SoftBodySimulation2D.get_budget_report().reason, "off", "reason without a budget")
	_set_project("budget_ms", NO_TICK_KEEPS)
	await ticks(20)
	var report := SoftBodySimulation2D.get_budget_report()
	check_equal(report.reason, "over_budget", "reason")
	check_above(report.levels_down, 0.5, "levels down")
	check_equal(report.rigid_flight, true, "rigid flight")
	check_equal(body.get_detail_report().level, "rigid", "level of a body in the air")
	_set_project("budget_ms", EVERY_TICK_KEEPS)
	await ticks(3)
	report = SoftBodySimulation2D.get_budget_report()
	check_equal([report.reason, report.levels_down], ["within_budget", 0], "with room")
	check_equal(body.get_detail_report().level, "full", "level with room")


func test_a_budget_takes_nothing_from_a_space_that_the_game_steps() -> void:
	_set_project("budget_ms", NO_TICK_KEEPS)
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(60, 0)})
	await ticks(20)
	var space := body.get_world_2d().space
	SoftBodySimulation2D.set_automatic_stepping(space, false)
	SoftBodySimulation2D.step(space, 1.0 / 60)
	check_equal(body.get_detail_report().level, "full", "level in a step by hand")
	SoftBodySimulation2D.set_automatic_stepping(space, true)


func test_unseen_bodies_pause_for_a_budget_unless_they_are_important_and_go_on_when_seen() -> void:
	if not open_viewport():
		return
	var camera := Camera2D.new()
	camera.anchor_mode = Camera2D.ANCHOR_MODE_FIXED_TOP_LEFT
	viewport.add_child(camera)
	camera.make_current()
	var moving := { "linear_velocity": Vector2(0, -60), "linear_damp_mode": SoftBody2D.DAMP_MODE_REPLACE, "position": Vector2(900, 0) }
	var unseen := add_to_view(moving)
	moving.merge({ "position": Vector2(900, 300), "important": true }, true)
	var important := add_to_view(moving)
	var seen := add_to_view({ "position": Vector2(200, 200), "linear_velocity": Vector2(0, -6) })
	_set_project("budget_ms", NO_TICK_KEEPS)
	await ticks(60)
	check_equal(unseen.get_detail_report().level, "paused", "level of the unseen body")
	check_equal(important.get_detail_report().level, "full", "level of the important body")
	check_equal(seen.get_detail_report().level, "rigid", "level of the body in view")
	check_equal(SoftBodySimulation2D.get_budget_report().paused_bodies, 1, "paused bodies")
	var before := unseen.global_position
	await ticks(10)
	check_equal(unseen.global_position, before, "place while paused")
	camera.position.x = 700
	await ticks(6)
	before = unseen.global_position
	await ticks(30)
	check_near(before.y - unseen.global_position.y, 30, 1.0, "way of the same body in view")
	camera.position.x = 0
	await ticks(10)
	check_equal(unseen.get_detail_report().level, "paused", "level when it is out of view again")
	_set_project("budget_ms", EVERY_TICK_KEEPS)
	await ticks(3)
	check(unseen.get_detail_report().level != "paused", "it goes on once there is room")
	check_equal(SoftBodySimulation2D.get_budget_report().paused_bodies, 0, "paused bodies with room")
