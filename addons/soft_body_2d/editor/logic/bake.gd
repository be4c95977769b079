# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The values of a Polygon2D that takes the place of a SoftBody2D.

const Conversion := preload("conversion.gd")
const PolygonEdit := preload("polygon_edit.gd")


## `outline` holds as many points as the body's polygon, in its coordinates: that polygon, or where its points are now.
static func values_of(body: SoftBody2D, outline: PackedVector2Array) -> Dictionary:
	var values := Conversion.node_values(body)
	values[&"polygon"] = outline
	values[&"color"] = body.get_color_in_use()
	values[&"antialiased"] = body.antialiased or body.get_look_in_use() == SoftBody2D.LOOK_SOFT
	if body.vertex_colors.size() == body.polygon.size():
		# They multiply a body's color, and take the place of that of a Polygon2D.
		var colors := body.vertex_colors
		for i in colors.size():
			colors[i] *= body.get_color_in_use()
		values[&"vertex_colors"] = colors
	if body.texture != null:
		values[&"texture"] = body.texture
		for property: StringName in [&"texture_offset", &"texture_scale", &"texture_rotation"]:
			values[property] = body.get(property)
		values[&"uv"] = _uv(body)
		# A Polygon2D shows the whole picture of an atlas.
		var atlas := body.texture as AtlasTexture
		if atlas != null and atlas.atlas != null:
			values[&"texture"] = atlas.atlas
			values[&"uv"] = Transform2D(0, _before_texture_transform(body, atlas.region.position)) * values[&"uv"]
	return values


## Where the outline's points are now, in the body's coordinates.
static func present_outline(body: SoftBody2D) -> PackedVector2Array:
	var count := body.polygon.size()
	var points := body.get_point_positions()
	if points.size() < count:
		return body.polygon
	return body.get_global_transform().affine_inverse() * points.slice(0, count)


# A body without coordinates of its own shows the whole texture in its box, turned and scaled about the middle.
static func _uv(body: SoftBody2D) -> PackedVector2Array:
	if body.uv.size() == body.polygon.size():
		return body.uv
	var box := PolygonEdit.bounds(body.polygon)
	var size := body.texture.get_size()
	var shift := _before_texture_transform(body, size / 2) - size / 2
	var uv := PackedVector2Array()
	for point in body.polygon:
		uv.append((point - box.position) / box.size * size + shift)
	return uv


# The pixels that scale and rotation of the texture take to `pixels`.
static func _before_texture_transform(body: SoftBody2D, pixels: Vector2) -> Vector2:
	if is_zero_approx(body.texture_scale.x) or is_zero_approx(body.texture_scale.y):
		return pixels
	return (pixels / body.texture_scale).rotated(-body.texture_rotation)
