# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Outlines: the makers of polygons, order and winding of points, holes that look like dents.

const DENTED: Array[Vector2] = [
	Vector2(-60, -40), Vector2(-30, -45), Vector2(0, 5), Vector2(30, -45), Vector2(60, -40),
	Vector2(60, 0), Vector2(60, 40), Vector2(20, 40), Vector2(-20, 40), Vector2(-60, 40), Vector2(-60, 0),
]


func _area(polygon: PackedVector2Array) -> float:
	var doubled := 0.0
	for i in polygon.size():
		doubled += polygon[i - 1].cross(polygon[i])
	return doubled / 2


func test_a_circle_has_its_radius_and_count() -> void:
	var polygon := SoftBody2D.make_circle_polygon(40, 24)
	check_equal(polygon.size(), 24, "number of points")
	for point in polygon:
		check_near(point.length(), 40.0, 0.001, "distance from the center")
	check_near(polygon[0], Vector2(40, 0), 0.001, "first point")
	check_near(absf(_area(polygon)), 24 / 2.0 * 40 * 40 * sin(TAU / 24), 1, "area")


func test_a_box_has_its_size_and_no_gap_above_the_spacing() -> void:
	var polygon := SoftBody2D.make_box_polygon(Vector2(100, 60), 20)
	check_equal(bounds_of(polygon), Rect2(-50, -30, 100, 60), "bounds")
	check_equal(polygon.size(), 16, "number of points")
	for i in polygon.size():
		check_below(polygon[i - 1].distance_to(polygon[i]), 20.001, "gap")
	check_near(absf(_area(polygon)), 6000.0, 0.1, "area")


func test_a_capsule_has_its_radius_and_height() -> void:
	var polygon := SoftBody2D.make_capsule_polygon(20, 100, 8)
	var box := bounds_of(polygon)
	check_near(box.size.x, 40.0, 0.1, "width")
	check_near(box.size.y, 100.0, 0.6, "height")
	check_near(box.get_center(), Vector2.ZERO, 0.5, "center")


func test_makers_refuse_what_is_no_shape() -> void:
	var wrong: Dictionary = {
		"circle of radius 0": func() -> PackedVector2Array: return SoftBody2D.make_circle_polygon(0, 16),
		"circle of radius NAN": func() -> PackedVector2Array: return SoftBody2D.make_circle_polygon(NAN, 16),
		"circle of 2 points": func() -> PackedVector2Array: return SoftBody2D.make_circle_polygon(50, 2),
		"circle of 5000 points": func() -> PackedVector2Array: return SoftBody2D.make_circle_polygon(50, 5000),
		"box without width": func() -> PackedVector2Array: return SoftBody2D.make_box_polygon(Vector2(0, 10), 5),
		"box without spacing": func() -> PackedVector2Array: return SoftBody2D.make_box_polygon(Vector2(10, 10), 0),
		"capsule of no length": func() -> PackedVector2Array: return SoftBody2D.make_capsule_polygon(50, 100, 5),
	}
	for what: String in wrong:
		var maker: Callable = wrong[what]
		check_refused(func() -> void:
			var made: PackedVector2Array = maker.call()
			check(made.is_empty(), "a %s was made" % what), [], what)


func test_points_are_in_the_order_of_the_polygon_then_the_center() -> void:
	for polygon: PackedVector2Array in [PackedVector2Array(DENTED), _reversed(DENTED)]:
		var body := add_weightless_body(Vector2(300, 200), { "polygon": polygon, "rotation": 0.5 })
		var expected := body.global_transform * polygon
		check_equal(body.get_point_count(), polygon.size() + 1, "get_point_count()")
		check_equal(body.polygon, polygon, "polygon")
		check_points_near(polygon_of(body), expected, 0.01, "points and polygon")
		await ticks(30)
		check_points_near(polygon_of(body), expected, 0.01, "points and polygon after half a second")
		var mean := Vector2.ZERO
		for point in polygon_of(body):
			mean += point / polygon.size()
		check_near(body.get_point_positions()[polygon.size()], mean, 0.05, "the center point")
		check_points_near(body.get_interpolated_polygon(1), expected, 0.01, "interpolated polygon and polygon")
		body.free()


