# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The values of a SoftBodySkin2D that takes the place of a Polygon2D, or shows what a body looks like.

const Bake := preload("bake.gd")
const Conversion := preload("conversion.gd")


## Whether this polygon lies below a body that it can follow, and does not follow it yet.
static func can_follow(node: Node) -> bool:
	return node is Polygon2D and not node is SoftBodySkin2D and node.get_parent() is SoftBody2D


## All that a Polygon2D stores. A skin follows its body, and no skeleton besides.
static func of_polygon(source: Polygon2D) -> Dictionary:
	var values := {}
	for property in ClassDB.class_get_property_list(&"Polygon2D"):
		if property["usage"] & PROPERTY_USAGE_STORAGE and property["name"] != "script":
			values[StringName(property["name"])] = source.get(property["name"])
	values[&"skeleton"] = NodePath()
	return values


## A skin of the body's own outline, texture and color, in its place.
static func of_body(body: SoftBody2D) -> Dictionary:
	var values := Bake.values_of(body, body.polygon)
	for property: StringName in Conversion.node_values(body):
		values.erase(property) # a child has them by its parent
	return values
