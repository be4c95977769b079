# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The logic of the editor addon, without an editor: edits of outlines and what becomes of springs and pins.

const LOGIC := "res://addons/soft_body_2d/editor/logic/"
const BodyValues := preload(LOGIC + "body_values.gd")
const Brush := preload(LOGIC + "brush.gd")
const PolygonEdit := preload(LOGIC + "polygon_edit.gd")
const Outline := preload(LOGIC + "outline.gd")
const PinEdit := preload(LOGIC + "pin_edit.gd")
const Presets := preload(LOGIC + "structure_presets.gd")
const Selection := preload(LOGIC + "selection.gd")
const SelectionBox := preload(LOGIC + "selection_box.gd")
const Snapping := preload(LOGIC + "snapping.gd")
const SpringEdit := preload(LOGIC + "spring_edit.gd")
const StartShapes := preload(LOGIC + "start_shapes.gd")
const StiffnessColors := preload(LOGIC + "stiffness_colors.gd")
const StructureRemap := preload(LOGIC + "structure_remap.gd")
const Words := preload(LOGIC + "words.gd")
const FineOutlines := preload("res://tests/support/fine_outlines.gd")

const SQUARE: PackedVector2Array = [Vector2(0, 0), Vector2(10, 0), Vector2(10, 10), Vector2(0, 10)]


func _values(polygon: PackedVector2Array, properties := {}) -> Dictionary:
	var body := SoftBody2D.new()
	body.polygon = polygon
	for property: String in properties:
		body.set(property, properties[property])
	var values := BodyValues.take(body)
	body.free()
	return values


## A body takes these values without a refusal and without a warning about its structure.
func _check_fits(values: Dictionary, what: String) -> void:
	var body := SoftBody2D.new()
	BodyValues.put(body, values)
	for property in BodyValues.PROPERTIES:
		check(BodyValues.is_same_value(body.get(property), values[property]), "%s: %s was not taken" % [what, property])
	var warnings := "\n".join(body.get_warnings())
	check(not "Left out" in warnings and not "refused" in warnings and not "pinned" in warnings, "%s: %s" % [what,
			warnings])
	body.free()


# Polygons.

func test_the_nearest_point_and_edge_within_the_radius_are_found() -> void:
	check_equal(PolygonEdit.nearest_point(SQUARE, Vector2(9, 1), 3), 1, "nearest point")
	check_equal(PolygonEdit.nearest_point(SQUARE, Vector2(5, 5), 3), -1, "point too far off")
	check_equal(PolygonEdit.nearest_edge(SQUARE, Vector2(5, -2), 3), 0, "edge above")
	check_equal(PolygonEdit.nearest_edge(SQUARE, Vector2(-1, 5), 3), 3, "edge that closes the outline")
	check_equal(PolygonEdit.nearest_edge(SQUARE, Vector2(5, 5), 3), -1, "edge too far off")


func test_points_are_inserted_erased_moved_and_boxed() -> void:
	check_equal(PolygonEdit.inserted(SQUARE, 3, Vector2(-1, 5)), PackedVector2Array(Array(SQUARE) + [Vector2(-1, 5)]),
			"after an insertion into the last edge")
	check_equal(PolygonEdit.erased(SQUARE, [0, 2]), PackedVector2Array([Vector2(10, 0), Vector2(0, 10)]), "after an erasure")
	check_equal(PolygonEdit.moved(SQUARE, [1], Vector2(2, 3))[1], Vector2(12, 3), "moved point")
	check_equal(PolygonEdit.points_in_box(SQUARE, Rect2(-1, -1, 12, 2)), PackedInt32Array([0, 1]), "points in a box")
	check_equal(SQUARE.size(), 4, "points of what was edited")


func test_edges_that_cross_are_named() -> void:
	var crossed: PackedVector2Array = [Vector2(0, 0), Vector2(10, 10), Vector2(10, 0), Vector2(0, 10)]
	var edges := PolygonEdit.crossing_edges(crossed, [1])
	check(0 in edges and 2 in edges, "edges 0 and 2 cross: %s" % [edges])


