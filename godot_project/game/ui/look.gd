# SPDX-License-Identifier: MIT
extends RefCounted
## The look of buttons, panels and words, made once and given to every screen as its theme.

const Palette := preload("res://game/palette.gd")

static var _theme: Theme


static func theme() -> Theme:
	if _theme == null:
		_theme = _make()
	return _theme


## A heading in the middle of a screen.
static func title(text: String, size := 54) -> Label:
	var label := Label.new()
	label.text = text
	label.horizontal_alignment = HORIZONTAL_ALIGNMENT_CENTER
	label.add_theme_font_size_override(&"font_size", size)
	label.add_theme_color_override(&"font_color", Palette.STAR)
	label.add_theme_color_override(&"font_outline_color", Palette.INK)
	label.add_theme_constant_override(&"outline_size", 14)
	return label


static func button(text: String, pressed: Callable) -> Button:
	var made := Button.new()
	made.text = text
	made.pressed.connect(pressed)
	# What the mouse is over and what keys would press are one and the same.
	made.mouse_entered.connect(made.grab_focus)
	return made


## A panel in the middle of the screen whose rows are added to what is returned.
static func centered_panel(parent: Node, width := 420.0) -> VBoxContainer:
	var middle := CenterContainer.new()
	middle.set_anchors_preset(Control.PRESET_FULL_RECT)
	middle.theme = theme()
	var panel := PanelContainer.new()
	panel.custom_minimum_size.x = width
	var rows := VBoxContainer.new()
	rows.add_theme_constant_override(&"separation", 12)
	panel.add_child(rows)
	middle.add_child(panel)
	parent.add_child(middle)
	return rows


## Darkens what is behind a menu.
static func veil(parent: Node, alpha := 0.55) -> void:
	var rect := ColorRect.new()
	rect.color = Color(Palette.INK, alpha)
	rect.set_anchors_preset(Control.PRESET_FULL_RECT)
	parent.add_child(rect)


static func _make() -> Theme:
	var made := Theme.new()
	made.default_font_size = 24
	made.set_color(&"font_color", &"Label", Palette.TEXT)
	made.set_stylebox(&"panel", &"PanelContainer", _box(Color(Palette.INK, 0.92), Palette.GROUND_RIM, 3, 22, 28))
	for state: String in ["normal", "hover", "pressed", "focus", "disabled", "hover_pressed"]:
		var strong := state in ["hover", "focus", "pressed", "hover_pressed"]
		var fill := Palette.JELLY if strong else Palette.GROUND
		var style := _box(fill, Palette.JELLY.lightened(0.4) if strong else Palette.GRASS, 3, 14, 10)
		if state == "focus":
			style.bg_color = Color(Palette.JELLY, 0.0)
			style.draw_center = false
		elif state == "disabled":
			style.bg_color = Color(Palette.GROUND, 0.4)
		for type: StringName in [&"Button", &"OptionButton", &"CheckButton"]:
			made.set_stylebox(StringName(state), type, style)
	for type: StringName in [&"Button", &"OptionButton", &"CheckButton"]:
		made.set_color(&"font_color", type, Palette.TEXT)
		for state: StringName in [&"font_hover_color", &"font_pressed_color", &"font_hover_pressed_color"]:
			made.set_color(state, type, Palette.INK)
		made.set_color(&"font_focus_color", type, Palette.JELLY)
		made.set_color(&"font_disabled_color", type, Color(Palette.TEXT_SOFT, 0.4))
	made.set_stylebox(&"slider", &"HSlider", _box(Palette.GROUND, Palette.GRASS, 2, 6, 4))
	made.set_stylebox(&"grabber_area", &"HSlider", _box(Palette.JELLY, Palette.JELLY, 0, 6, 4))
	made.set_stylebox(&"grabber_area_highlight", &"HSlider", _box(Palette.STAR, Palette.STAR, 0, 6, 4))
	return made


static func _box(fill: Color, edge: Color, width: int, radius: int, margin: float) -> StyleBoxFlat:
	var style := StyleBoxFlat.new()
	style.bg_color = fill
	style.border_color = edge
	style.set_border_width_all(width)
	style.set_corner_radius_all(radius)
	style.set_content_margin_all(margin)
	return style
