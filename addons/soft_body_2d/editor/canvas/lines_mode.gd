# SPDX-License-Identifier: MIT
@tool
extends "mode.gd"
## Shapes lines of points that a body has besides its polygon: points are dragged, inserted and erased, and new lines drawn. What
## lines these are, and which of them a body can have, is said by the modes that extend this one.

const LineEdit2D := preload("../logic/line_edit.gd")
const PointDrawing := preload("point_drawing.gd")

enum Drag { NONE, POINTS, BOX }

## Why the lines cannot be let go of as they are; empty when they can.
var problem := ""
## A line that is being drawn, of the first body.
var drawing: PointDrawing

var _closed := true
var _drag := Drag.NONE
var _press := Vector2.ZERO
var _mouse := Vector2.ZERO
var _grabbed: Array = [] # body and number of the point under the mouse
var _grab_offset := Vector2.ZERO
var _before := {} # lines of each body when the drag began
var _dragged := {} # lines as they are dragged
var _is_inserting := false
var _hover: Array = []
var _hover_edge: Array = []


func _init(p_canvas: BodyCanvas, closed: bool) -> void:
	super(p_canvas)
	_closed = closed
	drawing = PointDrawing.new(p_canvas, closed)
	drawing.finished.connect(_take_drawing)
	drawing.given_up.connect(canvas.changed.emit)


# What modes say of their lines.

## The property that holds the lines, as it is.
func property() -> StringName:
	return &""


func lines_of(_body: SoftBody2D) -> Array[PackedVector2Array]:
	return []


## What the property is set to for these lines.
func value_of(_lines: Array[PackedVector2Array]) -> Variant:
	return null


## Why the body cannot have these lines; empty if it can.
func problem_of(_body: SoftBody2D, _lines: Array[PackedVector2Array]) -> String:
	return ""


## The lines with one more that was drawn.
func with_drawn(_body: SoftBody2D, _lines: Array[PackedVector2Array], _drawn: PackedVector2Array) -> Array[PackedVector2Array]:
	return []


## The fewest points of a line; one that has fewer is gone, where a body can be without.
func least_points() -> int:
	return 3


func action_name(_verb: String) -> String:
	return ""


# Editing.

func follow_bodies() -> void:
	var counts := PackedInt32Array()
	for body in canvas.bodies:
		counts.append(LineEdit2D.points(lines_of(body)).size())
	selection.keep_to(canvas.bodies, counts)


func is_creating() -> bool:
	return drawing.is_on


func set_creating(enabled: bool) -> void:
	drawing.set_on(enabled)


func cancel() -> void:
	super()
	if _drag == Drag.POINTS:
		_put_back()
	_end_drag()
	drawing.clear()
	canvas.redraw()


func input(event: InputEvent) -> bool:
	if canvas.bodies.is_empty():
		return false
	if drawing.is_on:
		return drawing.input(event, canvas.bodies[0])
	if is_key(event, KEY_ESCAPE) and _drag != Drag.NONE:
		cancel()
		return true
	if is_key(event, KEY_DELETE) and not selection.is_empty():
		_erase_selected()
		return true
	if event is InputEventMouseMotion:
		return _move(event)
	if is_left(event, true):
		return _press_left(event)
	if is_left(event, false) and _drag != Drag.NONE:
		_release()
		return true
	if is_right_press(event):
		return _press_right(event)
	return false


func _take_drawing() -> void:
	var body := canvas.bodies[0]
	var after := with_drawn(body, lines_of(body), drawing.points)
	var refusal := problem_of(body, after)
	if refusal != "":
		canvas.warn(Words.say("Refused, as it was before: %s.") % refusal)
		return
	_commit(action_name("Draw"), {body: lines_of(body)}, {body: after})
	set_creating(false)
	canvas.changed.emit()


func _press_left(event: InputEventMouseButton) -> bool:
	_press = event.position
	_mouse = event.position
	var found := _find(event.position)
	if not found.is_empty():
		if not canvas.may_edit():
			return true
		if event.shift_pressed:
			selection.toggle(found[0], found[1])
			canvas.redraw()
			return true
		if event.double_click: # the line as a whole
			selection.clear()
			selection.add(found[0], LineEdit2D.line_around(lines_of(found[0]), found[1]))
		elif not selection.has(found[0], found[1]):
			selection.clear()
			selection.add(found[0], [found[1]])
		_begin_drag(found)
		return true
	if event.shift_pressed:
		_drag = Drag.BOX
		box_from = event.position
		box_to = event.position
		return true
	var edge := _find_edge(event.position)
	if not edge.is_empty():
		if canvas.may_edit():
			_insert(edge[0], edge[1], event.position)
		return true
	if not selection.is_empty():
		selection.clear() # only what is selected here is let go of, not the node
		canvas.redraw()
		return true
	return false


