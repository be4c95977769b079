# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The mass follows from the size, unless one is set; a body is firm enough for it.

const AUTO := SoftBody2D.MASS_MODE_AUTO
const CUSTOM := SoftBody2D.MASS_MODE_CUSTOM


## Area of a polygon [px²].
func _area(polygon: PackedVector2Array) -> float:
	var sum := 0.0
	for i in polygon.size():
		sum += polygon[i].cross(polygon[(i + 1) % polygon.size()])
	return absf(sum) / 2


## Of a circle of 16 points and a radius of 50 px: half of 16 R² sin(360°/16).
func _default_area() -> float:
	return 8 * 2500 * sin(TAU / 16)


func _usage(body: SoftBody2D, name: String) -> int:
	for property in body.get_property_list():
		if property["name"] == name:
			return property["usage"]
	return 0


func _reload(body: SoftBody2D, texts: Array[String] = []) -> SoftBody2D:
	var path := "user://mass_test.tscn"
	var scene := PackedScene.new()
	check_equal(scene.pack(body), OK, "packing")
	check_equal(ResourceSaver.save(scene, path), OK, "saving")
	texts.append(FileAccess.get_file_as_string(path))
	var loaded := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return loaded.instantiate() as SoftBody2D


# What makes the mass.

func test_a_new_node_has_one_kilogram_wherever_it_is_and_however_it_is_turned() -> void:
	var body := SoftBody2D.new()
	check_equal([body.mass_mode, body.mass, body.get_total_mass()], [AUTO, 1.0, 1.0], "mode and masses outside the tree")
	body.position = Vector2(1234.5, -77.25)
	body.rotation = 0.7
	stage.add_child(body)
	check_equal([body.mass, body.get_total_mass()], [1.0, 1.0], "masses in the tree")
	await seconds(0.5)
	check_equal(body.mass, 1.0, "mass on the way")


func test_mass_follows_the_area_of_any_polygon_at_any_scale() -> void:
	for polygon: PackedVector2Array in [SoftBody2D.make_circle_polygon(5, 16), SoftBody2D.make_circle_polygon(500, 40),
			SoftBody2D.make_box_polygon(Vector2(120, 30), 10), PackedVector2Array([Vector2(0, 0), Vector2(30, 0), Vector2(10, 5), Vector2(0, 40)])]:
		for scale: Vector2 in [Vector2.ONE, Vector2(2, 2), Vector2(0.5, 3), Vector2(-1, 1)]:
			var body := SoftBody2D.new()
			body.polygon = polygon
			body.scale = scale
			var expected := _area(polygon) * absf(scale.x * scale.y) / _default_area()
			check_near(body.mass / expected, 1.0, 1e-5, "mass outside the tree over what the area makes")
			stage.add_child(body)
			check_near(body.mass / expected, 1.0, 1e-5, "mass in the tree")
			check_equal(body.get_total_mass(), body.mass, "total mass")
			body.gravity_scale = 0
			body.apply_central_impulse(Vector2(30, 0) * body.mass)
			check_near(body.linear_velocity, Vector2(30, 0), 0.01, "velocity by an impulse of 30 px/s times the mass")
			body.free()


func test_another_size_makes_another_mass_in_a_running_game() -> void:
	var body := add_weightless_body()
	body.scale = Vector2(2, 2)
	await ticks(2)
	check_near(body.mass, 4.0, 1e-4, "mass at twice the size")
	body.polygon = SoftBody2D.make_circle_polygon(25, 16)
	check_near(body.mass, 1.0, 1e-4, "mass of half of the polygon at twice the size")
	body.mass = 3
	body.scale = Vector2.ONE
	await ticks(2)
	check_equal([body.mass_mode, body.mass], [CUSTOM, 3.0], "a mass that was set stays")
	body.mass_mode = AUTO
	check_near(body.mass, 0.25, 1e-4, "mass that follows the size again")


func test_a_tween_and_an_animation_of_the_mass_set_it() -> void:
	var body := add_weightless_body()
	var built := SoftBodySimulation2D.get_built_shape_count()
	var tween := tree.create_tween().set_process_mode(Tween.TWEEN_PROCESS_PHYSICS)
	tween.tween_property(body, "mass", 9.0, 0.5)
	await seconds(0.7)
	check_equal([body.mass_mode, body.mass], [CUSTOM, 9.0], "mode and mass after the tween")
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes that were built for it")
	body.apply_central_impulse(Vector2(90, 0))
	check_near(body.linear_velocity, Vector2(10, 0), 0.01, "velocity by an impulse of 90 kg·px/s")


