# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies that are cut: what becomes of the node, its points, its looks, and what hangs on it.

const ACROSS: Array[Vector2] = [Vector2(-200, 5), Vector2(200, -10)]


func cut_across(body: SoftBody2D) -> Array[SoftBody2D]:
	return body.cut(body.global_position + ACROSS[0], body.global_position + ACROSS[1])


func area_of(polygon: PackedVector2Array) -> float:
	var sum := 0.0
	for i in polygon.size():
		sum += polygon[i].cross(polygon[(i + 1) % polygon.size()])
	return absf(sum) / 2


func total(bodies: Array[SoftBody2D], method: StringName) -> float:
	var sum := 0.0
	for body in bodies:
		sum += body.call(method)
	return sum


func momentum_of(bodies: Array) -> Vector2:
	var sum := Vector2.ZERO
	for body: SoftBody2D in bodies:
		sum += body.mass * body.linear_velocity
	return sum


func spin_of(bodies: Array) -> float:
	var sum := 0.0
	for body: SoftBody2D in bodies:
		sum += body.inertia * body.angular_velocity + body.mass * (body.get_center_of_mass_position()).cross(body.linear_velocity)
	return sum


func test_a_default_node_is_cut_in_two() -> void:
	var body := add_body(Vector2(300, 200), {"linear_velocity": Vector2(80, -30), "angular_velocity": 2.0})
	body.name = "Jelly"
	body.add_to_group("food")
	body.collision_layer = 5
	body.modulate = Color.RED
	await ticks(5)
	var before := body.get_point_positions()
	var momentum := momentum_of([body])
	var spin := spin_of([body])
	var area := body.get_area()
	var pieces := cut_across(body)
	if not check_equal(pieces.size(), 2, "number of pieces"):
		return
	check(pieces[0] == body, "the first piece is the node")
	check_near(pieces[0].mass + pieces[1].mass, 1.0, 1e-5, "mass of the pieces")
	check(pieces[0].mass >= pieces[1].mass, "the largest piece is first")
	check_near(total(pieces, &"get_area"), area, 0.05, "area of the pieces")
	check_near(momentum_of(pieces), momentum, 1e-3, "momentum")
	check_near(spin_of(pieces) / spin, 1.0, 1e-4, "angular momentum over that before")
	var other := pieces[1]
	check(other.get_parent() == body.get_parent(), "the piece is a sibling")
	check(other.is_in_group("food"), "the piece is in the group")
	check_equal(other.collision_layer, 5, "layer of the piece")
	check_equal(other.modulate, Color.RED, "color of the piece")
	check_equal(other.elastic_model, body.elastic_model, "model of the piece")
	var kept := 0
	for piece in pieces:
		for point in piece.get_point_positions():
			if before.slice(0, 16).has(point):
				kept += 1
	check_equal(kept, 16, "points of the hull that are where they were, to the last bit")
	await seconds(1)
	check(is_instance_valid(other) and other.get_area() > 0.8 * other.get_rest_area(), "the piece goes on")


func test_a_signal_tells_after_the_step_and_may_free_anything() -> void:
	var body := add_weightless_body()
	var told: Array[Array] = []
	body.was_cut.connect(func(pieces: Array[SoftBody2D]) -> void:
		told.append(pieces.duplicate())
		pieces[1].free()
		body.queue_free()) # no sender of a signal can be freed at once
	cut_across(body)
	check_equal(told.size(), 0, "number of signals before the step")
	await ticks(2)
	check_equal(told.size(), 1, "number of signals after the step")
	check(not is_instance_valid(body) or body.is_queued_for_deletion(), "the listener has freed the node")
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "number of bodies")


func test_a_cut_that_misses_or_leaves_too_little_changes_nothing() -> void:
	var body := add_weightless_body()
	await ticks(2)
	var state := body.get_state()
	check_equal(body.cut(Vector2(-100, 60), Vector2(100, 60)).size(), 0, "number of pieces of a miss")
	check_equal(body.cut(Vector2(-100, 0), Vector2(0, 0)).size(), 0, "number of pieces of a cut that ends inside")
	check_equal(body.get_cut_problem([Vector2(-100, 60), Vector2(100, 60)]), "", "problem of a miss")
	check_refused(func() -> void: body.cut(Vector2(-100, 48), Vector2(100, 48)), ["smallest_piece", "0.02"], "a cut near the border")
	check("smallest_piece" in body.get_cut_problem([Vector2(-100, 48), Vector2(100, 48)]), "the problem is named")
	check_refused(func() -> void: body.cut(Vector2(NAN, 0), Vector2(100, 0)), ["blade[0]"], "a cut from nowhere")
	check_refused(func() -> void: body.cut_polyline([Vector2(-100, 0)]), ["blade", "1 points"], "a cut of one point")
	check_refused(func() -> void: body.smallest_piece = 0.7, ["smallest_piece", "0.7"], "a smallest piece of 0.7")
	check_equal(body.get_state(), state, "state")
	body.smallest_piece = 0.001
	check_equal(body.cut(Vector2(-100, 44), Vector2(100, 44)).size(), 2, "number of pieces of a cut near the border")


