# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What the captions of the examples say is what happens in them.

var _scene: Node2D


func _open(name: String) -> void:
	_scene = (load("res://examples/%s.tscn" % name) as PackedScene).instantiate()
	stage.add_child(_scene)


func _body(name: String) -> SoftBody2D:
	return _scene.get_node(name) as SoftBody2D


## How many pairs of edges of the polygon cross.
func _crossings(body: SoftBody2D) -> int:
	var polygon := polygon_of(body)
	var count := 0
	for i in polygon.size():
		for k in range(i + 2, polygon.size()):
			if (k + 1) % polygon.size() != i and Geometry2D.segment_intersects_segment(
					polygon[i], polygon[i + 1], polygon[k], polygon[(k + 1) % polygon.size()]) != null:
				count += 1
	return count


func test_pins_hold_and_the_rest_hangs() -> void:
	_open("pins")
	await ticks(1)
	var body := _body("Tongue")
	var before := polygon_of(body)
	await seconds(3)
	var after := polygon_of(body)
	for i in body.pinned_points:
		check_near(after[i], before[i], 0.01, "pinned point %d" % i)
	check_above(bounds_of(after).end.y, bounds_of(before).end.y + 8, "lower end of the tongue")


func test_pinned_points_follow_their_targets() -> void:
	_open("pin_targets")
	await ticks(2)
	var body := _body("Sling")
	var hook := _scene.get_node("Crane/LeftHook") as Node2D
	var pin := body.pinned_points[0]
	var offset := polygon_of(body)[pin] - hook.global_position
	for i in 10:
		await ticks(25)
		# The crane moves after the step: a pin is where its target was when the tick began, at 250 px/s at most.
		check_near(polygon_of(body)[pin] - hook.global_position, offset, 5, "place of the pin beside its hook")


func test_few_points_stand_for_two_hundred_and_lie_as_they_do() -> void:
	_open("detail")
	await seconds(4)
	var as_drawn := _body("AsDrawn")
	var automatic := _body("Automatic")
	check_equal(as_drawn.get_detail_report().points_simulated, 200, "points as drawn")
	check_below(automatic.get_detail_report().points_simulated, 24.5, "points within 3 %")
	check_equal(_body("PointCount").get_detail_report().points_simulated, 12, "a number of points")
	var box := bounds_of(as_drawn.get_interpolated_polygon(1))
	for body: SoftBody2D in [automatic, _body("PointCount")]:
		var other := bounds_of(body.get_interpolated_polygon(1))
		check_near(other.size, box.size, 10.0, "size of what is drawn of %s" % body.name)
		check_near(other.end.y, box.end.y, 9.0, "lowest place of %s" % body.name)


func test_bodies_with_holes_rest_with_their_holes_open() -> void:
	_open("holes")
	await seconds(4)
	for name: String in ["Ring", "Tyre", "Frame", "Cheese"]:
		var body := _body(name)
		check_near(body.get_area(), body.get_rest_area(), 0.25 * body.get_rest_area(), "area of what is left of %s" % name)
		for hole in body.get_interpolated_holes(1):
			for point in hole:
				check(Geometry2D.is_point_in_polygon(point, body.get_interpolated_polygon(1)), "a hole of %s stays inside" % name)
			check_above(bounds_of(hole).size.y, 8, "height of a hole of %s" % name)


func test_a_drawn_line_cuts_what_it_goes_through() -> void:
	_open("cuts")
	await seconds(1.5)
	var melon := _body("Melon")
	var star := _body("Star")
	var mass := melon.mass
	var made: int = _scene.call("cut_all", PackedVector2Array([melon.get_center_of_mass_position() + Vector2(-150, -20), melon.get_center_of_mass_position() + Vector2(40, 10),
			star.get_center_of_mass_position() + Vector2(0, 5), star.get_center_of_mass_position() + Vector2(140, 0)]))
	check(made >= 2, "number of new pieces is %d" % made)
	check_below(melon.mass, 0.9 * mass, "mass of what is left of the melon")
	await seconds(1)
	for body: SoftBody2D in _scene.find_children("*", "SoftBody2D", true, false):
		check_above(body.get_area(), 0.6 * body.get_rest_area(), "area of a piece")
		check_below(body.get_center_of_mass_position().y, 640, "y of a piece")


