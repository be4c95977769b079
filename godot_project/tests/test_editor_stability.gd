# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The stability report, the advice that is read out of it, and previews.

const LOGIC := "res://addons/soft_body_2d/editor/logic/"
const Advice := preload(LOGIC + "stability_advice.gd")
const FineOutlines := preload("res://tests/support/fine_outlines.gd")
const MaterialAccess := preload(LOGIC + "material_access.gd")
const Words := preload(LOGIC + "words.gd")
## Long enough for every body here to settle.
const LONG := 2000.0
## Lets a body fold that is too soft.
const UNLIMITED := {"least_area": 0.0, "least_stretch": 0.0}


func _advice_for(body: SoftBody2D) -> Dictionary:
	var changes := {}
	for advice in Advice.advice(body.get_stability_report(LONG), _own(body), Words.say):
		changes.merge(advice.changes)
	return changes


func _own(body: SoftBody2D) -> Dictionary:
	return {"youngs_modulus": body.youngs_modulus, "stiffness": body.stiffness, "damping": body.damping, "substeps": body.substeps, "integrator": body.integrator}


func test_the_report_says_what_the_plan_says_and_what_the_body_then_does() -> void:
	for stiffness: float in [12.0, 25.0, 60.0]:
		add_floor(100)
		var body := add_body(Vector2(0, 49), {"stiffness": stiffness})
		var report := body.get_stability_report(LONG)
		var plan := body.get_substep_plan()
		for key: String in plan:
			check_equal(report[key], plan[key], "%s of the report" % key)
		check(report["settled"], "the copy has settled")
		var height := bounds_of(polygon_of(body)).size.y
		await seconds(6)
		var sag := 1 - bounds_of(polygon_of(body)).size.y / height
		# The node lies on the engine's floor and may have come to rest on another point.
		check_near(report["sag"], sag, 0.02, "sag at %s N/m" % stiffness)
		check_near(report["area_loss"], 1 - body.get_area() / body.get_rest_area(), 0.01, "area lost at %s N/m" % stiffness)
		check_above(report["microseconds_per_tick"], 0, "time of a tick")
		body.free()


func test_the_advised_stiffness_holds_and_the_present_one_does_not() -> void:
	for properties: Dictionary in [{}, {"scale": Vector2(3, 3)}, {"mass": 10.0}, {"center_point": false,
			"shape_matching": 0.6},
			{"inner_points": PackedVector2Array([Vector2(20, 0), Vector2(-20, 0), Vector2(0, 20), Vector2(0, -20)])}]:
		var body := add_body(Vector2.ZERO, {"stiffness": 2.0}.merged(UNLIMITED).merged(properties))
		var before := body.get_stability_report(LONG)
		check(before["folds"], "2 N/m fold: %s, %s" % [properties, before])
		var changes := _advice_for(body)
		if check(changes.has(&"stiffness"), "there is advice: %s" % [properties]):
			body.stiffness = changes[&"stiffness"]
			var after := body.get_stability_report(LONG)
			check(not after["folds"] and after["sag"] <= 0.1, "%s N/m hold: %s" % [body.stiffness, after])
			check(not _advice_for(body).has(&"stiffness"), "no more advice on stiffness")
		body.free()


func test_substeps_that_are_too_many_or_too_few_are_told_of() -> void:
	var body := add_body(Vector2.ZERO, {"substeps": 40})
	check_equal(_advice_for(body).get(&"substeps"), body.get_stability_report(LONG)["automatic_substeps"],
			"advised substeps")
	body.substeps = 1
	body.stiffness = 2000
	check(not body.get_stability_report(LONG)["safe"], "one substep is not stable")
	body.substeps = _advice_for(body)[&"substeps"]
	check(body.get_stability_report(LONG)["safe"], "the advised number is")
	body.integrator = SoftBody2D.INTEGRATOR_EXPLICIT_EULER
	body.substeps = 0
	body.damping = 0
	check_equal(_advice_for(body).get(&"integrator"), 0, "advised integrator of one that is never stable")


