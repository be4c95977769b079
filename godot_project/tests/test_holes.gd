# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies with holes: what they weigh, how they bend, and what scripts are told.

const RADIUS := 50.0
const INNER := 35.0


func _circle(radius: float, count := 32, middle := Vector2.ZERO) -> PackedVector2Array:
	var points := PackedVector2Array()
	for i in count:
		points.append(middle + Vector2.from_angle(TAU * i / count) * radius)
	return points


func _area(polygon: PackedVector2Array) -> float:
	var twice := 0.0
	for i in polygon.size():
		twice += polygon[i].cross(polygon[(i + 1) % polygon.size()])
	return absf(twice / 2)


func _ring(position := Vector2.ZERO, properties := {}) -> SoftBody2D:
	var all := {"polygon": _circle(RADIUS), "holes": [_circle(INNER)] as Array[PackedVector2Array]}
	all.merge(properties, true)
	return add_body(position, all)


func test_a_body_has_no_holes_by_default() -> void:
	var body := add_body()
	check_equal(body.holes.size(), 0, "holes")
	check_equal(body.get_interpolated_holes().size(), 0, "drawn holes")
	check_near(body.mass, 1.0, 1e-6, "mass")


func test_area_mass_and_inertia_are_those_of_the_polygon_less_its_holes() -> void:
	var solid := add_body(Vector2.ZERO, {"polygon": _circle(RADIUS)})
	var ring := _ring(Vector2(300, 0))
	var share := 1 - _area(ring.holes[0]) / _area(ring.polygon)
	check_near(ring.get_area(), _area(ring.polygon) * share, 1.0, "area")
	check_near(ring.get_rest_area(), _area(ring.polygon) * share, 1.0, "rest area")
	check_near(ring.mass, solid.mass * share, 1e-4, "mass")
	# m (R² + r²) / 2 of round rings; 32 corners have 1 % less of each square.
	check_near(ring.inertia / (ring.mass * (RADIUS * RADIUS + INNER * INNER) / 2), 1.0, 0.02, "inertia")
	var wheel := _ring(Vector2(600, 0), {"scale": Vector2(2, 2)})
	check_near(wheel.get_area(), 4 * ring.get_area(), 4.0, "area at twice the size")
	check_near(wheel.mass, 4 * ring.mass, 1e-3, "mass at twice the size")


func test_the_center_of_mass_lies_away_from_a_hole_at_one_side() -> void:
	var hole := _circle(15, 16, Vector2(25, 0))
	for model: int in [SoftBody2D.ELASTIC_MODEL_AUTOMATIC, SoftBody2D.ELASTIC_MODEL_NETWORK, SoftBody2D.ELASTIC_MODEL_SPRINGS_AND_SHAPE, SoftBody2D.ELASTIC_MODEL_TRIANGLES]:
		var body := _ring(Vector2.ZERO, {"holes": [hole] as Array[PackedVector2Array], "elastic_model": model})
		var rest := _area(body.polygon) - _area(hole)
		check_near(body.get_center_of_mass(), Vector2(-25 * _area(hole) / rest, 0), 0.05, "center of mass, model %d" % model)
		body.free()


func test_holes_work_with_every_detail_mode() -> void:
	var masses: Array[float] = []
	for mode: int in [SoftBody2D.DETAIL_MODE_AS_DRAWN, SoftBody2D.DETAIL_MODE_AUTOMATIC, SoftBody2D.DETAIL_MODE_POINT_COUNT]:
		var body := _ring(Vector2.ZERO, {"polygon": _circle(RADIUS, 120), "detail_mode": mode, "detail_point_count": 20})
		masses.append(body.mass)
		check_points_near(body.get_interpolated_holes(1.0)[0], _circle(INNER), 0.1, "hole, mode %d" % mode)
		if mode != SoftBody2D.DETAIL_MODE_AS_DRAWN:
			check_below(body.get_simulated_polygon().size(), 21, "points simulated")
		body.free()
	check_near(masses[1], masses[0], 1e-5, "mass")
	check_near(masses[2], masses[0], 1e-5, "mass")


