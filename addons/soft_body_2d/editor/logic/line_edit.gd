# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Edits of lines of points, several of which belong to one body: the path of a rope, or the holes of a body. A point is named by
## its number among those of all lines, one line after the other.

const NOTHING := -1


## All points, one line after the other.
static func points(lines: Array[PackedVector2Array]) -> PackedVector2Array:
	var all := PackedVector2Array()
	for line in lines:
		all.append_array(line)
	return all


## The line and the place in it of a point.
static func place_of(lines: Array[PackedVector2Array], index: int) -> Vector2i:
	for i in lines.size():
		if index < lines[i].size():
			return Vector2i(i, index)
		index -= lines[i].size()
	return Vector2i(NOTHING, NOTHING)


## The number of the first point of a line.
static func first_of(lines: Array[PackedVector2Array], line: int) -> int:
	var first := 0
	for i in line:
		first += lines[i].size()
	return first


## All points of the line that a point belongs to.
static func line_around(lines: Array[PackedVector2Array], index: int) -> PackedInt32Array:
	var line := place_of(lines, index).x
	var first := first_of(lines, line)
	return PackedInt32Array(range(first, first + lines[line].size()))


## The edge nearest to `place`, by the number of its first point, or NOTHING if none is within `radius`. A closed line has an edge
## from its last point to its first.
static func nearest_edge(lines: Array[PackedVector2Array], closed: bool, place: Vector2, radius: float) -> int:
	var nearest := NOTHING
	var least := radius * radius
	var first := 0
	for line in lines:
		for i in line.size() if closed else line.size() - 1:
			var on_edge := Geometry2D.get_closest_point_to_segment(place, line[i], line[(i + 1) % line.size()])
			var distance := on_edge.distance_squared_to(place)
			if distance <= least:
				least = distance
				nearest = first + i
		first += line.size()
	return nearest


## The next point along the line of a point.
static func next_of(lines: Array[PackedVector2Array], index: int) -> int:
	var at := place_of(lines, index)
	return index + 1 if at.y + 1 < lines[at.x].size() else index - at.y


## With a point more, behind that one.
static func inserted(lines: Array[PackedVector2Array], behind: int, place: Vector2) -> Array[PackedVector2Array]:
	var result := copy(lines)
	var at := place_of(lines, behind)
	result[at.x].insert(at.y + 1, place)
	return result


## With other points, by number.
static func with_points(lines: Array[PackedVector2Array], moved: PackedVector2Array) -> Array[PackedVector2Array]:
	var result: Array[PackedVector2Array] = []
	var first := 0
	for line in lines:
		result.append(moved.slice(first, first + line.size()))
		first += line.size()
	return result


## Without these points, and without lines of which fewer than `least` are left.
static func erased(lines: Array[PackedVector2Array], indices: PackedInt32Array, least: int) -> Array[PackedVector2Array]:
	var result: Array[PackedVector2Array] = []
	var first := 0
	for line in lines:
		var kept := PackedVector2Array()
		for i in line.size():
			if not first + i in indices:
				kept.append(line[i])
		if kept.size() >= least:
			result.append(kept)
		first += line.size()
	return result


## Packed arrays are shared, and these go into the undo history.
static func copy(lines: Array[PackedVector2Array]) -> Array[PackedVector2Array]:
	var result: Array[PackedVector2Array] = []
	for line in lines:
		result.append(line.duplicate())
	return result
