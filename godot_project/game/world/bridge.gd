# SPDX-License-Identifier: MIT
@tool
extends SoftBody2D
## A soft bridge: a long flat body whose ends are pinned to the world ([method SoftBody2D.set_point_pinned]) and whose
## middle sags under a player that walks on it.

const Palette := preload("res://game/palette.gd")

## How far it reaches, in pixels; the node stands in its middle.
@export_range(100, 1000, 10, "or_greater") var span := 400.0
@export_range(10, 80, 1) var thickness := 26.0


func _ready() -> void:
	polygon = SoftBody2D.make_box_polygon(Vector2(span, thickness), thickness)
	mass = span / 160
	elastic_model = ELASTIC_MODEL_NETWORK
	stiffness = 260
	damping = 0.5
	center_point = false
	shape_matching = 0.35
	shape_damping_ratio = 0.6
	physics_material_override = PhysicsMaterial.new()
	physics_material_override.friction = 0.9
	antialiased = true
	smooth = true
	color = Palette.BRIDGE
	outline_color = Palette.BRIDGE_DARK
	outline_width = 4
	add_to_group(&"soft_bodies")
	for i in polygon.size():
		if absf(polygon[i].x) > span / 2 - thickness * 0.6:
			set_point_pinned(i, true)
