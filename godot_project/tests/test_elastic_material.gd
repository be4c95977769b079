# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A material is a material: it means the same for any body, its values are settings, and old networks stay what they were.

const NETWORK := SoftBody2D.ELASTIC_MODEL_NETWORK
const MODES := SoftBody2D.ELASTIC_MODEL_MODES
const RAW: Array[String] = ["stiffness", "damping", "shape_matching", "shape_damping_ratio", "pressure"]
const MATERIAL: Array[String] = ["youngs_modulus", "poisson_ratio", "damping_ratio"]


func _reason(body: SoftBody2D) -> String:
	return body.get_substep_plan()["elastic_reason"]


func _check_model(body: SoftBody2D, model: int, reason: String, what: String) -> void:
	check_equal(body.get_elastic_model_in_use(), model, "model of " + what)
	check_equal(_reason(body), reason, "reason for the model of " + what)
	check_equal(body.get_stability_report()["elastic_model"], model, "model in the report of " + what)


## Pulls at the left and at the right side with the tension `stress` [N/m] on each px of height. True uniform stress: each
## edge hands half of its force to each of its ends.
func _forces_of_tension(polygon: PackedVector2Array, points: int, stress: float) -> PackedVector2Array:
	var forces := PackedVector2Array()
	forces.resize(points)
	for i in polygon.size():
		var next := (i + 1) % polygon.size()
		var half := Vector2(stress * (polygon[next] - polygon[i]).y / 2, 0)
		forces[i] += half
		forces[next] += half
	return forces


## By how much the polygon has become longer along x and along y, as the best-fitting strain.
func _strain(rest: PackedVector2Array, now: PackedVector2Array) -> Vector2:
	var middle := Vector2.ZERO
	for point in now:
		middle += point / now.size()
	var center := Vector2.ZERO
	for point in rest:
		center += point / rest.size()
	var product := Vector2.ZERO
	var square := Vector2.ZERO
	for i in rest.size():
		product += (now[i] - middle) * (rest[i] - center)
		square += (rest[i] - center) * (rest[i] - center)
	return product / square - Vector2.ONE


func test_a_new_body_is_jelly_by_its_material() -> void:
	var body := add_weightless_body()
	for values: Object in [body, SoftBodyMaterial2D.new()]:
		check_equal([values.get("youngs_modulus"), values.get("poisson_ratio"), values.get("damping_ratio")], [300.0, 0.45, 0.15], "the material of a new %s" % values.get_class())
		check_equal(values.get("preset"), SoftBodyMaterial2D.PRESET_JELLY, "its preset")
	check_equal([body.least_area, body.least_stretch, body.most_stretch], [0.5, 0.2, 3.0], "limits")
	check_equal(body.elastic_model, SoftBody2D.ELASTIC_MODEL_AUTOMATIC, "elastic_model")
	_check_model(body, MODES, "material", "a new body")
	check_equal(body.get_spring_stiffness(0), 0.0, "stiffness of a spring that takes no part")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings")


func test_young_and_poisson_mean_what_elasticity_says_for_any_size_and_mass() -> void:
	# Plane strain: along the tension s (1 - nu^2) / E, across it -s nu (1 + nu) / E.
	var polygons := {"a circle": SoftBody2D.make_circle_polygon(50, 64), "a small circle": SoftBody2D.make_circle_polygon(12, 64)}
	for ratio: float in [0.0, 0.45]:
		for outline: String in polygons:
			var polygon: PackedVector2Array = polygons[outline]
			var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon, "youngs_modulus": 200.0, "poisson_ratio": ratio,
					"damping_ratio": 1.0, "can_sleep": false, "mass": 0.2 if ratio > 0 else 0.4})
			var stress := 6.0
			var forces := _forces_of_tension(polygon, body.get_point_count(), stress)
			for i in 120:
				body.apply_point_forces(forces)
				await ticks(1)
			var strain := _strain(polygon, polygon_of(body))
			var expected := Vector2(1 - ratio * ratio, -ratio * (1 + ratio)) * stress / 200.0
			check_near(strain, expected, 0.1 * expected.length(), "strain of %s at nu %s" % [outline, ratio])
			body.free()


