# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Contacts that a body reports: with which bodies, where, how hard, and when touches begin and end.


## Everything that the body's signals said, in order: [name, arguments...].
func _record(body: SoftBody2D) -> Array[Array]:
	var told: Array[Array] = []
	body.body_entered.connect(func(other: Node) -> void: told.append(["entered", other]))
	body.body_exited.connect(func(other: Node) -> void: told.append(["exited", other]))
	body.contact_started.connect(func(other: Node, point: Vector2, normal: Vector2, impulse: float) -> void:
			told.append(["started", other, point, normal, impulse]))
	return told


func _names(told: Array[Array]) -> PackedStringArray:
	return PackedStringArray(told.map(func(entry: Array) -> String: return entry[0]))


## Claims that with each collider every end follows a beginning, and every beginning but the first an end. How often it
## bounces is the body's affair.
func _check_alternates(told: Array[Array], was_touching: Array = []) -> void:
	var touching := was_touching.duplicate()
	for entry in told:
		if entry[0] == "entered":
			check(not entry[1] in touching, "entered twice: %s" % [told])
			touching.append(entry[1])
		elif entry[0] == "exited":
			check(entry[1] in touching, "left without being entered: %s" % [told])
			touching.erase(entry[1])
		else:
			check(entry[1] in touching, "a contact has started with whom it has not entered: %s" % [told])


func _add_watcher(position := Vector2.ZERO, properties := {}) -> SoftBody2D:
	return add_body(position, {"contact_monitor": true, "stiffness": 150.0}.merged(properties, true))


func test_a_landing_is_told_with_place_normal_and_impulse() -> void:
	var ground := add_floor(100)
	var body := _add_watcher()
	var told := _record(body)
	await seconds(5)
	_check_alternates(told)
	check_equal(_names(told).slice(0, 2), PackedStringArray(["entered", "started"]), "what was told first")
	check_equal(_names(told).slice(-2), PackedStringArray(["entered", "started"]), "what was told last")
	check_equal(told[0][1], ground, "who was entered")
	check_equal(told[1][1], ground, "whose contact has started")
	check_near(told[1][2], Vector2(0, 100), 8, "where it started")
	check_near(told[1][3], Vector2(0, -1), 0.01, "its normal")
	check_above(told[1][4], 0.1, "its impulse")
	check_equal(body.get_colliding_bodies(), [ground] as Array[Node2D], "what it touches at rest")


func test_contacts_of_a_tick_carry_the_weight() -> void:
	var ground := add_floor(100)
	var body := _add_watcher(Vector2(0, 45), {"can_sleep": false, "mass": 2.0})
	await seconds(4)
	var count := body.get_contact_count()
	check_above(count, 1, "number of contacts")
	var impulse := 0.0
	for i in count:
		check_equal(body.get_contact_collider(i), ground, "collider of contact %d" % i)
		check_near(body.get_contact_normal(i), Vector2(0, -1), 0.01, "normal of contact %d" % i)
		check_near(body.get_contact_position(i).y, 100.0, 0.5, "y of contact %d" % i)
		check_near(body.get_point_positions()[body.get_contact_point(i)], body.get_contact_position(i), 0.5, "point of contact %d" % i)
		check_below(body.get_contact_depth(i), 1, "depth of contact %d" % i)
		impulse += body.get_contact_impulse(i)
	check_near(impulse * 60, 2 * GRAVITY, 0.05 * 2 * GRAVITY, "force of all contacts")


func test_only_the_strongest_contacts_are_kept() -> void:
	add_floor(100)
	var body := _add_watcher(Vector2(0, 45), {"can_sleep": false})
	await seconds(3)
	var all := body.get_contact_count()
	var strongest := 0.0
	for i in all:
		strongest = maxf(strongest, body.get_contact_impulse(i))
	check_above(all, 2, "contacts when 16 may be kept")
	body.max_contacts_reported = 1
	await ticks(1)
	check_equal(body.get_contact_count(), 1, "contacts when one may be kept")
	check_near(body.get_contact_impulse(0), strongest, 0.2 * strongest, "its impulse")
	body.max_contacts_reported = 0
	await ticks(1)
	check_equal(body.get_contact_count(), 0, "contacts when none may be kept")
	check_equal(body.get_colliding_bodies().size(), 1, "what it touches all the same")
	check_refused(func() -> void: body.max_contacts_reported = -1, ["max_contacts_reported", "-1"], "fewer than no contacts")


func test_without_the_monitor_nothing_is_told() -> void:
	add_floor(100)
	var body := _add_watcher(Vector2.ZERO, {"contact_monitor": false})
	var told := _record(body)
	await seconds(1)
	check_equal(told.size(), 0, "what was told")
	check_equal(body.get_contact_count(), 0, "contacts")
	check_refused(func() -> void: body.get_colliding_bodies(), ["contact_monitor"], "asking what it touches")
	check_refused(func() -> void: body.get_contact_normal(0), ["contact index 0"], "a contact that is not there")
	body.contact_monitor = true
	await seconds(1)
	_check_alternates(told)
	check_equal(_names(told).slice(0, 2), PackedStringArray(["entered", "started"]), "what was told once it monitors")
	body.contact_monitor = false
	check_equal(body.get_contact_count(), 0, "contacts after it was switched off")


