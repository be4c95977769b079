# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Scale that scripts and tweens animate: a body pops in, shrinks to nothing, grows, and stays what it was.


const PLATFORM: PackedVector2Array = [Vector2(-90, -50), Vector2(0, -50), Vector2(90, -50), Vector2(90, 50), Vector2(0, 50), Vector2(-90, 50)]


## Shrinks a resting body to nothing and lets it grow again, in so many ticks each; 0 is at once.
func _pop(body: SoftBody2D, count: int) -> float:
	var fastest := 0.0
	for i in count:
		body.scale = Vector2.ONE * (1 - (i + 1.0) / count)
		await ticks(1)
		fastest = maxf(fastest, body.linear_velocity.length())
	body.scale = Vector2.ZERO
	await ticks(2)
	for i in count:
		body.scale = Vector2.ONE * ((i + 1.0) / count)
		await ticks(1)
		fastest = maxf(fastest, body.linear_velocity.length())
	body.scale = Vector2.ONE
	for i in 180:
		await ticks(1)
		fastest = maxf(fastest, body.linear_velocity.length())
	return fastest


func test_a_body_shrinks_to_nothing_on_the_floor_and_grows_again() -> void:
	add_floor(0)
	for count: int in [0, 6, 12, 30, 60]:
		var body := add_body(Vector2(0, -60))
		await seconds(2)
		var y := body.position.y
		var area := body.get_area()
		var fastest := await _pop(body, count)
		# It grows by up to 8 px a tick, which lifts it.
		check_below(fastest, 600, "fastest, with %d ticks to shrink" % count)
		check_near(body.position.y, y, 3, "its place on the floor after %d ticks to shrink" % count)
		check_near(body.position.x, 0, 3, "its place along the floor after %d ticks to shrink" % count)
		check_near(body.get_area() / area, 1, 0.03, "its area over that before, after %d ticks to shrink" % count)
		body.free()


## Grows a body that has sunk down at no size, in `duration` [s], 0 is at once. Returns how far it rises above `y` [px].
func _hop(body: SoftBody2D, y: float, duration: float) -> float:
	body.scale = Vector2.ZERO
	await seconds(1)
	var count := roundi(duration * Engine.physics_ticks_per_second)
	for i in count:
		body.scale = Vector2.ONE * ((i + 1.0) / count)
		await ticks(1)
	body.scale = Vector2.ONE
	var highest := 0.0
	for i in Engine.physics_ticks_per_second:
		await ticks(1)
		highest = maxf(highest, y - body.position.y)
	return highest


## What lifts it by its own size, 50 px, may not throw it. Without being held back it leaves the floor by up to 284 px.
func _check_hops(rate: int, durations: Array[float]) -> void:
	Engine.physics_ticks_per_second = rate
	add_floor(0)
	for duration in durations:
		var under := add_body(Vector2(0, -52), { "polygon": PLATFORM })
		var upper := add_body(Vector2(0, -152))
		var alone := add_body(Vector2(300, -52))
		await seconds(2)
		for body: SoftBody2D in [alone, upper]:
			var y := body.position.y
			var what := "%s, in %.2f s at %d ticks" % ["on the floor" if body == alone else "on a soft body", duration, rate]
			var highest := await _hop(body, y, duration)
			check_below(highest, 24 if rate == 30 else 12, "height of the hop after growing " + what)
			check_near(body.position.y, y, 5, "its place after growing " + what)
		for body: SoftBody2D in [under, upper, alone]:
			body.free()
	Engine.physics_ticks_per_second = 60


func test_a_body_that_grows_on_a_line_comes_out_above_it() -> void:
	var line := SegmentShape2D.new()
	line.a = Vector2(-500, 0)
	line.b = Vector2(500, 0)
	add_solid(line)
	for duration: float in [0.0, 0.2]:
		var body := add_body(Vector2(0, -52))
		await seconds(2)
		var y := body.position.y
		await _hop(body, y, duration)
		await seconds(1)
		check_near(body.position.y, y, 3, "its place after growing in %.1f s" % duration)
		body.free()


