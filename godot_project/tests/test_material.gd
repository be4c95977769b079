# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## A material is shared by nodes: its values count instead of theirs, and a change reaches all of them.

const FIELDS := {
	"youngs_modulus": [250.0, 320.0], "poisson_ratio": [0.25, 0.375], "damping_ratio": [0.5, 0.25],
	"stiffness": [250.0, 320.0], "damping": [0.5, 0.75], "shape_matching": [0.75, 0.5], "shape_damping_ratio": [0.5, 0.125],
	"pressure": [20.0, 40.0], "inflation": [1.25, 1.5], "friction": [0.75, 0.125], "bounce": [0.5, 0.25],
	"rolling_resistance": [0.25, 0.125], "density": [2.0, 4.0],
}


func _make(values := {}) -> SoftBodyMaterial2D:
	var material := SoftBodyMaterial2D.new()
	for name: String in values:
		material.set(name, values[name])
	return material


func test_a_change_reaches_every_body_of_the_material_at_once() -> void:
	var material := _make({"stiffness": 250.0, "damping": 0.5})
	var bodies: Array[SoftBody2D] = []
	for i in 3:
		bodies.append(add_weightless_body(Vector2(200 * i, 0), {"soft_body_material": material}))
	var other := add_weightless_body(Vector2(800, 0), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	for body in bodies:
		check_equal(body.get_spring_stiffness(3), 250.0, "stiffness of a spring")
	material.stiffness = 320.0
	material.damping = 0.75
	for body in bodies:
		check_equal(body.get_spring_stiffness(3), 320.0, "stiffness of a spring after the change")
		check_near(body.get_spring_damping(3), 0.75, 1e-6, "damping of a spring after the change")
	check_equal(other.get_spring_stiffness(3), 100.0, "stiffness of a body without the material")


func test_a_material_overrides_the_nodes_values_and_loses_none_of_them() -> void:
	var material := _make({"stiffness": 250.0})
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 60.0})
	body.soft_body_material = material
	check_equal(body.get_spring_stiffness(0), 250.0, "stiffness with the material")
	check_equal(body.stiffness, 60.0, "the node's own stiffness")
	body.stiffness = 70.0
	check_equal(body.get_spring_stiffness(0), 250.0, "stiffness after the node's own has changed")
	body.soft_body_material = null
	check_equal(body.get_spring_stiffness(0), 70.0, "stiffness without the material")
	material.stiffness = 400.0
	check_equal(body.get_spring_stiffness(0), 70.0, "stiffness after a change of the material that was taken away")
	check_equal(material.changed.get_connections().size(), 0, "listeners that the material has left")


func test_every_value_of_a_material_makes_the_motion_that_the_nodes_own_makes() -> void:
	add_floor(60)
	var plain := {}
	for name: String in FIELDS:
		if name != "density":
			plain[name] = FIELDS[name][0]
	var of_node := plain.duplicate()
	of_node.erase("friction")
	of_node.erase("bounce")
	of_node["physics_material_override"] = surface(plain["friction"], plain["bounce"])
	var own := add_body(Vector2.ZERO, of_node)
	var shared := add_body(Vector2(400, 0), {"soft_body_material": _make(plain)})
	for i in 90:
		await ticks(1)
		var expected := Transform2D(0, Vector2(400, 0)) * own.get_point_positions()
		check_points_near(shared.get_point_positions(), expected, 0.01, "points at tick %d" % i)


func test_values_out_of_range_are_refused_and_nobody_is_told() -> void:
	var material := _make()
	material.resource_name = "Jelly"
	var told: Array[int] = [0]
	material.changed.connect(func() -> void: told[0] += 1)
	for name: String in FIELDS:
		var bad: Array = [-0.5, NAN, INF, 1e300]
		if name == "bounce":
			bad.append(1.5)
		if name == "poisson_ratio":
			bad.append(0.5)
		if name == "youngs_modulus":
			bad.append(0.0)
		for value: float in bad:
			var old: float = material.get(name)
			check_refused(func() -> void: material.set(name, value), ["Jelly", name], "%s = %s" % [name, value])
			check_equal(material.get(name), old, name + " after a refused value")
	check_equal(told[0], 0, "how often the material said that it has changed")
	for name: String in FIELDS:
		material.set(name, FIELDS[name][0])
		material.set(name, FIELDS[name][0])
	check_equal(told[0], FIELDS.size(), "how often it said so for as many changes")


