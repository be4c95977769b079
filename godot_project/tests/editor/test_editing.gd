# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## Springs, pins, shapes, preview, the stability panel, and the plugin's own coming and going.


func _spring_middle(index: int) -> Vector2:
	var ends := body.get_spring_points(index)
	var points := BodyValues.points(BodyValues.take(body))
	return on_screen((points[ends.x] + points[ends.y]) / 2)


func test_the_brush_paints_springs_in_one_step() -> void:
	await open_scene()
	plugin.set_mode(2)
	await frames(2)
	check(plugin.springs_panel.visible, "the panel of springs is there")
	plugin.springs_mode.tool = 1
	plugin.springs_mode.brush.radius = 30.0
	plugin.springs_mode.brush.target = 4.0
	var before := values()
	var version := history().get_version()
	await drag(on_screen(Vector2(45, -20)), on_screen(Vector2(45, 20)), false, 10)
	var factors := body.spring_stiffness_scales
	if check_equal(factors.size(), body.get_spring_count(), "factors"):
		check(factors[0] > 2, "the spring under the brush is stiffer: %s" % factors[0])
		check_equal(factors[8], 1.0, "factor of a spring on the other side")
	await shot("springs_brush")
	await check_one_step(before, version, "a stroke of the brush")


func test_springs_are_selected_set_added_and_removed() -> void:
	await open_scene()
	plugin.set_mode(2)
	await frames(2)
	await click(_spring_middle(2))
	check_equal(plugin.springs_mode.selection.of(body), PackedInt32Array([2]), "the spring that was clicked")
	plugin.springs_mode.select_kind(0)
	check_equal(plugin.springs_mode.selection.size(), 16, "all polygon springs")
	plugin.springs_mode.select_kind(1)
	check_equal(plugin.springs_mode.selection.size(), 16, "all inner springs")
	var before := values()
	var version := history().get_version()
	plugin.springs_panel.fields[0].value = 2.5
	await frames(1)
	check_equal(body.spring_stiffness_scales[20], 2.5, "factor of an inner spring")
	check_equal(body.spring_stiffness_scales[3], 1.0, "factor of a polygon spring")
	await check_one_step(before, version, "setting a factor")

	plugin.springs_mode.tool = 2
	before = values()
	version = history().get_version()
	await drag(polygon_on_screen(0), polygon_on_screen(8))
	check_equal(body.get_spring_count(), 33, "springs after one was added")
	await check_one_step(before, version, "adding a spring")
	before = values()
	version = history().get_version()
	await click(on_screen(Vector2(20, 6)))
	check_equal(body.inner_points.size(), 1, "inner points after a click inside")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings")
	await check_one_step(before, version, "adding an inner point")
	await shot("springs_added")
	before = values()
	version = history().get_version()
	plugin.springs_mode.tool = 0
	await click(_spring_middle(3), MOUSE_BUTTON_RIGHT)
	check_equal(body.get_spring_count(), 35, "springs after one was removed")
	await check_one_step(before, version, "removing a spring")


func test_points_are_pinned_in_bulk_and_follow_a_node() -> void:
	await open_scene()
	plugin.set_mode(3)
	await frames(2)
	var before := values()
	var version := history().get_version()
	await drag(on_screen(Vector2(-60, -60)), on_screen(Vector2(60, -30)))
	var chosen: PackedInt32Array = plugin.pins_mode.selection.of(body)
	check_equal(chosen, PackedInt32Array([10, 11, 12, 13, 14]), "points in the box")
	await press_button(plugin.pins_panel.pin_button)
	check_equal(body.pinned_points, chosen, "pinned points")
	await check_one_step(before, version, "pinning")
	before = values()
	version = history().get_version()
	plugin.pins_mode.assign_selected(root())
	check_equal(body.pin_targets, [^"..", ^"..", ^"..", ^"..", ^".."] as Array[NodePath], "what the pins follow")
	await shot("pins")
	await check_one_step(before, version, "assigning a node")
	before = values()
	version = history().get_version()
	await click(polygon_on_screen(12), MOUSE_BUTTON_RIGHT)
	check_equal(body.pinned_points, PackedInt32Array([10, 11, 13, 14]), "pinned points after a right-click")
	await check_one_step(before, version, "unpinning")


