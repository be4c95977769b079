# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## A new line of points, drawn click by click: an outline, a hole, the path of a rope.

const BodyCanvas := preload("body_canvas.gd")
const Words := preload("../logic/words.gd")

## The line is to be closed, or to end where it does.
signal finished
## Escape with nothing drawn: no line is wanted.
signal given_up

## In the coordinates of `body`.
var points := PackedVector2Array()
var is_on := false
## Whether its last point is joined to its first one.
var is_closed := true

var _canvas: BodyCanvas
var _mouse := Vector2.ZERO


func _init(canvas: BodyCanvas, closed: bool) -> void:
	_canvas = canvas
	is_closed = closed


func set_on(enabled: bool) -> void:
	is_on = enabled
	points = PackedVector2Array()
	_canvas.redraw()


func clear() -> void:
	points = PackedVector2Array()
	_canvas.redraw()


func input(event: InputEvent, body: SoftBody2D) -> bool:
	if event is InputEventMouseMotion:
		_mouse = event.position
		_canvas.redraw()
		return not points.is_empty()
	var key := event as InputEventKey
	if key != null and key.pressed and not key.echo:
		if key.keycode == KEY_ESCAPE:
			if points.is_empty():
				set_on(false)
				given_up.emit()
			clear()
			return true
		if key.keycode == KEY_ENTER:
			finished.emit()
			return true
	var button := event as InputEventMouseButton
	if button == null:
		return false
	if button.button_index == MOUSE_BUTTON_RIGHT and button.pressed and not points.is_empty():
		points.remove_at(points.size() - 1)
		_canvas.redraw()
		return true
	if button.button_index == MOUSE_BUTTON_LEFT and button.pressed:
		if _canvas.may_edit():
			_press(button.position, body)
		return true
	return button.button_index == MOUSE_BUTTON_LEFT


func _press(place: Vector2, body: SoftBody2D) -> void:
	var on_screen := _canvas.to_screen(body) * points
	var end := 0 if is_closed else points.size() - 1
	if points.size() >= (3 if is_closed else 2) and on_screen[end].distance_to(place) <= _canvas.grab_radius():
		finished.emit()
		return
	points.append(_canvas.to_body(body, place))
	_canvas.redraw()


func draw(overlay: Control, body: SoftBody2D) -> void:
	if points.is_empty() or not _canvas.is_editable(body):
		_canvas.draw_text(overlay, Vector2(48, 96) * _canvas.scale(),
				Words.say("Click to place points; click the first again to close.") if is_closed
				else Words.say("Click to place points; click the last again to end."), BodyCanvas.SELECTED)
		return
	var on_screen := _canvas.to_screen(body) * points
	var line := on_screen.duplicate()
	line.append(_canvas.snapped_on_screen(body, _mouse))
	overlay.draw_polyline(line, BodyCanvas.LINE, 2 * _canvas.scale(), true)
	var end := 0 if is_closed else on_screen.size() - 1
	for i in on_screen.size():
		_canvas.draw_point(overlay, on_screen[i], BodyCanvas.SELECTED if i == end else BodyCanvas.LINE, i == end)