func test_as_firm_a_body_sags_as_much_for_any_number_of_points_and_a_network_does_not() -> void:
	var sags := {}
	for model: int in [MODES, NETWORK]:
		for count: int in [16, 32, 64]:
			var body := add_body(Vector2.ZERO, {"polygon": SoftBody2D.make_circle_polygon(50, count), "elastic_model": model,
					"youngs_modulus": 150.0, "stiffness": 30.0})
			sags[[model, count]] = body.get_stability_report(2000)["sag"]
			body.free()
	for count: int in [32, 64]:
		check_near(sags[[MODES, count]] / sags[[MODES, 16]], 1.0, 0.15, "sag of %d points over that of 16" % count)
	check_below(sags[[NETWORK, 64]], sags[[NETWORK, 16]] / 2, "sag of a network of 64 points, of the stiffness of 16")


func test_moving_a_slider_builds_nothing_and_costs_little() -> void:
	var jelly := add_weightless_body()
	var network := add_weightless_body(Vector2(300, 0), {"stiffness": 120.0})
	var material := SoftBodyMaterial2D.new()
	var shared := add_weightless_body(Vector2(600, 0), {"soft_body_material": material})
	await ticks(2)
	var built := SoftBodySimulation2D.get_built_shape_count()
	var places := jelly.get_point_positions() + network.get_point_positions() + shared.get_point_positions()
	var begin := Time.get_ticks_usec()
	for i in 1000:
		jelly.youngs_modulus = 100.0 + i
		jelly.poisson_ratio = 0.0004 * i
		jelly.damping_ratio = 0.001 * i
		network.stiffness = 50.0 + i
		network.damping = 0.1 + 0.001 * i
		network.shape_matching = 0.2 + 0.001 * i
		material.youngs_modulus = 50.0 + i
	var msec := (Time.get_ticks_usec() - begin) / 1000.0
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes that were built")
	check_below(msec, 500, "milliseconds for 7000 moves")
	check_equal(jelly.get_point_positions() + network.get_point_positions() + shared.get_point_positions(), places, "points")
	check_near(network.get_spring_stiffness(5), 1049.0, 1e-3, "stiffness of a spring after that")
	check_near(network.get_spring_damping(5), 1.099, 1e-4, "damping of a spring after that")
	check_near(jelly.get_stability_report()["youngs_modulus"], 1099.0, 1e-6, "Young's modulus after that")
	jelly.center_point = false
	check_above(SoftBodySimulation2D.get_built_shape_count(), built, "shapes built, after another structure")


func test_a_slider_is_felt_by_the_body_that_moves() -> void:
	add_floor(52)
	var body := add_body(Vector2.ZERO, {"youngs_modulus": 800.0})
	await seconds(3)
	var firm := bounds_of(polygon_of(body)).size.y
	body.youngs_modulus = 100.0
	await seconds(3)
	check_below(bounds_of(polygon_of(body)).size.y, firm - 5, "height in px after it was made soft")


