# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Rays, points, shapes and the engine's own nodes find a soft body where its polygon is.


func _space() -> PhysicsDirectSpaceState2D:
	return tree.root.world_2d.direct_space_state


func _ray(from: Vector2, to: Vector2, mask := 0xffffffff) -> Dictionary:
	return _space().intersect_ray(PhysicsRayQueryParameters2D.create(from, to, mask))


func _at(place: Vector2, mask := 0xffffffff) -> Array[Node]:
	var query := PhysicsPointQueryParameters2D.new()
	query.position = place
	query.collision_mask = mask
	return _colliders(_space().intersect_point(query))


func _in(shape: Shape2D, transform: Transform2D) -> Array[Node]:
	var query := PhysicsShapeQueryParameters2D.new()
	query.shape = shape
	query.transform = transform
	return _colliders(_space().intersect_shape(query))


func _colliders(hits: Array[Dictionary]) -> Array[Node]:
	var found: Array[Node] = []
	for hit in hits:
		if not hit["collider"] in found:
			found.append(hit["collider"])
	return found


## Where a ray meets the polygon first, and the edge's outward normal there, worked out from the points.
func _crossing(body: SoftBody2D, from: Vector2, to: Vector2) -> Dictionary:
	var polygon := polygon_of(body)
	var best := {}
	for i in polygon.size():
		var a := polygon[i]
		var b := polygon[(i + 1) % polygon.size()]
		var hit: Variant = Geometry2D.segment_intersects_segment(from, to, a, b)
		if hit != null and (best.is_empty() or from.distance_to(hit) < from.distance_to(best["position"])):
			var normal := (b - a).orthogonal().normalized()
			best = { "position": hit, "normal": normal if normal.dot(from - to) > 0 else -normal }
	return best


## Claims that rays from all sides towards the middle of mass find the body at its polygon.
func _check_rays(body: SoftBody2D, tolerance: float, what: String) -> void:
	var middle := body.get_center_of_mass_position()
	for i in 24:
		var from := middle + Vector2.from_angle(TAU * (i + 0.3) / 24) * 400
		var expected := _crossing(body, from, middle)
		var query := PhysicsRayQueryParameters2D.create(from, middle, body.collision_layer)
		var hit := _space().intersect_ray(query)
		if not check(not hit.is_empty(), "%s: ray %d finds nothing" % [what, i]):
			continue
		check(hit["collider"] == body, "%s: ray %d finds %s" % [what, i, hit["collider"]])
		check_equal(hit["rid"], body.get_rid(), what + ": the RID of what the ray found")
		check_near(hit["position"], expected["position"], tolerance, "%s: place of ray %d" % [what, i])
		if absf(hit["normal"].angle_to(expected["normal"])) > 0.1: # next to a corner either edge may be met
			check_below(_distance_to_corner(body, expected["position"]), 3 * tolerance,
					"%s: distance of ray %d, whose normal is another edge's, from a corner" % [what, i])


func _distance_to_corner(body: SoftBody2D, place: Vector2) -> float:
	var least := INF
	for point in polygon_of(body):
		least = minf(least, point.distance_to(place))
	return least


func test_rays_find_a_body_at_rest_at_its_polygon() -> void:
	var body := add_weightless_body(Vector2(300, 200))
	_check_rays(body, 0.1, "on entering the tree")
	await ticks(5)
	_check_rays(body, 0.1, "after five ticks")


func test_rays_find_a_body_that_flies_and_spins_where_it_is_now() -> void:
	var body := add_weightless_body(Vector2(-300, 0))
	for i in body.get_point_count():
		var arm := body.get_point_positions()[i] - body.get_center_of_mass_position()
		body.apply_point_impulse(i, (Vector2(900, -300) + arm.orthogonal() * -3) * body.mass / body.get_point_count())
	for i in 5:
		await ticks(7)
		_check_rays(body, 0.6, "in flight")


func test_rays_find_a_squashed_body_at_its_polygon() -> void:
	add_floor(100).collision_layer = 2
	var body := add_body(Vector2(0, 40), { "collision_mask": 2, "stiffness": 40.0 })
	body.apply_central_impulse(Vector2(0, 500))
	for i in 8:
		await ticks(3)
		_check_rays(body, 0.6, "on the floor")
	await seconds(4)
	_check_rays(body, 0.6, "at rest on the floor")


func _add_body_that_dents(x: float) -> SoftBody2D:
	return add_weightless_body(Vector2(x, 0), {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK}) # dents more than modes


