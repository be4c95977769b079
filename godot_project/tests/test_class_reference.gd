# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The class reference has a page for every class, and no page is empty. That the pages are true is up to test_class.gd.

const ClassReference := preload("res://tests/support/class_reference.gd")

var _pages := {}


func _read_pages() -> bool:
	_pages = ClassReference.read_all()
	if _pages.is_empty():
		skip("there is no folder doc_classes beside the project")
	return not _pages.is_empty()


func test_every_class_of_the_extension_has_a_page() -> void:
	if not ClassDB.has_method("class_get_api_type"):
		skip("this engine does not tell whose a class is (4.4)")
	if skip_reason != "" or not _read_pages():
		return
	var count := 0
	for class_id in ClassDB.get_class_list():
		if ClassDB.call("class_get_api_type", class_id) == 2: # API_EXTENSION
			count += 1
			check(_pages.has(class_id), "class %s is missing in the class reference" % class_id)
	check_above(count, 2, "number of classes")


func test_no_description_is_empty() -> void:
	if not _read_pages():
		return
	for class_id: String in _pages:
		for part: String in _pages[class_id].own_text:
			check_above(_pages[class_id].own_text[part].length(), 10, "%s: length of its %s" % [class_id, part])
		for kind: String in _pages[class_id].entries:
			for name: String in _pages[class_id].entries[kind]:
				check_above(_pages[class_id].entries[kind][name]["text"].length(), 10,
						"%s: length of the description of %s %s" % [class_id, kind, name])
