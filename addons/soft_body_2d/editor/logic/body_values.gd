# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The shape and structure of a body as plain values: what an edit starts from, what it makes, and what undo restores.

## In the order in which they are set: entries of the later ones count points of the earlier ones.
const PROPERTIES: Array[StringName] = [&"polygon", &"inner_points", &"center_point", &"springs",
		&"spring_stiffness_scales", &"spring_damping_scales", &"spring_length_scales", &"texture", &"uv",
		&"vertex_colors", &"pinned_points", &"pin_targets"]
const SCALES: Array[StringName] = [&"spring_stiffness_scales", &"spring_damping_scales", &"spring_length_scales"]


## Copies, which do not follow the body.
static func take(body: SoftBody2D) -> Dictionary:
	var values := {}
	for property in PROPERTIES:
		values[property] = body.get(property)
	values[&"pin_targets"] = (values[&"pin_targets"] as Array).duplicate()
	return values


static func copy(values: Dictionary) -> Dictionary:
	var copied := values.duplicate()
	for property: StringName in copied:
		if copied[property] is Array:
			copied[property] = (copied[property] as Array).duplicate()
	return copied


static func put(body: SoftBody2D, values: Dictionary) -> void:
	for property in PROPERTIES:
		if values.has(property) and not is_same_value(body.get(property), values[property]):
			body.set(property, values[property])


static func is_same_value(a: Variant, b: Variant) -> bool:
	# Bytes, as -0.0 equals 0.0 and an edit that is undone shall leave no bit behind. Resources are the same or not.
	if a is Object or b is Object:
		return is_same(a, b)
	return var_to_bytes(a) == var_to_bytes(b)


## Which properties differ, in order. Pins come with their targets: setting the points cuts off the targets.
static func changed(before: Dictionary, after: Dictionary) -> Array[StringName]:
	var names: Array[StringName] = []
	for property in PROPERTIES:
		if after.has(property) and not is_same_value(before[property], after[property]):
			names.append(property)
	if &"pinned_points" in names and not &"pin_targets" in names:
		names.append(&"pin_targets")
	return names


static func point_count(values: Dictionary) -> int:
	return values[&"polygon"].size() + values[&"inner_points"].size() + int(values[&"center_point"])


## All points in the node's coordinates: polygon, inner points, center point.
static func points(values: Dictionary) -> PackedVector2Array:
	var all := PackedVector2Array(values[&"polygon"])
	if values[&"center_point"]:
		var sum := Vector2.ZERO
		for point in all:
			sum += point
		var center := sum / maxf(1, all.size())
		all.append_array(values[&"inner_points"])
		all.append(center)
	else:
		all.append_array(values[&"inner_points"])
	return all


## Two point indices a spring, those of the automatic structure too: whatever a body with these values has.
static func springs(values: Dictionary) -> PackedInt32Array:
	if not values[&"springs"].is_empty():
		return values[&"springs"]
	var scratch := SoftBody2D.new()
	scratch.polygon = values[&"polygon"]
	scratch.center_point = values[&"center_point"]
	scratch.inner_points = values[&"inner_points"]
	var all := scratch.get_all_springs()
	scratch.free()
	return all
