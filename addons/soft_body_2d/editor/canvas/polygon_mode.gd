# SPDX-License-Identifier: MIT
@tool
extends "mode.gd"
## Shapes outlines: points are created, inserted, moved, turned, scaled and erased.

const PointDrawing := preload("point_drawing.gd")
const SelectionBox := preload("../logic/selection_box.gd")
const StructureRemap := preload("../logic/structure_remap.gd")
const ValueHandles := preload("value_handles.gd")

const HANDLE_DISTANCE := 28.0
const BOX_MARGIN := 12.0

enum Drag { NONE, POINTS, ROTATE, SCALE, HANDLE, BOX }

var handles: ValueHandles
## An outline that is being drawn, of the first body.
var drawing: PointDrawing
## Why the outline cannot be let go of as it is; empty when it can.
var problem := ""

var _drag := Drag.NONE
var _press := Vector2.ZERO
var _mouse := Vector2.ZERO
var _grabbed: Array = [] # body and index of the point under the mouse
var _grab_offset := Vector2.ZERO
var _before := {} # values of each body when the drag began
var _outlines := {} # polygons as they are dragged
var _begin_box := Rect2()
var _corner := -1
var _is_inserting := false
var _hover: Array = []
var _hover_edge: Array = []


func _init(p_canvas: BodyCanvas) -> void:
	super(p_canvas)
	handles = ValueHandles.new(p_canvas)
	drawing = PointDrawing.new(p_canvas, true)
	drawing.finished.connect(_close_drawing)
	drawing.given_up.connect(canvas.changed.emit)


func follow_bodies() -> void:
	var counts := PackedInt32Array()
	for body in canvas.bodies:
		counts.append(body.polygon.size())
	selection.keep_to(canvas.bodies, counts)


func cancel() -> void:
	super()
	if _drag in [Drag.POINTS, Drag.ROTATE, Drag.SCALE]:
		for body: SoftBody2D in _before:
			if is_instance_valid(body):
				BodyValues.put(body, _before[body])
	handles.cancel()
	_end_drag()
	drawing.clear()
	canvas.redraw()


func is_creating() -> bool:
	return drawing.is_on


func set_creating(enabled: bool) -> void:
	drawing.set_on(enabled)


func input(event: InputEvent) -> bool:
	if is_creating() and not canvas.bodies.is_empty():
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


# Creating.

func _close_drawing() -> void:
	var body := canvas.bodies[0]
	var refusal := SoftBody2D.get_polygon_problem(drawing.points)
	if refusal != "":
		canvas.warn(Words.say("This outline cannot be a polygon: %s.") % PolygonEdit.readable(refusal))
		return
	var before := {body: BodyValues.take(body)}
	canvas.commit(Words.say("Draw Polygon"), before, {body: StructureRemap.with_other_outline(before[body], drawing.points)})
	set_creating(false)
	canvas.changed.emit()


# Pressing.

func _press_left(event: InputEventMouseButton) -> bool:
	_press = event.position
	_mouse = event.position
	var shift := event.shift_pressed
	if not shift and _press_handle(event.position):
		return true
	var found := find_point(event.position, true)
	if not found.is_empty():
		if not canvas.may_edit():
			return true
		_grabbed = found
		if shift:
			selection.toggle(found[0], found[1])
			canvas.redraw()
			canvas.changed.emit()
			return true
		if not selection.has(found[0], found[1]):
			selection.clear()
			selection.add(found[0], [found[1]])
		_begin_points_drag()
		return true
	if shift:
		_drag = Drag.BOX
		box_from = event.position
		box_to = event.position
		return true
	var edge := _find_edge(event.position)
	if not edge.is_empty():
		if not canvas.may_edit():
			return true
		_insert(edge[0], edge[1], event.position)
		return true
	if not selection.is_empty():
		selection.clear() # only what is selected here is let go of, not the node
		canvas.redraw()
		canvas.changed.emit()
		return true
	return false


func _press_handle(place: Vector2) -> bool:
	if _has_box():
		var frame := _selection_box()
		var radius := canvas.grab_radius()
		if SelectionBox.rotation_handle(frame, HANDLE_DISTANCE * canvas.scale()).distance_to(place) <= radius:
			return _begin_box_drag(Drag.ROTATE, frame)
		var corners := SelectionBox.corners(frame)
		for i in 4:
			if corners[i].distance_to(place) <= radius:
				_corner = i
				return _begin_box_drag(Drag.SCALE, frame)
	if find_point(place, true).is_empty() and handles.press(place):
		if canvas.may_edit():
			_drag = Drag.HANDLE
		else:
			handles.cancel()
		return true
	return false


func _begin_box_drag(drag: Drag, frame: Rect2) -> bool:
	if not canvas.may_edit():
		return true
	_drag = drag
	_begin_box = frame
	_before = canvas.take_values()
	_outlines = {}
	return true


func _begin_points_drag() -> void:
	_drag = Drag.POINTS
	_before = canvas.take_values()
	_outlines = {}
	var body: SoftBody2D = _grabbed[0]
	_grab_offset = canvas.to_screen(body) * body.polygon[_grabbed[1]] - _press
	canvas.redraw()
	canvas.changed.emit()


