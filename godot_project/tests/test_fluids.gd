# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## SoftBodyFluid2D: how deep a body floats, how fast it sinks, what wind does; each beside a formula.

const PIXELS := 100.0 * 100.0 # in a square meter


func _add_fluid(position: Vector2, size: Vector2, properties := {}) -> SoftBodyFluid2D:
	var fluid := SoftBodyFluid2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(size.x, size.y)
	fluid.add_child(collision)
	fluid.position = position
	for property: String in properties:
		fluid.set(property, properties[property])
	stage.add_child(fluid)
	return fluid


# The share of a disk of radius 1 below a line at distance d from its middle, positive above: a circular segment.
func _share_below(d: float) -> float:
	return (acos(-d) + d * sqrt(1 - d * d)) / PI


# The d at which that share is `share`, by halving.
func _depth_of(share: float) -> float:
	var low := -1.0
	var high := 1.0
	for i in 50:
		var middle := (low + high) / 2
		if _share_below(middle) < share:
			low = middle
		else:
			high = middle
	return low


func test_a_disk_floats_as_deep_as_the_weight_of_the_water_that_it_displaces_says() -> void:
	for density: float in [1.6, 2.0, 4.0, 12.0]:
		var water := _add_fluid(Vector2(0, 500), Vector2(4000, 1000), {"density": density}) # the surface is at 0
		var body := add_body(Vector2(0, -20), {"polygon": SoftBody2D.make_circle_polygon(50, 48), "youngs_modulus": 2000.0})
		await seconds(10)
		var share := body.mass / (density * body.get_rest_area() / PIXELS)
		var expected := 50 * _depth_of(share) # of its middle
		check_near(body.get_center_of_mass_position().y, expected, 1.5, "depth in a fluid of %s kg/m²" % density)
		check_below(body.get_linear_velocity().length(), 1.0, "speed at last")
		water.free()
		body.free()


func test_a_body_that_simulates_few_points_of_many_floats_as_deep() -> void:
	_add_fluid(Vector2(0, 500), Vector2(4000, 1000), {"density": 2.0}) # the surface is at 0
	var body := add_body(Vector2(0, -20), {"polygon": SoftBody2D.make_circle_polygon(50, 200), "youngs_modulus": 2000.0,
			"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC})
	check_below(body.get_simulated_polygon().size(), 30, "points simulated")
	await seconds(10)
	var share := body.mass / (2.0 * body.get_rest_area() / PIXELS)
	check_near(body.get_center_of_mass_position().y, 50 * _depth_of(share), 1.5, "depth")


func test_in_fast_time_a_body_in_thick_water_comes_to_rest() -> void:
	_add_fluid(Vector2.ZERO, Vector2(4000, 4000), {"density": 2.0, "viscosity": 200.0, "buoyancy_enabled": false})
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(400, 0)})
	Engine.time_scale = 3
	await ticks(30)
	Engine.time_scale = 1
	check_below(body.get_linear_velocity().length(), 1.0, "speed after a second and a half")
	# 20 px in each tick until the engine tells of the overlap and the first force acts.
	check_below(absf(body.get_center_of_mass_position().x), 80, "way")


func test_a_body_that_is_denser_sinks_and_one_that_is_lighter_rises() -> void:
	_add_fluid(Vector2.ZERO, Vector2(4000, 4000), {"density": 2.0})
	var heavy := add_body(Vector2(-300, 0), {"mass": 3.0})
	var light := add_body(Vector2(300, 0), {"mass": 0.5})
	await seconds(1.5)
	check_above(heavy.position.y, 60, "where the heavy one has sunk to")
	check_below(light.position.y, -60, "where the light one has risen to")


func test_a_box_falls_at_the_speed_at_which_drag_bears_its_weight() -> void:
	for drag: float in [0.5, 2.0]:
		var air := _add_fluid(Vector2(0, 2000), Vector2(4000, 8000),
				{"density": 0.5, "drag": drag, "viscosity": 0.0, "buoyancy_enabled": false})
		var body := add_body(Vector2.ZERO, {"polygon": SoftBody2D.make_box_polygon(Vector2(120, 40), 20), "mass": 1.0,
				"youngs_modulus": 5000.0, "lock_rotation": true})
		await seconds(4)
		var terminal := sqrt(2 * 1.0 * 980.0 / (0.5 / PIXELS * drag * 120))
		check_near(body.get_linear_velocity().y, terminal, 0.02 * terminal, "speed with a drag of %s" % drag)
		air.free()
		body.free()


