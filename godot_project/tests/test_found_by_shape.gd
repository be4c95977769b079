# SPDX-License-Identifier: MIT
extends "res://tests/support/suite.gd"
## Shape queries find every soft body, with as few results as `intersect_shape` gives by default.

const DEFAULT_RESULTS := 32


func _parameters(shape: Shape2D, place: Vector2) -> PhysicsShapeQueryParameters2D:
	var query := PhysicsShapeQueryParameters2D.new()
	query.shape = shape
	query.transform = Transform2D(0, place)
	query.collision_mask = 1
	return query


func _own(shape: Shape2D, place: Vector2) -> Array[Node2D]:
	return SoftBodySimulation2D.intersect_shape(_parameters(shape, place))


## A physics server on a thread of its own knows a shape from the next tick on.
func _query(parameters: PhysicsShapeQueryParameters2D) -> Array[Dictionary]:
	return tree.root.world_2d.direct_space_state.intersect_shape(parameters)


func _bodies_of(hits: Array[Dictionary]) -> Dictionary:
	var found := {}
	for hit in hits:
		if hit["collider"] is SoftBody2D:
			found[hit["collider"]] = found.get(hit["collider"], 0) + 1
	return found


## Twelve bodies fall into a bin and settle. A query around them all finds twelve in every tick.
func test_intersect_shape_finds_twelve_settling_bodies() -> void:
	var kinds := {
		"default bodies": {},
		"soft ones": { "youngs_modulus": 100.0 },
		"networks": { "elastic_model": SoftBody2D.ELASTIC_MODEL_NETWORK },
	}
	for kind: String in kinds:
		for solid: StaticBody2D in [add_floor(400), add_solid(rectangle(20, 1200), Transform2D(0, Vector2(-180, 0))),
				add_solid(rectangle(20, 1200), Transform2D(0, Vector2(180, 0)))]:
			solid.collision_layer = 2
		for i in 12:
			var place := Vector2(-110 + 110 * (i % 3) + 5 * (i / 3), 300 - 115 * (i / 3))
			add_body(place, { "collision_mask": 3 }.merged(kinds[kind]))
		var everywhere := _parameters(rectangle(2000, 4000), Vector2.ZERO)
		await ticks(2)
		var fewest := 12
		var most_results := 0
		for i in 500:
			await ticks(1)
			var hits := _query(everywhere)
			fewest = mini(fewest, _bodies_of(hits).size())
			most_results = maxi(most_results, hits.size())
		check_equal(_own(rectangle(2000, 4000), Vector2.ZERO).size(), 12, "%s found by our own query" % kind)
		check_equal(fewest, 12, "%s found of twelve, in the worst of 500 ticks" % kind)
		check_below(most_results, DEFAULT_RESULTS, "results of the query, with " + kind)
		for node in stage.get_children():
			node.free()
		await ticks(2)


## More bodies than results: the engine gives as many as are asked for, our own query all of them, each once.
func test_our_own_query_finds_all_bodies_once() -> void:
	for i in 50:
		add_weightless_body(Vector2(120 * (i % 10), 120 * (i / 10)))
	var everywhere := _parameters(rectangle(5000, 5000), Vector2.ZERO)
	await ticks(4)
	check_equal(_query(everywhere).size(), DEFAULT_RESULTS, "results of the engine")
	var found := _own(rectangle(5000, 5000), Vector2.ZERO)
	check_equal(found.size(), 50, "bodies that our own query finds")
	for body in found:
		check_equal(found.count(body), 1, "times that a body is found")


func test_our_own_query_takes_shapes_of_all_kinds() -> void:
	var body := add_weightless_body(Vector2(200, 0))
	var capsule := CapsuleShape2D.new()
	capsule.radius = 10
	capsule.height = 60
	var segment := SegmentShape2D.new()
	segment.a = Vector2(-10, 0)
	segment.b = Vector2(10, 0)
	var convex := ConvexPolygonShape2D.new()
	convex.points = PackedVector2Array([Vector2(-10, -10), Vector2(10, -10), Vector2(10, 10), Vector2(-10, 10)])
	var concave := ConcavePolygonShape2D.new()
	concave.segments = PackedVector2Array([Vector2(-10, -10), Vector2(10, -10), Vector2(10, -10), Vector2(10, 10)])
	for shape: Shape2D in [circle(10), rectangle(20, 20), capsule, segment, convex, concave]:
		var what := shape.get_class()
		check_equal(_own(shape, Vector2(200, 0)), [body] as Array[Node2D], "what a %s in the middle finds" % what)
		check_equal(_own(shape, Vector2(142, 0)), [body] as Array[Node2D], "what a %s at its side finds" % what)
		check_equal(_own(shape, Vector2(135, 0)).size(), 0, "bodies that a %s beside it finds" % what)
		var query := _parameters(shape, Vector2(135, 0))
		query.margin = 8
		check_equal(SoftBodySimulation2D.intersect_shape(query).size(), 1, "bodies that a %s with a margin finds" % what)
	check_equal(_own(circle(500), Vector2(200, 0)).size(), 1, "bodies that a circle around it finds")
	var boundary := WorldBoundaryShape2D.new()
	check_equal(_own(boundary, Vector2(0, 40)).size(), 1, "bodies that a boundary finds above which it does not lie altogether")
	check_equal(_own(boundary, Vector2(0, 60)).size(), 0, "bodies that a boundary below it finds")


func test_our_own_query_goes_by_layers_exclusions_and_worlds() -> void:
	var body := add_weightless_body(Vector2.ZERO, { "collision_layer": 4 })
	var other := add_weightless_body(Vector2(60, 0))
	var hidden := add_weightless_body(Vector2(-60, 0), { "collision_proxy_enabled": false })
	var query := _parameters(circle(100), Vector2.ZERO)
	check_equal(SoftBodySimulation2D.intersect_shape(query), [other, hidden] as Array[Node2D], "bodies of layer 1")
	query.collision_mask = 4
	check_equal(SoftBodySimulation2D.intersect_shape(query), [body] as Array[Node2D], "bodies of layer 3")
	query.collision_mask = 5
	query.exclude = [other.get_rid()]
	check_equal(SoftBodySimulation2D.intersect_shape(query), [body, hidden] as Array[Node2D], "bodies that are not excluded")
	check_equal(SoftBodySimulation2D.intersect_shape(query, World2D.new()).size(), 0, "bodies of an empty world")
	check_equal(SoftBodySimulation2D.intersect_shape(query, tree.root.world_2d).size(), 2, "bodies of the root's world")
	check_refused(func() -> void: SoftBodySimulation2D.intersect_shape(PhysicsShapeQueryParameters2D.new()), ["no shape"], "a query without a shape")
	check_refused(func() -> void: SoftBodySimulation2D.intersect_shape(null), ["must not be null"], "a query without parameters")


## A circle in a cup meets the body's bounding box and its convex hull, and not the body.
func test_our_own_query_sees_dents() -> void:
	var u := PackedVector2Array([Vector2(-60, -60), Vector2(-30, -60), Vector2(-30, 20), Vector2(30, 20),
			Vector2(30, -60), Vector2(60, -60), Vector2(60, 60), Vector2(-60, 60)])
	add_weightless_body(Vector2.ZERO, { "polygon": u })
	check_equal(_own(circle(20), Vector2(0, -30)).size(), 0, "bodies in the cup")
	check_equal(_own(circle(20), Vector2(0, 5)).size(), 1, "bodies at the bottom of the cup")
