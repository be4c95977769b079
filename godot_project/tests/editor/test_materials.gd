# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## The materials in the inspector.


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