func test_a_selection_forgets_points_that_are_gone() -> void:
	var selection := Selection.new()
	var a := add_body()
	var b := add_body()
	selection.add(a, [3, 1])
	selection.add(b, [2])
	selection.toggle(a, 5)
	selection.toggle(b, 2)
	check_equal(selection.of(a), PackedInt32Array([1, 3, 5]), "points of a")
	check_equal(selection.size(), 3, "all points")
	selection.keep_to([a], [4])
	check_equal(selection.of(a), PackedInt32Array([1, 3]), "points of a that are left")


func test_a_selection_is_turned_and_scaled_about_a_place() -> void:
	var turn := SelectionBox.rotation_about(Vector2(5, 5), Vector2(5, 0), Vector2(10, 5), false)
	check_near(turn * Vector2(5, 0), Vector2(10, 5), 1e-4, "the handle goes with the mouse")
	check_near(turn * Vector2(5, 5), Vector2(5, 5), 1e-4, "the center")
	var stepped := SelectionBox.rotation_about(Vector2.ZERO, Vector2(1, 0), Vector2.from_angle(0.3), true)
	check_near(stepped.get_rotation(), deg_to_rad(15), 1e-5, "angle in steps")
	var grow := SelectionBox.scale_about(Vector2.ZERO, Vector2(10, 10), Vector2(20, 5), false)
	check_near(grow * Vector2(10, 10), Vector2(20, 5), 1e-4, "the corner goes with the mouse")
	var even := SelectionBox.scale_about(Vector2.ZERO, Vector2(10, 10), Vector2(20, 20), true)
	check_near(even * Vector2(3, 4), Vector2(6, 8), 1e-4, "scaled alike in both directions")
	var flat := SelectionBox.scale_about(Vector2.ZERO, Vector2(10, 10), Vector2(0, 10), false)
	check(flat.determinant() != 0, "a selection can be scaled up again")


func test_places_snap_to_a_grid_with_an_offset() -> void:
	var snapping := Snapping.new()
	check_equal(snapping.snapped_to_grid(Vector2(5, 5)), Vector2(5, 5), "place without snapping")
	snapping.enabled = true
	snapping.step = Vector2(10, 20)
	snapping.offset = Vector2(3, 0)
	check_equal(snapping.snapped_to_grid(Vector2(11, 11)), Vector2(13, 20), "place on the grid")


# What springs, pins and colors become.

func test_an_inserted_point_is_held_like_its_neighbors_and_indices_follow() -> void:
	var polygon := SoftBody2D.make_circle_polygon(50, 8)
	var inner: PackedVector2Array = [Vector2(10, 5)]
	var springs: PackedInt32Array = [0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 0, 2, 8, 3, 8, 7, 9]
	var scales := PackedFloat32Array(range(1, 12))
	var values := _values(polygon, {"inner_points": inner, "springs": springs, "spring_stiffness_scales": scales,
			"pinned_points": PackedInt32Array([1, 5, 9]), "pin_targets": [^"../A", ^"", ^"../B"] as Array[NodePath],
			"vertex_colors": PackedColorArray(Array(polygon).map(func(p: Vector2) -> Color: return Color(p.x / 100 + 0.5, 0, 0)))})
	var place := (polygon[2] + polygon[3]) / 2
	var old := PackedInt32Array([0, 1, 2, -1, 3, 4, 5, 6, 7])
	var after := StructureRemap.with_polygon(values, PolygonEdit.inserted(polygon, 2, place), old)
	_check_fits(after, "an insertion")
	var joined: PackedInt32Array = after[&"springs"]
	check(SpringEdit.find(joined, 2, 4) < 0, "the divided spring is gone")
	for pair: Array in [[2, 3], [3, 4], [3, 9], [2, 9], [4, 9], [8, 10], [8, 0]]:
		check(SpringEdit.find(joined, pair[0], pair[1]) >= 0, "points %s are joined" % [pair])
	check_equal(joined.size() / 2, 13, "springs")
	check_equal(after[&"spring_stiffness_scales"][SpringEdit.find(joined, 2, 3)], 3.0,
			"factor of a half of the divided spring")
	check_equal(after[&"spring_stiffness_scales"][SpringEdit.find(joined, 8, 10)], 11.0, "factor of a spring that stays")
	check_equal(after[&"pinned_points"], PackedInt32Array([1, 6, 10]), "pinned points")
	check_equal(after[&"pin_targets"], [^"../A", ^"", ^"../B"] as Array[NodePath], "targets")
	check_near(after[&"vertex_colors"][3].r, place.x / 100 + 0.5, 1e-5, "color of the new point")
	# Taking it out again gives what was, but for the order of the springs.
	var back := StructureRemap.with_polygon(after, polygon, PackedInt32Array([0, 1, 2, 4, 5, 6, 7, 8]))
	check_equal(back[&"pinned_points"], values[&"pinned_points"], "pinned points after the erasure")
	check_equal(back[&"vertex_colors"], values[&"vertex_colors"], "colors after the erasure")
	check(SpringEdit.find(back[&"springs"], 2, 3) < 0, "a spring between neighbors does not come back by itself")
	_check_fits(back, "an erasure")


