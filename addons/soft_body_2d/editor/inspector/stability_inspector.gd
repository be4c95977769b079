# SPDX-License-Identifier: MIT
@tool
extends EditorInspectorPlugin
## Puts the stability panel at the top of a SoftBody2D's properties, and of several that are selected together.

const BodyCanvas := preload("../canvas/body_canvas.gd")
const EditedBodies := preload("../ui/edited_bodies.gd")
const StabilityPanel := preload("stability_panel.gd")

var canvas: BodyCanvas
## The one that was made last, for tests.
var panel: StabilityPanel


func _can_handle(object: Object) -> bool:
	return EditedBodies.has_any(object)


func _parse_begin(object: Object) -> void:
	panel = StabilityPanel.new()
	panel.set_up(canvas, EditedBodies.of(object))
	add_custom_control(panel)
