# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## The materials in the inspector.

## A file of its own: the editor keeps what it has loaded, and would give the values of a node to one of another class.
const ROPE_SCENE := "res://editor_test_rope.tscn"


func test_a_thumbnail_moves_under_the_mouse_and_a_click_sets_its_material_with_undo() -> void:
	await open_scene({"physics_material_override": PhysicsMaterial.new()})
	await frames(30)
	var picker: Control = plugin.inspector.picker
	if not check(is_instance_valid(picker) and picker.is_visible_in_tree(), "the inspector shows the materials"):
		return
	check_equal(picker.thumbnails.size(), 9, "thumbnails")
	await shot("materials")
	var balloon: Control = picker.thumbnails[1]
	var still: PackedVector2Array = balloon.outline()
	await frames(10)
	check_equal(balloon.outline(), still, "outline without the mouse")
	balloon.mouse_entered.emit()
	await frames(20)
	check(balloon.outline() != still and balloon.played > 3, "it moves under the mouse: %d ticks" % balloon.played)
	await shot("materials_moving")
	balloon.mouse_exited.emit()
	check_equal(balloon.outline(), still, "outline after the mouse has left")
	var version := history().get_version()
	var override := body.physics_material_override
	var material: SoftBodyMaterial2D = balloon.preset.load_material()
	balloon.pressed.emit() # the inspector makes itself anew then
	await frames(5)
	check_equal(body.soft_body_material, material, "material")
	check_equal(body.physics_material_override, null, "physics material, which would count instead")
	check_equal(history().get_version(), version + 1, "steps of undo")
	await undo()
	check(body.soft_body_material == null, "no material after undo")
	check_equal(body.physics_material_override, override, "physics material after undo")
	await redo()
	await save_and_reload()
	check_equal(body.soft_body_material.resource_path.get_file(), "water_balloon.tres", "material after saving")


func test_a_rope_is_offered_the_kinds_of_ropes_and_a_click_sets_one_with_undo() -> void:
	var made := Node2D.new()
	made.name = "Root"
	var rope := SoftRope2D.new()
	rope.name = "Jelly"
	made.add_child(rope)
	rope.owner = made
	await close(ROPE_SCENE)
	write_scene(made, ROPE_SCENE)
	await open(ROPE_SCENE)
	await select_body()
	await frames(30)
	rope = body as SoftRope2D
	var picker: Control = plugin.inspector.rope_picker
	if not check(is_instance_valid(picker) and picker.is_visible_in_tree(), "the inspector shows the kinds of ropes"):
		return
	check_equal(picker.thumbnails.size(), 4, "thumbnails")
	check(not is_instance_valid(plugin.inspector.picker) or not plugin.inspector.picker.is_visible_in_tree(), "a rope is offered materials")
	await shot("ropes")
	for thumbnail: Control in picker.thumbnails:
		var still: PackedVector2Array = thumbnail.outline()
		check(not Geometry2D.triangulate_polygon(still).is_empty(), thumbnail.title + ": its picture is an outline")
		await frames(5)
		check_equal(thumbnail.outline(), still, thumbnail.title + ": outline without the mouse")
		thumbnail.mouse_entered.emit()
		await frames(20)
		check(thumbnail.outline() != still and thumbnail.played > 3, "%s moves under the mouse: %d ticks" % [thumbnail.title, thumbnail.played])
		if thumbnail.title == "Tentacle":
			await shot("ropes_moving")
		thumbnail.mouse_exited.emit()
		check_equal(thumbnail.outline(), still, thumbnail.title + ": outline after the mouse has left")
	var before := [rope.stretch_stiffness, rope.bend_stiffness, rope.bend_damping, rope.rest_bend]
	var version := history().get_version()
	picker.thumbnails[2].pressed.emit()
	await frames(5)
	check_equal(rope.kind, SoftRope2D.KIND_TENTACLE, "kind")
	check_equal(history().get_version(), version + 1, "steps of undo")
	await undo()
	check_equal([rope.stretch_stiffness, rope.bend_stiffness, rope.bend_damping, rope.rest_bend], before, "values after undo")
	check_equal(rope.kind, SoftRope2D.KIND_ROPE, "kind after undo")
	await redo()
	await save_and_reload(ROPE_SCENE)
	check_equal((body as SoftRope2D).kind, SoftRope2D.KIND_TENTACLE, "kind after saving")
	await close(ROPE_SCENE)
