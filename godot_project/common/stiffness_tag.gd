# SPDX-License-Identifier: MIT
extends Node2D
## Child of a [SoftBody2D]: floats above it, upright, and says how stiff it is.

const FONT_SIZE := 15
const PADDING := Vector2(9, 4)

## Space between the top of the polygon and the tag, in pixels.
@export var gap := 10.0
## Shown instead of the stiffness when not empty.
@export var text := ""

@onready var _body: SoftBody2D = get_parent()


func _ready() -> void:
	top_level = true
	z_index = 2
	physics_interpolation_mode = Node.PHYSICS_INTERPOLATION_MODE_OFF


func _process(_delta: float) -> void:
	var polygon := _body.get_interpolated_polygon()
	if polygon.is_empty():
		return
	var box := Rect2(polygon[0], Vector2.ZERO)
	for point in polygon:
		box = box.expand(point)
	global_transform = Transform2D(0, Vector2(box.get_center().x, box.position.y - gap))
	queue_redraw()


func _draw() -> void:
	var font := ThemeDB.fallback_font
	var shown := text if text != "" else "k = %d N/m" % roundi(_body.stiffness)
	var size := font.get_string_size(shown, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE)
	var pill := Rect2(Vector2(-size.x / 2, -size.y) - PADDING, size + 2 * PADDING)
	pill.position.y -= PADDING.y
	var back := StyleBoxFlat.new()
	back.bg_color = Color(0.08, 0.09, 0.18, 0.62)
	back.set_corner_radius_all(int(pill.size.y / 2))
	draw_style_box(back, pill)
	var baseline := pill.position + PADDING + Vector2(0, font.get_ascent(FONT_SIZE))
	draw_string(font, baseline, shown, HORIZONTAL_ALIGNMENT_LEFT, -1, FONT_SIZE, Color(1, 1, 1, 0.95))