func test_a_preview_shows_the_pieces_and_changes_nothing() -> void:
	var body := add_weightless_body(Vector2(100, 50))
	await ticks(2)
	var state := body.get_state()
	var blade := PackedVector2Array([body.global_position + ACROSS[0], body.global_position + ACROSS[1]])
	var outlines := body.preview_cut(blade)
	check_equal(outlines.size(), 2, "number of outlines")
	check_equal(body.get_state(), state, "state")
	var pieces := cut_across(body)
	for i in 2:
		check_points_near(pieces[i].get_point_positions().slice(0, outlines[i].size()), outlines[i], 1e-4, "the piece and its preview")
	check_equal(body.preview_cut([Vector2(0, 900), Vector2(1, 900)]).size(), 0, "number of outlines of a miss")


func test_an_l_is_cut_into_three_by_one_stroke() -> void:
	var polygon := PackedVector2Array([Vector2(0, 0), Vector2(120, 0), Vector2(120, 40), Vector2(40, 40), Vector2(40, 120), Vector2(0, 120)])
	var body := add_weightless_body(Vector2.ZERO, {"polygon": polygon, "elastic_model": SoftBody2D.ELASTIC_MODEL_SPRINGS})
	await ticks(1)
	var pieces := body.cut(Vector2(130, 10), Vector2(10, 130))
	check_equal(pieces.size(), 3, "number of pieces")
	check_near(total(pieces, &"get_rest_area"), area_of(polygon), 0.1, "area of the pieces")
	var bent := pieces[0].cut_polyline([Vector2(-10, 20), Vector2(20, 20), Vector2(20, -10)])
	check_equal(bent.size(), 2, "number of pieces of a bent cut")


func test_a_texture_goes_on_across_the_cut() -> void:
	var body := add_weightless_body(Vector2(50, 20), {"texture": PlaceholderTexture2D.new(), "texture_offset": Vector2(7, 0), "outline_width": 3.0, "scale": Vector2(1.5, 1.5)})
	var uv := PackedVector2Array()
	var colors := PackedColorArray()
	for point in body.polygon:
		uv.append(point * 2 + Vector2(64, 64))
		colors.append(Color(0.5 + point.x / 200, 0.5 + point.y / 200, 0))
	body.uv = uv
	body.vertex_colors = colors
	await ticks(2)
	var pieces := cut_across(body)
	check_equal(pieces.size(), 2, "number of pieces")
	for piece in pieces:
		check(piece.texture == body.texture and piece.texture_offset == Vector2(7, 0) and piece.outline_width == 3.0, "the look is that of the body")
		check_equal(piece.uv.size(), piece.polygon.size(), "number of texture coordinates")
		for i in piece.uv.size():
			check_near(piece.uv[i], piece.polygon[i] * 2 + Vector2(64, 64), 1e-2, "texture coordinate")
			check_near(piece.vertex_colors[i].r, 0.5 + piece.polygon[i].x / 200, 1e-2, "color of a corner")
		# The polygon is that of the whole: where the piece is not deformed, the node stands where the whole did.
		check_near(piece.global_position, Vector2(50, 20), 0.5, "position of the piece's node")


func test_a_texture_that_fills_the_box_goes_on_too() -> void:
	var texture := PlaceholderTexture2D.new()
	texture.size = Vector2(200, 100)
	var body := add_weightless_body(Vector2.ZERO, {"texture": texture, "texture_offset": Vector2(7, 3), "texture_scale": Vector2(2, 1.5), "texture_rotation": 0.4})
	await ticks(1)
	for piece in cut_across(body):
		for i in piece.polygon.size():
			# What the box of the whole, 100 px wide, shows at that place; and what the piece does.
			var pixel := (piece.polygon[i] + Vector2(50, 50)) * Vector2(2, 1)
			var shown := ((pixel - Vector2(100, 50)).rotated(0.4) + Vector2(7, 3)) * Vector2(2, 1.5) + Vector2(100, 50)
			check_near((piece.uv[i].rotated(0.4) + Vector2(7, 3)) * Vector2(2, 1.5), shown, 0.01, "place of the texture")


