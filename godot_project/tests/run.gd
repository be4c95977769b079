# SPDX-License-Identifier: MIT
extends SceneTree
## Runs the tests inside the engine: every method `test_*` of every suite `res://tests/test_*.gd`.
##
##     godot --headless --fixed-fps 60 --path godot_project --script res://tests/run.gd [-- [--levels] [--without=FILTER...] [FILTER...]]
##
## With `--levels` bodies change their level every ten ticks: rigid flight is switched on and off in turn.
## With filters only tests run whose "suite/test" contains one of them, and none that contains what follows a `--without=`. One
## line a failure, last line `N passed, N failed`, and `, N skipped` if tests could not be done here: those of drawing need
## a window, without `--headless`. Exit code 1 if anything failed or nothing ran. Tests provoke errors on purpose, and the
## engine prints them; one that was not expected makes its test fail and is quoted in the list of failures at the end.

const FOLDER := "res://tests"
const SUITE_BASE := "res://tests/support/suite.gd"
const ERROR_LOG := "res://tests/support/error_log.gd"
const RIGID_FLIGHT := "physics/soft_body_2d/solver/rigid_flight"
const TICKS_A_LEVEL := 10
## Left out with `--levels`: they compare to the bit what began at different ticks, and so with other levels.
const SAME_BITS := [
	"test_abuse/test_a_body_that_fails_is_named_and_reset_or_frozen_and_no_other_moves_differently",
	"test_interpolation/test_the_engines_interpolation_changes_nothing_in_the_simulation",
	"test_mass/test_a_new_node_moves_to_the_bit_as_without_help",
	"test_rollback/test_steps_by_hand_and_replays_repeat_what_water_and_wind_do",
]
const REQUIRED: Array[StringName] = [&"SoftBody2D", &"SoftBodySimulation2D"]

var _filters := PackedStringArray()
var _without := PackedStringArray()
var _changes_levels := false
var _passed := 0
var _failed := 0
var _skipped := 0
var _failures := PackedStringArray()
var _error_log: RefCounted


func _initialize() -> void:
	_run.call_deferred()


func _run() -> void:
	for argument in OS.get_cmdline_user_args():
		if argument == "--levels":
			_changes_levels = true
			physics_frame.connect(_change_levels)
		elif argument.begins_with("--without="):
			_without.append(argument.trim_prefix("--without="))
		else:
			_filters.append(argument)
	for name in REQUIRED:
		if not ClassDB.class_exists(name):
			print("FAILED: the class %s does not exist; build the extension and import the project first" % name)
			_failed += 1
			_finish()
			return
	if ClassDB.class_exists(&"Logger"):
		_error_log = (load(ERROR_LOG) as GDScript).new()
		OS.call("add_logger", _error_log)
	else:
		print("note: this engine has no Logger class (4.5); messages of errors are not checked")
	await physics_frame
	for entry in DirAccess.get_files_at(FOLDER):
		var file := entry.trim_suffix(".remap") # as exported projects list their scripts
		if file.begins_with("test_") and file.ends_with(".gd"):
			await _run_suite(FOLDER.path_join(file))
	if _passed + _failed + _skipped == 0:
		_fail("(no tests)", ["nothing ran"])
	_finish()


func _change_levels() -> void:
	if Engine.get_physics_frames() % TICKS_A_LEVEL == 0:
		ProjectSettings.set_setting(RIGID_FLIGHT, Engine.get_physics_frames() % (2 * TICKS_A_LEVEL) == 0)


func _finish() -> void:
	if _error_log != null:
		OS.call("remove_logger", _error_log)
		_error_log = null
	if not _failures.is_empty():
		print("\nWhat failed:")
		for failure in _failures:
			print(failure)
	print("%d passed, %d failed" % [_passed, _failed] + (", %d skipped" % _skipped if _skipped > 0 else ""))
	quit(1 if _failed > 0 else 0)


func _fail(label: String, reasons: PackedStringArray) -> void:
	_failed += 1
	for reason in reasons:
		var line := "FAILED %s: %s" % [label, reason]
		print(line)
		_failures.append(line)


func _run_suite(path: String) -> void:
	var suite_name := path.get_file().get_basename()
	var script := load(path) as GDScript
	if script == null or not script.can_instantiate() or not _is_suite(script):
		_fail(suite_name, ["does not load, or does not extend " + SUITE_BASE])
		return
	var tests := PackedStringArray()
	for method in script.get_script_method_list():
		var name: String = method["name"]
		if name.begins_with("test_") and not name in tests:
			tests.append(name)
	if tests.is_empty():
		_fail(suite_name, ["has no test"])
	var passed_before := _passed
	for test in tests:
		var label := suite_name + "/" + test
		if _is_in(_without, label) or (_changes_levels and label in SAME_BITS):
			continue
		if _filters.is_empty() or _is_in(_filters, label):
			await _run_test(script, test, label)
	if _passed > passed_before:
		print("%s: %d passed" % [suite_name, _passed - passed_before])


func _is_in(filters: PackedStringArray, label: String) -> bool:
	return Array(filters).any(func(filter: String) -> bool: return filter in label)


func _is_suite(script: Script) -> bool:
	var base := script.get_base_script()
	while base != null and base != load(SUITE_BASE):
		base = base.get_base_script()
	return base != null


## Every test gets an object, a stage and clean engine settings of its own.
func _run_test(script: GDScript, test: String, label: String) -> void:
	var suite: RefCounted = script.new()
	suite.call("set_up", self, _error_log)
	var done: Array[bool] = [false]
	_call_test(suite, test, done)
	var limit: int = suite.call("time_limit")
	var frames := 0
	while not done[0] and frames < limit:
		await physics_frame
		frames += 1
	if not done[0]:
		suite.call("abandon", "did not end within %d physics frames" % limit)
	await suite.call("tear_down")
	var failures: PackedStringArray = suite.get("failures")
	if not failures.is_empty():
		_fail(label, failures)
	elif suite.get("skip_reason") != "":
		_skipped += 1
		print("skipped %s: %s" % [label, suite.get("skip_reason")])
	else:
		_passed += 1


func _call_test(suite: RefCounted, test: String, done: Array[bool]) -> void:
	await suite.call(test)
	done[0] = true