func test_bad_holes_are_refused_and_nothing_changes() -> void:
	var body := _ring()
	var mass := body.mass
	var set_to := func(holes: Array[PackedVector2Array]) -> void: body.holes = holes
	check_refused(func() -> void: set_to.call([_circle(60)] as Array[PackedVector2Array]), ["holes[0]", "inside the polygon"], "a hole around the body")
	check_refused(func() -> void: set_to.call([_circle(10, 8, Vector2(45, 0))] as Array[PackedVector2Array]), ["holes[0]", "inside the polygon"], "a hole over the edge")
	check_refused(func() -> void: set_to.call([_circle(10), _circle(12, 8, Vector2(10, 0))] as Array[PackedVector2Array]), ["holes[1]", "another hole"], "two that cross")
	check_refused(func() -> void: set_to.call([_circle(10), _circle(5)] as Array[PackedVector2Array]), ["holes[1]", "overlap"], "one in another")
	check_refused(func() -> void: set_to.call([PackedVector2Array([Vector2.ZERO, Vector2.ONE])] as Array[PackedVector2Array]), ["holes[0]", "points"], "two points")
	check_refused(func() -> void: set_to.call([PackedVector2Array([Vector2.ZERO, Vector2(NAN, 1), Vector2(3, 4)])] as Array[PackedVector2Array]), ["holes[0]"], "NaN")
	check_equal(body.holes.size(), 1, "holes")
	check_equal(body.mass, mass, "mass")


func test_holes_that_do_not_fit_another_polygon_wait_with_a_warning() -> void:
	var body := _ring()
	body.polygon = _circle(30)
	check_near(body.get_area(), _area(_circle(30)), 1.0, "area")
	check(", ".join(body.get_warnings()).contains("holes"), "a warning about the holes")
	check_equal(body.holes.size(), 1, "holes are kept")
	body.polygon = _circle(RADIUS)
	check_near(body.get_area(), _area(_circle(RADIUS)) - _area(_circle(INNER)), 1.0, "area with the polygon that they fit")
	check(not ", ".join(body.get_warnings()).contains("holes"), "no warning")


func test_a_changed_copy_of_the_holes_changes_nothing() -> void:
	var body := _ring()
	body.holes.append(PackedVector2Array())
	check_equal(body.holes.size(), 1, "holes")


func test_a_point_in_a_hole_is_not_inside_the_body() -> void:
	var body := add_weightless_body(Vector2(100, 50), {"polygon": _circle(RADIUS), "holes": [_circle(15, 16, Vector2(20, 0))] as Array[PackedVector2Array], "rotation": 0.5, "scale": Vector2(2, 2)})
	body.linear_velocity = Vector2(200, 0)
	body.angular_velocity = 3
	for i in 20:
		await ticks(1)
		check(not body.has_point(body.to_global(Vector2(20, 0))), "not in the hole")
		check(body.has_point(body.to_global(Vector2(-20, 0))), "in the body")
		check(body.has_point(body.to_global(Vector2(41, 0))), "in the wall")
		check(not body.has_point(body.to_global(Vector2(55, 0))), "outside")


func test_holes_fly_and_spin_with_the_body() -> void:
	var body := add_weightless_body(Vector2(100, 50), {"polygon": _circle(RADIUS), "holes": [_circle(15, 16, Vector2(20, 0))] as Array[PackedVector2Array]})
	body.linear_velocity = Vector2(120, 40)
	body.angular_velocity = 2
	for i in 30:
		await ticks(1)
		var expected: PackedVector2Array = body.global_transform * body.holes[0]
		check_points_near(body.get_interpolated_holes(1.0)[0], expected, 0.5, "hole at tick %d" % i)


func test_a_ring_bends_where_a_disk_does_not() -> void:
	var gaps: Array[float] = []
	for holes: Array[PackedVector2Array] in [[] as Array[PackedVector2Array], [_circle(INNER)] as Array[PackedVector2Array]]:
		var body := add_weightless_body(Vector2.ZERO, {"polygon": _circle(RADIUS), "holes": holes, "firm_for_weight": false, "youngs_modulus": 2000.0})
		check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model")
		for tick in 240:
			body.apply_point_force(8, Vector2(0, -30))
			body.apply_point_force(24, Vector2(0, 30))
			await ticks(1)
		var points := body.get_point_positions()
		gaps.append(2 * RADIUS - points[8].distance_to(points[24]))
		if not holes.is_empty():
			var hole := body.get_interpolated_holes(1.0)[0]
			# The wall is as wide as before, over and beside the hole.
			check_near(points[8].distance_to(hole[8]), RADIUS - INNER, 1.5, "wall above")
			check_near(points[0].distance_to(hole[0]), RADIUS - INNER, 1.5, "wall beside")
		body.free()
	check_above(gaps[1], 4 * gaps[0], "the ring gives way")
	check_below(gaps[1], RADIUS, "but not all the way")


