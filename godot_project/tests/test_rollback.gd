# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The state of a whole world is a value, and a game may step a world by itself.

const DELTA := 1.0 / 60
const EXAMPLE := "res://examples/rollback.tscn"


func time_limit() -> int:
	return 6000


func add_world() -> SubViewport:
	var viewport := SubViewport.new()
	viewport.size = Vector2i(64, 64)
	viewport.world_2d = World2D.new()
	stage.add_child(viewport)
	return viewport


func add_to(world: Node, position: Vector2, properties := {}) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.position = position
	for property: String in properties:
		body.set(property, properties[property])
	world.add_child(body)
	return body


func step(world: SubViewport, count := 1, is_replay := false) -> void:
	for i in count:
		check_equal(SoftBodySimulation2D.step(world.world_2d.space, DELTA, is_replay), OK, "a step by hand")


func save(world: SubViewport, base := PackedByteArray()) -> PackedByteArray:
	return SoftBodySimulation2D.save_state(world.world_2d.space, base)


func restore(world: SubViewport, state: PackedByteArray, base := PackedByteArray()) -> Error:
	return SoftBodySimulation2D.restore_state(world.world_2d.space, state, base)


func bodies_of(world: Node) -> Array[SoftBody2D]:
	var bodies: Array[SoftBody2D] = []
	for node in world.find_children("*", "SoftBody2D", true, false):
		bodies.append(node as SoftBody2D)
	return bodies


## What shows of a world in each of so many steps by hand.
func course(world: SubViewport, count: int) -> Array:
	var seen := []
	for i in count:
		step(world)
		for body in bodies_of(world):
			seen.append([body.get_point_positions(), body.get_point_velocities(), body.global_transform, body.sleeping, body.get_dents(),
					body.get_colliding_bodies().size() if body.contact_monitor else 0])
		for joint in world.find_children("*", "SoftBodyJoint2D", true, false):
			seen.append((joint as SoftBodyJoint2D).is_broken())
	return seen


## A tower that is about to land, two joints, one of which breaks there, metal that dents, a body with a locked rotation.
func add_scene() -> SubViewport:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	add_floor(200, world)
	var bodies: Array[SoftBody2D] = []
	for i in 3:
		bodies.append(add_to(world, Vector2(20 * i, 60 - 105 * i), {"contact_monitor": true, "physics_material_override": surface(0.4, 0.3)}))
	bodies.append(add_to(world, Vector2(300, 0), {"yield_strain": 0.01, "linear_velocity": Vector2(0, 500)}))
	bodies.append(add_to(world, Vector2(500, 100), {"lock_rotation": true, "angular_velocity": 4.0}))
	for i in 2:
		var joint := SoftBodyJoint2D.new()
		joint.position = (bodies[i].position + bodies[i + 1].position) / 2
		world.add_child(joint)
		joint.node_a = joint.get_path_to(bodies[i])
		joint.node_b = joint.get_path_to(bodies[i + 1])
		joint.break_force = 3000.0 if i == 0 else 0.0
	return world


func test_a_world_put_back_goes_on_in_the_same_bits() -> void:
	var world := add_scene()
	var hits := []
	for body in bodies_of(world):
		body.body_entered.connect(func(other: Node) -> void: hits.append(["in", body.name, other.name]))
		body.body_exited.connect(func(other: Node) -> void: hits.append(["out", body.name, other.name]))
		body.sleeping_state_changed.connect(func() -> void: hits.append([body.name, body.sleeping]))
	var joint := world.find_children("*", "SoftBodyJoint2D", true, false)[0] as SoftBodyJoint2D
	joint.broken.connect(func() -> void: hits.append("broken"))
	var has_broken := false
	for wait: int in [0, 15, 60, 500]: # before the first step, in the air, bouncing, at rest
		var what := "after %d steps: " % wait
		step(world, wait)
		await ticks(1)
		hits.clear()
		var state := save(world)
		var was_broken := joint.is_broken()
		var expected := course(world, 60)
		var expected_hits := hits.duplicate()
		has_broken = has_broken or (joint.is_broken() and not was_broken)
		var end := save(world)
		for i in 2:
			hits.clear()
			bodies_of(world)[4].rotation += 0.4 # the rotation in which it is locked
			check_equal(restore(world, state), OK, what + "putting the state back")
			check_equal(save(world), state, what + "the state once more")
			check_equal(joint.is_broken(), was_broken, what + "whether the joint is broken")
			check(course(world, 60) == expected, what + "the course differs")
			check_equal(hits, expected_hits, what + "signals")
			check_equal(save(world), end, what + "the state at the end")
		restore(world, state)
	check(has_broken, "no joint has broken")
	check_above(bodies_of(world)[3].get_dent(), 0.001, "dent of the metal")
	check(bodies_of(world)[0].sleeping, "the tower does not sleep in the end")


