# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## SoftRope2D: what it bears, how it hangs and bends, what it lies on, and what it refuses.


func add_rope(path: PackedVector2Array, properties := {}) -> SoftRope2D:
	var rope := SoftRope2D.new()
	rope.path = path
	for property: String in properties:
		rope.set(property, properties[property])
	stage.add_child(rope)
	return rope


func add_weight(position: Vector2, mass: float, radius := 20.0) -> RigidBody2D:
	var weight := RigidBody2D.new()
	var collision := CollisionShape2D.new()
	var disk := CircleShape2D.new()
	disk.radius = radius
	collision.shape = disk
	weight.add_child(collision)
	weight.position = position
	weight.mass = mass
	weight.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	weight.angular_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	stage.add_child(weight)
	return weight


func join(place: Vector2, a: Node2D, b: Node2D, properties := {}) -> SoftBodyJoint2D:
	var joint := SoftBodyJoint2D.new()
	joint.position = place
	stage.add_child(joint)
	joint.node_a = joint.get_path_to(a) if a != null else NodePath()
	joint.node_b = joint.get_path_to(b) if b != null else NodePath()
	for property: String in properties:
		joint.set(property, properties[property])
	return joint


func _stretch(rope: SoftRope2D) -> float:
	return rope.get_length() / rope.get_rest_length()


func _end(rope: SoftRope2D) -> Vector2:
	return rope.get_center_positions()[rope.get_center_count() - 1]


func test_a_rope_of_40_points_holds_50_times_its_weight() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(0, 400)], {"link_count": 39, "mass": 1.0, "pin_start": true})
	var weight := add_weight(Vector2(0, 420), 50.0)
	join(Vector2(0, 400), rope, weight)
	var longest := 1.0
	for i in 180:
		await ticks(1)
		longest = maxf(longest, _stretch(rope))
	check_below(longest, 1.02, "length over that at rest")
	check_near(weight.position.y, 420, 8, "y of the weight")
	check_near(_end(rope).y, 400, 8, "y of the rope's end")


func test_a_pendulum_on_a_rope_swings_on_its_circle() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(300, 0)], {"pin_start": true, "mass": 0.2})
	var weight := add_weight(Vector2(300, 0), 5.0, 10.0)
	join(Vector2(300, 0), rope, weight)
	var farthest := 0.0
	var lowest := 0.0
	for i in 240:
		await ticks(1)
		farthest = maxf(farthest, weight.position.length())
		lowest = maxf(lowest, weight.position.y)
	check_below(farthest, 306, "distance of the weight from the pin")
	check_above(lowest, 290, "lowest place of the weight")


# 2 a sinh(span / 2 a) is the length; the sag is a (cosh(span / 2 a) - 1).
func test_a_rope_between_two_pins_hangs_as_a_catenary() -> void:
	var rope := add_rope([Vector2(-150, 0), Vector2(0, 200), Vector2(150, 0)], {"pin_start": true, "pin_end": true, "link_count": 48,
			"linear_damp": 3.0})
	await seconds(8)
	var low := 1.0
	var high := 1000.0
	for i in 60:
		var a := (low + high) / 2
		if 2 * a * sinh(150 / a) > rope.get_rest_length():
			low = a
		else:
			high = a
	var lowest := 0.0
	for place in rope.get_center_positions():
		lowest = maxf(lowest, place.y)
	check_near(lowest, low * (cosh(150 / low) - 1), 3.0, "sag")
	check_near(_stretch(rope), 1.0, 0.005, "length over that at rest")


# w L^4 / 8 EI at the end of a beam.
func test_a_strap_bends_by_its_own_stiffness() -> void:
	var sags: Array[float] = []
	for stiffness: float in [20.0, 40.0]:
		var strap := add_rope([Vector2(-8, 0), Vector2(192, 0)], {"link_count": 25, "bend_stiffness": stiffness, "mass": 1.0, "linear_damp": 4.0})
		strap.set_point_pinned(strap.get_center_point(0), true, NodePath())
		strap.set_point_pinned(strap.get_center_point(1), true, NodePath())
		await seconds(5)
		sags.append(_end(strap).y)
		strap.free()
	var expected := 0.96 * 9.8 * pow(1.92, 3) / (8 * 20.0) * 100
	check_near(sags[0], expected, 0.06 * expected, "sag")
	check_near(sags[1], expected / 2, 0.06 * expected, "sag of twice the stiffness")