func test_a_body_that_grows_where_it_lies_does_not_hop() -> void:
	await _check_hops(60, [0.0, 0.05, 0.2, 0.5])


func test_a_body_that_grows_does_not_hop_at_30_ticks() -> void:
	await _check_hops(30, [0.0, 0.05, 0.2, 0.5])


func test_a_body_that_grows_does_not_hop_at_120_ticks() -> void:
	await _check_hops(120, [0.0, 0.2])


func test_a_body_of_no_size_is_drawn_as_nothing() -> void:
	var body := add_weightless_body()
	body.scale = Vector2.ZERO
	await ticks(3)
	var box := Rect2(body.global_position, Vector2.ZERO)
	for point in body.get_interpolated_polygon():
		box = box.expand(point)
	check_below(box.size.length(), 0.01, "size of the drawn polygon [px]")
	body.scale = Vector2.ONE
	await ticks(3)
	box = Rect2(body.global_position, Vector2.ZERO)
	for point in body.get_interpolated_polygon():
		box = box.expand(point)
	check_near(box.size, Vector2(100, 100), 1, "size of the drawn polygon when it has grown [px]")


## Modes of an outline take 10 to 20 ms. They are looked for once, whatever the size.
func test_another_size_makes_no_new_shape() -> void:
	var body := add_weightless_body()
	await ticks(2)
	var built := SoftBodySimulation2D.get_built_shape_count()
	for i in 40:
		body.scale = Vector2.ONE * (0.5 + 0.05 * i)
		await ticks(1)
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes built after 40 sizes")
	check_near(body.get_area(), PI * pow(50 * 2.45, 2), 0.03 * PI * pow(50 * 2.45, 2), "area at the last size")
	var mirrored := add_weightless_body(Vector2(900, 0))
	mirrored.scale = Vector2(-1.5, 1.5)
	await ticks(2)
	check_near(mirrored.get_area(), PI * pow(75, 2), 0.03 * PI * pow(75, 2), "area of a mirrored body")


## The same motion as a body whose polygon has that size.
func test_a_scaled_body_moves_as_one_of_that_polygon() -> void:
	add_floor(0)
	var scaled := add_body(Vector2(0, -200), { "scale": Vector2.ONE * 0.6 })
	var polygon := SoftBody2D.make_circle_polygon(30, 16)
	var drawn := add_body(Vector2(400, -200), { "polygon": polygon })
	for i in 90:
		await ticks(1)
		if absf(scaled.get_center_of_mass_position().y - drawn.get_center_of_mass_position().y) > 0.5:
			break
	check_near(scaled.get_center_of_mass_position().y, drawn.get_center_of_mass_position().y, 0.5, "height after a fall and a bounce")
	check_near(scaled.get_area(), drawn.get_area(), 0.01 * drawn.get_area(), "area")


func test_a_polygon_that_is_small_by_itself_keeps_its_size() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "polygon": SoftBody2D.make_circle_polygon(1.5, 8) })
	await ticks(3)
	check_near(body.get_area(), 0.5 * 8 * sin(TAU / 8) * 1.5 * 1.5, 0.05, "area")


## The next wave of a game comes after the last body of its kind is gone.
func test_a_kind_of_which_none_is_left_is_not_looked_for_again() -> void:
	var polygon := SoftBody2D.make_circle_polygon(37, 14)
	var built := 0
	for wave in 3:
		var bodies: Array[SoftBody2D] = []
		for i in 5:
			bodies.append(add_body(Vector2(200 * i, 0), { "polygon": polygon }))
		await ticks(2)
		if wave == 0:
			built = SoftBodySimulation2D.get_built_shape_count()
		for body in bodies:
			body.free()
		await ticks(2)
	check_equal(SoftBodySimulation2D.get_built_shape_count(), built, "shapes built by three waves, and by the first")
