# SPDX-License-Identifier: MIT
extends Node2D
## Throws back what the fountain has lifted over its top, and sends the satellite on its way round the planet.

@onready var _satellite: SoftBody2D = $Satellite


func _ready() -> void:
	_satellite.linear_velocity = Vector2(0, -sqrt(700.0 * 160)) # v² / r is the area's gravity