func test_a_node_that_is_added_and_edited_is_saved_and_comes_back() -> void:
	await open_scene()
	root().get_node("Jelly").free()
	var added := SoftBody2D.new()
	added.name = "Jelly"
	added.position = Vector2(200, 300)
	root().add_child(added)
	added.owner = root()
	await select_body()
	check_equal(body, added, "the body that is edited")
	await drag(polygon_on_screen(2), polygon_on_screen(2) + Vector2(14, 9))
	await click((polygon_on_screen(6) + polygon_on_screen(7)) / 2)
	plugin.set_mode(2)
	plugin.springs_mode.tool = 1
	await drag(on_screen(Vector2(-45, 10)), on_screen(Vector2(-40, -20)), false, 6)
	plugin.set_mode(3)
	await click(polygon_on_screen(4), MOUSE_BUTTON_RIGHT)
	var before := values()
	check_equal([body.polygon.size(), body.pinned_points.size(), body.spring_stiffness_scales.size()], [17, 1, 34],
			"points, pins and factors")
	await save_and_reload()
	for property: StringName in BodyValues.PROPERTIES:
		check_equal(body.get(property), before[property], "%s after loading" % property)


func test_the_preview_leaves_the_node_as_it_was() -> void:
	await open_scene()
	var before := bytes(body)
	var transform := body.global_transform
	var version := history().get_version()
	plugin.set_preview(true)
	check(plugin.preview.is_playing(), "it plays")
	var start: Vector2 = plugin.preview.world.get_polygon(0)[4]
	for i in 200:
		await frames(1)
		if plugin.preview.played > 60:
			break
	check(plugin.preview.world.get_polygon(0)[4].y > start.y + 10, "the copy falls: %s" % plugin.preview.world.get_polygon(0)[4])
	await shot("preview")
	var place: Vector2 = plugin.canvas.scene_to_screen(body) * plugin.preview.world.get_polygon(0)[12]
	press(place)
	check(plugin.preview.world.is_grabbing(), "a press takes hold of a point")
	move(place + Vector2(0, -60))
	await frames(10)
	await shot("preview_pulled")
	release()
	await key(KEY_ESCAPE)
	check(not plugin.preview.is_playing(), "Escape stops it")
	check(bytes(body) == before, "the node's values are as before")
	check_equal(body.global_transform, transform, "its transform")
	plugin.set_mode(0)
	await drawn()
	var pixel := tree.root.get_texture().get_image().get_pixelv(viewport_origin() + on_screen(Vector2(15, 22)))
	var color := body.get_color_in_use()
	check(maxf(absf(pixel.r - color.r), absf(pixel.g - color.g)) < 0.05, "it is seen again: %s" % pixel)
	check_equal(history().get_version(), version, "steps of undo")


func test_the_panel_advises_a_material_on_youngs_modulus() -> void:
	await open_scene({"youngs_modulus": 20.0})
	await frames(30)
	var panel: Control = plugin.inspector.panel
	panel.refresh()
	await frames(2)
	check_equal(panel.shown_rows[6].text, "elastic modes", "what makes it elastic")
	check_equal(panel.shown_advice.size(), 1, "advice")
	panel.apply(panel.shown_advice[0])
	check(body.youngs_modulus > 40, "Young's modulus after the advice: %s" % body.youngs_modulus)
	check_equal([body.stiffness, body.get_elastic_model_in_use()], [100.0, SoftBody2D.ELASTIC_MODEL_MODES], "stiffness and model")
	check(body.get_stability_report(200)["sag"] <= 0.1, "with the advised value it holds")
	await undo()
	check_equal(body.youngs_modulus, 20.0, "Young's modulus after undo")


func test_raw_values_make_a_network_in_the_inspector_until_they_are_taken_back() -> void:
	await open_scene()
	body.stiffness = 140.0
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_NETWORK, "model with another stiffness")
	body.stiffness = 100.0
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model with the default again")


func test_a_preset_that_is_chosen_in_the_inspector_is_undone_with_all_its_values() -> void:
	var shared := PhysicsMaterial.new()
	shared.friction = 0.875
	await open_scene({"youngs_modulus": 333.0, "physics_material_override": shared})
	shared = body.physics_material_override
	await frames(30)
	var chooser: EditorProperty = null
	for property: EditorProperty in EditorInterface.get_inspector().find_children("*", "EditorProperty", true, false):
		if property.get_edited_property() == &"preset":
			chooser = property
	if not check(chooser != null, "the inspector shows the preset"):
		return
	check_equal(body.preset, SoftBodyMaterial2D.PRESET_CUSTOM, "preset of values of one's own")
	var version := history().get_version()
	chooser.emit_changed(&"preset", SoftBodyMaterial2D.PRESET_RUBBER)
	await frames(2)
	var rubber := SoftBodyMaterial2D.make_preset(SoftBodyMaterial2D.PRESET_RUBBER)
	check_equal(body.youngs_modulus, rubber.youngs_modulus, "Young's modulus of rubber")
	check(absf(body.physics_material_override.friction - rubber.friction) < 1e-6, "friction of rubber")
	check_equal(shared.friction, 0.875, "friction of the material that others may share")
	check_equal(history().get_version(), version + 1, "steps of undo")
	await undo()
	check_equal([body.youngs_modulus, body.poisson_ratio], [333.0, 0.45], "values after undo")
	check_equal(body.physics_material_override, shared, "physics material after undo")


