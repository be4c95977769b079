# SPDX-License-Identifier: MIT
@tool
extends Node
## What the menu Convert does: nodes become soft bodies, soft bodies become Polygon2D nodes, and polygons become skins that bend
## with a body, in one step of undo.

const Bake := preload("../logic/bake.gd")
const BodyCanvas := preload("../canvas/body_canvas.gd")
const Conversion := preload("../logic/conversion.gd")
const NodeSwap := preload("node_swap.gd")
const SkinValues := preload("../logic/skin_values.gd")
const SpriteOutline := preload("../logic/sprite_outline.gd")
const TextureTrace := preload("../logic/texture_trace.gd")
const TraceJob := preload("trace_job.gd")
const Words := preload("../logic/words.gd")

## Nodes are about to be replaced: whatever works with them must end.
signal starting

## How a Sprite2D is traced: what the dialog of Shape > From Sprite2D proposes.
const TRACE_POINTS := 32
const TRACE_THRESHOLD := 0.5

var canvas: BodyCanvas
## Returns where a body's points are in the live preview, in global coordinates; empty while none plays.
var preview_outline: Callable
## The tracing that is under way, if any.
var job: TraceJob


func _init() -> void:
	name = "SoftBody2DConvertCommands"


## Of the selection what can become a body. What lies below another such node is left to it.
static func convertible() -> Array[Node2D]:
	return _topmost(func(node: Node) -> bool: return Conversion.can_convert(node))


static func bodies() -> Array[Node2D]:
	return _topmost(func(node: Node) -> bool: return node is SoftBody2D)


## Of the selection, the polygons that lie below a body.
static func polygons_on_bodies() -> Array[Node2D]:
	return _topmost(SkinValues.can_follow)


static func _topmost(wanted: Callable) -> Array[Node2D]:
	var found: Array[Node2D] = []
	var selected := EditorInterface.get_selection().get_selected_nodes().filter(wanted)
	for node: Node in selected:
		if not selected.any(func(other: Node) -> bool: return other.is_ancestor_of(node)):
			found.append(node)
	return found


## Does it to all selected nodes, or to none if one of them cannot be converted.
func convert_selected() -> void:
	var nodes := convertible()
	if is_instance_valid(job):
		canvas.warn(Words.say("A picture is being traced already."))
		return
	for node in nodes:
		if not _may_replace(node):
			return
	var notes := PackedStringArray()
	var conversions: Array[Conversion] = []
	for node in nodes:
		var outline := PackedVector2Array()
		var holes: Array[PackedVector2Array] = []
		if node is Sprite2D and node.texture != null:
			var trace: TextureTrace = await _trace(node)
			if not nodes.all(func(each: Variant) -> bool: return is_instance_valid(each) and each.is_inside_tree()):
				return
			if trace.problem != "":
				canvas.warn("%s: %s" % [node.name, trace.problem])
				return
			if trace.note != "":
				notes.append(trace.note)
			outline = trace.outline
			holes = trace.holes
		var made: Conversion = Conversion.of(node, outline, holes)
		if made.problem != "":
			canvas.warn(made.problem)
			return
		notes.append_array(made.notes)
		conversions.append(made)
	var swaps: Array[NodeSwap] = []
	for i in nodes.size():
		swaps.append(NodeSwap.of(nodes[i], SoftBody2D.new(), conversions[i].values, conversions[i].used))
	_commit(Words.say("Convert to SoftBody2D"), swaps, notes)


## `as_it_is_now`: with dents, or as the live preview shows it; otherwise by the polygon that was designed.
func bake_selected(as_it_is_now: bool) -> void:
	var swaps: Array[NodeSwap] = []
	var notes := PackedStringArray()
	var nodes := bodies()
	for node in nodes:
		if not _may_replace(node):
			return
	for node in nodes:
		var body := node as SoftBody2D
		var outline := body.polygon
		if as_it_is_now:
			outline = Bake.present_outline(body)
			var shown: PackedVector2Array = preview_outline.call(body)
			if shown.size() == body.polygon.size():
				outline = body.get_global_transform().affine_inverse() * shown
		if not body.holes.is_empty():
			notes.append(Words.say("'%s' had holes, which a Polygon2D has not.") % body.name)
		if body.outline_width > 0:
			notes.append(Words.say("'%s' had an outline, which a Polygon2D has not.") % body.name)
		swaps.append(NodeSwap.of(body, Polygon2D.new(), Bake.values_of(body, outline)))
	_commit(Words.say("Bake to Polygon2D"), swaps, notes)