func test_automatic_chooses_by_what_the_body_is_made_of() -> void:
	var pairs := PackedInt32Array([0, 8, 4, 12, 2, 10, 6, 14])
	var ones := PackedFloat32Array()
	ones.resize(32)
	ones.fill(1)
	for entry: Array in [[{}, MODES, "material"], [{"youngs_modulus": 50.0}, MODES, "material"],
			[{"inner_points": PackedVector2Array([Vector2(20, 0)])}, MODES, "material"],
			[{"inflation": 1.2}, MODES, "material"], [{"springs": pairs}, NETWORK, "own_springs"],
			[{"spring_stiffness_scales": ones}, NETWORK, "painted_springs"], [{"spring_length_scales": ones}, NETWORK, "painted_springs"],
			[{"stiffness": 50.0}, NETWORK, "network_values"], [{"stiffness": 100.0}, NETWORK, "network_values"],
			[{"stiffness": 50.0, "elastic_model": MODES}, MODES, "chosen"], [{"elastic_model": NETWORK}, NETWORK, "chosen"],
			[{"elastic_model": SoftBody2D.ELASTIC_MODEL_SPRINGS}, SoftBody2D.ELASTIC_MODEL_SPRINGS, "chosen"]]:
		var properties: Dictionary = entry[0]
		var names := properties.keys()
		for turned: bool in [false, true]:
			if turned:
				names.reverse()
			var body := SoftBody2D.new()
			for name: String in names:
				body.set(name, properties[name])
			_check_model(body, entry[1], entry[2], "%s, outside the tree" % [names])
			stage.add_child(body)
			_check_model(body, entry[1], entry[2], "%s, in the tree" % [names])
			body.free()
	for raw in RAW:
		var body := add_weightless_body()
		body.set(raw, 0.5)
		_check_model(body, NETWORK, "network_values", "a body whose %s a script set" % raw)
		var material := SoftBodyMaterial2D.new()
		body.free()
		body = add_weightless_body(Vector2.ZERO, {"soft_body_material": material})
		check_equal(body.get_elastic_model_in_use(), MODES, "model by a material")
		material.set(raw, 0.5)
		_check_model(body, NETWORK, "network_values", "a body of a material whose %s a script set" % raw)
		check_equal(body.has_network_values(), true, "raw values in use")
		material.clear_network_values()
		_check_model(body, MODES, "material", "a body of a material without them again")
		body.free()


func test_the_plan_says_how_far_the_model_chosen_is_from_a_solid() -> void:
	for points: int in [6, 8, 16, 40, 300]:
		var body := add_weightless_body(Vector2.ZERO, {"polygon": SoftBody2D.make_circle_polygon(50, points)})
		var plan := body.get_substep_plan()
		check_equal(plan["elastic_model"], MODES, "model of %d points" % points)
		check(plan["elastic_error"] > 0.0 and plan["elastic_error"] < 0.05, "error of %d points is %s" % [points, plan["elastic_error"]])
		body.elastic_model = SoftBody2D.ELASTIC_MODEL_SPRINGS
		check(body.get_substep_plan()["elastic_error"] > 0.05, "springs of %d points are no further off" % points)
		body.elastic_model = NETWORK
		check_equal(body.get_substep_plan()["elastic_error"], 0.0, "error of a network of %d points" % points)
		body.free()


func test_raw_values_stay_in_force_until_the_model_is_chosen_or_they_are_cleared() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 70.0, "damping": 0.3})
	check_equal(body.get_warnings(), PackedStringArray(), "warnings of a network")
	body.youngs_modulus = 500.0
	check_equal(body.get_elastic_model_in_use(), NETWORK, "model after the material was set")
	check("youngs_modulus" in "\n".join(body.get_warnings()), "no warning says that the material has no effect")
	check_near(body.get_spring_stiffness(3), 70.0, 1e-4, "stiffness of a spring")
	body.elastic_model = MODES
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after the model was chosen")
	check_near(body.get_stability_report()["youngs_modulus"], 500.0, 1e-6, "Young's modulus in use")
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_AUTOMATIC
	check_equal(body.get_elastic_model_in_use(), NETWORK, "model when it is automatic again")
	body.clear_network_values()
	_check_model(body, MODES, "material", "the body without raw values")
	check_equal([body.stiffness, body.damping, body.has_network_values()], [100.0, 0.12, false], "raw values")


func test_old_scenes_load_as_the_networks_that_they_were_and_a_note_says_so_once() -> void:
	if not is_debug_build():
		return
	var path := "user://old_scene.tscn"
	for line: String in ["stiffness = 35.0", "damping = 0.5", "shape_matching = 0.8", "shape_damping_ratio = 0.5", "pressure = 60.0"]:
		var file := FileAccess.open(path, FileAccess.WRITE)
		file.store_string("[gd_scene format=3]\n\n[node name=\"Old\" type=\"SoftBody2D\"]\n%s\nmass = 2.0\n" % line)
		file.close()
		var scene := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
		var body := scene.instantiate() as SoftBody2D
		stage.add_child(body)
		_check_model(body, NETWORK, "network_values", "an old scene with " + line)
		check_near(body.get_spring_stiffness(0), 35.0 if line.begins_with("stiffness") else 100.0, 1e-4, "its stiffness")
		body.free()
	DirAccess.remove_absolute(path)
	await ticks(1)
	var notes: Variant = printed_notes()
	if notes != null and check_equal(notes.size(), 1, "notes in this run: %s; number" % [notes]):
		for word: String in ["stiffness", "youngs_modulus", "elastic_model"]:
			check(word in notes[0], "the note does not name " + word)


