# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Ready-made insides: what a polygon is filled with.

const BodyValues := preload("body_values.gd")
const PolygonEdit := preload("polygon_edit.gd")
const Outline := preload("outline.gd")

enum Preset { NONE, CENTER_POINT, CROSS_BRACED, LATTICE }

const MOST_LATTICE_POINTS := 400


## The values of a body with that inside. Factors and pins that spoke of other points and springs are gone; pins of the
## polygon stay.
static func with_preset(values: Dictionary, preset: Preset) -> Dictionary:
	var after := BodyValues.copy(values)
	after[&"inner_points"] = PackedVector2Array()
	after[&"springs"] = PackedInt32Array()
	after[&"center_point"] = preset == Preset.CENTER_POINT
	for scales in BodyValues.SCALES:
		after[scales] = PackedFloat32Array()
	var polygon: PackedVector2Array = values[&"polygon"]
	match preset:
		Preset.NONE:
			after[&"springs"] = _ring(polygon.size())
		Preset.CROSS_BRACED:
			after[&"springs"] = _braces(polygon)
		Preset.LATTICE:
			after[&"inner_points"] = _lattice(polygon)
	var pins := PackedInt32Array()
	var targets: Array[NodePath] = []
	for i in values[&"pinned_points"].size():
		if values[&"pinned_points"][i] < polygon.size():
			pins.append(values[&"pinned_points"][i])
			targets.append(values[&"pin_targets"][i] if i < values[&"pin_targets"].size() else NodePath())
	after[&"pinned_points"] = pins
	after[&"pin_targets"] = targets
	return after


static func _ring(count: int) -> PackedInt32Array:
	var springs := PackedInt32Array()
	for i in count:
		springs.append_array([i, (i + 1) % count])
	return springs


## The ring, each point with the next but one, and with the one across, as far as they see each other.
static func _braces(polygon: PackedVector2Array) -> PackedInt32Array:
	var count := polygon.size()
	var springs := _ring(count)
	var joined := {}
	for i in count:
		joined[Vector2i(mini(i, (i + 1) % count), maxi(i, (i + 1) % count))] = true
	for step: int in [2, count / 3, count / 2]:
		for i in count:
			var other := (i + step) % count
			var pair := Vector2i(mini(i, other), maxi(i, other))
			if step >= 2 and i != other and not joined.has(pair) and sees(polygon, i, other):
				joined[pair] = true
				springs.append_array([i, other])
	return springs


## Whether the line from one point of the outline to another stays inside.
static func sees(polygon: PackedVector2Array, a: int, b: int) -> bool:
	var count := polygon.size()
	if not Geometry2D.is_point_in_polygon((polygon[a] + polygon[b]) / 2, polygon):
		return false
	for i in count:
		var next := (i + 1) % count
		if i in [a, b] or next in [a, b]:
			continue
		if Geometry2D.segment_intersects_segment(polygon[a], polygon[b], polygon[i], polygon[next]) != null:
			return false
	return true


## Points on a grid about as fine as the outline, not too near to it.
static func _lattice(polygon: PackedVector2Array) -> PackedVector2Array:
	var box := PolygonEdit.bounds(polygon)
	var area := absf(PolygonEdit.signed_area(polygon))
	var spacing := maxf(Outline.perimeter(polygon) / polygon.size(), sqrt(area / MOST_LATTICE_POINTS))
	var inner: Array[PackedVector2Array] = Geometry2D.offset_polygon(polygon, -0.6 * spacing)
	var points := PackedVector2Array()
	var middle := box.get_center()
	var reach := Vector2i((box.size / 2 / spacing).ceil())
	for row in range(-reach.y, reach.y + 1):
		for column in range(-reach.x, reach.x + 1):
			var place := middle + Vector2(column, row) * spacing
			for part in inner:
				if Geometry2D.is_point_in_polygon(place, part):
					points.append(place)
					break
	return points
