# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A polygon of hundreds of points is drawn, and a hull of few is simulated.

const FineOutlines := preload("res://tests/support/fine_outlines.gd")


func _character(position: Vector2, properties := {}) -> SoftBody2D:
	var all := {"polygon": FineOutlines.character(), "detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC}
	all.merge(properties, true)
	return add_body(position, all)


func test_as_drawn_is_the_default_and_simulates_every_point() -> void:
	var body := add_body(Vector2.ZERO, {"polygon": FineOutlines.character()})
	check_equal(body.detail_mode, SoftBody2D.DETAIL_MODE_AS_DRAWN, "mode")
	check_equal(body.get_simulated_polygon(), body.polygon, "what is simulated")
	check_equal(body.get_point_count(), 201, "points")
	check_equal(body.get_detail_report().outline_error, 0.0, "error")


func test_automatic_simulates_few_points_within_the_tolerance() -> void:
	var body := _character(Vector2.ZERO)
	var report := body.get_detail_report()
	var radius := sqrt(FineOutlines.area(body.polygon) / PI)
	check_equal(report.points_drawn, 200, "points drawn")
	check_below(report.points_simulated, 24.5, "points simulated")
	check_equal(body.get_point_count(), report.points_simulated + 1, "points of the body")
	check_below(report.outline_error, 0.03, "error as a share of the radius")
	check_near(report.outline_error_px, report.outline_error * radius, 1e-3, "error in pixels")
	var hull := body.get_simulated_polygon()
	check_below(FineOutlines.distance(body.polygon, hull), 0.03 * radius + 0.01, "outline from hull")
	check_below(FineOutlines.distance(hull, body.polygon), 0.03 * radius + 0.01, "hull from outline")
	check_near(FineOutlines.area(hull), FineOutlines.area(body.polygon), 0.05, "area")
	check_near(body.get_area(), FineOutlines.area(body.polygon), 0.05, "area of the body")
	var as_drawn := add_body(Vector2(500, 0), {"polygon": body.polygon})
	check_equal(body.mass, as_drawn.mass, "mass, to the bit")
	# Other models of a body as drawn put their mass into the points, wherever these lie.
	as_drawn.elastic_model = SoftBody2D.ELASTIC_MODEL_TRIANGLES
	for model: int in [SoftBody2D.ELASTIC_MODEL_AUTOMATIC, SoftBody2D.ELASTIC_MODEL_NETWORK, SoftBody2D.ELASTIC_MODEL_SPRINGS_AND_SHAPE, SoftBody2D.ELASTIC_MODEL_TRIANGLES]:
		body.elastic_model = model
		check_near(body.get_center_of_mass(), as_drawn.get_center_of_mass(), 0.02, "center of mass, model %d" % model)


func test_the_default_polygon_is_simulated_as_drawn_in_every_mode() -> void:
	var usual := add_body(Vector2.ZERO)
	var automatic := add_body(Vector2(300, 0), {"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC})
	check_equal(automatic.get_simulated_polygon(), usual.polygon, "hull")
	await ticks(30)
	check_points_near(automatic.get_point_velocities(), usual.get_point_velocities(), 0.01, "velocities")


func test_a_number_of_points_and_a_tolerance_can_be_asked_for() -> void:
	var body := _character(Vector2.ZERO, {"detail_mode": SoftBody2D.DETAIL_MODE_POINT_COUNT, "detail_point_count": 30})
	check_below(body.get_simulated_polygon().size(), 30.5, "points")
	check_above(body.get_simulated_polygon().size(), 11.5, "points")
	body.detail_mode = SoftBody2D.DETAIL_MODE_AUTOMATIC
	var coarse := body.get_simulated_polygon().size()
	body.detail_tolerance = 0.005
	check_above(body.get_simulated_polygon().size(), coarse + 0.5, "points at a finer tolerance")
	body.detail_mode = SoftBody2D.DETAIL_MODE_AS_DRAWN
	check_equal(body.get_simulated_polygon(), body.polygon, "as drawn again")
	await ticks(2)
	check_equal(body.get_point_positions().size(), 201, "points of the body")


func test_bad_values_are_refused_and_nothing_changes() -> void:
	var body := _character(Vector2.ZERO)
	var hull := body.get_simulated_polygon()
	check_refused(func() -> void: body.detail_tolerance = 0, ["detail_tolerance", "0.001", "0.5"], "no tolerance")
	check_refused(func() -> void: body.detail_tolerance = NAN, ["detail_tolerance"], "NaN")
	check_refused(func() -> void: body.detail_point_count = 2, ["detail_point_count", "3"], "two points")
	check_refused(func() -> void: body.set("detail_mode", 7), ["detail_mode"], "an unknown mode")
	check_equal(body.get_simulated_polygon(), hull, "hull")
	check_equal(body.detail_tolerance, 0.03, "tolerance")


func test_the_drawn_outline_goes_with_a_body_that_flies_and_spins() -> void:
	var body := add_weightless_body(Vector2(100, 50), {"polygon": FineOutlines.character(), "detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC})
	body.linear_velocity = Vector2(120, 40)
	body.angular_velocity = 2
	await seconds(1)
	var drawn := body.get_interpolated_polygon(1)
	check_equal(drawn.size(), 200, "points drawn")
	var expected := body.global_transform * body.polygon
	for i in drawn.size():
		if not check_near(drawn[i], expected[i], 1.0, "point %d" % i):
			return


func test_polygons_of_either_winding_and_mirrored_nodes_are_drawn_where_they_are() -> void:
	for reverse: bool in [false, true]:
		for scale: Vector2 in [Vector2.ONE, Vector2(-1, 1), Vector2(2, 1.5)]:
			var polygon := FineOutlines.character()
			if reverse:
				polygon.reverse()
			var body := add_weightless_body(Vector2(0, 0), {"polygon": polygon, "detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC, "scale": scale, "rotation": 0.4})
			await ticks(2)
			var drawn := body.get_interpolated_polygon(1)
			var expected := body.global_transform * body.polygon
			check_below(FineOutlines.distance(drawn, expected), 0.05, "drawn outline, reversed %s, scale %s" % [reverse, scale])
			for i in drawn.size():
				if not check_near(drawn[i], expected[i], 0.1, "point %d" % i):
					break
			body.free()


func test_a_body_that_lies_on_a_floor_is_drawn_within_the_tolerance_of_it() -> void:
	add_floor(0)
	var body := _character(Vector2(0, -120))
	await seconds(3)
	var lowest := -INF
	for point in body.get_interpolated_polygon(1):
		lowest = maxf(lowest, point.y)
	# The hull rests on the floor; what is drawn keeps to the tolerance, 1.6 px here, and to its bend between hull points.
	check_near(lowest, 0.0, 3.2, "lowest drawn place")


func test_points_of_the_interface_are_those_that_are_simulated() -> void:
	var body := _character(Vector2.ZERO, {"gravity_scale": 0.0})
	await ticks(1)
	var hull := body.get_simulated_polygon()
	for i in hull.size():
		check_near(body.get_point_positions()[i], body.to_global(hull[i]), 0.05, "point %d" % i)
	var ear := body.get_nearest_point(Vector2(30, -72))
	body.set_point_pinned(ear, true)
	body.gravity_scale = 1
	var place := body.get_point_positions()[ear]
	await seconds(1)
	check_near(body.get_point_positions()[ear], place, 0.01, "the pinned point")
	check_equal(body.pinned_points, PackedInt32Array([ear]), "pins")
	# What is drawn there goes with it.
	check_below(FineOutlines.distance(PackedVector2Array([place]), body.get_interpolated_polygon(1)), 2.5, "outline at the pin")


func test_a_body_whose_detail_changes_goes_on_as_it_was_drawn() -> void:
	var body := _character(Vector2.ZERO, {"gravity_scale": 0.0, "detail_mode": SoftBody2D.DETAIL_MODE_AS_DRAWN})
	body.linear_velocity = Vector2(80, 50)
	body.angular_velocity = 1.5
	await ticks(1)
	var velocities := body.get_point_velocities()
	for k in velocities.size(): # squashed
		var arm := body.get_point_positions()[k] - body.global_position
		velocities[k] += Vector2(-arm.x, arm.y) * 4
	body.set_point_velocities(velocities)
	await ticks(2)
	check_above(largest_distance(body.get_interpolated_polygon(1), body.global_transform * body.polygon), 3.0, "how far it is squashed")
	for mode: int in [SoftBody2D.DETAIL_MODE_AUTOMATIC, SoftBody2D.DETAIL_MODE_POINT_COUNT, SoftBody2D.DETAIL_MODE_AS_DRAWN, SoftBody2D.DETAIL_MODE_AUTOMATIC]:
		var drawn := body.get_interpolated_polygon(1)
		var velocity := body.linear_velocity
		var spin := body.angular_velocity
		var area := body.get_area()
		body.detail_mode = mode
		check_below(largest_distance(body.get_interpolated_polygon(1), drawn), 1.6, "jump of a drawn point, mode %d" % mode)
		check_near(body.linear_velocity, velocity, 0.5, "velocity, mode %d" % mode)
		check_near(body.angular_velocity, spin, 0.02, "spin, mode %d" % mode)
		check_near(body.get_area() / area, 1.0, 0.01, "area, mode %d" % mode)
		await ticks(2)
	await seconds(3)
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.02, "area once it has calmed down")


func test_a_body_of_less_detail_is_cut_once_it_is_as_drawn_where_it_is_seen() -> void:
	var body := _character(Vector2.ZERO, {"gravity_scale": 0.0})
	for i in 6:
		for k in body.get_point_count():
			var arm := body.get_point_positions()[k] - body.global_position
			body.apply_point_impulse(k, Vector2(-arm.x, arm.y) * 0.05)
		await ticks(1)
	var drawn := body.get_interpolated_polygon(1)
	body.detail_mode = SoftBody2D.DETAIL_MODE_AS_DRAWN
	check_points_near(body.get_interpolated_polygon(1), drawn, 0.05, "outline as drawn")
	var pieces := body.cut(Vector2(-200, 0), Vector2(200, 0))
	check_equal(pieces.size(), 2, "pieces")
	for piece in pieces:
		check_below(FineOutlines.distance(piece.get_interpolated_polygon(1), drawn + PackedVector2Array([drawn[0]])), 60.0, "a piece lies where the whole was")


func test_a_scene_keeps_its_detail() -> void:
	var body := _character(Vector2.ZERO, {"detail_tolerance": 0.05})
	var scene := PackedScene.new()
	scene.pack(body)
	var copy := scene.instantiate() as SoftBody2D
	stage.add_child(copy)
	check_equal(copy.detail_mode, SoftBody2D.DETAIL_MODE_AUTOMATIC, "mode")
	check_equal(copy.detail_tolerance, 0.05, "tolerance")
	check_equal(copy.get_simulated_polygon(), body.get_simulated_polygon(), "hull")
	check_equal(copy.polygon, body.polygon, "polygon")


func test_a_state_goes_back_to_a_body_of_the_same_detail_only() -> void:
	add_floor(0)
	var body := _character(Vector2(0, -120))
	await ticks(40)
	var state := body.get_state()
	var points := body.get_point_positions()
	await ticks(20)
	check_equal(body.set_state(state), OK, "its own state")
	check_equal(body.get_point_positions(), points, "points")
	var other := add_body(Vector2(500, -200), {"polygon": body.polygon})
	check_refused(func() -> void: other.set_state(state), ["state refused"], "a state of another hull")


func test_a_body_of_less_detail_is_not_cut_and_says_what_to_do() -> void:
	var body := _character(Vector2.ZERO, {"gravity_scale": 0.0, "tear_stretch": 0.5})
	await ticks(2)
	check(body.get_cut_problem([Vector2(-200, 0), Vector2(200, 0)]).contains("As Drawn"), "the problem names the remedy")
	check_refused(func() -> void: body.cut(Vector2(-200, 0), Vector2(200, 0)), ["detail_mode", "As Drawn"], "a cut")
	check(" ".join(body.get_warnings()).contains("tear_stretch does nothing"), "a warning tells of tears")
	body.detail_mode = SoftBody2D.DETAIL_MODE_AS_DRAWN
	check(not " ".join(body.get_warnings()).contains("tear_stretch does nothing"), "no more")
	await ticks(1)
	check_equal(body.cut(Vector2(-200, 0), Vector2(200, 0)).size(), 2, "pieces as drawn")


func test_painted_values_of_the_outline_count_its_points() -> void:
	var colors := PackedColorArray()
	colors.resize(200)
	colors.fill(Color.RED)
	var uv := FineOutlines.character()
	var body := _character(Vector2.ZERO, {"vertex_colors": colors, "uv": uv})
	check(not " ".join(body.get_warnings()).contains("entries"), "one entry for each drawn point")
	body.uv = body.get_simulated_polygon()
	check(" ".join(body.get_warnings()).contains("entries"), "one for each simulated point is none")


func test_details_that_are_alike_share_one_shape_and_are_stepped_alike() -> void:
	var first := _character(Vector2(0, 0), {"gravity_scale": 0.0})
	var second := _character(Vector2(400, 0), {"gravity_scale": 0.0})
	first.apply_central_impulse(Vector2(50, 0))
	second.apply_central_impulse(Vector2(50, 0))
	await ticks(30)
	check_near(first.linear_velocity, second.linear_velocity, 1e-4, "velocity")
	check_equal(first.get_simulated_polygon(), second.get_simulated_polygon(), "hull")


func test_weights_paint_more_points_where_they_matter() -> void:
	var body := _character(Vector2.ZERO)
	var plain := body.get_simulated_polygon()
	var weights := PackedFloat32Array()
	for point in body.polygon:
		weights.append(4.0 if point.x > 0 else 1.0)
	body.detail_weights = weights
	var painted := body.get_simulated_polygon()
	var right := func(points: PackedVector2Array) -> int: return Array(points).filter(func(p: Vector2) -> bool: return p.x > 0).size()
	check_above(float(right.call(painted)), 1.5 * right.call(plain), "points on the painted side")
	check_below(float(painted.size() - right.call(painted)), plain.size() - right.call(plain) + 3.5, "points on the other side")
	await ticks(5)
	check(all_finite(body.get_point_positions()), "finite")
	var copy := body.duplicate() as SoftBody2D
	check_equal(copy.detail_weights, weights, "weights of a duplicate")
	copy.free()
	body.detail_weights = PackedFloat32Array()
	check_equal(body.get_simulated_polygon(), plain, "without weights")


func test_bad_weights_are_refused_and_a_wrong_number_is_told_of() -> void:
	var body := _character(Vector2.ZERO)
	var plain := body.get_simulated_polygon()
	check_refused(func() -> void: body.detail_weights = PackedFloat32Array([1, 0]), ["detail_weights[1]", "0.1", "10"], "a weight of 0")
	check_refused(func() -> void: body.detail_weights = PackedFloat32Array([NAN]), ["detail_weights[0]"], "NaN")
	body.detail_weights = PackedFloat32Array([1, 2, 3])
	check_equal(body.get_simulated_polygon(), plain, "hull")
	check(" ".join(body.get_warnings()).contains("detail_weights"), "a warning tells of the number")
