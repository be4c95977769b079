# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The class reference says something about everything that scripts can use, and about nothing else.

const FOLDER := "res://../doc_classes"
const HEADINGS := PROPERTY_USAGE_GROUP | PROPERTY_USAGE_SUBGROUP | PROPERTY_USAGE_CATEGORY | PROPERTY_USAGE_INTERNAL


## What one XML file says: by kind ("method", "member", "signal", "constant"), then by name.
class Reference:
	var entries := {"method": {}, "member": {}, "signal": {}, "constant": {}}
	var own_text := {"brief_description": "", "description": ""}

	func _init(path: String) -> void:
		var parser := XMLParser.new()
		parser.open(path)
		var entry := {}
		var text_of := ""
		while parser.read() == OK:
			match parser.get_node_type():
				XMLParser.NODE_ELEMENT:
					var tag := parser.get_node_name()
					if entries.has(tag):
						entry = {"text": "", "params": []}
						for i in parser.get_attribute_count():
							entry[parser.get_attribute_name(i)] = parser.get_attribute_value(i)
						entries[tag][entry["name"]] = entry
						text_of = tag if tag in ["member", "constant"] else ""
					elif tag == "param":
						(entry["params"] as Array).append(parser.get_named_attribute_value("name"))
					elif tag in ["description", "brief_description"]:
						text_of = tag
				XMLParser.NODE_TEXT:
					var text := parser.get_node_data().strip_edges()
					if text_of != "" and not entry.is_empty():
						entry["text"] += text
					elif text_of != "":
						own_text[text_of] += text
				XMLParser.NODE_ELEMENT_END:
					if parser.get_node_name() in ["member", "constant", "description", "brief_description"]:
						text_of = ""
					if entries.has(parser.get_node_name()):
						entry = {}


func _own_classes() -> PackedStringArray:
	var found := PackedStringArray()
	for name in ClassDB.get_class_list():
		if ClassDB.call("class_get_api_type", name) == 2: # API_EXTENSION
			found.append(name)
	return found


func _names(list: Array) -> PackedStringArray:
	return PackedStringArray(list.map(func(entry: Dictionary) -> String: return entry["name"]))


func _can_be_done() -> bool:
	if not ClassDB.has_method("class_get_api_type"):
		skip("this engine does not tell whose a class is (4.4)")
	elif not DirAccess.dir_exists_absolute(ProjectSettings.globalize_path(FOLDER)):
		skip("there is no folder doc_classes beside the project")
	return skip_reason == ""


## Claims that both lists hold the same names.
func _compare(class_id: String, kind: String, actual: PackedStringArray, written: Array) -> void:
	for name in actual:
		check(name in written, "%s: %s %s is missing in the class reference" % [class_id, kind, name])
	for name: String in written:
		check(name in actual, "%s: %s %s of the class reference does not exist" % [class_id, kind, name])


func test_every_class_of_the_extension_has_a_page_and_every_page_a_class() -> void:
	if not _can_be_done():
		return
	var classes := _own_classes()
	check_above(classes.size(), 2, "number of classes")
	var pages := PackedStringArray()
	for file in DirAccess.get_files_at(ProjectSettings.globalize_path(FOLDER)):
		pages.append(file.get_basename())
	_compare("(all)", "class", classes, Array(pages))


func test_every_method_property_signal_and_constant_is_written_down_and_nothing_else() -> void:
	if not _can_be_done():
		return
	for class_id in _own_classes():
		var page := Reference.new(ProjectSettings.globalize_path(FOLDER).path_join(class_id + ".xml"))
		var properties := ClassDB.class_get_property_list(class_id, true).filter(
				func(property: Dictionary) -> bool: return not property["usage"] & HEADINGS)
		var accessors := PackedStringArray()
		for property: Dictionary in properties:
			accessors.append(ClassDB.call("class_get_property_setter", class_id, property["name"]))
			accessors.append(ClassDB.call("class_get_property_getter", class_id, property["name"]))
		var methods := ClassDB.class_get_method_list(class_id, true).filter(
				func(method: Dictionary) -> bool: return not method["name"] in accessors and not method["name"].begins_with("_"))
		var signals := ClassDB.class_get_signal_list(class_id, true)
		_compare(class_id, "method", _names(methods), page.entries["method"].keys())
		_compare(class_id, "property", _names(properties), page.entries["member"].keys())
		_compare(class_id, "signal", _names(signals), page.entries["signal"].keys())
		_compare(class_id, "constant", ClassDB.class_get_integer_constant_list(class_id, true), page.entries["constant"].keys())

		for entry: Dictionary in methods:
			if page.entries["method"].has(entry["name"]):
				check_equal(PackedStringArray(page.entries["method"][entry["name"]]["params"]), _names(entry["args"]),
						"%s.%s(): parameters in the class reference" % [class_id, entry["name"]])
		for entry: Dictionary in signals:
			if page.entries["signal"].has(entry["name"]):
				check_equal(PackedStringArray(page.entries["signal"][entry["name"]]["params"]), _names(entry["args"]),
						"%s.%s: parameters in the class reference" % [class_id, entry["name"]])
		for entry: Dictionary in properties:
			_check_property(class_id, entry, page.entries["member"].get(entry["name"], {}))


func _check_property(class_id: String, property: Dictionary, written: Dictionary) -> void:
	if written.is_empty():
		return
	var name: String = property["name"]
	var what := "%s.%s: %%s in the class reference" % [class_id, name]
	check_equal(written["setter"], ClassDB.call("class_get_property_setter", class_id, name), what % "setter")
	check_equal(written["getter"], ClassDB.call("class_get_property_getter", class_id, name), what % "getter")
	var default: Variant = ClassDB.class_get_property_default_value(class_id, name)
	if default is bool or default is int or default is float:
		check_equal(str_to_var(written.get("default", "null")), default, what % "default")


func test_no_description_is_empty() -> void:
	if not _can_be_done():
		return
	for class_id in _own_classes():
		var page := Reference.new(ProjectSettings.globalize_path(FOLDER).path_join(class_id + ".xml"))
		for part: String in page.own_text:
			check_above(page.own_text[part].length(), 10, "%s: length of its %s" % [class_id, part])
		for kind: String in page.entries:
			for name: String in page.entries[kind]:
				check_above(page.entries[kind][name]["text"].length(), 10, "%s: length of the description of %s %s" % [class_id, kind, name])