func test_factors_of_automatic_springs_stay_with_their_points() -> void:
	var polygon := SoftBody2D.make_circle_polygon(50, 8)
	var values := _values(polygon, {"spring_stiffness_scales": PackedFloat32Array(range(1, 17))})
	var old_springs := BodyValues.springs(values)
	var after := StructureRemap.with_polygon(values, PolygonEdit.inserted(polygon, 4, (polygon[4] + polygon[5]) / 2),
			PackedInt32Array([0, 1, 2, 3, 4, -1, 5, 6, 7]))
	_check_fits(after, "an insertion")
	var springs := BodyValues.springs(after)
	check_equal(after[&"spring_stiffness_scales"].size(), springs.size() / 2, "factors")
	var new_of := [0, 1, 2, 3, 4, 6, 7, 8, 9] # the last is the center
	for i in old_springs.size() / 2:
		var a: int = new_of[old_springs[2 * i]]
		var b: int = new_of[old_springs[2 * i + 1]]
		if i != 4: # the one that was divided
			check_equal(after[&"spring_stiffness_scales"][SpringEdit.find(springs, a, b)], i + 1.0,
					"factor of the spring from %d to %d" % [a, b])
	for half: Array in [[4, 5], [5, 6]]:
		check_equal(after[&"spring_stiffness_scales"][SpringEdit.find(springs, half[0], half[1])], 5.0,
				"factor of the half %s" % [half])


func test_another_outline_takes_nothing_along_that_would_mean_nothing_and_says_so() -> void:
	var polygon := SoftBody2D.make_circle_polygon(50, 8)
	var values := _values(polygon, {"inner_points": PackedVector2Array([Vector2(3, 3)]),
			"pinned_points": PackedInt32Array([2]),
			"pin_targets": [^"../A"] as Array[NodePath]})
	check_equal(StructureRemap.losses(values), PackedStringArray(["inner_points", "pinned_points"]), "losses")
	_check_fits(StructureRemap.with_other_outline(values, SQUARE), "another outline")
	var resampled := StructureRemap.with_other_outline(values, Outline.resampled(polygon, 16), true)
	check_equal(resampled[&"pinned_points"], PackedInt32Array([4]), "the pin is at the nearest point")
	check_equal(resampled[&"pin_targets"], [^"../A"] as Array[NodePath], "and follows what it followed")
	check_equal(values[&"pinned_points"], PackedInt32Array([2]), "the values that it was made of")


