# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## How bodies move: falling, forces and impulses, one step a tick, properties changed on the way.


func test_falls_by_half_g_t_squared() -> void:
	var body := add_body()
	await seconds(1.5)
	check_near(body.get_center_of_mass_position().y, GRAVITY * 1.5 * 1.5 / 2, 0.02 * GRAVITY * 1.5 * 1.5 / 2, "fall")
	check_near(body.get_linear_velocity(), Vector2(0, GRAVITY * 1.5), 1, "velocity")
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.001, "area in free fall over rest area")


func test_gravity_scale_of_zero_floats_and_of_minus_one_rises() -> void:
	var floating := add_body(Vector2.ZERO, { "gravity_scale": 0.0 })
	var rising := add_body(Vector2(200, 0), { "gravity_scale": -1.0 })
	await seconds(1)
	check_near(floating.get_center_of_mass_position(), Vector2.ZERO, 0.01, "place of the floating body")
	check_near(rising.get_linear_velocity().y, -GRAVITY, 1, "velocity of the rising body")


func test_gravity_of_the_world_counts() -> void:
	var space := tree.root.world_2d.space
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_GRAVITY, 100.0)
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_GRAVITY_VECTOR, Vector2.RIGHT)
	var body := add_body()
	await seconds(1)
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_GRAVITY, GRAVITY)
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_GRAVITY_VECTOR, Vector2.DOWN)
	check_near(body.get_linear_velocity(), Vector2(100, 0), 0.5, "velocity after a second of 100 px/s² to the right")


func test_time_scale_slows_the_fall() -> void:
	Engine.time_scale = 0.5
	await ticks(2)
	var body := add_body()
	await ticks(60)
	check_near(body.get_linear_velocity().y, GRAVITY / 2, 5, "velocity after 60 ticks at half speed")
	Engine.time_scale = 0
	await ticks(2)
	var place := body.get_center_of_mass_position()
	await ticks(10)
	check_equal(body.get_center_of_mass_position(), place, "place while time stands still")


func test_every_body_is_stepped_exactly_once_a_tick() -> void:
	for count: int in [1, 4]:
		var bodies: Array[SoftBody2D] = []
		for i in count:
			bodies.append(add_body(Vector2(150 * i, 0)))
		check_equal(SoftBodySimulation2D.get_body_count(), count, "bodies of the simulation")
		var before := SoftBodySimulation2D.get_tick_count()
		await ticks(30)
		check_equal(SoftBodySimulation2D.get_tick_count() - before, 30, "ticks of the simulation during 30 ticks")
		for body in bodies:
			check_near(body.get_linear_velocity().y, GRAVITY * 30 / 60, 0.2, "velocity after 30 ticks")
			body.free()


func test_statistics_count_from_their_reset() -> void:
	add_body()
	await ticks(5)
	SoftBodySimulation2D.reset_statistics()
	check_equal(SoftBodySimulation2D.get_tick_count(), 0, "ticks after the reset")
	await ticks(7)
	check_equal(SoftBodySimulation2D.get_tick_count(), 7, "ticks after seven more")
	check_above(SoftBodySimulation2D.get_last_step_usec(), 0, "time of the last step")
	check_above(SoftBodySimulation2D.get_mean_step_usec(), 0, "mean time of a step")
	check_below(SoftBodySimulation2D.get_mean_step_usec(), 100_000, "mean time of a step")


func test_a_central_impulse_changes_the_velocity_by_j_over_m() -> void:
	for mass: float in [0.5, 1.0, 8.0]:
		var body := add_weightless_body(Vector2.ZERO, { "mass": mass })
		body.apply_central_impulse(Vector2(40, -24))
		check_near(body.get_linear_velocity(), Vector2(40, -24) / mass, 0.01, "velocity at %s kg" % mass)
		await seconds(1)
		check_near(body.get_linear_velocity(), Vector2(40, -24) / mass, 0.01, "velocity a second later")
		check_near(body.get_angular_velocity(), 0.0, 0.001, "spin")
		check_near(body.get_kinetic_energy(), Vector2(40, -24).length_squared() / (2 * mass), 1, "kinetic energy")
		body.free()


func test_a_central_force_acts_for_one_tick_and_is_forgotten() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "mass": 2.0 })
	body.apply_central_force(Vector2(600, 0))
	await ticks(1)
	check_near(body.get_linear_velocity(), Vector2(600 / 2.0 / 60, 0), 0.01, "velocity after one tick")
	await ticks(10)
	check_near(body.get_linear_velocity(), Vector2(600 / 2.0 / 60, 0), 0.01, "velocity ten ticks later")


func test_a_force_applied_every_tick_holds_a_body_up() -> void:
	var body := add_body(Vector2.ZERO, { "mass": 3.0 })
	for i in 60:
		body.apply_central_force(Vector2(0, -3 * GRAVITY))
		await ticks(1)
	check_near(body.get_center_of_mass_position(), Vector2.ZERO, 0.5, "place")


func test_a_force_at_a_point_moves_and_spins() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "stiffness": 2000.0 })
	for i in 10:
		body.apply_point_force(0, Vector2(0, 200)) # point 0 lies to the right of the center
		await ticks(1)
	check_near(body.get_linear_velocity(), Vector2(0, 200 * 10 / 60.0), 0.1, "velocity")
	check_above(body.get_angular_velocity(), 0.2, "spin")
	check_above(body.rotation, 0.005, "rotation of the node")