func _begin_drag(found: Array) -> void:
	_drag = Drag.POINTS
	_grabbed = found
	_before = {}
	_dragged = {}
	for body in canvas.bodies:
		_before[body] = LineEdit2D.copy(lines_of(body))
		_dragged[body] = _before[body]
	var place := LineEdit2D.points(_before[found[0]])[found[1]]
	_grab_offset = canvas.to_screen(found[0]) * place - _press
	canvas.redraw()


func _insert(body: SoftBody2D, behind: int, place: Vector2) -> void:
	# The lines before the point came are what undo restores: inserting and dragging on is one step.
	var after := LineEdit2D.inserted(lines_of(body), behind, canvas.to_body(body, place))
	var refusal := problem_of(body, after)
	if refusal != "":
		canvas.warn(Words.say("No point can be inserted here: %s.") % refusal)
		return
	var before := LineEdit2D.copy(lines_of(body))
	body.set(property(), value_of(after))
	selection.clear()
	selection.add(body, [behind + 1])
	_press = place
	_begin_drag([body, behind + 1])
	_before[body] = before
	_is_inserting = true


func _press_right(event: InputEventMouseButton) -> bool:
	if _drag != Drag.NONE:
		cancel()
		return true
	var found := _find(event.position)
	if found.is_empty():
		return false
	if canvas.may_edit():
		if not selection.has(found[0], found[1]):
			selection.clear()
			selection.add(found[0], [found[1]])
		_erase_selected()
	return true


func _erase_selected() -> void:
	if not canvas.may_edit():
		return
	var before := {}
	var after := {}
	for body in canvas.bodies:
		var chosen := selection.of(body)
		if not chosen.is_empty():
			before[body] = LineEdit2D.copy(lines_of(body))
			after[body] = LineEdit2D.erased(before[body], chosen, least_points())
			var refusal := problem_of(body, after[body])
			if refusal != "":
				canvas.warn(Words.say("These points of '%s' cannot be erased: %s.") % [body.name, refusal])
				return
	selection.clear()
	_commit(action_name("Erase"), before, after)


func _move(event: InputEventMouseMotion) -> bool:
	_mouse = event.position
	match _drag:
		Drag.NONE:
			_find_hover(event.position)
			return false
		Drag.BOX:
			box_to = event.position
			canvas.redraw()
		Drag.POINTS:
			_drag_points(event.position)
	return true


# The point under the mouse goes to the grid; the others keep their places beside it.
func _drag_points(place: Vector2) -> void:
	var grabbed: SoftBody2D = _grabbed[0]
	var to := canvas.to_body(grabbed, place + _grab_offset)
	var from := LineEdit2D.points(_dragged[grabbed])[_grabbed[1]]
	if to == from:
		return
	var way := canvas.to_screen(grabbed).basis_xform(to - from)
	problem = ""
	for body in canvas.bodies:
		var chosen := selection.of(body)
		if chosen.is_empty():
			continue
		var by := to - from if body == grabbed else canvas.to_screen(body).affine_inverse().basis_xform(way)
		var points := PolygonEdit.moved(LineEdit2D.points(_dragged[body]), chosen, by)
		if body == grabbed:
			points[_grabbed[1]] = to # no digit is lost on the way there
		_dragged[body] = LineEdit2D.with_points(_dragged[body], points)
		_show(body)
	canvas.redraw()


# The body follows as long as it can; lines that it would refuse are only drawn, in red.
func _show(body: SoftBody2D) -> void:
	var refusal := problem_of(body, _dragged[body])
	if refusal == "":
		body.set(property(), value_of(_dragged[body]))
	else:
		problem = refusal