## Pinches bodies between the topmost and the lowest point.
func _pinch(bodies: Array[SoftBody2D]) -> void:
	await ticks(2)
	for i in 20:
		for body in bodies:
			body.apply_point_force(12, Vector2(0, 3000))
			body.apply_point_force(4, Vector2(0, -3000))
		await ticks(1)


func _check_dent_is_seen(body: SoftBody2D, what: String) -> void:
	var bottom := polygon_of(body)[12]
	check_above(bottom.y, bounds_of(polygon_of(body)).position.y + 8, what + ": y of the bottom of the dent")
	var hit := _ray(Vector2(bottom.x, -300), Vector2(bottom.x, 0))
	if check(not hit.is_empty(), what + ": the ray into the dent finds nothing"):
		check_near(hit["position"].y, bottom.y, 1, what + ": what a ray finds in the dent")


func test_rays_see_a_deep_dent_and_a_body_smooth_again() -> void:
	var body := _add_body_that_dents(0)
	await _pinch([body])
	_check_dent_is_seen(body, "pinched")
	await seconds(5)
	_check_rays(body, 0.3, "five seconds later")


## As many dents are shown as the engine can bear; those of bodies that have left leave room for others.
func test_dents_of_bodies_that_are_gone_do_not_count() -> void:
	add_weightless_body(Vector2(0, 9000)) # so that their space stays
	var bodies: Array[SoftBody2D] = []
	for i in 16:
		bodies.append(_add_body_that_dents(300.0 * i))
	await _pinch(bodies)
	_check_dent_is_seen(bodies[15], "the last of 16")
	for body in bodies:
		body.free()
	var late := _add_body_that_dents(0)
	await _pinch([late])
	_check_dent_is_seen(late, "one after them")


## It rests all the time, so only the character has it looked at.
func test_a_frozen_body_draws_its_outline_in_only_while_a_character_is_near() -> void:
	var body := add_body(Vector2.ZERO, { "freeze": true, "collision_proxy_margin": 8.0 })
	await ticks(20)
	_check_rays(body, 0.1, "alone")
	var character := CharacterBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = circle(10)
	character.add_child(collision)
	character.position = Vector2(-75, 0)
	stage.add_child(character)
	await ticks(4)
	var hit := _ray(Vector2(400, 0), Vector2.ZERO)
	check_near(hit["position"], Vector2(42, 0), 0.5, "what a ray from the other side finds beside a character")
	character.position.x = -9000
	await ticks(4)
	_check_rays(body, 0.1, "alone again")


func test_concave_and_long_bodies_are_seen_as_they_are() -> void:
	var u := PackedVector2Array([Vector2(-60, -60), Vector2(-30, -60), Vector2(-30, 20), Vector2(30, 20),
			Vector2(30, -60), Vector2(60, -60), Vector2(60, 60), Vector2(-60, 60)])
	var cup := add_weightless_body(Vector2.ZERO, { "polygon": u, "stiffness": 500.0 })
	check(_at(Vector2(0, -30)).is_empty(), "something is seen inside the cup")
	check_equal(_at(Vector2(-45, -30)), [cup] as Array[Node], "what is seen in the cup's wall")
	var hit := _ray(Vector2(0, -200), Vector2(0, 200))
	check_near(hit["position"], Vector2(0, 20), 0.1, "what a ray into the cup finds")
	cup.position = Vector2(400, 0)
	await ticks(1)
	hit = _ray(Vector2(400, -200), Vector2(400, 200))
	check_near(hit["position"], Vector2(400, 20), 0.1, "what a ray into the moved cup finds")

	# A long bar, bent by hand into an arc whose ends are 140 px above its middle.
	var bar := add_weightless_body(Vector2(0, 600), { "polygon": SoftBody2D.make_box_polygon(Vector2(400, 40), 20),
			"stiffness": 0.0, "shape_matching": 0.0, "center_point": false, "damping": 0.0 })
	await ticks(1)
	for i in bar.get_point_count():
		var x := bar.get_point_positions()[i].x
		bar.apply_point_impulse(i, Vector2(0, -0.0035 * x * x * 60) * bar.mass / bar.get_point_count())
	await ticks(1)
	var middle := bounds_of(polygon_of(bar)).get_center().x
	var bent := _crossing(bar, Vector2(middle, 0), Vector2(middle, 2000))
	hit = _ray(Vector2(middle, 0), Vector2(middle, 2000))
	check_above(bent["position"].y, bounds_of(polygon_of(bar)).position.y + 100, "how deep the bar hangs through")
	check_near(hit["position"], bent["position"], 12, "what a ray finds at the bar's middle")
	var right_end := Vector2.ZERO # the mean of the four points farthest to the right
	var by_x := Array(polygon_of(bar))
	by_x.sort_custom(func(a: Vector2, b: Vector2) -> bool: return a.x > b.x)
	for i in 4:
		right_end += by_x[i] / 4
	check_equal(_at(right_end), [bar] as Array[Node], "what is at the bar's end, which was bent up")


