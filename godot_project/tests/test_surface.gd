# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Friction and bounce of a body are those of its physics material, as of a RigidBody2D; without one, of what it is made of.


# How far a box slides that begins with 200 px/s on a floor of that friction.
func _slide(material: PhysicsMaterial, floor_friction := 1.0, others := {}) -> float:
	var floor_body := add_floor(30)
	floor_body.physics_material_override = surface(floor_friction)
	var body := add_body(Vector2.ZERO, {"polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0, "rolling_resistance": 0.0,
			"youngs_modulus": 2000.0, "damping_ratio": 1.0, "physics_material_override": material}.merged(others))
	await ticks(20)
	var start := body.global_position.x
	body.apply_central_impulse(Vector2(200, 0))
	await seconds(1)
	var way := body.global_position.x - start
	body.free()
	floor_body.free()
	await ticks(2)
	return way


func test_a_body_without_a_physics_material_has_the_documented_grip() -> void:
	check_near(await _slide(null), await _slide(surface(0.4)), 0.01, "way without a physics material")


func test_the_smaller_friction_counts_unless_a_side_is_rough() -> void:
	var slick := await _slide(surface(0.05))
	check_near(await _slide(surface(1), 0.05), slick, 1, "way on a slick floor")
	check_above(slick, 2 * await _slide(surface(0.4)), "way of a slick body")
	var rough := surface(0.4)
	rough.rough = true
	check_near(await _slide(rough, 0.05), await _slide(surface(0.4)), 1, "way of a rough body on a slick floor")


func test_a_rough_soft_body_holds_on_a_slick_one() -> void:
	for is_rough: bool in [false, true]:
		var ground := add_body(Vector2(0, 60), {"polygon": SoftBody2D.make_box_polygon(Vector2(1200, 60), 60), "freeze": true,
				"physics_material_override": surface(0.02)})
		var grip := surface(0.5)
		grip.rough = is_rough
		var body := add_body(Vector2(0, 0), {"polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0, "youngs_modulus": 2000.0,
				"damping_ratio": 1.0, "rolling_resistance": 0.0, "physics_material_override": grip})
		await ticks(20)
		body.apply_central_impulse(Vector2(200, 0))
		await seconds(1)
		if is_rough:
			check_below(body.linear_velocity.x, 20, "velocity of a rough body")
		else:
			check_above(body.linear_velocity.x, 120, "velocity of a body that is not")
		body.free()
		ground.free()
		await ticks(2)


func test_a_physics_material_counts_instead_of_the_material() -> void:
	var ice := SoftBodyMaterial2D.new()
	ice.friction = 0.0
	ice.youngs_modulus = 2000.0
	ice.damping_ratio = 1.0
	ice.rolling_resistance = 0.0
	var others := {"soft_body_material": ice}
	check_above(await _slide(null, 1.0, others), 190, "way of a body of ice")
	check_near(await _slide(surface(0.4), 1.0, others), await _slide(surface(0.4)), 1, "way with a physics material")


func test_a_change_of_a_shared_physics_material_reaches_every_body_at_once() -> void:
	add_floor(30)
	var material := surface(1.0)
	var bodies: Array[SoftBody2D] = []
	for i in 2:
		bodies.append(add_body(Vector2(0, -90 * i), {"polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0,
				"physics_material_override": material}))
	await seconds(2)
	material.friction = 0.0
	await ticks(2)
	for body in bodies:
		body.apply_central_impulse(Vector2(100, 0))
	await seconds(1)
	for body in bodies:
		check_near(body.linear_velocity.x, 100.0, 8, "velocity on what was not ice before")
	bodies[0].physics_material_override = null
	check_equal(material.changed.get_connections().size(), 1, "listeners after one body has lost it")


# Speed with which a body leaves a floor that it met with 400 px/s.
func _rebound(material: PhysicsMaterial, floor_bounce: float) -> float:
	var floor_body := add_floor(100)
	floor_body.physics_material_override = surface(1, floor_bounce)
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 300.0, "damping": 20.0, "physics_material_override": material})
	body.apply_central_impulse(Vector2(0, 400))
	await seconds(2)
	var speed := -body.get_linear_velocity().y
	body.free()
	floor_body.free()
	await ticks(2)
	return speed


func test_bounces_add_up_and_an_absorbent_body_takes_its_own_away() -> void:
	check_near(await _rebound(surface(0.4, 0.3), 0.5), 320.0, 40, "speed with 0.3 on 0.5")
	var absorbent := surface(0.4, 0.3)
	absorbent.absorbent = true
	check_near(await _rebound(absorbent, 0.9), 240.0, 40, "speed of an absorbent body of 0.3 on 0.9")
	check_near(await _rebound(surface(0.4, 7), 0.0), 400.0, 40, "speed with a bounce above 1")


func test_a_physics_material_that_is_not_finite_is_refused_by_name() -> void:
	var body := add_body(Vector2.ZERO, {"physics_material_override": surface(0.75)})
	check_refused(func() -> void: body.physics_material_override.friction = NAN,
			[String(body.name), "physics_material_override", "friction", "nan"], "friction = NAN")
	await ticks(5)
	check(all_finite(body.get_point_positions()), "a point is not finite")
	check("friction" in "\n".join(body.get_warnings()), "no warning about it")
	body.physics_material_override.friction = 0.5
	check(not "friction" in "\n".join(body.get_warnings()), "the warning stays")
