# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Wrong uses that will happen all the same: the scene goes on, and a message names the mistake.

const MANY := 10000

## Where a number that is one larger, or the other boolean, is no value to try.
var other_values := {
	"polygon": SoftBody2D.make_box_polygon(Vector2(120, 70), 25), "inner_points": PackedVector2Array([Vector2(10, 5), Vector2(-20, 0)]),
	"springs": PackedInt32Array([0, 1, 1, 2, 2, 3, 0, 8, 16, 5]), "spring_stiffness_scales": _scales(2), "spring_damping_scales": _scales(3),
	"spring_length_scales": _scales(0.9), "pinned_points": PackedInt32Array([0, 3]), "pin_targets": [^".."] as Array[NodePath], "dents": _dents(),
	"poisson_ratio": 0.25, "mass_mode": SoftBody2D.MASS_MODE_CUSTOM, "vertex_colors": PackedColorArray([Color.RED]), "uv": PackedVector2Array([Vector2.ONE]), "texture": PlaceholderTexture2D.new(),
	"outline_texture": PlaceholderTexture2D.new(), "cut_texture": PlaceholderTexture2D.new(), "cut_edges": PackedInt32Array([1, 4]), "soft_body_material": SoftBodyMaterial2D.new(), "material": CanvasItemMaterial.new(),
	"holes": [SoftBody2D.make_circle_polygon(12, 9)] as Array[PackedVector2Array], "detail_weights": PackedFloat32Array([2, 3]),
	"integrator": SoftBody2D.INTEGRATOR_XPBD, "physics_material_override": PhysicsMaterial.new(),
}

static func _dents() -> PackedVector2Array:
	var dents := PackedVector2Array()
	dents.resize(17)
	dents[3] = Vector2(-4, 2)
	return dents


## Bodies whose script does something while the step moves them along.
class Moved extends SoftBody2D:
	var action := Callable()

	func _notification(what: int) -> void:
		if what == NOTIFICATION_LOCAL_TRANSFORM_CHANGED and action.is_valid():
			var now := action
			action = Callable()
			now.call()


static func _scales(value: float) -> PackedFloat32Array:
	var scales := PackedFloat32Array()
	scales.resize(32)
	scales.fill(value)
	return scales


func time_limit() -> int:
	return 8000


func _check_sound(body: SoftBody2D, what: String) -> void:
	check(all_finite(body.get_point_positions()), "%s has a point that is not finite" % what)


## What is stored of a body and can be set by anybody: name and another value than its own.
func _changes() -> Dictionary:
	var changes := {}
	var body := SoftBody2D.new()
	body.stiffness = body.stiffness # or a network's raw values are not stored
	body.mass = body.mass # or it follows from the area and is not stored
	for property in body.get_property_list():
		var name: String = property["name"]
		if not property["usage"] & PROPERTY_USAGE_STORAGE or name in ["script", "unique_name_in_owner"]:
			continue
		var value: Variant = body.get(name)
		if other_values.has(name):
			changes[name] = other_values[name]
			continue
		match typeof(value):
			TYPE_BOOL:
				changes[name] = not value
			TYPE_INT:
				changes[name] = value - 1 if name == "self_collision" else value + 1 # automatic is the last of its values
			TYPE_FLOAT:
				changes[name] = value + 0.125
			TYPE_VECTOR2:
				changes[name] = value + Vector2(0.5, -0.25)
			TYPE_COLOR:
				changes[name] = Color(0.2, 0.4, 0.6, 0.8)
			TYPE_STRING:
				changes[name] = "another"
			_:
				check(false, "there is no other value to try for " + name)
	body.free()
	return changes


## Calls `action` with the body and its signal's name when that happens to one of them; `mid_step` is no signal, but what
## the body's script is told while the step moves the body.
func _on_occasion(occasion: String, body: SoftBody2D, action: Callable) -> void:
	match occasion:
		"mid_step":
			body.set_notify_local_transform(true)
			(body as Moved).action = action
		"body_entered", "body_exited":
			body.connect(occasion, func(_other: Node) -> void: action.call(), CONNECT_ONE_SHOT)
		"contact_started":
			body.contact_started.connect(func(_o: Node, _a: Vector2, _n: Vector2, _i: float) -> void: action.call(), CONNECT_ONE_SHOT)
		"sleeping_state_changed":
			body.sleeping_state_changed.connect(action, CONNECT_ONE_SHOT)