func test_a_body_of_less_detail_is_edited_by_the_points_that_it_simulates() -> void:
	var polygon := FineOutlines.character()
	var values := _values(polygon, {"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC, "pinned_points": [0, 4]})
	var hull := BodyValues.hull(values)
	check_below(hull.size(), 24.5, "points of the hull")
	check_equal(BodyValues.point_count(values), hull.size() + 1, "points")
	check_equal(BodyValues.points(values).slice(0, hull.size()), hull, "places")
	check_equal(BodyValues.springs(values).size(), 4 * hull.size(), "springs of the hull and to its middle")
	# A dent that is drawn anew makes another hull: pins go to the points that are nearest.
	var old := PackedInt32Array(range(polygon.size()))
	var other := polygon.duplicate()
	for i in range(60, 80):
		other[i] = polygon[i].lerp(Vector2.ZERO, 0.2)
	var after := StructureRemap.with_polygon(values, other, old)
	check(BodyValues.hull(after) != hull, "the hull is another")
	for i in 2:
		var place := BodyValues.points(after)[after[&"pinned_points"][i]]
		check_near(place, hull[values[&"pinned_points"][i]], 12.0, "place of pin %d" % i)
	_check_fits(after, "another outline of a body of less detail")
	check_equal(BodyValues.hull(_values(polygon)), polygon, "hull of a body as drawn")


func test_springs_are_added_and_taken_out_with_their_factors() -> void:
	var values := _values(SoftBody2D.make_circle_polygon(50, 6), {"spring_damping_scales": PackedFloat32Array(range(1, 13))})
	var more := SpringEdit.with_spring(values, 0, 3)
	_check_fits(more, "another spring")
	check_equal(more[&"springs"].size() / 2, 13, "springs")
	check_equal(more[&"spring_damping_scales"][12], 1.0, "its factor")
	check(is_same(SpringEdit.with_spring(more, 3, 0), more), "the same spring again changes nothing")
	var fewer := SpringEdit.without_springs(more, [0, 12])
	_check_fits(fewer, "fewer springs")
	check_equal(fewer[&"springs"].size() / 2, 11, "springs that are left")
	check_equal(fewer[&"spring_damping_scales"][0], 2.0, "factor of the first that is left")
	check(is_same(SpringEdit.without_springs(more, PackedInt32Array(range(13))), more), "the last springs stay")
	check_equal(SpringEdit.of_kind(BodyValues.springs(values), 6, SpringEdit.Kind.POLYGON).size(), 6, "polygon springs")
	check_equal(SpringEdit.of_kind(BodyValues.springs(values), 6, SpringEdit.Kind.INNER).size(), 6, "inner springs")


func test_inner_points_come_and_go_and_the_center_point_stays_the_last() -> void:
	var values := _values(SoftBody2D.make_circle_polygon(50, 6), {"pinned_points": PackedInt32Array([6, 2]),
			"pin_targets": [^"../A", ^"../B"] as Array[NodePath]})
	var own := SpringEdit.with_spring(values, 0, 3)
	var more := SpringEdit.with_inner_point(own, Vector2(20, 5))
	_check_fits(more, "an inner point")
	check(SpringEdit.find(more[&"springs"], 7, 0) >= 0, "the center's springs are still the center's")
	check_equal(more[&"pinned_points"], PackedInt32Array([7, 2]), "the center's pin")
	check_equal(more[&"springs"].size() / 2, 16, "springs, with three of the new point")
	var back := SpringEdit.without_inner_point(more, 0)
	_check_fits(back, "without it")
	check_equal(back[&"springs"], own[&"springs"], "springs without it")
	check_equal(back[&"pinned_points"], PackedInt32Array([6, 2]), "pins without it")


func test_pins_keep_what_they_follow() -> void:
	var values := _values(SQUARE)
	var pinned := PinEdit.with_pins(PinEdit.with_target(values, [2, 3], ^"../A"), [3, 0], true)
	check_equal(pinned[&"pinned_points"], PackedInt32Array([2, 3, 0]), "pinned points")
	check_equal(pinned[&"pin_targets"], [^"../A", ^"../A", ^""] as Array[NodePath], "targets")
	var fewer := PinEdit.with_pins(pinned, [2], false)
	check_equal(fewer[&"pin_targets"], [^"../A", ^""] as Array[NodePath], "targets of those that stay")
	check_equal(values[&"pinned_points"], PackedInt32Array(), "the values that it was made of")


func test_values_come_back_byte_for_byte() -> void:
	var body := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([3, 1]), "pin_targets": [^"..",
			^""] as Array[NodePath]})
	var before := BodyValues.take(body)
	BodyValues.put(body, StructureRemap.with_other_outline(before, SoftBody2D.make_box_polygon(Vector2(80, 60), 20)))
	BodyValues.put(body, before)
	check_equal(var_to_bytes(BodyValues.take(body)), var_to_bytes(before), "values")


