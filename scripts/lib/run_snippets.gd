# SPDX-License-Identifier: MIT
extends SceneTree
## Runs every script of a folder for a second beside two soft bodies and a crate. What goes wrong is in the log as an error.
##
##     godot --headless --path PROJECT --script run_snippets.gd -- FOLDER

const TICKS := 70


func _initialize() -> void:
	_run.call_deferred()


func _add_solid(stage: Node2D, name: String, place: Vector2, size: Vector2) -> StaticBody2D:
	var solid := StaticBody2D.new()
	solid.name = name
	solid.position = place
	var shape := CollisionShape2D.new()
	shape.shape = RectangleShape2D.new()
	(shape.shape as RectangleShape2D).size = size
	solid.add_child(shape)
	stage.add_child(solid)
	return solid


func _add_jelly(stage: Node2D, name: String, place: Vector2) -> SoftBody2D:
	var body := SoftBody2D.new()
	body.name = name
	body.position = place
	stage.add_child(body)
	return body


func _run() -> void:
	var folder := OS.get_cmdline_user_args()[0]
	var passed := 0
	for file in DirAccess.get_files_at(folder):
		if not file.ends_with(".gd"):
			continue
		print("snippet ", file)
		var script := load(folder.path_join(file)) as GDScript
		if script == null or not script.can_instantiate():
			printerr("ERROR: ", file, " is no script that can run")
			continue
		var stage := Node2D.new()
		root.add_child(stage)
		_add_solid(stage, "Floor", Vector2(300, 620), Vector2(2000, 40))
		var node: Node2D = script.new()
		if not node is SoftBody2D:
			for name: String in ["jelly", "other", "crate"]:
				if not name in node:
					continue
				match name:
					"jelly":
						node.set(name, _add_jelly(stage, "Jelly", Vector2(300, 300)))
					"other":
						node.set(name, _add_jelly(stage, "Other", Vector2(500, 300)))
					"crate":
						node.set(name, _add_solid(stage, "Crate", Vector2(300, 500), Vector2(80, 80)))
		stage.add_child(node)
		for i in TICKS:
			await physics_frame
		stage.free()
		passed += 1
	print(passed, " passed, 0 failed")
	quit()