func test_a_leap_ends_the_touch_and_the_next_landing_begins_another() -> void:
	add_floor(100)
	var body := _add_watcher(Vector2(0, 45))
	await seconds(3)
	var told := _record(body)
	body.apply_central_impulse(Vector2(0, -400))
	await ticks(15)
	check_equal(_names(told), PackedStringArray(["exited"]), "what was told of the leap")
	check_equal(body.get_colliding_bodies(), [] as Array[Node2D], "what it touches in the air")
	await seconds(4)
	check_equal(_names(told).slice(1, 3), PackedStringArray(["entered", "started"]), "what was told of the landing")
	_check_alternates(told, [told[0][1]])


func test_two_soft_bodies_enter_each_other_with_opposite_normals() -> void:
	var left := _add_watcher(Vector2(-70, 0), {"gravity_scale": 0.0, "linear_velocity": Vector2(100, 0)})
	var right := _add_watcher(Vector2(70, 0), {"gravity_scale": 0.0, "linear_velocity": Vector2(-100, 0)})
	var of_left := _record(left)
	var of_right := _record(right)
	await ticks(30)
	check_equal(_names(of_left).slice(0, 2), PackedStringArray(["entered", "started"]), "what the left one was told")
	check_equal(of_left[0][1], right, "whom the left one met")
	check_equal(of_right[0][1], left, "whom the right one met")
	check_near(of_left[1][3], Vector2(-1, 0), 0.25, "normal of the left one")
	check_near(of_right[1][3], -of_left[1][3], 1e-3, "normal of the right one")
	check_near(of_left[1][4], of_right[1][4], 1e-3, "impulse of both")
	check_near(of_left[1][2], of_right[1][2], 1e-3, "place of both")


func test_a_collider_that_is_freed_is_told_while_it_can_be_looked_at() -> void:
	var ground := add_floor(100)
	var body := _add_watcher(Vector2(0, 45))
	await seconds(1)
	var told := _record(body)
	ground.queue_free()
	await ticks(2)
	check_equal(_names(told), PackedStringArray(["exited"]), "what was told")
	await ticks(20)
	check_equal(told.size(), 1, "how often")
	check_equal(body.get_colliding_bodies(), [] as Array[Node2D], "what it touches")


func test_a_soft_body_that_is_freed_leaves_its_neighbor() -> void:
	add_floor(100)
	var lower := _add_watcher(Vector2(0, 45))
	var upper := add_body(Vector2(0, -50), {"stiffness": 150.0})
	await seconds(2)
	check(upper in lower.get_colliding_bodies(), "they do not touch")
	var told := _record(lower)
	upper.free()
	check_equal(_names(told), PackedStringArray(["exited"]), "what was told")
	await ticks(10)
	check(not null in lower.get_colliding_bodies(), "a freed node is among those that it touches")
	check_equal(lower.get_colliding_bodies().size(), 1, "what it still touches")


func test_a_shape_of_many_is_entered_once() -> void:
	var ground := StaticBody2D.new()
	for i in 12:
		var part := CollisionShape2D.new()
		part.shape = rectangle(40, 40)
		part.position = Vector2(-220 + 40 * i, 120)
		ground.add_child(part)
	stage.add_child(ground)
	var body := _add_watcher(Vector2(-100, 0), {"stiffness": 60.0})
	var told := _record(body)
	await seconds(1)
	body.linear_velocity = Vector2(150, 0)
	await seconds(1)
	check_above(told.size(), 1, "what was told of one body of twelve shapes")
	_check_alternates(told)


func test_a_listener_may_free_whom_it_is_told_of() -> void:
	# As with any node, whose signal is being emitted cannot be freed at once.
	for what: String in ["the body", "the other", "both", "all others"]:
		var ground := add_floor(100)
		var body := _add_watcher(Vector2(0, 40))
		var bystander := _add_watcher(Vector2(300, 40))
		var entered: Array[int] = [0]
		body.body_entered.connect(func(_other: Node) -> void:
			entered[0] += 1
			if what in ["the body", "both"]:
				body.queue_free()
			if what in ["the other", "both"]:
				ground.free()
			if what == "all others":
				for child in stage.get_children():
					if child != body:
						child.free())
		await ticks(20)
		check_equal(entered[0], 1, "how often it was told before %s went" % what)
		if what == "all others":
			check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies of the simulation")
		else:
			check_near(bystander.global_position.x, 300.0, 5, "the bystander while %s goes" % what)
		for child in stage.get_children():
			child.free()