func test_values_out_of_range_are_refused_by_name_and_the_old_one_stays() -> void:
	var body := add_weightless_body()
	body.name = "Jelly"
	var state := body.get_state()
	for entry: Array in [["youngs_modulus", [0.0, -1.0, NAN, INF, 1e300, 3e38]], ["poisson_ratio", [0.5, -0.01, 1.0, NAN, INF]],
			["damping_ratio", [-0.1, NAN, INF, 1e300]], ["least_area", [-0.1, 1.1, NAN]], ["least_stretch", [-0.1, 1.1, NAN]],
			["most_stretch", [0.9, -1.0, NAN, INF]]]:
		var name: String = entry[0]
		var old: Variant = body.get(name)
		for value: float in entry[1]:
			check_refused(func() -> void: body.set(name, value), ["Jelly", name], "%s = %s" % [name, value])
			check_equal(body.get(name), old, name + " after a refused value")
			check(name in "\n".join(body.get_warnings()), "no warning of the refused %s" % name)
		body.set(name, old)
	for bad: int in [-1, 7, 99]:
		check_refused(func() -> void: body.set("elastic_model", bad), ["Jelly", "elastic_model"], "elastic_model = %d" % bad)
		check_equal(body.elastic_model, SoftBody2D.ELASTIC_MODEL_AUTOMATIC, "elastic_model after a refused value")
	check_refused(func() -> void: body.set("preset", 6), ["Jelly", "preset"], "preset = 6")
	check_refused(func() -> void: SoftBodyMaterial2D.new().set("preset", -1), ["preset"], "preset = -1")
	body.elastic_model = SoftBody2D.ELASTIC_MODEL_AUTOMATIC
	body.preset = SoftBodyMaterial2D.PRESET_JELLY
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after good values")
	check_equal(body.get_state(), state, "state")
	take_errors()


func test_a_model_of_springs_needs_springs_of_some_stiffness() -> void:
	var none := PackedFloat32Array()
	none.resize(32)
	var body := add_weightless_body(Vector2.ZERO, {"spring_stiffness_scales": none})
	check_refused(func() -> void: body.elastic_model = SoftBody2D.ELASTIC_MODEL_SPRINGS, ["elastic_model"], "springs without stiffness")
	check_equal(body.elastic_model, SoftBody2D.ELASTIC_MODEL_AUTOMATIC, "elastic_model after that")
	body.free()
	# A scene may set both, in any order: then the network takes its place, and a warning says so.
	for names: Array in [["elastic_model", "spring_stiffness_scales"], ["spring_stiffness_scales", "elastic_model"]]:
		body = SoftBody2D.new()
		for name: String in names:
			if name == "elastic_model":
				body.elastic_model = SoftBody2D.ELASTIC_MODEL_SPRINGS
			else:
				body.spring_stiffness_scales = none
		stage.add_child(body)
		_check_model(body, NETWORK, "unfit", "a body of springs without stiffness")
		check("elastic_model" in "\n".join(body.get_warnings()), "no warning: %s" % body.get_warnings())
		take_errors()
		await ticks(2)
		check("elastic_model" in "\n".join(take_errors()), "no message when it is stepped")
		body.free()


func test_painted_factors_weigh_springs_against_each_other_in_the_models_of_springs() -> void:
	var scales := PackedFloat32Array()
	scales.resize(32)
	scales.fill(1)
	scales[5] = 4
	for model: int in [SoftBody2D.ELASTIC_MODEL_SPRINGS, SoftBody2D.ELASTIC_MODEL_SPRINGS_AND_SHAPE, SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA]:
		var body := add_weightless_body(Vector2.ZERO, {"elastic_model": model, "spring_stiffness_scales": scales})
		check_above(body.get_spring_stiffness(4), 1, "stiffness of a spring in model %d" % model)
		check_near(body.get_spring_stiffness(5) / body.get_spring_stiffness(4), 4.0, 1e-4, "the painted spring over it")
		var single := body.get_spring_stiffness(4)
		body.youngs_modulus *= 2
		check_near(body.get_spring_stiffness(4) / single, 2.0, 1e-4, "stiffness of the spring at twice the Young's modulus")
		body.free()


