# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Outlines to start from, in the node's coordinates. An empty one was refused; `last_problem` says why.

const PolygonEdit := preload("polygon_edit.gd")
const Outline := preload("outline.gd")
const Words := preload("words.gd")
const MOST_POINTS := 4096

static var last_problem := ""


static func circle(radius: float, count: int) -> PackedVector2Array:
	if not _check(radius > 0, Words.say("A circle needs a radius above 0.")) or not _check_count(count):
		return PackedVector2Array()
	return SoftBody2D.make_circle_polygon(radius, count)


static func rectangle(size: Vector2, spacing: float) -> PackedVector2Array:
	if not _check(size.x > 0 and size.y > 0, Words.say("A rectangle needs a size above 0.")) \
			or not _check_spacing(2 * (size.x + size.y), spacing):
		return PackedVector2Array()
	return SoftBody2D.make_box_polygon(size, spacing)


static func capsule(radius: float, height: float, spacing: float) -> PackedVector2Array:
	if not _check(radius > 0, Words.say("A capsule needs a radius above 0.")) \
			or not _check(height > 2 * radius, Words.say("A capsule must be higher than twice its radius.")) \
			or not _check_spacing(2 * height + TAU * radius, spacing):
		return PackedVector2Array()
	return SoftBody2D.make_capsule_polygon(radius, height, spacing)


## `sides` corners on a circle, the first at the top, with `per_side` pieces an edge.
static func regular_polygon(radius: float, sides: int, per_side: int) -> PackedVector2Array:
	if not _check(radius > 0, Words.say("A polygon needs a radius above 0.")) \
			or not _check(sides >= 3 and per_side >= 1, Words.say("A polygon needs at least 3 sides of at least 1 piece.")) \
			or not _check_count(sides * per_side):
		return PackedVector2Array()
	var result := PackedVector2Array()
	for side in sides:
		var a := Vector2.UP.rotated(TAU * side / sides) * radius
		var b := Vector2.UP.rotated(TAU * (side + 1) / sides) * radius
		for piece in per_side:
			result.append(a.lerp(b, float(piece) / per_side))
	return result


## The outline of a Polygon2D as it lies over the body.
static func from_polygon(polygon: Polygon2D, to_body: Transform2D) -> PackedVector2Array:
	var points := polygon.polygon
	if polygon.internal_vertex_count > 0:
		points = points.slice(0, points.size() - polygon.internal_vertex_count)
	if not _check(points.size() >= 3, Words.say("The Polygon2D has no outline: it needs at least 3 points.")):
		return PackedVector2Array()
	return _checked((to_body * Transform2D(0, polygon.offset)) * points)


## The curve of a Path2D, closed, with `count` points at even distances.
static func from_path(path: Path2D, to_body: Transform2D, count: int) -> PackedVector2Array:
	if not _check(path.curve != null and path.curve.point_count >= 2,
			Words.say("The Path2D has no curve: it needs at least 2 points.")) \
			or not _check_count(count):
		return PackedVector2Array()
	return _checked(Outline.resampled(Outline.without_repeats(to_body * path.curve.tessellate()), count))


static func _checked(outline: PackedVector2Array) -> PackedVector2Array:
	var clean := Outline.without_repeats(outline)
	var problem := SoftBody2D.get_polygon_problem(clean)
	return clean if _check(problem == "", Words.say("This outline cannot be a polygon: %s.") % PolygonEdit.readable(problem)) else PackedVector2Array()


static func _check_count(count: int) -> bool:
	return _check(count >= 3 and count <= MOST_POINTS, Words.say("A polygon needs 3 to %d points.") % MOST_POINTS)


static func _check_spacing(length: float, spacing: float) -> bool:
	return _check(spacing > 0 and length / spacing <= MOST_POINTS - 8,
			Words.say("The distance between points is too small: more than %d points.") % MOST_POINTS)


static func _check(condition: bool, problem: String) -> bool:
	last_problem = "" if condition else problem
	return condition