func test_a_body_of_the_tree_keeps_its_mass_when_the_mode_becomes_custom_and_gets_back_the_one_that_was_set() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"polygon": SoftBody2D.make_circle_polygon(25, 16)})
	var own := body.mass
	body.mass_mode = CUSTOM
	check_equal(body.mass, own, "mass of the custom mode")
	body.polygon = SoftBody2D.make_circle_polygon(50, 16)
	check_equal(body.mass, own, "with another polygon")
	body.mass = 7
	body.mass_mode = AUTO
	check_equal(body.mass, 1.0, "automatic mass")
	body.mass_mode = CUSTOM # as undo does it
	check_equal(body.mass, 7.0, "the mass that was set before")


func test_a_refused_mass_changes_neither_mass_nor_mode() -> void:
	var body := add_weightless_body()
	for bad: float in [0.0, -1.0, NAN, INF, 1e300]:
		check_refused(func() -> void: body.mass = bad, ["mass"], "mass = %s" % bad)
		check_equal([body.mass_mode, body.mass], [AUTO, 1.0], "mode and mass after %s" % bad)
	check_refused(func() -> void: body.set("mass_mode", 2), ["mass_mode", "2"], "mass_mode = 2")
	check_equal(body.mass_mode, AUTO, "mode after a refused one")


# Inspector and files.

func test_only_a_mass_that_was_set_can_be_edited_and_is_saved() -> void:
	var body := SoftBody2D.new()
	for mode: int in [AUTO, CUSTOM, AUTO]:
		body.mass_mode = mode as SoftBody2D.MassMode
		check_equal(_usage(body, "mass") & PROPERTY_USAGE_READ_ONLY != 0, mode == AUTO, "whether it is read only in mode %d" % mode)
		check_equal(_usage(body, "mass") & PROPERTY_USAGE_STORAGE != 0, mode == CUSTOM, "whether it is saved in mode %d" % mode)
		check(_usage(body, "mass") & PROPERTY_USAGE_EDITOR, "it is shown in mode %d" % mode)
	body.free()


func test_a_scene_keeps_the_mass_and_how_it_is_made() -> void:
	for mass: float in [0.0, 1.0, 2.5]: # 0: what the size makes
		var body := SoftBody2D.new()
		body.polygon = SoftBody2D.make_circle_polygon(80, 12)
		body.soft_body_material = SoftBodyMaterial2D.new()
		body.soft_body_material.density = 3
		if mass > 0:
			body.mass = mass
		var texts: Array[String] = []
		var loaded := _reload(body, texts)
		check_equal("mass = " in texts[0], not mass in [0.0, 1.0], "whether %s kg are written" % mass)
		check_equal("mass_mode = " in texts[0], mass > 0, "whether the mode is written for %s kg" % mass)
		check_equal([loaded.mass_mode, loaded.mass], [body.mass_mode, body.mass], "mode and mass after loading, of %s kg" % mass)
		var twin := body.duplicate() as SoftBody2D
		check_equal([twin.mass_mode, twin.mass], [body.mass_mode, body.mass], "those of a duplicate of %s kg" % mass)
		loaded.free()
		twin.free()
		body.free()


## As earlier versions wrote it: the mass alone.
func test_the_mass_of_an_old_scene_is_one_that_was_set() -> void:
	var path := "user://old_mass_test.tscn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_scene format=3]\n\n[node name=\"Old\" type=\"SoftBody2D\"]\nscale = Vector2(2, 2)\nmass = 2.5\npolygon = PackedVector2Array(0, 0, 50, 0, 50, 50)\n")
	file.close()
	var body := (ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene).instantiate() as SoftBody2D
	DirAccess.remove_absolute(path)
	check_equal([body.mass_mode, body.mass], [CUSTOM, 2.5], "mode and mass")
	body.free()


# Firm enough for its weight.

func test_a_new_node_moves_to_the_bit_as_without_help() -> void:
	add_floor(100)
	var courses: Array[PackedVector2Array] = []
	for firm: bool in [true, false]:
		var body := add_body(Vector2.ZERO, {"firm_for_weight": firm})
		var course := PackedVector2Array()
		for i in 90:
			await ticks(1)
			course.append_array(body.get_point_positions())
		courses.append(course)
		check_equal(body.get_youngs_modulus_in_use(), 300.0, "Young's modulus in use")
		body.free()
	check(courses[0] == courses[1], "the way of every point")


