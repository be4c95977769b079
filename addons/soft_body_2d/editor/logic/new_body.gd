# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## What a body gets that is newly made in the editor, and that no scene or script ever gets by itself: the fewest points that keep its
## outline, and a color that stands out from the canvas.

## Polygons of as many points are simulated as drawn.
const POINTS_OF_DETAIL := 16
## Those of the automatic soft look, and two of its hue for canvases from which that does not stand out.
const ON_DARK := Color(0.2, 0.62, 0.57)
const ON_LIGHT := Color(0.08, 0.42, 0.39)
const PALE := Color(0.62, 0.9, 0.86)
## Least ratio of luminances to a dark canvas.
const LEAST_CONTRAST := 2.5


## Properties of a new node, by name; none that says what the default says. They are set once, and stay as they are when the canvas
## gets another color.
static func values_of(body: SoftBody2D, canvas: Color) -> Dictionary:
	var values := {}
	if not body is SoftRope2D:
		values[&"detail_mode"] = SoftBody2D.DETAIL_MODE_AUTOMATIC # it acts from 17 points on
	var color := color_on(canvas)
	if color != ON_DARK:
		values[&"look"] = SoftBody2D.LOOK_SOFT
		values[&"color"] = color
	return values


## Adds the detail of a body that is made of an outline, traced or converted: where it has few points there is nothing to leave out.
static func add_detail(values: Dictionary, tears: bool) -> void:
	if values[&"polygon"].size() > POINTS_OF_DETAIL and not tears:
		values[&"detail_mode"] = SoftBody2D.DETAIL_MODE_AUTOMATIC


static func color_on(canvas: Color) -> Color:
	var light := luminance(canvas)
	if light < luminance(ON_DARK) and contrast(canvas, ON_DARK) >= LEAST_CONTRAST:
		return ON_DARK
	return ON_LIGHT if contrast(canvas, ON_LIGHT) >= contrast(canvas, PALE) else PALE


## Whether a body has a color that it got as a new one.
static func is_given(color: Color) -> bool:
	return color == ON_LIGHT or color == PALE


## Relative luminance and the ratio of contrast, as the Web Content Accessibility Guidelines 2.1 define them.
static func luminance(color: Color) -> float:
	var linear := color.srgb_to_linear()
	return 0.2126 * linear.r + 0.7152 * linear.g + 0.0722 * linear.b


static func contrast(a: Color, b: Color) -> float:
	var lights := [luminance(a), luminance(b)]
	return (lights.max() + 0.05) / (lights.min() + 0.05)


## Whether nothing of a body has been set: what comes from a scene, a script or the clipboard is left as it is.
static func is_untouched(body: SoftBody2D) -> bool:
	if body.get_script() != null:
		return false
	for property in ClassDB.class_get_property_list(body.get_class()):
		var name: StringName = property["name"]
		if property["usage"] & PROPERTY_USAGE_STORAGE and ClassDB.class_get_property_list(&"Node2D").all(
				func(other: Dictionary) -> bool: return other["name"] != name):
			var default: Variant = ClassDB.class_get_property_default_value(body.get_class(), name)
			if var_to_bytes(body.get(name)) != var_to_bytes(default) and not (body.get(name) == null and default == null):
				return false
	return true