func test_a_rope_lies_on_a_floor_and_falls_asleep() -> void:
	add_floor(200)
	var rope := add_rope([Vector2(-150, 100), Vector2(150, 60)])
	await seconds(8)
	check(rope.sleeping, "asleep")
	for place in rope.get_point_positions():
		check_below(place.y, 201, "y of a point")
	check_below(rope.get_penetration(), 1.0, "penetration")


func test_a_rope_over_a_pulley_carries_both_weights() -> void:
	var pulley := StaticBody2D.new()
	var collision := CollisionShape2D.new()
	var disk := CircleShape2D.new()
	disk.radius = 50
	collision.shape = disk
	pulley.add_child(collision)
	stage.add_child(pulley)
	var path := PackedVector2Array([Vector2(-57, 200)])
	for i in 17:
		path.append(Vector2(-57, 0).rotated(PI * i / 16))
	path.append(Vector2(57, 200))
	var rope := add_rope(path, {"link_count": 60})
	var left := add_weight(Vector2(-57, 220), 3.0)
	var right := add_weight(Vector2(57, 220), 3.3)
	join(Vector2(-57, 200), rope, left)
	join(Vector2(57, 200), rope, right)
	await seconds(3)
	# Friction on half a turn holds a ratio of e^(0.4 pi).
	check_near(left.position.y, 220, 20, "y of the lighter weight")
	check_near(right.position.y, 220, 20, "y of the heavier weight")
	check_below(_stretch(rope), 1.02, "length over that at rest")
	check_below(rope.get_penetration(), 2.0, "penetration")


func test_nothing_passes_through_a_rope() -> void:
	var rope := add_rope([Vector2(-200, 0), Vector2(200, 0)], {"link_count": 40, "mass": 1.0, "width": 12.0, "pin_start": true, "pin_end": true})
	var ball := add_body(Vector2(0, -150))
	var crate := add_weight(Vector2(-90, -150), 1.0)
	await seconds(4)
	check_below(ball.get_center_of_mass_position().y, 60, "y of the soft ball")
	check_below(crate.position.y, 90, "y of the rigid disk")
	check_below(_stretch(rope), 1.06, "length over that at rest of a taut rope on which bodies lie") # measured: at most 1.044


func test_a_rope_touches_and_tells() -> void:
	add_floor(100)
	var rope := add_rope([Vector2(-100, 0), Vector2(100, 0)], {"contact_monitor": true, "max_contacts_reported": 8, "can_sleep": false})
	var entered: Array[Node] = []
	rope.body_entered.connect(func(body: Node) -> void: entered.append(body))
	await seconds(2)
	check_equal(entered.size(), 1, "bodies entered")
	check_above(rope.get_contact_count(), 0, "contacts")


func test_a_saved_world_of_ropes_goes_on_in_the_same_bits() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(200, 0)], {"pin_start": true})
	var other := add_rope([Vector2(0, 20), Vector2(300, 20)])
	join(Vector2(200, 0), rope, other)
	await seconds(0.5)
	var space := rope.get_world_2d().space
	var saved := SoftBodySimulation2D.save_state(space)
	await ticks(30)
	var places := rope.get_point_positions()
	SoftBodySimulation2D.restore_state(space, saved)
	await ticks(30)
	check_equal(rope.get_point_positions(), places, "points")


func test_a_joint_breaks_and_the_weight_falls() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(0, 200)], {"pin_start": true})
	var weight := add_weight(Vector2(0, 220), 10.0)
	join(Vector2(0, 200), rope, weight, {"break_force": 5000.0}) # 10 kg weigh 9800 kg px/s²
	await seconds(1)
	check_above(weight.position.y, 400, "y of the weight")


func test_a_rope_follows_its_node_and_scale() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(100, 0)], {"gravity_scale": 0.0})
	rope.scale = Vector2(2, 2)
	await ticks(2)
	check_near(rope.get_rest_length(), 200, 0.5, "length at rest of one of twice the size")
	rope.scale = Vector2(-1, 1)
	await ticks(2)
	check_near(rope.get_rest_length(), 100, 0.5, "length at rest of a mirrored one")
	check_near(_end(rope).x, -100, 1.0, "x of the end of a mirrored one")
	check_near(_stretch(rope), 1.0, 0.01, "length over that at rest")


