# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What becomes of nodes that are converted to soft bodies, and of bodies that are baked, without an editor.

const LOGIC := "res://addons/soft_body_2d/editor/logic/"
const Bake := preload(LOGIC + "bake.gd")
const Conversion := preload(LOGIC + "conversion.gd")
const PolygonEdit := preload(LOGIC + "polygon_edit.gd")
const SpriteOutline := preload(LOGIC + "sprite_outline.gd")
const ShapeOutlines := preload(LOGIC + "shape_outlines.gd")
const VisualValues := preload(LOGIC + "visual_values.gd")

const SQUARE: PackedVector2Array = [Vector2(0, 0), Vector2(40, 0), Vector2(40, 40), Vector2(0, 40)]
const CROSSED: PackedVector2Array = [Vector2(0, 0), Vector2(40, 40), Vector2(40, 0), Vector2(0, 40)]

var _made: Array[Node] = []


func tear_down() -> void:
	for node in _made:
		node.free()
	await super()


func _texture(size := Vector2i(64, 32)) -> Texture2D:
	return ImageTexture.create_from_image(Image.create(size.x, size.y, false, Image.FORMAT_RGBA8))


func _keep(node: Node, name: String, properties := {}) -> Node:
	node.name = name
	for property: StringName in properties:
		node.set(property, properties[property])
	_made.append(node)
	return node


func _child(parent: Node, node: Node, name: String, properties := {}) -> Node:
	node.name = name
	for property: StringName in properties:
		node.set(property, properties[property])
	parent.add_child(node)
	return node


func _polygon(properties := {}) -> Polygon2D:
	return _keep(Polygon2D.new(), "Leaf", {&"polygon": SQUARE}.merged(properties, true))


func _ball(shape: Shape2D = circle(20), properties := {}) -> RigidBody2D:
	var ball: RigidBody2D = _keep(RigidBody2D.new(), "Ball", properties)
	if shape != null:
		_child(ball, CollisionShape2D.new(), "Shape", {&"shape": shape})
	return ball


## A body takes all these values.
func _check_taken(values: Dictionary, what: String) -> SoftBody2D:
	var body: SoftBody2D = _keep(SoftBody2D.new(), "Body")
	for property: StringName in values:
		body.set(property, values[property])
	for property: StringName in values:
		check_equal(body.get(property), values[property], "%s of %s" % [property, what])
	return body


func _check_problem(node: Node2D, fragments: PackedStringArray, traced := PackedVector2Array()) -> void:
	var made: Conversion = Conversion.of(node, traced)
	for fragment in fragments:
		check(fragment in made.problem, "the message holds '%s': %s" % [fragment, made.problem])


func test_only_four_kinds_of_nodes_can_be_converted() -> void:
	for type: StringName in [&"Sprite2D", &"Polygon2D", &"CollisionPolygon2D", &"RigidBody2D"]:
		check(Conversion.can_convert(_keep(ClassDB.instantiate(type), "N")), "a %s can be converted" % type)
	for type: StringName in [&"Node2D", &"SoftBody2D", &"StaticBody2D", &"PhysicalBone2D", &"CollisionShape2D"]:
		check(not Conversion.can_convert(_keep(ClassDB.instantiate(type), "N")), "a %s cannot be converted" % type)
	check(not Conversion.can_convert(null), "nothing cannot be converted")
	_check_problem(_keep(Node2D.new(), "Plain"), ["'Plain' is no Sprite2D"])


func test_what_every_node_stores_is_kept() -> void:
	var material := CanvasItemMaterial.new()
	var expected := {&"position": Vector2(3, -4), &"rotation": 0.5, &"scale": Vector2(2, 1.5), &"skew": 0.25,
			&"visible": false, &"modulate": Color(1, 0.5, 0.25, 0.5), &"self_modulate": Color(0.5, 1, 1),
			&"z_index": 7, &"z_as_relative": false, &"y_sort_enabled": true, &"show_behind_parent": true,
			&"light_mask": 6, &"visibility_layer": 3, &"texture_filter": CanvasItem.TEXTURE_FILTER_NEAREST,
			&"texture_repeat": CanvasItem.TEXTURE_REPEAT_MIRROR, &"material": material,
			&"process_mode": Node.PROCESS_MODE_ALWAYS, &"process_priority": 5, &"editor_description": "green"}
	var made: Conversion = Conversion.of(_polygon(expected))
	var body := _check_taken(made.values, "the body")
	for property: StringName in expected:
		check_equal(made.values.get(property), expected[property], "value of " + property)
		check_equal(body.get(property), expected[property], property)
	check(not made.values.has(&"script"), "the script is not among them")


