# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Which soft bodies the editor means when it edits an object: for several nodes at once it gives one of its own, which says
## nothing of which ones they are.


static func has_any(object: Object) -> bool:
	return _has_polygon(object) or (object != null and object.get_class() == "MultiNodeEdit"
			and not selected().is_empty())


## Empty for null, as the editor has it when it stops editing.
static func of(object: Object) -> Array[SoftBody2D]:
	var bodies: Array[SoftBody2D] = []
	if _has_polygon(object):
		bodies.append(object)
	elif object != null and not object is SoftRope2D:
		bodies = selected()
	return bodies


static func selected() -> Array[SoftBody2D]:
	var bodies: Array[SoftBody2D] = []
	for node in EditorInterface.get_selection().get_selected_nodes():
		if _has_polygon(node):
			bodies.append(node)
	return bodies


## The ropes that are meant, where no other bodies are.
static func ropes_of(object: Object) -> Array[SoftBody2D]:
	var ropes: Array[SoftBody2D] = []
	if object is SoftRope2D:
		ropes.append(object)
	elif object != null and object.get_class() == "MultiNodeEdit":
		ropes = selected_ropes()
	return ropes


static func selected_ropes() -> Array[SoftBody2D]:
	var ropes: Array[SoftBody2D] = []
	for node in EditorInterface.get_selection().get_selected_nodes():
		if node is SoftRope2D:
			ropes.append(node)
	return ropes


## A rope's outline follows from its path.
static func _has_polygon(object: Object) -> bool:
	return object is SoftBody2D and not object is SoftRope2D
