# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Edits of springs: which lie under the mouse, factors on some of them, springs added and taken out.

const BodyValues := preload("body_values.gd")

enum Kind { POLYGON, INNER }


static func kind(a: int, b: int, polygon_count: int) -> Kind:
	var apart := absi(a - b)
	return Kind.POLYGON if a < polygon_count and b < polygon_count and (apart == 1 or apart == polygon_count - 1) else Kind.INNER


static func of_kind(springs: PackedInt32Array, polygon_count: int, wanted: Kind) -> PackedInt32Array:
	var found := PackedInt32Array()
	for i in springs.size() / 2:
		if kind(springs[2 * i], springs[2 * i + 1], polygon_count) == wanted:
			found.append(i)
	return found


## The spring nearest to `place`, or -1 if none is within `radius`.
static func nearest(points: PackedVector2Array, springs: PackedInt32Array, place: Vector2, radius: float) -> int:
	var found := -1
	var least := radius * radius
	for i in springs.size() / 2:
		var on_spring := Geometry2D.get_closest_point_to_segment(place, points[springs[2 * i]], points[springs[2 * i + 1]])
		var distance := on_spring.distance_squared_to(place)
		if distance <= least:
			least = distance
			found = i
	return found


## Springs with both ends in the box.
static func in_box(points: PackedVector2Array, springs: PackedInt32Array, box: Rect2) -> PackedInt32Array:
	var found := PackedInt32Array()
	for i in springs.size() / 2:
		if box.has_point(points[springs[2 * i]]) and box.has_point(points[springs[2 * i + 1]]):
			found.append(i)
	return found


## The factors of a property, one a spring: filled with 1 where none have been set, or where they do not fit.
static func scales(values: Dictionary, property: StringName, count: int) -> PackedFloat32Array:
	var result: PackedFloat32Array = values[property].duplicate()
	if result.size() != count:
		result.resize(count)
		result.fill(1)
	return result


static func with_scale(values: Dictionary, property: StringName, chosen: PackedInt32Array, scale: float) -> Dictionary:
	var factors := scales(values, property, BodyValues.springs(values).size() / 2)
	for index in chosen:
		factors[index] = scale
	return with_scales(values, property, factors)


static func with_scales(values: Dictionary, property: StringName, factors: PackedFloat32Array) -> Dictionary:
	var after := BodyValues.copy(values)
	after[property] = factors
	return after


## One that is there already, or that joins a point with itself, changes nothing.
static func with_spring(values: Dictionary, a: int, b: int) -> Dictionary:
	var springs := BodyValues.springs(values).duplicate()
	if a == b or find(springs, a, b) >= 0:
		return values
	var after := BodyValues.copy(values)
	for property in BodyValues.SCALES:
		if values[property].size() == springs.size() / 2:
			var factors: PackedFloat32Array = values[property].duplicate()
			factors.append(1)
			after[property] = factors
	springs.append_array([a, b])
	after[&"springs"] = springs
	return after


## The last spring cannot be taken out: a body without any would be given the automatic ones.
static func without_springs(values: Dictionary, chosen: PackedInt32Array) -> Dictionary:
	var springs := BodyValues.springs(values)
	var kept := PackedInt32Array()
	for i in springs.size() / 2:
		if not i in chosen:
			kept.append(i)
	if kept.is_empty() or kept.size() == springs.size() / 2:
		return values
	var after := BodyValues.copy(values)
	var left := PackedInt32Array()
	for index in kept:
		left.append_array([springs[2 * index], springs[2 * index + 1]])
	after[&"springs"] = left
	for property in BodyValues.SCALES:
		if values[property].size() == springs.size() / 2:
			var factors := PackedFloat32Array()
			for index in kept:
				factors.append(values[property][index])
			after[property] = factors
	return after


static func with_inner_point(values: Dictionary, place: Vector2) -> Dictionary:
	var after := BodyValues.copy(values)
	var inner: PackedVector2Array = values[&"inner_points"].duplicate()
	inner.append(place)
	after[&"inner_points"] = inner
	# The center point comes last: what names it names the next place now.
	var center: int = BodyValues.hull(values).size() + inner.size() - 1
	if values[&"center_point"]:
		after[&"springs"] = _renamed(values[&"springs"], center, center + 1)
		after[&"pinned_points"] = _renamed(values[&"pinned_points"], center, center + 1)
	if values[&"springs"].is_empty():
		_clear_scales(after) # the automatic springs are others now
	else:
		for i in 3: # held on to the three points around it
			var best := -1
			var points := BodyValues.points(after)
			for other in points.size():
				if other != center and find(after[&"springs"], center, other) < 0 \
						and (best < 0 or points[other].distance_to(place) < points[best].distance_to(place)):
					best = other
			if best >= 0:
				after = with_spring(after, center, best)
	return after


static func without_inner_point(values: Dictionary, index: int) -> Dictionary:
	var point: int = BodyValues.hull(values).size() + index
	var springs := BodyValues.springs(values)
	var gone := PackedInt32Array()
	for i in springs.size() / 2:
		if springs[2 * i] == point or springs[2 * i + 1] == point:
			gone.append(i)
	var after := BodyValues.copy(values)
	if values[&"springs"].is_empty():
		_clear_scales(after)
	else:
		after = without_springs(values, gone)
	var inner: PackedVector2Array = values[&"inner_points"].duplicate()
	inner.remove_at(index)
	after = BodyValues.copy(after)
	after[&"inner_points"] = inner
	for property: StringName in [&"springs", &"pinned_points"]:
		var indices: PackedInt32Array = after[property].duplicate()
		var targets: Array = after[&"pin_targets"]
		if property == &"pinned_points":
			var place := indices.find(point)
			if place >= 0:
				indices.remove_at(place)
				if place < targets.size():
					targets.remove_at(place)
		for i in indices.size():
			if indices[i] > point:
				indices[i] -= 1
		after[property] = indices
	return after


static func find(springs: PackedInt32Array, a: int, b: int) -> int:
	for i in springs.size() / 2:
		if (springs[2 * i] == a and springs[2 * i + 1] == b) or (springs[2 * i] == b and springs[2 * i + 1] == a):
			return i
	return -1


static func _clear_scales(values: Dictionary) -> void:
	for property in BodyValues.SCALES:
		values[property] = PackedFloat32Array()


static func _renamed(indices: PackedInt32Array, from: int, to: int) -> PackedInt32Array:
	var result := indices.duplicate()
	for i in result.size():
		if result[i] == from:
			result[i] = to
	return result
