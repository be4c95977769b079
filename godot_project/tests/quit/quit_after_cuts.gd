# SPDX-License-Identifier: MIT
extends SceneTree
## Cuts 60 bodies twice and quits, with the modes of their pieces still to be found: the program ends. Run by scripts/test.sh engine.


func _initialize() -> void:
	await physics_frame
	var pieces := 0
	for i in 60:
		var body := SoftBody2D.new()
		body.position = Vector2(i * 300.0, 0)
		root.add_child(body)
		for half in body.cut(body.position + Vector2(-100, 2), body.position + Vector2(100, -3)):
			pieces += 1 + half.cut(body.position + Vector2(2, -200), body.position + Vector2(-2, 200)).slice(1).size()
	await physics_frame
	await physics_frame
	print("%d passed, %d failed" % [1, 0] if pieces == 240 else "0 passed, 1 failed")
	quit()
