# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The inspector shows what every body needs first, and the rest in groups that are folded away.

const FIRST: Array[String] = ["soft_body_material", "preset", "youngs_modulus", "mass_mode", "mass", "physics_material_override"]


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


func test_six_properties_come_first_and_all_others_are_in_groups() -> void:
	check_equal(_groups()[""], FIRST, "properties outside all groups")


func test_all_arrays_are_in_one_group_the_last() -> void:
	var groups := _groups()
	check_equal(groups.keys()[-1], "Data", "the last group")
	var body := SoftBody2D.new()
	for group: String in groups:
		for name: String in groups[group]:
			check_equal(typeof(body.get(name)) >= TYPE_ARRAY, group == "Data", "whether %s in '%s' is an array" % [name, group])
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
