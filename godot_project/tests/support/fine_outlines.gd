# SPDX-License-Identifier: MIT
extends RefCounted
## Outlines of hundreds of points, as artists draw them.

const CHARACTER: Array[Vector2] = [Vector2(0, -46), Vector2(14, -48), Vector2(24, -72), Vector2(36, -70), Vector2(36, -40),
	Vector2(44, -18), Vector2(62, -14), Vector2(64, 2), Vector2(46, 6), Vector2(46, 22), Vector2(38, 38), Vector2(44, 52),
	Vector2(14, 54), Vector2(8, 42), Vector2(-8, 42), Vector2(-14, 54), Vector2(-44, 52), Vector2(-38, 38), Vector2(-46, 22),
	Vector2(-46, 6), Vector2(-64, 2), Vector2(-62, -14), Vector2(-44, -18), Vector2(-36, -40), Vector2(-36, -70),
	Vector2(-24, -72), Vector2(-14, -48)]


## A round body with two ears, two stubby arms and two feet.
static func character(count := 200) -> PackedVector2Array:
	var line := PackedVector2Array(CHARACTER)
	for cut in 3:
		var rounded := PackedVector2Array()
		for i in line.size():
			var next := line[(i + 1) % line.size()]
			rounded.append(line[i].lerp(next, 0.25))
			rounded.append(line[i].lerp(next, 0.75))
		line = rounded
	return evenly(line, count)


static func evenly(line: PackedVector2Array, count: int) -> PackedVector2Array:
	var perimeter := 0.0
	for i in line.size():
		perimeter += line[i].distance_to(line[(i + 1) % line.size()])
	var places := PackedVector2Array()
	var way := 0.0
	for i in line.size():
		var next := line[(i + 1) % line.size()]
		var size := line[i].distance_to(next)
		while places.size() < count and places.size() * perimeter / count < way + size:
			places.append(line[i].lerp(next, (places.size() * perimeter / count - way) / size))
		way += size
	return places


## Largest distance of a point of the one from the edges of the other.
static func distance(from: PackedVector2Array, to: PackedVector2Array) -> float:
	var most := 0.0
	for point in from:
		var least := INF
		for i in to.size():
			least = minf(least, point.distance_to(Geometry2D.get_closest_point_to_segment(point, to[i], to[(i + 1) % to.size()])))
		most = maxf(most, least)
	return most


static func area(polygon: PackedVector2Array) -> float:
	var twice := 0.0
	for i in polygon.size():
		twice += polygon[i].cross(polygon[(i + 1) % polygon.size()])
	return absf(twice / 2)
