# SPDX-License-Identifier: MIT
@tool
extends GridContainer
## Thumbnails of the addon's materials. A click gives one to the selected bodies, in one step of undo.

const Presets := preload("../../materials/presets.gd")
const Thumbnail := preload("material_thumbnail.gd")
const Words := preload("../logic/words.gd")

const COLUMNS := 3

var thumbnails: Array[Thumbnail] = []

var _canvas: RefCounted # BodyCanvas
var _bodies: Array[SoftBody2D] = []


func set_up(canvas: RefCounted, bodies: Array[SoftBody2D]) -> void:
	_canvas = canvas
	_bodies = bodies
	name = "SoftBodyMaterials"
	columns = COLUMNS
	for preset in Presets.all():
		var thumbnail := Thumbnail.new()
		thumbnail.set_up(preset)
		thumbnail.pressed.connect(pick.bind(preset))
		thumbnails.append(thumbnail)
		add_child(thumbnail)


## A physics material of the node would count instead of the friction and bounce of the picked one, so it goes.
func pick(preset: Presets.Preset) -> void:
	if _canvas == null:
		return
	var material := preset.load_material()
	var changes: Array[Dictionary] = []
	for body in _bodies:
		if not is_instance_valid(body):
			continue
		var lock: String = _canvas.lock_problem(body)
		if lock != "":
			_canvas.warn(lock)
			return
		for change: Array in [[&"soft_body_material", material], [&"physics_material_override", null]]:
			if body.get(change[0]) != change[1]:
				changes.append({"object": body, "property": change[0], "before": body.get(change[0]), "after": change[1]})
	_canvas.commit(Words.say("Set Material to %s") % preset.title, {}, {}, changes)
