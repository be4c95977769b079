# SPDX-License-Identifier: MIT
@tool
extends EditorPlugin
## Runs the suites beside it inside a real editor: every method `test_*`, or `picture_*` with the argument --pictures, or
## `bench_*` with --bench.
##
##     godot --editor --path COPY -- --editor-tests [--pictures|--bench] [FILTER...]
##
## Does nothing without --editor-tests. One line a failure, last line `N passed, N failed`, and
## `, N skipped` if tests could not be done here.

const ErrorLog := preload("res://tests/support/error_log.gd")
const FOLDER := "res://tests/editor"
## Seconds after which a test is given up, and a measurement.
const TIME_LIMIT := 30.0
const BENCH_TIME_LIMIT := 300.0
const RELOAD := "reload_by_editor/test_the_editor_reloads_a_library_that_has_changed"

var _passed := 0
var _failed := 0
var _skipped := 0
var _log: RefCounted
var _last_suite: RefCounted
var _reload_begin := 0


func _enter_tree() -> void:
	if "--editor-tests" in OS.get_cmdline_user_args():
		_run.call_deferred()


func _run() -> void:
	var arguments := OS.get_cmdline_user_args()
	var prefix := "picture_" if "--pictures" in arguments else ("bench_" if "--bench" in arguments else "test_")
	var filters := Array(arguments).filter(func(text: String) -> bool: return not text.begins_with("--"))
	if ClassDB.class_exists(&"Logger"):
		_log = ErrorLog.new()
		OS.call(&"add_logger", _log)
	while EditorInterface.get_resource_filesystem().is_scanning() or EditorInterface.get_base_control() == null:
		await get_tree().process_frame
	for i in 10:
		await get_tree().process_frame
	for file in DirAccess.get_files_at(FOLDER):
		if file.begins_with(prefix) and file.ends_with(".gd"):
			await _run_suite(file, prefix, filters)
	if prefix == "test_" and (filters.is_empty() or filters.any(func(f: String) -> bool: return f in RELOAD)):
		await _begin_reload()
	else:
		_finish()


# The last test, as no function of ours that waits outlives it.
func _begin_reload() -> void:
	_reload_begin = Time.get_ticks_msec()
	_last_suite = load(FOLDER.path_join("test_reload.gd")).new()
	_last_suite.call(&"set_up", self, _log)
	await _last_suite.call(&"write_scene_of_everything")
	await _last_suite.call(&"open", _last_suite.get(&"SCENE"))
	await _last_suite.call(&"select_body")
	var watch: Node = load(FOLDER.path_join("reload_by_editor.gd")).new()
	watch.suite = _last_suite
	watch.done.connect(_end_reload)
	add_child(watch)
	watch.start()


func _end_reload() -> void:
	for error: String in _log.call(&"take") if _log != null else []:
		_last_suite.failures.append("unexpected " + error)
	_report(RELOAD, _last_suite, _reload_begin)
	_finish()


func _finish() -> void:
	if _log != null:
		OS.call(&"remove_logger", _log)
	print("%d passed, %d failed" % [_passed, _failed] + (", %d skipped" % _skipped if _skipped > 0 else ""))
	get_tree().quit(1 if _failed > 0 else 0)


func _run_suite(file: String, prefix: String, filters: Array) -> void:
	var script: GDScript = load(FOLDER.path_join(file))
	if script == null or not script.can_instantiate():
		_failed += 1
		print("FAILED %s does not load" % file)
		return
	for method in script.get_script_method_list():
		var test: String = method["name"]
		var label := file.get_basename() + "/" + test
		if not test.begins_with(prefix) or not (filters.is_empty() or filters.any(func(f: String) -> bool: return f in label)):
			continue
		var suite: RefCounted = script.new()
		suite.call(&"set_up", self, _log)
		var done := [false]
		_call_test(suite, test, done)
		var begin := Time.get_ticks_msec()
		while not done[0]:
			await get_tree().process_frame
			var limit := BENCH_TIME_LIMIT if prefix == "bench_" else TIME_LIMIT
			if Time.get_ticks_msec() - begin > 1000 * limit:
				suite.failures.append("did not end within %d s" % limit)
				break
		await suite.call(&"tear_down")
		if suite.failures.is_empty() and suite.claims == 0 and suite.skip_reason == "":
			suite.failures.append("claimed nothing")
		_report(label, suite, begin)


func _report(label: String, suite: RefCounted, begin: int) -> void:
	for failure: String in suite.failures:
		print("FAILED %s: %s" % [label, failure])
	if suite.failures.is_empty() and suite.skip_reason != "":
		_skipped += 1
		print("skipped %s: %s" % [label, suite.skip_reason])
	elif suite.failures.is_empty():
		_passed += 1
		print("passed %s (%.1f s)" % [label, (Time.get_ticks_msec() - begin) / 1000.0])
	else:
		_failed += 1


func _call_test(suite: RefCounted, test: String, done: Array) -> void:
	await suite.call(test)
	done[0] = true
