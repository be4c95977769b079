# SPDX-License-Identifier: MIT
@tool
extends "mode.gd"
## Paints how fine the simulated outline is kept, onto the points of the polygon, and shows the points that are simulated.

const Brush := preload("../logic/brush.gd")
const DetailPaint := preload("../logic/detail_paint.gd")
const StructureRemap := preload("../logic/structure_remap.gd")

## How long a brush has stayed where it moves on [s].
const STROKE_TIME := 1.0 / 10

var brush := Brush.new()

var _before := {}
var _is_painting := false
var _paints_back := false # towards 1, by the right button
var _mouse := Vector2.INF


func _init(p_canvas: BodyCanvas) -> void:
	super(p_canvas)
	brush.target = 4.0


func cancel() -> void:
	super()
	if _is_painting:
		for body: SoftBody2D in _before:
			if is_instance_valid(body):
				BodyValues.put(body, _before[body])
	_is_painting = false
	_before = {}


func input(event: InputEvent) -> bool:
	if event is InputEventMouseMotion:
		_mouse = event.position
		canvas.redraw()
		if _is_painting:
			_paint()
		return _is_painting
	if is_key(event, KEY_ESCAPE) and _is_painting:
		cancel()
		canvas.redraw()
		return true
	if is_left(event, true) or is_right_press(event):
		if _is_painting: # the other button takes the stroke back
			cancel()
		elif canvas.may_edit():
			_is_painting = true
			_paints_back = is_right_press(event)
			_before = canvas.take_values()
			_mouse = (event as InputEventMouseButton).position
			_paint()
		canvas.redraw()
		return true
	var button := event as InputEventMouseButton
	if button != null and not button.pressed and button.button_index in [MOUSE_BUTTON_LEFT, MOUSE_BUTTON_RIGHT]:
		if _is_painting:
			_is_painting = false
			var after := _tidied()
			var lost := PackedStringArray()
			for body: SoftBody2D in after:
				lost.append_array(StructureRemap.lost_springs(_before[body], after[body]))
			canvas.commit(Words.say("Paint Detail"), _before, after)
			canvas.tell_losses(lost)
			_before = {}
		return true
	return false


## Takes all weights away, in one step of undo.
func clear_weights() -> void:
	if not canvas.may_edit():
		return
	_commit_all(Words.say("Clear Detail Weights"), &"detail_weights", PackedFloat32Array())


## Simulates as few points as keep the outline within its tolerance, in one step of undo.
func set_automatic() -> void:
	if not canvas.may_edit():
		return
	_commit_all(Words.say("Set Detail to Automatic"), &"detail_mode", SoftBody2D.DETAIL_MODE_AUTOMATIC)


func _commit_all(action: String, property: StringName, value: Variant) -> void:
	var before := canvas.take_values()
	var after := {}
	var lost := PackedStringArray()
	for body in canvas.bodies:
		after[body] = BodyValues.copy(before[body])
		after[body][property] = value
		after[body] = StructureRemap.with_other_hull(before[body], after[body])
		lost.append_array(StructureRemap.lost_springs(before[body], after[body]))
	canvas.commit(action, before, after)
	canvas.tell_losses(lost)


# The brush is round in the plane of the scene: zooming in makes it no finer.
func _paint() -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var weights := DetailPaint.weights_of(body)
			var points := body.get_global_transform() * body.polygon
			var place := canvas.scene_to_screen(body).affine_inverse() * _mouse
			var painted := brush.painted_points(weights, points, place, 1.0 if _paints_back else brush.target, STROKE_TIME)
			if painted != weights:
				body.detail_weights = painted
	canvas.redraw()
	canvas.changed.emit()


# What the stroke has made: no weights where all of them are 1, pins at the nearest of the points that are simulated now.
func _tidied() -> Dictionary:
	var after := {}
	for body: SoftBody2D in _before:
		var values := BodyValues.take(body)
		values[&"detail_weights"] = DetailPaint.tidied(values[&"detail_weights"])
		after[body] = StructureRemap.with_other_hull(_before[body], values)
	return after


# Drawing.

func draw(overlay: Control) -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			_draw_body(overlay, body)
	if _mouse != Vector2.INF and not canvas.bodies.is_empty():
		var radius: float = brush.radius * canvas.scene_to_screen(canvas.bodies[0]).get_scale().x
		overlay.draw_arc(_mouse, radius, 0, TAU, 48, BodyCanvas.SELECTED, canvas.scale(), true)
		overlay.draw_arc(_mouse, radius * (1 - brush.falloff), 0, TAU, 48, Color(BodyCanvas.SELECTED, 0.5), canvas.scale(), true)


# The drawn outline in the color of its weights, and over it what is simulated.
func _draw_body(overlay: Control, body: SoftBody2D) -> void:
	var view := canvas.to_screen(body)
	var points := view * body.polygon
	var weights := DetailPaint.weights_of(body)
	for i in points.size():
		var next := (i + 1) % points.size()
		overlay.draw_line(points[i], points[next], DetailPaint.color_of((weights[i] + weights[next]) / 2), 5 * canvas.scale(), true)
	var simulated := view * body.get_simulated_polygon()
	canvas.draw_outline(overlay, simulated, Color(BodyCanvas.SELECTED, 0.8))
	for point in simulated:
		canvas.draw_point(overlay, point, BodyCanvas.SELECTED)
