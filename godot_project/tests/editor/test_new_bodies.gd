# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## What bodies get that are newly added in the editor, and who gets none of it.

const CANVAS_COLOR := "rendering/environment/defaults/default_clear_color"

var _canvas: Color


func set_up(driver: EditorPlugin, error_log: RefCounted) -> void:
	super(driver, error_log)
	_canvas = ProjectSettings.get_setting(CANVAS_COLOR)


func tear_down() -> void:
	ProjectSettings.set_setting(CANVAS_COLOR, _canvas)
	await super()


# As the dialog Create New Node does.
func _create(made: Node2D) -> Node2D:
	var undo := plugin.get_undo_redo()
	undo.create_action("Create Node", UndoRedo.MERGE_DISABLE, root())
	undo.add_do_method(root(), &"add_child", made, true)
	undo.add_do_method(made, &"set_owner", root())
	undo.add_do_reference(made)
	undo.add_undo_method(root(), &"remove_child", made)
	undo.commit_action()
	await frames(2)
	return made


func test_a_body_that_is_added_has_automatic_detail_and_undo_takes_it_away() -> void:
	await open_scene()
	check_equal(body.detail_mode, SoftBody2D.DETAIL_MODE_AS_DRAWN, "detail of a body of a scene that was there")
	var version := history().get_version()
	var made: SoftBody2D = await _create(SoftBody2D.new())
	check_equal(made.detail_mode, SoftBody2D.DETAIL_MODE_AUTOMATIC, "detail of a new body")
	check_equal([made.look, made.color], [SoftBody2D.LOOK_AUTOMATIC, Color.WHITE], "look and color on the usual canvas")
	check_equal(made.get_simulated_polygon(), made.polygon, "what is simulated of its 16 points")
	made.polygon = SoftBody2D.make_circle_polygon(50, 200)
	check(made.get_simulated_polygon().size() <= 24, "points that are simulated of 200: %d" % made.get_simulated_polygon().size())
	check_equal(history().get_version(), version + 1, "steps of undo")
	await undo()
	check(not made.is_inside_tree(), "undo takes the node away")
	await redo()
	check(made.is_inside_tree() and made.detail_mode == SoftBody2D.DETAIL_MODE_AUTOMATIC, "redo brings it back as it was")
	made.name = "Made"
	await save_and_reload()
	check_equal(root().get_node("Made").detail_mode, SoftBody2D.DETAIL_MODE_AUTOMATIC, "detail after saving")
	check_equal(body.detail_mode, SoftBody2D.DETAIL_MODE_AS_DRAWN, "detail of the body that was there, after saving")


func test_what_a_script_a_scene_or_the_clipboard_brings_is_left_as_it_is() -> void:
	await open_scene()
	var added := SoftBody2D.new()
	root().add_child(added) # as a tool script does
	added.owner = root()
	await frames(2)
	check_equal(added.detail_mode, SoftBody2D.DETAIL_MODE_AS_DRAWN, "detail of a body that a script has added")
	var copied := SoftBody2D.new()
	copied.color = Color.TOMATO
	copied.polygon = SoftBody2D.make_circle_polygon(50, 40)
	await _create(copied) # as duplicating and pasting do
	check_equal([copied.detail_mode, copied.look], [SoftBody2D.DETAIL_MODE_AS_DRAWN, SoftBody2D.LOOK_AUTOMATIC], "detail and look of a copy")
	var scripted := SoftBody2D.new()
	scripted.set_script(GDScript.new())
	(scripted.get_script() as GDScript).source_code = "extends SoftBody2D"
	(scripted.get_script() as GDScript).reload()
	await _create(scripted)
	check_equal(scripted.detail_mode, SoftBody2D.DETAIL_MODE_AS_DRAWN, "detail of a body with a script")


func test_the_color_of_a_new_body_stands_out_from_the_canvas_and_stays() -> void:
	await open_scene() # once: a scene that is written anew while it is open makes the editor ask
	var seen := {}
	for canvas: Color in [Color.WHITE, Color(0.85, 0.86, 0.8), Color(0.2, 0.62, 0.57), Color.BLACK, Color("4d4d4d")]:
		ProjectSettings.set_setting(CANVAS_COLOR, canvas)
		var made: SoftBody2D = await _create(SoftBody2D.new())
		check_equal(made.get_look_in_use(), SoftBody2D.LOOK_SOFT, "look on %s" % canvas)
		var color := made.get_color_in_use()
		var lights := [canvas.srgb_to_linear().get_luminance() + 0.05, color.srgb_to_linear().get_luminance() + 0.05]
		check(lights.max() / lights.min() > 2.2, "contrast with %s is %s" % [canvas, lights.max() / lights.min()])
		made.position = Vector2(420, 200)
		made.name = "On%s" % canvas.to_html(false)
		await shot("new_on_%s" % canvas.to_html(false))
		seen[String(made.name)] = color
	ProjectSettings.set_setting(CANVAS_COLOR, Color.BLACK)
	await frames(4)
	for name: String in seen:
		check_equal(root().get_node(name).get_color_in_use(), seen[name], "color after the canvas has changed, %s" % name)
	await save_and_reload()
	for name: String in seen:
		check_equal(root().get_node(name).get_color_in_use(), seen[name], "color after saving, %s" % name)


