# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Dents: what a hard landing leaves, what keeps it and what takes it away.

const METAL := { "youngs_modulus": 3000.0, "poisson_ratio": 0.3, "yield_strain": 0.03, "flow_rate": 60.0 }


func _metal(position: Vector2, properties := {}) -> SoftBody2D:
	var all := METAL.duplicate()
	all.merge(properties, true)
	return add_body(position, all)


func _height_of(body: SoftBody2D) -> float:
	return bounds_of(polygon_of(body)).size.y


func test_a_hard_landing_leaves_a_dent_and_says_so() -> void:
	add_floor(0)
	var body := _metal(Vector2(0, -600))
	var twin := add_body(Vector2(400, -600), { "youngs_modulus": 3000.0, "poisson_ratio": 0.3 })
	var amounts: Array[float] = []
	body.dented.connect(func(amount: float) -> void: amounts.append(amount))
	await seconds(6)
	check_above(amounts.size(), 0, "times that it said so")
	check_near(amounts.back() if not amounts.is_empty() else 0.0, body.get_dent(), 1e-6, "amount that it said last")
	check_above(body.get_dent(), 0.03, "dent")
	check_equal(twin.get_dent(), 0.0, "dent of its elastic twin")
	check_below(_height_of(body), _height_of(twin) - 2, "height over that of its twin [px]")
	check_near(body.get_area() / twin.get_area(), 1, 0.02, "area over that of its twin")
	check(body.sleeping, "it has fallen asleep")


func test_below_the_yield_nothing_stays() -> void:
	add_floor(0)
	var body := _metal(Vector2(0, -300), { "yield_strain": 0.5 })
	await seconds(4)
	check_equal(body.get_dent(), 0.0, "dent")
	check_equal(body.dents, PackedVector2Array(), "dents")


func test_dents_are_saved_duplicated_and_taken_away() -> void:
	add_floor(0)
	var body := _metal(Vector2(0, -600))
	await seconds(4)
	var dent := body.get_dent()
	var height := _height_of(body)
	check_above(dent, 0.03, "dent")
	var copy: SoftBody2D = body.duplicate()
	copy.position.x += 300
	body.get_parent().add_child(copy)
	await seconds(2)
	check_near(copy.get_dent(), dent, 1e-4, "dent of a duplicate")
	check_near(_height_of(copy), height, 2, "height of a duplicate")
	var packed := PackedScene.new()
	packed.pack(body)
	var stored: SoftBody2D = packed.instantiate()
	check_equal(stored.dents.size(), body.get_point_count(), "entries of the dents in a packed scene")
	stored.free()
	var state := body.get_state()
	body.reset_dents()
	await seconds(3)
	check_equal(body.get_dent(), 0.0, "dent after they were taken away")
	check_above(_height_of(body), height + 2, "height after they were taken away")
	check_equal(body.set_state(state), OK, "putting the state back")
	check_near(body.get_dent(), dent, 1e-6, "dent of the state put back")


func test_dents_go_with_the_size_and_with_other_values() -> void:
	add_floor(0)
	var body := _metal(Vector2(0, -600))
	await seconds(4)
	var dent := body.get_dent()
	body.scale = Vector2.ONE * 0.5
	await seconds(1)
	check_near(body.get_dent(), dent, 0.01, "dent at half the size") # it falls on by 25 px
	dent = body.get_dent()
	body.yield_strain = 0
	body.youngs_modulus = 4000
	body.mass = 2
	await ticks(2)
	check_near(body.get_dent(), dent, 1e-3, "dent of a body that yields no more")
	body.polygon = SoftBody2D.make_circle_polygon(40, 12)
	await ticks(2)
	check_equal(body.get_dent(), 0.0, "dent of another polygon")


func test_dents_can_be_animated() -> void:
	var body := add_weightless_body(Vector2.ZERO, METAL)
	await ticks(2)
	var dents := PackedVector2Array()
	dents.resize(body.get_point_count())
	dents[0] = Vector2(-20, 0)
	for i in 11:
		var part := PackedVector2Array()
		for d in dents:
			part.append(d * (i / 10.0))
		body.dents = part
		await ticks(2)
	await seconds(2)
	check_near(body.get_dent(), 0.4, 0.02, "dent of a point moved in by 20 of 50 px")
	check_below(polygon_of(body)[0].distance_to(body.get_center_of_mass_position()), 40, "distance of that point from the middle [px]")


func test_bad_values_are_refused() -> void:
	var body := add_weightless_body(Vector2.ZERO, METAL)
	await ticks(2)
	check_refused(func() -> void: body.yield_strain = -0.1, ["yield_strain", "-0.1", "0"], "yield_strain = -0.1")
	check_refused(func() -> void: body.max_dent = 1.0, ["max_dent", "1", "0.9"], "max_dent = 1")
	check_refused(func() -> void: body.flow_rate = NAN, ["flow_rate"], "flow_rate = NAN")
	check_refused(func() -> void: body.dents = PackedVector2Array([Vector2.ZERO]), ["dents", "1 entries"], "dents of one point")
	var folded := PackedVector2Array()
	folded.resize(body.get_point_count())
	folded[0] = Vector2(-200, 0)
	check_refused(func() -> void: body.dents = folded, ["folded"], "dents that fold the hull")
	check_equal(body.get_dent(), 0.0, "dent after that")
