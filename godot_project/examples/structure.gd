# SPDX-License-Identifier: MIT
extends Node2D
## Gives each spring of three pads a stiffness of its own, and draws the springs: the firmer, the brighter.

const FIRM := 8.0

@onready var _pads: Array[SoftBody2D] = [%Soft, %Half, %Firm]


func _ready() -> void:
	for i in 3:
		var pad := _pads[i]
		var scales := PackedFloat32Array()
		for k in pad.get_spring_count():
			var ends := pad.get_spring_points(k)
			var middle := (_rest_place(pad, ends.x) + _rest_place(pad, ends.y)) / 2
			scales.append(1.0 if i == 0 or (i == 1 and middle.x < 0) else FIRM)
		pad.spring_stiffness_scales = scales


func _rest_place(pad: SoftBody2D, index: int) -> Vector2:
	return pad.polygon[index] if index < pad.polygon.size() else pad.inner_points[index - pad.polygon.size()]


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	for pad in _pads:
		var points := pad.get_point_positions()
		var lines := PackedVector2Array()
		var colors := PackedColorArray()
		for k in pad.get_spring_count():
			var ends := pad.get_spring_points(k)
			lines.append_array([points[ends.x], points[ends.y]])
			colors.append(Color(0.1, 0.1, 0.25, 0.25 if pad.spring_stiffness_scales[k] < 2 else 0.85))
		draw_multiline_colors(lines, colors, 2)
