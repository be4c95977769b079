# SPDX-License-Identifier: MIT
extends RefCounted
## Base of the test suites: claims, waiting, and things to build a scene from.
##
## A test fails by a broken claim, by an error or warning of the engine that it did not expect, by leaving
## soft bodies or nodes behind, by claiming nothing, and by not ending in time.

## Default gravity of a project [px/s²].
const GRAVITY := 980.0

signal _never

## Broken claims of this test.
var failures := PackedStringArray()
## Why this test did nothing, if so.
var skip_reason := ""
var tree: SceneTree
## Parent of everything that the test adds; freed after it.
var stage: Node2D

var _error_log: RefCounted
var _claims := 0
## Claims about messages, which engines without the class Logger do not tell.
var _unheard := 0
var _abandoned := false
var _orphans_before := 0.0


# Called by the runner.

func set_up(p_tree: SceneTree, p_error_log: RefCounted) -> void:
	tree = p_tree
	_error_log = p_error_log
	take_errors()
	set_default_damp(0, 0)
	_orphans_before = Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT)
	stage = Node2D.new()
	stage.name = "Stage"
	tree.root.add_child(stage)


func tear_down() -> void:
	tree.paused = false
	tree.physics_interpolation = false
	Engine.physics_ticks_per_second = 60
	Engine.time_scale = 1
	stage.queue_free()
	for i in 3:
		await tree.physics_frame
		await tree.process_frame
	for error in take_errors():
		_note_failure("unexpected " + error)
	if SoftBodySimulation2D.get_body_count() != 0:
		_note_failure("%d soft bodies stayed in the simulation" % SoftBodySimulation2D.get_body_count())
	var orphans := Performance.get_monitor(Performance.OBJECT_ORPHAN_NODE_COUNT) - _orphans_before
	if orphans > 0:
		_note_failure("%d nodes stayed outside the tree" % orphans)
	if _claims == 0 and skip_reason == "":
		_note_failure("claimed nothing")
	elif _claims > 0 and _claims == _unheard:
		skip("this engine does not tell its messages (4.5)")


## Frames after which the runner gives a test up.
func time_limit() -> int:
	return 3000


func abandon(reason: String) -> void:
	_abandoned = true
	_claims += 1
	_note_failure(reason)


# Claims. Each returns whether it held.

func check(condition: bool, claim: String) -> bool:
	_claims += 1
	if not condition:
		_note_failure(claim)
	return condition


func check_equal(actual: Variant, expected: Variant, what: String) -> bool:
	return check(actual == expected, "%s is %s, not %s" % [what, actual, expected])


## For a test that cannot be done here; it then counts as neither passed nor failed. Return after it.
func skip(reason: String) -> void:
	skip_reason = reason


## Whether this is a debug build. A release build says less: with it the test is skipped.
func is_debug_build() -> bool:
	if not OS.is_debug_build():
		skip("a release build does not say it")
	return OS.is_debug_build()


## For numbers and vectors.
func check_near(actual: Variant, expected: Variant, tolerance: float, what: String) -> bool:
	var error: float = absf(actual - expected) if actual is float or actual is int else (actual - expected).length()
	return check(error <= tolerance, "%s is %s, not %s within %s" % [what, actual, expected, tolerance])


func check_below(actual: float, limit: float, what: String) -> bool:
	return check(actual < limit, "%s is %s, not below %s" % [what, actual, limit])


func check_above(actual: float, limit: float, what: String) -> bool:
	return check(actual > limit, "%s is %s, not above %s" % [what, actual, limit])


func check_points_near(actual: PackedVector2Array, expected: PackedVector2Array, tolerance: float,
		what: String) -> bool:
	if not check_equal(actual.size(), expected.size(), "number of points of " + what):
		return false
	return check_below(largest_distance(actual, expected), tolerance, "largest distance between " + what)


## Runs `action`, which the engine must answer with one error that contains every one of `fragments`.
func check_refused(action: Callable, fragments: PackedStringArray, what: String) -> void:
	take_errors()
	action.call()
	_claims += 1
	if _error_log == null:
		_unheard += 1
		return
	var errors := take_errors()
	if errors.size() != 1:
		_note_failure("%s printed %d errors, not one: %s" % [what, errors.size(), errors])
		return
	for fragment in fragments:
		if not fragment in errors[0]:
			_note_failure("the error of %s does not say '%s': %s" % [what, fragment, errors[0]])


