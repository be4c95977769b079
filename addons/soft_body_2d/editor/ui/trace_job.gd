# SPDX-License-Identifier: MIT
@tool
extends ConfirmationDialog
## Traces a picture in a thread, and shows how far it is if that takes a while.

const TextureTrace := preload("../logic/texture_trace.gd")
const Words := preload("../logic/words.gd")

## Pictures of more pixels get a bar at once.
const LARGE := 1024 * 1024
const PATIENCE := 0.25

signal done(trace: TextureTrace)

var trace := TextureTrace.new()

var _task := -1
var _bar := ProgressBar.new()
var _waited := 0.0


func start(picture: Image, budget: int, threshold: float, margin: float) -> void:
	title = Words.say("Tracing the Picture")
	get_ok_button().hide()
	_bar.max_value = 1
	_bar.custom_minimum_size = Vector2(300, 24) * EditorInterface.get_editor_scale()
	add_child(_bar)
	canceled.connect(func() -> void: trace.canceled = true)
	_task = WorkerThreadPool.add_task(trace.trace.bind(picture, budget, threshold, margin), false,
			"SoftBody2D: trace a picture")
	if picture != null and picture.get_width() * picture.get_height() > LARGE:
		popup_centered()


func _process(delta: float) -> void:
	if _task < 0:
		return
	_bar.value = trace.progress
	_waited += delta
	if WorkerThreadPool.is_task_completed(_task):
		_finish()
		done.emit(trace)
		queue_free()
	elif _waited > PATIENCE and not visible and not trace.canceled:
		popup_centered()


func _exit_tree() -> void:
	trace.canceled = true
	_finish()


func _finish() -> void:
	if _task >= 0:
		WorkerThreadPool.wait_for_task_completion(_task)
		_task = -1