func test_steps_by_hand_are_those_of_a_tick() -> void:
	var automatic := add_world()
	var by_hand := add_world()
	SoftBodySimulation2D.set_automatic_stepping(by_hand.world_2d.space, false)
	check(not SoftBodySimulation2D.is_automatic_stepping(by_hand.world_2d.space), "it is stepped by ticks")
	check(SoftBodySimulation2D.is_automatic_stepping(automatic.world_2d.space), "the other is not")
	for world: SubViewport in [automatic, by_hand]:
		add_floor(100, world)
		for i in 3:
			add_to(world, Vector2(10 * i, -105 * i))
	var still := bodies_of(by_hand)[0].get_point_positions()
	await ticks(5)
	check_equal(bodies_of(by_hand)[0].get_point_positions(), still, "points of a world that nobody steps")
	step(by_hand, 5)
	for i in 100:
		check_equal(SoftBodySimulation2D.hash_state(by_hand.world_2d.space), SoftBodySimulation2D.hash_state(automatic.world_2d.space), "hash after %d ticks" % i)
		await ticks(1)
		step(by_hand)
	SoftBodySimulation2D.set_automatic_stepping(by_hand.world_2d.space, true)
	await ticks(1)
	check_equal(SoftBodySimulation2D.hash_state(by_hand.world_2d.space), SoftBodySimulation2D.hash_state(automatic.world_2d.space), "hash after an automatic step")
	var half := add_world()
	SoftBodySimulation2D.set_automatic_stepping(half.world_2d.space, false)
	var falling := add_to(half, Vector2.ZERO)
	for i in 120:
		SoftBodySimulation2D.step(half.world_2d.space, DELTA / 2)
	check_near(falling.linear_velocity.y, GRAVITY, 1, "velocity after a second of half steps in one tick")


func add_fluid(world: Node, position: Vector2, size: Vector2, properties := {}) -> SoftBodyFluid2D:
	var fluid := SoftBodyFluid2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = rectangle(size.x, size.y)
	fluid.add_child(collision)
	fluid.position = position
	for property: String in properties:
		fluid.set(property, properties[property])
	world.add_child(fluid)
	return fluid


