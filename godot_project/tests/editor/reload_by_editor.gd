# SPDX-License-Identifier: MIT
@tool
extends Node
## The last test: the editor itself notices that the library has changed, when its window is focused again, and reloads it
## and then all scripts. That ends every function that waits, so this waits in `_process`; the driver goes on when it is done.

const TestReload := preload("test_reload.gd")
const MARK := "zz"
## Frames after which the editor is given up.
const PATIENCE := 600
## How often the library is put in place, a tenth of a second apart.
const ATTEMPTS := 30
## Frames for the scripts to be reloaded in, after the library.
const AFTERMATH := 30

signal done

var suite: TestReload
var before := {}
var polygon := PackedVector2Array()
var waited := 0
var reloaded := false
var watching := false


## The scene is open and its body selected.
func start() -> void:
	before = suite.stored(suite.root())
	polygon = suite.body.polygon
	GDExtensionManager.extensions_reloaded.connect(_on_reloaded)
	_replace_library_seen_by_editor()
	watching = true
	get_tree().root.propagate_notification(NOTIFICATION_APPLICATION_FOCUS_IN)


# The editor tells a changed library by its modification time in whole seconds, and the suites before may have replaced it in
# this very second: then it is put in place again in the next one.
func _replace_library_seen_by_editor() -> void:
	var last := suite.library_time()
	for attempt in ATTEMPTS:
		suite.replace_library(MARK)
		if suite.library_time() != last:
			return
		OS.delay_msec(100)
	suite.check(false, "the modification time of the library changes when it is replaced")


func _on_reloaded() -> void:
	reloaded = true
	waited = 0


func _process(_delta: float) -> void:
	if not watching:
		return
	waited += 1
	if waited < (AFTERMATH if reloaded else PATIENCE):
		return
	watching = false
	if suite.check(reloaded, "the editor reloads a library that has changed when its window is focused"):
		_check()
	done.emit()


func _check() -> void:
	suite.check_equal(suite.mark(), MARK, "mark of the library in use")
	suite.check_stored(before, "after the editor reloaded the library")
	suite.find_plugin()
	var plugin := suite.plugin
	if not suite.check(plugin != null and plugin.canvas != null and suite.body in plugin.canvas.bodies, "the addon still edits the body"):
		return
	suite.check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies of the simulation, as a script finds it by its name")
	# A drag, as the suites do it, but without waiting.
	var from := suite.polygon_on_screen(0)
	suite.press(from)
	suite.move(from + Vector2(30, -14))
	suite.release()
	suite.check_near(suite.polygon_on_screen(0), from + Vector2(30, -14), 0.01, "place of a point dragged after the reload")
	suite.history().undo()
	suite.check_equal(suite.body.polygon, polygon, "polygon after the drag is undone")
