# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Handles for values of a whole body: its radius, to the right of it, and its pressure, an arrow out of its upper edge.

const BodyCanvas := preload("body_canvas.gd")
const BodyValues := preload("../logic/body_values.gd")
const PolygonEdit := preload("../logic/polygon_edit.gd")
const Words := preload("../logic/words.gd")
const Advice := preload("../logic/stability_advice.gd")

enum Kind { NONE, RADIUS, PRESSURE }

const DISTANCE := 26.0
## Length of the arrow for a pressure of twice the stiffness, which is usual [px on the screen].
const ARROW := 60.0
const LEAST_RADIUS := 1.0

var _canvas: BodyCanvas
var _kind := Kind.NONE
var _body: SoftBody2D
var _before := {}
var _pressures := {}
var _press := Vector2.ZERO
var _text := ""


func _init(canvas: BodyCanvas) -> void:
	_canvas = canvas


## Mean distance of the polygon's points from their mean: of a circle its radius.
static func radius_of(polygon: PackedVector2Array) -> float:
	var center := PolygonEdit.mean(polygon)
	var sum := 0.0
	for point in polygon:
		sum += point.distance_to(center)
	return sum / maxf(1, polygon.size())


## The polygon with another radius, about its mean, in the body's own plane.
static func with_radius(polygon: PackedVector2Array, radius: float) -> PackedVector2Array:
	var center := PolygonEdit.mean(polygon)
	var factor := maxf(radius, LEAST_RADIUS) / maxf(radius_of(polygon), 1e-6)
	return Transform2D(0, center) * Transform2D(0, Vector2(factor, factor), 0, Vector2.ZERO) * Transform2D(0,
			-center) * polygon


func press(place: Vector2) -> bool:
	cancel()
	for body in _canvas.bodies:
		if not _canvas.is_editable(body):
			continue
		if _radius_place(body).distance_to(place) <= _canvas.grab_radius():
			_kind = Kind.RADIUS
		elif _has_pressure(body) and _pressure_place(body).distance_to(place) <= _canvas.grab_radius():
			if body.soft_body_material != null:
				_canvas.warn(Words.say("The pressure of '%s' comes from its material: change it there.") % body.name)
				return false
			_kind = Kind.PRESSURE
		else:
			continue
		_body = body
		_press = place
		_before = _canvas.take_values()
		for other in _canvas.bodies:
			_pressures[other] = other.pressure
		return true
	return false


func drag(place: Vector2) -> void:
	if _kind == Kind.RADIUS:
		var inverse := _canvas.to_screen(_body).affine_inverse()
		var polygon: PackedVector2Array = _before[_body][&"polygon"]
		var center := PolygonEdit.mean(polygon)
		var reach := (inverse * _canvas.snapped_on_screen(_body, place - (_press - _edge_place(polygon)))).distance_to(center)
		var first := (inverse * _edge_place(polygon)).distance_to(center)
		var factor := reach / maxf(first, 1e-6)
		for body in _canvas.bodies:
			var resized := with_radius(_before[body][&"polygon"], radius_of(_before[body][&"polygon"]) * factor)
			if SoftBody2D.get_polygon_problem(resized) == "":
				body.polygon = resized
				_resize_holes(body, resized)
				if not _before[body][&"inner_points"].is_empty():
					var real := radius_of(resized) / radius_of(_before[body][&"polygon"])
					var middle := PolygonEdit.mean(resized)
					body.inner_points = Transform2D(0, middle) * Transform2D(0, Vector2(real, real), 0,
							Vector2.ZERO) * Transform2D(0, -middle) * (_before[body][&"inner_points"] as PackedVector2Array)
		_text = Words.say("radius %s px") % Advice.number(radius_of(_body.polygon))
	elif _kind == Kind.PRESSURE:
		var unit := 2 * _body.stiffness / (ARROW * _canvas.scale())
		var pressure: float = maxf(0, _pressures[_body] + (_press.y - place.y) * unit)
		if pressure < 2 * unit:
			pressure = 0
		for body in _canvas.bodies:
			if body.soft_body_material == null and _has_pressure(body):
				body.pressure = Advice.rounded_up(pressure)
		_text = Words.say("pressure %s N/m") % Advice.number(_body.pressure)
	_canvas.redraw()


