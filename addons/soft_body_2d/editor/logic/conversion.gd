# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The values of a SoftBody2D that takes the place of a Sprite2D, Polygon2D, CollisionPolygon2D or RigidBody2D.

const NewBody := preload("new_body.gd")
const Outline := preload("outline.gd")
const PolygonEdit := preload("polygon_edit.gd")
const ShapeOutlines := preload("shape_outlines.gd")
const SpriteOutline := preload("sprite_outline.gd")
const VisualValues := preload("visual_values.gd")
const Words := preload("words.gd")

## Properties that RigidBody2D and SoftBody2D have under one name, with one meaning.
const SHARED_WITH_RIGID_BODY: Array[StringName] = [&"collision_layer", &"collision_mask", &"gravity_scale",
		&"physics_material_override", &"linear_damp_mode", &"linear_damp", &"angular_damp_mode", &"angular_damp",
		&"linear_velocity", &"angular_velocity", &"constant_force", &"constant_torque", &"lock_rotation", &"freeze",
		&"can_sleep", &"sleeping", &"contact_monitor", &"input_pickable", &"disable_mode"]
## With fewer points than this a note recommends to resample.
const FEW_POINTS := 8
## Of the outline of a frame, about.
const FRAME_POINTS := 24

## Why the node cannot be converted, and what to do; empty when it can. The values are of no use then.
var problem := ""
## By property, in the order in which they are set.
var values := {}
## Children of the node that the body stands for: they go.
var used: Array[Node] = []
## What the node had and a body has not.
var notes := PackedStringArray()


static func can_convert(node: Object) -> bool:
	return node is Sprite2D or node is Polygon2D or node is CollisionPolygon2D or (node is RigidBody2D
			and not node is PhysicalBone2D)


## `traced` is the outline of a Sprite2D's picture, in pixels of what it shows, and `traced_holes` are its holes; other nodes need none.
static func of(node: Node2D, traced := PackedVector2Array(), traced_holes: Array[PackedVector2Array] = []) -> RefCounted:
	var made: RefCounted = new()
	made.values = node_values(node)
	if node is Sprite2D:
		made._take_sprite(node, traced, traced_holes)
	elif node is Polygon2D:
		made._take_polygon(node)
	elif node is CollisionPolygon2D:
		made._take_collision_polygon(node)
	elif node is RigidBody2D:
		made._take_rigid_body(node)
	else:
		made.problem = Words.say("'%s' is no Sprite2D, Polygon2D, CollisionPolygon2D or RigidBody2D.") % node.name
	if made.problem == "":
		NewBody.add_detail(made.values, false)
	if made.problem == "" and made.values[&"polygon"].size() < FEW_POINTS:
		made.notes.append(Words.say("'%s' has %d points; Shape > Resample gives it more to bend with.") % [node.name,
				made.values[&"polygon"].size()])
	return made


## What every Node2D stores: transform, visibility, z index, modulate, material, process mode and so on.
static func node_values(node: Node2D) -> Dictionary:
	var common := {}
	for property in ClassDB.class_get_property_list(&"Node2D"):
		if property["usage"] & PROPERTY_USAGE_STORAGE and property["name"] != "script":
			common[StringName(property["name"])] = node.get(property["name"])
	return common


## Points by index without neighbors that coincide or nearly do.
static func distinct(points: PackedVector2Array, least := 0.01) -> PackedInt32Array:
	var kept := PackedInt32Array()
	for i in points.size():
		if kept.is_empty() or points[kept[-1]].distance_to(points[i]) > least:
			kept.append(i)
	while kept.size() > 1 and points[kept[0]].distance_to(points[kept[-1]]) <= least:
		kept.remove_at(kept.size() - 1)
	return kept


# Whether `outline` can be a body's polygon; says why if not.
func _accept(node: Node, outline: PackedVector2Array) -> bool:
	if outline.size() < 3:
		problem = Words.say("'%s' has no outline: draw at least 3 points, then convert it.") % node.name
		return false
	var wrong := SoftBody2D.get_polygon_problem(outline)
	if wrong != "":
		problem = Words.say("'%s' has an outline that no body can have: %s. Move its points apart, then convert it.") % [
				node.name, PolygonEdit.readable(wrong)]
		return false
	values[&"polygon"] = outline
	return true


func _take_sprite(sprite: Sprite2D, traced: PackedVector2Array, traced_holes: Array[PackedVector2Array]) -> void:
	if sprite.texture == null:
		problem = Words.say("'%s' has no texture: give it one, then convert it.") % sprite.name
	elif _accept(sprite, SpriteOutline.to_local(sprite, traced)):
		values[&"texture"] = sprite.texture
		values[&"uv"] = SpriteOutline.to_texture(sprite, traced)
		var holes: Array[PackedVector2Array] = []
		for hole in traced_holes:
			holes.append(SpriteOutline.to_local(sprite, hole))
		_take_holes(sprite, holes)


# Holes that the body can have besides the others; a note names those that it cannot have.
func _take_holes(node: Node, holes: Array[PackedVector2Array]) -> void:
	var taken: Array[PackedVector2Array] = []
	for hole in holes:
		var with_it := taken.duplicate()
		with_it.append(hole)
		if SoftBody2D.get_holes_problem(with_it, values[&"polygon"]) == "":
			taken = with_it
	if taken.size() < holes.size():
		notes.append(Words.say("'%s' has %d holes that touch its outline or each other, and are filled.") % [node.name, holes.size() - taken.size()])
	if not taken.is_empty():
		values[&"holes"] = taken