func test_the_joint_breaks_and_is_mended() -> void:
	_open("joints")
	var joint := _scene.get_node("%Breaking") as SoftBodyJoint2D
	var told: Array[int] = [0]
	joint.broken.connect(func() -> void: told[0] += 1)
	await seconds(5)
	check_equal(told[0], 1, "times that the joint said it broke")
	await seconds(2.5)
	check(not joint.is_broken(), "the joint is still broken")
	var rod := _body("Left").global_position.distance_to(_body("Right").global_position)
	check_near(rod, 200, 12, "length of the rod and two half bodies")


func test_balloons_swell_and_shrink() -> void:
	_open("inflation")
	await seconds(3)
	var swollen := _body("Skin").get_area() / _body("Skin").get_rest_area()
	check_above(swollen, 1.8, "area over rest area, blown up")
	await seconds(3)
	check_below(_body("Skin").get_area() / _body("Skin").get_rest_area(), 0.75, "area over rest area, let out")


func test_lips_stop_each_other_only_with_self_collision() -> void:
	_open("self_collision")
	var most := [0, 0]
	for i in 30:
		await ticks(10)
		most[0] = maxi(most[0], _crossings(_body("Solid")))
		most[1] = maxi(most[1], _crossings(_body("Ghost")))
	check_equal(most[0], 0, "crossings with self-collision")
	check_above(most[1], 1, "crossings without")


func test_the_soft_side_gives_way() -> void:
	_open("structure")
	await seconds(4)
	var tops := PackedFloat32Array()
	for side: float in [-80, 80]:
		var place := _body("Half").to_global(Vector2(side, -70))
		tops.append(polygon_of(_body("Half"))[_body("Half").get_nearest_point(place)].y)
	check_above(tops[0], tops[1] + 2, "height of the soft side's top below that of the firm one")


func test_the_worm_crawls() -> void:
	_open("muscles")
	await seconds(1)
	var start := _body("Worm").get_center_of_mass_position().x
	await seconds(5)
	check_above(_body("Worm").get_center_of_mass_position().x, start + 60, "way of the worm")


func test_rewinding_leads_back_to_the_beginning() -> void:
	_open("rewind")
	await ticks(2)
	var body := _body("Body3")
	var first := body.get_point_positions()
	var farthest := 0.0
	var back := INF
	for i in 470:
		await ticks(1)
		var way := largest_distance(body.get_point_positions(), first)
		farthest = maxf(farthest, way)
		if i > 320:
			back = minf(back, way)
	check_above(farthest, 200, "way of a body")
	# Two ticks a tick: it comes by within one tick's fall of the beginning, which is 0.3 px and less.
	check_below(back, 1, "distance from the beginning, played backwards")


func test_frozen_bodies_wait_until_they_thaw() -> void:
	_open("freeze_and_sleep")
	var body := _body("Frozen2")
	var start := body.global_position
	await seconds(4.8)
	check_near(body.global_position, start, 0.01, "place of a frozen body")
	await seconds(2)
	check_above(body.global_position.y, start.y + 50, "y of the body that has thawed")


func test_the_satellite_stays_on_its_way() -> void:
	_open("areas")
	for i in 20:
		await ticks(30)
		var distance := _body("Satellite").get_center_of_mass_position().distance_to(Vector2(690, 330))
		check(distance > 100 and distance < 230, "the satellite is %d px from the planet's middle" % roundi(distance))
	check_below(_body("Raft").get_center_of_mass_position().y, 420, "y of the raft on the water")


func test_the_lift_carries_its_rider() -> void:
	_open("moving_platforms")
	await seconds(1)
	var lift := _scene.get_node("%Lift") as Node2D
	for i in 6:
		await seconds(1)
		check_near(bounds_of(polygon_of(_body("Rider"))).end.y, lift.position.y - 12, 6, "lower end of the rider on the lift")


