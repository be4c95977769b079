# SPDX-License-Identifier: MIT
@tool
extends SoftRope2D
## A hanging bridge: a slack rope, as thick as planks, whose ends are pinned. It sags under a player that walks on it, and swings
## when one jumps off.

const Palette := preload("res://game/palette.gd")
const LINK := 14.0 # px
const SLACK := 1.02 # how much longer it is than what it spans

## How far it reaches, in pixels; the node stands in its middle.
@export_range(100, 1000, 10, "or_greater") var span := 400.0


func _ready() -> void:
	kind = KIND_STRAP
	width = 18
	link_count = roundi(span / LINK)
	path = _hanging()
	mass = span / 160
	pin_start = true
	pin_end = true
	collision_mask = 2 # the player's layer; its ends are let into the banks
	physics_material_override = PhysicsMaterial.new()
	physics_material_override.friction = 0.9
	antialiased = true
	smooth = true
	color = Palette.BRIDGE
	outline_color = Palette.BRIDGE_DARK
	outline_width = 4
	add_to_group(&"soft_bodies")


## A parabola between the ends. One of the height h is longer than its span s by 8 h² / 3 s.
func _hanging() -> PackedVector2Array:
	var height := span * sqrt(3.0 / 8.0 * (SLACK - 1))
	var points := PackedVector2Array()
	for i in link_count + 1:
		var t := 2.0 * i / link_count - 1
		points.append(Vector2(t * span / 2, height * (1 - t * t)))
	return points
