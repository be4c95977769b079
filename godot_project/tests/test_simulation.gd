# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What holds for all soft bodies: project settings, threads, monitors, and nodes that come and go during a step.

const THREADS := "physics/soft_body_2d/solver/threads"
const CONTACT_SUBSTEPS := "physics/soft_body_2d/solver/contact_substeps"
const SUBSTEPS := "physics/soft_body_2d/solver/default_substeps"
const SLEEP := "physics/soft_body_2d/sleep/enabled"
const BUDGET := "physics/soft_body_2d/solver/budget_ms"
const DEFAULTS := { THREADS: 0, CONTACT_SUBSTEPS: 4, SUBSTEPS: 0, SLEEP: true, BUDGET: 0.0 }


func tear_down() -> void:
	for setting: String in DEFAULTS:
		ProjectSettings.set_setting(setting, DEFAULTS[setting])
	await super()


func test_project_settings_are_registered_with_defaults_and_hints() -> void:
	var expected := { THREADS: "0,64,1", CONTACT_SUBSTEPS: "1,64,1", SUBSTEPS: "0,64,1", SLEEP: "", BUDGET: "0,16,0.1,or_greater,suffix:ms" }
	var found := {}
	for property in ProjectSettings.get_property_list():
		if expected.has(property.name):
			found[property.name] = property.hint_string
	check_equal(found, expected, "hints of the settings")
	for setting: String in DEFAULTS:
		check_equal(ProjectSettings.get_setting(setting), DEFAULTS[setting], setting)
		check_equal(ProjectSettings.property_get_revert(setting), DEFAULTS[setting], "initial value of " + setting)


func test_a_setting_out_of_range_is_refused_and_its_default_holds() -> void:
	await change(THREADS, 1)
	add_pile(1) # the simulation reads settings once it has a body
	check_refused(func() -> void:
		ProjectSettings.set_setting(THREADS, -3)
		ProjectSettings.settings_changed.emit()
		ProjectSettings.set_setting(THREADS, 0),
		["physics/soft_body_2d/solver/threads", "-3", "0", "64"], "minus three threads")


func test_the_number_of_threads_follows_the_setting() -> void:
	add_pile(1)
	await change(THREADS, 1)
	check_equal(SoftBodySimulation2D.get_thread_count(), 1, "threads")
	await change(THREADS, 2)
	check_equal(SoftBodySimulation2D.get_thread_count(), mini(2, OS.get_processor_count()), "threads")


## Bits, not tolerances: a replay must not depend on the machine it runs on.
func test_any_number_of_threads_gives_the_same_motion() -> void:
	var results: Array[PackedVector2Array] = []
	for threads in [1, 2, 5]:
		await change(THREADS, threads)
		var pile := add_pile(80)
		await ticks(40)
		var points := PackedVector2Array()
		for body in pile:
			points.append_array(body.get_point_positions())
		results.append(points)
		for body in pile:
			body.free()
		await ticks(1)
	check_above(results[0].size(), 80 * 8, "number of points")
	check(results[0] == results[1], "two threads move bodies like one")
	check(results[0] == results[2], "five threads move bodies like one")


## Each substep solves its contacts again.
func test_contact_substeps_follow_the_setting() -> void:
	var counts := PackedFloat64Array()
	for substeps: int in [1, 8]:
		await change(CONTACT_SUBSTEPS, substeps)
		var pile := add_pile(30)
		var answered := 0
		for i in 60:
			await ticks(1)
			answered += SoftBodySimulation2D.get_contact_count()
		counts.append(answered)
		for body in pile:
			body.free()
		await ticks(1)
	check_above(counts[1], 1.5 * counts[0], "contacts answered in eight substeps, against one")