func test_pins_stay_with_their_points() -> void:
	var body := add_body(Vector2.ZERO)
	var holder := Node2D.new()
	stage.add_child(holder)
	body.set_point_pinned(4, true)
	body.set_point_pinned(12, true, body.get_path_to(holder))
	await ticks(5)
	var places := body.get_point_positions()
	var pieces := cut_across(body)
	check_equal(pieces[0].pinned_points.size() + pieces[1].pinned_points.size(), 2, "number of pins")
	for piece in pieces:
		check_equal(piece.pinned_points.size(), 1, "number of pins of a piece")
		var pin := piece.pinned_points[0]
		check(places.has(piece.get_point_positions()[pin]), "the pinned point is where it was")
		if not piece.get_pin_target(pin).is_empty():
			check(piece.get_node(piece.get_pin_target(pin)) == holder, "the target is the same")
	holder.position = Vector2(0, -100)
	await seconds(1)
	var ends := 0
	for piece in pieces:
		var place := piece.get_point_positions()[piece.pinned_points[0]]
		ends += int(place.distance_to(places[4]) < 0.01) + int(place.distance_to(places[12] + Vector2(0, -100)) < 0.01)
	check_equal(ends, 2, "number of pins that hold")


func test_joints_and_attachments_go_with_the_piece_they_stand_on() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var neighbor := add_weightless_body(Vector2(0, 105))
	var upper := SoftBodyJoint2D.new()
	upper.position = Vector2(0, -50)
	stage.add_child(upper)
	upper.node_a = upper.get_path_to(body)
	var lower := SoftBodyJoint2D.new()
	lower.position = Vector2(0, 52)
	stage.add_child(lower)
	lower.node_a = lower.get_path_to(body)
	lower.node_b = lower.get_path_to(neighbor)
	var hats: Array[SoftBodyAttachment2D] = []
	for y: float in [-40, 40]:
		var hat := SoftBodyAttachment2D.new()
		hat.position = Vector2(0, y)
		body.add_child(hat)
		hats.append(hat)
	await ticks(5)
	var anchors := [upper.get_anchor_a(), lower.get_anchor_a()]
	var places := [hats[0].global_position, hats[1].global_position]
	var pieces := cut_across(body)
	check(hats[0].get_parent() != hats[1].get_parent(), "the attachments are on different pieces")
	check(upper.get_node(upper.node_a) == hats[0].get_parent(), "the upper joint is on the upper piece")
	check(lower.get_node(lower.node_a) == hats[1].get_parent(), "the lower joint is on the lower piece")
	for i in 2:
		check_near([upper, lower][i].get_anchor_a(), anchors[i], 0.1, "anchor")
		check_near(hats[i].global_position, places[i], 0.5, "place of an attachment")
	await ticks(60)
	check_below(upper.get_anchor_a().distance_to(upper.get_anchor_b()), 1, "gap of the upper joint")
	check_near(lower.get_anchor_a().distance_to(lower.get_anchor_b()), anchors[1].distance_to(Vector2(0, 55)), 1, "gap of the lower joint")
	check_equal(pieces.size(), 2, "number of pieces")


func test_exceptions_of_the_whole_are_those_of_the_pieces() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var ghost := add_weightless_body(Vector2(300, 0))
	var wall := add_solid(rectangle(10, 10), Transform2D(0, Vector2(500, 0)))
	body.add_collision_exception_with(wall)
	ghost.add_collision_exception_with(body)
	await ticks(2)
	var pieces := cut_across(body)
	check(pieces[1].get_collision_exceptions().has(wall), "the piece has the exception of the whole")
	check(ghost.get_collision_exceptions().has(pieces[1]), "the other's exception holds for the piece")


func test_a_body_may_be_cut_where_it_lands() -> void:
	add_floor(100)
	var body := add_body(Vector2(0, 0), {"contact_monitor": true, "linear_velocity": Vector2(0, 300)})
	var found: Array[int] = []
	body.body_entered.connect(func(_floor: Node) -> void:
		if found.is_empty():
			found.append(cut_across(body).size()))
	await seconds(1.5)
	check_equal(found, [2] as Array[int], "number of pieces")
	check_equal(SoftBodySimulation2D.get_body_count(), 2, "number of bodies")


