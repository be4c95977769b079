# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## What a change of one property in the inspector has to keep of a body's look.

const NewBody := preload("new_body.gd")

## An automatic look is plain once one of these is set, which nobody means who picks a color.
const SHAPING: Array[StringName] = [&"color", &"texture", &"antialiased", &"smooth", &"outline_width", &"outline_color",
	&"outline_texture", &"vertex_colors", &"uv", &"modulate", &"self_modulate", &"material"]
## These say themselves what color the fill has.
const OF_FILL: Array[StringName] = [&"color", &"texture", &"vertex_colors"]


## The properties that are set together with `property`, so that a body in the soft look stays in it.
static func kept_with(property: StringName, body: SoftBody2D) -> Dictionary:
	if not property in SHAPING or body.get_look_in_use() != SoftBody2D.LOOK_SOFT:
		return {}
	var kept := {&"look": SoftBody2D.LOOK_SOFT}
	if not property in OF_FILL:
		kept[&"color"] = body.get_color_in_use()
	elif property != &"color" and NewBody.is_given(body.color):
		kept[&"color"] = Color.WHITE # a texture is not tinted by a color that nobody has picked
	return kept
