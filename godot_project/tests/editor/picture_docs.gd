# SPDX-License-Identifier: MIT
@tool
extends "suite.gd"
## The pictures of docs/editor.md, taken of the running editor by scripts/editor_pictures.sh.

const COLOR := Color("6ab7a8")
const CAT := """<svg xmlns='http://www.w3.org/2000/svg' width='160' height='150'>
<path d='M22 12 58 34Q80 28 102 34L138 12Q152 60 146 92 130 144 80 144T14 92Q8 60 22 12z' fill='#e8a35c'/>
<path d='M32 30 48 40 34 52zM128 30 112 40 126 52z' fill='#f6c9a0'/>
<circle cx='55' cy='80' r='9' fill='#2d2a32'/><circle cx='105' cy='80' r='9' fill='#2d2a32'/>
<path d='M72 100h16l-8 9z' fill='#c4566b'/><path d='M80 109q-10 14-24 6M80 109q10 14 24 6' fill='none' stroke='#2d2a32' stroke-width='3'/>
</svg>"""


func set_up(driver: EditorPlugin, error_log: RefCounted) -> void:
	super(driver, error_log)
	check(true, "a picture claims nothing")


# The middle of the viewport, with what is beside it.
func _around(size := Vector2i(560, 380)) -> Rect2i:
	var area := viewport_area()
	return Rect2i(area.get_center() - size / 2, size).intersection(area)


func picture_polygon() -> void:
	await open_scene({"color": COLOR, "polygon": SoftBody2D.make_circle_polygon(60, 20)})
	plugin.polygon_mode.selection.add(body, [17, 18, 19, 0, 1, 2, 3])
	move(polygon_on_screen(10) + Vector2(200, 150))
	await shot("polygon", _around())


func picture_springs() -> void:
	await open_scene({"color": Color(COLOR, 0.35), "polygon": SoftBody2D.make_circle_polygon(60, 20)})
	plugin.shapes.set_preset(3)
	plugin.set_mode(2)
	plugin.springs_panel.tool_buttons[1].button_pressed = true
	plugin.springs_mode.brush.radius = 34.0
	plugin.springs_mode.brush.target = 6.0
	plugin.springs_panel.brush_fields["radius"].value = 34
	plugin.springs_panel.brush_fields["target"].value = 6
	await frames(4)
	await center_on(body.global_position, 7)
	await drag(on_screen(Vector2(-30, 40)), on_screen(Vector2(35, 38)), false, 8)
	plugin.springs_mode.brush.target = 0.3
	plugin.springs_panel.brush_fields["target"].value = 0.3
	await drag(on_screen(Vector2(-25, -40)), on_screen(Vector2(28, -42)), false, 8)
	var area := viewport_area()
	area.size.x += int(plugin.springs_panel.size.x) + 4
	await shot("springs", area)
	plugin.springs_panel.tool_buttons[0].button_pressed = true


func picture_pins() -> void:
	await open_scene({"color": COLOR})
	var holder := Node2D.new()
	holder.name = "Hook"
	holder.position = Vector2(300, 90)
	root().add_child(holder)
	holder.owner = root()
	plugin.set_mode(3)
	await frames(3)
	await center_on(body.global_position + Vector2(0, -30), 6)
	plugin.pins_mode.selection.add(body, [11, 12, 13])
	plugin.pins_mode.assign_selected(holder)
	plugin.pins_mode.selection.clear()
	plugin.pins_mode.selection.add(body, [4])
	plugin.pins_mode.pin_selected(true)
	var area := viewport_area()
	area.size.x += int(plugin.pins_panel.size.x) + 4
	await shot("pins", area)


func picture_holes() -> void:
	var holes: Array[PackedVector2Array] = [Transform2D(0, Vector2(-18, -6)) * SoftBody2D.make_circle_polygon(16, 8),
			Transform2D(0, Vector2(26, 12)) * SoftBody2D.make_box_polygon(Vector2(22, 22), 22)]
	await open_scene({"color": COLOR, "polygon": SoftBody2D.make_circle_polygon(60, 24), "holes": holes})
	plugin.set_mode(4)
	plugin.holes_mode.selection.add(body, [8, 9, 10, 11])
	await shot("holes", _around())


func picture_rope() -> void:
	var made := Node2D.new()
	made.name = "Root"
	var rope := SoftRope2D.new()
	rope.name = "Jelly"
	rope.position = Vector2(300, 200)
	rope.path = [Vector2(-90, -30), Vector2(-40, 20), Vector2(10, 10), Vector2(50, -30), Vector2(95, -10)]
	made.add_child(rope)
	rope.owner = made
	await close(SCENE)
	write_scene(made, SCENE)
	await open(SCENE)
	await select_body()
	plugin.path_mode.selection.add(body, [2])
	await shot("rope", _around())