func _property_editor(name: StringName) -> EditorProperty:
	for property: EditorProperty in EditorInterface.get_inspector().find_children("*", "EditorProperty", true, false):
		if property.get_edited_property() == name:
			return property
	return null


func test_the_mass_follows_the_size_in_the_inspector_until_the_mode_is_custom_and_undo_takes_that_back() -> void:
	await open_scene({"polygon": SoftBody2D.make_circle_polygon(25, 16)})
	await frames(30)
	if not check(_property_editor(&"mass") != null, "the inspector shows the mass"):
		return
	check(_property_editor(&"mass").is_read_only(), "the mass of an automatic body can be edited")
	var own := body.mass
	check(absf(own - 0.25) < 1e-4, "mass of half the usual size: %s" % own)
	_property_editor(&"mass_mode").emit_changed(&"mass_mode", SoftBody2D.MASS_MODE_CUSTOM)
	await frames(10)
	check_equal(body.mass, own, "mass of the custom mode")
	check(not _property_editor(&"mass").is_read_only(), "the mass cannot be edited")
	_property_editor(&"mass").emit_changed(&"mass", 3.0)
	await frames(10)
	check_equal(body.mass, 3.0, "mass that was set")
	await undo()
	check_equal([body.mass_mode, body.mass], [SoftBody2D.MASS_MODE_CUSTOM, own], "mode and mass after undo")
	await undo()
	check_equal([body.mass_mode, body.mass], [SoftBody2D.MASS_MODE_AUTO, own], "mode and mass after undo of both")
	await frames(10)
	check(_property_editor(&"mass").is_read_only(), "the mass can be edited after undo")


func test_the_stability_panel_tells_and_its_advice_is_applied_in_one_step() -> void:
	await open_scene({"stiffness": 5.0, "substeps": 20})
	await frames(30)
	var panel: Control = plugin.inspector.panel
	if not check(is_instance_valid(panel) and panel.is_inside_tree(), "the inspector shows the panel"):
		return
	panel.refresh()
	await frames(2)
	await shot("stability")
	check(panel.report.get("folds", false), "a body of 5 N/m folds: %s" % panel.report)
	check_equal(panel.shown_rows.size(), 7, "figures")
	check(panel.headline.text.begins_with("To do: ") and "will fold" in panel.headline.text, "the line: " + panel.headline.text)
	var texts: Array = panel.shown_advice.map(func(advice: RefCounted) -> String: return advice.text)
	check("substeps are enough" in "\n".join(texts), "advice on substeps: %s" % [texts])
	check("will fold under its own weight" in "\n".join(texts), "advice on stiffness: %s" % [texts])
	var version := history().get_version()
	for advice: RefCounted in panel.shown_advice.duplicate():
		if advice.changes.has(&"stiffness"):
			panel.apply(advice)
	check(body.stiffness > 20, "stiffness after the advice: %s" % body.stiffness)
	check_equal(history().get_version(), version + 1, "steps of undo")
	var report := body.get_stability_report(200)
	check(not report["folds"] and report["sag"] <= 0.1, "with the advised stiffness it holds: %s" % report)
	await undo()
	check_equal(body.stiffness, 5.0, "stiffness after undo")


func test_shapes_from_other_nodes_keep_their_places() -> void:
	await open_scene()
	var sprite := Sprite2D.new()
	sprite.name = "Picture"
	sprite.texture = load("res://icon.svg")
	sprite.position = Vector2(420, 180)
	sprite.rotation = 0.3
	root().add_child(sprite)
	sprite.owner = root()
	var before := values()
	var version := history().get_version()
	plugin.shapes.run(&"sprite_2d", {"count": 40, "threshold": 0.5, "margin": 0.0}, sprite)
	for i in 200:
		await frames(1)
		if history().get_version() > version:
			break
	check(body.polygon.size() >= 4 and body.polygon.size() <= 40, "points of the traced polygon: %d" % body.polygon.size())
	check_equal(body.uv.size(), body.polygon.size(), "texture coordinates")
	check(body.texture == sprite.texture, "the body shows the sprite's texture")
	var middle := body.to_global(preload("res://addons/soft_body_2d/editor/logic/polygon_edit.gd").bounds(body.polygon).get_center())
	check_near(middle, sprite.global_position, 3, "middle of the traced polygon")
	await check_one_step(before, version, "tracing")


