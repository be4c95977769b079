# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## `docs/godot-audit.md` names every member of RigidBody2D and of its bases once, and says the truth of SoftBody2D.

const PAGE := "res://../docs/godot-audit.md"
const CLASSES: Array[String] = ["RigidBody2D", "PhysicsBody2D", "CollisionObject2D", "Node2D", "CanvasItem"]
const HEADINGS := PROPERTY_USAGE_GROUP | PROPERTY_USAGE_SUBGROUP | PROPERTY_USAGE_CATEGORY | PROPERTY_USAGE_INTERNAL

## Class -> member -> [status, reason, suite], and lines that stand there twice.
var _rows := {}
var _twice := PackedStringArray()


func _read_page() -> bool:
	_rows = {}
	_twice = []
	var path := ProjectSettings.globalize_path(PAGE)
	if not FileAccess.file_exists(path):
		skip("there is no folder docs beside the project")
		return false
	var class_id := ""
	for line in FileAccess.get_file_as_string(path).split("\n"):
		if line.begins_with("## "):
			class_id = line.trim_prefix("## ")
			_rows[class_id] = {}
		elif line.begins_with("| `"):
			var cells := line.trim_prefix("|").trim_suffix("|").split("|")
			var name := cells[0].strip_edges().trim_prefix("`").trim_suffix("`")
			if _rows[class_id].has(name):
				_twice.append("%s.%s" % [class_id, name])
			_rows[class_id][name] = [cells[1].strip_edges(), cells[2].strip_edges(), cells[3].strip_edges().trim_prefix("`").trim_suffix("`")]
	return true


func _named(list: Array) -> Dictionary:
	var found := {}
	for entry: Dictionary in list:
		found[String(entry["name"])] = entry
	return found


func _properties(class_id: String, own: bool) -> Dictionary:
	return _named(ClassDB.class_get_property_list(class_id, own).filter(
			func(property: Dictionary) -> bool: return not property["usage"] & HEADINGS))


## Getter and setter of a property, without what it lacks.
func _accessors(class_id: String, property: String) -> Array:
	return [String(ClassDB.call("class_get_property_getter", class_id, property)), String(ClassDB.call("class_get_property_setter", class_id, property))] \
			.filter(func(name: String) -> bool: return name != "")


## Methods of the class that belong to no property of it.
func _methods(class_id: String) -> Dictionary:
	var methods := _named(ClassDB.class_get_method_list(class_id, true))
	for property: String in _properties(class_id, true):
		for name: String in _accessors(class_id, property):
			if not name in ["get_transform", "get_global_transform"]: # said apart
				methods.erase(name)
	return methods


func _members(class_id: String) -> Array:
	return _properties(class_id, true).keys() + _methods(class_id).keys() + _named(ClassDB.class_get_signal_list(class_id, true)).keys()


func _can_read() -> bool:
	if not ClassDB.has_method("class_get_property_getter"):
		skip("this engine does not tell the getter of a property (4.3)")
		return false
	return _read_page()


func test_every_member_stands_in_the_table_once() -> void:
	if not _can_read():
		return
	check_equal(_twice, PackedStringArray(), "members that stand there twice")
	check_equal(_rows.keys(), CLASSES, "classes of the page")
	var is_pages_engine: bool = Engine.get_version_info()["major"] == 4 and Engine.get_version_info()["minor"] == 6
	for class_id in CLASSES:
		var members := _members(class_id)
		for name: String in members:
			check(_rows[class_id].has(name) or not is_pages_engine, "%s.%s is missing in the table" % [class_id, name])
		for name: String in _rows[class_id]:
			check(name in members or not is_pages_engine, "%s.%s of the table does not exist" % [class_id, name])
	check_above(_rows["CanvasItem"].size(), 80, "members of CanvasItem")


func test_each_line_says_the_truth_and_why() -> void:
	if not _can_read():
		return
	var ours := _properties("SoftBody2D", false)
	var our_methods := _named(ClassDB.class_get_method_list("SoftBody2D"))
	var our_signals := _named(ClassDB.class_get_signal_list("SoftBody2D"))
	for class_id in CLASSES:
		var properties := _properties(class_id, true)
		var methods := _methods(class_id)
		for name: String in _rows[class_id]:
			var row: Array = _rows[class_id][name]
			var what := "%s.%s" % [class_id, name]
			check(row[0] in ["same", "different", "absent"], "%s is said to be '%s'" % [what, row[0]])
			check(row[0] == "same" or row[1].length() > 5, what + " has no reason")
			check(FileAccess.file_exists("res://tests/%s.gd" % row[2]), "%s: there is no suite %s" % [what, row[2]])
			var exists: bool = ours.has(name) if properties.has(name) else our_methods.has(name) if methods.has(name) else our_signals.has(name)
			if not check_equal(exists, row[0] != "absent", "%s exists in SoftBody2D" % what) or not exists:
				continue
			if properties.has(name):
				check_equal(ours[name]["type"], properties[name]["type"], what + ": type")
				var read_only: bool = row[1].begins_with("Read only")
				for accessor: String in _accessors(class_id, name).slice(0, 1 if read_only else 2):
					check(our_methods.has(accessor), "%s: SoftBody2D has no method %s" % [what, accessor])
			elif methods.has(name) and row[0] == "same":
				check_equal(_signature(our_methods[name]), _signature(methods[name]), what + ": types of arguments and result")