func picture_detail() -> void:
	await open_scene({"color": Color(COLOR, 0.6), "polygon": SoftBody2D.make_circle_polygon(60, 120), "detail_mode": 1})
	plugin.set_mode(5)
	await frames(4)
	await center_on(body.global_position, 7)
	await drag(on_screen(Vector2(58, -14)), on_screen(Vector2(58, 14)), false, 12)
	var area := viewport_area()
	area.size.x += int(plugin.detail_panel.size.x) + 4
	await shot("detail", area)


func picture_preview() -> void:
	await open_scene({"color": COLOR, "stiffness": 40.0})
	plugin.set_preview(true)
	for i in 300:
		await frames(1)
		if plugin.preview.played > 120:
			break
	var top: Vector2 = plugin.canvas.scene_to_screen(body) * plugin.preview.world.get_polygon(0)[12]
	press(top)
	move(top + Vector2(50, -70))
	await frames(25)
	await shot("preview", _around(Vector2i(560, 500)))
	release()


func picture_stability() -> void:
	await open_scene({"color": COLOR, "stiffness": 6.0, "substeps": 12, "damping": 0.01})
	var panel: Control = plugin.inspector.panel
	panel.find_children("*", "Button", true, false)[0].button_pressed = true
	panel.refresh()
	await frames(10)
	var inspector := EditorInterface.get_inspector().get_global_rect()
	await shot("stability", Rect2i(Rect2(inspector.position, Vector2(inspector.size.x, panel.size.y + 16))))


func picture_materials() -> void:
	await open_scene()
	var picker: Control = plugin.inspector.picker
	picker.thumbnails[1].mouse_entered.emit()
	await frames(24)
	await shot("materials", Rect2i(picker.get_global_rect().grow(8)))


func picture_traced() -> void:
	await open_scene({"color": Color.WHITE})
	var sprite := Sprite2D.new()
	sprite.name = "Picture"
	var picture := Image.new()
	picture.load_svg_from_string(CAT)
	sprite.texture = ImageTexture.create_from_image(picture)
	sprite.position = body.position
	root().add_child(sprite)
	sprite.owner = root()
	var version := history().get_version()
	plugin.shapes.run(&"sprite_2d", {"count": 24, "threshold": 0.5, "margin": 1.0}, sprite)
	for i in 300:
		await frames(1)
		if history().get_version() > version:
			break
	sprite.hide()
	await center_on(body.global_position, 6)
	await shot("traced", _around())


# A sprite, a polygon, and a rigid body with a picture and two shapes, after they were converted together.
func picture_convert() -> void:
	await open_scene({"visible": false})
	var cat := Sprite2D.new()
	var picture := Image.new()
	picture.load_svg_from_string(CAT)
	cat.texture = ImageTexture.create_from_image(picture)
	cat.scale = Vector2(0.6, 0.6)
	var leaf := Polygon2D.new()
	leaf.polygon = SoftBody2D.make_capsule_polygon(14, 70, 9)
	leaf.color = COLOR
	var ball := RigidBody2D.new()
	var entries := [[cat, "Cat", Vector2(230, 200)], [leaf, "Leaf", Vector2(308, 200)], [ball, "Barbell", Vector2(370, 200)]]
	for entry: Array in entries:
		entry[0].name = entry[1]
		entry[0].position = entry[2]
		root().add_child(entry[0])
		entry[0].owner = root()
	for place: float in [-18, 18]:
		var shape := CollisionShape2D.new()
		shape.shape = CircleShape2D.new()
		shape.shape.radius = 24
		shape.position.y = place
		ball.add_child(shape)
		shape.owner = root()
	EditorInterface.get_selection().clear()
	for entry: Array in entries:
		EditorInterface.get_selection().add_node(entry[0])
	await frames(3)
	plugin.convert_menu.choose(0)
	for i in 300:
		await frames(1)
		if root().get_node("Barbell") is SoftBody2D:
			break
	await frames(30)
	await shot("convert", _around(Vector2i(560, 300)))


func picture_toolbar() -> void:
	await open_scene({"color": COLOR})
	var bar: Rect2 = plugin.toolbar.get_global_rect()
	await shot("toolbar", Rect2i(bar.grow(6)))


# Last: its message stays for a while.
func picture_refused() -> void:
	await open_scene({"color": COLOR})
	press(polygon_on_screen(0))
	move(on_screen(Vector2(-20, 6)))
	move(on_screen(Vector2(-72, 6)))
	await shot("refused", _around())
	release()
