# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What a body is made of and how it is stepped: pressure, the center point, integrators.

const RADIUS := 50.0
const POINTS := 16


## Size over that at rest at which springs, shape matching and pressure are in balance. Blown up by a factor x, a
## circle of n polygon points has the energy n k l²(x-1)²/2 in its polygon, n k R²(x-1)²/2 in its spokes and as much with
## shape matching's stiffness, and p A0 (x² - s)²/2 in its pressure; this is where the sum of their slopes is zero.
func _balance(body: SoftBody2D) -> float:
	var edge := 2 * RADIUS * sin(PI / POINTS)
	var elastic := POINTS * body.stiffness * edge * edge
	if body.center_point:
		elastic += POINTS * body.stiffness * RADIUS * RADIUS
	elastic += POINTS * body.stiffness * body.shape_matching * RADIUS * RADIUS
	var low := 0.0
	var high := 10.0
	for i in 60:
		var x := (low + high) / 2
		if elastic * (x - 1) + 2 * body.pressure * body.get_rest_area() * x * (x * x - body.inflation) < 0:
			low = x
		else:
			high = x
	return low


func test_inflation_sets_the_area_that_springs_and_pressure_agree_on() -> void:
	var models: Array[Dictionary] = [
		{ "center_point": false, "shape_matching": 0.0 },
		{ "center_point": true, "shape_matching": 0.0 },
		{ "center_point": true, "shape_matching": 0.4 },
	]
	for model in models:
		# Sucked in, a ring without spokes buckles instead of shrinking.
		var inflations: Array[float] = [1.0, 2.0]
		if model["center_point"]:
			inflations.append(0.6)
		for inflation in inflations:
			var properties := { "pressure": 200.0, "inflation": inflation, "damping": 1.0 }
			var body := add_weightless_body(Vector2.ZERO, properties.merged(model))
			await seconds(3 if model["center_point"] else 8) # the spokes damp it best
			var expected := pow(_balance(body), 2)
			var what := "area over rest area of %s, inflation %s" % [model, inflation]
			check_near(body.get_area() / body.get_rest_area(), expected, 0.01, what)
			body.free()


func test_a_network_without_pressure_is_not_inflated() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "inflation": 3.0, "elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK })
	await seconds(1)
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.001, "area over rest area")


func test_pressure_set_while_running_blows_the_body_up_and_lets_it_sink_again() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "inflation": 2.0, "damping": 1.0 })
	await ticks(10)
	body.pressure = 500
	await seconds(3)
	check_near(body.get_area() / body.get_rest_area(), pow(_balance(body), 2), 0.01, "area over rest area under pressure")
	check_above(body.get_area() / body.get_rest_area(), 1.2, "area over rest area under pressure")
	body.pressure = 0
	await seconds(3)
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.01, "area over rest area without")


func test_pressure_keeps_the_area_of_a_body_that_its_weight_presses_flat() -> void:
	add_floor(100)
	var soft := { "stiffness": 20.0, "shape_matching": 0.0, "least_area": 0.0 }
	var flat := add_body(Vector2(-200, 40), soft)
	var firm := add_body(Vector2(200, 40), soft.merged({ "pressure": 400.0 }))
	await seconds(5)
	var flat_share := flat.get_area() / flat.get_rest_area()
	var firm_share := firm.get_area() / firm.get_rest_area()
	check_below(flat_share, 0.85, "area over rest area without pressure")
	check_above(firm_share, 0.9, "area over rest area with pressure")


func test_the_center_point_is_one_more_point_and_may_come_and_go() -> void:
	var body := add_weightless_body(Vector2(30, 40))
	check_equal(body.get_point_count(), POINTS + 1, "points with a center point")
	await ticks(5)
	for wanted: bool in [false, true, false]:
		body.center_point = wanted
		await ticks(2)
		var count := POINTS + 1 if wanted else POINTS
		check_equal(body.get_point_count(), count, "points with center_point = %s" % wanted)
		check_equal(body.get_point_positions().size(), count, "positions with center_point = %s" % wanted)
		check_near(body.get_center_of_mass_position(), Vector2(30, 40), 0.1, "center of mass")
		check_near(body.get_area() / body.get_rest_area(), 1.0, 0.01, "area over rest area")


func test_each_integrator_names_itself_and_is_safe_as_planned() -> void:
	for integrator in range(1, 8):
		var body := add_weightless_body(Vector2.ZERO, { "integrator": integrator })
		var plan := body.get_substep_plan()
		check_equal(plan["integrator"], integrator, "integrator of the plan")
		check(plan["safe"], "integrator %d is not safe for the default body" % integrator)
		body.apply_point_impulse(0, Vector2(4, 0))
		await ticks(60)
		check(all_finite(body.get_point_positions()), "integrator %d lost its numbers" % integrator)
		check_near(body.get_linear_velocity(), Vector2(4, 0), 0.05, "velocity by integrator %d" % integrator)
		check_near(body.get_area() / body.get_rest_area(), 1.0, 0.02, "area over rest area by integrator %d" % integrator)
		body.free()


## In free fall the methods differ by half a step's worth of way: explicit Euler moves with the old velocity,
## semi-implicit Euler with the new, the others with the mean, as XPBD does unless it is damped strongly.
func test_each_integrator_falls_in_its_own_way() -> void:
	var leads := { 1: -0.5, 2: 0.5, 3: 0.0, 4: 0.0, 5: 0.0, 6: 0.0, 7: 0.0 }
	for integrator: int in leads:
		# As soft as it may be: one substep a tick would shake a firm body to pieces.
		var body := add_body(Vector2.ZERO, { "integrator": integrator, "substeps": 1, "stiffness": 5.0 })
		await ticks(30)
		var speed := body.get_linear_velocity().y
		var time := speed / GRAVITY
		check_above(time, 0.4, "time of the fall by integrator %d" % integrator)
		var lead: float = leads[integrator] * speed / 60
		var fall := body.get_center_of_mass_position().y
		check_near(fall, speed * time / 2 + lead, 0.3, "fall by integrator %d" % integrator)
		body.free()


func test_automatic_is_verlet_alone_semi_implicit_beside_surroundings_and_xpbd_for_the_stiff() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	check_equal(body.get_substep_plan()["integrator"], 2, "integrator of a body that collides")
	body.collision_mask = 0
	check_equal(body.get_substep_plan()["integrator"], 6, "integrator of a body that collides with nothing")
	body.stiffness = 1e6
	check_equal(body.get_substep_plan()["integrator"], 7, "integrator of a stiff body")
	check_equal(body.get_substep_plan()["reason"], "too_stiff", "reason for a stiff body")
	body.stiffness = 100
	body.substeps = 9
	check_equal(body.get_substep_plan()["substeps"], 9, "substeps when they are fixed")
	check_equal(body.get_substep_plan()["reason"], "fixed", "reason when substeps are fixed")
	await ticks(1)
