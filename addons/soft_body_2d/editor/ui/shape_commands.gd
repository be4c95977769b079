# SPDX-License-Identifier: MIT
@tool
extends Node
## What the menus Shape and Structure do: asks for what is missing, makes outlines, commits them.

const BodyCanvas := preload("../canvas/body_canvas.gd")
const BodyValues := preload("../logic/body_values.gd")
const NewBody := preload("../logic/new_body.gd")
const PolygonEdit := preload("../logic/polygon_edit.gd")
const Outline := preload("../logic/outline.gd")
const Presets := preload("../logic/structure_presets.gd")
const ShapeDialog := preload("shape_dialog.gd")
const SpriteOutline := preload("../logic/sprite_outline.gd")
const StartShapes := preload("../logic/start_shapes.gd")
const StructureRemap := preload("../logic/structure_remap.gd")
const TextureTrace := preload("../logic/texture_trace.gd")
const TraceJob := preload("trace_job.gd")
const ValueHandles := preload("../canvas/value_handles.gd")
const Words := preload("../logic/words.gd")

const SOURCES := {&"polygon_2d": &"Polygon2D", &"sprite_2d": &"Sprite2D", &"path_2d": &"Path2D"}

var canvas: BodyCanvas
var dialog := ShapeDialog.new()
## The tracing that is under way, if any.
var job: TraceJob

var _source: Node2D


func _ready() -> void:
	name = "SoftBody2DShapeCommands"
	add_child(dialog)
	dialog.accepted.connect(run)


func choose(shape: StringName, title: String) -> void:
	if not canvas.may_edit():
		return
	if ShapeDialog.FIELDS.has(shape):
		if SOURCES.has(shape):
			EditorInterface.popup_node_selector(_on_source_chosen.bind(shape, title), [SOURCES[shape]])
			return
		if shape == &"texture" and canvas.bodies[0].texture == null:
			canvas.warn(Words.say("'%s' has no texture: give it one first.") % canvas.bodies[0].name)
			return
		var defaults := {}
		if shape == &"circle":
			defaults = {"radius": snappedf(ValueHandles.radius_of(canvas.bodies[0].polygon), 0.5),
					"count": canvas.bodies[0].polygon.size()}
		elif shape == &"resample":
			defaults = {"count": canvas.bodies[0].polygon.size()}
		dialog.ask(shape, title, defaults)
	else:
		run(shape, {})


func _on_source_chosen(path: NodePath, shape: StringName, title: String) -> void:
	var root := EditorInterface.get_edited_scene_root()
	if root == null or path == NodePath():
		return
	_source = root.get_node_or_null(path) as Node2D
	if _source != null:
		if ShapeDialog.FIELDS[shape].is_empty():
			run(shape, {})
		else:
			dialog.ask(shape, title)


## Does it to all bodies, in one step of undo. `source` is the node whose outline is taken, if one is.
func run(shape: StringName, values: Dictionary, source: Node2D = _source) -> void:
	_source = null
	if not canvas.may_edit():
		return
	if shape in [&"sprite_2d", &"texture"]:
		_trace(shape, values, source)
		return
	var before := canvas.take_values()
	var after := {}
	var lost := PackedStringArray()
	for body in canvas.bodies:
		var made := _make(shape, values, body, before[body], source)
		if made.is_empty():
			canvas.warn(StartShapes.last_problem)
			return
		after[body] = made
		if not made.has(&"keeps"):
			lost.append_array(StructureRemap.losses(before[body], shape == &"resample"))
		made.erase(&"keeps")
	canvas.commit(Words.say("Change Polygon Shape"), before, after)
	canvas.tell_losses(lost)


