# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Every shape of the engine, on every transform, and what changes while soft bodies are near.


func time_limit() -> int:
	return 30000


func _box(position := Vector2.ZERO, properties := {}) -> SoftBody2D:
	return add_body(position, { "polygon": SoftBody2D.make_box_polygon(Vector2(80, 60), 20), "mass": 1.0, "rolling_resistance": 0.1 }.merged(properties))


func _clear_stage() -> void:
	for node in stage.get_children():
		node.free()
	await ticks(2)


## Shapes whose upper side is flat or a point at y = -40 over the origin, 80 high at least.
func _shapes() -> Dictionary:
	var convex := ConvexPolygonShape2D.new()
	convex.points = PackedVector2Array([Vector2(-200, -40), Vector2(200, -40), Vector2(100, 60), Vector2(-100, 60)])
	var concave := ConcavePolygonShape2D.new()
	concave.segments = PackedVector2Array([Vector2(-200, -40), Vector2(-70, -40), Vector2(-70, -40), Vector2(0, -40),
			Vector2(200, -40), Vector2(0, -40), Vector2(200, -40), Vector2(200, 40)])
	var segment := SegmentShape2D.new()
	segment.a = Vector2(-200, -40)
	segment.b = Vector2(200, -40)
	var boundary := WorldBoundaryShape2D.new()
	boundary.normal = Vector2(0, -1)
	boundary.distance = 40
	return { "rectangle": rectangle(400, 80), "convex": convex, "concave": concave, "segment": segment, "boundary": boundary }


## The height at which a box comes to rest over a shape is known from the shape alone.
func test_a_body_rests_on_every_flat_shape_under_every_transform() -> void:
	var transforms := {
		"as it is": Transform2D.IDENTITY,
		"scaled": Transform2D(0, Vector2(2, 0.5), 0, Vector2(0, 0)),
		"mirrored along x": Transform2D(0, Vector2(-1, 1), 0, Vector2.ZERO),
		"skewed": Transform2D(Vector2(1, 0), Vector2(0.7, 1), Vector2.ZERO),
		"mirrored and skewed": Transform2D(Vector2(-1.5, 0), Vector2(0.5, 1.5), Vector2.ZERO),
	}
	for shape_name: String in _shapes():
		for transform_name: String in transforms:
			var transform: Transform2D = transforms[transform_name]
			add_solid(_shapes()[shape_name], transform.translated(Vector2(0, 300)))
			var top := 300 - 40 * transform.y.y
			# The skewed shapes lean to one side; over the middle of their upper side.
			var x := -40 * transform.y.x
			var soft := _box(Vector2(x, top - 33))
			await seconds(1.5)
			var what := "on a shape (%s, %s)" % [shape_name, transform_name]
			check_near(bounds_of(polygon_of(soft)).end.y, top, 1.0, "lower side " + what)
			check_below(soft.get_linear_velocity().length(), 2, "speed " + what)
			await _clear_stage()


## The transform of the collision shape in its body counts too.
func test_a_shapes_own_transform_counts() -> void:
	var solid := add_solid(rectangle(200, 40), Transform2D(PI / 2, Vector2(0, 200)))
	(solid.get_child(0) as Node2D).transform = Transform2D(-PI / 2, Vector2(2, 1), 0, Vector2(-50, 0))
	var soft := _box(Vector2(0, 90))
	await seconds(2)
	# Turned by a right angle, (-50, 0) in the body is 50 px above it; half of 40 px is above that.
	check_near(bounds_of(polygon_of(soft)).end.y, 130.0, 1, "lower side")


func test_round_shapes_stay_round_and_become_ellipses() -> void:
	var capsule := CapsuleShape2D.new()
	capsule.radius = 40
	capsule.height = 200
	# Height of the top over the middle: radius, half height, scaled ones.
	for data: Array in [[circle(60), Vector2.ONE, 60.0], [circle(60), Vector2(-2, 2), 120.0], [circle(60), Vector2(2, 0.5), 30.0],
			[capsule, Vector2.ONE, 100.0], [capsule, Vector2(1, -1.5), 150.0]]:
		add_solid(data[0], Transform2D(0, data[1], 0, Vector2(0, 300)))
		var soft := add_weightless_body(Vector2(0, 300 - data[2] - 51), { "polygon": SoftBody2D.make_circle_polygon(50, 64) })
		await ticks(1)
		soft.apply_central_impulse(Vector2(0, 30))
		var lowest := -1000.0
		for i in 30:
			await ticks(1)
			lowest = maxf(lowest, bounds_of(polygon_of(soft)).end.y)
		check_near(lowest, 300.0 - data[2], 1.5, "lowest place over a round shape scaled by %s" % data[1])
		await _clear_stage()


