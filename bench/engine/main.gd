# SPDX-License-Identifier: MIT
extends Node
## Measures what it is asked for after `--`, prints one line `ROW {…}` for each measurement, and quits.
##
##     hold LOAD      how many bodies of that load a physics tick of 1/60 s holds
##     cost LOAD N    what N bodies cost, by parts
##     crowd N        what it costs to add N nodes in one tick and to free them, and what memory they take
##
## Run with `--fixed-fps 60`: then every frame is one tick, and none waits for the clock.

const BUDGET_USEC := 1e6 / 60
const SETTLE_TICKS := 90
const TIMED_TICKS := 60
## A count is found when its tick takes as long as it may, to that share.
const CLOSE := 0.03
const MAX_ROUNDS := 9

## What is simulated, and with which properties other than the node's own.
const LOADS := {
	"soft": {},
	"soft_unseen": { "collision_proxy_enabled": false },
	"soft_apart": { "collision_mask": 2 },
	"soft_alone": { "collision_mask": 0 },
	"soft_monitored": { "contact_monitor": true, "max_contacts_reported": 8 },
	"soft_asleep": {},
	"soft_resting": { "sleeping": true },
	"soft_off_screen": {},
	"soft_off_screen_still": { "simulate_off_screen": false },
	"rigid": {},
}


func _ready() -> void:
	_run.call_deferred()


func _run() -> void:
	var arguments := OS.get_cmdline_user_args()
	var i := 0
	while i < arguments.size():
		match arguments[i]:
			"hold":
				await _hold(arguments[i + 1])
				i += 2
			"cost":
				await _cost(arguments[i + 1], arguments[i + 2].to_int())
				i += 3
			"crowd":
				await _crowd(arguments[i + 1].to_int())
				i += 2
			_:
				printerr("unknown argument ", arguments[i])
				get_tree().quit(1)
				return
	get_tree().quit()


func _row(values: Dictionary) -> void:
	values["drawn"] = DisplayServer.get_name() != "headless"
	print("ROW ", JSON.stringify(values))


# How many bodies fit: from below, by what the last count took.
func _hold(load_name: String) -> void:
	var count := 20 if load_name == "rigid" else 200
	var below := 0
	var below_usec := 0.0
	var result := 0
	for round in MAX_ROUNDS:
		var usec: float = (await _measure(load_name, count)).tick
		if absf(usec / BUDGET_USEC - 1) <= CLOSE:
			result = count
			break
		if usec < BUDGET_USEC and count > below:
			below = count
			below_usec = usec
		# Costs grow a little faster than counts: by half as much too far, next time.
		count = maxi(1, roundi(count * clampf(pow(BUDGET_USEC / usec, 0.9), 0.1, 8)))
		result = below
	_row({ "hold": load_name, "bodies": result, "usec_below": below_usec })


func _cost(load_name: String, count: int) -> void:
	var measured: Dictionary = await _measure(load_name, count)
	measured.merge({ "cost": load_name, "bodies": count })
	_row(measured)


# Means and medians over some ticks of a pile that has fallen [µs a tick].
func _measure(load_name: String, count: int) -> Dictionary:
	ProjectSettings.set_setting("physics/soft_body_2d/sleep/enabled", load_name in ["soft_asleep", "soft_resting"])
	await get_tree().process_frame
	var pile: RefCounted
	if load_name == "rigid":
		pile = preload("res://rigid_load.gd").new(self, count)
	else:
		preload("res://soft_load.gd").properties = LOADS[load_name]
		pile = preload("res://soft_load.gd").new(self, count)
	var camera := Camera2D.new()
	var seen: Rect2 = pile.extent
	camera.position = seen.get_center() + Vector2(0, 1e6 if load_name.begins_with("soft_off_screen") else 0.0)
	camera.zoom = Vector2.ONE * minf(1280 / seen.size.x, 720 / seen.size.y)
	pile.root.add_child(camera)
	var settle := SETTLE_TICKS if load_name != "soft_asleep" else 20 * SETTLE_TICKS
	for i in settle:
		await get_tree().physics_frame
	SoftBodySimulation2D.reset_statistics()
	var times := PackedInt64Array()
	var draw_times := PackedFloat64Array()
	var draw_count := 0
	var last := Time.get_ticks_usec()
	for i in TIMED_TICKS:
		await get_tree().physics_frame
		var now := Time.get_ticks_usec()
		times.append(now - last)
		last = now
		draw_times.append(SoftBodySimulation2D.get_last_drawing_usec()) # of the frame before
		draw_count += SoftBodySimulation2D.get_last_drawn_count()
	times.sort()
	draw_times.sort()
	@warning_ignore("integer_division")
	var result := { "tick": times[TIMED_TICKS / 2], "step": SoftBodySimulation2D.get_mean_step_usec(),
		"draw": draw_times[TIMED_TICKS / 2], "draw_count": draw_count / float(TIMED_TICKS),
		"awake": SoftBodySimulation2D.get_awake_body_count(), "threads": SoftBodySimulation2D.get_thread_count() }
	result.merge(SoftBodySimulation2D.get_step_profile())
	pile.remove()
	await get_tree().process_frame
	return result


# Each is a median of some rounds; the first round, which makes the shape that all share, is told apart.
func _crowd(count: int) -> void:
	var added := PackedInt64Array()
	var first_ticks := PackedInt64Array()
	var freed := PackedInt64Array()
	var first := 0
	var bytes := 0.0
	for round in 6:
		await get_tree().physics_frame
		var before := _resident_bytes()
		var start := Time.get_ticks_usec()
		var crowd := Node2D.new()
		for i in count:
			var body := SoftBody2D.new()
			@warning_ignore("integer_division")
			body.position = Vector2(i % 100, i / 100) * 120
			crowd.add_child(body)
		add_child(crowd)
		var then := Time.get_ticks_usec()
		await get_tree().physics_frame
		await get_tree().physics_frame
		var ticked := Time.get_ticks_usec()
		if round == 0:
			first = then - start
			bytes = (_resident_bytes() - before) / float(count) # later rounds use what this one has freed
		else:
			added.append(then - start)
			first_ticks.append(ticked - then)
		start = Time.get_ticks_usec()
		crowd.free()
		freed.append(Time.get_ticks_usec() - start)
	for times: PackedInt64Array in [added, first_ticks, freed]:
		times.sort()
	_row({ "crowd": count, "first_add_usec": first, "add_usec": added[2], "first_ticks_usec": first_ticks[2], "free_usec": freed[3], "bytes_a_node": bytes })


# Memory of the process, which an export tells on Linux only.
func _resident_bytes() -> int:
	var status := FileAccess.open("/proc/self/statm", FileAccess.READ)
	return status.get_line().get_slice(" ", 1).to_int() * 4096 if status != null else 0
