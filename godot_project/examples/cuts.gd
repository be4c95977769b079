# SPDX-License-Identifier: MIT
extends Node2D
## Cuts soft bodies along the line that the mouse draws. While it is drawn, the pieces that it would leave are outlined.

## Bodies and pieces in the scene, beyond which the oldest pieces are freed.
const MOST_BODIES := 60
## Pixels between two points of the line.
const STEP := 6.0
const PUSH := 60.0 # px/s, with which pieces part

var _line := PackedVector2Array()
var _first: Array[Node] = []


func _ready() -> void:
	_first = _bodies()
	(%Knife as Timer).timeout.connect(_cut_by_itself)
	(%Ink as Node2D).draw.connect(_draw_ink) # above all bodies


func _bodies() -> Array[Node]:
	return find_children("*", "SoftBody2D", true, false)


func _unhandled_input(event: InputEvent) -> void:
	var mouse := make_input_local(event) as InputEventMouse
	if mouse == null:
		return
	var button := mouse as InputEventMouseButton
	if button != null and button.button_index == MOUSE_BUTTON_LEFT:
		if button.pressed:
			(%Knife as Timer).stop()
			_line = [to_global(mouse.position)]
		elif not _line.is_empty():
			cut_all(_line)
			_line.clear()
	elif button == null and not _line.is_empty() and _line[-1].distance_to(to_global(mouse.position)) >= STEP:
		_line.append(to_global(mouse.position))
	(%Ink as Node2D).queue_redraw()


## Cuts every body that the line goes through, and gives the pieces a push apart. Returns the number of new pieces.
func cut_all(line: PackedVector2Array) -> int:
	var made := 0
	for node in _bodies():
		var body := node as SoftBody2D
		if line.size() < 2 or body.get_cut_problem(line) != "":
			continue # too little would be left
		var middle := body.get_center_of_mass_position()
		for piece in body.cut_polyline(line):
			var way := (piece.get_center_of_mass_position() - middle).normalized()
			piece.apply_central_impulse(way * PUSH * piece.mass)
			made += int(piece != body)
	for node in _bodies().slice(MOST_BODIES):
		if not node in _first:
			node.queue_free()
	return made


# Until someone takes the mouse.
func _cut_by_itself() -> void:
	var bodies := _bodies()
	var body := bodies.pick_random() as SoftBody2D
	var middle := body.get_center_of_mass_position()
	var way := Vector2.from_angle(randf() * TAU) * 200
	cut_all([middle - way, middle + way])


func _draw_ink() -> void:
	var ink := %Ink as Node2D
	if _line.size() < 2:
		return
	for node in _bodies():
		for outline in (node as SoftBody2D).preview_cut(_line):
			outline.append(outline[0])
			ink.draw_polyline(ink.get_global_transform().affine_inverse() * outline, Color.WHITE, 2.0, true)
	ink.draw_polyline(ink.get_global_transform().affine_inverse() * _line, Color(1, 1, 1, 0.7), 3.0, true)
