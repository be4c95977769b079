# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## States of bodies that were cut since they were saved, or before.


func trace(bodies: Array, count: int) -> Array[PackedByteArray]:
	var bits: Array[PackedByteArray] = []
	for i in count:
		await ticks(1)
		for body: SoftBody2D in bodies:
			bits.append(body.get_point_positions().to_byte_array())
	return bits


func states_of(bodies: Array) -> Array[PackedByteArray]:
	var states: Array[PackedByteArray] = []
	for body: SoftBody2D in bodies:
		states.append(body.get_state())
	return states


func put_back(bodies: Array, states: Array[PackedByteArray]) -> void:
	for i in bodies.size():
		check_equal(bodies[i].set_state(states[i]), OK, "putting state %d back" % i)


func cut_through(body: SoftBody2D, angle := 0.1) -> Array[SoftBody2D]:
	var arm := Vector2.from_angle(angle) * 300
	return body.cut(body.get_center_of_mass_position() - arm, body.get_center_of_mass_position() + arm)


func free_others(pieces: Array[SoftBody2D]) -> void:
	for piece: SoftBody2D in pieces.slice(1):
		piece.free()


## Runs a tower on a floor whose middle body is cut, rewinds it to before the cut and goes on once without a cut and once with
## the same one: both in the same bits as without rewinding.
func check_rewound(model: SoftBody2D.ElasticModel) -> void:
	for wait: int in [10, 70, 400]: # in the air, when it lands, at rest
		var what := "%d ticks: " % wait
		var ground := add_floor(200)
		var tower: Array[SoftBody2D] = []
		for i in 3:
			tower.append(add_body(Vector2(3 * i, 100 - 115 * i), {"elastic_model": model, "physics_material_override": surface(0.4, 0.3)}))
		await ticks(wait)
		var whole := tower[1].polygon
		var states := states_of(tower)
		var uncut := await trace(tower, 40)
		put_back(tower, states)
		var pieces := cut_through(tower[1])
		if not check_equal(pieces.size(), 2, what + "number of pieces"):
			return
		var cut := await trace(tower + [pieces[1]], 40)
		check(cut.hash() != uncut.hash(), what + "a cut changes the run")
		put_back(tower, states)
		check_equal(tower[1].polygon, whole, what + "polygon of the whole")
		check_equal(states_of(tower), states, what + "states, put back")
		free_others(pieces)
		check_equal((await trace(tower, 40)).hash(), uncut.hash(), what + "the run without a cut")
		put_back(tower, states)
		pieces = cut_through(tower[1])
		check_equal((await trace(tower + [pieces[1]], 40)).hash(), cut.hash(), what + "the run with the cut")
		for body: SoftBody2D in tower + [pieces[1]]:
			body.free()
		ground.free()


func test_a_state_from_before_a_cut_undoes_it_in_the_same_bits() -> void:
	await check_rewound(SoftBody2D.ELASTIC_MODEL_AUTOMATIC)


func test_a_state_undoes_a_cut_of_triangles() -> void:
	await check_rewound(SoftBody2D.ELASTIC_MODEL_TRIANGLES)


func test_a_state_undoes_a_cut_of_springs_with_shape_and_area() -> void:
	await check_rewound(SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA)


func test_a_state_undoes_a_cut_of_a_network() -> void:
	await check_rewound(SoftBody2D.ELASTIC_MODEL_NETWORK)


func test_a_piece_whose_modes_were_not_found_yet_waits_for_them_anew() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var other := add_weightless_body(Vector2(500, 0))
	await ticks(2)
	cut_through(body)
	await ticks(1)
	var early := body.get_state()
	await ticks(10)
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model of the piece")
	var late := body.get_state()
	check_equal(body.set_state(early), OK, "the early state")
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_SPRINGS_SHAPE_AND_AREA, "model with the early state")
	check_equal(body.set_state(late), OK, "the late state")
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model with the late state")
	check_equal(body.set_state(early), OK, "the early state")
	await ticks(10)
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model ten ticks after the early state")
	check_equal(body.set_state(early), OK, "the early state")
	var size := early.decode_u32(16)
	var list: Array = bytes_to_var(early.slice(20, 20 + size))
	list[0] = SoftBody2D.make_circle_polygon(30, 5)
	var forged := sealed(list, other.get_state())
	check_refused(func() -> void: body.set_state(forged), ["state refused", "points"], "a state of other points")
	await ticks(10)
	check_equal(body.get_elastic_model_in_use(), SoftBody2D.ELASTIC_MODEL_MODES, "model ten ticks after a refused state")


func test_own_springs_and_the_model_that_they_choose_come_back() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"center_point": false, "springs": PackedInt32Array([0, 8, 4, 12, 0, 4, 4, 8, 8, 12, 12, 0])})
	await ticks(2)
	var state := body.get_state()
	var springs := body.get_all_springs()
	check_equal(cut_through(body).size(), 2, "number of pieces")
	await ticks(2)
	check_equal(body.set_state(state), OK, "putting the state back")
	check_equal(body.elastic_model, SoftBody2D.ELASTIC_MODEL_AUTOMATIC, "chosen model")
	check_equal(body.get_all_springs(), springs, "springs")