# The values that the body gets, or none, with the reason in `last_problem`.
func _make(shape: StringName, values: Dictionary, body: SoftBody2D, before: Dictionary, source: Node2D) -> Dictionary:
	var polygon: PackedVector2Array = before[&"polygon"]
	var outline := PackedVector2Array()
	match shape:
		&"circle":
			outline = StartShapes.circle(values["radius"], int(values["count"]))
		&"rectangle":
			outline = StartShapes.rectangle(Vector2(values["width"], values["height"]), values["spacing"])
		&"capsule":
			outline = StartShapes.capsule(values["radius"], values["height"], values["spacing"])
		&"regular_polygon":
			outline = StartShapes.regular_polygon(values["radius"], int(values["sides"]), int(values["per_side"]))
		&"polygon_2d":
			outline = StartShapes.from_polygon(source as Polygon2D,
					body.get_global_transform().affine_inverse() * source.get_global_transform())
		&"path_2d":
			outline = StartShapes.from_path(source as Path2D,
					body.get_global_transform().affine_inverse() * source.get_global_transform(), int(values["count"]))
		&"resample":
			outline = Outline.resampled(polygon, int(values["count"]))
		&"mirror_horizontally", &"mirror_vertically":
			return _mirrored(before, shape == &"mirror_horizontally")
		&"symmetric_left", &"symmetric_right":
			outline = Outline.symmetric(polygon, true, PolygonEdit.bounds(polygon).get_center(), -1 if shape == &"symmetric_left" else 1)
			if outline.is_empty():
				StartShapes.last_problem = Words.say("This half of the polygon is not in one piece: it cannot be mirrored onto the other.")
	var problem := SoftBody2D.get_polygon_problem(outline)
	if outline.is_empty() or problem != "":
		if not outline.is_empty():
			StartShapes.last_problem = Words.say("This outline cannot be a polygon: %s.") % PolygonEdit.readable(problem)
		return {}
	return StructureRemap.with_other_outline(before, outline, shape == &"resample")


# Every point keeps its index, its springs and its pin.
func _mirrored(before: Dictionary, horizontally: bool) -> Dictionary:
	var middle := PolygonEdit.bounds(before[&"polygon"]).get_center()
	var after := BodyValues.copy(before)
	after[&"polygon"] = Outline.mirrored(before[&"polygon"], horizontally, middle)
	after[&"inner_points"] = Outline.mirrored(before[&"inner_points"], horizontally, middle)
	var holes: Array[PackedVector2Array] = []
	for hole: PackedVector2Array in before[&"holes"]:
		holes.append(Outline.mirrored(hole, horizontally, middle))
	after[&"holes"] = holes
	after[&"keeps"] = true
	return after


# Tracing.

func _trace(shape: StringName, values: Dictionary, source: Node2D) -> void:
	if is_instance_valid(job):
		canvas.warn(Words.say("A picture is being traced already."))
		return
	var body := canvas.bodies[0]
	var sprite := source as Sprite2D
	var texture: Texture2D = sprite.texture if shape == &"sprite_2d" else body.texture
	if texture == null:
		canvas.warn(Words.say("There is no texture to trace."))
		return
	var picture := SpriteOutline.picture_of(sprite) if shape == &"sprite_2d" else texture.get_image()
	job = TraceJob.new()
	add_child(job)
	job.done.connect(_on_traced.bind(body, sprite, texture))
	job.start(picture, int(values["count"]), values["threshold"], values["margin"])


func _on_traced(trace: TextureTrace, body: SoftBody2D, sprite: Sprite2D, texture: Texture2D) -> void:
	job = null
	if trace.problem != "":
		canvas.warn(trace.problem)
		return
	if not is_instance_valid(body) or not body.is_inside_tree() or canvas.lock_problem(body) != "":
		return
	var before := {body: BodyValues.take(body)}
	var outline := trace.outline
	var after := {}
	if sprite != null and is_instance_valid(sprite):
		var to_body := body.get_global_transform().affine_inverse() * sprite.get_global_transform()
		after = StructureRemap.with_other_outline(before[body], to_body * SpriteOutline.to_local(sprite, outline))
		after[&"texture"] = sprite.texture
		after[&"uv"] = SpriteOutline.to_texture(sprite, outline)
	else:
		after = StructureRemap.with_other_outline(before[body], Transform2D(0, -texture.get_size() / 2) * outline)
		after[&"uv"] = outline
	var problem := SoftBody2D.get_polygon_problem(after[&"polygon"])
	if problem != "":
		canvas.warn(Words.say("This outline cannot be a polygon: %s.") % PolygonEdit.readable(problem))
		return
	NewBody.add_detail(after, body.tear_stretch > 0)
	canvas.commit(Words.say("Trace Polygon"), before, {body: after})
	canvas.tell_losses(StructureRemap.losses(before[body]))
	if trace.note != "":
		canvas.warn(trace.note)
	else:
		canvas.tell(Words.say("Traced with %d points.") % outline.size())


# Structure.

func set_preset(preset: Presets.Preset) -> void:
	if not canvas.may_edit():
		return
	var before := canvas.take_values()
	var after := {}
	for body in canvas.bodies:
		after[body] = Presets.with_preset(before[body], preset)
		if preset == Presets.Preset.NONE and body.pressure <= 0 and body.soft_body_material == null and body.shape_matching <= 0:
			canvas.tell(Words.say("An outline without anything inside collapses: give it pressure or shape matching."))
	canvas.commit(Words.say("Set Structure"), before, after)
