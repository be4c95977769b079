# SPDX-License-Identifier: MIT
@tool
extends "mode.gd"
## Shows springs by their stiffness: selects them, paints them, adds and takes them out.

const Brush := preload("../logic/brush.gd")
const SpringEdit := preload("../logic/spring_edit.gd")
const StiffnessColors := preload("../logic/stiffness_colors.gd")
const Advice := preload("../logic/stability_advice.gd")

enum Tool { SELECT, BRUSH, ADD }

## How long a brush has stayed where it moves on [s]: what a motion event paints.
const STROKE_TIME := 1.0 / 60
const STIFFNESS := &"spring_stiffness_scales"

var tool := Tool.SELECT:
	set(value):
		cancel()
		tool = value
		canvas.redraw()
var brush := Brush.new()

var _before := {}
var _is_painting := false
var _mouse := Vector2.INF
var _join_from := [] # body and point a new spring begins at
var _palette := StiffnessColors.new()


func selection_request() -> String:
	return Words.say("Select springs first: click them, or draw a box around them.")


func follow_bodies() -> void:
	var counts := PackedInt32Array()
	for body in canvas.bodies:
		counts.append(body.get_spring_count())
	selection.keep_to(canvas.bodies, counts)


func cancel() -> void:
	super()
	if _is_painting:
		for body: SoftBody2D in _before:
			if is_instance_valid(body):
				BodyValues.put(body, _before[body])
	_is_painting = false
	_before = {}
	_join_from = []


## "All polygon", "all inner".
func select_kind(kind: int) -> void:
	selection.clear()
	for body in canvas.bodies:
		selection.add(body, SpringEdit.of_kind(body.get_all_springs(), body.get_simulated_polygon().size(), kind))
	canvas.redraw()
	canvas.changed.emit()


func select_all() -> void:
	for body in canvas.bodies:
		selection.add(body, PackedInt32Array(range(body.get_spring_count())))
	canvas.redraw()
	canvas.changed.emit()


func select_none() -> void:
	selection.clear()
	canvas.redraw()
	canvas.changed.emit()


## Sets a factor of all selected springs.
func set_scale(property: StringName, scale: float) -> void:
	change_selected(Words.say("Set Springs"),
			func(_body: SoftBody2D, values: Dictionary, chosen: PackedInt32Array) -> Dictionary:
				return SpringEdit.with_scale(values, property, chosen, scale))


func remove_selected() -> void:
	change_selected(Words.say("Remove Springs"),
			func(_body: SoftBody2D, values: Dictionary, chosen: PackedInt32Array) -> Dictionary:
				var after := SpringEdit.without_springs(values, chosen)
				if is_same(after, values):
					canvas.warn(Words.say("A body keeps at least one spring: without any it would get the automatic ones."))
				return after)
	selection.clear()
	canvas.changed.emit()


func input(event: InputEvent) -> bool:
	if event is InputEventMouseMotion:
		return _move(event)
	if is_key(event, KEY_ESCAPE):
		var was_busy := _is_painting or is_boxing() or not _join_from.is_empty() or not selection.is_empty()
		cancel()
		select_none()
		return was_busy
	if is_key(event, KEY_DELETE) and not selection.is_empty():
		remove_selected()
		return true
	if is_left(event, true):
		_press(event)
		return true
	if is_left(event, false):
		_release()
		return true
	if is_right_press(event):
		_erase(event.position)
		return true
	return false


func _press(event: InputEventMouseButton) -> void:
	match tool:
		Tool.SELECT:
			if not event.shift_pressed:
				selection.clear()
			var found := _find_spring(event.position)
			if found.is_empty():
				box_from = event.position
				box_to = event.position
			else:
				selection.toggle(found[0], found[1])
			canvas.changed.emit()
		Tool.BRUSH:
			if canvas.may_edit():
				_is_painting = true
				_before = canvas.take_values()
				_paint(event.position)
		Tool.ADD:
			if not canvas.may_edit():
				return
			_join_from = find_point(event.position)
			if _join_from.is_empty():
				_add_inner_point(event.position)
	canvas.redraw()


func _move(event: InputEventMouseMotion) -> bool:
	_mouse = event.position
	canvas.redraw()
	if is_boxing():
		box_to = event.position
		return true
	if _is_painting:
		_paint(event.position)
		return true
	return not _join_from.is_empty()


func _release() -> void:
	if is_boxing():
		for body in canvas.bodies:
			if canvas.is_editable(body):
				var points := canvas.to_screen(body) * BodyValues.points(BodyValues.take(body))
				selection.add(body, SpringEdit.in_box(points, body.get_all_springs(), box()))
		box_from = Vector2.INF
		canvas.changed.emit()
	elif _is_painting:
		_is_painting = false
		canvas.commit(Words.say("Paint Spring Stiffness"), _before, canvas.take_values())
		_before = {}
	elif not _join_from.is_empty():
		_join(_join_from, find_point(_mouse))
		_join_from = []
	canvas.redraw()


# The brush is round in the plane of the scene: zooming in makes it no finer.
func _paint(place: Vector2) -> void:
	for body in canvas.bodies:
		if not canvas.is_editable(body):
			continue
		var values := BodyValues.take(body)
		var springs := body.get_all_springs()
		var factors := SpringEdit.scales(values, STIFFNESS, springs.size() / 2)
		var points := body.get_global_transform() * BodyValues.points(values)
		var in_scene := canvas.scene_to_screen(body).affine_inverse() * place
		var painted := brush.painted(factors, points, springs, in_scene, STROKE_TIME * 6)
		if painted != factors:
			body.spring_stiffness_scales = painted
	canvas.redraw()


