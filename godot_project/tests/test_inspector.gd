# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The inspector shows what every body needs first, and the rest in groups that are folded away.

const ClassReference := preload("res://tests/support/class_reference.gd")

## Material, polygon, color or texture, mass, layers.
const FIRST: Array[String] = ["soft_body_material", "preset", "polygon", "color", "texture", "mass_mode", "mass", "collision_layer",
	"collision_mask"]


## Names by group; those of no group under "". Only what the inspector shows.
func _groups() -> Dictionary:
	var groups := {"": []}
	var group := ""
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		if property["usage"] & PROPERTY_USAGE_GROUP:
			group = property["name"]
			check(not groups.has(group), "the group %s is there once" % group)
			groups[group] = []
		elif property["usage"] & PROPERTY_USAGE_EDITOR:
			(groups[group] as Array).append(property["name"])
	return groups


func test_material_polygon_color_mass_and_layers_come_first_and_all_others_are_in_groups() -> void:
	check_equal(_groups()[""], FIRST, "properties outside all groups")


func test_all_arrays_but_the_polygon_are_in_one_group_the_last() -> void:
	var groups := _groups()
	check_equal(groups.keys()[-1], "Data", "the last group")
	var body := SoftBody2D.new()
	for group: String in groups:
		for name: String in groups[group]:
			check_equal(typeof(body.get(name)) >= TYPE_ARRAY, group == "Data" or name == "polygon", "whether %s in '%s' is an array" % [name, group])
	body.free()


func test_like_dampings_have_like_units() -> void:
	var units := {}
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		var name: String = property["name"]
		if property["type"] == TYPE_FLOAT and "damp" in name:
			var unit := (property["hint_string"] as String).get_slice("suffix:", 1) if "suffix:" in property["hint_string"] else ""
			units[name] = unit
			check_equal(unit, "1/s" if name.ends_with("_damp") else "" if name.ends_with("_ratio") else "N·s/m", "unit of " + name)
	check_equal(units.size(), 5, "dampings: %s" % [units.keys()])


## What a slider does to the picture is said where it is seen first: in the tooltip.
func test_tooltips_of_what_a_body_is_made_of_say_what_is_seen_as_it_grows() -> void:
	var pages := ClassReference.read_all()
	if pages.is_empty():
		skip("there is no folder doc_classes beside the project")
		return
	for name: String in ["youngs_modulus", "poisson_ratio", "damping_ratio", "mass", "gravity_scale", "rolling_resistance", "stiffness",
			"linear_damp", "angular_damp", "least_area", "yield_strain", "max_dent", "tear_stretch", "smallest_piece", "substeps"]:
		check("As it grows, " in pages["SoftBody2D"].entries["member"][name]["text"], name)
	for name: String in ["youngs_modulus", "friction", "bounce", "density"]:
		check("As it grows, " in pages["SoftBodyMaterial2D"].entries["member"][name]["text"], "%s of the material" % name)
