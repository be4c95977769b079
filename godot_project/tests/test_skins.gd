# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Polygons that bend with a body.


class Probe extends Node:
	signal processed

	func _process(_delta: float) -> void:
		processed.emit()


# After every node's own work for a frame, before it is drawn.
func frame() -> void:
	var probe := Probe.new()
	probe.process_priority = 1000
	stage.add_child(probe)
	await probe.processed
	probe.queue_free()


func add_skin(body: SoftBody2D, polygon: PackedVector2Array, properties := {}) -> SoftBodySkin2D:
	var skin := SoftBodySkin2D.new()
	skin.polygon = polygon
	for property: StringName in properties:
		skin.set(property, properties[property])
	body.add_child(skin)
	return skin


# Where the skin's points are on the screen's plane in this frame, as the engine draws it below the body's canvas item.
func _shown(skin: SoftBodySkin2D) -> PackedVector2Array:
	var body := skin.get_parent() as SoftBody2D
	return body.get_interpolated_transform() * skin.transform * Transform2D(0, skin.offset) * skin.polygon


func test_a_skin_of_the_bodys_own_points_is_where_the_body_is_drawn() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -160), {"polygon": SoftBody2D.make_circle_polygon(50, 24)})
	var skin := add_skin(body, body.polygon)
	var most := 0.0
	for i in 90:
		await ticks(1)
		await frame()
		check_points_near(_shown(skin), body.get_interpolated_polygon(), 0.01, "the skin in tick %d" % i)
		most = maxf(most, bounds_of(polygon_of(body)).size.x)
	check_above(most, 103.0, "widest, when it is squashed")


func test_a_skin_goes_with_a_body_that_flies_and_spins_and_grows() -> void:
	var body := add_weightless_body(Vector2(100, 50))
	var skin := add_skin(body, [Vector2(-20, -10), Vector2(30, 0), Vector2(0, 70), Vector2(-60, 60)],
			{&"position": Vector2(4, -6), &"rotation": 0.7, &"scale": Vector2(1.4, -0.8), &"offset": Vector2(3, 2)})
	var rest := skin.transform * Transform2D(0, skin.offset) * skin.polygon
	body.linear_velocity = Vector2(120, 40)
	body.angular_velocity = 2
	await seconds(1)
	await frame()
	check_points_near(_shown(skin), body.get_interpolated_transform() * rest, 0.7, "points in, on and outside of the body")
	check_above(absf(body.global_rotation), 1.0, "turn of the body")


func test_texture_coordinates_colors_and_inner_vertices_stay() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -80))
	var polygon := PackedVector2Array([Vector2(-40, -40), Vector2(40, -40), Vector2(40, 40), Vector2(-40, 40), Vector2.ZERO])
	var uv := PackedVector2Array([Vector2(0, 0), Vector2(64, 0), Vector2(64, 64), Vector2(0, 64), Vector2(32, 32)])
	var colors := PackedColorArray([Color.RED, Color.GREEN, Color.BLUE, Color.WHITE, Color.BLACK])
	var texture := ImageTexture.create_from_image(Image.create(64, 64, false, Image.FORMAT_RGBA8))
	var parts := [PackedInt32Array([0, 1, 4]), PackedInt32Array([1, 2, 4]), PackedInt32Array([2, 3, 4]), PackedInt32Array([3, 0, 4])]
	var skin := add_skin(body, polygon, {&"uv": uv, &"vertex_colors": colors, &"texture": texture, &"polygons": parts, &"internal_vertex_count": 1})
	await seconds(1)
	await frame()
	check(skin.polygon != polygon, "the skin has followed")
	check_equal([skin.uv, skin.vertex_colors, skin.texture, skin.polygons, skin.internal_vertex_count], [uv, colors, texture, parts, 1], "what is shown on it")
	var box := bounds_of(skin.polygon.slice(0, 4))
	check(box.has_point(skin.polygon[4]), "the inner vertex is inside: %s" % skin.polygon)


func test_a_skin_follows_in_every_detail_mode() -> void:
	add_floor(0)
	var outline := SoftBody2D.make_circle_polygon(50, 120)
	for mode: int in [SoftBody2D.DETAIL_MODE_AS_DRAWN, SoftBody2D.DETAIL_MODE_AUTOMATIC]:
		var body := add_body(Vector2(200 * mode, -120), {"polygon": outline, "detail_mode": mode})
		var skin := add_skin(body, outline)
		await seconds(1)
		await frame()
		check_points_near(_shown(skin), body.get_interpolated_polygon(), 0.02, "the skin in mode %d" % mode)


