# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies that tear where they are stretched beyond what they bear.

const TOUGH := {"youngs_modulus": 600.0, "tear_stretch": 0.4}


func _bar() -> PackedVector2Array:
	var bar := PackedVector2Array()
	for i in 10:
		bar.append(Vector2(-100 + 20 * i, -20))
	for i in 2:
		bar.append(Vector2(100, -20 + 20 * i))
	for i in 10:
		bar.append(Vector2(100 - 20 * i, 20))
	for i in 2:
		bar.append(Vector2(-100, 20 - 20 * i))
	return bar


# A bar held at its left end and by a hand at its right end.
func _held_bar(place: Vector2, hand: Node2D, properties := {}) -> SoftBody2D:
	var all := TOUGH.duplicate()
	all.merge({"polygon": _bar(), "pinned_points": [22, 23, 0, 10, 11, 12]}, true)
	all.merge(properties, true)
	var body := add_weightless_body(place, all)
	var targets: Array[NodePath] = []
	for point in body.pinned_points:
		targets.append(body.get_path_to(hand) if point >= 10 and point <= 12 else NodePath())
	body.pin_targets = targets
	return body


func _hand() -> Node2D:
	var hand := Node2D.new()
	stage.add_child(hand)
	return hand


func _pull(hand: Node2D, way: float, duration: int) -> void:
	for i in duration:
		hand.position.x += way / duration
		await ticks(1)


func test_a_bar_that_is_pulled_tears_across_and_says_so() -> void:
	var hand := _hand()
	var body := _held_bar(Vector2(0, 0), hand)
	var twin := _held_bar(Vector2(0, 300), hand, {"tear_stretch": 0.0})
	var torn: Array = []
	body.torn.connect(func(pieces: Array[SoftBody2D]) -> void: torn.append(pieces))
	twin.torn.connect(func(_pieces: Array[SoftBody2D]) -> void: torn.append("the twin"))
	await _pull(hand, 50, 60)
	check_equal(torn.size(), 0, "tears at a stretch of 0.25")
	await _pull(hand, 60, 60)
	await ticks(2)
	if not check_equal(torn.size(), 1, "tears at a stretch of 0.55"):
		return
	var pieces: Array[SoftBody2D] = torn[0]
	check_equal(pieces.size(), 2, "number of pieces")
	check(pieces[0] == body, "the first piece is the node")
	check_near(pieces[0].mass + pieces[1].mass, twin.mass, 1e-4, "mass of the pieces")
	check_near(pieces[0].get_rest_area() + pieces[1].get_rest_area(), twin.get_rest_area(), 1, "area of the pieces at rest [px²]")
	check_equal(pieces[0].pinned_points.size() + pieces[1].pinned_points.size(), 6, "pins of both")
	for piece in pieces:
		check_equal(piece.tear_stretch, 0.4, "tear_stretch of a piece")
		check_above(piece.get_rest_area(), 160, "area of a piece [px²]")
	await seconds(3)
	check_equal(torn.size(), 1, "tears, three seconds later")
	var gap := absf(pieces[0].get_center_of_mass_position().x - pieces[1].get_center_of_mass_position().x)
	var lengths := bounds_of(polygon_of(pieces[0])).size.x + bounds_of(polygon_of(pieces[1])).size.x
	check_near(lengths, 200, 25, "length of both once they have sprung back [px]")
	check_above(gap, lengths / 2 + 30, "distance of their middles [px]")
	check_near(twin.get_rest_area(), 8000, 1, "area of the twin [px²]")


func test_a_body_that_hangs_under_100_gravities_is_torn_off() -> void:
	var body := add_body(Vector2.ZERO, {"gravity_scale": 100.0, "firm_for_weight": false, "tear_stretch": 0.5, "pinned_points": [0]})
	var count := [1]
	var failures := [0]
	body.torn.connect(func(pieces: Array[SoftBody2D]) -> void: count[0] += pieces.size() - 1)
	body.failed.connect(func() -> void: failures[0] += 1)
	await seconds(0.5)
	check_above(count[0], 1, "pieces")
	check_equal(failures[0], 0, "failures")
	for child in stage.get_children():
		if child is SoftBody2D:
			check(all_finite((child as SoftBody2D).get_point_positions()), "its points are finite")


func test_what_would_leave_too_little_holds() -> void:
	var hand := _hand()
	var body := _held_bar(Vector2(0, 0), hand, {"smallest_piece": 0.5})
	var twin := _held_bar(Vector2(0, 200), hand)
	await _pull(hand, 120, 60)
	await ticks(10)
	check_near(body.get_rest_area(), 8000, 1, "area of the body that may not be divided [px²]")
	check_below(twin.get_rest_area(), 7900, "area of its twin [px²]")


func test_what_yields_first_does_not_tear_below_that() -> void:
	var hand := _hand()
	var body := _held_bar(Vector2(0, 0), hand, {"tear_stretch": 0.1, "yield_strain": 0.5})
	await _pull(hand, 40, 60)
	check_near(body.get_rest_area(), 8000, 1, "area at a stretch of 0.2 [px²]")
	await _pull(hand, 100, 60)
	await ticks(2)
	check_below(body.get_rest_area(), 7900, "area at a stretch of 0.7 [px²]")


func test_many_tear_one_after_the_other() -> void:
	var hand := _hand()
	var torn := {}
	var count := [0]
	var most := 0
	for i in 30:
		var body := _held_bar(Vector2(0, 60 * i), hand, {"collision_layer": 0, "collision_mask": 0})
		body.torn.connect(func(_pieces: Array[SoftBody2D]) -> void:
			torn[body] = true
			count[0] += 1)
	await ticks(2)
	hand.position.x += 110
	for i in 20:
		var before: int = count[0]
		await ticks(1)
		most = maxi(most, count[0] - before)
	check_equal(torn.size(), 30, "bodies torn within 20 ticks")
	check_equal(most, 8, "most in a tick")


func test_it_may_be_freed_when_it_is_torn() -> void:
	var hand := _hand()
	var body := _held_bar(Vector2(0, 0), hand)
	body.torn.connect(func(pieces: Array[SoftBody2D]) -> void:
		for piece in pieces:
			piece.queue_free())
	await _pull(hand, 120, 30)
	await ticks(3)
	check(not is_instance_valid(body), "it is freed")


func test_a_shared_material_tears_alike() -> void:
	var hand := _hand()
	var material := SoftBodyMaterial2D.new()
	material.youngs_modulus = 600
	material.tear_stretch = 0.4
	var body := _held_bar(Vector2(0, 0), hand, {"soft_body_material": material})
	await _pull(hand, 110, 60)
	await ticks(2)
	check_below(body.get_rest_area(), 7900, "area [px²]")


func test_bad_values_are_refused() -> void:
	var body := add_weightless_body(Vector2.ZERO, TOUGH)
	check_refused(func() -> void: body.tear_stretch = -0.1, ["tear_stretch", "-0.1", "0"], "tear_stretch = -0.1")
	check_refused(func() -> void: body.tear_stretch = NAN, ["tear_stretch"], "tear_stretch = NAN")
	check_near(body.tear_stretch, 0.4, 1e-6, "tear_stretch after that")
