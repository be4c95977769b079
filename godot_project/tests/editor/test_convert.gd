# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## The menu Convert: nodes of the scene become soft bodies and soft bodies Polygon2D nodes, in one step of undo.

const ConvertMenu := preload("res://addons/soft_body_2d/editor/ui/convert_menu.gd")
const SQUARE: PackedVector2Array = [Vector2(0, 0), Vector2(40, 0), Vector2(40, 40), Vector2(0, 40)]
const CROSSED: PackedVector2Array = [Vector2(0, 0), Vector2(40, 40), Vector2(40, 0), Vector2(0, 40)]


func _add(node: Node, name: String, properties := {}, parent: Node = root()) -> Node:
	node.name = name
	for property: StringName in properties:
		node.set(property, properties[property])
	parent.add_child(node)
	node.owner = root()
	return node


func _add_ball(parent: Node = root()) -> RigidBody2D:
	var circle := CircleShape2D.new()
	circle.radius = 20
	var ball: RigidBody2D = _add(RigidBody2D.new(), "Ball", {&"position": Vector2(420, 240), &"mass": 3.0,
			&"collision_layer": 4}, parent)
	_add(CollisionShape2D.new(), "Shape", {&"shape": circle}, ball)
	_add(Sprite2D.new(), "Look", {&"texture": load("res://icon.svg"), &"scale": Vector2(0.4, 0.4)}, ball)
	_add(Node2D.new(), "Mark", {&"position": Vector2(0, -30)}, ball)
	return ball


func _select(names: Array) -> void:
	var selection := EditorInterface.get_selection()
	selection.clear()
	for name: String in names:
		selection.add_node(root().get_node(name))
	await frames(3)


# The label of every entry that the menu has, by id.
func _entries() -> Dictionary:
	var popup: PopupMenu = plugin.convert_menu.get_popup()
	var shown := {}
	for i in popup.item_count:
		shown[popup.get_item_id(i)] = popup.get_item_text(i)
	return shown if plugin.convert_menu.visible else {}


# Chooses it, and waits until what is traced is done.
func _choose(item: ConvertMenu.Item) -> void:
	plugin.canvas.last_message = ""
	plugin.convert_menu.get_popup().id_pressed.emit(item)
	for i in 600:
		await frames(1)
		if not is_instance_valid(plugin.convert_commands.job) and plugin.canvas.last_message != "":
			break
	await frames(2)


# Everything of the scene that is stored, and which nodes these are: the very same after undo.
func _describe(node: Node) -> String:
	var lines := PackedStringArray(["%s %s %d owner %s groups %s" % [node.get_path(), node.get_class(),
			node.get_instance_id(), node.owner, node.get_groups().filter(func(g: StringName) -> bool: return not g.begins_with("_"))]])
	for property in node.get_property_list():
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			lines.append("  %s = %s" % [property["name"], str(node.get(property["name"]))])
	for child in node.get_children():
		lines.append(_describe(child))
	return "\n".join(lines)


func _version() -> int:
	var manager := plugin.get_undo_redo()
	return manager.get_history_undo_redo(manager.get_object_history_id(root())).get_version()


func _history() -> UndoRedo:
	var manager := plugin.get_undo_redo()
	return manager.get_history_undo_redo(manager.get_object_history_id(root()))


# One step more since `version`; undoing it gives the scene of before, and redoing it that of after.
func _check_step(before: String, version: int, what: String) -> void:
	check_equal(_version(), version + 1, "steps of undo made by " + what)
	var after := _describe(root())
	_history().undo()
	await frames(2)
	check_equal(_describe(root()), before, "the scene after undo of " + what)
	_history().redo()
	await frames(2)
	check_equal(_describe(root()), after, "the scene after redo of " + what)