func test_a_skin_keeps_step_with_and_without_physics_interpolation() -> void:
	for interpolated: bool in [false, true]:
		tree.physics_interpolation = interpolated
		var body := add_weightless_body(Vector2(0, 0))
		var skin := add_skin(body, body.polygon)
		body.linear_velocity = Vector2(300, 0)
		body.angular_velocity = 3
		await ticks(20)
		for i in 6:
			await frame()
			check_points_near(_shown(skin), body.get_interpolated_polygon(), 0.01, "the skin in a frame, interpolation %s" % interpolated)
		body.queue_free()
		await ticks(1)
	tree.physics_interpolation = false


func test_a_copy_of_a_bent_body_has_its_skin_as_designed() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -45), {"stiffness": 30.0})
	var design := PackedVector2Array([Vector2(-40, -40), Vector2(40, -40), Vector2(30, 45), Vector2(-30, 45)])
	var skin := add_skin(body, design)
	await seconds(1)
	check(skin.polygon != design, "the skin is bent")
	check_equal(skin.rest_polygon, design, "its design")
	var copy: SoftBodySkin2D = skin.duplicate()
	check_equal(copy.polygon, design, "polygon of a copy")
	copy.free()
	skin.owner = body
	var packed := PackedScene.new()
	packed.pack(body)
	var saved := packed.instantiate()
	check_equal((saved.get_child(0) as SoftBodySkin2D).polygon, design, "polygon of a saved copy")
	saved.free()
	body.remove_child(skin)
	check_equal(skin.polygon, design, "polygon out of the tree")
	skin.free()


func test_what_a_script_sets_is_a_new_design() -> void:
	var body := add_weightless_body(Vector2(40, 0))
	var skin := add_skin(body, [Vector2(-20, -20), Vector2(20, -20), Vector2(0, 20)])
	body.angular_velocity = 1
	await ticks(30)
	await frame()
	var other := PackedVector2Array([Vector2(-10, -30), Vector2(30, -10), Vector2(10, 30), Vector2(-30, 0)])
	skin.polygon = other
	await ticks(2)
	await frame()
	check_equal(skin.rest_polygon, other, "the design")
	check_points_near(_shown(skin), body.get_interpolated_transform() * other, 0.4, "the new polygon")
	body.polygon = SoftBody2D.make_box_polygon(Vector2(80, 80), 20)
	await ticks(2)
	await frame()
	check_points_near(_shown(skin), body.get_interpolated_transform() * other, 0.4, "the polygon on another body")


func test_it_says_where_it_belongs() -> void:
	var alone := SoftBodySkin2D.new()
	stage.add_child(alone)
	check(alone.get_warnings().size() == 2 and "child of a SoftBody2D" in alone.get_warnings()[0], "warnings of one that is alone: %s" % alone.get_warnings())
	await ticks(2)
	check_equal(alone.polygon.size(), 0, "points of one that is alone")
	var body := add_weightless_body(Vector2.ZERO)
	var skin := add_skin(body, body.polygon)
	check_equal(skin.get_warnings(), PackedStringArray(), "warnings of one that is in its place")
	skin.skeleton = ^"../Bones"
	check(skin.get_warnings().size() == 1 and "skeleton" in skin.get_warnings()[0], "warnings beside a skeleton")


func test_skins_of_the_example_stay_on_their_bodies() -> void:
	var scene: Node2D = (load("res://examples/skins.tscn") as PackedScene).instantiate()
	stage.add_child(scene)
	await seconds(4)
	await frame()
	for skin: SoftBodySkin2D in scene.find_children("*", "SoftBodySkin2D"):
		check_equal(skin.get_warnings(), PackedStringArray(), "warnings of %s" % skin.name)
		var box := bounds_of(polygon_of(skin.get_parent())).grow(80)
		for point in _shown(skin):
			check(box.has_point(point), "%s lies near its body: %s, %s" % [skin.name, point, box])
	var ball: SoftBody2D = scene.get_node("Ball")
	check_points_near(_shown(ball.get_node("Skin")).slice(0, 24), ball.get_interpolated_polygon(), 0.02, "the rim of the ball")