func test_collision_polygons_hold_as_solids_and_as_segments() -> void:
	for mode: CollisionPolygon2D.BuildMode in [CollisionPolygon2D.BUILD_SOLIDS, CollisionPolygon2D.BUILD_SEGMENTS]:
		var solid := StaticBody2D.new()
		var polygon := CollisionPolygon2D.new()
		polygon.build_mode = mode
		# A bowl, 200 px wide inside, and so deep that a squashed body does not bulge over its rim.
		polygon.polygon = PackedVector2Array([Vector2(-150, -150), Vector2(-100, -150), Vector2(-100, 100), Vector2(100, 100),
				Vector2(100, -150), Vector2(150, -150), Vector2(150, 150), Vector2(-150, 150)])
		solid.add_child(polygon)
		stage.add_child(solid)
		# A network: of a body of elastic modes one polygon point gets behind a segment without thickness here (docs/limits.md).
		var soft := _box(Vector2(0, 0), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
		await seconds(2)
		check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side in a bowl, build mode %d" % mode)
		soft.apply_central_impulse(Vector2(-600, 0))
		var left := 0.0
		for i in 60:
			await ticks(1)
			left = minf(left, bounds_of(polygon_of(soft)).position.x)
		check_above(left, -102, "left side in a bowl, build mode %d" % mode)
		await _clear_stage()


func _tile_set(points: PackedVector2Array) -> TileSet:
	var tile_set := TileSet.new()
	tile_set.tile_size = Vector2i(32, 32)
	tile_set.add_physics_layer()
	var source := TileSetAtlasSource.new()
	source.texture = ImageTexture.create_from_image(Image.create(32, 32, false, Image.FORMAT_RGBA8))
	source.texture_region_size = Vector2i(32, 32)
	source.create_tile(Vector2i.ZERO)
	tile_set.add_source(source, 0)
	var data := source.get_tile_data(Vector2i.ZERO, 0)
	data.add_collision_polygon(0)
	data.set_collision_polygon_points(0, 0, points)
	return tile_set


func _add_tiles(quadrant: int, count: int, points := PackedVector2Array([Vector2(-16, -16), Vector2(16, -16), Vector2(16, 16), Vector2(-16, 16)])) -> TileMapLayer:
	var layer := TileMapLayer.new()
	layer.tile_set = _tile_set(points)
	if "physics_quadrant_size" in layer:
		layer.set("physics_quadrant_size", quadrant)
	for x in count:
		layer.set_cell(Vector2i(x, 0), 0, Vector2i.ZERO)
	stage.add_child(layer)
	return layer


func test_a_body_rests_on_tiles() -> void:
	var notch := PackedVector2Array([Vector2(-16, -16), Vector2(-4, -16), Vector2(-4, 8), Vector2(4, 8), Vector2(4, -16), Vector2(16, -16), Vector2(16, 16), Vector2(-16, 16)])
	for quadrant: int in [1, 16]:
		_add_tiles(quadrant, 20)
		var soft := _box(Vector2(320, -40))
		await check_rests(soft, 6, "the body on tiles, quadrants of %d" % quadrant)
		check_near(bounds_of(polygon_of(soft)).end.y, 0.0, 1, "lower side on tiles, quadrants of %d" % quadrant)
		await _clear_stage()
		_add_tiles(quadrant, 20, notch)
		soft = _box(Vector2(320, -40))
		await seconds(4)
		check_below(bounds_of(polygon_of(soft)).end.y, 12, "lower side on notched tiles, quadrants of %d" % quadrant)
		check_above(bounds_of(polygon_of(soft)).end.y, -1, "lower side on notched tiles, quadrants of %d" % quadrant)
		await _clear_stage()


func test_no_edge_between_tiles_slows_a_body_that_slides() -> void:
	for rate: int in [30, 60, 240]:
		Engine.physics_ticks_per_second = rate
		for quadrant: int in [1, 16]:
			for speed: float in [100.0, 400.0]:
				_add_tiles(quadrant, 80)
				var soft := _box(Vector2(100, -32), { "physics_material_override": surface(0.0), "rolling_resistance": 0.0, "stiffness": 300.0 })
				await seconds(0.5)
				soft.apply_central_impulse(Vector2(speed, 0))
				await seconds(50 * 32 / speed if speed > 200 else 4.0)
				var what := "at %d ticks, quadrants of %d" % [rate, quadrant]
				check_near(soft.get_linear_velocity().x, speed, 0.02 * speed, "speed after sliding over tiles " + what)
				check_near(bounds_of(polygon_of(soft)).end.y, 0.0, 1, "lower side after sliding over tiles " + what)
				await _clear_stage()


func test_a_chain_of_segments_is_smooth() -> void:
	for segment: float in [5.0, 32.0]:
		for round: bool in [true, false]:
			var concave := ConcavePolygonShape2D.new()
			var segments := PackedVector2Array()
			for i in roundi(2400 / segment):
				var ends := [Vector2(i * segment, 0), Vector2(i * segment + segment, 0)]
				if i % 3 == 1:
					ends.reverse() # in whichever direction each is given
				segments.append_array(ends)
			concave.segments = segments
			add_solid(concave)
			var polygon := SoftBody2D.make_circle_polygon(50, 16) if round else SoftBody2D.make_box_polygon(Vector2(80, 60), 20)
			var soft := add_body(Vector2(100, -51 if round else -31), { "polygon": polygon, "mass": 1.0, "physics_material_override": surface(0.0), "rolling_resistance": 0.0 })
			await seconds(0.5)
			soft.apply_central_impulse(Vector2(400, 0))
			await seconds(4)
			check_near(soft.get_linear_velocity().x, 400.0, 1, "speed after sliding over segments of %s px" % segment)
			await _clear_stage()


func test_a_changed_tile_map_is_noticed() -> void:
	for quadrant: int in [1, 16]:
		var layer := _add_tiles(quadrant, 20)
		var soft := _box(Vector2(320, -40))
		await seconds(2)
		check_near(bounds_of(polygon_of(soft)).end.y, 0.0, 1, "lower side, quadrants of %d" % quadrant)
		layer.set_cell(Vector2i(0, 3), 0, Vector2i.ZERO) # somewhere else in the same quadrant
		var lowest := 0.0
		for i in 30:
			await ticks(1)
			lowest = maxf(lowest, bounds_of(polygon_of(soft)).end.y)
		check_below(lowest, 1, "lower side after another tile was set, quadrants of %d" % quadrant)
		layer.position.y = 40 # all tiles with it
		await seconds(2)
		check_near(bounds_of(polygon_of(soft)).end.y, 40.0, 1, "lower side after the layer moved, quadrants of %d" % quadrant)
		layer.clear()
		await seconds(1)
		check_above(bounds_of(polygon_of(soft)).end.y, 200, "lower side after the tiles went, quadrants of %d" % quadrant)
		await _clear_stage()


func test_a_floor_that_appears_later_holds() -> void:
	for delay: int in [1, 2, 7, 30]:
		var soft := _box(Vector2.ZERO)
		await ticks(delay)
		add_floor(200)
		await seconds(3)
		check_near(bounds_of(polygon_of(soft)).end.y, 200.0, 1, "lower side over a floor that came after %d ticks" % delay)
		await _clear_stage()


## A body made right before a soft one, among so many that their surroundings are not all looked at in time.
func test_a_bullet_made_nearby_hits_at_once() -> void:
	for i in 300:
		add_weightless_body(Vector2(1000 + 700 * (i % 20), 1000 + 700 * (i / 20)), { "polygon": SoftBody2D.make_circle_polygon(20, 6) })
	for wait: int in [1, 2, 10, 11, 12, 13, 14, 15, 16, 17]:
		var soft := add_weightless_body()
		await ticks(wait)
		var bullet := RigidBody2D.new()
		var collision := CollisionShape2D.new()
		collision.shape = circle(10)
		bullet.add_child(collision)
		bullet.position = Vector2(-180, 0)
		bullet.gravity_scale = 0
		bullet.linear_velocity = Vector2(2000, 0)
		stage.add_child(bullet)
		await ticks(20)
		check_above(soft.get_linear_velocity().x, 300, "velocity after the bullet, made after %d ticks" % wait)
		bullet.free()
		soft.free()


func test_a_body_that_comes_from_afar_hits() -> void:
	var soft := add_weightless_body()
	await seconds(1)
	var ball := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = circle(30)
	ball.add_child(collision)
	ball.position = Vector2(-3000, 0)
	ball.gravity_scale = 0
	ball.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	ball.linear_velocity = Vector2(1500, 0)
	stage.add_child(ball)
	await seconds(3)
	check_above(soft.get_linear_velocity().x, 500, "velocity after the ball from afar")


func test_what_goes_away_holds_no_longer() -> void:
	var ways := {
		"free": func(solid: StaticBody2D) -> void: solid.free(),
		"queue_free": func(solid: StaticBody2D) -> void: solid.queue_free(),
		"disable its shape": func(solid: StaticBody2D) -> void: (solid.get_child(0) as CollisionShape2D).disabled = true,
		"free its shape": func(solid: StaticBody2D) -> void: solid.get_child(0).free(),
		"another layer": func(solid: StaticBody2D) -> void: solid.collision_layer = 2,
		"no layer": func(solid: StaticBody2D) -> void: solid.collision_layer = 0,
		"move it": func(solid: StaticBody2D) -> void: solid.position = Vector2(5000, 0),
		"out of the tree": func(solid: StaticBody2D) -> void:
			stage.remove_child(solid)
			solid.queue_free(),
		"another world": func(solid: StaticBody2D) -> void:
			var viewport := SubViewport.new()
			viewport.world_2d = World2D.new()
			stage.add_child(viewport)
			solid.reparent(viewport),
	}
	for way: String in ways:
		# Bodies are looked at in turn, so with shapes the moment could be a lucky one.
		for delay: int in range(60, 70, 3) if way.contains("shape") else [60]:
			for i in 100: # so many that not all of them are read again in every tick
				add_solid(circle(4), Transform2D(0, Vector2(90 + 12 * (i % 10), 130 + 8 * (i / 10))))
			var solid := add_floor(100)
			var soft := _box(Vector2(0, 68))
			await ticks(delay)
			check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side before '%s'" % way)
			(ways[way] as Callable).call(solid)
			await ticks(2)
			# Two ticks, in the first of which it may still have been there.
			check_above(soft.get_linear_velocity().y, GRAVITY / 60 * 0.5, "velocity two ticks after '%s'" % way)
			await ticks(28)
			check_near(soft.get_linear_velocity().y, GRAVITY * 0.5, 40, "velocity half a second after '%s'" % way)
			await _clear_stage()


func test_what_changes_is_honored() -> void:
	var solid := add_floor(100)
	var soft := _box(Vector2(0, 68), { "physics_material_override": surface(0.0), "rolling_resistance": 0.0 })
	await seconds(1)
	((solid.get_child(0) as CollisionShape2D).shape as RectangleShape2D).size.y = 60
	await seconds(2)
	check_near(bounds_of(polygon_of(soft)).end.y, 120.0, 1, "lower side after the floor got thinner")
	(solid.get_child(0) as CollisionShape2D).position.y = 10
	await seconds(2)
	check_near(bounds_of(polygon_of(soft)).end.y, 130.0, 1, "lower side after its shape was moved")
	(solid.get_child(0) as CollisionShape2D).shape = rectangle(2000, 100)
	await seconds(3)
	check_near(bounds_of(polygon_of(soft)).end.y, 110.0, 1, "lower side after it got another shape")
	solid.scale = Vector2(1, 0.5)
	await seconds(2)
	check_near(bounds_of(polygon_of(soft)).end.y, 130.0, 1, "lower side after it was scaled")
	solid.constant_linear_velocity = Vector2(50, 0)
	soft.physics_material_override = surface(1)
	await seconds(3)
	check_near(soft.get_linear_velocity().x, 50.0, 3, "velocity after it became a belt")
	solid.physics_material_override = PhysicsMaterial.new()
	solid.physics_material_override.friction = 0
	await seconds(0.5)
	soft.apply_central_impulse(Vector2(100, 0))
	await seconds(0.5)
	check_near(soft.get_linear_velocity().x, 150.0, 5, "velocity after it became slippery")


## A body of the physics server that has no node, so that no node can be asked about its shapes.
func test_a_body_without_a_node_holds_until_its_shape_is_disabled() -> void:
	var shape := PhysicsServer2D.rectangle_shape_create()
	PhysicsServer2D.shape_set_data(shape, Vector2(500, 20))
	var body := PhysicsServer2D.body_create()
	PhysicsServer2D.body_set_mode(body, PhysicsServer2D.BODY_MODE_STATIC)
	PhysicsServer2D.body_add_shape(body, shape)
	PhysicsServer2D.body_set_state(body, PhysicsServer2D.BODY_STATE_TRANSFORM, Transform2D(0, Vector2(0, 120)))
	PhysicsServer2D.body_set_space(body, stage.get_world_2d().space)
	var soft := _box(Vector2(0, 50))
	await seconds(12) # until it sleeps
	check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side on a body without a node")
	PhysicsServer2D.body_set_shape_disabled(body, 0, true)
	await ticks(30)
	check_above(soft.get_linear_velocity().y, 200, "velocity after its shape was disabled")
	PhysicsServer2D.free_rid(body)
	PhysicsServer2D.free_rid(shape)


## What leaves the physics space may come back as the same body.
func test_a_body_that_comes_back_holds_again() -> void:
	var solid := add_floor(100)
	var soft := _box(Vector2(0, 60))
	for pause: int in [1, 40]:
		await seconds(1)
		check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side on the floor")
		solid.process_mode = Node.PROCESS_MODE_DISABLED # which takes it out of the space
		await ticks(pause)
		soft.teleport(Transform2D(0, Vector2(0, 60)))
		soft.linear_velocity = Vector2.ZERO
		solid.process_mode = Node.PROCESS_MODE_INHERIT
	await seconds(1)
	check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side on the floor that came back")


func test_what_was_left_behind_is_found_again() -> void:
	add_floor(100)
	var soft := _box(Vector2(0, 60))
	await seconds(1)
	soft.teleport(Transform2D(0, Vector2(20000, -50000)))
	await seconds(2.5)
	soft.teleport(Transform2D(0, Vector2(0, 60)))
	soft.linear_velocity = Vector2.ZERO
	await seconds(1)
	check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side of a body that came back")


## More of them in one place than the engine answers at once, each a body, and more than it looks at in one query.
func test_thousands_of_small_solids_all_hold() -> void:
	for x in 150:
		for y in 22:
			add_solid(rectangle(7, 7), Transform2D(0, Vector2(x * 7, y * 7 + 3.5)))
	var bodies: Array[SoftBody2D] = []
	for i in 8:
		bodies.append(_box(Vector2(60 + i * 110, -40)))
	await seconds(3)
	for soft in bodies:
		check_near(bounds_of(polygon_of(soft)).end.y, 0.0, 1, "lower side on thousands of solids")


func test_a_changed_layer_is_honored_at_once() -> void:
	var solid := add_floor(100)
	solid.collision_layer = 2
	var soft := _box(Vector2(0, 0))
	await ticks(5)
	solid.collision_layer = 1
	await seconds(2)
	check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side after the layer fits")


func test_only_near_shapes_are_of_interest_and_they_change_with_the_way() -> void:
	for i in 40:
		add_solid(rectangle(300, 40), Transform2D(0, Vector2(i * 300, 120)))
	var soft := _box(Vector2(100, 68), { "physics_material_override": surface(0.0), "rolling_resistance": 0.0 })
	await seconds(0.5)
	soft.apply_central_impulse(Vector2(2000, 0))
	await seconds(5)
	check_near(soft.get_linear_velocity().x, 2000.0, 40, "speed after 10000 px of separate floors")
	check_near(bounds_of(polygon_of(soft)).end.y, 100.0, 1, "lower side after 10000 px of separate floors")


func test_a_sleeping_body_wakes_for_what_comes() -> void:
	add_floor(100)
	var soft := add_body(Vector2(0, 50))
	await seconds(12)
	var rest := soft.get_center_of_mass_position()
	var pusher := AnimatableBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(40, 80)
	pusher.add_child(collision)
	pusher.position = Vector2(-900, 50)
	stage.add_child(pusher)
	await ticks(5)
	for i in 90:
		pusher.position.x += 10
		await ticks(1)
	check_above(soft.get_center_of_mass_position().x, rest.x + 40, "x after something came and pushed")


func test_a_body_that_was_asleep_meets_what_it_is_thrown_at() -> void:
	var soft := add_weightless_body(Vector2.ZERO, { "sleeping": true })
	add_solid(rectangle(100, 400), Transform2D(0, Vector2(1500, 0)))
	await ticks(20)
	check(soft.sleeping, "it sleeps far from the wall")
	soft.apply_central_impulse(Vector2(1200, 0) * soft.mass)
	await seconds(2)
	check_below(soft.get_center_of_mass_position().x, 1450, "x after two seconds, which the wall stopped")


## In every second tick the engine is asked what is near a sleeping body.
func test_a_sleeping_body_notices_within_two_ticks_what_appears() -> void:
	for phase in 6:
		var soft := add_weightless_body(Vector2.ZERO, { "sleeping": true })
		await ticks(30 + phase)
		check(soft.sleeping, "it sleeps")
		var solid := add_solid(rectangle(40, 40), Transform2D(0, Vector2(60, 0)))
		await ticks(2)
		check(not soft.sleeping, "it sleeps on two ticks after a solid appeared in it, at phase %d" % phase)
		soft.free()
		solid.free()


func test_freeing_during_a_tick_leaves_nothing_behind() -> void:
	for i in 20:
		var solid := add_floor(100)
		var rigid := RigidBody2D.new()
		var collision := CollisionShape2D.new()
		collision.shape = circle(20)
		rigid.add_child(collision)
		rigid.position = Vector2(0, -80)
		stage.add_child(rigid)
		var soft := _box(Vector2(0, 60))
		await ticks(i % 5)
		match i % 4:
			0: rigid.free()
			1: solid.free()
			2: soft.free()
			3: rigid.reparent(solid)
		await ticks(i % 3)
		await _clear_stage()
	check(true, "nothing crashed")


## The engine tests 2048 shapes in a query, whatever their layers, and says nothing of the others.
func test_floors_that_appear_among_thousands_of_other_shapes_are_found() -> void:
	var server := PhysicsServer2D
	var shape := server.rectangle_shape_create()
	server.shape_set_data(shape, Vector2(3, 3))
	var rids: Array[RID] = []
	for i in 20000:
		var other := server.body_create()
		server.body_set_mode(other, PhysicsServer2D.BODY_MODE_STATIC)
		server.body_add_shape(other, shape)
		server.body_set_collision_layer(other, 2)
		server.body_set_state(other, PhysicsServer2D.BODY_STATE_TRANSFORM, Transform2D(0, Vector2(-800 + 11.3 * (i % 142), -800 + 11.3 * (i / 142))))
		server.body_set_space(other, tree.root.world_2d.space)
		rids.append(other)
	var bodies: Array[SoftBody2D] = []
	for k in 6:
		bodies.append(add_weightless_body(Vector2(-600 + 220 * k, 0), { "polygon": SoftBody2D.make_circle_polygon(30, 12) }))
	await seconds(1.5)
	for body in bodies:
		add_solid(rectangle(100, 30), Transform2D(0, body.position + Vector2(0, 150)))
		body.gravity_scale = 1
	await seconds(2)
	for body in bodies:
		check_below(body.position.y, 140, "y of a body above its floor")
	for rid in rids:
		server.free_rid(rid)
	server.free_rid(shape)
