# SPDX-License-Identifier: MIT
@tool
extends GridContainer
## Thumbnails of the kinds of ropes. A click makes the selected ropes one of them, in one step of undo.

const RopeKinds := preload("../../materials/rope_kinds.gd")
const Thumbnail := preload("rope_thumbnail.gd")
const Words := preload("../logic/words.gd")

const COLUMNS := 2

var thumbnails: Array[Thumbnail] = []

var _canvas: RefCounted # BodyCanvas
var _ropes: Array[SoftBody2D] = []


func set_up(canvas: RefCounted, ropes: Array[SoftBody2D]) -> void:
	_canvas = canvas
	_ropes = ropes
	name = "SoftRopeKinds"
	columns = COLUMNS
	for kind in RopeKinds.all():
		var thumbnail := Thumbnail.new()
		thumbnail.set_up_kind(kind)
		thumbnail.pressed.connect(pick.bind(kind))
		thumbnails.append(thumbnail)
		add_child(thumbnail)


## The kind itself is not stored, so that its values are what is set and undone.
func pick(kind: RopeKinds.Kind) -> void:
	if _canvas == null:
		return
	var values := kind.values()
	var changes: Array[Dictionary] = []
	for rope in _ropes:
		if not is_instance_valid(rope):
			continue
		var lock: String = _canvas.lock_problem(rope)
		if lock != "":
			_canvas.warn(lock)
			return
		for property: StringName in values:
			if rope.get(property) != values[property]:
				changes.append({"object": rope, "property": property, "before": rope.get(property), "after": values[property]})
	_canvas.commit(Words.say("Set Kind to %s") % kind.title, {}, {}, changes)
	for rope in _ropes:
		if is_instance_valid(rope):
			rope.notify_property_list_changed()