func test_little_damping_is_told_of_whatever_is_painted() -> void:
	var body := add_body(Vector2.ZERO, {"damping": 0.01})
	body.damping = _advice_for(body)[&"damping"]
	check(not _advice_for(body).has(&"damping"), "no more advice on damping")
	var scales := PackedFloat32Array()
	scales.resize(body.get_spring_count())
	scales.fill(0.1)
	body.spring_damping_scales = scales
	body.damping = _advice_for(body)[&"damping"]
	check(not _advice_for(body).has(&"damping"), "no more advice on painted damping")


func test_a_good_body_is_green_and_needs_no_advice() -> void:
	var body := add_body()
	var report := body.get_stability_report(LONG)
	var rows := Advice.rows(report, 1.0 / 60, Words.say)
	check_equal(rows.size(), 7, "figures")
	for row in rows:
		check_equal(row.level, Advice.Level.GOOD, "light of %s (%s)" % [row.title, row.text])
	check_equal(_advice_for(body), {}, "advice")
	var soft := Advice.rows(add_body(Vector2.ZERO, {"stiffness": 3.0}.merged(UNLIMITED)).get_stability_report(LONG), 1.0 / 60, Words.say)
	check_equal(soft[3].level, Advice.Level.BAD, "light of the sag of a soft body")


func test_a_fine_outline_has_a_line_of_its_points_and_advice_to_simulate_fewer() -> void:
	var body := add_body(Vector2.ZERO, {"polygon": FineOutlines.character()})
	var line := Advice.rows(body.get_stability_report(LONG), 1.0 / 60, Words.say)[5]
	check_equal([line.title, line.text, line.level], ["Points", "200, as drawn", Advice.Level.FAIR], "line as drawn")
	var changes := _advice_for(body)
	check_equal(changes.get(&"detail_mode"), SoftBody2D.DETAIL_MODE_AUTOMATIC, "advice")
	body.detail_mode = changes[&"detail_mode"]
	var report := body.get_stability_report(LONG)
	line = Advice.rows(report, 1.0 / 60, Words.say)[5]
	check_equal([line.text, line.level], ["%d of 200, error %s %%" % [report.points_simulated, Advice.number(100 * report.outline_error)],
			Advice.Level.GOOD], "line with less detail")
	check(not _advice_for(body).has(&"detail_mode"), "no more advice")
	check(not _advice_for(add_body()).has(&"detail_mode"), "none for the default body")


func test_a_body_made_firmer_for_its_weight_has_a_line_that_says_how_much() -> void:
	var body := add_body(Vector2.ZERO, {"mass": 5.0})
	var line := Advice.rows(body.get_stability_report(LONG), 1.0 / 60, Words.say)[7]
	check_equal([line.title, line.text, line.level], ["Firmness", "4.96 × for its weight", Advice.Level.GOOD], "line")
	check("%s is used" % Advice.number(body.get_youngs_modulus_in_use()) in line.hint, "the hint names the value: " + line.hint)
	check_equal(_advice_for(body), {}, "advice")
	body.youngs_modulus = 5
	line = Advice.rows(body.get_stability_report(LONG), 1.0 / 60, Words.say)[7]
	check_equal(line.level, Advice.Level.FAIR, "light of a Young's modulus without effect")
	check("no effect" in line.hint, "the hint says so: " + line.hint)
	var changes := _advice_for(body)
	if check(changes.has(&"youngs_modulus"), "there is advice"):
		body.youngs_modulus = changes[&"youngs_modulus"]
		check_equal(_advice_for(body), {}, "no more advice")
		check_below(body.get_stability_report(LONG)["sag"], 0.1, "sag with the advised value")


func test_bodies_that_hang_float_or_are_frozen_have_a_report() -> void:
	var hanging := add_body(Vector2.ZERO, {"pinned_points": PackedInt32Array([12])})
	var report := hanging.get_stability_report(LONG)
	check(report["sag"] > 0 and report["sag"] < 1, "a body that hangs comes down: %s" % report["sag"])
	var floating := add_weightless_body()
	check_equal(floating.get_stability_report(LONG)["sag"], 0.0, "sag of a weightless body")
	var frozen := add_body(Vector2.ZERO, {"freeze": true, "collision_mask": 0})
	check_above(frozen.get_stability_report(LONG)["microseconds_per_tick"], 0, "time of a tick of a frozen body")
	check_refused(func() -> void: floating.get_stability_report(0), ["time_limit_msec"], "no time")