func test_presets_set_a_material_and_are_not_stored() -> void:
	var seen := {}
	for preset: int in [SoftBodyMaterial2D.PRESET_JELLY, SoftBodyMaterial2D.PRESET_RUBBER, SoftBodyMaterial2D.PRESET_WATER_BALLOON,
			SoftBodyMaterial2D.PRESET_MARSHMALLOW, SoftBodyMaterial2D.PRESET_FOAM]:
		var material := SoftBodyMaterial2D.make_preset(preset)
		check_equal(material.preset, preset, "preset of a material made from it")
		var body := add_weightless_body(Vector2(200, 0), {"stiffness": 10.0})
		body.preset = preset
		for name: String in MATERIAL + ["rolling_resistance"]:
			check_equal(body.get(name), material.get(name), "%s of a body of preset %d" % [name, preset])
		var grip := body.physics_material_override if body.physics_material_override != null else surface()
		check_near(grip.friction, material.friction, 1e-6, "friction of a body of preset %d" % preset)
		check_near(grip.bounce, material.bounce, 1e-6, "bounce of a body of preset %d" % preset)
		check_equal(body.preset, preset, "preset of the body")
		check_equal(body.stiffness, 10.0, "the raw stiffness")
		seen[[material.youngs_modulus, material.poisson_ratio, material.damping_ratio]] = true
		body.elastic_model = MODES
		check_equal(body.get_warnings(), PackedStringArray(), "warnings of a body of preset %d" % preset)
		check_below(body.get_stability_report()["sag"] if body.gravity_scale > 0 else 0.0, 0.2, "sag")
		body.physics_material_override = surface(0.875)
		check_equal(body.preset, SoftBodyMaterial2D.PRESET_CUSTOM, "preset after a change")
		body.preset = SoftBodyMaterial2D.PRESET_CUSTOM
		check_equal(body.youngs_modulus, material.youngs_modulus, "Young's modulus after choosing Custom")
		body.free()
	check_equal(seen.size(), 5, "materials that differ")
	check_equal(SoftBodyMaterial2D.new().preset, SoftBodyMaterial2D.PRESET_JELLY, "preset of a new material")
	for owner: Object in [add_weightless_body(), SoftBodyMaterial2D.new()]:
		for property in owner.get_property_list():
			if property["name"] == "preset":
				check(not property["usage"] & PROPERTY_USAGE_STORAGE, "preset is stored")


func test_copies_and_scenes_keep_the_material_the_model_and_what_was_set() -> void:
	for properties: Dictionary in [{"youngs_modulus": 450.0, "poisson_ratio": 0.25, "damping_ratio": 0.5, "least_area": 0.25,
			"least_stretch": 0.125, "most_stretch": 2.0}, {"stiffness": 64.0}, {"stiffness": 64.0, "elastic_model": MODES},
			{"elastic_model": SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA}, {"pressure": 32.0, "inflation": 1.25}]:
		var body := add_weightless_body(Vector2.ZERO, properties)
		var scene := PackedScene.new()
		scene.pack(body)
		for copy: SoftBody2D in [body.duplicate(), scene.instantiate()]:
			stage.add_child(copy)
			for name: String in properties:
				check_equal(copy.get(name), properties[name], name + " of a copy")
			check_equal(copy.get_elastic_model_in_use(), body.get_elastic_model_in_use(), "model of a copy of %s" % properties)
			check_equal(_reason(copy), _reason(body), "reason for the model of a copy of %s" % properties)
			copy.free()
		body.free()
	var by_script := add_weightless_body(Vector2.ZERO, {"stiffness": 100.0})
	var packed := PackedScene.new()
	packed.pack(by_script)
	for twin: SoftBody2D in [by_script.duplicate(), packed.instantiate()]:
		check_equal(twin.get_elastic_model_in_use(), NETWORK, "model of a copy of a network with the default stiffness")
		twin.free()
	by_script.clear_network_values()
	packed.pack(by_script)
	for twin: SoftBody2D in [by_script.duplicate(), packed.instantiate()]:
		check_equal(twin.get_elastic_model_in_use(), MODES, "model of a copy of a body whose raw values were cleared")
		twin.free()
	var material := SoftBodyMaterial2D.new()
	check_equal((material.duplicate() as SoftBodyMaterial2D).has_network_values(), false, "raw values of a duplicated material")
	material.damping = 0.12
	check_equal((material.duplicate() as SoftBodyMaterial2D).has_network_values(), true, "raw values of a duplicated network material")


