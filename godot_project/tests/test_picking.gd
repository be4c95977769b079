# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## The mouse finds a body by its deformed outline, in the words of CollisionObject2D.

var _told: Array[String] = []
var _events: Array[InputEvent] = []
var _was_picking := false


func set_up(p_tree: SceneTree, p_error_log: RefCounted) -> void:
	super(p_tree, p_error_log)
	_told = []
	_events = []
	_was_picking = tree.root.physics_object_picking
	tree.root.physics_object_picking = true


func tear_down() -> void:
	tree.root.physics_object_picking = _was_picking
	await super()


func _listen(body: Node, name: String) -> void:
	body.connect("mouse_entered", func() -> void: _told.append(name + " entered"))
	body.connect("mouse_exited", func() -> void: _told.append(name + " exited"))
	body.connect("input_event", func(viewport: Node, event: InputEvent, shape_idx: int) -> void:
		check_equal(viewport, stage.get_viewport(), "viewport")
		check_equal(shape_idx, 0, "shape")
		_events.append(event))


func _move_mouse(place: Vector2) -> void:
	var event := InputEventMouseMotion.new()
	event.position = place
	event.global_position = place
	tree.root.push_input(event, true)


func _click(place: Vector2) -> void:
	var event := InputEventMouseButton.new()
	event.position = place
	event.button_index = MOUSE_BUTTON_LEFT
	event.pressed = true
	tree.root.push_input(event, true)


func _take() -> Array[String]:
	var told := _told
	_told = []
	return told


func test_a_body_is_entered_clicked_and_left() -> void:
	var body := add_weightless_body(Vector2(300, 200), {"input_pickable": true})
	_listen(body, "body")
	await ticks(2)
	_move_mouse(Vector2(300, 120))
	check_equal(_take(), [] as Array[String], "what was told of a mouse beside it")
	_move_mouse(Vector2(300, 170))
	check_equal(_take(), ["body entered"] as Array[String], "what was told of a mouse that came")
	_move_mouse(Vector2(300, 190))
	_click(Vector2(310, 190))
	check_equal(_take(), [] as Array[String], "what was told of a mouse that stayed")
	check_equal(_events.size(), 3, "number of events")
	check(_events.back() is InputEventMouseButton, "the last event is no click")
	_move_mouse(Vector2(300, 260))
	_click(Vector2(300, 260))
	check_equal(_take(), ["body exited"] as Array[String], "what was told of a mouse that left")
	check_equal(_events.size(), 3, "number of events after the mouse left")


func test_the_outline_is_the_deformed_one() -> void:
	add_floor(400)
	var body := add_body(Vector2(300, 350), {"input_pickable": true, "youngs_modulus": 40.0})
	_listen(body, "body")
	await seconds(3)
	var box := bounds_of(polygon_of(body))
	check_above(box.size.x, 108, "width of the squashed body")
	_click(Vector2(box.position.x + 2, body.get_center_of_mass_position().y + 5))
	check_equal(_events.size(), 1, "events at its bulge, beyond its rest shape")
	_click(Vector2(300, box.position.y - 3))
	check_equal(_events.size(), 1, "events above its pressed top, within its rest shape")


func test_a_body_that_moves_under_a_still_mouse_says_so() -> void:
	var body := add_weightless_body(Vector2(300, 200), {"input_pickable": true})
	_listen(body, "body")
	await ticks(2)
	_move_mouse(Vector2(500, 200))
	body.linear_velocity = Vector2(600, 0)
	await ticks(20)
	check_equal(_take(), ["body entered"] as Array[String], "what was told as the body came")
	await ticks(20)
	check_equal(_take(), ["body exited"] as Array[String], "what was told as the body went on")