func test_the_report_changes_nothing() -> void:
	var body := add_body(Vector2(0, -200))
	await seconds(0.5)
	var state := body.get_state()
	body.get_stability_report(LONG)
	check_equal(body.get_state(), state, "state after the report")


func test_numbers_are_read_easily() -> void:
	check_equal(Advice.number(1234.5), "1235" if roundi(1234.5) == 1235 else "1234", "1234.5")
	check_equal(Advice.number(12.345), "12.3", "12.345")
	check_equal(Advice.number(0.1234), "0.1234", "0.1234")
	check_equal(Advice.number(INF), "∞", "infinity")
	for value: float in [0.00123, 0.5, 3.14, 99.2, 1234.0, 1000.0]:
		var up := Advice.rounded_up(value)
		check(up >= value * (1 - 1e-6) and up <= value * 1.11, "%s rounded up is %s" % [value, up])
	check_equal(Advice.rounded_up(1000.0), 1000.0, "a round number")


func test_read_only_materials_and_those_of_other_scenes_are_told_of() -> void:
	var path := "user://material_access_test.tres"
	var material := SoftBodyMaterial2D.new()
	check_equal(MaterialAccess.problem(material, stage), "", "problem of a material of this scene")
	ResourceSaver.save(material, path)
	var stored: Resource = load(path)
	check_equal(MaterialAccess.problem(stored, stage), "", "problem of a file that can be written")
	if OS.get_name() == "Linux":
		FileAccess.set_unix_permissions(ProjectSettings.globalize_path(path), 0x124)
		check("read-only" in MaterialAccess.problem(stored, stage), "a file that cannot")
		FileAccess.set_unix_permissions(ProjectSettings.globalize_path(path), 0x1a4)
	material.resource_path = "res://other.tscn::SoftBodyMaterial2D_1"
	check("other.tscn" in MaterialAccess.problem(material, stage), "a material of another scene")
	DirAccess.remove_absolute(path)


# Previews.

func test_a_preview_falls_like_the_body_and_leaves_it_alone() -> void:
	var body := add_body(Vector2(30, -100), {"rotation": 0.4})
	var preview := SoftBodyPreview2D.new()
	check_equal(preview.add_body(body), 0, "index of the copy")
	check_equal(preview.get_polygon(0), polygon_of(body), "polygon of the copy")
	preview.add_floor(Vector2(0, 1e6))
	for i in 60:
		preview.step(1.0 / 60)
	var state := body.get_state()
	check_equal(body.get_state(), state, "state of the body")
	await seconds(1)
	check_points_near(preview.get_polygon(0), polygon_of(body), 20, "copy and body after a second of falling")
	# Free fall for a second: 490 px, but for what the method of integration adds.
	check_near(bounds_of(preview.get_polygon(0)).get_center().y, 390.0, 10, "height of the copy")


func test_a_preview_rests_on_its_floor_and_can_be_pulled() -> void:
	var body := add_body(Vector2(0, 0))
	var preview := SoftBodyPreview2D.new()
	preview.add_body(body)
	preview.add_floor(Vector2(0, 100))
	for i in 300:
		preview.step(1.0 / 60)
	var box := bounds_of(preview.get_polygon(0))
	check_near(box.end.y, 100.0, 0.5, "lowest point")
	check(not preview.grab(Vector2(1000, 0), 50), "nothing is near enough to grab")
	check(preview.grab(box.get_center() - Vector2(0, 60), 100), "a point is grabbed")
	preview.drag(Vector2(0, -100))
	for i in 60:
		preview.step(1.0 / 60)
	check_near(preview.get_grabbed_position(), Vector2(0, -100), 1, "the grabbed point")
	check_below(bounds_of(preview.get_polygon(0)).position.y, -90, "top of the body")
	preview.release()
	check(not preview.is_grabbing(), "it is let go")
	for i in 300:
		preview.step(1.0 / 60)
	check_near(bounds_of(preview.get_polygon(0)).end.y, 100.0, 0.5, "lowest point after it was let go")