func test_a_polygon_gives_its_points_texture_coordinates_and_color() -> void:
	var texture := _texture()
	var uv: PackedVector2Array = [Vector2(1, 2), Vector2(30, 2), Vector2(30, 20), Vector2(1, 20)]
	var made: Conversion = Conversion.of(_polygon({&"offset": Vector2(5, -5), &"color": Color.RED, &"texture": texture,
			&"uv": uv, &"texture_offset": Vector2(3, 4), &"texture_scale": Vector2(2, 3), &"texture_rotation": 0.5,
			&"antialiased": true}))
	check_equal(made.problem, "", "problem")
	check_equal(made.values[&"polygon"], Transform2D(0, Vector2(5, -5)) * SQUARE, "polygon")
	check_equal(made.values[&"uv"], uv, "texture coordinates")
	check_equal(made.values[&"texture"], texture, "texture")
	check_equal(made.values[&"texture_offset"], Vector2(3, 4), "texture offset")
	check_equal(made.values[&"texture_scale"], Vector2(2, 3), "texture scale")
	check_near(made.values[&"texture_rotation"], 0.5, 1e-6, "texture rotation")
	check_equal(made.values[&"color"], Color.RED, "color")
	check_equal(made.values[&"antialiased"], true, "antialiased")
	check("Resample" in "".join(made.notes), "four points are told of: %s" % [made.notes])
	_check_taken(made.values, "a polygon")


func test_a_polygon_without_coordinates_shows_a_pixel_of_the_texture_a_pixel() -> void:
	var made: Conversion = Conversion.of(_polygon({&"texture": _texture(), &"offset": Vector2(5, -5)}))
	check_equal(made.values[&"uv"], Transform2D(0, Vector2(5, -5)) * SQUARE, "texture coordinates")
	made = Conversion.of(_polygon({&"uv": SQUARE}))
	check(not made.values.has(&"uv"), "a polygon without a texture gives no coordinates")


func test_colors_and_coordinates_stay_with_their_points_where_some_are_left_out() -> void:
	var points: PackedVector2Array = [Vector2(0, 0), Vector2(40, 0), Vector2(40, 0), Vector2(40, 40), Vector2(0, 40),
			Vector2(20, 20)]
	var uv: PackedVector2Array = [Vector2(0, 0), Vector2(1, 0), Vector2(9, 9), Vector2(1, 1), Vector2(0, 1), Vector2(8, 8)]
	var colors: PackedColorArray = [Color.RED, Color.GREEN, Color.WHITE, Color.BLUE, Color.YELLOW, Color.BLACK]
	var made: Conversion = Conversion.of(_polygon({&"polygon": points, &"uv": uv, &"vertex_colors": colors,
			&"internal_vertex_count": 1, &"texture": _texture(), &"color": Color.RED}))
	check_equal(made.values[&"polygon"], SQUARE, "polygon")
	check_equal(made.values[&"uv"], PackedVector2Array([Vector2(0, 0), Vector2(1, 0), Vector2(1, 1), Vector2(0, 1)]),
			"texture coordinates")
	check_equal(made.values[&"vertex_colors"], PackedColorArray([Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW]),
			"colors of points")
	check_equal(made.values[&"color"], Color.WHITE, "color, which those of points take the place of")
	made = Conversion.of(_polygon({&"polygon": points, &"vertex_colors": colors, &"uv": uv, &"texture": _texture(),
			&"polygons": [PackedInt32Array([4, 0, 1, 3])]}))
	check_equal(made.values[&"vertex_colors"], PackedColorArray([Color.YELLOW, Color.RED, Color.GREEN, Color.BLUE]),
			"colors by index")
	check_equal(made.values[&"uv"], PackedVector2Array([Vector2(0, 1), Vector2(0, 0), Vector2(1, 0), Vector2(1, 1)]),
			"coordinates by index")
	check_equal(made.values[&"polygon"], PackedVector2Array([Vector2(0, 40), Vector2(0, 0), Vector2(40, 0), Vector2(40, 40)]),
			"outline of a single polygon by index")