func _join(from: Array, to: Array) -> void:
	if to.is_empty() or to[0] != from[0] or to[1] == from[1]:
		return
	var body: SoftBody2D = from[0]
	var before := {body: BodyValues.take(body)}
	var after := SpringEdit.with_spring(before[body], from[1], to[1])
	if is_same(after, before[body]):
		canvas.tell(Words.say("Points %d and %d are joined already.") % [from[1], to[1]])
	canvas.commit(Words.say("Add Spring"), before, {body: after})


func _add_inner_point(place: Vector2) -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var local := canvas.to_body(body, place)
			if Geometry2D.is_point_in_polygon(local, body.polygon):
				var before := {body: BodyValues.take(body)}
				canvas.commit(Words.say("Add Inner Point"), before, {body: SpringEdit.with_inner_point(before[body], local)})
				return
	canvas.tell(Words.say("Inner points belong inside the polygon. Drag from point to point to add a spring."))


func _erase(place: Vector2) -> void:
	if not canvas.may_edit():
		return
	var point := find_point(place)
	if not point.is_empty() and tool == Tool.ADD:
		var body: SoftBody2D = point[0]
		var inner: int = point[1] - body.get_simulated_polygon().size()
		if inner >= 0 and inner < body.inner_points.size():
			var before := {body: BodyValues.take(body)}
			canvas.commit(Words.say("Remove Inner Point"), before, {body: SpringEdit.without_inner_point(before[body], inner)})
			return
	var found := _find_spring(place)
	if not found.is_empty():
		selection.clear()
		selection.add(found[0], [found[1]])
		remove_selected()


func _find_spring(place: Vector2) -> Array:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			var points := canvas.to_screen(body) * BodyValues.points(BodyValues.take(body))
			var index := SpringEdit.nearest(points, body.get_all_springs(), place, canvas.grab_radius())
			if index >= 0:
				return [body, index]
	return []


# Drawing.

func draw(overlay: Control) -> void:
	_palette.clear()
	for body in canvas.bodies:
		_palette.include(body.stiffness, body.spring_stiffness_scales)
	for body in canvas.bodies:
		if canvas.is_editable(body):
			_draw_body(overlay, body)
	if is_boxing():
		canvas.draw_box(overlay, box())
	if not canvas.bodies.is_empty():
		_draw_legend(overlay)
	if tool == Tool.BRUSH and _mouse != Vector2.INF and not canvas.bodies.is_empty():
		var radius: float = brush.radius * canvas.scene_to_screen(canvas.bodies[0]).get_scale().x
		overlay.draw_arc(_mouse, radius, 0, TAU, 48, BodyCanvas.SELECTED, canvas.scale(), true)
		overlay.draw_arc(_mouse, radius * (1 - brush.falloff), 0, TAU, 48, Color(BodyCanvas.SELECTED, 0.5), canvas.scale(),
				true)


func _draw_body(overlay: Control, body: SoftBody2D) -> void:
	var points := canvas.to_screen(body) * BodyValues.points(BodyValues.take(body))
	var springs := body.get_all_springs()
	var count := springs.size() / 2
	var stiffness := body.stiffness
	var factors := body.spring_stiffness_scales
	var painted := factors.size() == count
	var lines := PackedVector2Array()
	var colors := PackedColorArray()
	lines.resize(2 * count)
	colors.resize(count)
	for i in count:
		lines[2 * i] = points[springs[2 * i]]
		lines[2 * i + 1] = points[springs[2 * i + 1]]
		colors[i] = _palette.color_of(stiffness * (factors[i] if painted else 1.0))
	if count > 0:
		var chosen := selection.of(body)
		if not chosen.is_empty():
			var halo := PackedVector2Array()
			for index in chosen:
				if index < count:
					halo.append_array([lines[2 * index], lines[2 * index + 1]])
			overlay.draw_multiline(halo, BodyCanvas.SELECTED, 6 * canvas.scale(), true)
		overlay.draw_multiline_colors(lines, colors, 2.5 * canvas.scale(), true)
	var hull_count := body.get_simulated_polygon().size()
	for i in points.size():
		canvas.draw_point(overlay, points[i], BodyCanvas.LINE if i < hull_count else Color("b8c4d0"))
	if not _join_from.is_empty() and _join_from[0] == body:
		overlay.draw_line(points[_join_from[1]], _mouse, BodyCanvas.SELECTED, 2 * canvas.scale(), true)


func _draw_legend(overlay: Control) -> void:
	var bar := Rect2(Vector2(48, 64) * canvas.scale(), Vector2(180, 12) * canvas.scale())
	overlay.draw_rect(bar.grow(6 * canvas.scale()).grow_side(SIDE_BOTTOM, 18 * canvas.scale()), Color(0, 0, 0, 0.55))
	const STEPS := 24
	for i in STEPS:
		var part := Rect2(bar.position + Vector2(bar.size.x * i / STEPS, 0), Vector2(bar.size.x / STEPS + 1, bar.size.y))
		overlay.draw_rect(part, _palette.ramp((i + 0.5) / STEPS))
	var below := bar.position + Vector2(0, bar.size.y + 16 * canvas.scale())
	canvas.draw_text(overlay, below, Advice.number(_palette.least), BodyCanvas.SELECTED)
	canvas.draw_text(overlay, below + Vector2(bar.size.x - 60 * canvas.scale(), 0),
			"%s N/m" % Advice.number(_palette.most), BodyCanvas.SELECTED)
