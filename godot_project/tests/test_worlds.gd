# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Bodies of different 2D worlds know nothing of each other.


func _add_viewport() -> SubViewport:
	var viewport := SubViewport.new()
	viewport.size = Vector2i(64, 64)
	viewport.world_2d = World2D.new()
	stage.add_child(viewport)
	return viewport


func _add_body(parent: Node) -> SoftBody2D:
	var body := SoftBody2D.new()
	parent.add_child(body)
	return body


func test_a_floor_holds_only_the_bodies_of_its_world() -> void:
	var with_floor := _add_viewport()
	var without := _add_viewport()
	add_floor(100, with_floor)
	var resting := _add_body(with_floor)
	var falling := _add_body(without)
	check_equal(SoftBodySimulation2D.get_body_count(), 2, "bodies of the simulation")
	var before := SoftBodySimulation2D.get_tick_count()
	await seconds(3)
	check_equal(SoftBodySimulation2D.get_tick_count() - before, 180, "ticks of the simulation with two worlds")
	check_near(bounds_of(polygon_of(resting)).end.y, 100.0, 1, "lowest point of the resting body")
	check_near(falling.get_linear_velocity().y, GRAVITY * 3, 3, "velocity of the falling body")


func test_every_world_has_its_own_gravity() -> void:
	var here := _add_viewport()
	var there := _add_viewport()
	PhysicsServer2D.area_set_param(there.world_2d.space, PhysicsServer2D.AREA_PARAM_GRAVITY, 100.0)
	var heavy := _add_body(here)
	var light := _add_body(there)
	await seconds(1)
	check_near(heavy.get_linear_velocity().y, GRAVITY, 1, "velocity here")
	check_near(light.get_linear_velocity().y, 100.0, 0.5, "velocity there")


func test_a_body_may_change_worlds() -> void:
	var first := _add_viewport()
	var second := _add_viewport()
	add_floor(100, second)
	var body := _add_body(first)
	await ticks(10)
	var velocity := body.get_linear_velocity()
	body.reparent(second)
	await ticks(1)
	check_near(body.get_linear_velocity(), velocity + Vector2(0, GRAVITY / 60), 0.5, "velocity after the change")
	await check_rests(body, 8)
	check_near(bounds_of(polygon_of(body)).end.y, 100.0, 1, "lowest point")


func _add_character(parent: Node, position: Vector2) -> void:
	var character := CharacterBody2D.new()
	var collision := CollisionShape2D.new()
	collision.shape = circle(10)
	character.add_child(collision)
	character.position = position
	parent.add_child(character)


## What is near the first body of one world is told to no body that has become the first of another.
func test_a_body_that_changes_worlds_has_no_neighbors_in_the_one_it_left() -> void:
	var first := _add_viewport()
	var second := _add_viewport()
	var bodies: Array[SoftBody2D] = []
	for i in 2:
		var body := _add_body(first)
		body.position.x = 1000.0 * i
		body.freeze = true
		body.collision_proxy_margin = 8.0
		bodies.append(body)
		_add_character(first, Vector2(1000.0 * i - 75, 0))
	await ticks(4)
	bodies[1].reparent(second)
	await ticks(4)
	var query := PhysicsRayQueryParameters2D.create(Vector2(1400, 0), Vector2(1000, 0))
	var hit := second.world_2d.direct_space_state.intersect_ray(query)
	check_near(hit["position"], Vector2(1050, 0), 0.5, "what a ray finds where no character is")


func test_a_viewport_may_get_another_world() -> void:
	var viewport := _add_viewport()
	var body := _add_body(viewport)
	await ticks(5)
	viewport.world_2d = World2D.new()
	add_floor(100, viewport)
	await ticks(5)
	check_equal(SoftBodySimulation2D.get_body_count(), 1, "bodies of the simulation")
	await check_rests(body, 8)
	check_near(bounds_of(polygon_of(body)).end.y, 100.0, 1, "lowest point")


func test_freeing_a_viewport_frees_its_bodies() -> void:
	var viewport := _add_viewport()
	_add_body(viewport)
	_add_body(viewport)
	await ticks(5)
	viewport.queue_free()
	await ticks(3)
	check_equal(SoftBodySimulation2D.get_body_count(), 0, "bodies of the simulation")