# Presets.

func test_every_preset_makes_a_body_that_finds_its_shape_again() -> void:
	for polygon: PackedVector2Array in [SoftBody2D.make_circle_polygon(50, 16), SoftBody2D.make_box_polygon(Vector2(120, 60), 20),
			PackedVector2Array([Vector2(-60, -40), Vector2(60, -40), Vector2(60, 40), Vector2(20, 40), Vector2(20, 0),
					Vector2(-60, 0)])]:
		for preset: int in Presets.Preset.values():
			var what := "preset %s of %d points" % [Presets.Preset.keys()[preset], polygon.size()]
			var after := Presets.with_preset(_values(polygon, {"pinned_points": PackedInt32Array([1, polygon.size()])}), preset)
			_check_fits(after, what)
			check_equal(after[&"pinned_points"], PackedInt32Array([1]), what + ": pins of the polygon stay")
	var lattice := Presets.with_preset(_values(SoftBody2D.make_circle_polygon(50, 16)), Presets.Preset.LATTICE)
	check_above(lattice[&"inner_points"].size(), 5, "points of a lattice")
	var braced := Presets.with_preset(_values(SoftBody2D.make_circle_polygon(50, 16)), Presets.Preset.CROSS_BRACED)
	check_above(braced[&"springs"].size() / 2, 39, "springs of a cross-braced circle")
	var large := Presets.with_preset(_values(SoftBody2D.make_circle_polygon(500, 1000)), Presets.Preset.LATTICE)
	check_below(large[&"inner_points"].size(), 600, "points of the lattice of a large polygon")


func test_braces_do_not_leave_a_dented_polygon() -> void:
	var horseshoe: PackedVector2Array = [Vector2(0, 0), Vector2(60, 0), Vector2(60, 60), Vector2(45, 60), Vector2(45, 15),
			Vector2(15, 15), Vector2(15, 60), Vector2(0, 60)]
	check(not Presets.sees(horseshoe, 2, 7), "the two ends do not see each other")
	check(Presets.sees(horseshoe, 0, 5), "a corner sees the one inside of it")


func test_what_users_read_can_be_translated() -> void:
	check_equal(Words.say("Trace Polygon"), "Trace Polygon", "text without a translation")
	if not TranslationServer.has_method(&"get_or_add_domain"):
		skip("this engine has no translation domains (4.4)")
		return
	var translation := Translation.new()
	translation.locale = TranslationServer.get_locale()
	translation.add_message("Trace Polygon", "Umriss nachzeichnen")
	var domain: Object = TranslationServer.call(&"get_or_add_domain", Words.DOMAIN)
	domain.call(&"add_translation", translation)
	check_equal(Words.say("Trace Polygon"), "Umriss nachzeichnen", "text with one")
	Words.unload_translations()
	check_equal(Words.say("Trace Polygon"), "Trace Polygon", "text after it was unloaded")


# Brush and colors.