func _insert(body: SoftBody2D, edge: int, place: Vector2) -> void:
	# The values before the point came are what undo restores: inserting and dragging on is one step.
	var before := canvas.take_values()
	var values: Dictionary = before[body]
	var outline := PolygonEdit.inserted(values[&"polygon"], edge, canvas.to_body(body, place))
	var old_points := PackedInt32Array(range(values[&"polygon"].size()))
	old_points.insert(edge + 1, StructureRemap.NEW)
	var refusal := SoftBody2D.get_polygon_problem(outline)
	if refusal != "":
		canvas.warn(Words.say("No point can be inserted here: %s.") % PolygonEdit.readable(refusal))
		return
	BodyValues.put(body, StructureRemap.with_polygon(values, outline, old_points))
	selection.clear()
	selection.add(body, [edge + 1])
	_grabbed = [body, edge + 1]
	_press = place
	_begin_points_drag()
	_before = before
	_is_inserting = true


func _press_right(event: InputEventMouseButton) -> bool:
	if _drag != Drag.NONE:
		cancel()
		return true
	var found := find_point(event.position, true)
	if found.is_empty():
		return false
	if not canvas.may_edit():
		return true
	if selection.has(found[0], found[1]):
		_erase_selected()
	else:
		_erase({found[0]: PackedInt32Array([found[1]])})
	return true


func _erase_selected() -> void:
	if not canvas.may_edit():
		return
	var chosen := {}
	for body in canvas.bodies:
		var indices := selection.of(body)
		if not indices.is_empty():
			chosen[body] = indices
	_erase(chosen)


func _erase(chosen: Dictionary) -> void:
	var before := {}
	var after := {}
	for body: SoftBody2D in chosen:
		before[body] = BodyValues.take(body)
		var outline := PolygonEdit.erased(before[body][&"polygon"], chosen[body])
		var refusal := SoftBody2D.get_polygon_problem(outline)
		if refusal != "":
			canvas.warn(Words.say("These points of '%s' cannot be erased: %s.") % [body.name, PolygonEdit.readable(refusal)])
			return
		var old_points := PackedInt32Array()
		for i in before[body][&"polygon"].size():
			if not i in chosen[body]:
				old_points.append(i)
		after[body] = StructureRemap.with_polygon(before[body], outline, old_points)
	selection.clear()
	canvas.commit(Words.say("Erase Polygon Points"), before, after)


# Moving.

func _move(event: InputEventMouseMotion) -> bool:
	_mouse = event.position
	match _drag:
		Drag.NONE:
			_find_hover(event.position)
			return false
		Drag.BOX:
			box_to = event.position
			canvas.redraw()
		Drag.HANDLE:
			handles.drag(event.position)
		Drag.POINTS:
			_drag_points(event.position)
		Drag.ROTATE:
			var turn := SelectionBox.rotation_about(_begin_box.get_center(), _press, event.position, event.ctrl_pressed)
			_transform_on_screen(turn)
		Drag.SCALE:
			var corners := SelectionBox.corners(_begin_box)
			var anchor := _begin_box.get_center() if event.alt_pressed else corners[(_corner + 2) % 4]
			_transform_on_screen(SelectionBox.scale_about(anchor, corners[_corner], canvas.snapped_on_screen(canvas.bodies[0],
					event.position), event.shift_pressed))
	return true


# The point under the mouse goes to the grid; the others keep their places beside it.
func _drag_points(place: Vector2) -> void:
	var grabbed: SoftBody2D = _grabbed[0]
	var first: PackedVector2Array = _outlines.get(grabbed, grabbed.polygon) if not _outlines.is_empty() else grabbed.polygon
	if _outlines.is_empty():
		for body in canvas.bodies:
			_outlines[body] = body.polygon
		first = _outlines[grabbed]
	var to := canvas.to_body(grabbed, place + _grab_offset)
	var from := first[_grabbed[1]]
	if to == from:
		return
	var way := canvas.to_screen(grabbed).basis_xform(to - from)
	problem = ""
	for body in canvas.bodies:
		var chosen := selection.of(body)
		if not chosen.is_empty():
			var by := to - from if body == grabbed else canvas.to_screen(body).affine_inverse().basis_xform(way)
			_outlines[body] = PolygonEdit.moved(_outlines[body], chosen, by)
			if body == grabbed:
				_outlines[body][_grabbed[1]] = to # no digit is lost on the way there
			_show_outline(body)
	canvas.redraw()


func _transform_on_screen(by: Transform2D) -> void:
	problem = ""
	for body in canvas.bodies:
		var chosen := selection.of(body)
		if not chosen.is_empty():
			var view := canvas.to_screen(body)
			_outlines[body] = PolygonEdit.transformed(_before[body][&"polygon"], chosen, view.affine_inverse() * by * view)
			_show_outline(body)
	canvas.redraw()


# The body follows as long as it can; a polygon that it would refuse is only drawn, in red.
func _show_outline(body: SoftBody2D) -> void:
	var refusal := SoftBody2D.get_polygon_problem(_outlines[body])
	if refusal == "":
		body.polygon = _outlines[body]
	else:
		problem = PolygonEdit.readable(refusal)