func _take_polygon(source: Polygon2D) -> void:
	if source.polygons.size() > 1:
		problem = Words.say("'%s' is made of %d polygons; a body has one outline. Clear them in the UV editor, or make a node of each, then convert it.") % [
				source.name, source.polygons.size()]
		return
	# Vertices inside, for skeletons, come last.
	var order := PackedInt32Array(range(maxi(0, source.polygon.size() - source.internal_vertex_count)))
	if source.polygons.size() == 1:
		order = PackedInt32Array(source.polygons[0])
	var outline := PackedVector2Array()
	for i in order:
		if i < 0 or i >= source.polygon.size():
			problem = Words.say("'%s' has a polygon with a point %d that is not there. Clear its polygons in the UV editor, then convert it.") % [source.name, i]
			return
		outline.append(source.polygon[i] + source.offset)
	var kept := distinct(outline)
	if not _accept(source, _picked(outline, kept)):
		return
	if source.invert_enabled:
		_take_frame(source)
		return
	values[&"look"] = SoftBody2D.LOOK_PLAIN # as it was
	values[&"antialiased"] = source.antialiased
	values[&"color"] = source.color
	if source.texture != null:
		values[&"texture"] = source.texture
		values[&"texture_offset"] = source.texture_offset
		values[&"texture_scale"] = source.texture_scale
		values[&"texture_rotation"] = source.texture_rotation
		# Without coordinates of its own a Polygon2D shows one pixel of the texture a pixel.
		values[&"uv"] = values[&"polygon"]
		if source.uv.size() == source.polygon.size():
			values[&"uv"] = _picked(_picked(source.uv, order), kept)
	if source.vertex_colors.size() == source.polygon.size():
		# They take the place of a Polygon2D's color, and multiply that of a body.
		var colors := PackedColorArray()
		for i in kept:
			colors.append(source.vertex_colors[order[i]])
		values[&"vertex_colors"] = colors
		values[&"color"] = Color.WHITE
	if not source.skeleton.is_empty():
		notes.append(Words.say("'%s' no longer follows its skeleton.") % source.name)


# An inverted Polygon2D fills the box around its polygon, and its border, but for the polygon.
func _take_frame(source: Polygon2D) -> void:
	var hole: PackedVector2Array = values[&"polygon"]
	var box := PolygonEdit.bounds(hole).grow(source.invert_border)
	var frame := SoftBody2D.make_box_polygon(box.size, 2 * (box.size.x + box.size.y) / FRAME_POINTS)
	values[&"polygon"] = Transform2D(0, box.get_center()) * frame
	var problem_of_hole := SoftBody2D.get_holes_problem([hole] as Array[PackedVector2Array], values[&"polygon"])
	if problem_of_hole != "":
		problem = Words.say("'%s' is inverted, and its border is too thin for a body: %s. Give it a wider Invert > Border, then convert it.") % [source.name, problem_of_hole]
		return
	values[&"holes"] = [hole] as Array[PackedVector2Array]
	values[&"look"] = SoftBody2D.LOOK_PLAIN
	values[&"antialiased"] = source.antialiased
	values[&"color"] = source.color
	if source.texture != null:
		values[&"texture"] = source.texture
		values[&"texture_offset"] = source.texture_offset
		values[&"texture_scale"] = source.texture_scale
		values[&"texture_rotation"] = source.texture_rotation
		values[&"uv"] = values[&"polygon"]
	if source.vertex_colors.size() == source.polygon.size() and not source.vertex_colors.is_empty():
		notes.append(Words.say("The vertex colors of '%s' are left out, as they are those of its hole.") % source.name)


static func _picked(points: PackedVector2Array, indices: PackedInt32Array) -> PackedVector2Array:
	var result := PackedVector2Array()
	for i in indices:
		result.append(points[i])
	return result


func _take_collision_polygon(source: CollisionPolygon2D) -> void:
	if _accept(source, Outline.without_repeats(source.polygon)):
		# Its layers are those of the body that it belongs to.
		var object := source.get_parent() as CollisionObject2D
		if object != null:
			values[&"collision_layer"] = object.collision_layer
			values[&"collision_mask"] = object.collision_mask


func _take_rigid_body(source: RigidBody2D) -> void:
	var shapes := ShapeOutlines.of(source)
	if shapes.problem != "":
		problem = shapes.problem
		return
	if not _accept(source, shapes.outline):
		return
	_take_holes(source, shapes.holes)
	for property in SHARED_WITH_RIGID_BODY:
		values[property] = source.get(property)
	values[&"mass_mode"] = SoftBody2D.MASS_MODE_CUSTOM
	values[&"mass"] = source.mass
	if source.max_contacts_reported > 0: # zero is what a RigidBody2D begins with
		values[&"max_contacts_reported"] = source.max_contacts_reported
	for shape: Node in shapes.used:
		_use(shape)
	for child in source.get_children():
		if (child is Sprite2D or child is Polygon2D) and child.get_child_count() == 0:
			var look := VisualValues.of(child, values[&"polygon"])
			if not look.is_empty():
				values.merge(look, true)
				used.append(child)
				break


# A child that has children of its own stays, or they would be lost.
func _use(child: Node) -> void:
	if child.get_child_count() == 0:
		used.append(child)
	else:
		notes.append(Words.say("'%s' stays, as it has children.") % child.name)