func test_a_state_is_restored_into_a_body_of_any_model() -> void:
	add_floor(80)
	var body := add_body()
	await seconds(0.7)
	var state := body.get_state()
	await ticks(20)
	var later := body.get_point_positions()
	body.set_state(state)
	await ticks(20)
	check_equal(body.get_point_positions(), later, "points after the same 20 ticks")
	body.set_state(state)
	var places := body.get_point_positions()
	var velocity := body.get_linear_velocity()
	for model: int in [NETWORK, SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA, MODES]:
		body.elastic_model = model
		check_equal(body.get_point_positions(), places, "points after the model was changed to %d" % model)
		check_equal(body.set_state(state), OK, "the state of a jelly for model %d" % model)
	check_near(body.get_linear_velocity(), velocity, 1e-3, "velocity after all that")


func test_nothing_presses_a_body_flat_or_draws_it_out_unless_the_limits_are_off() -> void:
	var rest := SoftBody2D.make_circle_polygon(50, 16)
	for limited: bool in [true, false]:
		var values := {"youngs_modulus": 10.0, "poisson_ratio": 0.0, "can_sleep": false, "least_area": 0.0, "least_stretch": 0.0,
				"most_stretch": 1000.0}
		if limited:
			values.merge({"least_area": 0.5, "least_stretch": 0.25, "most_stretch": 1.5}, true)
		var pressed := add_weightless_body(Vector2.ZERO, values)
		var drawn := add_weightless_body(Vector2(600, 0), values)
		var network := add_weightless_body(Vector2(1200, 0), values.merged({"stiffness": 10.0}))
		var least := INF
		var thinnest := INF
		var longest := 0.0
		for i in 120:
			for point in 16:
				pressed.apply_point_force(point, Vector2(0, -4 * rest[point].y))
				drawn.apply_point_force(point, Vector2(0, 4 * rest[point].y))
				network.apply_point_force(point, Vector2(0, -8 * rest[point].y))
			await ticks(1)
			least = minf(least, network.get_area() / network.get_rest_area())
			thinnest = minf(thinnest, 1 + _strain(rest, polygon_of(pressed)).y)
			longest = maxf(longest, 1 + _strain(rest, polygon_of(drawn)).y)
		if limited:
			check_above(least, 0.45, "least area of a network that is pressed")
			check_above(thinnest, 0.2, "thickness of a jelly that is pressed")
			check_below(longest, 1.65, "length of one that is drawn")
		else:
			check_below(least, 0, "least area without limits")
			check_below(thinnest, 0, "thickness without limits")
			check_above(longest, 2.0, "length without limits")
		for body: SoftBody2D in [pressed, drawn, network]:
			body.free()