func test_cut_twice_in_a_tick_and_in_ready() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var first := cut_across(body)
	var second: Array[SoftBody2D] = []
	for piece in first:
		second.append_array(piece.cut(Vector2(3, -100), Vector2(-4, 100)))
	check_equal(second.size(), 4, "number of pieces")
	check_near(total(second, &"get_rest_area"), 7653.7, 1.0, "area of the pieces")
	var scene := Node2D.new()
	var early := SoftBody2D.new()
	early.position = Vector2(400, 0)
	scene.add_child(early)
	early.ready.connect(func() -> void: cut_across(early))
	stage.add_child(scene)
	await ticks(2)
	check_equal(scene.get_child_count(), 2, "number of nodes of a body that is cut as it gets ready")
	check_equal(SoftBodySimulation2D.get_body_count(), 6, "number of bodies")


func test_two_hundred_cuts_in_a_tick() -> void:
	for i in 100:
		add_weightless_body(Vector2(i % 10 * 130, floori(i / 10.0) * 130), {"elastic_model": SoftBody2D.ELASTIC_MODEL_SPRINGS_AND_SHAPE})
	await ticks(2)
	var count := 0
	for body: SoftBody2D in stage.get_children():
		var pieces := cut_across(body)
		count += int(pieces.size() == 2)
		count += int(pieces[0].cut(body.global_position + Vector2(0, -200), body.global_position + Vector2(5, 200)).size() == 2)
	check_equal(count, 200, "number of cuts")
	await ticks(30)
	check_equal(SoftBodySimulation2D.get_body_count(), 300, "number of bodies")
	for body: SoftBody2D in stage.get_children():
		check_above(body.get_area(), 0.5 * body.get_rest_area(), "area of a piece")


func test_pressed_bodies_of_a_pile_are_cut() -> void:
	add_floor(0)
	for x: float in [-1060, 1060]:
		add_solid(rectangle(20, 3000), Transform2D(0, Vector2(x, -1400)))
	for i in 300:
		add_body(Vector2(-997.5 + i % 20 * 105, -60 - floori(i / 20.0) * 105))
	await seconds(2)
	var mass := 300.0
	for body: SoftBody2D in stage.get_children().filter(func(node: Node) -> bool: return node is SoftBody2D).slice(0, 30):
		cut_across(body) # those at the bottom
	await seconds(3)
	var found := 0.0
	for body: SoftBody2D in stage.get_children().filter(func(node: Node) -> bool: return node is SoftBody2D):
		found += body.mass
		check_below(absf(body.get_center_of_mass_position().x), 1055, "x of a body")
		check_below(body.get_center_of_mass_position().y, 0, "y of a body")
		check_above(body.get_area(), 0.2 * body.get_rest_area(), "area of a body")
	check_near(found, mass, 0.01, "mass of the pile")


func test_pieces_that_lie_on_each_other_are_not_thrown_when_they_are_cut() -> void:
	# Twelve blocks of 260 by 190 px, each cut across; 48 ticks later both pieces are cut upright by one line. A piece of the
	# fourth left with 132 px/s while a corner's longer edge decided through which edge it leaves another body.
	var outline := PackedVector2Array()
	var corners := [Vector2(-130, -95), Vector2(130, -95), Vector2(130, 95), Vector2(-130, 95)]
	for side in 4:
		for k in 6:
			outline.append(corners[side].lerp(corners[(side + 1) % 4], k / 6.0))
	var heaps: Array[Array] = []
	for i in 12:
		add_solid(rectangle(800, 40), Transform2D(0, Vector2(i * 900.0, 20)))
		heaps.append([add_body(Vector2(i * 900.0, -100), {"polygon": outline})])
	await ticks(30)
	for i in 12:
		var middle: Vector2 = heaps[i][0].get_center_of_mass_position()
		var slope := 20.0 * (i % 4) - 30
		heaps[i] = heaps[i][0].cut(middle + Vector2(-400, -slope), middle + Vector2(400, slope))
		check_equal(heaps[i].size(), 2, "pieces of block %d" % i)
	await ticks(48)
	for i in 12:
		var place := Vector2(i * 900.0 + 15 * (i % 5) - 30, -95)
		for piece: SoftBody2D in heaps[i].duplicate():
			heaps[i].append_array(piece.cut(place + Vector2(-i, -400), place + Vector2(i, 400)).slice(1))
		check_equal(heaps[i].size(), 4, "pieces of block %d in the end" % i)
	var fastest := PackedFloat32Array()
	fastest.resize(12)
	for tick in 120:
		await ticks(1)
		for i in 12:
			for piece: SoftBody2D in heaps[i]:
				fastest[i] = maxf(fastest[i], piece.linear_velocity.length())
	for i in 12:
		check_below(fastest[i], 120, "speed of the fastest piece of block %d" % i)