func test_wind_takes_a_light_body_along_and_no_faster_than_it_blows() -> void:
	var wind := _add_fluid(Vector2.ZERO, Vector2(20000, 4000), {"buoyancy_enabled": false, "flow": Vector2(300, 0), "viscosity": 0.0})
	wind.rotation = PI
	var body := add_weightless_body(Vector2.ZERO, {"mass": 0.02})
	await seconds(6)
	check_near(body.get_linear_velocity(), Vector2(-300, 0), 30.0, "velocity in a wind that was turned round")
	check_above(body.get_linear_velocity().x, -300.5, "never faster than the wind")


func test_wind_presses_in_the_side_that_it_meets() -> void:
	_add_fluid(Vector2.ZERO, Vector2(2000, 2000), {"density": 4.0, "buoyancy_enabled": false, "flow": Vector2(500, 0)})
	var body := add_weightless_body(Vector2.ZERO, {"polygon": SoftBody2D.make_box_polygon(Vector2(30, 240), 15), "pinned_points": PackedInt32Array([0, 1, 2, 18, 19, 20])})
	var pins := body.pinned_points
	check_equal(pins.size(), 6, "pins")
	await seconds(2)
	var middle := polygon_of(body)[10]
	check_above(middle.x - body.to_global(body.polygon[10]).x, 15, "how far the middle of the sail is blown out")


func test_only_what_is_inside_is_pushed_and_disabled_shapes_hold_nothing() -> void:
	var wind := _add_fluid(Vector2(0, -500), Vector2(2000, 1000), {"buoyancy_enabled": false, "flow": Vector2(300, 0), "viscosity": 0.0})
	# Its upper half is in the wind.
	var body := add_weightless_body(Vector2.ZERO, {"polygon": SoftBody2D.make_box_polygon(Vector2(60, 120), 20)})
	await ticks(20)
	check_above(body.get_angular_velocity(), 0.1, "spin by a wind in its upper half")
	wind.get_child(0).disabled = true
	await ticks(3)
	var velocity := body.get_linear_velocity()
	await ticks(20)
	check_near(body.get_linear_velocity(), velocity, 0.01, "velocity after the shape was disabled")


func test_a_disabled_shape_beside_another_holds_nothing() -> void:
	var water := _add_fluid(Vector2(-545, 0), Vector2(1000, 1000), {"density": 6.0}) # reaches 5 px into the body
	var all := CollisionShape2D.new()
	all.shape = rectangle(8000, 8000)
	all.disabled = true
	water.add_child(all)
	var body := add_body()
	await ticks(12)
	check_above(body.get_linear_velocity().y, 100, "speed of a body that falls, with a few drops under it")
	all.disabled = false
	await ticks(40)
	check_below(body.get_linear_velocity().y, -50, "speed of one that is lifted")


func test_a_body_at_rest_in_still_air_sleeps() -> void:
	add_floor(50)
	_add_fluid(Vector2.ZERO, Vector2(1000, 1000), {"buoyancy_enabled": false, "viscosity": 0.0})
	var body := add_body(Vector2(0, -10))
	await seconds(8)
	check(body.sleeping, "the body sleeps")


func test_every_kind_of_shape_with_an_inside_holds_fluid() -> void:
	var shapes: Array[Shape2D] = [circle(400), CapsuleShape2D.new(), ConvexPolygonShape2D.new(), WorldBoundaryShape2D.new()]
	(shapes[1] as CapsuleShape2D).radius = 300
	(shapes[1] as CapsuleShape2D).height = 900
	(shapes[2] as ConvexPolygonShape2D).points = PackedVector2Array([Vector2(-300, -300), Vector2(300, -300), Vector2(0, 400)])
	for shape in shapes:
		var fluid := _add_fluid(Vector2.ZERO, Vector2.ONE, {"density": 4.0, "viscosity": 0.0, "drag": 0.0})
		fluid.get_child(0).shape = shape
		var deep := shape is WorldBoundaryShape2D
		var body := add_body(Vector2(0, 200 if deep else 0))
		await ticks(4)
		var before := body.get_linear_velocity().y
		await ticks(6)
		# Gravity and three times as much upward, by density 4 over 1.307.
		var ratio := 4.0 * body.get_rest_area() / PIXELS / body.mass
		check_near(body.get_linear_velocity().y - before, 980.0 * (1 - ratio) * 6 / 60, 6.0, "gain of speed in %s" % shape.get_class())
		fluid.free()
		body.free()