func test_a_polygon_becomes_a_body_in_its_place_with_children_groups_and_name() -> void:
	await open_scene()
	var texture: Texture2D = load("res://icon.svg")
	var leaf: Polygon2D = _add(Polygon2D.new(), "Leaf", {&"polygon": SQUARE, &"texture": texture, &"color": Color.GREEN,
			&"position": Vector2(400, 180), &"rotation": 0.25, &"z_index": 3, &"visible": true, &"unique_name_in_owner": true})
	leaf.add_to_group(&"leaves", true)
	leaf.set_meta(&"season", "fall")
	var branch := _add(Node2D.new(), "Branch", {&"position": Vector2(5, 6)}, leaf)
	_add(Node2D.new(), "Tip", {}, branch)
	_add(Node2D.new(), "Last")
	await _select(["Leaf"])
	check_equal(_entries(), {0: "Convert to SoftBody2D"}, "entries for a polygon")
	await shot("convert_before")
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.CONVERT)
	var made := root().get_node("Leaf") as SoftBody2D
	if not check(made != null, "there is a SoftBody2D: " + plugin.canvas.last_message):
		return
	check_equal(made.get_index(), 1, "place among siblings")
	check_equal(made.owner, root(), "owner")
	check_equal(root().get_node("%Leaf"), made, "the node by its unique name")
	check_equal(made.polygon, SQUARE, "polygon")
	check_equal(made.texture, texture, "texture")
	check_equal(made.uv, SQUARE, "texture coordinates")
	check_equal(made.color, Color.GREEN, "color")
	check_equal(made.position, Vector2(400, 180), "position")
	check_near(made.rotation, 0.25, 1e-6, "rotation")
	check_equal(made.z_index, 3, "z index")
	check(made.is_in_group(&"leaves"), "the group is kept")
	check_equal(made.get_meta(&"season", ""), "fall", "metadata")
	check_equal(made.get_children(), [branch] as Array[Node], "children")
	check_equal(branch.owner, root(), "owner of a child")
	check_equal(branch.get_child(0).owner, root(), "owner of a child's child")
	check_equal(EditorInterface.get_selection().get_selected_nodes(), [made] as Array[Node], "selection")
	await shot("convert_after")
	await _check_step(before, version, "converting a polygon")
	EditorInterface.save_scene()
	await frames(5)
	await open(SCENE)
	await select_body(["Leaf"])
	check_equal(body.polygon, SQUARE, "polygon after saving and loading")
	check(root().get_node_or_null("Leaf/Branch/Tip") != null, "children are saved")


func test_several_nodes_become_bodies_in_one_step() -> void:
	await open_scene()
	_add(Sprite2D.new(), "Cat", {&"texture": load("res://icon.svg"), &"position": Vector2(380, 180), &"flip_h": true})
	_add(CollisionPolygon2D.new(), "Wall", {&"polygon": SQUARE, &"position": Vector2(250, 240)})
	var ball := _add_ball()
	var mark := ball.get_node("Mark")
	await _select(["Cat", "Wall", "Ball", "Ball/Look"])
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.CONVERT)
	for name: String in ["Cat", "Wall", "Ball"]:
		if not check(root().get_node_or_null(name) is SoftBody2D, "%s is a SoftBody2D: %s" % [name, plugin.canvas.last_message]):
			return
	check_equal(root().get_children().map(func(node: Node) -> String: return node.name), ["Jelly", "Cat", "Wall", "Ball"],
			"nodes in order")
	var cat := root().get_node("Cat") as SoftBody2D
	check(cat.polygon.size() > 3 and cat.polygon.size() <= 32, "points of the sprite: %d" % cat.polygon.size())
	check_equal(cat.texture, load("res://icon.svg"), "texture of the sprite")
	check_near(cat.uv[0].x, cat.texture.get_size().x / 2 - cat.polygon[0].x, 0.01, "flipped coordinates of the sprite")
	var made := root().get_node("Ball") as SoftBody2D
	check_equal(made.get_children(), [mark] as Array[Node], "children of the ball: its shape and picture are gone")
	check_equal(made.collision_layer, 4, "layer")
	check_equal(made.mass, 3.0, "mass")
	check_equal(made.mass_mode, SoftBody2D.MASS_MODE_CUSTOM, "mass mode")
	check_equal(made.polygon.size(), 24, "points of the ball")
	check_equal(made.texture, load("res://icon.svg"), "texture of the ball")
	await shot("convert_several")
	await _check_step(before, version, "converting several nodes")
	_history().undo()
	await frames(2)
	check_equal(EditorInterface.get_selection().get_selected_nodes().size(), 3, "selected nodes after undo")
	_history().redo() # the editor counts what it undoes itself