func test_bodies_of_one_color_pass_through_each_other() -> void:
	_open("collision_exceptions")
	await seconds(3)
	var bodies := _scene.find_children("*", "SoftBody2D")
	var exceptions := 0
	var overlaps := 0
	for a: SoftBody2D in bodies:
		for b: SoftBody2D in bodies:
			if a == b:
				continue
			var inside := 0
			for point in polygon_of(a):
				inside += int(b.has_point(point.lerp(a.get_center_of_mass_position(), 0.1)))
			if a.color != b.color:
				check_equal(inside, 0, "points of %s a tenth deep inside %s" % [a.name, b.name])
			else:
				overlaps += int(inside > 0)
			exceptions += int(a.get_collision_exceptions().has(b))
	check_equal(exceptions, 3 * 4 * 3 / 2, "pairs of one color")
	check_above(overlaps, 5, "bodies that lie in one of their color")


func test_interpolation_puts_the_ticks_back() -> void:
	_open("interpolation")
	check_equal(Engine.physics_ticks_per_second, 10, "ticks per second in the scene")
	await ticks(5)
	_scene.free()
	check_equal(Engine.physics_ticks_per_second, 60, "ticks per second after it")


func test_forces_move_what_the_caption_says() -> void:
	_open("motion")
	await seconds(2)
	check_above(_body("Wheel").get_center_of_mass_position().x, 300, "way of the wheel up the ramp")
	check_above(_body("Sledge").get_center_of_mass_position().x, 580, "way of the sledge")
	# g / d (t - (1 - exp(-d t)) / d) below its start, with d = 4 as there is no other damping in tests.
	check_near(_body("Ball").get_center_of_mass_position().y, 140 + 245 * (2 - 0.25), 8, "y of the braked ball after 2 s")
	check_above(_body("Star").angular_velocity, 6, "spin of the star")


func test_bodies_roll_down_the_tiles() -> void:
	_open("tiles")
	await seconds(6)
	for i in 3:
		var body := _body("Body%d" % (i + 1))
		check_above(body.get_center_of_mass_position().y, 330, "height of %s after 6 s" % body.name)
		check_below(body.get_penetration(), 1, "penetration of " + body.name)


func test_dents_stay_and_grow_out() -> void:
	_open("dents")
	await seconds(4)
	check_equal(_body("Elastic").get_dent(), 0.0, "dent of the elastic disc")
	check_above(_body("Metal").get_dent(), 0.3, "dent of sheet metal")
	check_above(_body("Tough").get_dent(), 0.1, "dent of tough matter")
	check_below(_body("Tough").get_dent(), 0.3, "dent of tough matter")
	check_below(_body("Dough").get_dent(), 0.1, "dent of what creeps slowly")
	check_above(_body("Dough").get_dent(), 0.02, "dent of what creeps slowly")
	await seconds(2.8)
	check_below(_body("Metal").get_dent(), 0.05, "dent of sheet metal when it has grown out")


func test_strips_tear_and_the_painted_one_at_its_seam() -> void:
	_open("tears")
	await seconds(4)
	var strips: Array[SoftBody2D] = _scene.get(&"strips")
	var found: Array[int] = [0, 0, 0]
	var seam := 0.0
	for body: SoftBody2D in _scene.find_children("*", "SoftBody2D", true, false):
		for i in strips.size():
			if absf(body.position.y - strips[i].position.y) < 90:
				found[i] += 1
		if body != strips[2] and absf(body.position.y - strips[2].position.y) < 90:
			seam = body.get_rest_area() / (strips[2].get_rest_area() + body.get_rest_area())
	check_equal(found[0], 1, "pieces of the strip that does not tear")
	check_equal(found[1], 2, "pieces of the second strip")
	check_equal(found[2], 2, "pieces of the painted strip")
	check_near(seam, (150 - 70) / 300.0, (22 + 11) / 300.0, "share of what is beyond the seam, which is 44 px wide between points 21 px apart")