func test_outlines_that_no_body_can_have_are_refused_with_what_to_do() -> void:
	_check_problem(_polygon({&"polygon": CROSSED}), ["'Leaf'", "edge 0-1 meets edge 2-3", "Move its points apart"])
	_check_problem(_polygon({&"polygon": PackedVector2Array()}), ["'Leaf' has no outline", "at least 3 points"])
	_check_problem(_polygon({&"invert_enabled": true, &"invert_border": 0.0}), ["'Leaf' is inverted", "wider Invert > Border"])
	_check_problem(_polygon({&"polygons": [PackedInt32Array([0, 1, 2]), PackedInt32Array([0, 2, 3])]}),
			["2 polygons", "UV editor"])
	_check_problem(_polygon({&"polygons": [PackedInt32Array([0, 1, 9])]}), ["a point 9 that is not there"])
	_check_problem(_keep(CollisionPolygon2D.new(), "Wall", {&"polygon": CROSSED}), ["'Wall'", "Move its points apart"])
	_check_problem(_keep(Sprite2D.new(), "Cat"), ["'Cat' has no texture", "give it one"])
	_check_problem(_ball(null), ["'Ball' has no shape", "add a CollisionShape2D"])
	_check_problem(_ball(WorldBoundaryShape2D.new()), ["'Shape' has no area"])
	_check_problem(_ball(SegmentShape2D.new()), ["'Shape' has no area"])
	var apart := _ball()
	_child(apart, CollisionShape2D.new(), "Far", {&"shape": circle(5), &"position": Vector2(100, 0)})
	_check_problem(apart, ["The shapes of 'Ball' do not touch", "Move them together"])
	var ring := _ball(rectangle(100, 10))
	for place: Array in [[rectangle(10, 100), Vector2(45, 45)], [rectangle(100, 10), Vector2(0, 90)], [rectangle(10, 100),
			Vector2(-45, 45)]]:
		_child(ring, CollisionShape2D.new(), "Side", {&"shape": place[0], &"position": place[1]})
	var made: Conversion = Conversion.of(ring)
	check_equal(made.problem, "", "problem of a frame")
	check_equal(made.values[&"holes"].size(), 1, "holes of a frame")
	check_near(absf(PolygonEdit.signed_area(made.values[&"holes"][0])), 80.0 * 80.0, 1, "area of its hole")
	_child(ring, CollisionShape2D.new(), "Lid", {&"shape": rectangle(90, 90), &"position": Vector2(0, 45)})
	check(not Conversion.of(ring).values.has(&"holes"), "a shape over the hole fills it")
	var crossed := _ball(null)
	_child(crossed, CollisionPolygon2D.new(), "Bow", {&"polygon": CROSSED})
	_check_problem(crossed, ["'Bow' has an outline that no body can have", "convert 'Ball'"])


func test_an_inverted_polygon_is_a_frame_with_a_hole() -> void:
	var made: Conversion = Conversion.of(_polygon({&"invert_enabled": true, &"invert_border": 20.0, &"offset": Vector2(5, 0)}))
	check_equal(made.problem, "", "problem")
	var holes: Array[PackedVector2Array] = made.values[&"holes"]
	check_equal(holes.size(), 1, "holes")
	var box := PolygonEdit.bounds(holes[0])
	check_near(PolygonEdit.bounds(made.values[&"polygon"]).position, box.position - Vector2(20, 20), 0.01, "frame")
	check_near(PolygonEdit.bounds(made.values[&"polygon"]).size, box.size + Vector2(40, 40), 0.01, "size of the frame")
	check_equal(SoftBody2D.get_holes_problem(holes, made.values[&"polygon"]), "", "what keeps a body from having it")


func test_a_sprite_gives_its_holes_where_they_are_seen() -> void:
	var traced: PackedVector2Array = [Vector2(0, 0), Vector2(16, 0), Vector2(16, 8), Vector2(0, 8)]
	var hole: PackedVector2Array = [Vector2(2, 2), Vector2(6, 2), Vector2(6, 6)]
	var over: PackedVector2Array = [Vector2(12, 2), Vector2(20, 2), Vector2(20, 6)]
	var sprite: Sprite2D = _keep(Sprite2D.new(), "Cat", {&"texture": _texture(), &"flip_h": true})
	var made: Conversion = Conversion.of(sprite, traced, [hole, over] as Array[PackedVector2Array])
	check_equal(made.values[&"holes"], [SpriteOutline.to_local(sprite, hole)] as Array[PackedVector2Array], "holes")
	check("1 holes" in ", ".join(made.notes), "a note about the one over the edge")


