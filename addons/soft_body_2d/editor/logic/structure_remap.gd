# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## What becomes of springs, pins and colors when the points of an outline come and go: each stays with its points.

const BodyValues := preload("body_values.gd")
const NEW := -1


## The values of a body whose polygon becomes `polygon`. `old_points` says for each of its points which one it was, or NEW. New
## springs beside a new point take after those of its neighbors.
static func with_polygon(values: Dictionary, polygon: PackedVector2Array, old_points: PackedInt32Array) -> Dictionary:
	var after := BodyValues.copy(values)
	after[&"polygon"] = polygon.duplicate() # packed arrays are shared, and this one goes into the undo history
	if BodyValues.is_simplified(values) or BodyValues.is_simplified(after):
		if BodyValues.is_simplified(values) or not _has_own_structure(values):
			_remap_skin(values, after, old_points)
			_remap_to_other_hull(values, after)
			return after
		# What was painted on single springs stays with them, as long as every point is simulated.
		after[&"detail_mode"] = SoftBody2D.DETAIL_MODE_AS_DRAWN
	var new_points := _new_points(values, old_points)
	_remap_pins(after, new_points)
	_remap_skin(values, after, old_points)
	if values[&"springs"].is_empty():
		_remap_scales_of_automatic_springs(values, after, new_points, old_points)
	else:
		_remap_springs(values, after, new_points, old_points)
	return after


## The values `after`, of the same polygon or of one with as many points, of a body that had those of `before`: where another number
## of points is simulated now, pins are at the nearest of them.
static func with_other_hull(before: Dictionary, after: Dictionary) -> Dictionary:
	var result := BodyValues.copy(after)
	if BodyValues.hull(before).size() != BodyValues.hull(after).size():
		_remap_to_other_hull(before, result)
	return result


## What of single springs `after` no longer has, for a message.
static func lost_springs(before: Dictionary, after: Dictionary) -> PackedStringArray:
	var lost := PackedStringArray()
	for property: StringName in [&"springs"] + BodyValues.SCALES:
		if not before[property].is_empty() and after[property].is_empty():
			lost.append(property)
	return lost


static func _has_own_structure(values: Dictionary) -> bool:
	return not values[&"springs"].is_empty() or BodyValues.SCALES.any(func(property: StringName) -> bool: return not values[property].is_empty())


# Of a body that simulates fewer points than are drawn, one point more or less may make all others new: pins go to the points
# that are nearest, and what was said of single springs means nothing there.
static func _remap_to_other_hull(values: Dictionary, after: Dictionary) -> void:
	if BodyValues.hull(values) == BodyValues.hull(after):
		return
	var before := BodyValues.points(values)
	var points := BodyValues.points(after)
	var pins := {}
	for i in values[&"pinned_points"].size():
		var point: int = values[&"pinned_points"][i]
		if point < before.size():
			pins[_nearest(points, before[point])] = values[&"pin_targets"][i] if i < values[&"pin_targets"].size() else NodePath()
	_set_pins(after, pins)
	after[&"springs"] = PackedInt32Array()
	for scales in BodyValues.SCALES:
		after[scales] = PackedFloat32Array()


## The values of a body whose points become others altogether: what was said of single points and springs would mean
## nothing there. Pins go to the nearest points if `keeps_pins`.
static func with_other_outline(values: Dictionary, polygon: PackedVector2Array, keeps_pins := false) -> Dictionary:
	var after := BodyValues.copy(values)
	after[&"polygon"] = polygon.duplicate()
	after[&"inner_points"] = PackedVector2Array()
	after[&"springs"] = PackedInt32Array()
	for scales in BodyValues.SCALES:
		after[scales] = PackedFloat32Array()
	after[&"uv"] = PackedVector2Array()
	after[&"vertex_colors"] = PackedColorArray()
	after[&"detail_weights"] = PackedFloat32Array()
	var pins := {}
	if keeps_pins:
		var before := BodyValues.points(values)
		var hull := BodyValues.hull(after)
		for i in values[&"pinned_points"].size():
			var point: int = values[&"pinned_points"][i]
			if point < before.size():
				pins[_nearest(hull, before[point])] = values[&"pin_targets"][i] if i < values[&"pin_targets"].size() else NodePath()
	_set_pins(after, pins)
	return after