func test_a_script_stays_where_a_body_can_have_it() -> void:
	for type: String in ["Node2D", "Polygon2D"]:
		var file := FileAccess.open("res://convert_%s.gd" % type, FileAccess.WRITE)
		file.store_string("extends %s\n\n@export var speed := 1.0\n" % type)
		file.close()
	await open_scene()
	for type: String in ["Node2D", "Polygon2D"]:
		var script: Script = load("res://convert_%s.gd" % type)
		_add(Polygon2D.new(), type, {&"polygon": SQUARE, &"script": script, &"speed": 7.5})
	await _select(["Node2D", "Polygon2D"])
	var kept: Script = root().get_node("Node2D").get_script()
	check_equal(root().get_node("Node2D").get(&"speed"), 7.5, "the exported value before")
	await _choose(ConvertMenu.Item.CONVERT)
	check_equal(root().get_node("Node2D").get_class(), "SoftBody2D", "class of the first")
	check_equal(root().get_node("Node2D").get_script(), kept, "script that extends Node2D")
	check_equal(root().get_node("Node2D").get(&"speed"), 7.5, "its exported value")
	check_equal(root().get_node("Polygon2D").get_class(), "SoftBody2D", "class of the second")
	check_equal(root().get_node("Polygon2D").get_script(), null, "script that extends Polygon2D")
	check("The script of 'Polygon2D' stays behind" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
	check(not "The script of 'Node2D'" in plugin.canvas.last_message, "the message names no other script")


func test_undo_works_while_the_addon_is_off() -> void:
	await open_scene()
	_add_ball()
	await _select(["Ball"])
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.CONVERT)
	EditorInterface.set_plugin_enabled("soft_body_2d", false)
	await frames(5)
	var manager := EditorInterface.get_editor_undo_redo()
	var steps := manager.get_history_undo_redo(manager.get_object_history_id(root()))
	check_equal(steps.get_version(), version + 1, "steps of undo")
	var after := _describe(root())
	steps.undo()
	await frames(2)
	check_equal(_describe(root()), before, "the scene after undo")
	steps.redo()
	await frames(2)
	check_equal(_describe(root()), after, "the scene after redo")
	EditorInterface.set_plugin_enabled("soft_body_2d", true)
	await frames(5)
	find_plugin()


func test_where_one_cannot_be_converted_nothing_changes_and_the_message_says_what_to_do() -> void:
	await open_scene()
	_add(Polygon2D.new(), "Good", {&"polygon": SQUARE})
	_add(Polygon2D.new(), "Bad", {&"polygon": CROSSED})
	var locked := _add(Polygon2D.new(), "Locked", {&"polygon": SQUARE})
	locked.set_meta(&"_edit_lock_", true)
	var clear := ImageTexture.create_from_image(Image.create(16, 16, false, Image.FORMAT_RGBA8))
	_add(Sprite2D.new(), "Clear", {&"texture": clear})
	var before := _describe(root())
	var version := _version()
	for entry: Array in [["Bad", "Move its points apart"], ["Locked", "is locked"], ["Clear", "Clear: The picture has no opaque pixel"]]:
		await _select(["Good", entry[0]])
		await _choose(ConvertMenu.Item.CONVERT)
		check(entry[1] in plugin.canvas.last_message, "the message holds '%s': %s" % [entry[1], plugin.canvas.last_message])
		check_equal(_describe(root()), before, "the scene, with " + entry[0])
		check_equal(_version(), version, "steps of undo, with " + entry[0])
	await _select(["Jelly"])
	check_equal(_entries(), {4: "Add Skin", 1: "Bake to Polygon2D", 2: "Bake to Polygon2D as It Is Now"}, "entries for a body")
	_add(Node2D.new(), "Plain")
	await _select(["Plain"])
	check_equal(_entries(), {}, "entries for another node")


func test_nodes_of_other_scenes_are_not_converted() -> void:
	var part := Polygon2D.new()
	part.name = "Part"
	part.polygon = SQUARE
	write_scene(part, "res://convert_part.tscn")
	await open_scene()
	var instance: Node = load("res://convert_part.tscn").instantiate()
	_add(instance, "Part")
	await _select(["Part"])
	var before := _describe(root())
	await _choose(ConvertMenu.Item.CONVERT)
	check("comes from convert_part.tscn" in plugin.canvas.last_message, "the message: " + plugin.canvas.last_message)
	check_equal(_describe(root()), before, "the scene")
	instance.free() # or the editor would load it anew when it sees the file


