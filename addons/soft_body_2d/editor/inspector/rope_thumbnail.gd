# SPDX-License-Identifier: MIT
@tool
extends "material_thumbnail.gd"
## A kind of rope, held level at one end and let go: it lies still, and falls again and again while the mouse is over it.

const RopeKinds := preload("../../materials/rope_kinds.gd")

const LENGTH := 110.0
const WIDTH := 16.0
const LINKS := 12
## Heavy enough that a rubber band is seen to stretch.
const MASS := 1.0
## As the limp ones have swung halfway down.
const STILL_TICKS := 18

var kind: RopeKinds.Kind


func set_up_kind(of: RopeKinds.Kind) -> void:
	kind = of
	set_up_as(of.file, of.title, of.text, of.figures(), of.color)


func _fill() -> void:
	var rope := SoftRope2D.new()
	rope.kind = kind.kind
	rope.width = WIDTH
	rope.link_count = LINKS
	rope.path = PackedVector2Array([Vector2.ZERO, Vector2(LENGTH, 0)])
	rope.position = Vector2(-LENGTH / 2, -SCENE_HEIGHT + WIDTH)
	rope.mass = MASS
	for i in 2: # one point would leave it free to turn
		rope.set_point_pinned(rope.get_center_point(i), true, NodePath())
	world.add_body(rope)
	rope.free()


func _still_ticks() -> int:
	return STILL_TICKS