## What `with_other_outline` would take away, for a message; empty when nothing.
static func losses(values: Dictionary, keeps_pins := false) -> PackedStringArray:
	var lost := PackedStringArray()
	if not values[&"inner_points"].is_empty():
		lost.append("inner_points")
	if not values[&"springs"].is_empty():
		lost.append("springs")
	for scales in BodyValues.SCALES:
		if not values[scales].is_empty():
			lost.append(scales)
	for property: StringName in [&"vertex_colors", &"detail_weights"]:
		if not values.get(property, []).is_empty():
			lost.append(property)
	if not keeps_pins and not values[&"pinned_points"].is_empty():
		lost.append("pinned_points")
	return lost


## Old index -> new index, of every point that stays.
static func _new_points(values: Dictionary, old_points: PackedInt32Array) -> Dictionary:
	var new_points := {}
	for i in old_points.size():
		if old_points[i] != NEW:
			new_points[old_points[i]] = i
	var shift := old_points.size() - int(values[&"polygon"].size())
	for i in range(values[&"polygon"].size(), BodyValues.point_count(values)):
		new_points[i] = i + shift
	return new_points


static func _remap_pins(after: Dictionary, new_points: Dictionary) -> void:
	var pins := {}
	for i in after[&"pinned_points"].size():
		var point: int = after[&"pinned_points"][i]
		if new_points.has(point):
			pins[new_points[point]] = after[&"pin_targets"][i] if i < after[&"pin_targets"].size() else NodePath()
	_set_pins(after, pins)


static func _set_pins(after: Dictionary, pins: Dictionary) -> void:
	var targets: Array[NodePath] = []
	targets.assign(pins.values())
	after[&"pinned_points"] = PackedInt32Array(pins.keys())
	after[&"pin_targets"] = targets


static func _remap_skin(values: Dictionary, after: Dictionary, old_points: PackedInt32Array) -> void:
	for property: StringName in [&"uv", &"vertex_colors", &"detail_weights"]:
		if not values.has(property) or values[property].size() != values[&"polygon"].size():
			continue # empty, or unused until it fits
		var entries: Variant = values[property].duplicate()
		entries.resize(old_points.size())
		for i in old_points.size():
			if old_points[i] != NEW:
				entries[i] = values[property][old_points[i]]
			else:
				var beside := _old_neighbors(old_points, i)
				var share := _share(values[&"polygon"], beside, after[&"polygon"][i])
				entries[i] = lerp(values[property][beside.x], values[property][beside.y], share)
		after[property] = entries


## The nearest points before and after in the outline that were there before.
static func _old_neighbors(old_points: PackedInt32Array, index: int) -> Vector2i:
	var count := old_points.size()
	var found := Vector2i(0, 0)
	for step in range(1, count):
		if old_points[posmod(index - step, count)] != NEW:
			found.x = old_points[posmod(index - step, count)]
			break
	for step in range(1, count):
		if old_points[(index + step) % count] != NEW:
			found.y = old_points[(index + step) % count]
			break
	return found


static func _share(polygon: PackedVector2Array, beside: Vector2i, place: Vector2) -> float:
	var edge := polygon[beside.y] - polygon[beside.x]
	var square := edge.length_squared()
	return clampf((place - polygon[beside.x]).dot(edge) / square, 0, 1) if square > 0 else 0.5