const OCCASIONS: Array[String] = ["mid_step", "body_entered", "contact_started", "sleeping_state_changed", "body_exited"]


## Each of the bodies lands on a floor, sleeps, wakes, and leaves the floor again.
func _live(bodies: Array) -> void:
	await ticks(20)
	for what: String in ["sleep", "jump"]:
		for body: Variant in bodies:
			if is_instance_valid(body) and body.is_inside_tree():
				if what == "sleep":
					body.sleeping = true
				else:
					body.apply_central_impulse(Vector2(0, -800 * body.mass))
		await ticks(20)


func test_any_property_may_be_set_in_any_signal_and_in_mid_step() -> void:
	var changes := _changes()
	for property in ClassDB.class_get_property_list(&"SoftBody2D", true):
		if property["usage"] & PROPERTY_USAGE_STORAGE:
			check(changes.has(property["name"]), "%s is not tried" % property["name"])
	check_above(changes.size(), 70, "properties tried")
	var bodies := []
	var done := {}
	for row in OCCASIONS.size():
		add_solid(rectangle(250.0 * changes.size() + 500, 100), Transform2D(0, Vector2(125.0 * changes.size(), 150 + 1500 * row)))
		for property: String in changes:
			var body := Moved.new()
			body.position = Vector2(250 * (bodies.size() % changes.size()), 40 + 1500 * row)
			body.contact_monitor = true
			stage.add_child(body)
			var key := "%s in %s" % [property, OCCASIONS[row]]
			_on_occasion(OCCASIONS[row], body, func() -> void:
				var before: Variant = body.get(property)
				var value: Variant = changes[property]
				body.set(property, (not before) if value is bool else value)
				done[key] = body.get(property) != before)
			bodies.append(body)
	await _live(bodies)
	for row in OCCASIONS.size():
		for property: String in changes:
			var key := "%s in %s" % [property, OCCASIONS[row]]
			check(done.get(key, false), key + (" was not set" if done.has(key) else " was not reached"))
	for body: SoftBody2D in bodies:
		_check_sound(body, str(body.position))


func test_a_body_may_leave_in_its_own_signals_and_in_mid_step() -> void:
	if not is_debug_build():
		return
	for way: String in ["queue_free", "remove_child", "reparent", "change_world", "free"]:
		add_floor(100)
		var left := []
		var viewport := SubViewport.new()
		viewport.world_2d = World2D.new()
		stage.add_child(viewport)
		take_errors()
		for occasion in OCCASIONS:
			if way == "free" and occasion == "mid_step":
				continue # the engine's own nodes do not survive that either
			var body := Moved.new()
			body.position = Vector2(300 * left.size() - 600, 40)
			body.contact_monitor = true
			stage.add_child(body)
			var leave := func() -> void:
				match way:
					"queue_free":
						body.queue_free()
					"remove_child":
						stage.remove_child(body)
					"reparent":
						body.reparent(tree.root)
					"change_world":
						body.reparent(viewport)
					"free":
						body.free()
			_on_occasion(occasion, body, leave)
			left.append(body)
		await _live(left)
		var errors := take_errors()
		if way == "free":
			# As with any node that is freed in a signal of its own.
			check(errors.size() >= left.size(), "one message each at least: %s" % errors)
			check(errors.is_empty() or "locked" in errors[0], "the engine says why: %s" % errors)
		else:
			check_equal(errors, PackedStringArray(), "messages of " + way)
		for i in left.size():
			check(way != "queue_free" or not is_instance_valid(left[i]), "a body freed in %s is there" % OCCASIONS[i])
			if is_instance_valid(left[i]):
				check((left[i].get_parent() == stage) == (way == "free"), "where it is after %s in %s" % [way, OCCASIONS[i]])
				left[i].free()
		viewport.free()
		for child in stage.get_children():
			child.free()


