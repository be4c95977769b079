# SPDX-License-Identifier: MIT
extends Node2D
## Sends the satellite on its way round the planet; the areas do the rest.

@onready var _satellite: SoftBody2D = $Satellite


func _ready() -> void:
	_satellite.linear_velocity = Vector2(0, -sqrt(700.0 * 160)) # v² / r is the area's gravity
