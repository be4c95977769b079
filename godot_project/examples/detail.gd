# SPDX-License-Identifier: MIT
extends Node2D
## Shows over three bodies of the same drawn outline what is simulated of it.

@onready var _bodies: Array[SoftBody2D] = [%AsDrawn, %Automatic, %PointCount]


func _ready() -> void:
	for body in _bodies:
		var report := body.get_detail_report()
		(body.get_node(^"Tag") as Node2D).set(&"text", "%d points simulated, error %.1f %%" % [report["points_simulated"], 100 * report["outline_error"]])


func _process(_delta: float) -> void:
	queue_redraw()


func _draw() -> void:
	for body in _bodies:
		var count := body.get_simulated_polygon().size()
		var hull := body.get_point_positions().slice(0, count)
		hull.append(hull[0])
		draw_polyline(hull, Color(1, 1, 1, 0.8), 1.5, true)
		for point in hull:
			draw_circle(point, 2.5 if count > 100 else 4.5, Color.WHITE)