# They keep their places beside the polygon.
func _resize_holes(body: SoftBody2D, resized: PackedVector2Array) -> void:
	var holes: Array[PackedVector2Array] = []
	var factor := radius_of(resized) / radius_of(_before[body][&"polygon"])
	var center := PolygonEdit.mean(_before[body][&"polygon"])
	for hole: PackedVector2Array in _before[body][&"holes"]:
		holes.append(Transform2D(0, PolygonEdit.mean(resized)) * Transform2D(0, Vector2(factor, factor), 0, Vector2.ZERO) * Transform2D(0, -center) * hole)
	if not holes.is_empty() and SoftBody2D.get_holes_problem(holes, resized) == "":
		body.holes = holes


func release() -> void:
	if _kind == Kind.RADIUS:
		_canvas.commit(Words.say("Change Radius"), _before, _canvas.take_values())
	elif _kind == Kind.PRESSURE:
		var changes: Array[Dictionary] = []
		for body: SoftBody2D in _pressures:
			if body.pressure != _pressures[body]:
				changes.append({"object": body, "property": &"pressure", "before": _pressures[body], "after": body.pressure})
		_canvas.commit(Words.say("Change Pressure"), {}, {}, changes)
	_forget()


func cancel() -> void:
	if _kind != Kind.NONE:
		for body: SoftBody2D in _before:
			if is_instance_valid(body):
				BodyValues.put(body, _before[body])
				if _kind == Kind.PRESSURE:
					body.pressure = _pressures[body]
	_forget()


func _forget() -> void:
	_kind = Kind.NONE
	_before = {}
	_pressures = {}
	_text = ""


func draw(overlay: Control) -> void:
	var color := Color(BodyCanvas.LINE, 0.9)
	for body in _canvas.bodies:
		if not _canvas.is_editable(body):
			continue
		var radius_place := _radius_place(body)
		var edge := radius_place - Vector2(DISTANCE * _canvas.scale(), 0)
		overlay.draw_line(edge, radius_place, color, _canvas.scale(), true)
		_canvas.draw_square(overlay, radius_place, color)
		var tip := _pressure_place(body)
		if _has_pressure(body):
			overlay.draw_line(_top(body), tip, color, 2 * _canvas.scale(), true)
			var head := 6 * _canvas.scale()
			overlay.draw_colored_polygon([tip + Vector2(0, -head), tip + Vector2(-head, head / 2), tip + Vector2(head,
					head / 2)], color)
		if _body == body and _kind != Kind.NONE:
			var place := radius_place if _kind == Kind.RADIUS else tip
			_canvas.draw_text(overlay, place + Vector2(14, 4) * _canvas.scale(), _text, BodyCanvas.SELECTED)


func _box(body: SoftBody2D) -> Rect2:
	return PolygonEdit.bounds(_canvas.to_screen(body) * body.polygon)


# The middle of the right edge of its box on the screen.
func _edge_place(polygon: PackedVector2Array) -> Vector2:
	var box := PolygonEdit.bounds(_canvas.to_screen(_body) * polygon)
	return Vector2(box.end.x, box.get_center().y)


func _radius_place(body: SoftBody2D) -> Vector2:
	var box := _box(body)
	return Vector2(box.end.x + DISTANCE * _canvas.scale(), box.get_center().y)


func _top(body: SoftBody2D) -> Vector2:
	var box := _box(body)
	return Vector2(box.get_center().x, box.position.y)


# A material holds its area by itself, and a pressure would make a network of it.
func _has_pressure(body: SoftBody2D) -> bool:
	return body.get_elastic_model_in_use() == SoftBody2D.ELASTIC_MODEL_NETWORK


func _pressure_place(body: SoftBody2D) -> Vector2:
	var length := ARROW * body.pressure / maxf(2 * body.stiffness, 1e-6)
	return _top(body) - Vector2(0, (DISTANCE + length) * _canvas.scale())
