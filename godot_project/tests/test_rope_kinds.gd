# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The kinds of ropes to begin with do what their texts say: each hangs, holds, bends, lands, rests and lies in a heap.

const RopeKinds := preload("res://addons/soft_body_2d/materials/rope_kinds.gd")
const FLOOR := 400.0
const LENGTH := 300.0

func time_limit() -> int:
	return 20000


func _add_rope(kind: SoftRope2D.Kind, path: PackedVector2Array, properties := {}) -> SoftRope2D:
	var rope := SoftRope2D.new()
	rope.kind = kind
	rope.path = path
	for property: String in properties:
		rope.set(property, properties[property])
	stage.add_child(rope)
	return rope


func _end(rope: SoftRope2D) -> Vector2:
	return rope.get_center_positions()[rope.get_center_count() - 1]


func test_every_kind_has_a_line_here_and_reads_as_itself() -> void:
	check_equal(RopeKinds.all().size(), ClassDB.class_get_enum_constants(&"SoftRope2D", &"Kind").size() - 1, "kinds")
	for line in RopeKinds.all():
		var rope := _add_rope(line.kind, [Vector2.ZERO, Vector2(0, 100)])
		check_equal(rope.kind, line.kind, "kind of a " + line.title)
		for property: StringName in line.values():
			check_equal(rope.get(property), line.values()[property], "%s of a %s" % [property, line.title])


func test_each_holds_a_kilogram_and_bends_as_its_text_says() -> void:
	set_default_damp(0.1, 1.0)
	for line in RopeKinds.all():
		var rope := _add_rope(line.kind, [Vector2.ZERO, Vector2(0, LENGTH)], {"pin_start": true, "mass": 0.02})
		var weight := RigidBody2D.new()
		weight.add_child(CollisionShape2D.new())
		(weight.get_child(0) as CollisionShape2D).shape = circle(20)
		weight.position = Vector2(0, LENGTH + 30)
		weight.mass = 1.0
		weight.linear_damp = 3
		stage.add_child(weight)
		var joint := SoftBodyJoint2D.new()
		joint.position = Vector2(0, LENGTH)
		stage.add_child(joint)
		joint.node_a = joint.get_path_to(rope)
		joint.node_b = joint.get_path_to(weight)
		var level := _add_rope(line.kind, [Vector2(600, 0), Vector2(660, 0)], {"linear_damp": 3.0, "link_count": 12})
		for i in 2:
			level.set_point_pinned(level.get_center_point(i), true, NodePath())
		await seconds(12)
		check_near(rope.get_length() / LENGTH, line.stretch, 0.03, "%s: length under a kilogram over that at rest" % line.title)
		check_near((_end(level).x - 600) / 60, line.reach, 0.05, "%s: how far its free end is out" % line.title)
		check("by %d %%" % roundi(100 * line.reach) in line.figures(), line.title + ": figures")
		for node: Node in [joint, rope, weight, level]:
			node.free()


func test_each_lands_and_comes_to_rest() -> void:
	set_default_damp(0.1, 1.0)
	add_floor(FLOOR)
	for line in RopeKinds.all():
		var rope := _add_rope(line.kind, [Vector2(-LENGTH / 2, FLOOR - 206), Vector2(LENGTH / 2, FLOOR - 206)])
		var has_landed := false
		var jump := 0.0
		var slept := -1.0
		for i in 900:
			await ticks(1)
			var end := bounds_of(rope.get_point_positions()).end.y
			has_landed = has_landed or end > FLOOR - 2
			if has_landed:
				jump = maxf(jump, FLOOR - end)
			if rope.sleeping:
				slept = i / 60.0
				break
		check(slept > 0, "a %s comes to rest" % line.title)
		check_below(jump / 200, 0.05, "%s: jump" % line.title)
		check_near(rope.get_length() / LENGTH, 1, 0.01, "%s: length at rest" % line.title)
		rope.free()


func test_ten_ropes_and_ten_tentacles_lie_in_a_heap_and_keep_their_lengths() -> void:
	set_default_damp(0.1, 1.0)
	add_floor(FLOOR)
	for side: float in [-270.0, 270.0]:
		add_solid(rectangle(100, 4000), Transform2D(0, Vector2(side, -1000)))
	for line in RopeKinds.all():
		if not line.kind in [SoftRope2D.KIND_ROPE, SoftRope2D.KIND_TENTACLE]:
			continue # docs/limits.md
		var heap: Array[SoftRope2D] = []
		for i in 10:
			var middle := Vector2(-20 + 10 * (i % 5), FLOOR - 40 - 45 * i)
			heap.append(_add_rope(line.kind, [middle - Vector2(LENGTH / 2, 0), middle + Vector2(LENGTH / 2, 0)]))
		var deepest := 0.0
		var longest := 0.0
		for i in 600:
			await ticks(1)
			if i % 10 == 0:
				for rope in heap:
					longest = maxf(longest, rope.get_length() / LENGTH)
		for rope in heap:
			deepest = maxf(deepest, rope.get_penetration())
		check_below(deepest, 2, "%s: penetration in px" % line.title)
		check_below(longest, 1.02, "%s: length over that at rest" % line.title)
		for rope in heap:
			rope.free()
