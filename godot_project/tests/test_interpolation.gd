# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The polygon between two physics ticks, as it is drawn.


func _check_ends_at_the_ticks(body: SoftBody2D, before: PackedVector2Array) -> void:
	check_points_near(body.get_interpolated_polygon(0), before, 0.01, "interpolated polygon at 0 and the tick before")
	check_points_near(body.get_interpolated_polygon(1), polygon_of(body), 0.01, "interpolated polygon at 1 and the last tick")


func test_a_falling_polygon_is_halfway_at_one_half() -> void:
	var body := add_body()
	await ticks(20)
	var before := polygon_of(body)
	await ticks(1)
	_check_ends_at_the_ticks(body, before)
	var after := polygon_of(body)
	for fraction: float in [0.25, 0.5, 0.9]:
		var expected := PackedVector2Array()
		for i in after.size():
			expected.append(before[i].lerp(after[i], fraction))
		check_points_near(body.get_interpolated_polygon(fraction), expected, 0.02, "polygons at %s" % fraction)


func test_a_wobbling_polygon_is_halfway_at_one_half() -> void:
	add_floor(100)
	var body := add_body(Vector2.ZERO, { "stiffness": 200.0 })
	for i in 60:
		var before := polygon_of(body)
		await ticks(1)
		_check_ends_at_the_ticks(body, before)
		var after := polygon_of(body)
		var polygon := body.get_interpolated_polygon(0.5)
		for k in polygon.size():
			check_near(polygon[k], before[k].lerp(after[k], 0.5), 0.3, "a point of the wobbling polygon at 0.5")


func test_a_spinning_polygon_turns_between_the_ticks_and_keeps_its_size() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "stiffness": 3000.0 })
	for i in 16:
		body.apply_point_impulse(i, Vector2.from_angle(TAU * i / 16.0).orthogonal() * -30)
	await ticks(10)
	check_above(absf(body.get_angular_velocity()), 5, "spin")
	for i in 20:
		var before := polygon_of(body)
		await ticks(1)
		_check_ends_at_the_ticks(body, before)
		var after := polygon_of(body)
		var polygon := body.get_interpolated_polygon(0.5)
		for k in polygon.size():
			# An arc leaves the box of its chord by less than the length of the chord.
			var box := Rect2(before[k], Vector2.ZERO).expand(after[k]).grow(0.5 + 0.2 * before[k].distance_to(after[k]))
			check(box.has_point(polygon[k]), "a point of the spinning polygon leaves the way between its ticks")
		var chord := PackedVector2Array()
		for k in polygon.size():
			chord.append(before[k].lerp(after[k], 0.5))
		check_above(bounds_of(polygon).size.length(), bounds_of(chord).size.length() - 0.5, "size between the ticks")


func test_a_resting_polygon_does_not_flicker() -> void:
	add_floor(100)
	var body := add_body()
	await seconds(8)
	for i in 10:
		await ticks(1)
		check_points_near(body.get_interpolated_polygon(0), body.get_interpolated_polygon(1), 0.1, "ends of the interpolation")


func test_a_teleport_is_not_smeared() -> void:
	var body := add_weightless_body()
	await ticks(5)
	body.global_position = Vector2(700, -300)
	await ticks(1)
	check_points_near(body.get_interpolated_polygon(0), polygon_of(body), 0.01, "polygon at 0 and the new place")
	check_points_near(body.get_interpolated_polygon(0.5), polygon_of(body), 0.01, "polygon at 0.5 and the new place")


func test_a_paused_polygon_stands_still_for_every_fraction() -> void:
	var body := add_body()
	await ticks(20)
	tree.paused = true
	await ticks(3)
	check_points_near(body.get_interpolated_polygon(0), body.get_interpolated_polygon(1), 0.01, "ends while paused")


func test_a_fraction_outside_the_ticks_is_refused() -> void:
	var body := add_weightless_body()
	body.name = "Jelly"
	for fraction: float in [-0.1, 1.1, NAN]:
		check_refused(func() -> void:
			check(body.get_interpolated_polygon(fraction).is_empty(), "a polygon at %s was given" % fraction),
				["Jelly", "fraction"], "a fraction of %s" % fraction)


func test_the_engines_interpolation_changes_nothing_in_the_simulation() -> void:
	var runs: Array[PackedVector2Array] = []
	for interpolated: bool in [false, true]:
		tree.physics_interpolation = interpolated
		var floor_body := add_floor(100)
		var body := add_body(Vector2.ZERO, { "rotation": 0.3 })
		await ticks(90)
		var polygon := body.get_interpolated_polygon(0.5)
		runs.append(polygon)
		var local := body.global_transform.affine_inverse() * polygon_of(body)
		check_below(largest_distance(body.global_transform * local, polygon_of(body)), 0.01, "node and polygon apart")
		body.free()
		floor_body.free()
		await ticks(1)
	check_equal(runs[0], runs[1], "the polygon with the engine's interpolation")
