# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Every class is what the class reference says, and the class reference leaves nothing out. No class or property is named
## here: the table that these tests go through is read from `doc_classes`.

const ClassReference := preload("res://tests/support/class_reference.gd")
const HEADINGS := PROPERTY_USAGE_GROUP | PROPERTY_USAGE_SUBGROUP | PROPERTY_USAGE_CATEGORY | PROPERTY_USAGE_INTERNAL
const ENUMERATION := PROPERTY_USAGE_CLASS_IS_ENUM | PROPERTY_USAGE_CLASS_IS_BITFIELD
const QUALIFIERS := { "const": METHOD_FLAG_CONST, "static": METHOD_FLAG_STATIC, "vararg": METHOD_FLAG_VARARG }
## How the class reference writes a unit, and how the inspector does.
const UNITS := { "kilograms": "kg", "pixels": "px", "N/m": "N/m", "N·s/m": "N·s/m" }

var _pages := {}


func _read_pages() -> bool:
	_pages = ClassReference.read_all()
	if _pages.is_empty():
		skip("there is no folder doc_classes beside the project")
	return not _pages.is_empty()


# What the engine says, in the words of the class reference.

func _properties(class_id: String) -> Dictionary:
	return _by_name(ClassDB.class_get_property_list(class_id, true).filter(
			func(property: Dictionary) -> bool: return not property["usage"] & HEADINGS))


func _methods(class_id: String) -> Dictionary:
	return _by_name(ClassDB.class_get_method_list(class_id, true))


func _signals(class_id: String) -> Dictionary:
	return _by_name(ClassDB.class_get_signal_list(class_id, true))


func _by_name(list: Array) -> Dictionary:
	var found := {}
	for entry: Dictionary in list:
		found[entry["name"]] = entry
	return found


## The type of a property, an argument or a result.
func _type_of(info: Dictionary) -> String:
	var type: int = info["type"]
	if type == TYPE_INT and info["usage"] & ENUMERATION:
		return "int"
	if info["class_name"] != &"":
		return info["class_name"]
	if type == TYPE_OBJECT and info["hint"] == PROPERTY_HINT_RESOURCE_TYPE:
		return info["hint_string"]
	if type == TYPE_ARRAY and info["hint"] == PROPERTY_HINT_ARRAY_TYPE:
		var element: String = info["hint_string"].get_slice("/", 0).get_slice(":", 0) # 22/34:Node2D, or NodePath
		return (type_string(int(element)) if element.is_valid_int() else element) + "[]"
	if type == TYPE_NIL:
		return "Variant" if info["usage"] & PROPERTY_USAGE_NIL_IS_VARIANT else "void"
	return type_string(type)


func _enumeration_of(info: Dictionary) -> String:
	return info["class_name"] if info["type"] == TYPE_INT and info["usage"] & ENUMERATION else ""


# Claims.

## Claims that both have the same names.
func _compare_names(class_id: String, kind: String, actual: Array, written: Array) -> void:
	for name: String in actual:
		check(name in written, "%s: %s %s is missing in the class reference" % [class_id, kind, name])
	for name: String in written:
		check(name in actual, "%s: %s %s of the class reference does not exist" % [class_id, kind, name])


func _compare_type(what: String, info: Dictionary, written: Dictionary) -> void:
	check_equal(written["type"], _type_of(info), what + ": type in the class reference")
	check_equal(written.get("enum", ""), _enumeration_of(info), what + ": enumeration in the class reference")


func _compare_arguments(what: String, function: Dictionary, written: Dictionary) -> void:
	var arguments: Array = function["args"]
	var params: Array = written["params"]
	var defaults: Array = function["default_args"]
	if not check_equal(params.size(), arguments.size(), what + ": number of parameters in the class reference"):
		return
	for i in arguments.size():
		var label := "%s: parameter %d" % [what, i]
		check_equal(params[i]["name"], arguments[i]["name"], label + ": name in the class reference")
		_compare_type(label, arguments[i], params[i])
		var which := i - (arguments.size() - defaults.size())
		if check_equal(params[i].has("default"), which >= 0, label + ": whether the class reference has a default") and which >= 0:
			_compare_value(label + ": default", defaults[which], params[i]["default"])