func test_youngs_modulus_grows_with_the_weight_over_the_radius_and_never_falls() -> void:
	for values: Array in [[50, 1.0, 1.0], [50, 100.0, 1.0], [50, 4.0, -3.0], [10, 0.01, 1.0], [500, 100.0, 0.2], [200, 16.0, 0.0]]:
		for modulus: float in [5.0, 300.0, 2000.0]:
			var body := SoftBody2D.new()
			body.polygon = SoftBody2D.make_circle_polygon(values[0], 16)
			body.mass = values[1]
			body.gravity_scale = values[2]
			body.youngs_modulus = modulus
			var load := body.mass * GRAVITY * absf(body.gravity_scale) / sqrt(_area(body.polygon) / PI)
			var expected := maxf(modulus * maxf(1, load / 20), 2 * load)
			check_near(body.get_youngs_modulus_in_use() / expected, 1.0, 1e-5, "Young's modulus of %s at %s N/m, over the expected" % [values, modulus])
			body.firm_for_weight = false
			check_equal(body.get_youngs_modulus_in_use(), modulus, "without help")
			check_equal(body.youngs_modulus, modulus, "the value that was set")
			body.free()


func test_a_large_or_heavy_body_sags_no_more_than_a_new_node() -> void:
	var usual: float = add_body().get_stability_report(1000.0)["sag"]
	for values: Dictionary in [{"polygon": SoftBody2D.make_circle_polygon(500, 16)}, {"scale": Vector2(6, 6)}, {"mass": 1000.0},
			{"gravity_scale": 5.0}, {"mass": 30.0, "elastic_model": SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA}]:
		var body := add_body(Vector2.ZERO, values)
		var report := body.get_stability_report(1000.0)
		check_below(report["sag"], 1.5 * usual, "sag of %s" % [values.keys()])
		check_above(report["firm_factor"], 4, "how many times as firm")
		check_near(report["youngs_modulus_in_use"], body.youngs_modulus * report["firm_factor"], 1e-2, "Young's modulus in use")
		check_equal(body.get_warnings(), PackedStringArray(), "warnings")
		body.firm_for_weight = false
		check_above(body.get_stability_report(1000.0)["sag"], 2 * usual, "sag without help")
		body.free()


func test_gravity_that_changes_in_every_tick_makes_the_body_firmer_and_builds_nothing() -> void:
	var body := add_body()
	var built := SoftBodySimulation2D.get_built_shape_count()
	for i in 60:
		body.gravity_scale = 1 + 0.1 * i
		await ticks(1)
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes that were built")
	check_above(body.get_youngs_modulus_in_use(), 1900, "Young's modulus at 6.9 times the gravity")
	body.gravity_scale = 1
	check_equal(body.get_youngs_modulus_in_use(), 300.0, "Young's modulus at the usual gravity")


func test_a_material_too_soft_for_any_weight_is_told_of_and_the_advice_has_an_effect() -> void:
	for values: Dictionary in [{}, {"mass": 50.0}]:
		var body := add_body(Vector2.ZERO, {"youngs_modulus": 10.0}.merged(values))
		var report := body.get_stability_report(1000.0)
		check(report["weight_decides"], "the report says that the weight decides")
		check(not report["folds"], "it does not fold")
		var warnings := "\n".join(body.get_warnings())
		check("Young's modulus 10" in warnings and "firm_for_weight" in warnings, "no warning: " + warnings)
		var advised := warnings.get_slice("at least", 0).get_slice("as with ", 1).to_float()
		body.youngs_modulus = 0.97 * advised
		check("firm_for_weight" in "\n".join(body.get_warnings()), "a little less than the advised %s N/m is enough" % advised)
		body.youngs_modulus = advised
		check_equal(body.get_warnings(), PackedStringArray(), "warnings at the advised value")
		var firm: float = body.get_stability_report(1000.0)["firm_youngs_modulus"]
		body.youngs_modulus = firm
		check_below(body.get_stability_report(1000.0)["sag"], 0.11, "sag at the advised %s N/m" % firm)
		body.free()


func test_a_network_is_as_firm_as_its_raw_values() -> void:
	var body := add_body(Vector2.ZERO, {"stiffness": 100.0, "mass": 50.0})
	check_equal(body.get_youngs_modulus_in_use(), 0.0, "Young's modulus in use")
	check_equal(body.get_stability_report(1000.0)["firm_factor"], 1.0, "how many times as firm")
