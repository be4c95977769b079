# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Inner points and springs of one's own: which points are joined, how strongly, and what becomes of values that do not fit.

const SQUARE: Array[Vector2] = [Vector2(-40, -40), Vector2(40, -40), Vector2(40, 40), Vector2(-40, 40)]


func _square(properties := {}) -> SoftBody2D:
	return add_weightless_body(Vector2.ZERO, {"polygon": PackedVector2Array(SQUARE), "mass": 1.0, "center_point": false}.merged(properties, true))


func _warnings(body: SoftBody2D) -> String:
	return "\n".join(body.get_warnings())


func test_the_automatic_springs_are_a_ring_and_spokes() -> void:
	var body := add_weightless_body()
	check_equal(body.get_spring_count(), 32, "number of springs")
	for i in 16:
		check_equal(body.get_spring_points(i), Vector2i(i, (i + 1) % 16), "points of polygon spring %d" % i)
		check_equal(body.get_spring_points(16 + i), Vector2i(i, 16), "points of spoke %d" % i)
	check_near(body.get_spring_length(20), 50.0, 0.01, "length of a spoke")
	check_near(body.get_spring_rest_length(20), 50.0, 0.01, "rest length of a spoke")
	check_near(body.get_spring_strain(20), 0.0, 1e-4, "strain of a spoke")


func test_springs_are_told_alike_in_and_outside_the_tree_at_any_winding_and_scale() -> void:
	var polygon := SoftBody2D.make_box_polygon(Vector2(100, 60), 30)
	var backwards := polygon.duplicate()
	backwards.reverse()
	for outline: PackedVector2Array in [polygon, backwards]:
		for scale: Vector2 in [Vector2.ONE, Vector2(-1, 1), Vector2(2, 0.5)]:
			var body := SoftBody2D.new()
			body.gravity_scale = 0
			body.polygon = outline
			body.scale = scale
			var before := body.get_all_springs()
			var lengths := PackedFloat32Array()
			for i in body.get_spring_count():
				lengths.append(body.get_spring_length(i))
			stage.add_child(body)
			check_equal(body.get_all_springs(), before, "springs in and outside the tree")
			var points := body.get_point_positions()
			for i in body.get_spring_count():
				var ends := body.get_spring_points(i)
				check_equal(ends, Vector2i(before[2 * i], before[2 * i + 1]), "points of spring %d" % i)
				check_near(body.get_spring_length(i), points[ends.x].distance_to(points[ends.y]), 0.01, "length of spring %d" % i)
				check_near(lengths[i], body.get_spring_length(i), 0.01, "length of spring %d before it entered" % i)
			body.free()