## Claims that a value is the one that is written down, as far as its digits go.
func _compare_value(what: String, actual: Variant, written: String) -> void:
	var expected: Variant = str_to_var(written)
	if not check_equal(type_string(typeof(actual)), type_string(typeof(expected)), what + ": type of its value"):
		return
	if actual is PackedVector2Array:
		check_points_near(actual, expected, 0.001, what)
	else:
		check_equal(actual, expected, what)


func test_every_class_inherits_and_begins_as_written() -> void:
	if not _read_pages():
		return
	check_above(_pages.size(), 2, "number of classes in the class reference")
	for class_id: String in _pages:
		if not check(ClassDB.class_exists(class_id), "class %s of the class reference does not exist" % class_id):
			continue
		check_equal(ClassDB.get_parent_class(class_id), StringName(_pages[class_id].inherits), class_id + ": what it inherits")
		if Engine.has_singleton(class_id):
			check_equal(Engine.get_singleton(class_id).get_class(), class_id, "class of the singleton " + class_id)
		elif check(ClassDB.can_instantiate(class_id), class_id + " cannot be made"):
			var object: Object = ClassDB.instantiate(class_id)
			check_equal(object.get_class(), class_id, class_id + ": get_class()")
			_discard(object)


func test_names_are_those_of_the_class_reference() -> void:
	if not _read_pages():
		return
	for class_id: String in _pages:
		var entries: Dictionary = _pages[class_id].entries
		var members: Dictionary = entries["member"]
		var accessors := []
		for name: String in members:
			accessors.append_array([members[name]["setter"], members[name]["getter"]])
		var methods := _methods(class_id).keys()
		for accessor: String in accessors:
			check(accessor == "" or accessor in methods, "%s: %s() of the class reference does not exist" % [class_id, accessor])
		methods = methods.filter(func(name: String) -> bool: return not name in accessors and not name.begins_with("_"))
		_compare_names(class_id, "method", methods, entries["method"].keys())
		_compare_names(class_id, "property", _properties(class_id).keys(), members.keys())
		_compare_names(class_id, "signal", _signals(class_id).keys(), entries["signal"].keys())
		_compare_names(class_id, "constant", Array(ClassDB.class_get_integer_constant_list(class_id, true)),
				entries["constant"].keys())


func test_methods_signals_and_constants_are_the_written_ones() -> void:
	if not _read_pages():
		return
	for class_id: String in _pages:
		var entries: Dictionary = _pages[class_id].entries
		var methods := _methods(class_id)
		for name: String in entries["method"]:
			if methods.has(name):
				var what := "%s.%s()" % [class_id, name]
				var written: Dictionary = entries["method"][name]
				_compare_type(what + ": result", methods[name]["return"], written["return"])
				_compare_arguments(what, methods[name], written)
				for qualifier: String in QUALIFIERS:
					check_equal(qualifier in written.get("qualifiers", "").split(" "),
							bool(methods[name]["flags"] & QUALIFIERS[qualifier]), "%s: whether it is written to be %s" % [what, qualifier])
		var signals := _signals(class_id)
		for name: String in entries["signal"]:
			if signals.has(name):
				_compare_arguments("%s.%s" % [class_id, name], signals[name], entries["signal"][name])
		for name: String in entries["constant"]:
			var what := "%s.%s" % [class_id, name]
			check_equal(ClassDB.class_get_integer_constant(class_id, name), int(entries["constant"][name]["value"]), what)
			check_equal(ClassDB.class_get_integer_constant_enum(class_id, name, true),
					StringName(entries["constant"][name].get("enum", "")), what + ": its enumeration")