func test_points_and_shapes_find_it() -> void:
	var body := add_weightless_body(Vector2(200, 100))
	var other := add_weightless_body(Vector2(-200, 100))
	check_equal(_at(Vector2(200, 100)), [body] as Array[Node], "what is at the first body's middle")
	check_equal(_at(Vector2(200, 55)), [body] as Array[Node], "what is near the first body's top")
	check(_at(Vector2(200, 45)).is_empty(), "something is seen above the first body")
	check_equal(_in(circle(20), Transform2D(0, Vector2(135, 100))), [body] as Array[Node], "what a circle at its side finds")
	check(_in(circle(20), Transform2D(0, Vector2(125, 100))).is_empty(), "a circle beside it finds something")
	check_equal(_in(rectangle(600, 10), Transform2D(0, Vector2(0, 100))).size(), 2, "number of bodies across which a bar lies")
	other.free()
	await ticks(1)
	check_equal(_in(rectangle(600, 10), Transform2D(0, Vector2(0, 100))), [body] as Array[Node], "what is left after one is freed")


func test_ray_and_shape_cast_nodes_name_the_node() -> void:
	var body := add_weightless_body(Vector2(200, 0))
	var ray := RayCast2D.new()
	ray.target_position = Vector2(400, 0)
	stage.add_child(ray)
	var cast := ShapeCast2D.new()
	cast.shape = circle(5)
	cast.target_position = Vector2(400, 0)
	stage.add_child(cast)
	await ticks(3)
	check(ray.is_colliding() and ray.get_collider() == body, "RayCast2D does not find the body")
	check_near(ray.get_collision_point(), Vector2(150, 0), 1, "where RayCast2D finds it")
	check(cast.is_colliding() and cast.get_collider(0) == body, "ShapeCast2D does not find the body")
	check_near(cast.get_closest_collision_safe_fraction() * 400, 145.0, 3, "how far ShapeCast2D may go")
	ray.add_exception_rid(body.get_rid())
	ray.force_raycast_update()
	check(not ray.is_colliding(), "RayCast2D finds a body that it is to ignore")


func test_the_layer_decides_who_sees_it() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "collision_layer": 4 })
	check(not _ray(Vector2(-200, 0), Vector2(200, 0), 4).is_empty(), "a ray of its layer finds nothing")
	check(_ray(Vector2(-200, 0), Vector2(200, 0), 3).is_empty(), "a ray of other layers finds it")
	body.collision_layer = 2
	check(not _ray(Vector2(-200, 0), Vector2(200, 0), 2).is_empty(), "a ray of its new layer finds nothing")
	check(_ray(Vector2(-200, 0), Vector2(200, 0), 4).is_empty(), "a ray of its old layer finds it")


func test_who_leaves_is_not_seen_and_who_hides_is() -> void:
	var body := add_weightless_body()
	var from := Vector2(-200, 0)
	var rid := body.get_rid()
	body.hide()
	await ticks(2)
	check(not _ray(from, -from).is_empty(), "a hidden body is not seen")
	body.collision_proxy_enabled = false
	check(_ray(from, -from).is_empty(), "a body whose proxy is off is seen")
	await ticks(2)
	check(_ray(from, -from).is_empty(), "a body whose proxy is off is seen two ticks later")
	body.collision_proxy_enabled = true
	check(not _ray(from, -from).is_empty(), "a body whose proxy is on again is not seen")
	body.process_mode = Node.PROCESS_MODE_DISABLED
	check(_ray(from, -from).is_empty(), "a disabled body is seen")
	body.process_mode = Node.PROCESS_MODE_INHERIT
	check(not _ray(from, -from).is_empty(), "a body that is enabled again is not seen")
	tree.paused = true
	check(not _ray(from, -from).is_empty(), "a body is not seen while the tree is paused")
	tree.paused = false
	stage.remove_child(body)
	check(_ray(from, -from).is_empty(), "a body outside the tree is seen")
	body.position = Vector2(0, 500)
	stage.add_child(body)
	check(_ray(from, -from).is_empty(), "a body that came back elsewhere is seen where it was")
	check(not _ray(from + Vector2(0, 500), Vector2(200, 500)).is_empty(), "a body that came back is not seen")
	check_equal(body.get_rid(), rid, "the RID after all that")
	body.free()
	check(_ray(from + Vector2(0, 500), Vector2(200, 500)).is_empty(), "a freed body is seen")


