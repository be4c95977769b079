# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Setters refuse what cannot work, say why, keep the old value, and the editor shows it until it is put right.

## Refused values, and a good one that differs from the default.
const NUMBERS := {
	"mass": [[0.0, -1.0, NAN, INF], 2.5],
	"stiffness": [[-1.0, NAN, INF], 120.0],
	"damping": [[-0.1, NAN, INF], 0.5],
	"rolling_resistance": [[-0.1, NAN, INF], 0.2],
	"shape_matching": [[-0.1, NAN, INF], 0.8],
	"shape_damping_ratio": [[-0.1, NAN, INF], 0.5],
	"gravity_scale": [[NAN, INF, -INF], -2.0],
	"substeps": [[-1, 65], 8],
}
const GOOD_POLYGON: Array[Vector2] = [Vector2(-40, -40), Vector2(40, -40), Vector2(40, 40), Vector2(-40, 40)]
const POLYGONS := {
	"no points": [],
	"two points": [Vector2(0, 0), Vector2(50, 0)],
	"a bow tie": [Vector2(-40, -40), Vector2(40, 40), Vector2(40, -40), Vector2(-40, 40)],
	"points on one line": [Vector2(0, 0), Vector2(50, 0), Vector2(100, 0)],
	"a point given twice": [Vector2(-40, -40), Vector2(-40, -40), Vector2(40, -40), Vector2(0, 40)],
	"NAN": [Vector2(-40, -40), Vector2(NAN, -40), Vector2(0, 40)],
	"INF": [Vector2(-40, -40), Vector2(40, -INF), Vector2(0, 40)],
}


func _warnings(body: SoftBody2D) -> String:
	return "\n".join(body.get_warnings())


func _make(in_tree: bool) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.name = "Jelly"
	if in_tree:
		stage.add_child(body)
	return body


func test_numbers_out_of_range_are_refused_and_the_old_value_stays() -> void:
	for in_tree: bool in [false, true]:
		var body := _make(in_tree)
		for property: String in NUMBERS:
			var old: Variant = NUMBERS[property][1] if in_tree else body.get(property)
			body.set(property, old)
			for value: Variant in NUMBERS[property][0]:
				var what := "%s = %s" % [property, value]
				check_refused(func() -> void: body.set(property, value), ["Jelly", property], what)
				check_equal(body.get(property), old, property + " after a refused value")
		body.free()


func test_the_message_names_the_value_and_the_bound() -> void:
	var body := _make(true)
	check_refused(func() -> void: body.mass = -3, ["Jelly", "mass", "-3", "0"], "mass = -3")
	check_refused(func() -> void: body.least_area = 1.5, ["Jelly", "least_area", "1.5", "1"], "least_area = 1.5")
	check_refused(func() -> void: body.substeps = 65, ["Jelly", "substeps", "65", "64"], "substeps = 65")
	check_refused(func() -> void: body.stiffness = NAN, ["Jelly", "stiffness", "nan"], "stiffness = NAN")
	check_refused(func() -> void: body.polygon = PackedVector2Array([Vector2.ZERO, Vector2.ONE]),
			["Jelly", "polygon", "2", "3"], "a polygon of two points")


func test_bounds_themselves_are_accepted() -> void:
	var body := _make(true)
	for value: Array in [["stiffness", 0.0], ["damping", 0.0], ["damping_ratio", 0.0], ["least_area", 0.0], ["least_area", 1.0],
			["rolling_resistance", 0.0], ["shape_matching", 0.0], ["shape_damping_ratio", 0.0], ["gravity_scale", 0.0],
			["substeps", 0], ["substeps", 64], ["mass", 0.001], ["collision_layer", 0], ["collision_mask", 0]]:
		body.set(value[0], value[1])
		check_equal(body.get(value[0]), value[1], value[0])
	await ticks(3)
	check(all_finite(body.get_point_positions()), "a point is not finite")


func test_bad_polygons_are_refused_and_the_old_one_stays() -> void:
	for in_tree: bool in [false, true]:
		var body := _make(in_tree)
		var old := PackedVector2Array(GOOD_POLYGON) if in_tree else body.polygon
		body.polygon = old
		for what: String in POLYGONS:
			var bad := PackedVector2Array(POLYGONS[what] as Array)
			check_refused(func() -> void: body.polygon = bad, ["Jelly", "polygon"], "a polygon of " + what)
			check_equal(body.polygon, old, "polygon after one of %s" % what)
			check_equal(body.get_point_count(), old.size() + 1, "point count after a polygon of " + what)
		body.free()


