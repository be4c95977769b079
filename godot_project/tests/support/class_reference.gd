# SPDX-License-Identifier: MIT
extends RefCounted
## One page of the class reference: what an XML file of `doc_classes` says about a class.

const FOLDER := "res://../doc_classes"
## Tags that hold an entry of a page, by name.
const KINDS: Array[String] = ["method", "member", "signal", "constant"]

## What the class derives from.
var inherits := ""
## Kind -> name -> the attributes of the tag, and besides "text", "params" (attributes of each) and "return" (attributes).
var entries := {}
## Brief description and description of the class.
var own_text := { "brief_description": "", "description": "" }


## All pages by the name of their class; empty where the project lies alone, without the folder beside it.
static func read_all() -> Dictionary:
	var pages := {}
	var folder := ProjectSettings.globalize_path(FOLDER)
	if DirAccess.dir_exists_absolute(folder):
		for file in DirAccess.get_files_at(folder):
			if file.ends_with(".xml"):
				pages[file.get_basename()] = new(folder.path_join(file))
	return pages


func _init(path: String) -> void:
	for kind in KINDS:
		entries[kind] = {}
	var parser := XMLParser.new()
	parser.open(path)
	var entry := {}
	var text_of := ""
	while parser.read() == OK:
		match parser.get_node_type():
			XMLParser.NODE_ELEMENT:
				var tag := parser.get_node_name()
				if tag == "class":
					inherits = _attributes(parser).get("inherits", "")
				elif tag in KINDS:
					entry = _attributes(parser).merged({ "text": "", "params": [], "return": { "type": "void" } })
					entries[tag][entry["name"]] = entry
					text_of = tag if tag in ["member", "constant"] else ""
				elif tag == "param":
					(entry["params"] as Array).append(_attributes(parser))
				elif tag == "return":
					entry["return"] = _attributes(parser)
				elif own_text.has(tag):
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
				if parser.get_node_name() in KINDS:
					entry = {}


## The names of an enumeration's constants, by value.
func constants_of(enumeration: String) -> Dictionary:
	var found := {}
	for name: String in entries["constant"]:
		if entries["constant"][name].get("enum", "") == enumeration:
			found[int(entries["constant"][name]["value"])] = name
	return found


func _attributes(parser: XMLParser) -> Dictionary:
	var found := {}
	for i in parser.get_attribute_count():
		found[parser.get_attribute_name(i)] = parser.get_attribute_value(i)
	return found