func test_the_root_of_a_scene_is_converted() -> void:
	var ball := RigidBody2D.new()
	ball.name = "Ball"
	ball.mass = 2
	var shape := CollisionShape2D.new()
	shape.name = "Shape"
	shape.shape = RectangleShape2D.new()
	ball.add_child(shape)
	shape.owner = ball
	var mark := Node2D.new()
	mark.name = "Mark"
	ball.add_child(mark)
	mark.owner = ball
	write_scene(ball, "res://convert_root.tscn")
	await open("res://convert_root.tscn")
	EditorInterface.get_selection().clear()
	EditorInterface.get_selection().add_node(root())
	await frames(3)
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.CONVERT)
	if check(root() is SoftBody2D, "the root is a SoftBody2D: " + plugin.canvas.last_message):
		check_equal(root().name, &"Ball", "name")
		check_equal(root().scene_file_path, "res://convert_root.tscn", "file of the scene")
		check_equal(root().get_children().map(func(node: Node) -> String: return node.name), ["Mark"], "children")
		check_equal(root().get_node("Mark").owner, root(), "owner of a child")
		await _check_step(before, version, "converting the root")
		EditorInterface.save_scene()
		await frames(5)
		var saved: Node = (ResourceLoader.load("res://convert_root.tscn", "", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene).instantiate()
		check(saved is SoftBody2D and saved.get_child_count() == 1, "the scene is saved with it: %s" % saved)
		check_equal(saved.get(&"mass"), 2.0, "mass that is saved")
		saved.free()


func test_connections_that_a_body_has_an_end_for_are_kept() -> void:
	await open_scene()
	var ball := _add_ball()
	var timer: Timer = _add(Timer.new(), "Timer")
	ball.body_entered.connect(Callable(timer, &"set_wait_time"), CONNECT_PERSIST)
	ball.sleeping_state_changed.connect(Callable(timer, &"stop"), CONNECT_PERSIST)
	timer.timeout.connect(Callable(ball, &"hide"), CONNECT_PERSIST)
	timer.renamed.connect(Callable(ball, &"move_and_collide"), CONNECT_PERSIST)
	await _select(["Ball"])
	var version := _version()
	await _choose(ConvertMenu.Item.CONVERT)
	var made := root().get_node("Ball") as SoftBody2D
	if not check(made != null, "there is a SoftBody2D: " + plugin.canvas.last_message):
		return
	check(made.is_connected(&"body_entered", Callable(timer, &"set_wait_time")), "a signal that both have")
	check(timer.timeout.is_connected(Callable(made, &"hide")), "a signal of another node")
	check(not timer.timeout.is_connected(Callable(ball, &"hide")), "and no longer to the old node")
	check(not timer.renamed.is_connected(Callable(ball, &"move_and_collide")), "a method that a body has not")
	check("renamed" in plugin.canvas.last_message, "the message names it: " + plugin.canvas.last_message)
	_history().undo()
	await frames(2)
	check_equal(_version(), version, "steps of undo")
	check(timer.timeout.is_connected(Callable(ball, &"hide")), "undo connects the old node again")
	check(not timer.timeout.is_connected(Callable(made, &"hide")), "and no longer the new one")
	check(timer.renamed.is_connected(Callable(ball, &"move_and_collide")), "also what the body has no method for")
	_history().redo()


func test_a_body_is_baked_as_it_was_designed() -> void:
	await open_scene({&"texture": load("res://icon.svg"), &"color": Color.ORANGE})
	var designed := body.polygon
	var mark := _add(Node2D.new(), "Mark", {}, body)
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.BAKE)
	var baked := root().get_node("Jelly") as Polygon2D
	if not check(baked != null, "there is a Polygon2D: " + plugin.canvas.last_message):
		return
	check_equal(baked.polygon, designed, "polygon")
	check_equal(baked.texture, load("res://icon.svg"), "texture")
	check_equal(baked.color, Color.ORANGE, "color")
	check_equal(baked.uv.size(), designed.size(), "texture coordinates")
	check_near(baked.uv[0], Vector2(baked.texture.get_size().x, baked.texture.get_size().y / 2), 0.01, "coordinate of the rightmost point")
	check_equal(baked.get_children(), [mark] as Array[Node], "children")
	await shot("baked")
	await _check_step(before, version, "baking")


func test_a_body_is_baked_as_the_preview_shows_it() -> void:
	await open_scene()
	var designed := body.polygon
	plugin.set_preview(true)
	for i in 300:
		await frames(1)
		if plugin.preview.played > 60:
			break
	var shown: PackedVector2Array = body.get_global_transform().affine_inverse() * plugin.preview.world.get_polygon(0)
	check(shown[0].distance_to(designed[0]) > 5, "the body falls in the preview")
	await _choose(ConvertMenu.Item.BAKE_PRESENT)
	var baked := root().get_node("Jelly") as Polygon2D
	if not check(baked != null, "there is a Polygon2D: " + plugin.canvas.last_message):
		return
	for i in shown.size():
		check_near(baked.polygon[i], shown[i], 0.01, "point %d as the preview showed it" % i)
	check(not plugin.preview.is_playing(), "the preview has ended")


