# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Geometry of edits on an outline: what lies under the mouse, and outlines with points moved, added and taken out.

const NOTHING := -1


## The point nearest to `place`, or NOTHING if none is within `radius`.
static func nearest_point(points: PackedVector2Array, place: Vector2, radius: float) -> int:
	var nearest := NOTHING
	var least := radius * radius
	for i in points.size():
		var distance := points[i].distance_squared_to(place)
		if distance <= least:
			least = distance
			nearest = i
	return nearest


## The edge nearest to `place`, by its first point, or NOTHING if none is within `radius`.
static func nearest_edge(outline: PackedVector2Array, place: Vector2, radius: float) -> int:
	var nearest := NOTHING
	var least := radius * radius
	for i in outline.size():
		var on_edge := Geometry2D.get_closest_point_to_segment(place, outline[i], outline[(i + 1) % outline.size()])
		var distance := on_edge.distance_squared_to(place)
		if distance <= least:
			least = distance
			nearest = i
	return nearest


static func points_in_box(points: PackedVector2Array, box: Rect2) -> PackedInt32Array:
	var inside := PackedInt32Array()
	for i in points.size():
		if box.has_point(points[i]):
			inside.append(i)
	return inside


static func moved(points: PackedVector2Array, indices: PackedInt32Array, by: Vector2) -> PackedVector2Array:
	return transformed(points, indices, Transform2D(0, by))


static func transformed(points: PackedVector2Array, indices: PackedInt32Array, by: Transform2D) -> PackedVector2Array:
	var result := points.duplicate()
	for index in indices:
		result[index] = by * points[index]
	return result


static func inserted(outline: PackedVector2Array, edge: int, place: Vector2) -> PackedVector2Array:
	var result := outline.duplicate()
	result.insert(edge + 1, place)
	return result


static func erased(points: PackedVector2Array, indices: PackedInt32Array) -> PackedVector2Array:
	var result := PackedVector2Array()
	for i in points.size():
		if not i in indices:
			result.append(points[i])
	return result


## Edges, by their first points, that meet one beside a point of `indices`. All of them where that would take long.
static func crossing_edges(outline: PackedVector2Array, indices: PackedInt32Array) -> PackedInt32Array:
	const MANY := 24
	var count := outline.size()
	var suspects := {}
	for index in indices:
		suspects[index] = true
		suspects[(index + count - 1) % count] = true
	var crossing := {}
	if suspects.size() > MANY:
		return PackedInt32Array(range(count))
	for a: int in suspects:
		for b in count:
			var apart := posmod(a - b, count)
			if apart > 1 and apart < count - 1 and Geometry2D.segment_intersects_segment(outline[a],
					outline[(a + 1) % count], outline[b], outline[(b + 1) % count]) != null:
				crossing[a] = true
				crossing[b] = true
	if crossing.is_empty(): # points that coincide, an edge that folds back, no area: these edges are to blame
		return PackedInt32Array(suspects.keys())
	return PackedInt32Array(crossing.keys())


## What the core says of a polygon, as one reads it at a glance: "edge 0-1 meets edge 7-8".
static func readable(problem: String) -> String:
	var text := problem.trim_prefix("polygon = ").get_slice(";", 0)
	for rest: String in [" must not intersect itself", " must have distinct neighboring points"]:
		text = text.replace(rest, "")
	return text


## Area, positive when it winds from x towards y.
static func signed_area(outline: PackedVector2Array) -> float:
	var twice := 0.0
	for i in outline.size():
		twice += outline[i].cross(outline[(i + 1) % outline.size()])
	return twice / 2


static func mean(points: PackedVector2Array) -> Vector2:
	var sum := Vector2.ZERO
	for point in points:
		sum += point
	return sum / maxf(1, points.size())


static func bounds(points: PackedVector2Array) -> Rect2:
	if points.is_empty():
		return Rect2()
	var box := Rect2(points[0], Vector2.ZERO)
	for point in points:
		box = box.expand(point)
	return box