func test_locked_inherited_and_read_only_things_are_told_of_and_nothing_is_lost() -> void:
	await open_scene()
	body.set_meta(&"_edit_lock_", true)
	var before := values()
	await drag(polygon_on_screen(0), polygon_on_screen(0) + Vector2(20, 0))
	check(bytes(body) == _bytes_of(before), "a locked body stays as it is")
	check("locked" in plugin.canvas.last_message, "the message says so: " + plugin.canvas.last_message)
	body.remove_meta(&"_edit_lock_")

	var material := SoftBodyMaterial2D.new()
	material.stiffness = 5
	ResourceSaver.save(material, "res://locked_material.tres")
	material = load("res://locked_material.tres")
	FileAccess.set_unix_permissions(ProjectSettings.globalize_path("res://locked_material.tres"), 0x124) # r--r--r--
	body.soft_body_material = material
	EditorInterface.inspect_object(body)
	await frames(10)
	var panel: Control = plugin.inspector.panel
	panel.refresh()
	for advice: RefCounted in panel.shown_advice.duplicate():
		if advice.changes.has(&"stiffness"):
			panel.apply(advice)
	check_equal(material.stiffness, 5.0, "stiffness of the read-only material")
	check("read-only" in plugin.canvas.last_message, "the message says so: " + plugin.canvas.last_message)
	body.soft_body_material = null

	EditorInterface.save_scene()
	var inherited := "res://inherited_test.tscn"
	var file := FileAccess.open(inherited, FileAccess.WRITE)
	file.store_string("[gd_scene load_steps=2 format=3]\n\n[ext_resource type=\"PackedScene\" path=\"%s\" id=\"1\"]\n\n[node name=\"Root\" instance=ExtResource(\"1\")]\n" % SCENE)
	file.close()
	await open(inherited)
	await select_body()
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(20, 0))
	check("comes from" in plugin.canvas.last_message, "the message says so: " + plugin.canvas.last_message)
	var moved := body.polygon
	EditorInterface.save_scene()
	await frames(5)
	await open(inherited)
	await select_body()
	check_equal(body.polygon, moved, "the polygon in the inherited scene after loading")


func test_a_polygon_of_a_thousand_points_and_a_scale_of_zero_break_nothing() -> void:
	await open_scene({"polygon": SoftBody2D.make_circle_polygon(150, 1000)})
	for mode: int in [1, 2, 3]:
		plugin.set_mode(mode)
		move(on_screen(Vector2(10, 10)))
		await drawn()
	plugin.set_mode(1)
	await frames(3) # the panel beside the viewport goes
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(6, 0))
	check_near(polygon_on_screen(0), from + Vector2(6, 0), 0.05, "place of the dragged point")
	body.scale = Vector2(0.0, 1)
	take_errors() # the engine's own, of a node without size
	move(Vector2(200, 200))
	await click(Vector2(210, 200), MOUSE_BUTTON_RIGHT)
	await drawn()
	take_errors()
	body.scale = Vector2.ONE
	await frames(2)
	check_equal(body.polygon.size(), 1000, "points")


func test_the_plugin_is_switched_off_and_on_again_without_a_trace() -> void:
	await open_scene()
	var base := EditorInterface.get_base_control()
	var ours := func() -> int: return base.find_children("SoftBody2D*", "", true, false).filter(func(node: Node) -> bool:
		return node is Control or node is Node and not node is SoftBody2D).filter(func(node: Node) -> bool: return not node.is_queued_for_deletion()).size()
	var there: int = ours.call()
	check(there >= 4, "toolbar, panels and commands are there: %d" % there)
	var orphans := Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT)
	for i in 3:
		EditorInterface.set_plugin_enabled("soft_body_2d", false)
		await frames(5)
		check_equal(ours.call(), 0, "nodes of the addon while it is off")
		check(base.find_children("SoftBodyStability", "", true, false).is_empty(), "the panel is gone from the inspector")
		await drag(Vector2(100, 100), Vector2(120, 120))
		EditorInterface.set_plugin_enabled("soft_body_2d", true)
		await frames(5)
		check_equal(ours.call(), there, "nodes of the addon after it was switched on again")
	check_equal(Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT), orphans, "nodes outside of the tree")
	find_plugin()
	await select_body()
	var from := polygon_on_screen(0)
	await drag(from, from + Vector2(10, 0))
	check_near(polygon_on_screen(0), from + Vector2(10, 0), 0.01, "a point is dragged as before")