func test_a_warning_shows_the_refused_value_until_a_good_one_is_set() -> void:
	var body := _make(true)
	var clean := _warnings(body)
	for property: String in NUMBERS:
		var bad: Variant = NUMBERS[property][0][0]
		body.set(property, bad)
		take_errors()
		check(property in _warnings(body), "no warning about %s = %s: '%s'" % [property, bad, _warnings(body)])
		body.gravity_scale = body.gravity_scale if property != "gravity_scale" else 1.0
		body.set(property, body.get(property))
		check_equal(_warnings(body), clean, "warnings after a good value of " + property)
	body.polygon = PackedVector2Array()
	take_errors()
	check("polygon" in _warnings(body), "no warning about an empty polygon")
	body.rolling_resistance = 0.2
	check("polygon" in _warnings(body), "a good rolling resistance took the warning about the polygon away")
	body.polygon = PackedVector2Array(GOOD_POLYGON)
	check_equal(_warnings(body), clean, "warnings after a good polygon")


func test_several_warnings_stand_side_by_side() -> void:
	var body := _make(false)
	var clean := _warnings(body)
	body.mass = -1
	body.inflation = -1
	take_errors()
	check("mass" in _warnings(body) and "inflation" in _warnings(body), "not both: " + _warnings(body))
	body.mass = 2
	check(not "mass" in _warnings(body) and "inflation" in _warnings(body), "not only inflation: " + _warnings(body))
	body.inflation = 1
	check_equal(_warnings(body), clean, "warnings at the end")
	body.free()


func test_a_refused_value_does_not_disturb_the_motion() -> void:
	var body := _make(true)
	await ticks(10)
	for property: String in NUMBERS:
		body.set(property, NUMBERS[property][0][0])
	body.polygon = PackedVector2Array()
	take_errors()
	await ticks(20)
	check_near(body.get_linear_velocity().y, GRAVITY * 30 / 60, 0.2, "velocity after 30 ticks")


func test_the_defaults_warn_of_nothing() -> void:
	var body := _make(true)
	check_equal(_warnings(body), "", "warnings of a fresh body")


func test_values_that_will_not_work_well_are_warned_of() -> void:
	var body := _make(true)
	for change: Array in [["stiffness", 2.0, "fold"], ["mass", 60.0, "fold"], ["gravity_scale", 50.0, "fold"],
			["damping", 0.0, "Damping"]]:
		var good: Variant = body.get(change[0])
		body.set(change[0], change[1])
		check(change[2] in _warnings(body), "no warning about %s = %s" % [change[0], change[1]])
		body.set(change[0], good)
		check_equal(_warnings(body), "", "warnings after a good value of " + change[0])
	body.stiffness = 20_000
	body.damping = 1
	check_equal(_warnings(body), "", "warnings of a stiff body with automatic substeps")
	body.substeps = 1
	check("stable" in _warnings(body), "no warning about one substep for a stiff body")
	body.substeps = 0
	check_equal(_warnings(body), "", "warnings with automatic substeps again")


func test_a_transform_that_is_no_place_is_refused() -> void:
	var body := _make(true)
	body.gravity_scale = 0
	await ticks(2)
	body.global_position = Vector2(NAN, 0)
	await ticks(2)
	take_errors()
	check(all_finite(body.get_point_positions()), "a point is not finite after a position of NAN")
	check(body.global_position.is_finite(), "the node's position stays at NAN")
	body.scale = Vector2.ZERO # the engine makes a tiny number of it
	await ticks(2)
	take_errors()
	check(all_finite(body.get_point_positions()), "a point is not finite after a scale of zero")
	body.scale = Vector2.ONE
	await seconds(1)
	take_errors()
	check_near(body.get_area() / 7653.67, 1.0, 0.02, "area after the scale came back, over its first area")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after a good transform")


func test_a_polygon_whose_middle_is_one_of_its_points_is_refused_whole() -> void:
	var body := add_body()
	var old := body.polygon
	var mean_on_point := PackedVector2Array([Vector2(0, 0), Vector2(60, 0), Vector2(-30, 40), Vector2(-30, -40)])
	check_refused(func() -> void: body.polygon = mean_on_point, ["polygon", "center point"], "a middle on a polygon point")
	check_equal(body.polygon, old, "polygon")
	check_equal(body.get_point_positions().size(), old.size() + 1, "number of points")
	take_errors()