func test_a_new_polygon_or_scale_is_seen() -> void:
	var body := add_weightless_body()
	await ticks(2)
	body.polygon = SoftBody2D.make_circle_polygon(80, 20)
	await ticks(1)
	check_near(_ray(Vector2(-300, 0), Vector2.ZERO)["position"], Vector2(-80, 0), 0.5, "where the larger polygon is seen")
	body.scale = Vector2(2, 1)
	await ticks(1)
	check_near(_ray(Vector2(-300, 0), Vector2.ZERO)["position"], Vector2(-160, 0), 0.5, "where the stretched body is seen")


func test_soft_bodies_do_not_see_each_others_proxies() -> void:
	# If they did, two overlapping ones would be pushed apart though neither has the other's layer in its mask.
	var one := add_weightless_body(Vector2(-20, 0), { "collision_layer": 1, "collision_mask": 2 })
	var other := add_weightless_body(Vector2(20, 0), { "collision_layer": 1, "collision_mask": 2 })
	var same := add_weightless_body(Vector2(500, 0))
	await seconds(1)
	check_near(one.get_center_of_mass_position(), Vector2(-20, 0), 0.01, "the one")
	check_near(other.get_center_of_mass_position(), Vector2(20, 0), 0.01, "the other")
	check_near(same.get_center_of_mass_position(), Vector2(500, 0), 0.001, "a body whose mask has its own layer")
	check_below(largest_distance(polygon_of(same), same.global_transform * same.polygon), 0.01, "deformation of that body")


func test_the_engine_does_not_answer_rigid_bodies_that_the_body_meets() -> void:
	var body := add_weightless_body()
	for speed: float in [10.0, 300.0, 3000.0]:
		var crate := RigidBody2D.new()
		var shape := CollisionShape2D.new()
		shape.shape = rectangle(30, 30)
		crate.add_child(shape)
		crate.gravity_scale = 0
		crate.contact_monitor = true
		crate.max_contacts_reported = 8
		crate.position = Vector2(-70 - speed / 60 * 5.5, 0)
		crate.linear_velocity = Vector2(speed, 0)
		crate.continuous_cd = RigidBody2D.CCD_MODE_DISABLED
		stage.add_child(crate)
		var contacts := 0
		for i in 30:
			await ticks(1)
			contacts += crate.get_contact_count()
		check_equal(contacts, 0, "contacts that the engine answered of a crate at %s px/s" % speed)
		crate.queue_free()
		await ticks(2)
	check_above(body.get_area(), 0, "area of the body")


func test_the_engine_answers_rigid_bodies_that_the_body_does_not_meet() -> void:
	# A body that only the other one's mask has is like a wall to it, as between Godot's own bodies.
	add_weightless_body(Vector2.ZERO, { "collision_mask": 2 })
	var crate := RigidBody2D.new()
	var shape := CollisionShape2D.new()
	shape.shape = rectangle(30, 30)
	crate.add_child(shape)
	crate.gravity_scale = 0
	crate.position = Vector2(-150, 0)
	crate.linear_velocity = Vector2(200, 0)
	stage.add_child(crate)
	await seconds(1)
	check_below(crate.position.x, -60, "x of the crate after a second")


func test_a_sleeping_body_is_seen_and_its_proxy_stands_still() -> void:
	add_floor(100).collision_layer = 2
	var body := add_body(Vector2(0, 40), { "collision_mask": 2 })
	await seconds(6)
	var polygon := polygon_of(body)
	await seconds(1)
	check_equal(polygon_of(body), polygon, "the polygon a second later, so that it sleeps")
	_check_rays(body, 0.1, "asleep")
	var state := PhysicsServer2D.body_get_direct_state(body.get_rid())
	check_equal(state.linear_velocity, Vector2.ZERO, "velocity of the proxy")
	var awake := 0
	for i in 16:
		await ticks(1)
		awake += 0 if PhysicsServer2D.body_get_state(body.get_rid(), PhysicsServer2D.BODY_STATE_SLEEPING) else 1
	check_below(awake, 2, "ticks of 16 in which the proxy was awake, once to ask about areas")


