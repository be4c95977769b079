# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## One-way shapes: they hold what comes from their upper side, and let through what comes from below.


func time_limit() -> int:
	return 30000


func _box(position: Vector2, properties := {}) -> SoftBody2D:
	return add_body(position, { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0, "rolling_resistance": 0.1 }.merged(properties))


func _add_platform(solid: CollisionObject2D, transform := Transform2D.IDENTITY) -> CollisionShape2D:
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(300, 16)
	collision.one_way_collision = true
	collision.transform = transform
	solid.add_child(collision)
	stage.add_child(solid)
	return collision


func _clear_stage() -> void:
	for node in stage.get_children():
		node.free()
	await ticks(2)


## Thrown up from below with 700 px/s, a body rises 250 px: through the platform 130 px above, onto which it falls back.
func test_a_body_jumps_through_a_platform_from_below_and_lands_on_it() -> void:
	for rate: int in [30, 60, 120, 240]:
		Engine.physics_ticks_per_second = rate
		for solid: CollisionObject2D in [StaticBody2D.new(), AnimatableBody2D.new()]:
			add_floor(400)
			solid.position = Vector2(0, 240)
			_add_platform(solid)
			var soft := _box(Vector2(0, 368))
			await seconds(0.5)
			soft.apply_central_impulse(Vector2(0, -750))
			var highest := 400.0
			for i in rate:
				await ticks(1)
				highest = minf(highest, bounds_of(polygon_of(soft)).end.y)
			var what := "%s at %d ticks" % [solid.get_class(), rate]
			check_below(highest, 180, "highest place of the lower side over a " + what)
			await seconds(2)
			check_near(bounds_of(polygon_of(soft)).end.y, 232.0, 1, "lower side on a " + what)
			await _clear_stage()


## Turned upside down, by a rotation or by mirroring, it holds from the other side only.
func test_the_side_that_holds_turns_with_the_shape() -> void:
	for upside_down: Transform2D in [Transform2D(PI, Vector2.ZERO), Transform2D(0, Vector2(1, -1), 0, Vector2.ZERO)]:
		for turned_is_the_body: bool in [true, false]:
			var solid := StaticBody2D.new()
			solid.transform = (upside_down if turned_is_the_body else Transform2D.IDENTITY).translated(Vector2(0, 100))
			_add_platform(solid, Transform2D.IDENTITY if turned_is_the_body else upside_down)
			var soft := _box(Vector2(0, 0))
			await seconds(1)
			check_above(soft.get_center_of_mass_position().y, 300, "y of the body over a platform upside down (%s)" % upside_down)
			soft.free()
			soft = _box(Vector2(0, 200), { "gravity_scale": -1.0 })
			await seconds(2)
			check_near(bounds_of(polygon_of(soft)).position.y, 108.0, 1, "upper side of what falls up under it (%s)" % upside_down)
			await _clear_stage()


func test_a_platform_is_switched_while_a_body_is_on_it() -> void:
	var solid := StaticBody2D.new()
	solid.position = Vector2(0, 100)
	var collision := _add_platform(solid)
	var soft := _box(Vector2(0, 50), { "gravity_scale": 1.0 })
	await seconds(1.5)
	check_near(bounds_of(polygon_of(soft)).end.y, 92.0, 1, "lower side on the platform")
	collision.one_way_collision = false
	soft.teleport(Transform2D(0, Vector2(0, 300)))
	soft.linear_velocity = Vector2(0, -700)
	var highest := 1000.0
	for i in 40:
		await ticks(1)
		highest = minf(highest, bounds_of(polygon_of(soft)).position.y)
	check_above(highest, 104, "highest place under what is one-way no longer")
	collision.one_way_collision = true
	soft.teleport(Transform2D(0, Vector2(0, 300)))
	soft.linear_velocity = Vector2(0, -900)
	await seconds(0.6)
	check_below(bounds_of(polygon_of(soft)).end.y, 92, "lower side over what is one-way again")