func test_an_impulse_at_a_point_acts_at_once() -> void:
	# The points of a network are equally heavy.
	var body := add_weightless_body(Vector2.ZERO, {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	body.apply_point_impulse(4, Vector2(0, 5))
	check_near(body.get_linear_velocity(), Vector2(0, 5), 0.01, "velocity of the body")
	check_near(body.get_point_velocities()[4], Vector2(0, 5 * 17), 0.1, "velocity of the point")


func test_forces_refuse_a_wrong_point_and_what_is_not_finite() -> void:
	var body := add_weightless_body()
	body.name = "Jelly"
	check_refused(func() -> void: body.apply_point_force(17, Vector2.RIGHT), ["Jelly", "17"], "a force on point 17")
	check_refused(func() -> void: body.apply_point_impulse(-1, Vector2.RIGHT), ["Jelly", "-1"], "an impulse on point -1")
	check_refused(func() -> void: body.apply_point_force(0, Vector2(NAN, 0)), ["Jelly"], "a force of NAN")
	check_refused(func() -> void: body.apply_central_force(Vector2(0, INF)), ["Jelly"], "a central force of INF")
	check_refused(func() -> void: body.apply_central_impulse(Vector2(0, NAN)), ["Jelly"], "a central impulse of NAN")
	await ticks(5)
	check_near(body.get_center_of_mass_position(), Vector2.ZERO, 0.01, "place after all that")


func test_stiffness_changed_while_running_takes_effect_without_a_jump() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 45), { "stiffness": 1500.0 })
	await seconds(4)
	var points := body.get_point_positions()
	var height := bounds_of(points).size.y
	body.stiffness = 150
	check_equal(body.get_point_positions(), points, "points right after the change")
	await ticks(1)
	check_below(largest_distance(body.get_point_positions(), points), 2, "way of a point in the tick after the change")
	await seconds(4)
	check_below(bounds_of(polygon_of(body)).size.y, height - 2, "height of the softened body")


func test_mass_changed_while_running_takes_effect_without_a_jump() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 45), { "stiffness": 600.0 })
	await seconds(4)
	var points := body.get_point_positions()
	var height := bounds_of(points).size.y
	body.mass = 3
	check_equal(body.get_point_positions(), points, "points right after the change")
	await seconds(4)
	check_below(bounds_of(polygon_of(body)).size.y, height - 1.5, "height of the heavier body")
	body.gravity_scale = 0
	var before := body.get_linear_velocity()
	body.apply_central_impulse(Vector2(30, 0))
	check_near(body.get_linear_velocity() - before, Vector2(10, 0), 0.01, "change of velocity by 30 kg·px/s at 3 kg")


func test_every_other_property_may_change_while_running() -> void:
	add_floor(100)
	var body := add_body()
	await seconds(1)
	for change: Array in [["damping", 0.5], ["physics_material_override", surface(0.9, 0.3)], ["rolling_resistance", 0.1],
			["shape_matching", 1.0], ["shape_damping_ratio", 0.5], ["gravity_scale", 1.2], ["substeps", 12],
			["collision_layer", 3], ["collision_mask", 5], ["color", Color.RED]]:
		var points := body.get_point_positions()
		body.set(change[0], change[1])
		check_equal(body.get_point_positions(), points, "points after a change of " + change[0])
	await check_rests(body, 8)


func test_the_substep_plan_follows_stiffness_and_choice() -> void:
	var body := add_body()
	var soft := body.get_substep_plan()
	for key: String in ["frequency", "damping_rate", "substeps", "stability_margin", "safe"]:
		check(soft.has(key), "the plan has no '%s'" % key)
	check_equal(soft["safe"], true, "safety of the defaults")
	body.stiffness = 5000
	check_above(body.get_substep_plan()["substeps"], soft["substeps"], "substeps at 5000 N/m")
	body.substeps = 3
	check_equal(body.get_substep_plan()["substeps"], 3, "substeps when chosen")
	check_equal(body.get_substep_plan()["safe"], false, "safety of 3 substeps at 5000 N/m")


func test_measures_agree_with_the_points() -> void:
	var body := add_weightless_body(Vector2(30, 40), { "stiffness": 800.0 })
	body.apply_point_impulse(3, Vector2(8, -3))
	await ticks(7)
	var sum := Vector2.ZERO
	var velocity := Vector2.ZERO
	var energy := 0.0
	for i in body.get_point_count():
		sum += body.get_point_positions()[i] / 17
		velocity += body.get_point_velocities()[i] / 17
		energy += body.get_point_velocities()[i].length_squared() / 2 / 17
	check_near(body.get_center_of_mass_position(), sum, 0.01, "center of mass")
	check_near(body.get_linear_velocity(), velocity, 0.01, "velocity")
	check_near(body.get_kinetic_energy(), energy, 0.001 * energy, "kinetic energy")
	check_equal(body.get_nearest_point(body.get_point_positions()[5] + Vector2(1, 1)), 5, "nearest point")
	check(body.has_point(sum), "the center is not inside")
	check(not body.has_point(sum + Vector2(80, 0)), "a place 80 px away is inside")


func test_penetration_is_told() -> void:
	add_floor(100)
	var body := add_weightless_body(Vector2(0, 70))
	await ticks(1)
	check_below(body.get_penetration(), 0.01, "penetration after the first tick has pushed the body out")
	body.collision_mask = 2
	await ticks(1)
	check_equal(body.get_penetration(), 0.0, "penetration in what the body does not notice")
	check_near(SoftBodySimulation2D.measure_max_penetration(), body.get_penetration(), 1e-6, "the simulation's maximum")
