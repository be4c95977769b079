# SPDX-License-Identifier: MIT
@tool
extends EditorInspectorPlugin
## Puts the stability panel and the materials at the top of a SoftBody2D's properties, and of several that are selected together. Ropes get
## their kinds instead.

const BodyCanvas := preload("../canvas/body_canvas.gd")
const EditedBodies := preload("../ui/edited_bodies.gd")
const MaterialPicker := preload("material_picker.gd")
const RopePicker := preload("rope_picker.gd")
const StabilityPanel := preload("stability_panel.gd")

var canvas: BodyCanvas
## Those that were made last, for tests.
var panel: StabilityPanel
var picker: MaterialPicker
var rope_picker: RopePicker


func _can_handle(object: Object) -> bool:
	return EditedBodies.has_any(object) or not EditedBodies.ropes_of(object).is_empty()


func _parse_begin(object: Object) -> void:
	if not EditedBodies.has_any(object):
		return
	panel = StabilityPanel.new()
	panel.set_up(canvas, EditedBodies.of(object))
	add_custom_control(panel)


# Above the material itself, or the kind of a rope.
func _parse_property(object: Object, _type: Variant.Type, name: String, _hint: PropertyHint, _hint_text: String, _usage: int, _wide: bool) -> bool:
	if name == "soft_body_material":
		picker = MaterialPicker.new()
		picker.set_up(canvas, EditedBodies.of(object))
		add_custom_control(picker)
	elif name == "kind" and not EditedBodies.ropes_of(object).is_empty():
		rope_picker = RopePicker.new()
		rope_picker.set_up(canvas, EditedBodies.ropes_of(object))
		add_custom_control(rope_picker)
	return false
