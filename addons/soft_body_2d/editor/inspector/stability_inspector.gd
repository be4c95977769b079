# SPDX-License-Identifier: MIT
@tool
extends EditorInspectorPlugin
## Puts the stability panel at the top of a SoftBody2D's properties, and of several that are selected together.

const BodyCanvas := preload("../canvas/body_canvas.gd")
const StabilityPanel := preload("stability_panel.gd")

var canvas: BodyCanvas
## The one that was made last, for tests.
var panel: StabilityPanel


func _can_handle(object: Object) -> bool:
	return object is SoftBody2D or (object != null and object.get_class() == "MultiNodeEdit"
			and not _selected().is_empty())


func _parse_begin(object: Object) -> void:
	var bodies: Array[SoftBody2D] = []
	if object is SoftBody2D:
		bodies.append(object)
	else:
		bodies = _selected()
	panel = StabilityPanel.new()
	panel.set_up(canvas, bodies)
	add_custom_control(panel)


func _selected() -> Array[SoftBody2D]:
	var bodies: Array[SoftBody2D] = []
	for node in EditorInterface.get_selection().get_selected_nodes():
		if node is SoftBody2D:
			bodies.append(node)
	return bodies