func test_cuts_of_cuts_are_undone_one_by_one() -> void:
	var body := add_weightless_body(Vector2(100, 50), {"texture_rotation": 0.3, "mass_mode": SoftBody2D.MASS_MODE_CUSTOM, "mass": 3.0})
	await ticks(3)
	var states: Array[PackedByteArray] = []
	var polygons: Array[PackedVector2Array] = []
	var edges: Array[PackedInt32Array] = []
	var masses: Array[float] = []
	for i in 4:
		states.append(body.get_state())
		polygons.append(body.polygon)
		edges.append(body.cut_edges)
		masses.append(body.mass)
		check_equal(cut_through(body, 1.1 * i).size(), 2, "number of pieces of cut %d" % i)
		await ticks(8)
	for i: int in [2, 3, 0, 1, 3, 0]: # back and forth
		check_equal(body.set_state(states[i]), OK, "state %d" % i)
		check_equal(body.polygon, polygons[i], "polygon %d" % i)
		check_equal(body.cut_edges, edges[i], "cut edges %d" % i)
		check_near(body.mass, masses[i], 1e-9, "mass %d" % i)
		check_equal(body.get_state(), states[i], "state %d, as bytes" % i)
		await ticks(2)


func test_a_saved_game_makes_pieces_of_new_nodes() -> void:
	var body := add_body(Vector2(0, 0), {"linear_velocity": Vector2(50, -200), "angular_velocity": 3.0})
	await ticks(5)
	var pieces := cut_through(body)
	await ticks(20)
	var states := states_of(pieces)
	var masses := pieces.map(func(piece: SoftBody2D) -> float: return piece.mass)
	var expected := await trace(pieces, 60)
	for piece: SoftBody2D in pieces:
		piece.free()
	var loaded: Array[SoftBody2D] = [add_body(Vector2(500, 0)), add_body(Vector2(-500, 0))]
	put_back(loaded, states)
	check_equal(states_of(loaded), states, "states of the new nodes")
	for i in 2:
		check_near(loaded[i].mass, masses[i], 1e-6, "mass of new node %d" % i)
	check_equal((await trace(loaded, 60)).hash(), expected.hash(), "motion of the new nodes")


func test_the_state_of_the_whole_makes_a_piece_whole() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	await ticks(2)
	var state := body.get_state()
	var pieces := cut_through(body)
	await ticks(5)
	body.free()
	check_equal(pieces[1].set_state(state), OK, "state of the whole in the other piece")
	check_equal(pieces[1].get_point_count(), 17, "points of it")
	check_near(pieces[1].mass, 1.0, 1e-6, "mass of it")


func test_what_hung_on_the_whole_comes_back() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	var holders: Array[Node2D] = [Node2D.new(), Node2D.new()]
	for i in 2:
		stage.add_child(holders[i])
		body.set_point_pinned(3 + 8 * i, true, body.get_path_to(holders[i]))
	var joints: Array[SoftBodyJoint2D] = []
	var hats: Array[SoftBodyAttachment2D] = []
	for y: float in [-50, 50]:
		var joint := SoftBodyJoint2D.new()
		joint.position = Vector2(0, y)
		stage.add_child(joint)
		joint.node_a = joint.get_path_to(body)
		joints.append(joint)
		var hat := SoftBodyAttachment2D.new()
		hat.position = Vector2(0, 0.8 * y)
		body.add_child(hat)
		hats.append(hat)
	await ticks(5)
	var state := body.get_state()
	var pins := body.pinned_points
	var anchors := [joints[0].get_anchor_a(), joints[1].get_anchor_a()]
	var places := [hats[0].global_position, hats[1].global_position]
	var pieces := cut_through(body)
	check_equal(pieces[0].get_child_count() + pieces[1].get_child_count(), 2, "number of attachments of the pieces")
	await ticks(10)
	check_equal(body.set_state(state), OK, "putting the state back")
	check_equal(body.pinned_points, pins, "pins")
	for i in 2:
		check(body.get_node_or_null(body.get_pin_target(3 + 8 * i)) == holders[i], "target %d is as before" % i)
	free_others(pieces)
	for i in 2:
		check(is_instance_valid(hats[i]) and hats[i].get_parent() == body, "attachment %d is back" % i)
		check_near(hats[i].global_position, places[i], 0.01, "place of attachment %d" % i)
		check(joints[i].get_node_or_null(joints[i].node_a) == body, "joint %d is back" % i)
		check_near(joints[i].get_anchor_a(), anchors[i], 0.01, "anchor %d" % i)
	await seconds(1)
	for i in 2:
		check_near(joints[i].get_anchor_a(), anchors[i], 1.0, "anchor %d, a second later" % i)
		check_below(joints[i].get_anchor_a().distance_to(joints[i].get_anchor_b()), 1.0, "gap %d" % i)


