# SPDX-License-Identifier: MIT
extends Node2D
## Blows balloons up and lets their air out again.

const LEAST := 0.6
const MOST := 2.2
const PERIOD := 6.0 # s

var _age := 0.0


func _physics_process(delta: float) -> void:
	_age += delta
	var inflation := lerpf(LEAST, MOST, 0.5 - 0.5 * cos(TAU * _age / PERIOD))
	for body: SoftBody2D in [$Filled, $Skin, $Wedged]:
		body.inflation = inflation
	(%Status as Label).text = "inflation %.2f; the areas are %d %%, %d %% and %d %% of those at rest" % [inflation,
			_percent($Filled), _percent($Skin), _percent($Wedged)]


func _percent(body: SoftBody2D) -> int:
	return roundi(100 * body.get_area() / body.get_rest_area())