## Bodies fall into water, drift into wind and out of it, while the engine makes no step at all.
func test_steps_by_hand_and_replays_repeat_what_water_and_wind_do() -> void:
	var automatic := add_world()
	var by_hand := add_world()
	SoftBodySimulation2D.set_automatic_stepping(by_hand.world_2d.space, false)
	var winds: Array[SoftBodyFluid2D] = []
	for world: SubViewport in [automatic, by_hand]:
		add_fluid(world, Vector2(0, 300), Vector2(4000, 400)) # its surface is at 100
		winds.append(add_fluid(world, Vector2(300, -1000), Vector2(400, 4000), {"buoyancy_enabled": false, "flow": Vector2(900, 0)}))
		for i in 4:
			add_to(world, Vector2(-300 + 130 * i, -120 * i), {"mass": 0.4 + 0.5 * i})
		add_to(world, Vector2(250, -500), {"mass": 0.3})
		add_to(world, Vector2(-600, 400), {"mass": 3.0, "collision_layer": 2}) # on a layer that no fluid looks at
	await ticks(90)
	step(by_hand, 15)
	var state := save(by_hand)
	step(by_hand, 75)
	var space := by_hand.world_2d.space
	check_equal(SoftBodySimulation2D.hash_state(space), SoftBodySimulation2D.hash_state(automatic.world_2d.space), "hash after 90 steps in one tick")
	check_below(bodies_of(by_hand)[0].linear_velocity.y, 200.0, "speed of a body that fell into the water")
	check_above(bodies_of(by_hand)[4].linear_velocity.x, 100.0, "speed of a body that the wind has caught")
	check_near(bodies_of(by_hand)[5].linear_velocity.y, GRAVITY * 1.5, 40.0, "speed of a body that no fluid sees")

	restore(by_hand, state)
	var expected := course(by_hand, 120)
	for i in 2:
		await ticks(3 * i)
		restore(by_hand, state)
		check(course(by_hand, 120) == expected, "the course differs when it is repeated")
		restore(by_hand, state)
		step(by_hand, 120, true)
		check(course(by_hand, 1)[0] != expected[0], "a replay moves nothing")
	# A replay in which the wind has another strength goes another way; with the old one it is what it was.
	winds[1].flow = Vector2(-900, 0)
	restore(by_hand, state)
	check(course(by_hand, 120) != expected, "the course is that of the wind before")
	winds[1].flow = Vector2(900, 0)
	restore(by_hand, state)
	check(course(by_hand, 120) == expected, "the course differs with the wind that there was")
	# A fluid that is paused, freed or blind pushes nothing.
	winds[1].process_mode = Node.PROCESS_MODE_DISABLED
	restore(by_hand, state)
	var still := course(by_hand, 120)
	check(still != expected, "a fluid that is switched off pushes")
	winds[1].process_mode = Node.PROCESS_MODE_INHERIT
	winds[1].monitoring = false
	restore(by_hand, state)
	check(course(by_hand, 120) == still, "a fluid that monitors nothing is another than none")
	winds[1].free()
	restore(by_hand, state)
	check(course(by_hand, 120) == still, "a fluid that was freed is another than none")


## A ball flies at a wall, or is turned away before; the state leads back to before that.
func test_a_replay_tells_nothing_and_the_next_step_tells_what_has_changed() -> void:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	var wall := add_solid(rectangle(40, 400), Transform2D(0, Vector2(150, 0)), world)
	var ball := add_to(world, Vector2.ZERO, {"gravity_scale": 0.0, "contact_monitor": true, "linear_velocity": Vector2(600, 0), "can_sleep": false})
	var told: Array[String] = []
	ball.body_entered.connect(func(_other: Node) -> void: told.append("in"))
	ball.body_exited.connect(func(_other: Node) -> void: told.append("out"))
	await ticks(2)
	step(world, 3)
	var start := save(world)
	while told.is_empty():
		step(world)
	var touching := save(world)
	check_equal(ball.get_colliding_bodies(), [wall] as Array[Node2D], "what it touches")
	restore(world, start)
	check_equal(ball.get_colliding_bodies().size(), 0, "what it touches after the state")
	step(world, 20, true)
	check_equal(told, ["in"] as Array[String], "signals of a replay")
	told.clear()
	restore(world, touching)
	step(world, 1, true)
	step(world)
	check_equal(told, [] as Array[String], "signals of a touch that was told before")
	restore(world, start)
	ball.linear_velocity = Vector2(-600, 0)
	step(world, 5, true)
	check_equal(told, [] as Array[String], "signals of a replay of another past")
	step(world)
	check_equal(told, ["out"] as Array[String], "signals of the first step after it: it never touched the wall")
	told.clear()
	restore(world, start)
	for i in 100:
		if told.is_empty():
			step(world)
	check_equal(told, ["in"] as Array[String], "signals of a replay that is to be told")


func test_falling_asleep_is_told_again_by_a_replay_with_signals_only() -> void:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	add_floor(60, world)
	var body := add_to(world, Vector2.ZERO)
	var told: Array[bool] = []
	body.sleeping_state_changed.connect(func() -> void: told.append(body.sleeping))
	await ticks(2)
	var state: PackedByteArray
	for i in 40:
		if told.is_empty():
			state = save(world)
			step(world, 30)
	check_equal(told, [true] as Array[bool], "signals until it sleeps")
	restore(world, state)
	check(not body.sleeping, "it sleeps when the state is put back")
	step(world, 30, true)
	check(body.sleeping, "it is awake after the replay")
	step(world)
	check_equal(told, [true] as Array[bool], "signals after a replay without")
	restore(world, state)
	step(world, 30)
	check_equal(told, [true, true] as Array[bool], "signals after a replay with")


