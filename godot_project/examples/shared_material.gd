# SPDX-License-Identifier: MIT
extends Node2D
## Changes the material that three bodies share.

const SOFT := 90.0
const HARD := 700.0
const PERIOD := 6.0 # s

var _age := 0.0


func _physics_process(delta: float) -> void:
	_age += delta
	var material := ($Round as SoftBody2D).soft_body_material
	material.stiffness = lerpf(HARD, SOFT, 0.5 - 0.5 * cos(TAU * _age / PERIOD))
	(%Status as Label).text = "stiffness %d N/m" % roundi(material.stiffness)