func test_a_texture_is_not_tinted_by_the_color_of_a_new_body() -> void:
	await open_scene()
	ProjectSettings.set_setting(CANVAS_COLOR, Color.WHITE)
	body = await _create(SoftBody2D.new())
	check(body.color != Color.WHITE, "a new body on a light canvas has a color")
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(body)
	await frames(30)
	var given := body.color
	for property: EditorProperty in EditorInterface.get_inspector().find_children("*", "EditorProperty", true, false):
		if property.get_edited_property() == &"texture":
			property.emit_changed(&"texture", ImageTexture.create_from_image(Image.create(8, 8, false, Image.FORMAT_RGBA8)))
	await frames(3)
	check_equal([body.color, body.look], [Color.WHITE, SoftBody2D.LOOK_SOFT], "color and look beside the texture")
	await undo()
	check_equal([body.color, body.texture == null], [given, true], "color and texture after undo")


func test_bodies_that_are_traced_or_converted_have_automatic_detail_where_they_have_many_points() -> void:
	await open_scene()
	var picture := Image.create(96, 96, false, Image.FORMAT_RGBA8)
	for y in 96:
		for x in 96:
			var place := Vector2(x - 48, y - 48)
			if place.length() < 34 + 8 * sin(5 * place.angle()):
				picture.set_pixel(x, y, Color.WHITE)
	body.texture = ImageTexture.create_from_image(picture)
	var before := values()
	var version := history().get_version()
	plugin.shapes.run(&"texture", {"count": 60, "threshold": 0.5, "margin": 1.0})
	for i in 300:
		await frames(1)
		if history().get_version() > version:
			break
	check(body.polygon.size() > 16, "points of the trace: %d" % body.polygon.size())
	check_equal(body.detail_mode, SoftBody2D.DETAIL_MODE_AUTOMATIC, "detail of the traced body")
	await check_one_step(before, version, "tracing")
	var entries := [[PackedVector2Array(SoftBody2D.make_circle_polygon(40, 12)), SoftBody2D.DETAIL_MODE_AS_DRAWN],
			[PackedVector2Array(SoftBody2D.make_circle_polygon(40, 48)), SoftBody2D.DETAIL_MODE_AUTOMATIC]]
	for i in 2:
		var leaf := Polygon2D.new()
		leaf.polygon = entries[i][0]
		leaf.name = "Leaf%d" % i
		root().add_child(leaf)
		leaf.owner = root()
	EditorInterface.get_selection().clear()
	for i in 2:
		EditorInterface.get_selection().add_node(root().get_node("Leaf%d" % i))
	await frames(3)
	plugin.convert_menu.choose(0)
	await frames(5)
	for i in 2:
		var made := root().get_node("Leaf%d" % i) as SoftBody2D
		if check(made != null, "the polygon is converted"):
			check_equal(made.detail_mode, entries[i][1], "detail of a converted polygon of %d points" % made.polygon.size())


func test_painted_springs_stay_when_a_new_body_gets_a_seventeenth_point() -> void:
	await open_scene({"detail_mode": SoftBody2D.DETAIL_MODE_AUTOMATIC, "elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	var scales := PackedFloat32Array()
	for i in body.get_spring_count():
		scales.append(1.0 + i * 0.1)
	body.spring_stiffness_scales = scales
	for i in 4:
		await click((polygon_on_screen(4 * i) + polygon_on_screen(4 * i + 1)) / 2)
	check_equal(body.polygon.size(), 20, "points")
	check_equal(body.get_simulated_polygon(), body.polygon, "what is simulated")
	check_equal(body.spring_stiffness_scales.size(), body.get_spring_count(), "factors")
	for factor: float in [scales[0], scales[1], scales[15]]:
		check(factor in body.spring_stiffness_scales, "the factor %s is still there" % factor)
