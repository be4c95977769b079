# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Where the pixels of a Sprite2D are: its frame or region, centered, flipped, offset.


## Which part of the texture it shows, in pixels of the texture.
static func part_of(sprite: Sprite2D) -> Rect2:
	var whole := sprite.region_rect if sprite.region_enabled else Rect2(Vector2.ZERO, sprite.texture.get_size())
	var frame := whole.size / Vector2(sprite.hframes, sprite.vframes)
	return Rect2(whole.position + frame * Vector2(sprite.frame_coords), frame)


## The pixels that it shows.
static func picture_of(sprite: Sprite2D) -> Image:
	var image := sprite.texture.get_image()
	if image == null:
		return null
	var part := Rect2i(part_of(sprite))
	if part == Rect2i(Vector2i.ZERO, image.get_size()):
		return image
	if image.is_compressed() and image.decompress() != OK:
		return null
	return image.get_region(part)


## From pixels of that picture to the sprite's own coordinates.
static func to_local(sprite: Sprite2D, pixels: PackedVector2Array) -> PackedVector2Array:
	var size := part_of(sprite).size
	var result := pixels.duplicate()
	for i in pixels.size():
		var place := pixels[i]
		if sprite.flip_h:
			place.x = size.x - place.x
		if sprite.flip_v:
			place.y = size.y - place.y
		result[i] = place + sprite.offset - (size / 2 if sprite.centered else Vector2.ZERO)
	return result


## From pixels of that picture to pixels of the texture.
static func to_texture(sprite: Sprite2D, pixels: PackedVector2Array) -> PackedVector2Array:
	return Transform2D(0, part_of(sprite).position) * pixels
