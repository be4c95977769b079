# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## How a body looks that takes the place of a Sprite2D or Polygon2D, its child: texture, coordinates, color.

const PolygonEdit := preload("polygon_edit.gd")
const SpriteOutline := preload("sprite_outline.gd")

## Share of the outline's box that the picture must cover to be one of the body.
const LEAST_COVER := 0.5
## How far texture coordinates may be from an even mapping [px].
const TOLERANCE := 1.0


## Empty if the child shows nothing where the body is, or cannot be spread over it. `polygon` is the body's, in its coordinates.
static func of(child: Node2D, polygon: PackedVector2Array) -> Dictionary:
	if not child.visible or is_zero_approx(child.transform.determinant()):
		return {}
	var values := {}
	var box := Rect2()
	var color := child.modulate * child.self_modulate
	if child is Sprite2D:
		if child.texture == null:
			return {}
		box = child.get_rect()
		values[&"texture"] = child.texture
		values[&"uv"] = sprite_pixels(child) * (child.transform.affine_inverse() * polygon)
	else:
		if child.invert_enabled or child.polygon.size() < 3:
			return {}
		box = PolygonEdit.bounds(Transform2D(0, child.offset) * child.polygon)
		color *= child.color
		if child.texture != null:
			var pixels := polygon_pixels(child)
			if pixels.is_empty():
				return {}
			values[&"texture"] = child.texture
			values[&"uv"] = pixels[0] * (child.transform.affine_inverse() * polygon)
	var body_box := PolygonEdit.bounds(polygon)
	if (child.transform * box).intersection(body_box).get_area() < LEAST_COVER * body_box.get_area():
		return {}
	values[&"color"] = color
	for property: StringName in [&"material", &"texture_filter", &"texture_repeat"]:
		if child.get(property): # null and "inherit" are the body's own
			values[property] = child.get(property)
	return values


## From a sprite's own coordinates to pixels of its texture.
static func sprite_pixels(sprite: Sprite2D) -> Transform2D:
	var part := SpriteOutline.part_of(sprite)
	var corners := SpriteOutline.to_local(sprite, [Vector2.ZERO, Vector2(part.size.x, 0), Vector2(0, part.size.y)])
	return _through(corners, SpriteOutline.to_texture(sprite, [Vector2.ZERO, Vector2(part.size.x, 0), Vector2(0, part.size.y)]))


## From a Polygon2D's own coordinates to pixels of its texture: one transform, or none if its texture is bent.
static func polygon_pixels(source: Polygon2D) -> Array[Transform2D]:
	# In this order the engine applies them.
	var shown := Transform2D(source.texture_rotation, source.texture_offset).scaled(source.texture_scale)
	if source.uv.size() != source.polygon.size():
		return [shown * Transform2D(0, source.offset)]
	var points := Transform2D(0, source.offset) * source.polygon
	var widest := _widest_triangle(points)
	if widest.is_empty():
		return []
	var even := _through([points[widest[0]], points[widest[1]], points[widest[2]]],
			[source.uv[widest[0]], source.uv[widest[1]], source.uv[widest[2]]])
	for i in points.size():
		if (even * points[i]).distance_to(source.uv[i]) > TOLERANCE:
			return []
	return [shown * even]


# The transform that takes three points to three others.
static func _through(from: PackedVector2Array, to: PackedVector2Array) -> Transform2D:
	var source := Transform2D(from[1] - from[0], from[2] - from[0], from[0])
	return Transform2D(to[1] - to[0], to[2] - to[0], to[0]) * source.affine_inverse()


static func _widest_triangle(points: PackedVector2Array) -> PackedInt32Array:
	var far := 0
	for i in points.size():
		if points[i].distance_squared_to(points[0]) > points[far].distance_squared_to(points[0]):
			far = i
	var third := 0
	for i in points.size():
		if absf((points[i] - points[0]).cross(points[far] - points[0])) > absf((points[third]
				- points[0]).cross(points[far] - points[0])):
			third = i
	return PackedInt32Array() if third == 0 or third == far else PackedInt32Array([0, far, third])
