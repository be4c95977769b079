# SPDX-License-Identifier: MIT
@tool
extends Button
## A material as a ball that is dropped: it lies still, and falls again and again while the mouse is over it.
##
## Any other preset is shown the same way by a class that overrides [method _fill] and [method _still_ticks].

const Presets := preload("../../materials/presets.gd")

const BALL_POINTS := 12
const RADIUS := 50.0
const FALL := 80.0
## Height of the scene that the picture shows, with the ball above its fall.
const SCENE_HEIGHT := 2 * RADIUS + FALL
## Ticks after which the ball is dropped again, and in which the still picture is taken: as the ball is squashed.
const ROUND := 130
const STILL := 30
const TICK := 1.0 / 60
const LABEL_SIZE := 9

var preset: Presets.Preset # null: not of a material
var title := ""
var color := Color.WHITE
var world: SoftBodyPreview2D
var played := 0
var _owed := 0.0


func set_up(of: Presets.Preset) -> void:
	preset = of
	set_up_as(of.file, of.title, of.text, of.figures(), of.color)


func set_up_as(file: String, p_title: String, text_of_it: String, figures: String, p_color: Color) -> void:
	title = p_title
	color = p_color
	tooltip_text = "%s\n%s\n%s" % [title, text_of_it, figures]
	name = file.to_pascal_case()
	custom_minimum_size = Vector2(56, 70) * EditorInterface.get_editor_scale()
	size_flags_horizontal = SIZE_EXPAND_FILL
	clip_contents = true
	mouse_entered.connect(play)
	mouse_exited.connect(stop)
	_drop(_still_ticks())


func _ready() -> void:
	set_process(false)


func play() -> void:
	_drop(0)
	set_process(true)


func stop() -> void:
	set_process(false)
	_drop(_still_ticks())


func outline() -> PackedVector2Array:
	return world.get_polygon(0) if world != null and world.get_body_count() > 0 else PackedVector2Array()


## Puts what the picture shows into [member world], above a ground at a height of 0.
func _fill() -> void:
	var body := SoftBody2D.new()
	body.polygon = SoftBody2D.make_circle_polygon(RADIUS, BALL_POINTS)
	body.soft_body_material = preset.load_material()
	body.position = Vector2(0, -RADIUS - FALL)
	world.add_body(body)
	body.free()
	world.add_floor(Vector2.ZERO)


## Ticks after the start in which the still picture is taken.
func _still_ticks() -> int:
	return STILL


func _drop(ticks: int) -> void:
	world = SoftBodyPreview2D.new()
	_fill()
	for i in ticks:
		world.step(TICK)
	played = ticks
	_owed = 0.0
	queue_redraw()


func _process(delta: float) -> void:
	_owed = minf(_owed + delta, 4 * TICK)
	while _owed >= TICK:
		world.step(TICK)
		_owed -= TICK
		played += 1
	if played > ROUND:
		_drop(0)
	queue_redraw()


func _draw() -> void:
	var scale := EditorInterface.get_editor_scale()
	var font := get_theme_default_font()
	var text_size := roundi(LABEL_SIZE * scale)
	var ground := size.y - text_size * 1.7
	var zoom := (ground - 3 * scale) / SCENE_HEIGHT
	var view := Transform2D(0, Vector2.ONE * zoom, 0, Vector2(size.x / 2, ground))
	var ink := get_theme_color(&"font_color", &"Label")
	draw_line(Vector2(4 * scale, ground), Vector2(size.x - 4 * scale, ground), Color(ink, 0.5), scale)
	var polygon := view * outline()
	if not Geometry2D.triangulate_polygon(polygon).is_empty():
		draw_colored_polygon(polygon, color)
		polygon.append(polygon[0])
		draw_polyline(polygon, color.darkened(0.45), 1.5 * scale, true)
	draw_string(font, Vector2(2 * scale, size.y - text_size * 0.45), title, HORIZONTAL_ALIGNMENT_CENTER, size.x - 4 * scale, text_size,
			Color(ink, 0.9))