func test_bodies_of_a_preview_collide_and_polygons_of_either_winding_keep_their_order() -> void:
	var lower := add_body(Vector2(0, 40))
	var reversed := SoftBody2D.make_circle_polygon(50, 16)
	reversed.reverse()
	var upper := add_body(Vector2(4, -80), {"polygon": reversed})
	var preview := SoftBodyPreview2D.new()
	preview.add_body(lower)
	preview.add_body(upper)
	check_points_near(preview.get_polygon(1), upper.get_global_transform() * reversed, 0.01,
			"polygon of a body that winds the other way")
	preview.add_floor(Vector2(0, 100))
	preview.add_floor(Vector2(-60, 0), Vector2(1, 0))
	preview.add_floor(Vector2(64, 0), Vector2(-1, 0))
	for i in 200:
		preview.step(1.0 / 60)
	check_below(bounds_of(preview.get_polygon(1)).get_center().y, bounds_of(preview.get_polygon(0)).get_center().y - 60,
			"height of the upper one")


func test_previews_refuse_what_they_cannot_do() -> void:
	var preview := SoftBodyPreview2D.new()
	check_refused(func() -> void: preview.add_body(null), ["null"], "no body")
	check_refused(func() -> void: preview.step(0), ["step refused"], "no time")
	check_refused(func() -> void: preview.get_polygon(3), ["0 bodies"], "a body that is not there")
	check_refused(func() -> void: preview.add_floor(Vector2.ZERO, Vector2.ZERO), ["floor refused"],
			"a floor without a direction")
	check_refused(func() -> void: preview.get_grabbed_position(), ["no point"], "nothing grabbed")


func test_what_keeps_points_from_being_a_polygon_is_said_as_the_setter_says_it() -> void:
	check_equal(SoftBody2D.get_polygon_problem(SoftBody2D.make_circle_polygon(50, 8)), "", "problem of a circle")
	var crossed: PackedVector2Array = [Vector2(0, 0), Vector2(10, 10), Vector2(10, 0), Vector2(0, 10)]
	var problem := SoftBody2D.get_polygon_problem(crossed)
	var body := add_body()
	check_refused(func() -> void: body.polygon = crossed, [problem], "the same points as a polygon")


## Whether it dented, or tore, in three seconds after a fall from that height.
func _is_damaged_by(height: float, properties: Dictionary) -> bool:
	var floor_body := add_floor(100)
	var body := add_body(Vector2(0, 49.9 - height), properties)
	var told := [0]
	body.torn.connect(func(_pieces: Array) -> void: told[0] += 1)
	await seconds(sqrt(2 * height / 980) + 1.5)
	var damaged: bool = body.get_dent() > 0 or told[0] > 0
	for each in stage.find_children("*", "SoftBody2D", true, false):
		each.free()
	floor_body.free()
	return damaged


func test_the_heights_from_which_a_fall_dents_or_tears_are_those_of_falls() -> void:
	for properties: Dictionary in [{"yield_strain": 0.1, "youngs_modulus": 600.0}, {"yield_strain": 0.2, "youngs_modulus": 300.0},
			{"tear_stretch": 0.3, "smallest_piece": 0.0}]:
		var body := add_body(Vector2(0, 0), properties)
		var report := body.get_stability_report(LONG)
		var key := "dent_drop" if properties.has("yield_strain") else "tear_drop"
		body.free()
		if not check(is_finite(report.get(key, NAN)) and report[key] > 0, "%s of %s is %s" % [key, properties, report.get(key)]):
			continue
		check(not await _is_damaged_by(0.7 * report[key], properties), "%s is damaged by a fall of 0.7 of %s" % [properties, report[key]])
		if key == "dent_drop": # a body that is overstretched holds on where too little would come off
			check(await _is_damaged_by(1.4 * report[key], properties), "%s is whole after a fall of 1.4 times %s" % [properties, report[key]])


