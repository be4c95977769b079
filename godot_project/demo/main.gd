# SPDX-License-Identifier: MIT
extends Node2D
## The demo: soft bodies of different stiffness, a mouse to pull them with, and what stepping them costs.

const RunOptions := preload("res://demo/run_options.gd")
const RunRecord := preload("res://demo/run_record.gd")
const STATUS_INTERVAL := 0.25 # s; numbers that change with every frame cannot be read

var _options := RunOptions.new()
var _record := RunRecord.new()
var _bodies: Array[SoftBody2D] = []
var _starts: Array[Transform2D] = []
var _ticks := 0
var _ending := false
var _status_age := STATUS_INTERVAL

@onready var _status: Label = %Status


func _ready() -> void:
	# Inside another scene, such as a test, the command line is not meant for the demo.
	if get_tree().current_scene == self:
		_options.read(OS.get_cmdline_user_args())
		if _options.problem != "":
			printerr("SoftBody2D demo: " + _options.problem)
			_ending = true
			get_tree().quit(2)
			return
		get_tree().auto_accept_quit = false
	for node in get_tree().get_nodes_in_group(&"soft_bodies"):
		var body := node as SoftBody2D
		_bodies.append(body)
		_starts.append(body.global_transform)
	SoftBodySimulation2D.reset_statistics()


func _notification(what: int) -> void:
	if what == NOTIFICATION_WM_CLOSE_REQUEST and get_tree().current_scene == self:
		_end()


func _unhandled_key_input(event: InputEvent) -> void:
	var key := event as InputEventKey
	if key.pressed and not key.echo and key.keycode == KEY_R:
		reset()


## Puts every body back to where it started, at rest.
func reset() -> void:
	for i in _bodies.size():
		_bodies[i].global_transform = _starts[i]
		_bodies[i].reset()


func _physics_process(_delta: float) -> void:
	if _ending:
		return
	_ticks += 1
	_record.observe(_bodies)
	if _options.quit_after_seconds > 0 \
			and _ticks >= roundi(_options.quit_after_seconds * Engine.physics_ticks_per_second):
		_end()


func _process(delta: float) -> void:
	_status_age += delta
	if _status_age < STATUS_INTERVAL:
		return
	_status_age = 0
	_status.text = "tick %d µs (mean %d µs)   ·   %d bodies   ·   %d FPS" % [
		roundi(SoftBodySimulation2D.get_last_step_usec()), roundi(SoftBodySimulation2D.get_mean_step_usec()),
		SoftBodySimulation2D.get_body_count(), roundi(Engine.get_frames_per_second()),
	]


func _end() -> void:
	if _ending:
		return
	_ending = true
	var line := _record.to_line() # before the picture is taken, which may let more ticks pass
	var failed := _options.screenshot_path != "" and not await _save_picture(_options.screenshot_path)
	if _options.summary:
		print(line)
	get_tree().quit(1 if failed else 0)


## Returns false if a picture was expected and could not be saved.
func _save_picture(path: String) -> bool:
	if DisplayServer.get_name() == "headless":
		print("No screenshot: a headless run draws nothing.")
		return true
	await RenderingServer.frame_post_draw
	var error := get_viewport().get_texture().get_image().save_png(path)
	if error != OK:
		printerr("SoftBody2D demo: the screenshot %s was not saved: %s" % [path, error_string(error)])
	return error == OK