func test_a_replay_pushes_nothing_of_the_engine() -> void:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	var crate := RigidBody2D.new()
	crate.gravity_scale = 0
	crate.linear_damp_mode = RigidBody2D.DAMP_MODE_REPLACE
	var shape := CollisionShape2D.new()
	shape.shape = rectangle(80, 80)
	crate.add_child(shape)
	crate.position = Vector2(100, 0)
	world.add_child(crate)
	var ball := add_to(world, Vector2.ZERO, {"gravity_scale": 0.0, "linear_velocity": Vector2(300, 0)})
	await ticks(2)
	step(world, 6, true)
	await ticks(2)
	check_near(crate.linear_velocity, Vector2.ZERO, 1e-3, "velocity of the crate after a replay")
	ball.linear_velocity = Vector2(300, 0)
	step(world)
	await ticks(2)
	check_above(crate.linear_velocity.x, 1.0, "velocity of the crate after a step")


func test_a_state_on_top_of_another_is_small() -> void:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	for i in 12:
		add_to(world, Vector2(150 * i, 0), {"sleeping": true})
	await ticks(2)
	step(world, 3)
	var base := save(world)
	bodies_of(world)[4].linear_velocity = Vector2(0, 100)
	step(world)
	var whole := save(world)
	var part := save(world, base)
	check_below(part.size(), whole.size() / 4.0, "bytes on top of the state before")
	step(world, 10)
	check_equal(restore(world, part, base), OK, "putting it back")
	check_equal(save(world), whole, "the whole state")
	check_refused(func() -> void: restore(world, part), ["restore_state refused", "base = none"], "a state without its base")
	check_refused(func() -> void: save(world, part), ["save_state", "base"], "a base with a base")
	check_equal(save(world), whole, "the whole state after refusals")


func test_what_cannot_be_put_back_is_refused_by_name_and_changes_nothing() -> void:
	var world := add_scene()
	var bodies := bodies_of(world)
	bodies[1].name = "Middle"
	await ticks(2)
	step(world, 10)
	var state := save(world)
	step(world, 10)
	var before := save(world)
	var damaged := state.duplicate()
	damaged[200] ^= 4
	var space := world.world_2d.space
	check_refused(func() -> void: restore(world, damaged), ["restore_state refused", "state.checksum", "goes on as it was"], "damaged bytes")
	check_refused(func() -> void: restore(world, bodies[0].get_state()), ["state.magic", "SB2W"], "the state of a body")
	check_refused(func() -> void: restore(world, PackedByteArray()), ["state.magic", "0 bytes"], "no bytes")
	check_equal(save(world), before, "the world after damaged states")
	check_refused(func() -> void: SoftBodySimulation2D.step(space, 0), ["step", "delta = 0", "above 0 s"], "no time")
	check_refused(func() -> void: SoftBodySimulation2D.step(space, NAN), ["delta = nan", "finite"], "no number")
	check_refused(func() -> void: SoftBodySimulation2D.step(RID(), DELTA), ["step", "World2D"], "no space")
	check_refused(func() -> void: SoftBodySimulation2D.save_state(RID()), ["save_state", "World2D"], "no space to save")
	check_refused(func() -> void: SoftBodySimulation2D.set_automatic_stepping(RID(), false), ["set_automatic_stepping", "World2D"], "no space to step")
	var empty := add_world()
	check_refused(func() -> void: save(empty), ["save_state", "no soft body"], "a world without bodies")
	check_refused(func() -> void: restore(empty, state), ["restore_state", "no soft body"], "a world without bodies")
	check_equal(SoftBodySimulation2D.step(empty.world_2d.space, DELTA), OK, "a step of a world without bodies")
	check_equal(save(world), before, "the world after bad calls")
	var late := add_to(world, Vector2(900, 0))
	check_refused(func() -> void: restore(world, state), ["state.bodies = 5", "6", "remove first"], "a world with one body more")
	late.free()
	check_equal(restore(world, state), OK, "a world without that body")
	check_equal(save(world), state, "its state")
	late = add_to(world, Vector2(900, 0))
	check_equal(late.get_rid().is_valid(), true, "a body that comes again")
	late.free()
	bodies[1].polygon = SoftBody2D.make_box_polygon(Vector2(80, 80), 20)
	check_refused(func() -> void: restore(world, state), ["state."], "a body of another outline")
	step(world, 2)