func test_heights_are_told_only_of_bodies_that_dent_or_tear() -> void:
	var body := add_body(Vector2(0, 0), {})
	var report := body.get_stability_report(LONG)
	check(not report.has("dent_drop") and not report.has("tear_drop"), "heights of a body that is elastic")
	body.yield_strain = 0.1
	check_equal(body.get_stability_report(LONG)["dent_drop"], 0.0, "height from which what is too soft for its weight dents")
	body.youngs_modulus = 600
	body.tear_stretch = 40.0
	report = body.get_stability_report(LONG)
	check_equal(report["tear_drop"], INF, "height from which what never tears tears")
	var titles := Advice.rows(report, 1.0 / 60, func(text: String) -> String: return text).map(func(row: Advice.Row) -> String: return row.title + " " + row.text)
	check(titles.has("Tears not from 100 m"), "row of tears: %s" % [titles])
	check(titles.any(func(title: String) -> bool: return title.begins_with("Dents from ")), "row of dents: %s" % [titles])
	body.pinned_points = PackedInt32Array([0])
	report = body.get_stability_report(LONG)
	check(is_nan(report["dent_drop"]), "height of a body that hangs")


func test_the_preview_dents_and_leaves_the_node_as_it_was() -> void:
	var body := add_body(Vector2(0, 0), {"yield_strain": 0.03, "flow_rate": 60.0})
	body.freeze = true
	var preview := SoftBodyPreview2D.new()
	var index := preview.add_body(body)
	preview.add_floor(Vector2(0, 500))
	for i in 240:
		preview.step(1.0 / 60)
	var height := bounds_of(preview.get_polygon(index)).size.y
	check_below(height, 92, "height of the dented copy, of 100")
	check_equal(body.get_dent(), 0.0, "dent of the node")


func _shoelace(polygon: PackedVector2Array) -> float:
	var sum := 0.0
	for i in polygon.size():
		sum += polygon[i].cross(polygon[(i + 1) % polygon.size()])
	return absf(sum) / 2


func test_the_preview_tears_what_is_pulled_too_far_and_leaves_the_node_as_it_was() -> void:
	for clockwise: bool in [false, true]:
		var bar := SoftBody2D.make_box_polygon(Vector2(200, 40), 20)
		if clockwise:
			bar.reverse()
		var body := add_body(Vector2(0, 0), {"polygon": bar, "youngs_modulus": 600.0, "tear_stretch": 0.4, "gravity_scale": 0.0, "freeze": true})
		var left := PackedInt32Array()
		for i in bar.size():
			if bar[i].x < -99:
				left.append(i)
		body.pinned_points = left
		var preview := SoftBodyPreview2D.new()
		preview.add_body(body)
		check(preview.grab(Vector2(100, 0), 50), "the right end is held")
		for i in 120:
			preview.drag(Vector2(100 + 2 * i, 0))
			preview.step(1.0 / 60)
		check_above(preview.get_body_count(), 1, "bodies")
		check(preview.is_grabbing(), "the hand still holds a piece")
		var area := 0.0
		for i in preview.get_body_count():
			check_equal(preview.get_source(i), 0, "source of body %d" % i)
			var carried := preview.carry(i, bar)
			check_equal(carried.size(), preview.get_polygon(i).size(), "carried values of body %d" % i)
			area += _shoelace(carried)
		check_near(area, 8000.0, 1.0, "area at rest of all pieces")
		check_equal(body.polygon, bar, "polygon of the node")
		preview.release()
		body.free()


func test_one_line_says_what_to_do_and_the_worst_comes_first() -> void:
	var say := func(text: String) -> String: return text
	var body := SoftBody2D.new()
	stage.add_child(body)
	var tick := 1.0 / 60
	var line := func() -> String:
		var report := body.get_stability_report(200)
		var own := {"youngs_modulus": body.youngs_modulus, "stiffness": body.stiffness, "damping": body.damping,
				"substeps": body.substeps, "integrator": body.integrator}
		return Advice.headline(Advice.rows(report, tick, say), Advice.advice(report, own, say), say).text
	check_equal(line.call(), "It holds: nothing to do.", "line of a new node")
	body.substeps = 60
	check("substeps are enough" in line.call(), "line of too many substeps: " + line.call())
	body.firm_for_weight = false
	body.youngs_modulus = 5
	check("Young's modulus 5" in line.call(), "line of a body that sags, with too many substeps: " + line.call())
	body.youngs_modulus = 2e6
	body.integrator = SoftBody2D.INTEGRATOR_EXPLICIT_EULER
	body.substeps = 1
	check("To do" in line.call() and "stable" in line.call(), "line of what is not stable: " + line.call())