func test_a_cut_moves_nothing_that_is_drawn_between_ticks() -> void:
	var body := add_body(Vector2(100, 100), {"linear_velocity": Vector2(400, -200), "angular_velocity": 5.0})
	await ticks(10)
	var shown := body.get_interpolated_polygon(0.4)
	var pieces := cut_across(body)
	var found := 0
	var drawn := pieces[0].get_interpolated_polygon(0.4) + pieces[1].get_interpolated_polygon(0.4)
	for old in shown:
		for point in drawn:
			if old.distance_to(point) < 0.1:
				found += 1
				break
	check_equal(found, 16, "corners that are drawn where they were")


func test_inner_points_springs_and_custom_mass() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"inner_points": PackedVector2Array([Vector2(0, -20), Vector2(10, 20)]), "mass": 4.0})
	body.springs = body.get_all_springs()
	await ticks(2)
	var pieces := cut_across(body)
	check_near(pieces[0].mass + pieces[1].mass, 4.0, 1e-5, "mass of the pieces")
	for piece in pieces:
		check_equal(piece.inner_points.size(), 1, "number of inner points")
		check_equal(piece.springs.size(), 0, "number of springs that were given")
		check_equal(piece.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_NETWORK, "model")
	await ticks(30)


func test_springs_stand_in_for_the_modes_of_pieces_for_some_ticks() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"linear_velocity": Vector2(90, 10), "angular_velocity": 3.0})
	await ticks(2)
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model before")
	var built := SoftBodySimulation2D.get_built_shape_count()
	var pieces := cut_across(body)
	for piece in pieces:
		check_equal(piece.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA, "model at the cut")
	var momentum := momentum_of(pieces)
	var spin := spin_of(pieces)
	await ticks(12)
	for piece in pieces:
		check_equal(piece.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model later")
		check_equal(piece.elastic_model, SoftBody2D.ELASTIC_MODEL_AUTOMATIC, "model that was set")
	check_equal(SoftBodySimulation2D.get_built_shape_count() - built, 4, "number of shapes that were made")
	check_near(momentum_of(pieces), momentum, 0.02, "momentum")
	check_near(spin_of(pieces) / spin, 1.0, 2e-3, "angular momentum over that before")
	var again := pieces[0].cut(pieces[0].get_center_of_mass_position() + Vector2(0, -200), pieces[0].get_center_of_mass_position() + Vector2(1, 200))
	check_equal(again.size(), 2, "number of pieces of a piece")
	again[1].cut(again[1].get_center_of_mass_position() - Vector2(200, 10), again[1].get_center_of_mass_position() + Vector2(200, 10))
	again[0].queue_free() # before its modes are there
	await ticks(12)
	for piece: SoftBody2D in stage.get_children():
		check_equal(piece.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model of a piece of a piece")


func test_pieces_lie_where_the_body_lay_whatever_the_frame() -> void:
	var reversed := SoftBody2D.make_box_polygon(Vector2(120, 80), 20)
	reversed.reverse()
	var cases: Array[Dictionary] = [
		{"polygon": reversed},
		{"scale": Vector2(-1.5, 1.5)},
		{"scale": Vector2(1.4, 0.7), "rotation": 0.6},
		{"skew": 0.3, "rotation": -2.0},
		{"top_level": true, "rotation": 1.0},
		{"scale": Vector2(0.3, 0.3)},
		{"polygon": Transform2D(0, Vector2(700, -300)) * reversed, "rotation": 0.4},
	]
	for i in cases.size():
		var parent := Node2D.new()
		parent.transform = Transform2D(0.5, Vector2(2, 2), 0.0, Vector2(i * 2000, 3000))
		stage.add_child(parent)
		var body := SoftBody2D.new()
		body.gravity_scale = 0
		for property: String in cases[i]:
			body.set(property, cases[i][property])
		parent.add_child(body)
		var what := "case %d: " % i
		await ticks(2)
		var before := polygon_of(body)
		var area := body.get_rest_area()
		var middle := body.get_center_of_mass_position()
		var pieces := body.cut(middle + Vector2(-900, 20), middle + Vector2(900, -35))
		check_equal(pieces.size(), 2, what + "number of pieces")
		check_near(total(pieces, &"get_rest_area") / area, 1.0, 1e-4, what + "area over that of the whole")
		var after := PackedVector2Array()
		for piece in pieces:
			check(piece.get_parent() == parent, what + "parent of a piece")
			check_near(piece.get_global_transform().determinant() / body.get_global_transform().determinant(), 1.0, 1e-3, what + "scale of a piece's node")
			after.append_array(polygon_of(piece))
		for point in before:
			check(after.has(point), what + "a corner is where it was, to the last bit")
		await ticks(20)
		for piece in pieces:
			for point in polygon_of(piece):
				var nearest := INF
				for old in after:
					nearest = minf(nearest, old.distance_to(point))
				check_below(nearest, 0.05, what + "way of a corner of a body at rest")


func test_material_and_surface_are_those_of_the_whole() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"youngs_modulus": 777.0, "poisson_ratio": 0.2, "physics_material_override": surface(0.9, 0.3), "linear_damp": 0.5,
			"contact_monitor": true, "self_collision": SoftBody2D.SELF_COLLISION_ON, "process_mode": Node.PROCESS_MODE_ALWAYS, "input_pickable": true})
	var shared := SoftBodyMaterial2D.new()
	shared.youngs_modulus = 432.0
	var other := add_weightless_body(Vector2(300, 0), {"soft_body_material": shared})
	await ticks(2)
	for piece in cut_across(body):
		check_equal([piece.youngs_modulus, piece.poisson_ratio, piece.linear_damp, piece.contact_monitor, piece.self_collision, piece.process_mode, piece.input_pickable],
				[777.0, 0.2, 0.5, true, SoftBody2D.SELF_COLLISION_ON, Node.PROCESS_MODE_ALWAYS, true], "values of a piece")
		check(piece.physics_material_override == body.physics_material_override, "surface of a piece")
	for piece in cut_across(other):
		check(piece.soft_body_material == shared, "material of a piece")