func test_properties_have_the_written_type_and_accessors() -> void:
	if not _read_pages():
		return
	for class_id: String in _pages:
		var properties := _properties(class_id)
		var methods := _methods(class_id)
		for name: String in _pages[class_id].entries["member"]:
			var written: Dictionary = _pages[class_id].entries["member"][name]
			var what := "%s.%s" % [class_id, name]
			if not properties.has(name):
				continue
			check_equal(written["type"], _type_of(properties[name]), what + ": type in the class reference")
			if methods.has(written["getter"]): # it knows the enumeration
				check_equal(written.get("enum", ""), _enumeration_of(methods[written["getter"]]["return"]),
						what + ": enumeration in the class reference")
			if ClassDB.has_method(&"class_get_property_setter"): # 4.4
				for accessor: String in ["setter", "getter"]:
					check_equal(StringName(written[accessor]), ClassDB.call("class_get_property_" + accessor, class_id, name),
							"%s: %s in the class reference" % [what, accessor])


func test_defaults_are_the_written_ones() -> void:
	if not _read_pages():
		return
	for class_id: String in _pages:
		var properties := _properties(class_id)
		var object: Object = null if Engine.has_singleton(class_id) else ClassDB.instantiate(class_id)
		for name: String in _pages[class_id].entries["member"]:
			var written: Dictionary = _pages[class_id].entries["member"][name]
			var what := "%s.%s: default" % [class_id, name]
			if written.has("default"):
				_compare_value(what, ClassDB.class_get_property_default_value(class_id, name), written["default"])
				_compare_value(what + " of a new object", object.get(name), written["default"])
			elif properties.has(name) and properties[name]["usage"] & PROPERTY_USAGE_STORAGE:
				check_equal(ClassDB.class_get_property_default_value(class_id, name), null, what)
				check_equal(object.get(name), null, what + " of a new object")
		_discard(object)


func _discard(object: Object) -> void:
	if object is Node:
		object.free()


func test_the_inspector_offers_the_constants_and_units_that_are_written_down() -> void:
	if not _read_pages():
		return
	var unit := RegEx.create_from_string("\\bin (%s)(?![\\w·/])" % "|".join(UNITS.keys()))
	var enumerations := 0
	var units := 0
	for class_id: String in _pages:
		var properties := _properties(class_id)
		for name: String in _pages[class_id].entries["member"]:
			if not properties.has(name) or not properties[name]["usage"] & PROPERTY_USAGE_STORAGE:
				continue
			var written: Dictionary = _pages[class_id].entries["member"][name]
			var hint: String = properties[name]["hint_string"]
			var what := "%s.%s" % [class_id, name]
			check(properties[name]["usage"] & PROPERTY_USAGE_EDITOR or "stored" in written["text"],
					what + " is not shown in the inspector, and the class reference does not say why it is stored")
			if written.has("enum"):
				enumerations += 1
				check_equal(properties[name]["hint"], PROPERTY_HINT_ENUM, what + ": hint")
				_compare_options(what, hint, written["enum"])
			if name.ends_with("_layer") or name.ends_with("_mask"):
				check_equal(properties[name]["hint"], PROPERTY_HINT_LAYERS_2D_PHYSICS, what + ": hint")
			var named := unit.search(written["text"].get_slice(". ", 0))
			if named != null and properties[name]["type"] in [TYPE_FLOAT, TYPE_VECTOR2]:
				units += 1
				check("suffix:" + UNITS[named.get_string(1)] in hint, "hint of %s is '%s', the class reference says %s" % [what, hint, named.get_string()])
				if properties[name]["hint"] == PROPERTY_HINT_RANGE:
					check("or_greater" in hint, "the inspector ends the range of %s, which has a unit" % what)
	check_above(enumerations, 3, "number of properties with an enumeration")
	check_above(units, 5, "number of properties with a unit")


## Claims that the inspector's list ("Off,On,Automatic") has the constants of the enumeration in the order of their values.
func _compare_options(what: String, hint: String, enumeration: String) -> void:
	var constants: Dictionary = _pages[enumeration.get_slice(".", 0)].constants_of(enumeration.get_slice(".", 1))
	var options := hint.split(",")
	check_equal(options.size(), constants.size(), what + ": number of options in the inspector")
	for i in options.size():
		var option := options[i].get_slice(":", 0).to_upper().replace(" ", "_").replace("-", "_")
		check(String(constants.get(i, "")).ends_with("_" + option), "%s: option %d is '%s', but the constant %s" % [what, i, options[i],
				constants.get(i, "(missing)")])
