# SPDX-License-Identifier: MIT
@tool
extends RefCounted
## Edits of pins: which points are held, and by what.

const BodyValues := preload("body_values.gd")


## Pins the points, or lets them go. Those that are pinned already keep what they follow.
static func with_pins(values: Dictionary, points: PackedInt32Array, pinned: bool) -> Dictionary:
	var targets := targets_of(values)
	for point in points:
		if not pinned:
			targets.erase(point)
		elif not targets.has(point):
			targets[point] = NodePath()
	return _with(values, targets)


## Pins the points to a node; an empty path is the world.
static func with_target(values: Dictionary, points: PackedInt32Array, target: NodePath) -> Dictionary:
	var targets := targets_of(values)
	for point in points:
		targets[point] = target
	return _with(values, targets)


## Point -> path of what it follows, in the order of the pins.
static func targets_of(values: Dictionary) -> Dictionary:
	var targets := {}
	for i in values[&"pinned_points"].size():
		targets[values[&"pinned_points"][i]] = values[&"pin_targets"][i] if i < values[&"pin_targets"].size() else NodePath()
	return targets


static func _with(values: Dictionary, targets: Dictionary) -> Dictionary:
	var after := BodyValues.copy(values)
	var paths: Array[NodePath] = []
	paths.assign(targets.values())
	after[&"pinned_points"] = PackedInt32Array(targets.keys())
	after[&"pin_targets"] = paths
	return after
