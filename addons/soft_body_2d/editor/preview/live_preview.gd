# SPDX-License-Identifier: MIT
@tool
extends "../canvas/mode.gd"
## Plays copies of the bodies in the editor's viewport, on a floor that is only there for it. The nodes are not touched:
## their canvas items are hidden on the rendering server meanwhile, which no property shows.

const FLOOR_GAP := 0.6
## Ticks that are made up for at most when the editor was busy.
const MOST_TICKS := 4

var world: SoftBodyPreview2D
var floor_y := 0.0
## Ticks played so far.
var played := 0

var _played_bodies: Array[SoftBody2D] = []
var _triangles: Array[PackedInt32Array] = []
var _uvs: Array[PackedVector2Array] = []
var _point_counts := {} # of what was drawn last, by index: a body that tears gets others
var _owed := 0.0


func is_playing() -> bool:
	return world != null


func start() -> void:
	stop()
	var copied := SoftBodyPreview2D.new()
	var bounds := Rect2()
	for body in canvas.bodies:
		if not canvas.is_editable(body) or copied.add_body(body) < 0:
			continue
		var polygon := body.get_global_transform() * body.polygon
		var box := PolygonEdit.bounds(polygon)
		bounds = box if _played_bodies.is_empty() else bounds.merge(box)
		_played_bodies.append(body)
		_triangles.append(Geometry2D.triangulate_polygon(body.get_simulated_polygon()))
		_uvs.append(_uv_of(body))
	if _played_bodies.is_empty():
		canvas.warn(Words.say("There is nothing to play: select a SoftBody2D whose scale is not 0."))
		return
	floor_y = bounds.end.y + FLOOR_GAP * bounds.size.y
	copied.add_floor(Vector2(bounds.get_center().x, floor_y))
	world = copied
	played = 0
	_owed = 0.0
	_show_bodies(false)
	canvas.tell(Words.say("Playing: pull at the body with the mouse. Escape stops, and everything is as before."))
	canvas.changed.emit()


## Where the points of a body's copy are, in global coordinates; empty where none plays.
func outline_of(body: SoftBody2D) -> PackedVector2Array:
	var index := _played_bodies.find(body)
	return PackedVector2Array() if world == null or index < 0 else world.get_polygon(index)


func stop() -> void:
	if world == null:
		return
	_show_bodies(true)
	world = null
	_played_bodies.clear()
	_triangles.clear()
	_uvs.clear()
	_point_counts.clear()
	canvas.redraw()
	canvas.changed.emit()


func _show_bodies(shown: bool) -> void:
	for body in _played_bodies:
		if is_instance_valid(body):
			RenderingServer.canvas_item_set_visible(body.get_canvas_item(), shown and body.visible)


func cancel() -> void:
	super()
	stop()


## Once a frame.
func process(delta: float) -> void:
	if world == null:
		return
	for body in _played_bodies:
		if not is_instance_valid(body) or not body.is_inside_tree():
			stop()
			return
	if world.get_body_count() < _played_bodies.size():
		stop()
		canvas.tell(Words.say("The extension was loaded anew: the preview has ended, and everything is as before."))
		return
	var tick := 1.0 / Engine.physics_ticks_per_second
	_owed = minf(_owed + delta, MOST_TICKS * tick)
	while _owed >= tick:
		world.step(tick)
		_owed -= tick
		played += 1
	canvas.redraw()


func input(event: InputEvent) -> bool:
	if world == null:
		return false
	if is_key(event, KEY_ESCAPE):
		stop()
		return true
	if event is InputEventMouseMotion:
		if world.is_grabbing():
			world.drag(_in_scene(event.position))
		return world.is_grabbing()
	if is_left(event, true):
		var reach := 0.0
		for body in _played_bodies:
			reach = maxf(reach, PolygonEdit.bounds(body.get_global_transform() * body.polygon).size.length())
		world.grab(_in_scene(event.position), reach)
		return true
	if is_left(event, false):
		world.release()
		return true
	return false


func _in_scene(place: Vector2) -> Vector2:
	return canvas.scene_to_screen(_played_bodies[0]).affine_inverse() * place


# As the node itself shows its texture; [0, 1] over the polygon's box where nothing else is said. What plays is the hull that
# is simulated; where that has fewer points than the polygon, each shows what the polygon's nearest point does.
func _uv_of(body: SoftBody2D) -> PackedVector2Array:
	var uvs := PackedVector2Array()
	if body.texture == null:
		return uvs
	var box := PolygonEdit.bounds(body.polygon)
	var size := body.texture.get_size()
	var hull := body.get_simulated_polygon()
	for i in hull.size():
		if body.uv.size() == body.polygon.size():
			var nearest := i if hull.size() == body.polygon.size() else PolygonEdit.nearest_point(body.polygon, hull[i], INF)
			uvs.append((body.uv[nearest] + body.texture_offset) / size)
		else:
			uvs.append((hull[i] - box.position) / box.size)
	return uvs


func draw(overlay: Control) -> void:
	if world == null:
		return
	var view := canvas.scene_to_screen(_played_bodies[0])
	var floor_place := view * Vector2(0, floor_y)
	overlay.draw_line(Vector2(0, floor_place.y), Vector2(overlay.size.x, floor_place.y), Color(BodyCanvas.SELECTED, 0.8),
			2 * canvas.scale())
	for x in range(0, int(overlay.size.x), int(24 * canvas.scale())):
		overlay.draw_line(Vector2(x, floor_place.y + 10 * canvas.scale()), Vector2(x + 10 * canvas.scale(), floor_place.y),
				Color(BodyCanvas.SELECTED, 0.35), canvas.scale())
	for i in world.get_body_count(): # pieces are the last ones
		var source := world.get_source(i)
		var body := _played_bodies[source]
		var polygon := view * world.get_polygon(i)
		if i >= _triangles.size():
			_triangles.append(PackedInt32Array())
		# One that has folded over itself keeps the triangles of its last good frame.
		var triangles := Geometry2D.triangulate_polygon(polygon)
		if not triangles.is_empty() or polygon.size() != _point_counts.get(i, polygon.size()):
			_triangles[i] = triangles
		_point_counts[i] = polygon.size()
		if not _triangles[i].is_empty():
			var texture := body.texture.get_rid() if body.texture != null else RID()
			RenderingServer.canvas_item_add_triangle_array(overlay.get_canvas_item(), _triangles[i], polygon,
					PackedColorArray([body.get_color_in_use() * body.modulate]),
					world.carry(i, _uvs[source]) if not _uvs[source].is_empty() else PackedVector2Array(), PackedInt32Array(), PackedFloat32Array(), texture)
		canvas.draw_outline(overlay, polygon, BodyCanvas.LINE)
	if world.is_grabbing():
		canvas.draw_point(overlay, view * world.get_grabbed_position(), BodyCanvas.SELECTED, true)