func test_the_automatic_springs_written_down_are_the_same_body() -> void:
	add_floor(60)
	var automatic := add_body(Vector2.ZERO, {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	var written := add_body(Vector2(512, 0), {"springs": automatic.get_all_springs()})
	for i in 60:
		await ticks(1)
	check_points_near(written.get_point_positions(), Transform2D(0, Vector2(512, 0)) * automatic.get_point_positions(), 0.02, "points")
	check_above(written.global_position.y, 5, "fall")


func test_factors_follow_the_material_and_belong_to_their_spring() -> void:
	var body := _square({"spring_stiffness_scales": PackedFloat32Array([1, 2, 0.5, 0])})
	for value: float in [100.0, 300.0]:
		body.stiffness = value
		for i in 4:
			check_near(body.get_spring_stiffness(i), value * body.spring_stiffness_scales[i], 1e-3, "stiffness of spring %d" % i)
	body.set_spring_stiffness_scale(3, 4.0)
	check_equal(body.spring_stiffness_scales, PackedFloat32Array([1, 2, 0.5, 4]), "factors after one was set")
	check_near(body.get_spring_stiffness(3), 1200.0, 1e-2, "stiffness of that spring")
	check_equal(body.spring_damping_scales, PackedFloat32Array(), "factors on the damping")
	body.set_spring_damping_scale(1, 3.0)
	check_equal(body.spring_damping_scales, PackedFloat32Array([1, 3, 1, 1]), "factors on the damping after one was set")
	check_near(body.get_spring_damping(1), 0.36, 1e-5, "damping of that spring")
	body.set_spring_length_scale(0, 1.25)
	check_near(body.get_spring_rest_length(0), 100.0, 1e-3, "rest length of the top spring")
	check_near(body.get_spring_strain(0), -0.2, 1e-5, "its strain")


func test_a_spring_that_wants_to_be_shorter_pulls_its_ends_together() -> void:
	# A muscle changes the shape that the body wants; the limits go by the one that it was designed with.
	var body := _square({"shape_matching": 0.0, "shape_damping_ratio": 0.0, "damping": 3.0, "least_area": 0.0})
	body.set_spring_length_scale(0, 0.5)
	await seconds(2)
	check_near(body.get_spring_length(0), 40.0, 1, "length of the top spring")
	check_near(body.get_spring_strain(0), 0.0, 0.02, "its strain")


func test_a_painted_body_moves_alike_in_either_winding() -> void:
	var reversed := PackedVector2Array([SQUARE[0], SQUARE[3], SQUARE[2], SQUARE[1]])
	var body := _square({"spring_length_scales": PackedFloat32Array([0.5, 1, 1, 1])})
	# The same spring, between the first point and (40, -40), is the last of the outline that runs the other way.
	var mirrored := add_weightless_body(Vector2(400, 0), {"polygon": reversed, "mass": 1.0, "center_point": false,
			"spring_length_scales": PackedFloat32Array([1, 1, 1, 0.5])})
	await ticks(20)
	var a := body.get_point_positions()
	var b := mirrored.get_point_positions()
	check_above(a[1].distance_to(SQUARE[1]), 2, "way of a corner")
	for i in 4:
		check_near(b[(4 - i) % 4] - Vector2(400, 0), a[i], 0.01, "corner %d" % i)


func test_inner_points_are_points_of_the_body() -> void:
	var inner := PackedVector2Array([Vector2(-15, -10), Vector2(20, 5)])
	var body := add_weightless_body(Vector2(100, 50), {"polygon": PackedVector2Array(SQUARE), "inner_points": inner, "mass": 1.0,
			"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	check_equal(body.get_point_count(), 7, "number of points")
	var points := body.get_point_positions()
	for i in 2:
		check_near(points[4 + i], Vector2(100, 50) + inner[i], 0.01, "inner point %d" % i)
	check_near(points[6], Vector2(100, 50), 0.01, "center point")
	check_equal(polygon_of(body).size(), 4, "polygon points")
	body.apply_point_impulse(5, Vector2(1, 0))
	check_near(body.get_point_velocities()[5], Vector2(7, 0), 1e-3, "velocity of the inner point, a seventh of the mass")
	await ticks(3)
	check_near(body.linear_velocity, Vector2(1, 0), 1e-3, "velocity of the body, whose springs the point pulls at")
	check_above(body.get_point_velocities()[0].x, 0.001, "velocity of a corner")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings")


func test_every_inner_point_is_held_by_springs() -> void:
	var inner := PackedVector2Array()
	for i in 25:
		inner.append(Vector2.from_angle(i * 2.4) * sqrt(i) * 8)
	var body := add_weightless_body(Vector2.ZERO, {"inner_points": inner})
	var held := {}
	for index in body.get_all_springs():
		held[index] = held.get(index, 0) + 1
	for i in range(16, 41):
		check_above(held.get(i, 0), 2, "springs at inner point %d" % i)


func test_properties_may_be_set_in_any_order() -> void:
	var values := {
		"polygon": PackedVector2Array(SQUARE), "inner_points": PackedVector2Array([Vector2(10, 0)]), "center_point": false,
		"springs": PackedInt32Array([0, 1, 1, 2, 2, 3, 3, 0, 0, 4, 1, 4]),
		"spring_stiffness_scales": PackedFloat32Array([1, 1, 1, 1, 2, 3]),
		"spring_length_scales": PackedFloat32Array([1, 1, 1, 1, 1, 0.75]),
	}
	var names := values.keys()
	var random := RandomNumberGenerator.new()
	random.seed = 5
	for in_tree: bool in [false, true]:
		for attempt in 12:
			var order := names.duplicate()
			for i in range(order.size() - 1, 0, -1):
				var j := random.randi_range(0, i)
				var swapped: String = order[i]
				order[i] = order[j]
				order[j] = swapped
			var body := add_weightless_body() if in_tree else SoftBody2D.new()
			for name: String in order:
				body.set(name, values[name])
			for name: String in order:
				check_equal(body.get(name), values[name], "%s after %s" % [name, order])
			check_equal(body.get_all_springs(), values["springs"], "springs after %s" % [order])
			check_near(body.get_spring_stiffness(5), 300.0, 0.01, "stiffness of a spring after %s" % [order])
			check_equal(body.get_warnings(), PackedStringArray(), "warnings after %s" % [order])
			body.free()


func test_what_does_not_fit_is_kept_left_out_and_told_once() -> void:
	var body := _square({"springs": PackedInt32Array([0, 1, 1, 2, 2, 3, 3, 0, 0, 2]),
			"spring_stiffness_scales": PackedFloat32Array([1, 1, 1, 1, 2])})
	body.name = "Jelly"
	await ticks(2)
	check_equal(body.get_warnings(), PackedStringArray(), "warnings while all fits")
	body.polygon = PackedVector2Array([SQUARE[0], SQUARE[1], Vector2(0, 40)])
	check_equal(body.get_spring_count(), 3, "springs of the triangle")
	check("springs[1]" in _warnings(body) or "springs[2]" in _warnings(body), "no warning about the springs: " + _warnings(body))
	check_equal(body.springs.size(), 10, "entries of springs")
	take_errors()
	await ticks(10)
	var errors := take_errors()
	if check_equal(errors.size(), 1, "errors in ten ticks"):
		check("Jelly" in errors[0] and "springs" in errors[0], "the error does not say what is wrong: " + errors[0])
	body.polygon = PackedVector2Array(SQUARE)
	check_equal(body.get_spring_count(), 5, "springs after the fourth corner is back")
	check_equal(body.get_spring_stiffness(4), 200.0, "stiffness of the diagonal")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after the fourth corner is back")
	body.spring_stiffness_scales = PackedFloat32Array([2])
	check_equal(body.get_spring_stiffness(0), 100.0, "stiffness with one factor for five springs")
	check("spring_stiffness_scales" in _warnings(body) and "5" in _warnings(body), "no warning about the factors: " + _warnings(body))
	body.spring_stiffness_scales = PackedFloat32Array()
	check_equal(body.get_warnings(), PackedStringArray(), "warnings without factors")


func test_what_can_never_be_right_is_refused() -> void:
	var body := _square()
	body.name = "Jelly"
	for bad: Array in [["springs", PackedInt32Array([0, 1, 2]), "pairs"], ["springs", PackedInt32Array([0, -1]), "springs[0]"],
			["springs", PackedInt32Array([0, 1, 2, 2]), "springs[1]"], ["springs", PackedInt32Array([0, 1, 2, 3, 1, 0]), "twice"],
			["spring_stiffness_scales", PackedFloat32Array([1, -1, 1, 1]), "spring_stiffness_scales[1]"],
			["spring_damping_scales", PackedFloat32Array([1, 1, NAN, 1]), "spring_damping_scales[2]"],
			["spring_length_scales", PackedFloat32Array([0, 1, 1, 1]), "spring_length_scales[0]"],
			["inner_points", PackedVector2Array([Vector2(INF, 0)]), "inner_points[0]"]]:
		var old: Variant = body.get(bad[0])
		check_refused(func() -> void: body.set(bad[0], bad[1]), ["Jelly", bad[2]], "%s = %s" % [bad[0], bad[1]])
		check_equal(body.get(bad[0]), old, "%s after a refused value" % bad[0])
		body.set(bad[0], old)
	check_refused(func() -> void: body.get_spring_length(4), ["Jelly", "4"], "the length of a spring that is not there")
	check_refused(func() -> void: body.set_spring_stiffness_scale(-1, 1), ["Jelly", "-1"], "the factor of a spring that is not there")
	check_refused(func() -> void: body.set_spring_stiffness_scale(0, -1), ["Jelly", "spring_stiffness_scales[0]"], "a negative factor")
	check_equal(body.get_spring_count(), 4, "number of springs at the end")
	check_equal(body.get_warnings().size(), 1, "warnings: the last refused factor")


func test_another_polygon_keeps_the_motion() -> void:
	var body := add_weightless_body()
	body.linear_velocity = Vector2(120, -30)
	body.angular_velocity = 2.0
	await ticks(10)
	body.polygon = SoftBody2D.make_circle_polygon(80, 24)
	check_near(body.linear_velocity, Vector2(120, -30), 0.05, "velocity")
	check_near(body.angular_velocity, 2.0, 0.02, "spin")
	check_near(body.get_rest_area(), 24 * 0.5 * 6400 * sin(TAU / 24), 20, "area")
	await ticks(10)
	check_near(body.linear_velocity, Vector2(120, -30), 0.05, "velocity ten ticks later")


func test_a_body_with_inner_points_is_drawn_and_rests() -> void:
	add_floor(60)
	var body := add_body(Vector2.ZERO, {"inner_points": PackedVector2Array([Vector2(10, 10), Vector2(-20, 0), Vector2(0, -25)]),
			"stiffness": 150.0})
	await check_rests(body, 6)
