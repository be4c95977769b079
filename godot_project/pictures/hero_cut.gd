# SPDX-License-Identifier: MIT
extends "res://pictures/hero.gd"
## A blade goes through three bodies, one after the other; the halves slide apart and wobble.

const RADIUS := 62.0
## Of each cut: the second at which the blade begins, and its way.
const CUTS: Array[Array] = [
	[0.5, Vector2(-275, -125), Vector2(-75, -30)],
	[1.1, Vector2(95, -125), Vector2(-95, -25)],
	[1.7, Vector2(90, -110), Vector2(260, -20)],
]
const SWIPE := 0.15 # s that the blade takes
const PUSH := 60.0 # px/s, with which pieces part

var _done := 0
var _ink := Node2D.new()


func _build() -> void:
	add_floor()
	add_body("water_balloon", SoftBody2D.make_circle_polygon(RADIUS, 28), Vector2(-175, -RADIUS))
	add_body("jelly", make_block(Vector2.ONE * 120), Vector2(0, -60), Color("ff6b8b"))
	add_body("jelly", SoftBody2D.make_circle_polygon(RADIUS, 28), Vector2(175, -RADIUS))
	_ink.z_index = 10
	_ink.draw.connect(_draw_blade)
	add_child(_ink)


func _move() -> void:
	_ink.queue_redraw()
	if _done < CUTS.size() and age > float(CUTS[_done][0]) + SWIPE:
		_cut([CUTS[_done][1], CUTS[_done][2]])
		_done += 1


func _cut(line: PackedVector2Array) -> void:
	for body: SoftBody2D in find_children("*", "SoftBody2D", true, false):
		if body.get_cut_problem(line) != "":
			continue
		var middle := body.get_center_of_mass_position()
		for piece in body.cut_polyline(line):
			piece.apply_central_impulse((piece.get_center_of_mass_position() - middle).normalized() * PUSH * piece.mass)


func _draw_blade() -> void:
	for cut in CUTS:
		var share := (age - float(cut[0])) / SWIPE
		if share > 0 and share < 2:
			var begin: Vector2 = cut[1]
			var tip := begin.lerp(cut[2], minf(share, 1))
			_ink.draw_line(begin.lerp(cut[2], maxf(share - 0.9, 0)), tip, Color(1, 1, 1, 0.85 * (2 - maxf(share, 1))), 3, true)