func test_a_material_too_soft_for_its_weight_is_told_of_and_the_advice_holds() -> void:
	var body := add_body(Vector2.ZERO, {"youngs_modulus": 10.0, "firm_for_weight": false})
	var warnings := "\n".join(body.get_warnings())
	check("Young's modulus 10" in warnings, "no warning: %s" % warnings)
	check(not "tiffness" in warnings and not "Damping" in warnings, "advice about springs that take no part: %s" % warnings)
	var report := body.get_stability_report(2000)
	check_below(report["strength"], 1.0, "strength")
	check_equal(report["firm_stiffness"], 0.0, "advised stiffness of a body of a material")
	check_above(report["firm_youngs_modulus"], 20.0, "advised Young's modulus")
	body.youngs_modulus = report["firm_youngs_modulus"]
	check_equal(body.get_warnings(), PackedStringArray(), "warnings with the advised value")
	var after := body.get_stability_report(2000)
	check(not after["folds"] and after["sag"] <= 0.11, "the advised value holds: %s" % after)
	var network := add_body(Vector2(300, 0), {"stiffness": 1.0})
	var of_network := network.get_stability_report(2000)
	check_equal([of_network["youngs_modulus"], of_network["poisson_ratio"], of_network["firm_youngs_modulus"]], [0.0, 0.0, 0.0], "material of a network")
	check("Stiffness 1.0 " in "\n".join(network.get_warnings()), "no warning of the network: %s" % network.get_warnings())


func test_a_body_goes_on_as_it_moves_when_its_model_changes() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(120, 0)})
	await ticks(10)
	for model: int in [NETWORK, MODES, SoftBody2D.ELASTIC_MODEL_SPRINGS, SoftBody2D.ELASTIC_MODEL_AUTOMATIC]:
		var place := body.global_position
		body.elastic_model = model
		await ticks(1)
		check_near(body.global_position, place + Vector2(2, 0), 0.05, "place a tick after the change to %d" % model)
		check_near(body.linear_velocity, Vector2(120, 0), 0.1, "velocity after it")


func test_triangles_can_be_chosen_before_and_while_the_body_moves() -> void:
	add_floor(80)
	var model := SoftBody2D.ELASTIC_MODEL_TRIANGLES
	var body := add_body(Vector2(-300, 0), {"elastic_model": model})
	var switched := add_body(Vector2(300, 0))
	check_equal([body.get_elastic_model_in_use(), body.get_substep_plan()["elastic_reason"]], [model, "chosen"], "model and reason")
	check_equal(body.get_point_count(), 16 + 24, "points, with those inside")
	check_equal(switched.get_point_count(), 17, "points of elastic modes")
	switched.linear_velocity = Vector2(0, 50)
	await ticks(5)
	var speed := switched.linear_velocity
	switched.elastic_model = model
	check_equal([switched.get_elastic_model_in_use(), switched.get_point_count()], [model, 40], "model and points after the switch")
	check(switched.linear_velocity.is_equal_approx(speed), "the switch changed the velocity from %s to %s" % [speed, switched.linear_velocity])
	for copy: SoftBody2D in [body.duplicate()]:
		stage.add_child(copy)
		check_equal([copy.get_elastic_model_in_use(), copy.get_point_count()], [model, 40], "model and points of a copy")
		copy.free()
	await seconds(3)
	for each: SoftBody2D in [body, switched]:
		check_near(each.get_area() / each.get_rest_area(), 0.99, 0.02, "area at rest")
		check(all_finite(each.get_point_positions()), "a point is not finite")
		var state := each.get_state()
		each.apply_central_impulse(Vector2(0, -300))
		await ticks(10)
		each.set_state(state)
		check_equal(each.get_state(), state, "state put back")
	body.youngs_modulus = 600.0
	var built := SoftBodySimulation2D.get_built_shape_count()
	body.youngs_modulus = 500.0
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes built for another stiffness")
	body.elastic_model = MODES
	check_equal(body.get_point_count(), 17, "points of elastic modes again")
	await ticks(5)
	check(all_finite(body.get_point_positions()), "a point is not finite")
	var concave := add_body(Vector2(0, -200), {"elastic_model": model, "polygon": PackedVector2Array([Vector2(-40, -40), Vector2(0, -40),
			Vector2(0, 5), Vector2(40, 5), Vector2(40, 40), Vector2(-40, 40)]), "mass": 2.0})
	check_equal(concave.get_elastic_model_in_use(), model, "model of an L")
	check_near(concave.get_total_mass(), 2.0, 1e-6, "mass of an L")
	await seconds(2)
	check_near(concave.get_area() / concave.get_rest_area(), 1.0, 0.08, "area of an L at rest")