func _release() -> void:
	match _drag:
		Drag.BOX:
			for body in canvas.bodies:
				if canvas.is_editable(body):
					selection.add(body, PolygonEdit.points_in_box(canvas.to_screen(body) * body.polygon, box()))
			canvas.changed.emit()
		Drag.HANDLE:
			handles.release()
		_:
			if problem != "":
				for body: SoftBody2D in _before:
					BodyValues.put(body, _before[body])
				if _is_inserting:
					selection.clear()
				canvas.warn(Words.say("Refused, as it was before: %s.") % problem)
			else:
				var action := Words.say("Move Polygon Points")
				if _is_inserting:
					action = Words.say("Insert Polygon Point")
				elif _drag == Drag.ROTATE:
					action = Words.say("Rotate Polygon Points")
				elif _drag == Drag.SCALE:
					action = Words.say("Scale Polygon Points")
				var after := canvas.take_values()
				for body: SoftBody2D in after:
					after[body] = StructureRemap.with_other_hull(_before[body], after[body]) if not _is_inserting else after[body]
				canvas.commit(action, _before, after)
	_end_drag()
	canvas.redraw()


func _end_drag() -> void:
	_drag = Drag.NONE
	_before = {}
	_outlines = {}
	_is_inserting = false
	problem = ""
	box_from = Vector2.INF
	box_to = Vector2.INF


# Looking.

func _find_edge(place: Vector2) -> Array:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var edge := PolygonEdit.nearest_edge(canvas.to_screen(body) * body.polygon, place, canvas.grab_radius())
			if edge >= 0:
				return [body, edge]
	return []


func _find_hover(place: Vector2) -> void:
	var point := find_point(place, true)
	var edge := [] if not point.is_empty() else _find_edge(place)
	if point != _hover or edge != _hover_edge or not edge.is_empty():
		_hover = point
		_hover_edge = edge
		canvas.redraw()


func _has_box() -> bool:
	return selection.size() >= 2


func _selection_box() -> Rect2:
	var places := PackedVector2Array()
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var points := canvas.to_screen(body) * body.polygon
			for index in selection.of(body):
				places.append(points[index])
	return PolygonEdit.bounds(places).grow(BOX_MARGIN * canvas.scale())


# Drawing.

func draw(overlay: Control) -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			_draw_body(overlay, body)
	if not is_creating() and (_drag == Drag.NONE or _drag == Drag.HANDLE):
		handles.draw(overlay)
	if _has_box() and _drag in [Drag.NONE, Drag.POINTS]:
		_draw_selection_box(overlay)
	if is_boxing():
		canvas.draw_box(overlay, box())
	if is_creating() and not canvas.bodies.is_empty():
		drawing.draw(overlay, canvas.bodies[0])
	if problem != "":
		canvas.draw_text(overlay, _mouse + Vector2(16, 24) * canvas.scale(), problem, BodyCanvas.BAD)


func _draw_body(overlay: Control, body: SoftBody2D) -> void:
	var outline: PackedVector2Array = _outlines.get(body, body.polygon)
	var is_bad := problem != "" and outline != body.polygon
	var points := canvas.to_screen(body) * outline
	if is_creating():
		canvas.draw_outline(overlay, points, Color(BodyCanvas.LINE, 0.35))
		return
	canvas.draw_outline(overlay, points, BodyCanvas.LINE, 2)
	if is_bad:
		for edge in PolygonEdit.crossing_edges(outline, selection.of(body)):
			overlay.draw_line(points[edge], points[(edge + 1) % points.size()], BodyCanvas.BAD, 3 * canvas.scale(), true)
	for i in points.size():
		var color := BodyCanvas.LINE
		if selection.has(body, i):
			color = BodyCanvas.BAD if is_bad else BodyCanvas.SELECTED
		canvas.draw_point(overlay, points[i], color, _hover == [body, i] or selection.has(body, i))
	if _drag == Drag.NONE and not _hover_edge.is_empty() and _hover_edge[0] == body and not is_creating():
		var edge: int = _hover_edge[1]
		if edge < points.size():
			var on_edge := Geometry2D.get_closest_point_to_segment(_mouse, points[edge], points[(edge + 1) % points.size()])
			canvas.draw_point(overlay, on_edge, Color(BodyCanvas.SELECTED, 0.6))


func _draw_selection_box(overlay: Control) -> void:
	var frame := _selection_box()
	var color := Color(BodyCanvas.SELECTED, 0.7)
	overlay.draw_rect(frame, color, false, canvas.scale())
	for corner in SelectionBox.corners(frame):
		canvas.draw_square(overlay, corner, BodyCanvas.SELECTED)
	var handle := SelectionBox.rotation_handle(frame, HANDLE_DISTANCE * canvas.scale())
	overlay.draw_line(Vector2(frame.get_center().x, frame.position.y), handle, color, canvas.scale(), true)
	canvas.draw_point(overlay, handle, BodyCanvas.SELECTED, true)