func test_the_brush_is_full_in_the_middle_and_fades_evenly() -> void:
	var brush := Brush.new()
	brush.radius = 10
	brush.falloff = 0.5
	check_equal(brush.weight(0), 1.0, "weight in the middle")
	check_equal(brush.weight(4.9), 1.0, "weight where it is still full")
	check_near(brush.weight(7.5), 0.5, 1e-6, "weight half-way")
	check_near(brush.weight(6.25), 1 - 0.25 * 0.25 * 2.5, 1e-6,
			"weight a quarter of the way: it begins to fade without a kink")
	check_equal(brush.weight(10), 0.0, "weight at the edge")
	var last := 1.0
	for i in 101:
		check(brush.weight(i * 0.1) <= last, "the weight rises at %.1f" % (i * 0.1))
		last = brush.weight(i * 0.1)
	brush.falloff = 0
	check_equal(brush.weight(9.99), 1.0, "weight within a hard edge")


func test_the_brush_paints_towards_its_factor_and_only_what_it_touches() -> void:
	var brush := Brush.new()
	brush.radius = 4
	brush.target = 4
	var points: PackedVector2Array = [Vector2(0, 0), Vector2(10, 0), Vector2(0, 20), Vector2(10, 20)]
	var springs: PackedInt32Array = [0, 1, 2, 3]
	var factors: PackedFloat32Array = [1, 1]
	var once := brush.painted(factors, points, springs, Vector2(5, 0), 0.1)
	check(once[0] > 1 and once[0] < 4, "painted once: %s" % once[0])
	check_equal(once[1], 1.0, "factor of a spring that it does not touch")
	# Two strokes of half the time do what one does.
	var twice := brush.painted(brush.painted(factors, points, springs, Vector2(5, 0), 0.05), points, springs, Vector2(5,
			0), 0.05)
	check_near(twice[0], once[0], 1e-5, "factor after two half strokes")
	check_equal(brush.painted(factors, points, springs, Vector2(5, 0), 10)[0], 4.0, "factor after a long stroke")
	check_equal(factors, PackedFloat32Array([1, 1]), "what was painted on")


func test_colors_go_by_ratios_and_equal_springs_are_in_the_middle() -> void:
	var colors := StiffnessColors.new()
	colors.include(100, PackedFloat32Array())
	check_near(colors.place_of(100), 0.5, 1e-6, "place of springs that are all alike")
	colors.clear()
	colors.include(100, PackedFloat32Array([0.1, 1, 10]))
	check_near(colors.place_of(10), 0.0, 1e-6, "place of the softest")
	check_near(colors.place_of(100), 0.5, 1e-6, "place of the middle")
	check_near(colors.place_of(1000), 1.0, 1e-6, "place of the stiffest")
	check(colors.color_of(10) != colors.color_of(1000), "soft and stiff have colors of their own")


# Shapes.

func test_start_shapes_have_their_sizes_and_counts_and_bad_numbers_are_told() -> void:
	check_equal(StartShapes.circle(30, 12).size(), 12, "points of a circle")
	check_equal(PolygonEdit.bounds(StartShapes.rectangle(Vector2(80, 40), 10)).size, Vector2(80, 40), "size of a rectangle")
	check_near(PolygonEdit.bounds(StartShapes.capsule(20, 100, 8)).size, Vector2(40, 100), 0.5, "size of a capsule")
	var hexagon := StartShapes.regular_polygon(50, 6, 3)
	check_equal(hexagon.size(), 18, "points of a hexagon")
	check_near(absf(PolygonEdit.signed_area(hexagon)), 1.5 * sqrt(3) * 2500, 1, "area of a hexagon")
	for bad: Callable in [StartShapes.circle.bind(-1.0, 12), StartShapes.circle.bind(30.0, 2),
			StartShapes.circle.bind(30.0, 100000),
			StartShapes.rectangle.bind(Vector2(0, 10), 5.0), StartShapes.rectangle.bind(Vector2(100, 10), 0.0),
			StartShapes.capsule.bind(30.0, 40.0, 5.0), StartShapes.regular_polygon.bind(30.0, 2, 1)]:
		check_equal(bad.call(), PackedVector2Array(), "outline of bad numbers")
		check_above(StartShapes.last_problem.length(), 10, "length of the message")