func test_it_is_found_where_a_camera_and_a_canvas_layer_show_it() -> void:
	var layer := CanvasLayer.new()
	layer.offset = Vector2(100, 40)
	layer.scale = Vector2(2, 2)
	stage.add_child(layer)
	var body := add_weightless_body(Vector2(50, 50), {"input_pickable": true})
	body.reparent(layer, false)
	_listen(body, "body")
	await ticks(2)
	_click(Vector2(200, 140))
	check_equal(_events.size(), 1, "events where the layer shows it")
	_click(Vector2(200, 140) + Vector2(90, 0))
	check_equal(_events.size(), 2, "events at its rim, twice as far out")
	_click(Vector2(50, 50))
	check_equal(_events.size(), 2, "events where it would be without the layer")


func test_who_is_not_pickable_hidden_or_in_no_layer_hears_nothing() -> void:
	for properties: Dictionary in [{}, {"input_pickable": true, "visible": false}, {"input_pickable": true, "collision_layer": 0},
			{"input_pickable": true, "process_mode": Node.PROCESS_MODE_DISABLED}]:
		var body := add_weightless_body(Vector2(300, 200), properties)
		_listen(body, "body")
		await ticks(2)
		_move_mouse(Vector2(300, 200))
		_click(Vector2(300, 200))
		await ticks(2)
		check_equal(_take(), [] as Array[String], "what was told with %s" % properties)
		check_equal(_events.size(), 0, "events with %s" % properties)
		body.free()
	var off := add_weightless_body(Vector2(300, 200), {"input_pickable": true})
	tree.root.physics_object_picking = false
	_listen(off, "body")
	_click(Vector2(300, 200))
	check_equal(_events.size(), 0, "events of a viewport without picking")


func test_picking_ends_with_a_word_when_it_is_switched_off_or_the_body_goes() -> void:
	for end: Callable in [func(body: SoftBody2D) -> void: body.input_pickable = false,
			func(body: SoftBody2D) -> void: stage.remove_child(body),
			func(body: SoftBody2D) -> void: body.process_mode = Node.PROCESS_MODE_DISABLED]:
		var body := add_weightless_body(Vector2(300, 200), {"input_pickable": true})
		_listen(body, "body")
		await ticks(1)
		_move_mouse(Vector2(300, 200))
		check_equal(_take(), ["body entered"] as Array[String], "what was told at first")
		end.call(body)
		check_equal(_take(), ["body exited"] as Array[String], "what was told in the end")
		body.free()


func test_a_listener_may_free_the_body() -> void:
	for signal_id: String in ["mouse_entered", "input_event"]:
		var body := add_weightless_body(Vector2(300, 200), {"input_pickable": true})
		body.connect(signal_id, body.queue_free if signal_id == "mouse_entered" else func(_v: Node, _e: InputEvent, _s: int) -> void: body.queue_free())
		await ticks(1)
		_move_mouse(Vector2(300, 200))
		await ticks(2)
		check(not is_instance_valid(body), "the body is still there after " + signal_id)


## A script of the body has its own input, its children are its own, and what is switched off costs nothing.
func test_it_leaves_nothing_at_a_body_that_is_not_pickable() -> void:
	var body := add_weightless_body()
	check_equal(body.get_child_count(true), 0, "children of a body that is not pickable")
	body.input_pickable = true
	check_equal(body.get_child_count(), 0, "children of a pickable body")
	var copy := body.duplicate()
	check_equal(copy.get_child_count(true), 1, "internal children of its duplicate")
	copy.free()
	body.input_pickable = false
	await tree.process_frame
	await ticks(1)
	check_equal(body.get_child_count(true), 0, "children of a body that is no longer pickable")


func test_rigid_and_soft_bodies_are_told_of_the_same_click() -> void:
	var soft := add_weightless_body(Vector2(300, 200), {"input_pickable": true, "collision_mask": 0})
	var rigid := add_solid(rectangle(80, 80), Transform2D(0, Vector2(300, 200)))
	rigid.input_pickable = true
	_listen(soft, "soft")
	_listen(rigid, "rigid")
	await ticks(2)
	_move_mouse(Vector2(300, 200))
	_click(Vector2(300, 200))
	await ticks(3)
	check("soft entered" in _told and "rigid entered" in _told, "only these were entered: %s" % [_told])
	check_equal(_events.filter(func(event: InputEvent) -> bool: return event is InputEventMouseButton).size(), 2, "clicks that were told")
