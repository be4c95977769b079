# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## The shape and structure of a body as plain values: what an edit starts from, what it makes, and what undo restores.

## In the order in which they are set: entries of the later ones count points of the earlier ones.
const PROPERTIES: Array[StringName] = [&"polygon", &"holes", &"detail_mode", &"detail_tolerance",
		&"detail_point_count", &"detail_weights", &"inner_points", &"center_point", &"springs",
		&"spring_stiffness_scales", &"spring_damping_scales", &"spring_length_scales", &"texture", &"uv",
		&"vertex_colors", &"pinned_points", &"pin_targets"]
const SCALES: Array[StringName] = [&"spring_stiffness_scales", &"spring_damping_scales", &"spring_length_scales"]


## Copies, which do not follow the body.
static func take(body: SoftBody2D) -> Dictionary:
	var values := {}
	for property in PROPERTIES:
		values[property] = body.get(property)
	for property: StringName in [&"pin_targets", &"holes"]:
		values[property] = (values[property] as Array).duplicate()
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


## Whether fewer points than those of the polygon may be simulated.
static func has_less_detail(values: Dictionary) -> bool:
	return values.get(&"detail_mode", SoftBody2D.DETAIL_MODE_AS_DRAWN) != SoftBody2D.DETAIL_MODE_AS_DRAWN


## Whether fewer points, or others, are simulated than those of the polygon.
static func is_simplified(values: Dictionary) -> bool:
	return has_less_detail(values) and hull(values) != values[&"polygon"]


## What a body with these values simulates: its polygon, or fewer points that stand for it. Pins and springs count these.
static func hull(values: Dictionary) -> PackedVector2Array:
	if not has_less_detail(values):
		return values[&"polygon"]
	var scratch := SoftBody2D.new()
	for property: StringName in [&"polygon", &"detail_mode", &"detail_tolerance", &"detail_point_count", &"detail_weights"]:
		if values.has(property):
			scratch.set(property, values[property])
	var simulated := scratch.get_simulated_polygon()
	scratch.free()
	return simulated


static func point_count(values: Dictionary) -> int:
	return hull(values).size() + values[&"inner_points"].size() + int(values[&"center_point"])


## All points that are simulated, in the node's coordinates: hull, inner points, center point.
static func points(values: Dictionary) -> PackedVector2Array:
	var all := PackedVector2Array(hull(values))
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
	scratch.polygon = hull(values)
	scratch.center_point = values[&"center_point"]
	scratch.inner_points = values[&"inner_points"]
	var all := scratch.get_all_springs()
	scratch.free()
	return all