func test_bad_values_are_refused_and_the_old_ones_stay() -> void:
	var fluid := SoftBodyFluid2D.new()
	stage.add_child(fluid)
	check_refused(func() -> void: fluid.density = -1, ["density", "-1", "0"], "a negative density")
	check_refused(func() -> void: fluid.drag = NAN, ["drag", "nan"], "a drag that is NaN")
	check_refused(func() -> void: fluid.viscosity = -0.5, ["viscosity", "-0.5"], "a negative viscosity")
	check_refused(func() -> void: fluid.flow = Vector2(INF, 0), ["flow", "finite"], "an infinite flow")
	check_equal([fluid.density, fluid.drag, fluid.viscosity, fluid.flow], [2.0, 1.0, 2.0, Vector2.ZERO], "values")
	fluid.monitoring = false
	check("monitoring" in "\n".join(fluid.get_warnings()), "a warning of a fluid that finds no body")


func test_a_body_beside_the_fluid_sleeps_and_a_frozen_one_stays() -> void:
	add_floor(50)
	_add_fluid(Vector2(300, 0), Vector2(300, 300))
	var beside := add_body(Vector2(0, -10))
	var frozen := add_body(Vector2(300, 0), {"freeze": true})
	await seconds(6)
	check(beside.sleeping, "the body beside the water sleeps")
	check_near(frozen.position, Vector2(300, 0), 0.01, "place of the frozen one")


func test_the_examples_show_what_their_captions_say() -> void:
	var scene: Node2D = (load("res://examples/water.tscn") as PackedScene).instantiate()
	stage.add_child(scene)
	await seconds(8)
	var surface := 360.0
	var ball: SoftBody2D = scene.get_node("BeachBall")
	var jelly: SoftBody2D = scene.get_node("Jelly")
	var tyre: SoftBody2D = scene.get_node("Tyre")
	var plank: SoftBody2D = scene.get_node("Plank")
	check_below(bounds_of(polygon_of(ball)).end.y, surface + 45, "lower end of the beach ball")
	check_near(jelly.get_center_of_mass_position().y, surface + 50 * _depth_of(1.307 / 2), 4, "middle of the jelly")
	check_above(bounds_of(polygon_of(tyre)).end.y, 618, "lower end of the tyre")
	check_below(bounds_of(polygon_of(plank)).size.y, 60, "height of the plank, which has turned flat")
	scene.free()
	scene = (load("res://examples/wind.tscn") as PackedScene).instantiate()
	stage.add_child(scene)
	var heavy: SoftBody2D = scene.get_node("CarPanel")
	var start := heavy.position.x
	await seconds(3)
	var sail: SoftBody2D = scene.get_node("Sail")
	check_above(polygon_of(sail)[9].x - sail.to_global(sail.polygon[9]).x, 15, "belly of the sail")
	check_above(scene.get_node("Marshmallow").position.x, 700, "where the marshmallow is")
	check_below(heavy.position.x - start, 120, "way of the car panel")


func test_a_body_that_floats_falls_asleep_and_wakes_when_the_water_changes() -> void:
	var water := _add_fluid(Vector2(0, 500), Vector2(4000, 1000)) # the surface is at 0
	var body := add_body(Vector2(0, -100))
	await seconds(20)
	check(body.sleeping, "asleep after 20 s in still water")
	var share := body.mass / (2.0 * body.get_rest_area() / PIXELS)
	check_near(body.get_center_of_mass_position().y, 50 * _depth_of(share), 2.0, "depth of the sleeper")
	var changes := {
		"level": func() -> void: water.position.y += 30,
		"density": func() -> void: water.density = 2.5,
		"flow": func() -> void: water.flow = Vector2(40, 0),
		"no flow": func() -> void: water.flow = Vector2.ZERO,
		"shape": func() -> void: ((water.get_child(0) as CollisionShape2D).shape as RectangleShape2D).size.y -= 20,
		"monitoring": func() -> void: water.monitoring = false,
	}
	for change: String in changes:
		body.set_sleeping(true) # in case it still bobs
		await ticks(2)
		check(body.sleeping or change == "no flow", "asleep before another " + change)
		(changes[change] as Callable).call()
		await ticks(2)
		check(not body.sleeping, "another %s wakes it" % change)
	water.monitoring = true
	body.set_sleeping(true)
	await ticks(3)
	water.free()
	await ticks(2)
	check(not body.sleeping, "water that is gone wakes it")


func test_waves_and_a_touch_wake_what_floats() -> void:
	var water := _add_fluid(Vector2(0, 500), Vector2(4000, 1000))
	var body := add_body(Vector2(0, -50))
	for i in 600:
		water.position.y = 500 + 3 * sin(i / 20.0)
		await ticks(1)
		check(not body.sleeping, "awake on waves")
	await seconds(15)
	check(body.sleeping, "asleep when the waves are over")
	add_body(Vector2(0, -200))
	await seconds(1)
	check(not body.sleeping, "another body wakes it")