func test_a_ring_falls_and_rests_without_being_crushed() -> void:
	add_floor(300)
	var ring := _ring(Vector2(0, 200))
	await ticks(240)
	check(all_finite(ring.get_point_positions()), "finite")
	check_above(bounds_of(ring.get_interpolated_polygon(1.0)).size.y, 1.5 * RADIUS, "height at rest")
	var outline := ring.get_interpolated_polygon(1.0)
	for point in ring.get_interpolated_holes(1.0)[0]:
		check(Geometry2D.is_point_in_polygon(point, outline), "the hole stays inside")
	await check_rests(ring)


func test_triangles_and_springs_have_holes_too() -> void:
	add_floor(300)
	for model: int in [SoftBody2D.ELASTIC_MODEL_TRIANGLES, SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA, SoftBody2D.ELASTIC_MODEL_NETWORK]:
		var ring := _ring(Vector2(0, 240), {"holes": [_circle(20)] as Array[PackedVector2Array], "elastic_model": model})
		check_equal(ring.get_elastic_model_in_use(), model, "model")
		await ticks(60)
		check(all_finite(ring.get_interpolated_holes(1.0)[0]), "finite, model %d" % model)
		ring.free()


func test_holes_are_saved_and_duplicated() -> void:
	var ring := _ring(Vector2.ZERO, {"name": "Ring"})
	var copy := ring.duplicate() as SoftBody2D
	check_equal(copy.holes, ring.holes, "holes of a duplicate")
	copy.free()
	var scene := PackedScene.new()
	check_equal(scene.pack(ring), OK, "packed")
	var loaded := scene.instantiate() as SoftBody2D
	check_equal(loaded.holes, ring.holes, "holes of a scene")
	stage.add_child(loaded)
	check_equal(loaded.mass, ring.mass, "mass")


func test_holes_change_while_the_body_moves() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"polygon": _circle(RADIUS)})
	body.linear_velocity = Vector2(100, 0)
	body.angular_velocity = 1
	await ticks(10)
	var place := body.get_center_of_mass_position()
	body.holes = [_circle(INNER)] as Array[PackedVector2Array]
	check_near(body.get_center_of_mass_position(), place, 0.01, "center of mass")
	check_near(body.linear_velocity, Vector2(100, 0), 0.1, "velocity")
	check_near(body.angular_velocity, 1.0, 0.01, "spin")
	await ticks(10)
	body.holes = [] as Array[PackedVector2Array]
	check_near(body.linear_velocity, Vector2(100, 0), 0.1, "velocity without holes")
	check_equal(body.get_interpolated_holes().size(), 0, "drawn holes")


func test_a_body_with_holes_is_not_cut_and_says_so() -> void:
	var ring := _ring()
	await ticks(1)
	check(ring.get_cut_problem([Vector2(-100, 0), Vector2(100, 0)]).contains("holes"), "the problem names the holes")
	check_refused(func() -> void: ring.cut(Vector2(-100, 0), Vector2(100, 0)), ["holes"], "a cut")
	ring.tear_stretch = 1.5
	check(", ".join(ring.get_warnings()).contains("tear_stretch does nothing"), "a warning about tears")
	ring.holes = [] as Array[PackedVector2Array]
	check_equal(ring.get_cut_problem([Vector2(-100, 0), Vector2(100, 0)]), "", "without holes it is cut")


func test_a_state_puts_a_ring_back() -> void:
	add_floor(300)
	var ring := _ring(Vector2(0, 220))
	await ticks(30)
	var state := ring.get_state()
	var points := ring.get_point_positions()
	var hole := ring.get_interpolated_holes(1.0)[0]
	await ticks(30)
	check_equal(ring.set_state(state), OK, "set")
	check_equal(ring.get_point_positions(), points, "points")
	check_points_near(ring.get_interpolated_holes(1.0)[0], hole, 0.01, "hole")