func test_a_listener_may_change_anything() -> void:
	add_floor(100)
	var body := _add_watcher(Vector2(0, 40))
	var made: Array[SoftBody2D] = []
	body.body_entered.connect(func(_other: Node) -> void:
		body.polygon = SoftBody2D.make_circle_polygon(30, 12)
		body.center_point = false
		body.contact_monitor = false
		body.scale = Vector2(1.5, 1.5)
		body.reparent(tree.root)
		body.reparent(stage)
		made.append(_add_watcher(Vector2(0, -100))))
	await ticks(60)
	check_equal(made.size(), 1, "bodies made by the listener")
	check_equal(body.polygon.size(), 12, "polygon points")
	check(all_finite(body.get_point_positions()), "a point is not finite")
	check_equal(SoftBodySimulation2D.get_body_count(), 2, "bodies of the simulation")


func test_a_body_that_leaves_the_tree_and_comes_back_is_told_of_no_touch_twice() -> void:
	var ground := add_floor(100)
	var body := _add_watcher(Vector2(0, 45))
	await seconds(1)
	check_equal(body.get_colliding_bodies(), [ground] as Array[Node2D], "what it touches")
	check_above(body.get_contact_count(), 0, "contacts")
	var told := _record(body)
	stage.remove_child(body)
	check_equal(body.get_contact_count(), 0, "contacts outside the tree")
	await ticks(5)
	stage.add_child(body)
	await seconds(1)
	var names := _names(told)
	check_equal(names.count("entered"), names.count("exited"), "beginnings and ends that were told")
	check_equal(body.get_colliding_bodies(), [ground] as Array[Node2D], "what it touches again")


func test_signals_come_when_every_body_is_up_to_date() -> void:
	add_floor(100)
	var first := _add_watcher(Vector2(-200, 45))
	var last := add_body(Vector2(200, 0))
	var stale: Array[float] = []
	first.body_entered.connect(func(_other: Node) -> void:
		stale.append(last.global_position.distance_to(last.get_center_of_mass_position())))
	await ticks(20)
	check_equal(stale.size(), 1, "landings")
	check_near(stale[0], 0.0, 0.01, "distance of the last node from its body")


func test_contacts_do_not_change_the_motion() -> void:
	add_floor(100)
	var plain := add_body(Vector2(0, 0), {"stiffness": 150.0})
	var watched := _add_watcher(Vector2(512, 0))
	await seconds(2)
	check_points_near(watched.get_point_positions(), Transform2D(0, Vector2(512, 0)) * plain.get_point_positions(), 0.05, "points")


func test_a_body_folds_onto_itself_instead_of_through_itself() -> void:
	# A flat strip that is closed like a book.
	var polygon := SoftBody2D.make_box_polygon(Vector2(200, 16), 10)
	var crossings: Array[bool] = []
	for self_collision: int in [SoftBody2D.SELF_COLLISION_OFF, SoftBody2D.SELF_COLLISION_ON]:
		var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon, "center_point": false, "shape_matching": 0.0,
				"stiffness": 60.0, "self_collision": self_collision, "least_area": 0.0})
		var crossed := false
		for i in 60:
			for j in polygon.size():
				body.apply_point_force(j, Vector2(0, -6) if absf(polygon[j].x) > 60 else Vector2(0, 6))
				body.apply_point_force(j, Vector2(-0.15 * polygon[j].x, 0))
			await ticks(1)
			crossed = crossed or Geometry2D.triangulate_polygon(polygon_of(body)).is_empty()
		crossings.append(crossed)
		check(all_finite(body.get_point_positions()), "a point is not finite")
		body.free()
	check(crossings[0], "without self-collision the strip does not cross itself, so this shows nothing")
	check(not crossings[1], "with self-collision the strip crosses itself")


func test_a_body_with_deep_dents_does_not_pass_through_itself_at_default_values() -> void:
	check_equal(add_weightless_body().has_self_collision(), false, "self-collision of a circle")
	add_floor(100)
	var polygon := PackedVector2Array([Vector2(-40, -40), Vector2(-14, -40), Vector2(-14, -14), Vector2(-14, 12), Vector2(14, 12),
			Vector2(14, -14), Vector2(14, -40), Vector2(40, -40), Vector2(40, 0), Vector2(40, 40), Vector2(0, 40), Vector2(-40, 40),
			Vector2(-40, 0)])
	for mode: int in [SoftBody2D.SELF_COLLISION_OFF, SoftBody2D.SELF_COLLISION_AUTOMATIC]:
		var pile: Array[SoftBody2D] = []
		for i in 5:
			pile.append(add_body(Vector2(500 * mode + 3 * i, 50 - 90 * i), {"polygon": polygon, "self_collision": mode}))
		check_equal(pile[0].has_self_collision(), mode == SoftBody2D.SELF_COLLISION_AUTOMATIC, "self-collision of a U")
		var crossed := 0
		for i in 180:
			await ticks(1)
			for body in pile:
				crossed += 1 if Geometry2D.triangulate_polygon(polygon_of(body)).is_empty() else 0
		if mode == SoftBody2D.SELF_COLLISION_OFF:
			check(crossed > 0, "without self-collision no arms cross, so this shows nothing")
		else:
			check_equal(crossed, 0, "ticks in which the arms of a U cross")
	check_refused(func() -> void: add_body().set("self_collision", 3), ["self_collision"], "self_collision = 3")