func test_polygons_and_paths_lie_where_they_were() -> void:
	var polygon := Polygon2D.new()
	polygon.polygon = SQUARE
	polygon.offset = Vector2(5, 0)
	var made := StartShapes.from_polygon(polygon, Transform2D(0, Vector2(100, 0)))
	check_equal(made[0], Vector2(105, 0), "first point of a Polygon2D")
	polygon.polygon = [Vector2(0, 0), Vector2(10, 10), Vector2(10, 0), Vector2(0, 10)]
	check_equal(StartShapes.from_polygon(polygon, Transform2D.IDENTITY), PackedVector2Array(),
			"outline of one that crosses itself")
	check("edge 0-1 meets edge 2-3." in StartShapes.last_problem, "the message: " + StartShapes.last_problem)
	polygon.free()
	var path := Path2D.new()
	check_equal(StartShapes.from_path(path, Transform2D.IDENTITY, 12), PackedVector2Array(),
			"outline of a path without a curve")
	path.curve = Curve2D.new()
	for corner in SQUARE:
		path.curve.add_point(10 * corner)
	var outline := StartShapes.from_path(path, Transform2D.IDENTITY, 20)
	check_equal(outline.size(), 20, "points of a path")
	check_near(absf(PolygonEdit.signed_area(outline)), 10000, 1, "area of a path")
	path.free()


func test_resampled_outlines_are_even_and_keep_their_length() -> void:
	var outline := Outline.resampled(SQUARE, 8)
	check_equal(outline, PackedVector2Array([Vector2(0, 0), Vector2(5, 0), Vector2(10, 0), Vector2(10, 5), Vector2(10, 10),
			Vector2(5, 10), Vector2(0, 10), Vector2(0, 5)]), "points")
	var circle := Outline.resampled(SoftBody2D.make_circle_polygon(50, 64), 200)
	for i in 200:
		check_near(circle[i].distance_to(circle[(i + 1) % 200]), TAU * 50 / 200, 0.02, "distance of neighbors")


func test_simplified_outlines_keep_what_matters() -> void:
	var fine := Outline.resampled(SQUARE, 400)
	var corners := Outline.simplified(fine, 4)
	check_equal(corners, SQUARE, "corners of a square with 400 points")
	var circle := SoftBody2D.make_circle_polygon(100, 720)
	var few := Outline.simplified(circle, 24)
	check_equal(few.size(), 24, "points of a circle")
	check_above(absf(PolygonEdit.signed_area(few)) / absf(PolygonEdit.signed_area(circle)), 0.95,
			"share of the circle's area that is left")
	check_equal(Outline.simplified(SQUARE, 10), SQUARE, "an outline within its budget")


func test_mirrored_and_symmetric_outlines() -> void:
	var wedge: PackedVector2Array = [Vector2(0, 0), Vector2(30, 0), Vector2(30, 10), Vector2(0, 20)]
	check_equal(Outline.mirrored(wedge, true, Vector2(15, 0)), PackedVector2Array([Vector2(30, 0), Vector2(0, 0),
			Vector2(0, 10), Vector2(30, 20)]), "mirrored")
	check_equal(Outline.mirrored(Outline.mirrored(wedge, false, Vector2(0, 7)), false, Vector2(0, 7)), wedge,
			"mirrored twice")
	var symmetric := Outline.symmetric(wedge, true, Vector2(15, 10), -1)
	check_near(absf(PolygonEdit.signed_area(symmetric)), 2 * (15 * 15 + 15 * 5 / 2.0), 0.5, "area of a left half twice")
	check_equal(SoftBody2D.get_polygon_problem(symmetric), "", "problem of the symmetric outline")


func test_an_outline_that_meets_itself_is_repaired() -> void:
	var bow: PackedVector2Array = [Vector2(0, 0), Vector2(100, 100), Vector2(100, 0), Vector2(0, 100)]
	check(SoftBody2D.get_polygon_problem(bow) != "", "a bow tie is no polygon")
	check_equal(SoftBody2D.get_polygon_problem(Outline.repaired(bow)), "", "problem of the repaired one")
	check_equal(Outline.repaired(SQUARE), SQUARE, "one that needs no repair")