func _sprite(image: Image) -> Sprite2D:
	var sprite := Sprite2D.new()
	sprite.texture = ImageTexture.create_from_image(image)
	root().add_child(sprite)
	return sprite


# The addon has a message for it, or has changed the body.
func _trace(image: Image) -> void:
	var version := history().get_version()
	plugin.canvas.last_message = ""
	plugin.shapes.run(&"sprite_2d", {"count": 24, "threshold": 0.5, "margin": 0.0}, _sprite(image))
	for i in 600:
		await frames(1)
		if not is_instance_valid(plugin.shapes.job) and (plugin.canvas.last_message != ""
				or history().get_version() > version):
			break


func test_bad_pictures_are_told_of_and_large_ones_show_how_far_they_are() -> void:
	await open_scene()
	var before := values()
	var version := history().get_version()
	await _trace(Image.create(64, 64, false, Image.FORMAT_RGBA8))
	check("no opaque pixel" in plugin.canvas.last_message,
			"the message of an empty picture: " + plugin.canvas.last_message)
	check(bytes(body) == _bytes_of(before), "the body is as it was")
	check_equal(history().get_version(), version, "steps of undo")
	var islands := Image.create(64, 64, false, Image.FORMAT_RGBA8)
	islands.fill_rect(Rect2i(4, 4, 30, 30), Color.WHITE)
	islands.fill_rect(Rect2i(44, 44, 10, 10), Color.WHITE)
	await _trace(islands)
	check("2 islands" in plugin.canvas.last_message, "the message of two islands: " + plugin.canvas.last_message)
	check_equal(history().get_version(), version + 1, "steps of undo")
	var large := Image.create(4096, 4096, false, Image.FORMAT_RGBA8)
	large.fill_rect(Rect2i(500, 500, 3000, 2000), Color.WHITE)
	plugin.shapes.run(&"sprite_2d", {"count": 24, "threshold": 0.5, "margin": 0.0}, _sprite(large))
	check(is_instance_valid(plugin.shapes.job) and plugin.shapes.job.visible, "a bar shows how far it is, at once")
	for i in 600:
		if not is_instance_valid(plugin.shapes.job):
			break
		await frames(1)
	check_equal(history().get_version(), version + 2, "steps of undo after a picture of 4096 pixels")
	check_near(preload("res://addons/soft_body_2d/editor/logic/polygon_edit.gd").bounds(body.polygon).size, Vector2(3000,
			2000), 10, "size of its outline")


func test_menus_ask_and_do_what_they_say() -> void:
	await open_scene({"spring_stiffness_scales": PackedFloat32Array(range(1, 33))})
	var before := values()
	var version := history().get_version()
	plugin.toolbar.shape_menu.get_popup().id_pressed.emit(0)
	await frames(2)
	var dialog: ConfirmationDialog = plugin.shapes.dialog
	check(dialog.visible, "the dialog of the circle is shown")
	check_equal(dialog.fields["count"].value, 16.0, "points that it proposes")
	dialog.fields["count"].get_line_edit().text = "24" # typed, without Enter
	dialog.get_ok_button().pressed.emit()
	await frames(2)
	check_equal(body.polygon.size(), 24, "points")
	check("spring_stiffness_scales" in plugin.canvas.last_message,
			"the message names what is gone: " + plugin.canvas.last_message)
	await check_one_step(before, version, "a start shape")
	before = values()
	version = history().get_version()
	plugin.toolbar.structure_menu.get_popup().id_pressed.emit(3)
	check(body.inner_points.size() > 4 and not body.center_point, "a lattice: %d points" % body.inner_points.size())
	await check_one_step(before, version, "a structure")
	before = values()
	version = history().get_version()
	plugin.shapes.choose(&"mirror_horizontally", "")
	check(body.polygon != before[&"polygon"], "the polygon is mirrored")
	check_equal(body.get_warnings(), PackedStringArray(), "warnings")
	await check_one_step(before, version, "mirroring")
	plugin.shapes.choose(&"texture", "")
	check("no texture" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
	plugin.toolbar.help_button.pressed.emit()
	await frames(10)
	var help := EditorInterface.get_script_editor().find_children("*", "EditorHelp", true, false)
	check(help.any(func(page: Control) -> bool: return page.name == "SoftBody2D"),
			"the class reference is open: %s" % [help])