func test_tears_are_undone() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"tear_stretch": 0.2, "youngs_modulus": 1e3})
	await ticks(2)
	var state := body.get_state()
	var whole := body.polygon
	var torn: Array[SoftBody2D] = []
	body.torn.connect(func(pieces: Array[SoftBody2D]) -> void: torn.append_array(pieces.slice(1)))
	for i in 60:
		for point in body.get_point_count():
			var place := body.get_point_positions()[point]
			body.apply_point_force(point, Vector2(signf(place.x) * 3000, 0))
		await ticks(1)
		if not torn.is_empty():
			break
	if not check_above(torn.size(), 0, "number of pieces torn off"):
		return
	await ticks(5)
	for piece in torn:
		if is_instance_valid(piece):
			piece.free()
	check_equal(body.set_state(state), OK, "putting the state back")
	check_equal(body.polygon, whole, "polygon")
	check_equal(body.get_state(), state, "state")
	await ticks(30)
	check_near(body.get_area() / body.get_rest_area(), 1.0, 0.01, "area, over that at rest")


func test_a_user_s_new_polygon_ends_the_history() -> void:
	var body := add_weightless_body(Vector2.ZERO)
	await ticks(2)
	var state := body.get_state()
	var pieces := cut_through(body)
	body.polygon = SoftBody2D.make_circle_polygon(30, 12)
	check_refused(func() -> void: body.set_state(state), ["state refused", "points"], "the state of another polygon")
	check_equal(body.get_point_count(), 13, "points")
	pieces[1].free()


func test_damaged_states_of_pieces_are_refused_and_change_nothing() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"name": "Jelly"})
	await ticks(2)
	var whole := body.get_state()
	cut_through(body)
	await ticks(6)
	var state := body.get_state()
	check_equal(body.set_state(whole), OK, "the whole again")
	var random := RandomNumberGenerator.new()
	random.seed = 22
	var bad: Array[PackedByteArray] = [state.slice(0, 10), state.slice(0, 30), state.slice(0, state.size() - 1), state + PackedByteArray([0])]
	for i in 200:
		var damaged := state.duplicate()
		damaged[random.randi_range(0, state.size() - 1)] ^= 1 << random.randi_range(0, 7)
		bad.append(damaged)
	for each in bad:
		check_refused(func() -> void: body.set_state(each), ["Jelly", "state refused"], "damaged bytes")
	check_equal(body.get_state(), whole, "state of the body after all of them")


## Bytes whose checksums are right and whose structure no node can have.
func test_forged_structures_are_refused_by_name() -> void:
	var body := add_weightless_body(Vector2.ZERO, {"name": "Jelly"})
	await ticks(2)
	cut_through(body)
	await ticks(6)
	var state := body.get_state()
	var size := state.decode_u32(16)
	var list: Array = bytes_to_var(state.slice(20, 20 + size))
	var core := state.slice(20 + size)
	for forged: Array in [[0, PackedVector2Array(), "polygon"], [0, PackedVector2Array([Vector2.ZERO, Vector2.ONE, Vector2(NAN, 0)]), "polygon"],
			[2, PackedInt32Array([1]), "springs"], [3, PackedFloat32Array([-1]), "spring_stiffness_scales"], [10, 0.0, "mass"], [10, INF, "mass"],
			[11, 99, "elastic_model"], [11, "x", "elastic_model"], [12, 3, "awaits_modes"], [7, PackedVector2Array([Vector2(INF, 0)]), "uv"],
			[0, SoftBody2D.make_circle_polygon(30, 5), "points"]]:
		var values := list.duplicate()
		values[forged[0]] = forged[1]
		check_refused(func() -> void: body.set_state(sealed(values, core)), ["Jelly", "state refused", forged[2]], "forged %s" % forged[2])
	check_refused(func() -> void: body.set_state(sealed(list.slice(0, 5), core)), ["Jelly", "state refused"], "a short list")
	check_refused(func() -> void: body.set_state(sealed({}, core)), ["Jelly", "state refused", "structure"], "no list")
	check_equal(body.get_state(), state, "state of the body after all of them")
	check_equal(body.set_state(sealed(list, core)), OK, "the list as it was")


func sealed(values: Variant, core: PackedByteArray) -> PackedByteArray:
	var structure := var_to_bytes(values)
	var bytes := "SB2C".to_ascii_buffer()
	bytes.resize(20)
	bytes.encode_u32(4, 1)
	bytes.encode_u32(16, structure.size())
	bytes += structure + core
	var checksum := -3750763034362895579 # 0xcbf29ce484222325
	for i in range(16, bytes.size()):
		checksum = (checksum ^ bytes[i]) * 0x100000001b3
	bytes.encode_s64(8, checksum)
	return bytes