func _signature(method: Dictionary) -> Array:
	return [method["return"]["type"], (method["args"] as Array).map(func(argument: Dictionary) -> int: return argument["type"]),
			method["default_args"]]


## What a Node2D does with its transform, a body without weight does.
func test_it_is_moved_as_a_plain_node() -> void:
	var far := Transform2D(0.4, Vector2(1, 1), 0, Vector2(120, -40))
	for action: Array in [["set", "position", Vector2(30, 40)], ["set", "rotation", 0.5], ["set", "rotation_degrees", 20.0],
			["set", "global_position", Vector2(7, 8)], ["set", "global_rotation", -0.3], ["set", "global_rotation_degrees", 15.0],
			["set", "transform", far], ["set", "global_transform", far], ["rotate", 0.2], ["move_local_x", 12.0], ["move_local_y", -9.0, true],
			["translate", Vector2(3, 4)], ["global_translate", Vector2(5, 6)], ["look_at", Vector2(900, 300)], ["set", "scale", Vector2(1.5, 1.5)],
			["apply_scale", Vector2(0.8, 0.8)], ["set", "global_scale", Vector2(2, 2)], ["set", "skew", 0.2], ["set", "global_skew", 0.2]]:
		var nodes: Array[Node2D] = []
		var parent := Node2D.new()
		parent.transform = Transform2D(0.3, Vector2(50, 60))
		stage.add_child(parent)
		for node: Node2D in [Node2D.new(), SoftBody2D.new()]:
			node.set("gravity_scale", 0)
			node.position = Vector2(10, 20)
			parent.add_child(node)
			nodes.append(node)
		await ticks(2)
		for node in nodes:
			node.callv(action[0], action.slice(1))
		await ticks(3)
		var plain := nodes[0].global_transform
		var body := nodes[1].global_transform
		check_near(body.origin, plain.origin, 0.05, "place after %s" % [action])
		check_near(body.x, plain.x, 1e-3, "x axis after %s" % [action])
		check_near(body.y, plain.y, 1e-3, "y axis after %s" % [action])
		check_near(nodes[1].to_global(Vector2(9, 5)), nodes[0].to_global(Vector2(9, 5)), 0.05, "to_global after %s" % [action])
		check_near(nodes[1].get_angle_to(Vector2(500, 0)), nodes[0].get_angle_to(Vector2(500, 0)), 1e-3, "get_angle_to after %s" % [action])
		parent.free()


## The properties of a CanvasItem are set and read as those of any other node, and a tick changes none.
func test_it_is_a_canvas_item_as_others() -> void:
	var body := add_weightless_body(Vector2(40, 30))
	var plain := Node2D.new()
	stage.add_child(plain)
	var signals := PackedStringArray()
	body.visibility_changed.connect(func() -> void: signals.append("visibility_changed"))
	body.hidden.connect(func() -> void: signals.append("hidden"))
	var values := {TYPE_BOOL: [true, false], TYPE_INT: [2, 1], TYPE_COLOR: [Color.TOMATO, Color(1, 1, 1, 0.5)],
			TYPE_OBJECT: [CanvasItemMaterial.new(), null]}
	var count := 0
	for name: String in _properties("CanvasItem", true):
		for value: Variant in values[typeof(plain.get(name)) if plain.get(name) != null else TYPE_OBJECT]:
			body.set(name, value)
			plain.set(name, value)
			await ticks(1)
			check_equal(body.get(name), plain.get(name), "%s once set to %s" % [name, value])
			count += 1
	check_above(count, 25, "number of values")
	check("visibility_changed" in signals and "hidden" in signals, "signals of hiding: %s" % signals)
	check(body.is_transform_notification_enabled(), "the node is not told that it was moved")
	check_equal(body.get_canvas_transform(), plain.get_canvas_transform(), "canvas transform")
	check_equal(body.get_world_2d(), plain.get_world_2d(), "world")
	var before := body.global_transform
	body.top_level = true
	await ticks(2)
	check_near(body.global_transform.origin, before.origin, 0.01, "place of a body that became top level")