func test_the_proxy_has_the_bodys_velocity() -> void:
	var body := add_weightless_body()
	body.apply_central_impulse(Vector2(120, -40) * body.mass)
	await ticks(3)
	var state := PhysicsServer2D.body_get_direct_state(body.get_rid())
	check_near(state.linear_velocity, Vector2(120, -40), 0.2, "velocity of the proxy")
	var spinning := add_weightless_body(Vector2(300, 0))
	for i in spinning.get_point_count():
		var arm := spinning.get_point_positions()[i] - spinning.get_center_of_mass_position()
		spinning.apply_point_impulse(i, Vector2(-arm.y, arm.x) * 2 * spinning.mass / spinning.get_point_count())
	await ticks(3)
	state = PhysicsServer2D.body_get_direct_state(spinning.get_rid())
	check_near(state.angular_velocity, spinning.get_angular_velocity(), 0.01, "spin of the proxy")
	check_above(state.angular_velocity, 1, "spin of the proxy")


func test_collision_exceptions_are_kept_by_the_node() -> void:
	var wall := add_solid(rectangle(10, 10), Transform2D(0, Vector2(500, 0)))
	var body := add_weightless_body()
	var other := add_weightless_body(Vector2(300, 0))
	body.add_collision_exception_with(wall)
	body.add_collision_exception_with(other)
	body.add_collision_exception_with(wall)
	check_equal(body.get_collision_exceptions(), [wall, other] as Array[Node2D], "the exceptions")
	stage.remove_child(body)
	stage.add_child(body)
	check_equal(body.get_collision_exceptions().size(), 2, "number of exceptions after leaving the tree and coming back")
	body.remove_collision_exception_with(wall)
	check_equal(body.get_collision_exceptions(), [other] as Array[Node2D], "the exceptions after one is removed")
	other.free()
	check_equal(body.get_collision_exceptions().size(), 0, "number of exceptions after the other is freed")
	check_refused(func() -> void: body.add_collision_exception_with(stage), ["neither a SoftBody2D nor a CollisionObject2D"],
			"an exception with a plain node")


func test_an_excepted_floor_is_fallen_through_and_held_again() -> void:
	var ground := add_floor(100)
	var body := add_body(Vector2(0, 0))
	body.add_collision_exception_with(ground)
	await seconds(1)
	check_above(body.get_center_of_mass_position().y, 300, "y of the body that the floor does not hold")
	body.position = Vector2.ZERO
	body.linear_velocity = Vector2.ZERO
	body.remove_collision_exception_with(ground)
	await seconds(2)
	check_near(bounds_of(polygon_of(body)).end.y, 100.0, 1, "lowest point of the body that the floor holds again")


func test_excepted_soft_bodies_pass_each_other_also_after_one_came_back() -> void:
	var one := add_weightless_body(Vector2(-100, 0))
	var other := add_weightless_body(Vector2(100, 0))
	one.add_collision_exception_with(other)
	for again in 3:
		if again == 1:
			stage.remove_child(other)
			stage.add_child(other)
		elif again == 2:
			other.polygon = SoftBody2D.make_circle_polygon(40, 12)
		one.position = Vector2(-100, 0)
		other.position = Vector2(100, 0)
		one.linear_velocity = Vector2(200, 0)
		other.linear_velocity = Vector2(-200, 0)
		await seconds(1)
		check_near(one.get_center_of_mass_position(), Vector2(100, 0), 4, "the one, meeting %d" % again)
		check_near(other.get_center_of_mass_position(), Vector2(-100, 0), 4, "the other, meeting %d" % again)
	one.remove_collision_exception_with(other)
	one.position = Vector2(-100, 0)
	other.position = Vector2(100, 0)
	one.linear_velocity = Vector2(200, 0)
	other.linear_velocity = Vector2(-200, 0)
	await seconds(1)
	check_below(one.get_center_of_mass_position().x, 20, "x of the one that meets the other again")


func test_bad_margins_and_damping_are_refused() -> void:
	var body := add_weightless_body()
	check_refused(func() -> void: body.collision_proxy_margin = NAN, ["collision_proxy_margin"], "a margin that is not a number")
	check_equal(body.collision_proxy_margin, -1.0, "the margin")
	check_refused(func() -> void: body.linear_damp = -1, ["linear_damp"], "a negative damping")
	check_refused(func() -> void: body.angular_damp = INF, ["angular_damp"], "an infinite damping")
	check_equal([body.linear_damp, body.angular_damp], [0.0, 0.0], "the damping")