func test_a_body_that_was_cut_gets_its_own_state_first() -> void:
	var world := add_world()
	SoftBodySimulation2D.set_automatic_stepping(world.world_2d.space, false)
	add_floor(200, world)
	var body := add_to(world, Vector2.ZERO, {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	body.name = "Whole"
	add_to(world, Vector2(200, 0))
	await ticks(2)
	step(world, 5)
	var own := body.get_state()
	var state := save(world)
	var expected := course(world, 40)
	restore(world, state)
	var pieces := body.cut(Vector2(-200, body.position.y), Vector2(200, body.position.y + 5))
	check_equal(pieces.size(), 2, "pieces")
	check_refused(func() -> void: restore(world, state), ["state.bodies = 2", "remove first"], "a world with a piece more")
	pieces[1].free()
	check_refused(func() -> void: restore(world, state), ["Whole", "structure", "restore its own state first"], "a piece")
	check_equal(body.set_state(own), OK, "its own state")
	check_equal(restore(world, state), OK, "the state of the world")
	check(course(world, 40) == expected, "the course differs")


func test_sleepers_of_another_world_sleep_on_and_joints_break_there_too() -> void:
	var here := add_scene()
	var there := add_scene()
	await ticks(2)
	step(here, 600)
	step(there, 5)
	check(bodies_of(here)[0].sleeping, "it is awake")
	check_equal(restore(there, save(here)), OK, "the state of a world built alike")
	check_equal(SoftBodySimulation2D.hash_state(there.world_2d.space), SoftBodySimulation2D.hash_state(here.world_2d.space), "hash")
	for i in 100:
		step(here)
		step(there)
		check_equal(SoftBodySimulation2D.hash_state(there.world_2d.space), SoftBodySimulation2D.hash_state(here.world_2d.space), "hash %d steps later" % i)
	check(bodies_of(there)[0].sleeping, "it has woken")
	var joints := there.find_children("*", "SoftBodyJoint2D", true, false)
	check((joints[0] as SoftBodyJoint2D).is_broken(), "the joint is whole there")
	check(not (joints[1] as SoftBodyJoint2D).is_broken(), "the other joint is broken there")


## The peers of the example, and a third world that plays what they have chosen and never goes back.
func test_two_peers_agree_with_the_truth_over_any_network() -> void:
	var scene: Node = (load(EXAMPLE) as PackedScene).instantiate()
	scene.set_physics_process(false)
	stage.add_child(scene)
	var truth := add_world()
	SoftBodySimulation2D.set_automatic_stepping(truth.world_2d.space, false)
	var players: Array[SoftBody2D] = scene.make_arena(truth)
	var start := save(truth)
	await ticks(2)
	var rollbacks := 0
	var deepest := 0
	for round_number in 24:
		var what := "seed %d: " % round_number
		scene.loss = 0.15 * (round_number % 5)
		scene.most_delay = 1 + round_number % 9
		scene.begin(round_number)
		for i in 150:
			scene.advance()
		var peers: Array = scene.peers
		check_equal(scene.mismatches, 0, what + "mismatches")
		check_above(scene.agreed, 40, what + "ticks in which both agree")
		check_equal(restore(truth, start), OK, what + "the beginning")
		for i: int in scene.agreed:
			for player in 2:
				peers[0].push(players[player], peers[player].own[i])
			step(truth)
			if not check_equal(peers[1].hashes[i], SoftBodySimulation2D.hash_state(truth.world_2d.space), what + "hash of tick %d" % i):
				break
		rollbacks += peers[0].rollbacks + peers[1].rollbacks
		deepest = maxi(deepest, maxi(peers[0].deepest, peers[1].deepest))
	check_above(rollbacks, 200, "rollbacks")
	check_equal(deepest, 8, "ticks of the deepest rollback")