func test_the_scene_tree_offers_it_in_its_context_menu() -> void:
	if not ClassDB.class_exists(&"EditorContextMenuPlugin"):
		skip("this engine has no plugins of context menus (4.4)")
		return
	await open_scene()
	_add(Polygon2D.new(), "Leaf", {&"polygon": SQUARE})
	await _select(["Leaf"])
	var docks := tree.root.find_children("*", "SceneTreeDock", true, false)
	if not check(docks.size() == 1, "the scene tree: %s" % [docks]):
		return
	var nodes := docks[0].find_children("*", "SceneTreeEditor", true, false)[0].find_children("*", "Tree", true, false)[0] as Tree
	var item := nodes.get_root()
	while item != null and item.get_text(0) != "Leaf":
		item = item.get_next_visible()
	if not check(item != null, "the tree shows the polygon"):
		return
	var place := nodes.get_global_transform_with_canvas() * nodes.get_item_area_rect(item, 0).get_center()
	for pressed: bool in [true, false]:
		var event := InputEventMouseButton.new()
		event.button_index = MOUSE_BUTTON_RIGHT
		event.pressed = pressed
		event.position = place
		event.global_position = place
		tree.root.push_input(event)
	await frames(3)
	var found := false
	for popup: PopupMenu in docks[0].find_children("*", "PopupMenu", true, false):
		for i in popup.item_count:
			if popup.visible and popup.get_item_text(i) == "Convert to SoftBody2D":
				found = true
				await shot("convert_context")
				popup.id_pressed.emit(popup.get_item_id(i))
				popup.hide()
				break
	check(found, "the context menu has the entry")
	await frames(10)
	check(root().get_node("Leaf") is SoftBody2D, "the polygon is a SoftBody2D")


func test_a_polygon_below_a_body_becomes_its_skin() -> void:
	await open_scene()
	var leaf: Polygon2D = _add(Polygon2D.new(), "Leaf", {&"polygon": SQUARE, &"uv": SQUARE, &"texture": load("res://icon.svg"), &"color": Color.ORANGE,
			&"position": Vector2(-20, -10), &"rotation": 0.3, &"z_index": 2, &"internal_vertex_count": 0}, body)
	leaf.add_to_group(&"leaves", true)
	_add(Node2D.new(), "Mark", {}, leaf)
	_add(Polygon2D.new(), "Apart", {&"polygon": SQUARE})
	await _select(["Apart"])
	check(not ConvertMenu.Item.SKIN in _entries(), "a polygon that is below no body is none: %s" % _entries())
	await _select(["Jelly/Leaf"])
	check_equal(_entries().get(ConvertMenu.Item.SKIN), "Convert to SoftBodySkin2D", "entry")
	var before := _describe(root())
	var version := _version()
	var values := {}
	for property: StringName in [&"polygon", &"uv", &"texture", &"color", &"position", &"rotation", &"z_index"]:
		values[property] = leaf.get(property)
	await _choose(ConvertMenu.Item.SKIN)
	var skin := body.get_node("Leaf") as SoftBodySkin2D
	if not check(skin != null, "there is a skin: " + plugin.canvas.last_message):
		return
	for property: StringName in values:
		check_equal(skin.get(property), values[property], "%s of the skin" % property)
	check_equal([skin.is_in_group(&"leaves"), skin.get_child_count(), skin.owner], [true, 1, root()], "group, children, owner")
	check_equal(skin.get_warnings(), PackedStringArray(), "warnings")
	await _check_step(before, version, "making a skin")


func test_a_body_gets_a_skin_of_its_looks() -> void:
	await open_scene({"texture": load("res://icon.svg"), "color": Color.ORANGE})
	await _select(["Jelly"])
	check_equal(_entries().get(ConvertMenu.Item.ADD_SKIN), "Add Skin", "entry")
	var before := _describe(root())
	var version := _version()
	await _choose(ConvertMenu.Item.ADD_SKIN)
	var skin := body.get_node_or_null("Skin") as SoftBodySkin2D
	if not check(skin != null, "there is a skin: " + plugin.canvas.last_message):
		return
	check_equal([skin.polygon, skin.texture, skin.color, skin.transform], [body.polygon, body.texture, Color.ORANGE, Transform2D()], "what it shows, and where")
	check_equal(skin.uv.size(), body.polygon.size(), "texture coordinates")
	check_equal(body.self_modulate.a, 0.0, "opacity of the body itself")
	await shot("skin_added")
	await _check_step(before, version, "adding a skin")
	await save_and_reload()
	check(body.get_node("Skin") is SoftBodySkin2D, "the skin is saved")