func _release() -> void:
	if _drag == Drag.BOX:
		for body in canvas.bodies:
			if canvas.is_editable(body):
				selection.add(body, PolygonEdit.points_in_box(canvas.to_screen(body) * LineEdit2D.points(lines_of(body)), box()))
	elif problem != "":
		_put_back()
		if _is_inserting:
			selection.clear()
		canvas.warn(Words.say("Refused, as it was before: %s.") % problem)
	else:
		var after := {}
		for body: SoftBody2D in _before:
			after[body] = LineEdit2D.copy(lines_of(body))
		_commit(action_name("Insert" if _is_inserting else "Move"), _before, after)
	_end_drag()
	canvas.redraw()


func _put_back() -> void:
	for body: SoftBody2D in _before:
		if is_instance_valid(body) and not BodyValues.is_same_value(body.get(property()), value_of(_before[body])):
			body.set(property(), value_of(_before[body]))


func _commit(action: String, before: Dictionary, after: Dictionary) -> void:
	var changes: Array[Dictionary] = []
	for body: SoftBody2D in after:
		var old: Variant = value_of(before[body])
		var new: Variant = value_of(after[body])
		if not BodyValues.is_same_value(old, new):
			changes.append({"object": body, "property": property(), "before": old, "after": new})
	canvas.commit(action, {}, {}, changes)


func _end_drag() -> void:
	_drag = Drag.NONE
	_before = {}
	_dragged = {}
	_is_inserting = false
	problem = ""
	box_from = Vector2.INF
	box_to = Vector2.INF


# Looking.

func _find(place: Vector2) -> Array:
	var found := []
	var least := canvas.grab_radius()
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var points := canvas.to_screen(body) * LineEdit2D.points(lines_of(body))
			var index := PolygonEdit.nearest_point(points, place, least)
			if index >= 0:
				least = points[index].distance_to(place)
				found = [body, index]
	return found


func _find_edge(place: Vector2) -> Array:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var edge := LineEdit2D.nearest_edge(_on_screen(body, lines_of(body)), _closed, place, canvas.grab_radius())
			if edge >= 0:
				return [body, edge]
	return []


func _find_hover(place: Vector2) -> void:
	var point := _find(place)
	var edge := [] if not point.is_empty() else _find_edge(place)
	if point != _hover or edge != _hover_edge or not edge.is_empty():
		_hover = point
		_hover_edge = edge
		canvas.redraw()


func _on_screen(body: SoftBody2D, lines: Array[PackedVector2Array]) -> Array[PackedVector2Array]:
	var view := canvas.to_screen(body)
	var placed: Array[PackedVector2Array] = []
	for line in lines:
		placed.append(view * line)
	return placed


# Drawing.

func draw(overlay: Control) -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			draw_body(overlay, body)
	if is_boxing():
		canvas.draw_box(overlay, box())
	if drawing.is_on and not canvas.bodies.is_empty():
		drawing.draw(overlay, canvas.bodies[0])
	if problem != "":
		canvas.draw_text(overlay, _mouse + Vector2(16, 24) * canvas.scale(), problem, BodyCanvas.BAD)


func draw_body(overlay: Control, body: SoftBody2D) -> void:
	var lines: Array[PackedVector2Array] = _dragged.get(body, lines_of(body))
	var is_bad := problem != "" and not BodyValues.is_same_value(lines, lines_of(body))
	var color := Color(BodyCanvas.LINE, 0.35) if drawing.is_on else (BodyCanvas.BAD if is_bad else BodyCanvas.LINE)
	for line in _on_screen(body, lines):
		if _closed:
			canvas.draw_outline(overlay, line, color, 2)
		elif line.size() >= 2:
			overlay.draw_polyline(line, color, 2 * canvas.scale(), true)
	if drawing.is_on:
		return
	var points := canvas.to_screen(body) * LineEdit2D.points(lines)
	for i in points.size():
		var is_chosen := selection.has(body, i)
		var ink := (BodyCanvas.BAD if is_bad else BodyCanvas.SELECTED) if is_chosen else BodyCanvas.LINE
		canvas.draw_point(overlay, points[i], ink, is_chosen or _hover == [body, i])
	if _drag == Drag.NONE and not _hover_edge.is_empty() and _hover_edge[0] == body and _hover_edge[1] < points.size():
		var edge: int = _hover_edge[1]
		var on_edge := Geometry2D.get_closest_point_to_segment(_mouse, points[edge], points[LineEdit2D.next_of(lines, edge)])
		canvas.draw_point(overlay, on_edge, Color(BodyCanvas.SELECTED, 0.6))