func test_a_collision_polygon_gives_its_outline_and_the_layers_of_its_parent() -> void:
	var floor_body: StaticBody2D = _keep(StaticBody2D.new(), "Floor", {&"collision_layer": 4, &"collision_mask": 9})
	var wall := _child(floor_body, CollisionPolygon2D.new(), "Wall", {&"polygon": SQUARE, &"position": Vector2(7, 8)})
	var made: Conversion = Conversion.of(wall)
	check_equal(made.values[&"polygon"], SQUARE, "polygon")
	check_equal(made.values[&"position"], Vector2(7, 8), "position")
	check_equal(made.values[&"collision_layer"], 4, "layer")
	check_equal(made.values[&"collision_mask"], 9, "mask")
	made = Conversion.of(_keep(CollisionPolygon2D.new(), "Alone", {&"polygon": SQUARE}))
	check(not made.values.has(&"collision_layer"), "without a body the layers are those of a new node")


func test_a_sprite_gives_its_texture_with_region_frame_flip_and_offset_as_coordinates() -> void:
	var traced: PackedVector2Array = [Vector2(0, 0), Vector2(16, 0), Vector2(16, 8), Vector2(0, 8)]
	var texture := _texture()
	var plain: Sprite2D = _keep(Sprite2D.new(), "Cat", {&"texture": texture})
	var made: Conversion = Conversion.of(plain, traced)
	check_equal(made.values[&"polygon"], Transform2D(0, Vector2(-32, -16)) * traced, "polygon of a centered sprite")
	check_equal(made.values[&"uv"], traced, "coordinates")
	check_equal(made.values[&"texture"], texture, "texture")
	var sprite: Sprite2D = _keep(Sprite2D.new(), "Cat", {&"texture": texture, &"region_enabled": true,
			&"region_rect": Rect2(10, 4, 32, 16), &"hframes": 2, &"frame": 1, &"flip_h": true, &"centered": false,
			&"offset": Vector2(100, 200), &"modulate": Color.RED})
	made = Conversion.of(sprite, traced)
	check_equal(made.values[&"polygon"], PackedVector2Array([Vector2(116, 200), Vector2(100, 200), Vector2(100, 208),
			Vector2(116, 208)]), "polygon of a flipped region")
	check_equal(made.values[&"uv"], Transform2D(0, Vector2(26, 4)) * traced, "coordinates within the second frame")
	check_equal(made.values[&"modulate"], Color.RED, "modulate")
	_check_taken(made.values, "a sprite")


func test_a_rigid_body_gives_layers_mass_material_damps_and_velocities() -> void:
	var surface_of := surface(0.7, 0.3)
	var expected := {&"collision_layer": 6, &"collision_mask": 10, &"mass": 12.5, &"gravity_scale": 0.5,
			&"physics_material_override": surface_of, &"linear_damp": 0.5, &"linear_damp_mode": RigidBody2D.DAMP_MODE_REPLACE,
			&"angular_damp": 0.25, &"angular_damp_mode": RigidBody2D.DAMP_MODE_REPLACE, &"linear_velocity": Vector2(30, -40),
			&"angular_velocity": 2.0, &"constant_force": Vector2(1, 2), &"constant_torque": 3.0, &"lock_rotation": true,
			&"freeze": true, &"can_sleep": false, &"contact_monitor": true, &"max_contacts_reported": 5,
			&"input_pickable": true, &"disable_mode": CollisionObject2D.DISABLE_MODE_KEEP_ACTIVE}
	var made: Conversion = Conversion.of(_ball(circle(20), expected))
	check_equal(made.problem, "", "problem")
	for property: StringName in expected:
		check_equal(made.values.get(property), expected[property], "value of " + property)
	check_equal(made.values[&"mass_mode"], SoftBody2D.MASS_MODE_CUSTOM, "mass mode")
	_check_taken(made.values, "a rigid body")
	made = Conversion.of(_ball())
	check(not made.values.has(&"max_contacts_reported"), "no contacts reported leaves the number of a new node")