func _is_near_any(place: Vector2, lines: Array) -> bool:
	return lines.any(func(line: Array) -> bool:
		return absf((place - line[0]).dot((line[1] - line[0]).orthogonal().normalized())) < 0.01)


## Of each piece exactly the edges on the lines, of which a body whose polygon goes the other way has others.
func test_pieces_know_which_of_their_edges_are_cut() -> void:
	for clockwise: bool in [false, true]:
		for mirrored: bool in [false, true]:
			var polygon := SoftBody2D.make_circle_polygon(60, 20)
			if clockwise:
				polygon.reverse()
			var body := add_body(Vector2(300, 200), {"polygon": polygon, "gravity_scale": 0.0, "scale": Vector2(-1 if mirrored else 1, 1)})
			await ticks(2)
			var lines := [[Vector2(200, 190), Vector2(400, 215)], [Vector2(290, 100), Vector2(315, 300)]]
			var pieces: Array[SoftBody2D] = []
			for piece in body.cut(lines[0][0], lines[0][1]):
				pieces.append_array(piece.cut(lines[1][0], lines[1][1]))
			check_equal(pieces.size(), 4, "number of pieces")
			for piece in pieces:
				var places := piece.get_point_positions()
				var count := piece.polygon.size()
				for i in count:
					var on_line := _is_near_any(places[i], [lines[0]]) and _is_near_any(places[(i + 1) % count], [lines[0]])
					on_line = on_line or (_is_near_any(places[i], [lines[1]]) and _is_near_any(places[(i + 1) % count], [lines[1]]))
					check_equal(piece.cut_edges.has(i), on_line, "edge %d of %s, clockwise %s, mirrored %s, is cut" % [i, piece.name, clockwise, mirrored])
				piece.free()


func test_edges_that_are_none_are_warned_of() -> void:
	var body := add_body(Vector2(300, 200), {"cut_edges": PackedInt32Array([3, 99])})
	check("cut_edges" in " ".join(body.get_warnings()), "an edge that is none is not warned of")
	body.cut_edges = PackedInt32Array([3])
	check(not "cut_edges" in " ".join(body.get_warnings()), "an edge is warned of")
