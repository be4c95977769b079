# SPDX-License-Identifier: MIT
extends SceneTree
## Plays a scene that holds one soft body and a floor, and says whether the body has come to rest on the floor.
##
##     godot --headless --path PROJECT --script newcomer.gd -- SCENE

const TICKS := 480
## How far above the floor's top, or in it, the lowest point may be [px].
const GAP := 1.0


func _initialize() -> void:
	_run.call_deferred()


func _find(type: String) -> Node2D:
	return root.find_children("*", type, true, false).front()


func _run() -> void:
	var scene := load(OS.get_cmdline_user_args()[0]) as PackedScene
	root.add_child(scene.instantiate())
	for i in TICKS:
		await physics_frame
	var body := _find("SoftBody2D") as SoftBody2D
	var solid := _find("StaticBody2D")
	if body == null or solid == null:
		printerr("ERROR: there is no soft body, or no floor")
		quit(1)
		return
	var lowest := -INF
	for point in body.get_point_positions():
		lowest = maxf(lowest, point.y)
	var shape := _find("CollisionShape2D") as CollisionShape2D
	var top := shape.global_position.y + shape.shape.get_rect().position.y
	if shape.shape is WorldBoundaryShape2D:
		top = shape.global_position.y
	print("lowest point ", lowest, ", floor ", top, ", speed ", body.linear_velocity.length())
	if absf(lowest - top) > GAP or body.linear_velocity.length() > 1.0:
		printerr("ERROR: the body does not rest on the floor")
		quit(1)
		return
	print("1 passed, 0 failed")
	quit()
