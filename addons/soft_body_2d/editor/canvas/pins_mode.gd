# SPDX-License-Identifier: MIT
@tool
extends "mode.gd"
## Pins points and lets them go, and says what they follow.

const PinEdit := preload("../logic/pin_edit.gd")

const PIN := Color("ffd166")

var _hover := []


func selection_request() -> String:
	return Words.say("Select points first: click them, or draw a box around them.")


func follow_bodies() -> void:
	var counts := PackedInt32Array()
	for body in canvas.bodies:
		counts.append(body.get_point_count())
	selection.keep_to(canvas.bodies, counts)


func input(event: InputEvent) -> bool:
	if event is InputEventMouseMotion:
		if is_boxing():
			box_to = event.position
			canvas.redraw()
			return true
		var found := find_point(event.position)
		if found != _hover:
			_hover = found
			canvas.redraw()
		return false
	if is_key(event, KEY_ESCAPE):
		var was_busy := is_boxing() or not selection.is_empty()
		cancel()
		selection.clear()
		canvas.changed.emit()
		canvas.redraw()
		return was_busy
	if is_left(event, true):
		_press(event)
		return true
	if is_left(event, false):
		if is_boxing():
			for body in canvas.bodies:
				if canvas.is_editable(body):
					selection.add(body, PolygonEdit.points_in_box(canvas.to_screen(body) * BodyValues.points(BodyValues.take(body)),
							box()))
			box_from = Vector2.INF
			canvas.changed.emit()
			canvas.redraw()
		return true
	if is_right_press(event):
		_toggle_pin(event.position)
		return true
	return false


func _press(event: InputEventMouseButton) -> void:
	var found := find_point(event.position)
	if event.double_click and not found.is_empty():
		_toggle_pin(event.position)
		return
	if not event.shift_pressed:
		selection.clear()
	if found.is_empty():
		box_from = event.position
		box_to = event.position
	else:
		selection.toggle(found[0], found[1])
	canvas.changed.emit()
	canvas.redraw()


func _toggle_pin(place: Vector2) -> void:
	var found := find_point(place)
	if found.is_empty() or not canvas.may_edit():
		return
	var body: SoftBody2D = found[0]
	var before := {body: BodyValues.take(body)}
	var pinned := not body.is_point_pinned(found[1])
	canvas.commit(Words.say("Pin Point") if pinned else Words.say("Unpin Point"), before,
			{body: PinEdit.with_pins(before[body], [found[1]], pinned)})


## Pins what is selected, or lets it go.
func pin_selected(pinned: bool) -> void:
	change_selected(Words.say("Pin Points") if pinned else Words.say("Unpin Points"),
			func(_body: SoftBody2D, values: Dictionary, chosen: PackedInt32Array) -> Dictionary:
				return PinEdit.with_pins(values, chosen, pinned))


## Has what is selected follow a node; null is the world.
func assign_selected(target: Node2D) -> void:
	for body in canvas.bodies:
		if target == body and not selection.of(body).is_empty():
			canvas.warn(Words.say("A point of '%s' cannot follow the body itself. Choose another node.") % body.name)
			return
	change_selected(Words.say("Pin Points to Node"),
			func(body: SoftBody2D, values: Dictionary, chosen: PackedInt32Array) -> Dictionary:
				return PinEdit.with_target(values, chosen, body.get_path_to(target) if target != null else NodePath()))


func draw(overlay: Control) -> void:
	for body in canvas.bodies:
		if canvas.is_editable(body):
			_draw_body(overlay, body)
	if is_boxing():
		canvas.draw_box(overlay, box())


func _draw_body(overlay: Control, body: SoftBody2D) -> void:
	var view := canvas.to_screen(body)
	var points := view * BodyValues.points(BodyValues.take(body))
	canvas.draw_outline(overlay, view * body.polygon, Color(BodyCanvas.LINE, 0.6))
	for i in points.size():
		var pinned := body.is_point_pinned(i)
		if pinned:
			var target := body.get_node_or_null(body.get_pin_target(i)) as Node2D if body.get_pin_target(i) != NodePath() else null
			if target != null:
				overlay.draw_dashed_line(points[i], canvas.scene_to_screen(body) * target.global_position, PIN, canvas.scale(),
						6 * canvas.scale())
			_draw_pin(overlay, points[i], PIN if body.get_pin_target(i) == NodePath() or target != null else BodyCanvas.BAD)
		var color := BodyCanvas.SELECTED if selection.has(body, i) else (PIN if pinned else BodyCanvas.LINE)
		canvas.draw_point(overlay, points[i], color, selection.has(body, i) or _hover == [body, i])


func _draw_pin(overlay: Control, place: Vector2, color: Color) -> void:
	var size := canvas.scale()
	var head := place + Vector2(0, -14) * size
	overlay.draw_line(place, head, Color(0, 0, 0, 0.7), 4 * size, true)
	overlay.draw_line(place, head, color, 2 * size, true)
	overlay.draw_circle(head, 5 * size, Color(0, 0, 0, 0.7))
	overlay.draw_circle(head, 4 * size, color)
