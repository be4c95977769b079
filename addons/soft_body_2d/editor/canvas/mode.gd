# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## A way of editing bodies on the canvas: takes the input that is meant for it and draws what it shows.

const BodyCanvas := preload("body_canvas.gd")
const BodyValues := preload("../logic/body_values.gd")
const PolygonEdit := preload("../logic/polygon_edit.gd")
const Selection := preload("../logic/selection.gd")
const Words := preload("../logic/words.gd")

var canvas: BodyCanvas
var selection := Selection.new()
## While a box is drawn around things.
var box_from := Vector2.INF
var box_to := Vector2.INF


func _init(p_canvas: BodyCanvas) -> void:
	canvas = p_canvas


## True when the event has been used.
func input(_event: InputEvent) -> bool:
	return false


func draw(_overlay: Control) -> void:
	pass


## Ends what was begun, as it was before: another mode, another body, Escape.
func cancel() -> void:
	box_from = Vector2.INF


## Whether a new line of points is being drawn.
func is_creating() -> bool:
	return false


func set_creating(_enabled: bool) -> void:
	pass


## Another body, or one that has changed: forgets what is selected of points that are no more.
func follow_bodies() -> void:
	pass


## The request that is shown when a change needs a selection and nothing is selected.
func selection_request() -> String:
	return ""


## Changes the bodies of which something is selected, in one step of undo: [param change] gets a body, its values and what
## is chosen of it, and gives the new values.
func change_selected(action: String, change: Callable) -> void:
	if not canvas.may_edit():
		return
	var before := {}
	var after := {}
	for body in canvas.bodies:
		var chosen := selection.of(body)
		if not chosen.is_empty():
			before[body] = BodyValues.take(body)
			after[body] = change.call(body, before[body], chosen)
	if after.is_empty():
		canvas.tell(selection_request())
	canvas.commit(action, before, after)


func is_boxing() -> bool:
	return box_from != Vector2.INF


func box() -> Rect2:
	return Rect2(box_from, box_to - box_from).abs()


func is_left(event: InputEvent, pressed: bool) -> bool:
	var button := event as InputEventMouseButton
	return button != null and button.button_index == MOUSE_BUTTON_LEFT and button.pressed == pressed


func is_right_press(event: InputEvent) -> bool:
	var button := event as InputEventMouseButton
	return button != null and button.button_index == MOUSE_BUTTON_RIGHT and button.pressed


func is_key(event: InputEvent, key: Key) -> bool:
	var pressed := event as InputEventKey
	return pressed != null and pressed.pressed and not pressed.echo and pressed.keycode == key


## The body and point nearest to a place of the overlay: [body, index], or an empty list.
func find_point(place: Vector2, polygon_only := false) -> Array:
	var found := []
	var least := canvas.grab_radius()
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var points := canvas.to_screen(body) * (body.polygon if polygon_only else BodyValues.points(BodyValues.take(body)))
			var index := PolygonEdit.nearest_point(points, place, least)
			if index >= 0:
				least = points[index].distance_to(place)
				found = [body, index]
	return found
