# SPDX-License-Identifier: MIT
@tool
extends "lines_mode.gd"
## Shapes the path of a rope. A line that is drawn from an end of the path makes it longer; any other takes its place.


func _init(p_canvas: BodyCanvas) -> void:
	super(p_canvas, false)


func property() -> StringName:
	return &"path"


func lines_of(body: SoftBody2D) -> Array[PackedVector2Array]:
	var lines: Array[PackedVector2Array] = []
	if body is SoftRope2D:
		lines.append((body as SoftRope2D).path)
	return lines


func value_of(lines: Array[PackedVector2Array]) -> Variant:
	return lines[0] if not lines.is_empty() else PackedVector2Array()


func problem_of(body: SoftBody2D, lines: Array[PackedVector2Array]) -> String:
	var text := (body as SoftRope2D).get_path_problem(value_of(lines)).trim_prefix("path = ").get_slice(";", 0)
	# Numbers of edges of the outline say nothing to those who see the path alone.
	var begin := text.find("must not bend")
	return Words.say("a path") + " " + text.substr(begin) if begin >= 0 else text


func least_points() -> int:
	return 0 # a rope has a path in any case, and says how many points it needs


func with_drawn(body: SoftBody2D, lines: Array[PackedVector2Array], drawn: PackedVector2Array) -> Array[PackedVector2Array]:
	var line := drawn.duplicate()
	if not drawn.is_empty() and not lines.is_empty() and lines[0].size() >= 2:
		var radius := canvas.grab_radius()
		var view := canvas.to_screen(body)
		var old := lines[0]
		if (view * old[-1]).distance_to(view * drawn[0]) <= radius:
			line = old + drawn.slice(1)
		elif (view * old[0]).distance_to(view * drawn[0]) <= radius:
			var before := drawn.slice(1)
			before.reverse()
			line = before + old
	return [line]


func action_name(verb: String) -> String:
	match verb:
		"Draw":
			return Words.say("Draw Rope Path")
		"Insert":
			return Words.say("Insert Rope Path Point")
		"Erase":
			return Words.say("Erase Rope Path Points")
	return Words.say("Move Rope Path Points")
