# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## What nobody should do, and somebody will: the scene goes on, and says what was wrong.

const MANY := 10000

## For every property that may be set while the game runs, another value than its default.
var other_values := {
	"stiffness": 160.0, "damping": 0.2, "shape_matching": 0.6, "shape_damping": 0.5, "pressure": 50.0, "inflation": 1.2,
	"mass": 2.0, "friction": 0.8, "bounce": 0.3, "rolling_resistance": 0.1, "gravity_scale": 1.5, "linear_damp": 0.5,
	"angular_damp": 0.5, "linear_damp_mode": SoftBody2D.DAMP_MODE_REPLACE, "angular_damp_mode": SoftBody2D.DAMP_MODE_REPLACE,
	"integrator": SoftBody2D.INTEGRATOR_XPBD, "substeps": 9, "center_point": false, "self_collision": true,
	"collision_layer": 3, "collision_mask": 3, "collision_proxy_enabled": false, "collision_proxy_margin": 2.0,
	"linear_velocity": Vector2(30, -40), "angular_velocity": 1.0, "constant_force": Vector2(1, 1), "constant_torque": 5.0,
	"contact_monitor": false, "max_contacts_reported": 2, "can_sleep": false, "sleeping": true, "freeze": true,
	"color": Color.RED, "outline_width": 3.0, "smooth": true, "antialiased": true, "position": Vector2(5, -80),
	"rotation": 0.5, "scale": Vector2(1.5, 1.5), "process_mode": Node.PROCESS_MODE_DISABLED, "visible": false,
	"simulate_off_screen": false, "failure_mode": SoftBody2D.FAILURE_MODE_FREEZE, "pinned_points": PackedInt32Array([0, 3]),
}


func time_limit() -> int:
	return 8000


func _check_sound(body: SoftBody2D, what: String) -> void:
	check(all_finite(body.get_point_positions()), "%s has a point that is not finite" % what)


func test_any_property_may_be_set_in_any_signal() -> void:
	var signals := ["body_entered", "contact_started", "sleeping_state_changed"]
	add_floor(100)
	for property: String in other_values:
		var bodies: Array[SoftBody2D] = []
		var before := []
		for i in signals.size():
			var body := add_body(Vector2(-400 + 400 * i, 40), { "contact_monitor": true })
			var set_it := func() -> void: body.set(property, other_values[property])
			match signals[i]:
				"body_entered":
					body.body_entered.connect(func(_other: Node) -> void: set_it.call())
				"contact_started":
					body.contact_started.connect(func(_other: Node, _at: Vector2, _normal: Vector2, _impulse: float) -> void: set_it.call())
				"sleeping_state_changed":
					body.sleeping_state_changed.connect(set_it)
			bodies.append(body)
			before.append(body.get(property))
		await ticks(20)
		bodies[2].sleeping = true
		bodies[2].apply_central_impulse(Vector2(0, -50))
		await ticks(20)
		for i in 2:
			check(bodies[i].get(property) != before[i], "%s was not set in %s" % [property, signals[i]])
		for body in bodies:
			_check_sound(body, "the body whose %s was set in a signal" % property)
			body.free()


func test_a_body_may_leave_in_its_own_signals() -> void:
	add_floor(100)
	for way: String in ["queue_free", "remove_child", "reparent", "change_world"]:
		var left: Array[SoftBody2D] = []
		var viewport := SubViewport.new()
		viewport.world_2d = World2D.new()
		stage.add_child(viewport)
		for name: String in ["body_entered", "contact_started"]:
			var body := add_body(Vector2(300 * left.size(), 40), { "contact_monitor": true })
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
			if name == "body_entered":
				body.body_entered.connect(func(_other: Node) -> void: leave.call(), CONNECT_ONE_SHOT)
			else:
				body.contact_started.connect(func(_o: Node, _a: Vector2, _n: Vector2, _i: float) -> void: leave.call(), CONNECT_ONE_SHOT)
			left.append(body)
		await ticks(30)
		for body: Variant in left:
			check(way != "queue_free" or not is_instance_valid(body), "a body freed in its own signal is there")
			if is_instance_valid(body):
				check(body.get_parent() != stage, "a body stayed where it was: " + way)
				body.free()
		viewport.free()