func test_density_makes_the_mass_of_the_area_and_a_scaled_body_heavier() -> void:
	# Two by one meters.
	var polygon := SoftBody2D.make_box_polygon(Vector2(200, 100), 25)
	var material := _make({"density": 3.0, "stiffness": 300.0})
	var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon, "mass": 5.0})
	check_equal(body.get_total_mass(), 5.0, "mass without a material")
	body.soft_body_material = material
	check_near(body.get_total_mass(), 6.0, 1e-4, "mass at 3 kg/m²")
	body.apply_central_impulse(Vector2(600, 0))
	check_near(body.linear_velocity, Vector2(100, 0), 0.01, "velocity after an impulse of 600 kg·px/s")
	material.density = 0.0
	check_equal(body.get_total_mass(), 5.0, "mass at density 0")
	material.density = 1.5
	check_near(body.get_total_mass(), 3.0, 1e-4, "mass at 1.5 kg/m²")
	var large := add_weightless_body(Vector2(900, 0), {"polygon": polygon, "scale": Vector2(2, 2), "soft_body_material": material})
	check_near(large.get_total_mass(), 12.0, 1e-3, "mass of a body of twice the size")
	check_equal(body.mass, 5.0, "the node's own mass")


func test_what_a_material_overrides_is_shown_and_saved_but_not_edited() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"stiffness": 60.0})
	var usage := func(name: String) -> int:
		for property in body.get_property_list():
			if property["name"] == name:
				return property["usage"]
		return 0
	var own := FIELDS.keys().filter(func(name: String) -> bool: return not name in ["density", "friction", "bounce"])
	for name: String in own:
		check(not usage.call(name) & PROPERTY_USAGE_READ_ONLY, name + " cannot be edited without a material")
	body.soft_body_material = _make()
	for name: String in own:
		check(usage.call(name) & PROPERTY_USAGE_READ_ONLY, name + " can be edited with a material")
		check(usage.call(name) & PROPERTY_USAGE_STORAGE, name + " is not saved with a material")
	check(not usage.call("mass") & PROPERTY_USAGE_READ_ONLY, "mass cannot be edited though the density is 0")
	body.soft_body_material.density = 1
	check(usage.call("mass") & PROPERTY_USAGE_READ_ONLY, "mass can be edited though the density decides")


func test_a_material_is_saved_and_loaded_alone_and_in_a_scene() -> void:
	var values := {}
	for name: String in FIELDS:
		values[name] = FIELDS[name][1]
	var material := _make(values)
	for path: String in ["user://material_test.tres", "user://material_test.res"]:
		check_equal(ResourceSaver.save(material, path), OK, "saving " + path)
		var loaded := ResourceLoader.load(path, "", ResourceLoader.CACHE_MODE_IGNORE) as SoftBodyMaterial2D
		DirAccess.remove_absolute(path)
		for name: String in values:
			check_equal(loaded.get(name), values[name], name + " after loading")
	var root := Node2D.new()
	for i in 2:
		var body := SoftBody2D.new()
		body.soft_body_material = material
		root.add_child(body)
		body.owner = root
	var scene := PackedScene.new()
	scene.pack(root)
	var copy := scene.instantiate()
	var first := copy.get_child(0) as SoftBody2D
	check_equal(first.soft_body_material, (copy.get_child(1) as SoftBody2D).soft_body_material, "the material of both")
	check_equal(first.soft_body_material.stiffness, FIELDS["stiffness"][1], "its stiffness")
	copy.free()
	root.free()


func test_a_material_local_to_scene_belongs_to_one_instance() -> void:
	var material := _make({"stiffness": 200.0})
	material.resource_local_to_scene = true
	var body := SoftBody2D.new()
	body.soft_body_material = material
	var scene := PackedScene.new()
	scene.pack(body)
	body.free()
	var a := scene.instantiate() as SoftBody2D
	var b := scene.instantiate() as SoftBody2D
	stage.add_child(a)
	stage.add_child(b)
	a.soft_body_material.stiffness = 300.0
	check_equal(a.get_spring_stiffness(0), 300.0, "stiffness of the first instance")
	check_equal(b.get_spring_stiffness(0), 200.0, "stiffness of the second instance")


func test_a_duplicate_shares_the_material_unless_it_is_duplicated_too() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"soft_body_material": _make({"stiffness": 200.0})})
	var copy := body.duplicate() as SoftBody2D
	check_equal(copy.soft_body_material, body.soft_body_material, "material of the copy")
	copy.soft_body_material = body.soft_body_material.duplicate() as SoftBodyMaterial2D
	check_equal(copy.soft_body_material.stiffness, 200.0, "stiffness of the duplicated material")
	copy.free()


func test_a_material_that_no_body_can_have_leaves_the_body_as_it_is() -> void:
	var material := _make({"density": 1.0})
	var body := add_weightless_body(Vector2.ZERO, {"soft_body_material": material, "scale": Vector2(2, 2)})
	body.name = "Jelly"
	var mass := body.get_total_mass()
	check_refused(func() -> void: material.density = 3e38, ["Jelly", "soft_body_material"], "a density that overflows")
	check("soft_body_material" in "\n".join(body.get_warnings()), "no warning about the material")
	body.apply_central_impulse(Vector2(mass, 0))
	check_near(body.linear_velocity, Vector2(1, 0), 1e-4, "velocity of the body, which keeps its mass")
	take_errors()
	material.density = 1.0
	check_equal(body.get_warnings(), PackedStringArray(), "warnings after a good value")