func test_shapes_give_outlines_of_their_size_and_place() -> void:
	var capsule := CapsuleShape2D.new()
	capsule.radius = 10
	capsule.height = 60
	var round_capsule := CapsuleShape2D.new()
	round_capsule.radius = 10
	round_capsule.height = 20
	var convex := ConvexPolygonShape2D.new()
	convex.points = SQUARE
	for entry: Array in [[circle(20), Rect2(-20, -20, 40, 40), PI * 400], [rectangle(60, 30), Rect2(-30, -15, 60, 30), 1800.0],
			[capsule, Rect2(-10, -30, 20, 60), PI * 100 + 800], [round_capsule, Rect2(-10, -10, 20, 20), PI * 100],
			[convex, Rect2(0, 0, 40, 40), 1600.0]]:
		var outline := ShapeOutlines.of_shape(entry[0])
		var type: String = entry[0].get_class()
		check_near(PolygonEdit.bounds(outline).position, entry[1].position, 0.5, "place of a " + type)
		check_near(PolygonEdit.bounds(outline).size, entry[1].size, 0.5, "size of a " + type)
		check_near(absf(PolygonEdit.signed_area(outline)), entry[2], 0.03 * entry[2], "area of a " + type)
	check_above(ShapeOutlines.of_shape(rectangle(60, 30)).size(), 20, "points of a rectangle")
	check_equal(ShapeOutlines.of_shape(convex), SQUARE, "points of a convex polygon")
	var placed := _ball(null)
	_child(placed, CollisionPolygon2D.new(), "Hull", {&"polygon": SQUARE, &"position": Vector2(5, 6), &"rotation": PI / 2})
	check_points_near(Conversion.of(placed).values[&"polygon"], Transform2D(PI / 2, Vector2(5, 6)) * SQUARE, 1e-4,
			"a turned polygon")


func test_shapes_that_touch_are_joined_and_go_and_disabled_ones_do_not_count() -> void:
	var tee := _ball(rectangle(60, 20))
	_child(tee, CollisionShape2D.new(), "Stem", {&"shape": rectangle(20, 60), &"position": Vector2(0, 40)})
	_child(tee, CollisionShape2D.new(), "Off", {&"shape": circle(100), &"disabled": true})
	var made: Conversion = Conversion.of(tee)
	check_equal(made.problem, "", "problem")
	check_near(absf(PolygonEdit.signed_area(made.values[&"polygon"])), 60 * 20 + 20 * 60, 1, "area of both together")
	check_equal(PolygonEdit.bounds(made.values[&"polygon"]), Rect2(-30, -10, 60, 80), "box of both together")
	check_equal(made.used.map(func(node: Node) -> String: return node.name), ["Shape", "Stem"], "nodes that go")
	# In this order the second touches the first only by way of the third.
	var chain := _ball(rectangle(20, 20))
	_child(chain, CollisionShape2D.new(), "End", {&"shape": rectangle(20, 20), &"position": Vector2(40, 0)})
	_child(chain, CollisionShape2D.new(), "Link", {&"shape": rectangle(24, 20), &"position": Vector2(20, 0)})
	made = Conversion.of(chain)
	check_equal(PolygonEdit.bounds(made.values.get(&"polygon", PackedVector2Array())), Rect2(-10, -10, 60, 20), "box of a chain")
	var held := _ball()
	_child(held.get_child(0), Node2D.new(), "Mark")
	made = Conversion.of(held)
	check_equal(made.used, [] as Array[Node], "a shape with a child does not go")
	check("'Shape' stays" in "".join(made.notes), "and is told of: %s" % [made.notes])