func test_ten_thousand_bodies_come_and_go_in_one_frame() -> void:
	var memory := PackedInt64Array()
	for round in 3:
		var holder := Node2D.new()
		for i in MANY:
			var body := SoftBody2D.new()
			body.position = Vector2(150 * (i % 100), 150 * floorf(i / 100.0))
			holder.add_child(body)
		stage.add_child(holder)
		check_equal(SoftBodyServer2D.get_body_count(), MANY, "bodies")
		if round > 0:
			await ticks(1)
		holder.free()
		check_equal(SoftBodyServer2D.get_body_count(), 0, "bodies left")
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
	check_equal(SoftBodyServer2D.get_body_count(), 0, "bodies left")


func _scene_of(lines: String) -> SoftBody2D:
	var path := "user://abused.tscn"
	var file := FileAccess.open(path, FileAccess.WRITE)
	file.store_string("[gd_scene format=3]\n\n[node name=\"Jelly\" type=\"SoftBody2D\"]\n" + lines + "\n")
	file.close()
	var scene := ResourceLoader.load(path, "PackedScene", ResourceLoader.CACHE_MODE_IGNORE) as PackedScene
	DirAccess.remove_absolute(path)
	return null if scene == null else scene.instantiate() as SoftBody2D


func test_a_scene_of_a_newer_version_opens_with_what_is_known() -> void:
	var body := _scene_of("stiffness = 77.0\nsome_future_property = Vector3(1, 2, 3)\nfriction = 0.25")
	if not check(body != null, "the scene opens"):
		return
	check_equal(body.stiffness, 77.0, "stiffness")
	check_equal(body.friction, 0.25, "friction")
	stage.add_child(body)
	await ticks(5)
	_check_sound(body, "the body of the newer scene")


func test_damaged_arrays_in_a_scene_are_named_and_the_rest_is_kept() -> void:
	var damages := {
		"hull = PackedVector2Array(0, 0, nan, 5, 10, 10, 0, 10)": "hull",
		"hull = PackedVector2Array(0, 0, 10, 0)": "hull",
		"hull = PackedVector2Array(0, 0, 10, 10, 10, 0, 0, 10)": "hull",
		"inner_points = PackedVector2Array(inf, 0)": "inner_points",
		"springs = PackedInt32Array(0, 1, 2)": "springs",
		"springs = PackedInt32Array(0, -1)": "springs",
		"spring_stiffness_scales = PackedFloat32Array(-1, 1)": "spring_stiffness_scales",
		"pinned_points = PackedInt32Array(-2)": "pinned_points",
		"stiffness = nan": "stiffness",
		"mass = -1.0": "mass",
	}
	for line: String in damages:
		take_errors()
		var body := _scene_of("color = Color(1, 0, 0, 1)\n" + line + "\nfriction = 0.25")
		if not check(body != null, "the scene with %s opens" % line):
			continue
		stage.add_child(body)
		await ticks(3)
		check_equal(body.friction, 0.25, "friction beside " + line)
		check_equal(body.hull.size(), 16, "hull points beside " + line)
		_check_sound(body, "the body with " + line)
		var errors := take_errors()
		check(not errors.is_empty() and damages[line] in errors[0], "the message for %s names it: %s" % [line, errors])
		body.free()


func test_arrays_that_name_what_is_not_there_are_left_out_with_a_word() -> void:
	var damages := ["springs = PackedInt32Array(0, 400)", "spring_stiffness_scales = PackedFloat32Array(1, 2)",
			"pinned_points = PackedInt32Array(99)", "uv = PackedVector2Array(0, 0)"]
	for line: String in damages:
		take_errors()
		var body := _scene_of(line + "\nfriction = 0.25")
		stage.add_child(body)
		await ticks(3)
		check_equal(body.friction, 0.25, "friction beside " + line)
		_check_sound(body, "the body with " + line)
		check(not body.get_warnings().is_empty(), "nothing is said of " + line)
		take_errors()
		body.free()


func test_a_body_that_fails_is_named_and_reset_or_frozen_and_no_other_moves_differently() -> void:
	for mode: int in [SoftBody2D.FAILURE_MODE_RESET, SoftBody2D.FAILURE_MODE_FREEZE]:
		var ways: Array[PackedVector2Array] = []
		for fails: bool in [false, true]:
			add_floor(100)
			var failing := add_body(Vector2(-400, 0), { "failure_mode": mode, "name": "Doomed" })
			var other := add_body(Vector2(100, 0))
			await ticks(10)
			take_errors()
			if fails:
				failing.set_point_velocity(3, Vector2(1e30, 0))
			await ticks(1)
			var errors := take_errors()
			ways.append(other.get_point_positions())
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
