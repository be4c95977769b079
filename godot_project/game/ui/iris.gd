# SPDX-License-Identifier: MIT
extends CanvasLayer
## Closes the view to a circle around the player and opens it again, between levels.

const Palette := preload("res://game/palette.gd")
const TIME := 0.7
const CODE := "
shader_type canvas_item;
uniform vec2 center = vec2(640.0, 360.0);
uniform float radius = 2000.0;
uniform vec2 extent = vec2(1280.0, 720.0);
void fragment() {
	COLOR.a *= smoothstep(radius - 2.0, radius + 2.0, distance(UV * extent, center));
}
"
const OPEN_RADIUS := 1500.0

var _rect := ColorRect.new()
var _material := ShaderMaterial.new()


func _ready() -> void:
	layer = 5
	_rect.color = Palette.INK
	_rect.set_anchors_preset(Control.PRESET_FULL_RECT)
	_rect.mouse_filter = Control.MOUSE_FILTER_IGNORE
	_material.shader = Shader.new()
	_material.shader.code = CODE
	_rect.material = _material
	add_child(_rect)
	_rect.visible = false


func open(around: Node2D) -> void:
	_move(around, 0, OPEN_RADIUS, Callable())


## Calls `then` when it is dark.
func close(around: Node2D, then: Callable) -> void:
	_move(around, OPEN_RADIUS, 0, then)


func _move(around: Node2D, from: float, to: float, then: Callable) -> void:
	_rect.visible = true
	var extent := get_viewport().get_visible_rect().size
	_material.set_shader_parameter(&"extent", extent)
	_material.set_shader_parameter(&"radius", from)
	var step := func(radius: float) -> void:
		if not is_instance_valid(around):
			return
		var place := around.get_global_transform_with_canvas().origin
		_material.set_shader_parameter(&"center", place.clamp(Vector2.ZERO, extent))
		_material.set_shader_parameter(&"radius", radius)
	var tween := create_tween()
	tween.tween_method(step, from, to, TIME).set_trans(Tween.TRANS_CUBIC) \
			.set_ease(Tween.EASE_IN if to > from else Tween.EASE_OUT)
	if to > from:
		tween.tween_callback(_rect.hide)
	if then.is_valid():
		tween.tween_callback(then)
