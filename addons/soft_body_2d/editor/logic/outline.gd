# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Outlines made of other outlines: evenly spaced points, fewer points, mirrored, grown.

const PolygonEdit := preload("polygon_edit.gd")


static func perimeter(outline: PackedVector2Array) -> float:
	var sum := 0.0
	for i in outline.size():
		sum += outline[i].distance_to(outline[(i + 1) % outline.size()])
	return sum


## `count` points at even distances along the outline, beginning at its first point.
static func resampled(outline: PackedVector2Array, count: int) -> PackedVector2Array:
	var result := PackedVector2Array()
	if outline.size() < 2 or count < 1:
		return result
	var spacing := perimeter(outline) / count
	var edge := 0
	var edge_begin := 0.0
	var edge_length := outline[0].distance_to(outline[1])
	for i in count:
		var at := i * spacing
		while at > edge_begin + edge_length and edge < outline.size() - 1:
			edge_begin += edge_length
			edge += 1
			edge_length = outline[edge].distance_to(outline[(edge + 1) % outline.size()])
		var share := (at - edge_begin) / edge_length if edge_length > 0 else 0.0
		result.append(outline[edge].lerp(outline[(edge + 1) % outline.size()], clampf(share, 0, 1)))
	return result


## At most `budget` of its points: those whose lack would change it most (Douglas and Peucker 1973, asked the other way
## round: each point has the tolerance up to which it is kept, and the largest stay). O(n log n) as a rule.
static func simplified(outline: PackedVector2Array, budget: int) -> PackedVector2Array:
	var count := outline.size()
	if count <= budget or budget < 3:
		return outline.duplicate()
	# A closed outline is divided at two points that are far out, and so will not be missed.
	var middle := PolygonEdit.mean(outline)
	var start := 0
	for i in count:
		if outline[i].distance_squared_to(middle) > outline[start].distance_squared_to(middle):
			start = i
	var far := 0 # counted from there, as all that follows
	for i in count:
		if _at(outline, start + i).distance_squared_to(outline[start]) > _at(outline,
				start + far).distance_squared_to(outline[start]):
			far = i
	var worth := PackedFloat64Array()
	worth.resize(count)
	worth[0] = INF
	worth[far] = INF
	var parts := [[0, far, INF], [far, count, INF]]
	while not parts.is_empty():
		var part: Array = parts.pop_back()
		var first: int = part[0]
		var last: int = part[1]
		if last - first < 2:
			continue
		var a := _at(outline, start + first)
		var along := _at(outline, start + last) - a
		var length := along.length()
		var farthest := first + 1
		var most := -1.0
		for i in range(first + 1, last):
			var way := outline[(start + i) % count] - a
			var distance := absf(along.cross(way)) / length if length > 0 else way.length()
			if distance > most:
				most = distance
				farthest = i
		worth[farthest] = minf(part[2], most)
		parts.append([first, farthest, worth[farthest]])
		parts.append([farthest, last, worth[farthest]])
	var order := range(count)
	order.sort_custom(func(i: int, j: int) -> bool: return worth[i] > worth[j] or (worth[i] == worth[j] and i < j))
	var kept := order.slice(0, budget).map(func(i: int) -> int: return (start + i) % count)
	kept.sort()
	var result := PackedVector2Array()
	for i: int in kept:
		result.append(outline[i])
	return result


static func _at(outline: PackedVector2Array, index: int) -> Vector2:
	return outline[index % outline.size()]


## Turned over about the line through the middle of its box, upright if `horizontally`.
static func mirrored(points: PackedVector2Array, horizontally: bool, about: Vector2) -> PackedVector2Array:
	var result := points.duplicate()
	for i in points.size():
		result[i] = Vector2(2 * about.x - points[i].x, points[i].y) if horizontally else Vector2(points[i].x,
				2 * about.y - points[i].y)
	return result


## The half of it on one side of a line through `about`, and its mirror image: a symmetric outline, or an empty one where
## that is not in one piece. `side` is -1 to keep what lies left of an upright line or above a level one, 1 for the other.
static func symmetric(outline: PackedVector2Array, horizontally: bool, about: Vector2, side: int) -> PackedVector2Array:
	var box := PolygonEdit.bounds(outline).grow(1)
	var half := Rect2(box)
	if horizontally:
		half = Rect2(about.x, box.position.y, box.end.x - about.x, box.size.y) if side > 0 \
				else Rect2(box.position.x, box.position.y, about.x - box.position.x, box.size.y)
	else:
		half = Rect2(box.position.x, about.y, box.size.x, box.end.y - about.y) if side > 0 \
				else Rect2(box.position.x, box.position.y, box.size.x, about.y - box.position.y)
	var clip := PackedVector2Array([half.position, Vector2(half.end.x, half.position.y), half.end,
			Vector2(half.position.x, half.end.y)])
	var parts := Geometry2D.intersect_polygons(outline, clip)
	if parts.size() != 1:
		return PackedVector2Array()
	var joined := Geometry2D.merge_polygons(parts[0], mirrored(parts[0], horizontally, about))
	return without_repeats(joined[0]) if joined.size() == 1 else PackedVector2Array()


## Without neighbors that coincide or nearly do, and without points in the middle of a straight line.
static func without_repeats(outline: PackedVector2Array, least := 0.01) -> PackedVector2Array:
	var distinct := PackedVector2Array()
	for point in outline:
		if distinct.is_empty() or distinct[-1].distance_to(point) > least:
			distinct.append(point)
	while distinct.size() > 1 and distinct[0].distance_to(distinct[-1]) <= least:
		distinct.remove_at(distinct.size() - 1)
	return distinct


## A simple outline near one that may meet itself: the largest part of what it encloses. Empty if there is none.
static func repaired(outline: PackedVector2Array) -> PackedVector2Array:
	var clean := without_repeats(outline)
	if clean.size() < 3 or SoftBody2D.get_polygon_problem(clean) == "":
		return clean if clean.size() >= 3 else PackedVector2Array()
	# Grown and shrunk by the same way, necks without width and spikes are gone.
	var size := PolygonEdit.bounds(clean).size.length()
	for share: float in [0.001, 0.005, 0.02]:
		for grown in Geometry2D.offset_polygon(clean, share * size):
			for shrunk in Geometry2D.offset_polygon(grown, -share * size):
				var candidate := without_repeats(shrunk)
				if candidate.size() >= 3 and SoftBody2D.get_polygon_problem(candidate) == "":
					return candidate
	var around := Geometry2D.convex_hull(clean)
	if around.size() > 1 and around[0] == around[-1]:
		around.remove_at(around.size() - 1)
	return around if around.size() >= 3 and SoftBody2D.get_polygon_problem(around) == "" else PackedVector2Array()