func test_bodies_that_leave_their_substeps_open_take_the_project_s() -> void:
	var open := add_weightless_body(Vector2.ZERO, {"elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK})
	var own := add_weightless_body(Vector2(300, 0), {"substeps": 3})
	await change(SUBSTEPS, 7)
	check_equal(open.get_substep_plan()["substeps"], 7, "substeps of a body that leaves them open")
	check_equal(own.get_substep_plan()["substeps"], 3, "substeps of a body with its own")
	await change(SUBSTEPS, 0)
	check_equal(open.get_substep_plan()["reason"], "contacts", "reason of the automatic choice")


func test_sleep_can_be_switched_off_for_a_project() -> void:
	add_floor(0)
	var body := add_body(Vector2(0, -60))
	await ticks(240)
	check_equal(SoftBodySimulation2D.get_awake_body_count(), 0, "bodies awake after four seconds on the floor")
	await change(SLEEP, false)
	await ticks(2)
	check_equal(SoftBodySimulation2D.get_awake_body_count(), 1, "bodies awake without sleep")
	body.free()


func test_the_debugger_has_monitors() -> void:
	add_floor(0)
	add_body(Vector2(0, -60))
	await ticks(60)
	check_equal(Performance.get_custom_monitor("SoftBody2D/Awake Bodies"), SoftBodySimulation2D.get_awake_body_count(), "monitor of bodies awake")
	check_equal(Performance.get_custom_monitor("SoftBody2D/Contacts"), SoftBodySimulation2D.get_contact_count(), "monitor of contacts")
	check_equal(Performance.get_custom_monitor("SoftBody2D/Step (usec)"), SoftBodySimulation2D.get_last_step_usec(), "monitor of the step's time")
	check_above(Performance.get_custom_monitor("SoftBody2D/Contacts"), 0, "contacts of a body on the floor")


func test_the_parts_of_the_profile_lie_within_the_step() -> void:
	add_pile(20)
	SoftBodySimulation2D.reset_statistics()
	await ticks(10)
	var profile := SoftBodySimulation2D.get_step_profile()
	check_equal(profile.keys(), ["nodes", "prepare", "surroundings", "simulate", "finish", "proxies"], "parts of the profile")
	var sum := 0.0
	check_equal(profile.nodes, 20.0, "nodes gone through, all of which fall")
	profile.erase("nodes")
	for part: String in profile:
		check(profile[part] >= 0, part + " is a time")
		sum += profile[part]
	# One clock is read at the ends of the parts and of the step, which they follow one another in, so no load of the
	# machine can make them longer than the whole.
	check_above(sum, 0, "sum of the parts")
	check(sum <= SoftBodySimulation2D.get_mean_step_usec() + 1e-6, "the parts are no longer than the step")


func test_islands_tell_their_bodies_substeps_and_contact_error() -> void:
	add_floor(0)
	var heap: Array[SoftBody2D] = []
	for i in 4:
		heap.append(add_body(Vector2(0, -50 - 97 * i), {"can_sleep": false}))
	var stiff := add_body(Vector2(600, -50), {"can_sleep": false, "youngs_modulus": 100 * heap[0].youngs_modulus})
	await ticks(2)
	check_equal(SoftBodySimulation2D.get_islands(), [], "islands that nobody asked for")
	check(not SoftBodySimulation2D.is_reporting_islands(), "islands are measured without being asked for")
	SoftBodySimulation2D.set_reporting_islands(true)
	var overlap := 0.0
	for _tick in 15:
		await ticks(1)
		var islands := SoftBodySimulation2D.get_islands()
		var bodies := 0
		for island in islands:
			bodies += island.bodies
			overlap = maxf(overlap, island.overlap)
			check(island.first == stiff or island.first in heap, "first body of an island")
			check(island.deepest == stiff or island.deepest in heap, "deepest body of an island")
			check_below(island.penetration, 1, "penetration left in the floor")
		check_equal(bodies, 5, "bodies of all islands")
	var islands := SoftBodySimulation2D.get_islands()
	check_equal(islands.size(), 2, "islands once the heap has come together")
	check_equal(islands[0].first, heap[0], "first body of the heap")
	check_equal(islands[0].bodies, 4, "bodies of the heap")
	check_equal(islands[1].first, stiff, "the body apart")
	check_above(islands[1].contact_substeps, islands[0].contact_substeps, "contact substeps of the stiff one")
	check_below(overlap, 2, "overlap of the heap")
	check_above(overlap, 0, "overlap of the heap")
	heap[0].free()
	check_equal(SoftBodySimulation2D.get_islands()[0].first, null, "first body that is gone")
	SoftBodySimulation2D.set_reporting_islands(false)
	check_equal(SoftBodySimulation2D.get_islands(), [], "islands once nobody asks for them")


## A node that is moved along runs code of the user at once, if it asked for it.
func test_bodies_may_be_freed_and_added_while_a_step_moves_nodes() -> void:
	var bodies := add_pile(12)
	var fuse := Fuse.new()
	fuse.position = Vector2(-200, -60)
	stage.add_child(fuse)
	bodies.append_array(add_pile(2)) # behind the fuse in the order of the step
	fuse.victims = [bodies[1], bodies[7], bodies[13]]
	fuse.armed = true
	await ticks(2)
	if not check(fuse.added != null, "the fuse burnt"):
		return
	for i: int in [1, 7, 13]:
		check(not is_instance_valid(bodies[i]), "body %d is gone" % i)
	var before: float = fuse.added.position.y
	await ticks(10)
	check_above(fuse.added.position.y, before, "y of the body that was added during the step, after a while")
	check_equal(SoftBodySimulation2D.get_body_count(), 13, "bodies in the simulation")


func test_a_body_may_leave_the_tree_while_it_is_moved_and_be_the_last_of_its_space() -> void:
	var fuse := Fuse.new()
	stage.add_child(fuse)
	fuse.leaves = true
	fuse.armed = true
	await ticks(3)
	check(not fuse.is_inside_tree(), "the body has left")
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies in the simulation")
	fuse.free()


func test_ten_thousand_nodes_come_and_go() -> void:
	var polygon := SoftBody2D.make_circle_polygon(10, 8)
	var parent := Node2D.new()
	for i in 10000:
		var body := SoftBody2D.new()
		body.polygon = polygon
		body.collision_mask = 0
		body.position = Vector2(30 * (i % 100), 30.0 * (i / 100.0))
		parent.add_child(body)
	stage.add_child(parent)
	await ticks(1)
	check_equal(SoftBodySimulation2D.get_body_count(), 10000, "bodies in the simulation")
	parent.free()
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies in the simulation")
	await ticks(1)


# Sets a project setting; the engine tells about the change at the end of the frame.
func change(setting: String, value: Variant) -> void:
	ProjectSettings.set_setting(setting, value)
	await tree.process_frame
	await tree.process_frame


func add_pile(count: int) -> Array[SoftBody2D]:
	if stage.get_child_count() == 0:
		add_floor(0)
	var pile: Array[SoftBody2D] = []
	for i in count:
		var body := add_body(Vector2(95 * (i % 10) + 20 * ((i / 10) % 2), -60 - 95 * floorf(i / 10.0)))
		pile.append(body)
	return pile


# Frees its victims and adds a body, or leaves, when the step moves it.
class Fuse extends SoftBody2D:
	var victims: Array = []
	var added: SoftBody2D
	var leaves := false
	var armed := false

	func _init() -> void:
		set_notify_local_transform(true)

	func _notification(what: int) -> void:
		if what != NOTIFICATION_LOCAL_TRANSFORM_CHANGED or not armed:
			return
		armed = false
		for victim: SoftBody2D in victims:
			victim.free()
		if leaves:
			get_parent().remove_child(self)
			return
		added = SoftBody2D.new()
		added.position = position + Vector2(-200, 0)
		get_parent().add_child(added)


func test_frozen_and_paused_bodies_do_not_count_as_awake() -> void:
	var bodies: Array[SoftBody2D] = []
	for i in 4:
		bodies.append(add_weightless_body(Vector2(200 * i, 0), { "linear_velocity": Vector2(0, 5), "can_sleep": false }))
	await ticks(3)
	check_equal(SoftBodySimulation2D.get_awake_body_count(), 4, "awake bodies")
	bodies[0].freeze = true
	bodies[1].process_mode = Node.PROCESS_MODE_DISABLED
	await ticks(2)
	check_equal(SoftBodySimulation2D.get_awake_body_count(), 2, "awake bodies with one frozen and one paused")