static func _remap_springs(values: Dictionary, after: Dictionary, new_points: Dictionary,
		old_points: PackedInt32Array) -> void:
	var old: PackedInt32Array = values[&"springs"]
	var springs := PackedInt32Array()
	var sources := PackedInt32Array() # the old spring that a new one takes after
	var index_of := _index_by_ends(old)
	for i in old.size() / 2:
		if new_points.has(old[2 * i]) and new_points.has(old[2 * i + 1]):
			springs.append_array([new_points[old[2 * i]], new_points[old[2 * i + 1]]])
			sources.append(i)
	# A new point takes the place of the spring along the edge that it divides, and is held as its neighbors are.
	var removed := {}
	for i in old_points.size():
		if old_points[i] != NEW:
			continue
		var beside := _old_neighbors(old_points, i)
		var count := old_points.size()
		var divided: int = index_of.get(_key(beside.x, beside.y), -1)
		for neighbor: int in [posmod(i - 1, count), (i + 1) % count]:
			if not _has_spring(springs, i, neighbor):
				springs.append_array([i, neighbor])
				sources.append(divided)
		removed[divided] = true
		for point in range(values[&"polygon"].size(), BodyValues.point_count(values)):
			var first: int = index_of.get(_key(beside.x, point), -1)
			if first >= 0 and index_of.has(_key(beside.y, point)):
				springs.append_array([i, new_points[point]])
				sources.append(first)
	var kept := PackedInt32Array()
	var kept_sources := PackedInt32Array()
	for i in sources.size():
		# Only the divided spring itself has two old ends.
		var is_old := springs[2 * i] < old_points.size() and springs[2 * i + 1] < old_points.size() \
				and old_points[springs[2 * i]] != NEW and old_points[springs[2 * i + 1]] != NEW
		if not (is_old and sources[i] >= 0 and removed.has(sources[i])):
			kept.append_array([springs[2 * i], springs[2 * i + 1]])
			kept_sources.append(sources[i])
	after[&"springs"] = kept
	for property in BodyValues.SCALES:
		if values[property].size() == old.size() / 2:
			var scales := PackedFloat32Array()
			for source in kept_sources:
				scales.append(values[property][source] if source >= 0 else 1.0)
			after[property] = scales


static func _has_spring(springs: PackedInt32Array, a: int, b: int) -> bool:
	for i in springs.size() / 2:
		if _key(springs[2 * i], springs[2 * i + 1]) == _key(a, b):
			return true
	return false


static func _remap_scales_of_automatic_springs(values: Dictionary, after: Dictionary, new_points: Dictionary,
		old_points: PackedInt32Array) -> void:
	if BodyValues.SCALES.all(func(property: StringName) -> bool: return values[property].is_empty()):
		return
	var old_of := _index_by_ends(BodyValues.springs(values))
	var springs := BodyValues.springs(after)
	var was := {} # new point -> old point
	for point: int in new_points:
		was[new_points[point]] = point
	var sources := PackedInt32Array()
	for i in springs.size() / 2:
		var ends := [springs[2 * i], springs[2 * i + 1]]
		var candidates := [[], []]
		for side in 2:
			if was.has(ends[side]):
				candidates[side] = [was[ends[side]]]
			elif ends[side] < old_points.size():
				var beside := _old_neighbors(old_points, ends[side])
				candidates[side] = [beside.x, beside.y]
		var source := -1
		for a: int in candidates[0]:
			for b: int in candidates[1]:
				if source < 0:
					source = old_of.get(_key(a, b), -1)
		sources.append(source)
	for property in BodyValues.SCALES:
		if values[property].size() == old_of.size():
			var scales := PackedFloat32Array()
			for source in sources:
				scales.append(values[property][source] if source >= 0 else 1.0)
			after[property] = scales


static func _index_by_ends(springs: PackedInt32Array) -> Dictionary:
	var index_of := {}
	for i in springs.size() / 2:
		index_of[_key(springs[2 * i], springs[2 * i + 1])] = i
	return index_of


static func _key(a: int, b: int) -> Vector2i:
	return Vector2i(mini(a, b), maxi(a, b))


static func _nearest(points: PackedVector2Array, place: Vector2) -> int:
	var nearest := 0
	for i in points.size():
		if points[i].distance_squared_to(place) < points[nearest].distance_squared_to(place):
			nearest = i
	return nearest