func test_the_picture_of_a_rigid_body_goes_onto_the_soft_one() -> void:
	var texture := _texture(Vector2i(40, 40))
	var shader := ShaderMaterial.new()
	var ball := _ball(circle(20))
	_child(ball, Sprite2D.new(), "Far", {&"texture": _texture(), &"position": Vector2(200, 0)})
	_child(ball, Sprite2D.new(), "Look", {&"texture": texture, &"scale": Vector2(2, 2), &"modulate": Color(1, 0.5, 1),
			&"self_modulate": Color(0.5, 1, 1), &"material": shader, &"texture_filter": CanvasItem.TEXTURE_FILTER_NEAREST})
	_child(ball, Sprite2D.new(), "Eye", {&"texture": _texture()})
	var made: Conversion = Conversion.of(ball)
	check_equal(made.values.get(&"texture"), texture, "texture")
	check_equal(made.values.get(&"color"), Color(0.5, 0.5, 1), "color")
	check_equal(made.values.get(&"material"), shader, "material")
	check_equal(made.values.get(&"texture_filter"), CanvasItem.TEXTURE_FILTER_NEAREST, "filter")
	# The sprite shows its 40 pixels on 80, about its middle.
	check_points_near(made.values[&"uv"], Transform2D(0, Vector2(0.5, 0.5), 0, Vector2(20, 20)) * made.values[&"polygon"], 1e-4,
			"texture coordinates")
	check_equal(made.used.map(func(node: Node) -> String: return node.name), ["Shape", "Look"], "nodes that go")
	_check_taken(made.values, "a body with a picture")
	var hidden := _ball()
	_child(hidden, Sprite2D.new(), "Look", {&"texture": texture, &"visible": false})
	check(not Conversion.of(hidden).values.has(&"texture"), "a hidden sprite gives nothing")


func test_coordinates_of_a_flipped_region_and_of_a_polygon_are_where_their_pixels_are() -> void:
	var sprite: Sprite2D = _keep(Sprite2D.new(), "Look", {&"texture": _texture(), &"region_enabled": true,
			&"region_rect": Rect2(8, 4, 20, 10), &"flip_h": true, &"offset": Vector2(1, 2)})
	check_near(VisualValues.sprite_pixels(sprite) * Vector2(1 - 10, 2 - 5), Vector2(28, 4), 1e-4, "upper left corner, flipped")
	check_near(VisualValues.sprite_pixels(sprite) * Vector2(1 + 10, 2 + 5), Vector2(8, 14), 1e-4, "lower right corner, flipped")
	var texture := _texture()
	var leaf := _polygon({&"texture": texture, &"texture_offset": Vector2(2, 3), &"texture_scale": Vector2(2, 2),
			&"offset": Vector2(10, 0)})
	check_near(VisualValues.polygon_pixels(leaf)[0] * Vector2(1, 1), Vector2(26, 8), 1e-4,
			"pixel of a polygon without coordinates: (1 + 10 + 2) · 2, (1 + 3) · 2")
	leaf.uv = Transform2D(0, Vector2(0.5, 0.25), 0, Vector2(4, 6)) * SQUARE
	leaf.texture_offset = Vector2.ZERO
	leaf.texture_scale = Vector2.ONE
	check_near(VisualValues.polygon_pixels(leaf)[0] * Vector2(30, 20), Vector2(14, 11), 1e-4, "pixel by its own coordinates")
	leaf.uv[2] += Vector2(5, 0)
	check_equal(VisualValues.polygon_pixels(leaf), [] as Array[Transform2D], "a bent texture")
	var ball := _ball(rectangle(30, 30))
	_child(ball, Polygon2D.new(), "Look", {&"polygon": Transform2D(0, Vector2(-20, -20)) * SQUARE, &"color": Color.GREEN,
			&"texture": texture, &"texture_offset": Vector2(20, 20)})
	var made: Conversion = Conversion.of(ball)
	check_equal(made.values.get(&"color"), Color.GREEN, "color of a polygon")
	check_points_near(made.values.get(&"uv", PackedVector2Array()), Transform2D(0, Vector2(20, 20)) * made.values[&"polygon"],
			1e-4, "texture coordinates by a polygon")


