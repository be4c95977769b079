# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The outline of all collision shapes of a body together, in the body's coordinates.

const Outline := preload("outline.gd")
const PolygonEdit := preload("polygon_edit.gd")
const Words := preload("words.gd")

## Points of a round shape, and about as many of a rectangle.
const POINTS := 24
## Area of a hole that is kept, as a share of that of the outline.
const LEAST_HOLE := 0.001

var problem := ""
var outline := PackedVector2Array()
## What the shapes leave open between them.
var holes: Array[PackedVector2Array] = []
## The nodes with these shapes. Disabled ones do not count.
var used: Array[Node] = []


static func of(body: CollisionObject2D) -> RefCounted:
	var made: RefCounted = new()
	made._gather(body)
	return made


## Empty for a shape without an area.
static func of_shape(shape: Shape2D) -> PackedVector2Array:
	if shape is CircleShape2D:
		return SoftBody2D.make_circle_polygon(shape.radius, POINTS)
	if shape is RectangleShape2D:
		return SoftBody2D.make_box_polygon(shape.size, 2 * (shape.size.x + shape.size.y) / POINTS)
	if shape is CapsuleShape2D:
		if shape.height <= 2 * shape.radius:
			return SoftBody2D.make_circle_polygon(shape.radius, POINTS)
		return SoftBody2D.make_capsule_polygon(shape.radius, shape.height,
				(2 * (shape.height - 2 * shape.radius) + TAU * shape.radius) / POINTS)
	if shape is ConvexPolygonShape2D:
		return Outline.without_repeats(shape.points)
	return PackedVector2Array()


func _gather(body: CollisionObject2D) -> void:
	var parts: Array[PackedVector2Array] = []
	for child in body.get_children():
		if not (child is CollisionShape2D or child is CollisionPolygon2D) or child.disabled:
			continue
		var part := PackedVector2Array()
		if child is CollisionPolygon2D:
			part = Outline.without_repeats(child.polygon)
		elif child.shape != null:
			part = of_shape(child.shape)
		if part.size() < 3:
			problem = Words.say("'%s' has no area that a body could fill: give it a circle, rectangle, capsule or polygon, or remove it, then convert '%s'.") % [
					child.name, body.name]
			return
		part = child.transform * part
		var wrong := SoftBody2D.get_polygon_problem(part)
		if wrong != "":
			problem = Words.say("'%s' has an outline that no body can have: %s. Move its points apart, then convert '%s'.") % [
					child.name, PolygonEdit.readable(wrong), body.name]
			return
		parts.append(part)
		used.append(child)
	if parts.is_empty():
		problem = Words.say("'%s' has no shape: add a CollisionShape2D or CollisionPolygon2D, then convert it.") % body.name
		return
	_join(parts, body)


func _join(parts: Array[PackedVector2Array], body: Node) -> void:
	var all := parts.duplicate()
	outline = parts.pop_front()
	while not parts.is_empty():
		var joined := -1
		for i in parts.size():
			var merged := Geometry2D.merge_polygons(outline, parts[i])
			# Holes are clockwise.
			var outer := merged.filter(func(each: PackedVector2Array) -> bool: return not Geometry2D.is_polygon_clockwise(each))
			if outer.size() != 1:
				continue
			for each in merged:
				if Geometry2D.is_polygon_clockwise(each):
					holes.append(each)
			outline = Outline.without_repeats(outer[0])
			joined = i
			break
		if joined < 0:
			problem = Words.say("The shapes of '%s' do not touch; a body has one outline. Move them together, or make a body of each, then convert it.") % body.name
			return
		parts.remove_at(joined)
	for part in all: # one that was joined later may fill them
		var left: Array[PackedVector2Array] = []
		for hole in holes:
			left.append_array(Geometry2D.clip_polygons(hole, part))
		holes = left
	var open: Array[PackedVector2Array] = []
	for hole in holes:
		hole = Outline.without_repeats(hole)
		if not Geometry2D.is_polygon_clockwise(hole) and absf(PolygonEdit.signed_area(hole)) > LEAST_HOLE * absf(PolygonEdit.signed_area(outline)):
			open.append(hole)
	holes = open