## Polygons below bodies become skins of these, where they lie.
func make_skins() -> void:
	var swaps: Array[NodeSwap] = []
	var notes := PackedStringArray()
	var nodes := polygons_on_bodies()
	for node in nodes:
		if not _may_replace(node):
			return
	for node in nodes:
		if not (node as Polygon2D).skeleton.is_empty():
			notes.append(Words.say("'%s' no longer follows its skeleton.") % node.name)
		swaps.append(NodeSwap.of(node, SoftBodySkin2D.new(), SkinValues.of_polygon(node)))
	_commit(Words.say("Convert to SoftBodySkin2D"), swaps, notes)


## Each body gets a skin that looks as it does, and is itself not seen any more.
func add_skins() -> void:
	var root := EditorInterface.get_edited_scene_root()
	var nodes := bodies()
	for node in nodes:
		var problem := canvas.lock_problem(node)
		if problem == "" and node != root and node.owner != root:
			problem = Words.say("'%s' is not stored in this scene: nothing was converted.") % node.name
		if problem != "":
			canvas.warn(problem)
			return
	if nodes.is_empty():
		return
	starting.emit()
	var undo := canvas.plugin.get_undo_redo()
	undo.create_action(Words.say("Add Skin"), UndoRedo.MERGE_DISABLE, root)
	for node in nodes:
		var body := node as SoftBody2D
		var values := SkinValues.of_body(body)
		var skin := SoftBodySkin2D.new()
		skin.name = "Skin"
		for property: StringName in values:
			skin.set(property, values[property])
		undo.add_do_method(body, &"add_child", skin, true)
		undo.add_do_method(skin, &"set_owner", root)
		undo.add_do_reference(skin)
		undo.add_do_property(body, &"self_modulate", Color(body.self_modulate, 0))
		undo.add_undo_property(body, &"self_modulate", body.self_modulate)
		undo.add_undo_method(body, &"remove_child", skin)
	undo.commit_action()
	canvas.tell(Words.say("Skins were added. The bodies are not seen themselves any more: their Self Modulate is transparent."))


func _trace(sprite: Sprite2D) -> TextureTrace:
	job = TraceJob.new()
	add_child(job)
	job.start(SpriteOutline.picture_of(sprite), TRACE_POINTS, TRACE_THRESHOLD, 0.0)
	var trace: TextureTrace = await job.done
	job = null
	return trace


# False, with a message, where the node must stay what it is.
func _may_replace(node: Node2D) -> bool:
	var root := EditorInterface.get_edited_scene_root()
	var problem := canvas.lock_problem(node)
	var origin := canvas.origin_of(node)
	if problem == "" and origin != "":
		problem = Words.say("'%s' comes from %s: open that scene and convert it there, or make it local.") % [node.name,
				origin.get_file()]
	elif problem == "" and node != root and node.owner != root:
		problem = Words.say("'%s' is not stored in this scene: nothing was converted.") % node.name
	elif problem == "" and node == root and NodeSwap.editor_node() == null:
		problem = Words.say("'%s' is the scene's root, which this version of the editor lets no plugin replace. Reparent it to a new node, convert it, and make it the scene's root again.") % node.name
	if problem != "":
		canvas.warn(problem)
	return problem == ""


func _commit(action: String, swaps: Array[NodeSwap], notes: PackedStringArray) -> void:
	if swaps.is_empty():
		return
	starting.emit()
	var undo := canvas.plugin.get_undo_redo()
	var selection := EditorInterface.get_selection()
	undo.create_action(action, UndoRedo.MERGE_DISABLE, EditorInterface.get_edited_scene_root())
	undo.add_do_method(selection, &"clear")
	undo.add_undo_method(selection, &"clear")
	for swap in swaps:
		swap.add_do(undo)
		undo.add_do_method(selection, &"add_node", swap.made)
		if swap.old.get_script() != swap.made.get_script():
			notes.append(Words.say("The script of '%s' stays behind: it extends another class.") % swap.old.name)
		if not swap.lost.is_empty():
			notes.append(Words.say("Connections of '%s' that are gone: %s.") % [swap.old.name, ", ".join(swap.lost)])
	for i in range(swaps.size() - 1, -1, -1):
		swaps[i].add_undo(undo)
		undo.add_undo_method(selection, &"add_node", swaps[i].old)
	undo.commit_action()
	if notes.is_empty():
		var names := swaps.map(func(swap: NodeSwap) -> String: return swap.made.name)
		canvas.tell("%s: %s." % [action, ", ".join(names)])
	else:
		canvas.warn(" ".join(notes))
