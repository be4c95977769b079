# SPDX-License-Identifier: MIT
@tool
extends "lines_mode.gd"
## Shapes the holes of bodies. A hole that is drawn is one more; one of which fewer than three points are left is gone.


func _init(p_canvas: BodyCanvas) -> void:
	super(p_canvas, true)


func property() -> StringName:
	return &"holes"


func lines_of(body: SoftBody2D) -> Array[PackedVector2Array]:
	return body.holes


func value_of(lines: Array[PackedVector2Array]) -> Variant:
	return lines


## In the words of the setter, which refuses them.
func problem_of(body: SoftBody2D, lines: Array[PackedVector2Array]) -> String:
	return SoftBody2D.get_holes_problem(lines, body.polygon)


func with_drawn(_body: SoftBody2D, lines: Array[PackedVector2Array], drawn: PackedVector2Array) -> Array[PackedVector2Array]:
	var after := LineEdit2D.copy(lines)
	after.append(drawn.duplicate())
	return after


func action_name(verb: String) -> String:
	match verb:
		"Draw":
			return Words.say("Draw Hole")
		"Insert":
			return Words.say("Insert Hole Point")
		"Erase":
			return Words.say("Erase Hole Points")
	return Words.say("Move Hole Points")


func draw_body(overlay: Control, body: SoftBody2D) -> void:
	canvas.draw_outline(overlay, canvas.to_screen(body) * body.polygon, Color(BodyCanvas.LINE, 0.5))
	super(overlay, body)
	if lines_of(body).is_empty() and not drawing.is_on:
		canvas.draw_text(overlay, Vector2(48, 96) * canvas.scale(),
				Words.say("No holes yet: click the pen in the toolbar, then place the points of one."), BodyCanvas.SELECTED)