func test_a_joint_may_leave_when_it_breaks_and_take_its_bodies_along() -> void:
	var ends: Array[SoftBody2D] = [add_body(Vector2(0, 0), {"freeze": true}), add_body(Vector2(0, 200), {"mass": 50.0})]
	var joint := SoftBodyJoint2D.new()
	joint.position = Vector2(0, 100)
	joint.break_force = 100
	stage.add_child(joint)
	joint.node_a = joint.get_path_to(ends[0])
	joint.node_b = joint.get_path_to(ends[1])
	joint.broken.connect(func() -> void:
		joint.queue_free()
		ends[0].free()
		stage.remove_child(ends[1]))
	await ticks(60)
	check(not is_instance_valid(joint), "the joint has left")
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies left")
	ends[1].free()


func test_ten_thousand_bodies_come_and_go_in_one_frame() -> void:
	var memory := PackedInt64Array()
	for round in 3:
		var holder := Node2D.new()
		for i in MANY:
			var body := SoftBody2D.new()
			body.position = Vector2(150 * (i % 100), 150 * floorf(i / 100.0))
			holder.add_child(body)
		stage.add_child(holder)
		check_equal(SoftBodySimulation2D.get_body_count(), MANY, "bodies")
		if round > 0:
			await ticks(1)
		holder.free()
		check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies left")
		await ticks(2)
		memory.append(OS.get_static_memory_usage())
	# What the first rounds made is used again: lists that have grown once, pools of the engine.
	check_below(memory[2] - memory[1], 2e6, "memory that a round of bodies leaves behind in bytes")


func test_scenes_change_while_bodies_move() -> void:
	for i in 40:
		var scene := Node2D.new()
		for j in 30:
			var body := SoftBody2D.new()
			body.position = Vector2(90 * (j % 10), -90 * floorf(j / 10.0))
			body.contact_monitor = true
			scene.add_child(body)
		add_floor(80, scene)
		stage.add_child(scene)
		await ticks(1 + i % 4)
		if i % 2 == 0:
			scene.free()
		else:
			scene.queue_free()
	await ticks(2)
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies left")


## A scene of that many bodies over a floor.
static func _pack_scene(count: int) -> PackedScene:
	var root := Node2D.new()
	for i in count:
		var body := SoftBody2D.new()
		body.position = Vector2(90 * (i % 10), -95 * floorf(i / 10.0))
		body.polygon = SoftBody2D.make_circle_polygon(40, 12 + i % 5)
		body.contact_monitor = true
		root.add_child(body)
		body.owner = root
	var packed := PackedScene.new()
	packed.pack(root)
	root.free()
	return packed


# While the simulation's threads step the bodies of one scene, two threads of a game build others; the scene is changed from
# `_physics_process`, from a signal of a body, and from a thread by way of a deferred call.
func test_scenes_change_while_threads_run() -> void:
	const SETTING := "physics/soft_body_2d/solver/threads"
	ProjectSettings.set_setting(SETTING, 4)
	await ticks(1)
	var path := "user://changed.tscn"
	ResourceSaver.save(_pack_scene(40), path)
	var built: Array[int] = [0, 0]
	var go_on: Array[bool] = [true]
	var threads: Array[Thread] = []
	for i in 2:
		threads.append(Thread.new())
		threads[i].start(func() -> void:
			while go_on[0]:
				var scene := _pack_scene(15).instantiate()
				for body: SoftBody2D in scene.get_children():
					if body.polygon.size() < 12 or body.get_point_count() != body.polygon.size() + 1:
						go_on[0] = false
				scene.free()
				built[i] += 1)
	var changes: Array[int] = [0]
	for round in 12:
		ResourceLoader.load_threaded_request(path, "PackedScene", true, ResourceLoader.CACHE_MODE_IGNORE)
		var scene: PackedScene = ResourceLoader.load_threaded_get(path)
		var change := func() -> void:
			changes[0] += int(tree.change_scene_to_packed(scene) == OK)
		match round % 3:
			0:
				change.call()
			1:
				var body := add_body(Vector2(5000, 40), {"contact_monitor": true})
				add_solid(rectangle(400, 100), Transform2D(0, Vector2(5000, 150)))
				body.body_entered.connect(func(_other: Node) -> void: change.call(), CONNECT_ONE_SHOT)
			2:
				var thread := Thread.new()
				thread.start(func() -> void: change.call_deferred())
				thread.wait_to_finish()
		await ticks(20)
		check_equal(SoftBodySimulation2D.get_body_count(), 40 + stage.find_children("*", "SoftBody2D", true, false).size(),
				"bodies after change %d" % round)
	check(go_on[0], "what a thread built was whole")
	go_on[0] = false
	for thread in threads:
		thread.wait_to_finish()
	check(mini(built[0], built[1]) > 0, "threads built scenes meanwhile: %s" % [built])
	check_equal(changes[0], 12, "changes of scene")
	if OS.get_processor_count() > 1:
		check_above(SoftBodySimulation2D.get_thread_count(), 1, "threads of the simulation")
	tree.unload_current_scene()
	DirAccess.remove_absolute(path)
	ProjectSettings.set_setting(SETTING, 0)
	await ticks(2)