func test_one_way_tiles() -> void:
	for quadrant: int in [1, 16]:
		for above_solid: bool in [false, true]:
			var tile_set := TileSet.new()
			tile_set.tile_size = Vector2i(32, 32)
			tile_set.add_physics_layer()
			var source := TileSetAtlasSource.new()
			source.texture = ImageTexture.create_from_image(Image.create(64, 32, false, Image.FORMAT_RGBA8))
			source.texture_region_size = Vector2i(32, 32)
			tile_set.add_source(source, 0)
			for i in 2:
				source.create_tile(Vector2i(i, 0))
				var data := source.get_tile_data(Vector2i(i, 0), 0)
				data.add_collision_polygon(0)
				data.set_collision_polygon_points(0, 0, PackedVector2Array([Vector2(-16, -16), Vector2(16, -16), Vector2(16, 16), Vector2(-16, 16)]))
				data.set_collision_polygon_one_way(0, 0, i == 1)
			var layer := TileMapLayer.new()
			layer.tile_set = tile_set
			if "physics_quadrant_size" in layer:
				layer.set("physics_quadrant_size", quadrant)
			for x in 20:
				layer.set_cell(Vector2i(x, 0), 0, Vector2i(1, 0))
				if above_solid:
					layer.set_cell(Vector2i(x, 1), 0, Vector2i.ZERO)
				layer.set_cell(Vector2i(x, 8), 0, Vector2i.ZERO)
			stage.add_child(layer)
			var what := "quadrants of %d, %s" % [quadrant, "above solid ones" if above_solid else "alone"]
			var soft := _box(Vector2(320, 220))
			await seconds(0.5)
			soft.apply_central_impulse(Vector2(0, -950))
			await seconds(2.5)
			if above_solid:
				check_near(bounds_of(polygon_of(soft)).end.y, 256.0, 1, "lower side of what jumped, " + what)
			else:
				check_near(bounds_of(polygon_of(soft)).end.y, 0.0, 1, "lower side of what jumped through one-way tiles, " + what)
			var second := _box(Vector2(480, -60))
			await seconds(2)
			check_near(bounds_of(polygon_of(second)).end.y, 0.0, 1, "lower side of what fell on one-way tiles, " + what)
			await _clear_stage()


func test_a_one_way_lift_carries() -> void:
	var lift := AnimatableBody2D.new()
	lift.position = Vector2(0, 300)
	_add_platform(lift)
	var soft := _box(Vector2(0, 258))
	await seconds(0.5)
	for i in 120:
		lift.position.y -= 1.5
		await ticks(1)
	await ticks(30)
	check_near(bounds_of(polygon_of(soft)).end.y, 112.0, 2, "lower side on the one-way lift")


func _add_boundary(solid: CollisionObject2D, normal := Vector2.UP) -> void:
	var boundary := WorldBoundaryShape2D.new()
	boundary.normal = normal
	var collision := CollisionShape2D.new()
	collision.shape = boundary
	collision.one_way_collision = true
	solid.add_child(collision)
	stage.add_child(solid)


## As through a platform: from below, and held from above, also far beside the boundary's own place.
func test_a_one_way_world_boundary_holds_from_one_side() -> void:
	for rate: int in [30, 60, 240]:
		for x: float in [0.0, -3000.0]:
			Engine.physics_ticks_per_second = rate
			var what := "at x = %s, %d ticks" % [x, rate]
			add_solid(rectangle(400, 100), Transform2D(0, Vector2(x, 450)))
			var solid := StaticBody2D.new()
			solid.position = Vector2(0, 240)
			_add_boundary(solid)
			var soft := _box(Vector2(x, 368))
			await seconds(0.5)
			check_near(bounds_of(polygon_of(soft)).end.y, 400.0, 2, "lower side of what lies below, " + what)
			soft.apply_central_impulse(Vector2(0, -750))
			var highest := 400.0
			for i in rate:
				await ticks(1)
				highest = minf(highest, bounds_of(polygon_of(soft)).end.y)
			check_below(highest, 180, "highest place of the lower side over a boundary " + what)
			await seconds(2)
			check_near(bounds_of(polygon_of(soft)).end.y, 240.0, 1, "lower side on a boundary " + what)
			await _clear_stage()