## Errors and warnings since the last call; always empty on engines without the class Logger.
func take_errors() -> PackedStringArray:
	return PackedStringArray() if _error_log == null else PackedStringArray(_error_log.call("take"))


## Notes of the extension since the run began; null on engines without the class Logger.
func printed_notes() -> Variant:
	return null if _error_log == null else PackedStringArray(_error_log.call("notes"))


# Waiting. After each awaited tick, the soft bodies have been stepped once more.

func ticks(count: int) -> void:
	for i in count:
		await tree.physics_frame
		if _abandoned:
			await _never # the runner has moved on; nothing of this test may go on


func seconds(duration: float) -> void:
	await ticks(roundi(duration * Engine.physics_ticks_per_second))


# Things to build a scene from.

func add_body(position := Vector2.ZERO, properties := {}) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.position = position
	for property: String in properties:
		body.set(property, properties[property])
	stage.add_child(body)
	return body


func add_weightless_body(position := Vector2.ZERO, properties := {}) -> SoftBody2D:
	return add_body(position, properties.merged({"gravity_scale": 0.0}))


func add_solid(shape: Shape2D, transform := Transform2D.IDENTITY, parent: Node = null) -> StaticBody2D:
	var solid := StaticBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = shape
	solid.add_child(collision)
	solid.transform = transform
	(stage if parent == null else parent).add_child(solid)
	return solid


## A wide rectangle whose top is at `y`.
## The surface of a body: without values that of one that has no material.
func surface(friction := 0.4, bounce := 0.0) -> PhysicsMaterial:
	var material := PhysicsMaterial.new()
	material.friction = friction
	material.bounce = bounce
	return material


func add_floor(y: float, parent: Node = null) -> StaticBody2D:
	return add_solid(rectangle(2000, 100), Transform2D(0, Vector2(0, y + 50)), parent)


## What a project's default damping does, here and in worlds to come. Tests begin in empty space, where a motion can be
## calculated; a new project has 0.1 and 1.
func set_default_damp(linear: float, angular: float) -> void:
	ProjectSettings.set_setting("physics/2d/default_linear_damp", linear)
	ProjectSettings.set_setting("physics/2d/default_angular_damp", angular)
	var space := tree.root.world_2d.space
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_LINEAR_DAMP, linear)
	PhysicsServer2D.area_set_param(space, PhysicsServer2D.AREA_PARAM_ANGULAR_DAMP, angular)


func rectangle(width: float, height: float) -> RectangleShape2D:
	var shape := RectangleShape2D.new()
	shape.size = Vector2(width, height)
	return shape


func circle(radius: float) -> CircleShape2D:
	var shape := CircleShape2D.new()
	shape.radius = radius
	return shape


# Measures.

func polygon_of(body: SoftBody2D) -> PackedVector2Array:
	return body.get_point_positions().slice(0, body.polygon.size())


func bounds_of(points: PackedVector2Array) -> Rect2:
	var box := Rect2(points[0], Vector2.ZERO)
	for point in points:
		box = box.expand(point)
	return box


func largest_distance(a: PackedVector2Array, b: PackedVector2Array) -> float:
	var largest := 0.0
	for i in a.size():
		largest = maxf(largest, a[i].distance_to(b[i]))
	return largest


func all_finite(points: PackedVector2Array) -> bool:
	for point in points:
		if not point.is_finite():
			return false
	return true


## Claims that the body, `duration` seconds from now, lies still and outside its surroundings: penetration
## and every point's way during the last second stay below a pixel.
func check_rests(body: SoftBody2D, duration := 10.0, what := "the body") -> void:
	await seconds(duration - 1)
	var points := body.get_point_positions()
	var center := body.get_center_of_mass_position()
	var way := 0.0
	var center_way := 0.0
	for i in Engine.physics_ticks_per_second:
		await ticks(1)
		way = maxf(way, largest_distance(body.get_point_positions(), points))
		center_way = maxf(center_way, body.get_center_of_mass_position().distance_to(center))
	check(all_finite(body.get_point_positions()), what + " has a point that is not finite")
	check_below(body.get_penetration(), 1, "penetration of %s in px" % what)
	check_below(center_way, 1, "way of the center of %s during the last second in px" % what)
	check_below(way, 1, "way of a point of %s during the last second in px" % what)


func _note_failure(reason: String) -> void:
	if not reason in failures:
		failures.append(reason)
