# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Finds the outline of what is opaque in a picture, within a budget of points. Can run in a thread.

const PolygonEdit := preload("polygon_edit.gd")
const Outline := preload("outline.gd")
const Words := preload("words.gd")

## Longest side that is looked at pixel by pixel; larger pictures are shrunk first, so that the outline of one of 4096
## pixels is right to about 4 of them.
const LONGEST_SIDE := 1024
## How far the traced outline may be from the pixels' corners before points are saved [px of what is looked at].
const ROUGHNESS := 0.8
## Corners that are kept before the budget is looked at.
const MOST_CORNERS := 1024
## Of the points of an outline, as a share of the mean one.
const LEAST_SPACING := 0.25
## Points of a hole, which are drawn and not simulated.
const MOST_HOLE_POINTS := 48
## Area of a hole that is kept, as a share of that of the outline.
const LEAST_HOLE := 0.005

## Outline in pixels of the picture; empty when `problem` is not.
var outline := PackedVector2Array()
## What is clear inside of it, the same way.
var holes: Array[PackedVector2Array] = []
var problem := ""
## Worth knowing though it worked: islands that were left out, points of the budget.
var note := ""
var islands := 0
## 0 to 1, for a progress bar.
var progress := 0.0
## Set from another thread, it ends the work soon.
var canceled := false


## `threshold`: alpha above which a pixel counts. `margin` [px]: by how much the outline grows, negative: shrinks.
func trace(picture: Image, budget: int, threshold := 0.5, margin := 0.0) -> void:
	outline = PackedVector2Array()
	holes.clear()
	problem = ""
	note = ""
	islands = 0
	progress = 0.0
	if picture == null or picture.is_empty():
		problem = Words.say("There is no picture to trace: the texture has no pixels that can be read.")
		return
	if budget < 3:
		problem = Words.say("The outline needs at least 3 points.")
		return
	var size := picture.get_size()
	var work := _readable(picture)
	if work == null or _is_canceled():
		return
	var scale := Vector2(size) / Vector2(work.get_size())
	progress = 0.3
	var mask := BitMap.new()
	mask.create_from_image_alpha(work, threshold)
	progress = 0.5
	if _is_canceled():
		return
	if mask.get_true_bit_count() == 0:
		problem = Words.say("The picture has no opaque pixel (alpha above %.2f): there is no outline to trace. Lower the threshold, or choose another picture.") % threshold
		return
	var parts := mask.opaque_to_polygons(Rect2i(Vector2i.ZERO, work.get_size()), ROUGHNESS)
	progress = 0.8
	if _is_canceled():
		return
	var largest := PackedVector2Array()
	var total := 0.0
	for part in parts:
		var area := absf(PolygonEdit.signed_area(part))
		total += area
		islands += int(part.size() >= 3)
		if part.size() >= 3 and (largest.is_empty() or area > absf(PolygonEdit.signed_area(largest))):
			largest = part
	if largest.is_empty():
		problem = Words.say("What is opaque in the picture is too thin to have an outline. Lower the threshold, or choose another picture.")
		return
	var share := absf(PolygonEdit.signed_area(largest)) / maxf(total, 1e-9)
	outline = _finish(Transform2D(0, scale, 0, Vector2.ZERO) * largest, budget, margin)
	progress = 0.9
	_find_holes(mask, scale, margin)
	progress = 1.0
	if outline.is_empty():
		problem = Words.say("The outline of the picture cannot be drawn with %d points without crossing itself. Allow more points, or a larger margin.") % budget
	elif islands > 1:
		note = Words.say("The picture has %d islands; a body has one outline. The largest was taken, %d %% of what is opaque. For the others add a body each.") % [islands, roundi(100 * share)]


# What is clear and does not reach the edge of the picture: within the outline, or it would be clear around another island.
func _find_holes(mask: BitMap, scale: Vector2, margin: float) -> void:
	var size := mask.get_size()
	var clear := BitMap.new()
	clear.create(size)
	for y in size.y:
		for x in size.x:
			if not mask.get_bit(x, y):
				clear.set_bit(x, y, true)
		if _is_canceled():
			return
	for part in clear.opaque_to_polygons(Rect2i(Vector2i.ZERO, size), ROUGHNESS):
		if part.size() < 3:
			continue
		var box := PolygonEdit.bounds(part)
		if box.position.x < 1 or box.position.y < 1 or box.end.x > size.x - 1 or box.end.y > size.y - 1:
			continue
		var hole := _finish(Transform2D(0, scale, 0, Vector2.ZERO) * part, MOST_HOLE_POINTS, -margin)
		if hole.is_empty() or absf(PolygonEdit.signed_area(hole)) < LEAST_HOLE * absf(PolygonEdit.signed_area(outline)):
			continue
		if SoftBody2D.get_holes_problem([hole] as Array[PackedVector2Array], outline) == "":
			holes.append(hole)


func _readable(picture: Image) -> Image:
	var work := picture
	if picture.is_compressed() or picture.get_format() != Image.FORMAT_RGBA8 or maxi(picture.get_width(),
			picture.get_height()) > LONGEST_SIDE:
		work = picture.duplicate()
	if work.is_compressed() and work.decompress() != OK:
		problem = Words.say("The picture is compressed in a way that cannot be read here. Import it as lossless.")
		return null
	progress = 0.1
	if maxi(work.get_width(), work.get_height()) > LONGEST_SIDE:
		var shrink := float(LONGEST_SIDE) / maxi(work.get_width(), work.get_height())
		work.clear_mipmaps()
		work.resize(maxi(1, roundi(work.get_width() * shrink)), maxi(1, roundi(work.get_height() * shrink)),
				Image.INTERPOLATE_BILINEAR)
	return work


func _finish(traced: PackedVector2Array, budget: int, margin: float) -> PackedVector2Array:
	# Looking for edges that cross takes the square of their number.
	var whole := Outline.repaired(Outline.simplified(Outline.without_repeats(traced), maxi(MOST_CORNERS, budget)))
	if margin != 0 and not whole.is_empty():
		var grown: Array[PackedVector2Array] = Geometry2D.offset_polygon(whole, margin)
		whole = PackedVector2Array()
		for part in grown:
			if not Geometry2D.is_polygon_clockwise(part) or grown.size() == 1:
				if absf(PolygonEdit.signed_area(part)) > absf(PolygonEdit.signed_area(whole)):
					whole = part
	# What is left out may make edges cross where arms are thin; other points may do.
	var points := budget
	while points >= 3 and not whole.is_empty():
		var reduced := Outline.simplified(whole, points)
		# Steps of pixels leave points side by side, which a body has nothing of.
		reduced = Outline.without_repeats(reduced, LEAST_SPACING * Outline.perimeter(reduced) / reduced.size())
		if SoftBody2D.get_polygon_problem(reduced) == "":
			return reduced
		points = mini(points - 1, int(points * 0.9))
	return PackedVector2Array()


func _is_canceled() -> bool:
	if canceled:
		problem = Words.say("Tracing was canceled.")
	return canceled