func test_values_follow_from_path_width_and_kind() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(100, 0)], {"link_count": 10, "width": 8.0})
	check_equal(rope.get_center_count(), 11, "centers")
	check_equal(rope.polygon.size(), 22, "points of the outline")
	check_equal(rope.kind, SoftRope2D.KIND_ROPE, "kind of a new rope")
	rope.kind = SoftRope2D.KIND_RUBBER_BAND
	check_equal(rope.stretch_stiffness, 20.0, "stretch_stiffness of a rubber band")
	rope.stretch_stiffness = 21
	check_equal(rope.kind, SoftRope2D.KIND_CUSTOM, "kind of other values")
	var curve := Curve.new()
	curve.add_point(Vector2(0, 1))
	curve.add_point(Vector2(1, 0.25))
	rope.width_curve = curve
	check_near(rope.polygon[0].distance_to(rope.polygon[21]), 8, 0.05, "width at the start")
	check_near(rope.polygon[10].distance_to(rope.polygon[11]), 2, 0.05, "width at the end")
	rope.link_count = 0
	check_equal(rope.get_center_count(), 2, "centers of a path of two points")


func test_bad_values_are_refused_and_change_nothing() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(100, 0)])
	var path := rope.path
	for bad: PackedVector2Array in [PackedVector2Array(), PackedVector2Array([Vector2.ZERO]), PackedVector2Array([Vector2.ZERO, Vector2.ZERO]),
			PackedVector2Array([Vector2.ZERO, Vector2(NAN, 0)]),
			PackedVector2Array([Vector2(0, 0), Vector2(200, 0), Vector2(200, 100), Vector2(100, 100), Vector2(100, -100)])]:
		check_refused(func() -> void: rope.path = bad, ["SoftRope2D", "path", "The old value stays"], "path %s" % bad)
		check_equal(rope.path, path, "path after a bad one")
	for value: Array in [["width", 0.0], ["width", NAN], ["link_count", -1], ["link_count", 1000], ["stretch_stiffness", -1.0],
			["bend_stiffness", NAN], ["bend_damping", -1.0], ["rest_bend", 2.0]]:
		var before: Variant = rope.get(value[0])
		check_refused(func() -> void: rope.set(value[0], value[1]), [value[0], "The old value stays"], "%s = %s" % value)
		check_equal(rope.get(value[0]), before, "%s after %s" % value)
	var hole := [PackedVector2Array([Vector2(48, -1), Vector2(52, -1), Vector2(50, 1)])] as Array[PackedVector2Array]
	check_refused(func() -> void: rope.holes = hole, ["SoftRope2D", "holes", "none for a rope"], "a hole")
	for property: Dictionary in rope.get_property_list():
		if property["name"] in ["polygon", "holes", "detail_weights"]:
			check_equal(property["usage"] & (PROPERTY_USAGE_EDITOR | PROPERTY_USAGE_STORAGE), 0, "usage of %s" % property["name"])
	check_refused(func() -> void: check_equal(rope.get_center_point(99), -1, "center"), ["center index 99"], "a center out of range")
	check_refused(func() -> void: check_equal(rope.cut(Vector2(50, -50), Vector2(50, 50)).size(), 0, "pieces"), ["SoftRope2D"], "a cut")
	await ticks(2)


func test_a_texture_lies_along_the_rope() -> void:
	var rope := add_rope([Vector2.ZERO, Vector2(120, 0)], {"link_count": 10, "width": 12.0})
	var texture := GradientTexture2D.new()
	texture.width = 32
	texture.height = 16
	rope.texture = texture
	await ticks(2)
	await tree.process_frame
	check_equal(rope.uv.size(), 22, "texture coordinates")
	check_equal(rope.uv[0], Vector2(0, 0), "at the start, on one side")
	check_equal(rope.uv[21], Vector2(0, 16), "at the start, on the other side")
	check_near(rope.uv[10].x, 160, 0.1, "at the end: ten times the height of the texture")


func test_the_problem_of_a_path_is_known_before_it_is_set() -> void:
	var seed_of_run := randi()
	var random := RandomNumberGenerator.new()
	random.seed = seed_of_run
	var refused := 0
	for i in 200:
		var rope := SoftRope2D.new()
		rope.link_count = random.randi_range(0, 12)
		rope.width = random.randf_range(2, 30)
		var path := PackedVector2Array()
		for j in random.randi_range(1, 5):
			path.append(Vector2(random.randf_range(-90, 90), random.randf_range(-90, 90)))
		var problem := rope.get_path_problem(path)
		if problem == "":
			rope.path = path
			check_equal(rope.path, path, "path %d, of which nothing is said (seed %d)" % [i, seed_of_run])
		else:
			refused += 1
			var old := rope.path
			check_refused(func() -> void: rope.path = path, [problem.trim_prefix("path")], "path %d (seed %d)" % [i, seed_of_run])
			check_equal(rope.path, old, "path %d after a refusal (seed %d)" % [i, seed_of_run])
		rope.free()
	check(refused > 20 and refused < 180, "paths that were refused: %d of 200" % refused)
