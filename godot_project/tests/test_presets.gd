# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The materials of the addon do what they say they do.

const Presets := preload("res://addons/soft_body_2d/materials/presets.gd")
const RopeKinds := preload("res://addons/soft_body_2d/materials/rope_kinds.gd")
const FLOOR := 400.0
const RADIUS := 50.0
const FALL := 200.0
## Two heights that differ by less look alike: 2 px of 100.
const TOLERANCE := 0.02


func time_limit() -> int:
	return 20000


# With the damping that a new project has.
func _drop(preset: Presets.Preset) -> SoftBody2D:
	set_default_damp(0.1, 1.0)
	add_floor(FLOOR)
	return add_body(Vector2(0, FLOOR - RADIUS - FALL), {"soft_body_material": preset.load_material()})


func test_every_material_has_a_file_and_every_file_a_line() -> void:
	var files := PackedStringArray()
	for preset in Presets.all():
		files.append(preset.file)
		if check(ResourceLoader.exists(preset.path()), "there is " + preset.path()):
			check(preset.load_material() != null, preset.file + " is a material")
	for entry in DirAccess.get_files_at(Presets.FOLDER):
		if entry.trim_suffix(".remap").ends_with(".tres"):
			check(entry.trim_suffix(".remap").get_basename() in files, entry + " is in the list")
	check_equal(files.size(), 9, "materials")


func test_each_squashes_jumps_and_rests_as_its_text_says() -> void:
	for preset in Presets.all():
		var body := _drop(preset)
		var least := INF
		var jump := 0.0
		var has_landed := false
		var slept := false
		for i in 900:
			await ticks(1)
			var box := bounds_of(polygon_of(body))
			least = minf(least, box.size.y)
			has_landed = has_landed or box.end.y > FLOOR - 2
			if has_landed:
				jump = maxf(jump, FLOOR - box.end.y)
			slept = slept or body.sleeping
		check_near(least / (2 * RADIUS), preset.squash, TOLERANCE, preset.file + ": least height")
		check_near(jump / FALL, preset.rebound, TOLERANCE, preset.file + ": jump")
		check_near(bounds_of(polygon_of(body)).size.y / (2 * RADIUS), preset.rest, TOLERANCE, preset.file + ": height at rest")
		check_near(body.get_dent(), preset.dent, TOLERANCE, preset.file + ": dent")
		check(slept, preset.file + " comes to rest")
		check("%d %%" % roundi(100 * preset.squash) in preset.figures(), preset.file + ": figures")
		body.free()
		stage.get_child(0).free()


func test_ten_of_each_lie_in_a_heap_and_none_folds() -> void:
	set_default_damp(0.1, 1.0)
	add_floor(FLOOR)
	for side: float in [-270.0, 270.0]:
		add_solid(rectangle(100, 4000), Transform2D(0, Vector2(side, -1000)))
	for preset in Presets.all():
		var heap: Array[SoftBody2D] = []
		for i in 10:
			heap.append(add_body(Vector2(-150 + 105 * (i % 4) + 20 * (i / 4), FLOOR - 60 - 110 * (i / 4)),
					{"soft_body_material": preset.load_material()}))
		var asleep := false
		for i in 600:
			await ticks(1)
			for body in heap:
				if i % 5 == 0:
					check_equal(SoftBody2D.get_polygon_problem(polygon_of(body)), "", "%s: fold of %s" % [preset.file, body.name])
					check_above(body.get_area() / body.get_rest_area(), 0.85, "%s: area of %s" % [preset.file, body.name])
			if heap.all(func(body: SoftBody2D) -> bool: return body.sleeping):
				asleep = true
				break
		check(asleep, preset.file + ": the heap comes to rest within 10 s")
		for body in heap:
			body.free()
		await ticks(1)


func test_the_gallery_shows_all_of_them() -> void:
	var scene: Node2D = (load("res://examples/presets.tscn") as PackedScene).instantiate()
	stage.add_child(scene)
	var shown := PackedStringArray()
	var kinds := PackedInt32Array()
	for body: SoftBody2D in scene.find_children("*", "SoftBody2D", true, false):
		if body is SoftRope2D:
			kinds.append((body as SoftRope2D).kind)
			continue
		shown.append(body.soft_body_material.resource_path.get_file().get_basename())
	for preset in Presets.all():
		check(preset.file in shown, preset.file + " is shown")
	for line in RopeKinds.all():
		check(line.kind in kinds, line.file + " is shown")
	var rope: SoftRope2D = scene.get_node("Rope")
	var jelly: SoftBody2D = scene.get_node("Jelly")
	var start := jelly.position
	var lowest := -INF
	for i in 120:
		await ticks(1)
		lowest = maxf(lowest, rope.get_center_positions()[16].y)
	check_above(jelly.position.y, start.y + 150, "where the jelly has fallen to")
	check_above(lowest, rope.global_position.y + 100, "where the free end of the rope has swung")
	await seconds(2.1)
	check_below(rope.get_center_positions()[16].y, rope.global_position.y + 60, "where the rope is level again")
	check_below(jelly.position.y, start.y + 60, "where it is dropped again")
