# SPDX-License-Identifier: MIT
extends RefCounted
## What happened to the bodies of a run, looked at every physics tick: the numbers of the summary line.

var max_penetration := 0.0
var min_area_ratio := 1.0
var finite := true


func observe(bodies: Array[SoftBody2D]) -> void:
	max_penetration = maxf(max_penetration, SoftBodySimulation2D.measure_max_penetration())
	for body in bodies:
		min_area_ratio = minf(min_area_ratio, body.get_area() / body.get_rest_area())
		for position in body.get_point_positions():
			finite = finite and position.is_finite()


func to_line() -> String:
	return "SUMMARY " + JSON.stringify({
		"godot": Engine.get_version_info()["string"],
		"bodies": SoftBodySimulation2D.get_body_count(),
		"ticks": SoftBodySimulation2D.get_tick_count(),
		"mean_step_us": snappedf(SoftBodySimulation2D.get_mean_step_usec(), 0.1),
		"max_penetration_px": snappedf(max_penetration, 0.0001),
		"min_area_ratio": snappedf(min_area_ratio, 0.0001),
		"finite": finite,
	}, "", false)