func test_a_body_is_baked_with_texture_coordinates_and_color() -> void:
	var texture := _texture()
	var uv: PackedVector2Array = [Vector2(1, 2), Vector2(30, 2), Vector2(30, 20), Vector2(1, 20)]
	var body: SoftBody2D = _keep(SoftBody2D.new(), "Jelly", {&"polygon": SQUARE, &"color": Color(1, 0.5, 0.25),
			&"texture": texture, &"uv": uv, &"texture_offset": Vector2(3, 4), &"texture_scale": Vector2(2, 3),
			&"texture_rotation": 0.5, &"antialiased": true, &"position": Vector2(9, 8), &"z_index": 3})
	var moved := Transform2D(0, Vector2(1, 1)) * SQUARE
	var expected := {&"polygon": moved, &"color": Color(1, 0.5, 0.25), &"texture": texture, &"uv": uv,
			&"texture_offset": Vector2(3, 4), &"texture_scale": Vector2(2, 3), &"antialiased": true,
			&"position": Vector2(9, 8), &"z_index": 3}
	var values := Bake.values_of(body, moved)
	var baked: Polygon2D = _keep(Polygon2D.new(), "Baked")
	for property: StringName in values:
		baked.set(property, values[property])
	for property: StringName in expected:
		check_equal(baked.get(property), expected[property], property)
	check_near(baked.texture_rotation, 0.5, 1e-6, "texture_rotation")
	body.vertex_colors = [Color.RED, Color.WHITE, Color.WHITE, Color.BLACK]
	check_equal(Bake.values_of(body, SQUARE)[&"vertex_colors"], PackedColorArray([Color(1, 0, 0), Color(1, 0.5, 0.25),
			Color(1, 0.5, 0.25), Color(0, 0, 0)]), "colors of points, by that of the body")
	body.texture = null
	check(not Bake.values_of(body, SQUARE).has(&"uv"), "without a texture there are no coordinates")


func test_a_body_without_coordinates_is_baked_with_the_whole_texture_in_its_box() -> void:
	var body: SoftBody2D = _keep(SoftBody2D.new(), "Jelly", {&"polygon": SQUARE, &"texture": _texture()})
	check_equal(Bake.values_of(body, SQUARE)[&"uv"], PackedVector2Array([Vector2(0, 0), Vector2(64, 0), Vector2(64, 32),
			Vector2(0, 32)]), "texture coordinates")
	body.texture_scale = Vector2(2, 2)
	body.texture_rotation = PI / 2
	var values := Bake.values_of(body, SQUARE)
	# As a Polygon2D applies them: the middle stays, the rest is turned and scaled about it.
	var shown := Transform2D(PI / 2, Vector2.ZERO).scaled(Vector2(2, 2)) * PackedVector2Array(values[&"uv"])
	check_points_near(shown, PackedVector2Array([Vector2(64, -48), Vector2(64, 80), Vector2(0, 80), Vector2(0, -48)]), 1e-3,
			"what is shown turned and at half its size")
	var atlas := AtlasTexture.new()
	atlas.atlas = _texture()
	atlas.region = Rect2(16, 8, 32, 16)
	body.texture = atlas
	body.texture_scale = Vector2.ONE
	body.texture_rotation = 0
	values = Bake.values_of(body, SQUARE)
	check_equal(values[&"texture"], atlas.atlas, "texture of an atlas")
	check_equal(values[&"uv"], PackedVector2Array([Vector2(16, 8), Vector2(48, 8), Vector2(48, 24), Vector2(16, 24)]),
			"coordinates within the atlas")


func test_what_is_converted_and_baked_is_what_it_was() -> void:
	var texture := _texture()
	var uv: PackedVector2Array = [Vector2(1, 2), Vector2(30, 2), Vector2(30, 20), Vector2(1, 20)]
	for properties: Dictionary in [{}, {&"texture": texture, &"uv": uv, &"texture_scale": Vector2(2, 3)},
			{&"vertex_colors": PackedColorArray([Color.RED, Color.GREEN, Color.BLUE, Color.YELLOW])}]:
		var leaf := _polygon(properties)
		var body := _check_taken(Conversion.of(leaf).values, "a polygon")
		var values := Bake.values_of(body, body.polygon)
		for property: StringName in [&"polygon", &"texture", &"uv", &"texture_scale", &"vertex_colors"]:
			if properties.has(property) or property == &"polygon":
				check_equal(values.get(property), leaf.get(property), property)


func test_the_present_outline_is_where_the_points_are() -> void:
	var body := add_body(Vector2(100, 50), {"rotation": 0.5, "gravity_scale": 0.0})
	await ticks(2)
	check_points_near(Bake.present_outline(body), body.polygon, 0.01, "outline of a body that has not moved")
	var place := body.to_global(Vector2(70, 5))
	body.set_point_position(0, place)
	check_near(body.to_global(Bake.present_outline(body)[0]), place, 0.01, "a point that was moved")
	check_above(Bake.present_outline(body)[0].distance_to(body.polygon[0]), 10, "its way from where it was designed")
	check_equal(Bake.present_outline(_keep(SoftBody2D.new(), "New")).size(), 16, "points of a node outside of the tree")