func test_negative_winding_moves_like_positive_winding() -> void:
	var runs: Array[PackedVector2Array] = []
	for polygon: PackedVector2Array in [PackedVector2Array(DENTED), _reversed(DENTED)]:
		var floor_body := add_floor(100)
		var body := add_body(Vector2(0, -60), { "polygon": polygon, "rotation": 0.4 })
		check_above(body.get_area(), 0, "area")
		await ticks(20)
		body.apply_point_impulse(polygon.find(DENTED[2]), Vector2(60, -40))
		await ticks(100)
		var points := PackedVector2Array()
		for corner in DENTED:
			points.append(body.get_point_positions()[polygon.find(corner)])
		runs.append(points)
		body.free()
		floor_body.free()
	check_points_near(runs[0], runs[1], 0.5, "a body and its twin of the other winding")


func test_forces_reach_the_point_of_the_given_index_in_either_winding() -> void:
	for polygon: PackedVector2Array in [PackedVector2Array(DENTED), _reversed(DENTED)]:
		var body := add_weightless_body(Vector2.ZERO, { "polygon": polygon })
		for index: int in [0, 1, 4, polygon.size() - 1, polygon.size()]:
			body.reset()
			body.apply_point_impulse(index, Vector2(10, 0))
			var velocities := body.get_point_velocities()
			for i in velocities.size():
				check(velocities[i].is_zero_approx() == (i != index), "an impulse on %d moves %d wrongly" % [index, i])


func test_a_dented_polygon_keeps_its_dent() -> void:
	add_floor(100)
	var body := add_body(Vector2.ZERO, { "polygon": PackedVector2Array(DENTED), "stiffness": 1500.0 })
	check(not body.has_point(body.to_global(Vector2(0, -20))), "the dent counts as inside")
	check(body.has_point(body.to_global(Vector2(0, 20))), "the belly counts as outside")
	check_near(body.get_rest_area(), absf(_area(DENTED)), 1, "rest area")
	await check_rests(body)
	check(not body.has_point(body.to_global(Vector2(0, -25))), "the dent has closed")


func test_a_body_may_sit_on_a_peg_in_its_dent() -> void:
	add_solid(circle(12), Transform2D(0, Vector2(0, 100)))
	# Open below, and the peg reaches far above the middle: it hangs there like a pendulum.
	var polygon := PackedVector2Array([Vector2(-60, -50), Vector2(-20, -50), Vector2(20, -50), Vector2(60, -50),
			Vector2(60, 0), Vector2(60, 50), Vector2(30, 50), Vector2(25, 0), Vector2(0, -15), Vector2(-25, 0),
			Vector2(-30, 50), Vector2(-60, 50), Vector2(-60, 0)])
	var body := add_body(Vector2.ZERO, { "polygon": polygon, "stiffness": 1500.0 })
	await check_rests(body)
	check_above(body.get_center_of_mass_position().y, 40, "height of the body on the peg")
	check_below(body.get_center_of_mass_position().y, 120, "height of the body on the peg")


func test_changing_the_polygon_while_running_rebuilds_the_body() -> void:
	add_floor(100)
	var body := add_body()
	await seconds(2)
	body.polygon = SoftBody2D.make_box_polygon(Vector2(60, 60), 15)
	check_equal(body.get_point_count(), 17, "get_point_count()")
	check_near(body.get_rest_area(), 3600.0, 1, "rest area")
	await check_rests(body)


func _reversed(points: Array[Vector2]) -> PackedVector2Array:
	var reversed := PackedVector2Array(points)
	reversed.reverse()
	return reversed