func test_a_game_that_runs_is_not_reloaded_and_says_so() -> void:
	add_floor(100)
	var body := add_body()
	await ticks(5)
	check_refused(func() -> void:
			check(GDExtensionManager.reload_extension("res://addons/soft_body_2d/soft_body_2d.gdextension") != GDExtensionManager.LOAD_STATUS_OK, "the game was reloaded"),
			["reload"], "reloading the extension in a game")
	var before := body.position
	await ticks(5)
	check(body.position.y > before.y, "the body goes on falling")


func test_a_body_that_fails_is_named_and_reset_or_frozen_and_no_other_moves_differently() -> void:
	for mode: int in [SoftBody2D.FAILURE_MODE_RESET, SoftBody2D.FAILURE_MODE_FREEZE]:
		var ways: Array[PackedVector2Array] = []
		for fails: bool in [false, true]:
			add_floor(100)
			var failing := add_body(Vector2(-400, 0), { "failure_mode": mode, "name": "Doomed" })
			var other := add_body(Vector2(100, 0))
			var told: Array[bool] = []
			failing.failed.connect(func() -> void: told.append(failing.freeze))
			await ticks(10)
			take_errors()
			if fails:
				failing.set_point_velocity(3, Vector2(1e30, 0))
			await ticks(1)
			var errors := take_errors()
			ways.append(other.get_point_positions())
			var expected: Array[bool] = []
			if fails:
				expected.append(mode == SoftBody2D.FAILURE_MODE_FREEZE)
			check_equal(told, expected, "signals, and whether the body was frozen when they came")
			if fails:
				check_equal(errors.size(), 1, "number of messages")
				check("Doomed" in errors[0], "the message names the body: %s" % errors)
				check(("frozen" in errors[0]) == (mode == SoftBody2D.FAILURE_MODE_FREEZE), "the message tells what became of it")
				check_equal(failing.freeze, mode == SoftBody2D.FAILURE_MODE_FREEZE, "frozen")
				_check_sound(failing, "the body that failed")
				check_near(failing.get_area(), failing.get_rest_area(), 1, "area of the body that failed")
				var before := failing.global_position
				await ticks(20)
				check_equal(failing.global_position == before, failing.freeze, "whether the body stays where it failed")
			for child in stage.get_children():
				child.free()
			await ticks(1)
		check(ways[0] == ways[1], "another body moves in the same bits beside one that fails")


## One error a second, with a count, whatever fails in each tick.
func test_a_body_that_fails_in_every_tick_says_so_once_a_second() -> void:
	var body := add_weightless_body()
	var failures := [0]
	body.failed.connect(func() -> void: failures[0] += 1)
	await ticks(2)
	take_errors()
	for i in 150:
		body.set_point_velocity(0, Vector2(1e37, -1e37))
		await ticks(1)
	check_above(failures[0], 100, "failures")
	var errors := take_errors()
	check(errors.size() >= 2 and errors.size() <= 4, "%d errors in two and a half seconds" % errors.size())
	check("times since" in errors[1], "the second error has no count: %s" % errors[1])


func test_a_damping_beyond_the_range_of_numbers_is_refused_by_name() -> void:
	var body := add_weightless_body()
	for property: String in ["linear_damp", "angular_damp"]:
		body.set(property, 3.0)
		check_refused(func() -> void: body.set(property, 1e300), [property, "1e"], "a huge " + property)
		check_equal(body.get(property), 3.0, property)
	await ticks(3)
